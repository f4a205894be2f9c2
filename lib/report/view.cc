#include "report/view.h"

#include "io/results_json.h"
#include "report/damage_maps.h"
#include "report/equation.h"
#include "report/text_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::report
{
  namespace
  {
    /// @param make  of a number
    RecordColumn scalar_column(const std::string &head, const std::string &scalar,
                               Cell (*make)(double))
    {
      return {head, [=](const Record &record)
              { return known(record.has(scalar), make(record[scalar])); }};
    }

    bool is_drawn(double value)
    {
      return value > 0 && std::isfinite(value);
    }

    std::string suffix(const std::string &series)
    {
      return series.empty() ? "" : "_" + slug(series);
    }

    /// What varies over the records of a series.
    study::Axis axis_of(const StudyResults &results, const std::vector<const Record *> &records)
    {
      if (!results.variable.empty())
        return study::Axis::variable;
      const bool has_one_h = std::all_of(records.begin(), records.end(),
                                         [&](const Record *record)
                                         { return record->key.h == records.front()->key.h; });
      return has_one_h ? study::Axis::horizon : study::Axis::mesh_size;
    }
  } // namespace

  RecordColumn number_column(const std::string &head, const std::string &scalar)
  {
    return scalar_column(head, scalar, number_cell);
  }

  RecordColumn error_column(const std::string &head, const std::string &scalar)
  {
    return scalar_column(head, scalar, error_cell);
  }

  RecordColumn count_column(const std::string &head, const std::string &scalar)
  {
    return {head, [scalar](const Record &record)
            { return known(record.has(scalar), count_cell(record.count(scalar))); }};
  }

  RecordColumn text_column(const std::string &head, const std::string &text)
  {
    return {head, [text](const Record &record)
            { return known(!record.text(text).empty(), text_cell(record.text(text))); }};
  }

  std::vector<RecordColumn> with_place(const StudyResults &results,
                                       std::vector<RecordColumn> others)
  {
    std::vector<RecordColumn> columns = {
        {"method", [](const Record &record) { return text_cell(record.key.label()); }},
        {"m", [](const Record &record) { return number_cell(record.key.m()); }},
        {"h", [](const Record &record) { return number_cell(record.key.h); }}};
    if (!results.variable.empty())
      columns.push_back(
          {results.variable, [](const Record &record) { return number_cell(record.key.value); }});
    std::move(others.begin(), others.end(), std::back_inserter(columns));
    return columns;
  }

  Table table_of(const StudyResults &results, const std::vector<RecordColumn> &columns,
                 const IsShown &is_shown)
  {
    std::vector<std::reference_wrapper<const Record>> shown;
    std::copy_if(results.records.begin(), results.records.end(), std::back_inserter(shown),
                 is_shown);
    return without_empty_columns(table_of(shown, columns));
  }

  std::string look_of(study::Rating rating)
  {
    constexpr std::array names = {"converges", "undecided", "stalls"};
    return names[static_cast<std::size_t>(rating)];
  }

  Part failures(const StudyResults &results, const std::string &title, const std::string &head,
                const IsShown &is_shown)
  {
    return {"missing", title, "",
            table_of(results,
                     with_place(results, {{head, [](const Record &record)
                                           { return text_cell(record.failure); }}}),
                     [&](const Record &record)
                     { return !record.failure.empty() && (!is_shown || is_shown(record)); })};
  }

  const std::vector<double> &column(const analysis::Curve &curve, const std::string &name)
  {
    return std::find_if(curve.begin(), curve.end(),
                        [&](const analysis::Column &one) { return one.name == name; })
        ->values;
  }

  Table table_of(const analysis::Curve &curve)
  {
    Table table;
    for (const analysis::Column &column : curve)
      table.columns.emplace_back(column.name +
                                 (column.unit.empty() ? "" : " [" + column.unit + "]"));
    for (std::size_t i = 0; i < curve.front().values.size(); ++i)
    {
      table.rows.emplace_back();
      for (const analysis::Column &column : curve)
        table.rows.back().push_back(number_cell(column.values[i]));
    }
    return table;
  }

  Table quantity_table(const Record &record,
                       const std::vector<std::pair<std::string, std::string>> &meanings)
  {
    Table table;
    table.columns = {"quantity", "value", "meaning"};
    for (const auto &[name, meaning] : meanings)
      if (record.has(name) || record.texts.count(name) > 0)
        table.rows.push_back(
            {text_cell(name),
             record.has(name) ? number_cell(record[name]) : text_cell(record.text(name)),
             text_cell(meaning)});
    return table;
  }

  Table verdict_table(const StudyResults &results)
  {
    Table table;
    table.columns = {"method", "series", "verdict", "condition", "explanation"};
    for (const study::Verdict &v : results.verdicts)
    {
      table.rows.push_back(
          {text_cell(v.method), known(!v.series.empty(), text_cell(v.series)), text_cell(v.verdict),
           known(!v.condition.empty(), text_cell(v.condition)), text_cell(v.explanation)});
      table.rows.back()[2].look = look_of(v.rating);
    }
    return without_empty_columns(table);
  }

  Table power_table(const StudyResults &results)
  {
    Table table;
    table.columns = {"method", "series", "powers of"};
    std::vector<std::string> names;
    for (const study::Power &power : results.powers)
      for (const auto &[name, value] : power.of)
        if (std::find(names.begin(), names.end(), name) == names.end())
          names.push_back(name);
    table.columns.insert(table.columns.end(), names.begin(), names.end());
    for (const study::Power &power : results.powers)
    {
      if (power.of.empty())
        continue;
      table.rows.push_back(
          {text_cell(power.method), text_cell(power.series), text_cell(base::word(power.axis))});
      for (const std::string &name : names)
      {
        const auto found = power.of.find(name);
        table.rows.back().push_back(found == power.of.end() ? empty_cell()
                                                            : rate_cell(found->second));
      }
    }
    return without_empty_columns(table);
  }

  std::vector<MethodName> methods_of(const StudyResults &results, const IsShown &is_shown)
  {
    std::vector<MethodName> methods;
    for (const Record &record : results.records)
      if (is_shown(record) &&
          std::none_of(methods.begin(), methods.end(),
                       [&](const MethodName &one) { return one.name == record.key.label(); }))
        methods.push_back({record.key.label(), record.key.family});
    return methods;
  }

  std::vector<std::string> series_of(const StudyResults &results)
  {
    std::vector<std::string> all;
    for (const Record &record : results.records)
      if (std::find(all.begin(), all.end(), record.key.series) == all.end())
        all.push_back(record.key.series);
    return all;
  }

  namespace
  {
    DataChart chart_of(const ChartView &view, const StudyResults &results,
                       const std::vector<const Record *> &records,
                       const std::vector<MethodName> &methods)
    {
      constexpr double wide = 20; // values fill a logarithmic axis from this ratio on
      const std::string &series = records.front()->key.series;
      const study::Axis axis = axis_of(results, records);
      DataChart chart =
          named(view.name + suffix(series), (series.empty() ? "" : series + ": ") + view.title);
      Plot &plot = chart.plot;
      plot.x_label = label(axis, results.variable);
      plot.y_label = view.y_label;
      plot.has_slopes = view.has_slopes && results.variable.empty();
      chart.data.columns = {"method", "series", "h", "horizon", view.name};
      if (!results.variable.empty())
        chart.data.columns.emplace_back(results.variable);
      if (view.bound)
        chart.data.columns.emplace_back("bound");
      Range range{std::numeric_limits<double>::max(), 0};
      bool has_bound = false;
      for (const MethodName &method : methods)
      {
        Line line{method.name, style_of(methods, method.name), 1.8, {}}, bound;
        for (const Record *record : records)
        {
          if (record->key.label() != method.name)
            continue;
          const double x = coordinate(axis, record->key), value = view.y(*record),
                       limit = view.bound ? view.bound(*record) : 0;
          plot.x_ticks.push_back(x);
          if (is_drawn(value))
            line.points.push_back({x, value});
          if (is_drawn(limit))
            bound.points.push_back({x, limit});
          for (const double y : {value, limit})
            if (is_drawn(y))
              range = {std::min(range.low, y), std::max(range.high, y)};
          const auto cell = [](double v) { return v == 0 ? empty_cell() : number_cell(v); };
          auto &row = chart.data.rows.emplace_back();
          row = {text_cell(method.name), text_cell(series), number_cell(record->key.h),
                 number_cell(record->key.horizon), cell(value)};
          if (!results.variable.empty())
            row.push_back(number_cell(record->key.value));
          if (view.bound)
            row.push_back(cell(limit));
        }
        if (!bound.points.empty())
        {
          bound.style = {"#999999", line.style.symbol, true};
          bound.width = 1;
          bound.label = has_bound ? "" : view.bound_label;
          has_bound = true;
          plot.lines.push_back(bound);
        }
        plot.lines.push_back(line);
      }
      plot.is_x_log = is_logarithmic(axis, plot.x_ticks);
      if (!plot.is_x_log)
        plot.x_ticks.clear();
      plot.is_y_log = range.high > wide * range.low;
      return chart;
    }
  } // namespace

  std::vector<DataChart> charts_of(const ChartView &view, const StudyResults &results,
                                   const IsShown &is_shown)
  {
    std::vector<DataChart> charts;
    const auto methods = methods_of(results, is_shown);
    for (const std::string &series : series_of(results))
    {
      std::vector<const Record *> records;
      for (const Record &record : results.records)
        if (record.key.series == series && is_shown(record))
          records.push_back(&record);
      const auto differs = [&](const Record *record)
      {
        const study::Axis axis = axis_of(results, records);
        return coordinate(axis, record->key) != coordinate(axis, records.front()->key);
      };
      if (std::any_of(records.begin(), records.end(), differs) &&
          std::any_of(records.begin(), records.end(),
                      [&](const Record *record) { return is_drawn(view.y(*record)); }))
        charts.push_back(chart_of(view, results, records, methods));
    }
    return charts;
  }

  View default_view(const StudyResults &results)
  {
    const auto is_shown = [](const Record &record) { return record.failure.empty(); };
    std::vector<RecordColumn> columns;
    std::vector<std::string> names;
    for (const Record &record : results.records)
      for (const auto &[name, scalar] : record.scalars)
        if (std::find(names.begin(), names.end(), name) == names.end())
          names.push_back(name);
    View view{results.analysis};
    Gallery charts{"charts", "Over the sweep", "", {}};
    for (const std::string &name : names)
    {
      columns.push_back(number_column(name, name));
      for (DataChart &chart : charts_of(
               {slug(name), name, name, [name](const Record &record) { return record[name]; }},
               results, is_shown))
        charts.charts.push_back(std::move(chart));
    }
    view.parts = {
        {"values", "Values", "", table_of(results, with_place(results, columns), is_shown)},
        failures(results, "Levels without a result", "because")};
    view.galleries = {std::move(charts)};
    return view;
  }

  namespace
  {
    constexpr std::array signs = {"✓", "?", "✗"}; // of ratings

    /// So many charts or cards are seen at one glance; more are folded.
    constexpr std::size_t at_a_glance = 6;

    FileNames files_of(const View &view, const StudyResults &results)
    {
      FileNames names = view.files;
      for (std::string *const one : {&names.page, &names.numbers, &names.tables, &names.charts})
        if (one->empty())
          *one = results.analysis;
      return names;
    }

    Data page_verdicts(const View &view)
    {
      Data data = page::table(view.verdicts);
      if (data.is_null())
        return data;
      for (Data &row : data["rows"])
        row["cells"][0]["class"] = "method";
      data["style"] = "verdicts";
      data["question"] = view.question;
      data["explanation"] = view.words;
      return data;
    }

    Data page_advice(const View &view)
    {
      if (view.statements.empty())
        return {};
      Data statements = Data::array(), open = Data::array(), more = Data::array();
      for (const Statement &one : view.statements)
        statements.push_back({{"words", one.words}, {"is_bad", one.is_bad}});
      for (const Card &card : view.cards)
        (open.size() < at_a_glance ? open : more)
            .push_back({{"title", card.title},
                        {"table", page::table(card.table)},
                        {"words", card.words},
                        {"warnings", card.warnings}});
      const Data n_more = more.empty() ? Data() : Data(more.size());
      return {{"statements", std::move(statements)},
              {"remarks", view.remarks},
              {"cards",
               open.empty() ? Data() : Data{{"open", open}, {"more", more}, {"n_more", n_more}}}};
    }

    Data page_gallery(const View &view, const Gallery &gallery, const std::filesystem::path &folder,
                      const std::string &charts)
    {
      Data large = Data::array(), small = Data::array(), pictures = Data::array();
      for (std::size_t i = 0; i < gallery.charts.size(); ++i)
      {
        const DataChart &chart = gallery.charts[i];
        const bool is_large = i < gallery.n_large;
        (is_large ? large : small)
            .push_back(page::figure({folder / charts / chart.plot.file, chart.name + "-",
                                     chart.plot.title, chart.caption, "Data",
                                     charts + "/" + chart.name + ".csv", is_large, view.redraw}));
      }
      for (const Picture &picture : gallery.pictures)
      {
        const bool has_data = !picture.data.rows.empty();
        pictures.push_back(page::figure(
            {folder / charts / (picture.name + ".svg"), picture.name + "-", picture.title,
             picture.caption, has_data ? "Data" : "Picture",
             charts + "/" + picture.name + (has_data ? ".csv" : ".svg"), true, view.redraw}));
      }
      if (large.empty() && small.empty() && pictures.empty())
        return {};
      const std::size_t n = small.size();
      Data grid = n == 0 ? Data() : Data{{"charts", std::move(small)}};
      const bool is_folded = n > 0 && !gallery.rest.empty();
      if (is_folded)
        grid.update({{"summary", gallery.rest},
                     {"fold_words", gallery.note},
                     {"n", n},
                     {"is_open", n <= at_a_glance && gallery.n_large > 0}});
      return {{"id", gallery.id},
              {"title", gallery.title},
              {"words", gallery.words},
              {"large", std::move(large)},
              {"pictures", std::move(pictures)},
              {"folded", is_folded ? grid : Data()},
              {"grid", is_folded ? Data() : grid},
              {"note", is_folded ? "" : gallery.note}};
    }

    std::vector<std::string> facts_of(const View &view, const StudyResults &results)
    {
      std::vector<std::string> facts = view.facts;
      for (std::size_t i = 0; i < signs.size() && !results.verdicts.empty(); ++i)
        facts.push_back(
            signs[i] +
            (" " + std::to_string(std::count_if(results.verdicts.begin(), results.verdicts.end(),
                                                [&](const study::Verdict &v) {
                                                  return static_cast<std::size_t>(v.rating) == i;
                                                }))) +
            " " + base::word(static_cast<study::Rating>(i)));
      const auto n_hold = std::count_if(results.expectations.begin(), results.expectations.end(),
                                        [](const study::Expectation &one) { return one.holds; });
      if (const std::size_t n = results.expectations.size(); n > 0)
        facts.push_back("expected: " + std::to_string(n_hold) + " of " + std::to_string(n) +
                        " hold");
      if (!results.is_complete)
        facts.emplace_back(page::interrupted);
      return facts;
    }

    std::string page_of(const View &view, const StudyResults &results,
                        const std::filesystem::path &folder)
    {
      const FileNames files = files_of(view, results);
      Data data =
          page::begin(files.page, results.scene_name, results.purpose, facts_of(view, results));
      data["is_partial"] = !results.is_complete;
      data["setting"] = view.setting;
      data["advice"] = page_advice(view);
      data["findings"] = view.findings.empty()
                             ? Data()
                             : Data{{"list", view.findings},
                                    {"n", view.findings.size()},
                                    {"is_open", view.findings.size() <= at_a_glance}};
      data["answer"] = view.statements.empty() ? answer_of(view) : "";
      data["equation"] = equation(results);
      data["scene_text"] = results.scene_text;
      data["verdicts"] = page_verdicts(view);
      data["expectations"] = page::expectations(results);
      data["warnings"] = results.warnings;
      data["left_out"] = results.left_out;
      data["n_left_out"] = results.left_out.empty() ? Data() : Data(results.left_out.size());
      data["provenance"] = Data::array();
      for (const auto &[what, value] : results.provenance)
        data["provenance"].push_back(what + ": " + value);
      data["galleries"] = Data::array();
      for (const Gallery &gallery : view.galleries)
        if (Data one = page_gallery(view, gallery, folder, files.charts); !one.is_null())
          data["galleries"].push_back(std::move(one));
      data["parts"] = page::parts(view.parts, files.tables);
      Data links = Data::array();
      for (const auto &[section, title] :
           {std::pair("verdicts", "Verdicts"), {"expectations", "Expectations"}})
        if (!data[section].is_null())
          links.push_back({{"id", section}, {"title", title}});
      for (const Data &gallery : data["galleries"])
        if (gallery["title"] != "")
          links.push_back({{"id", gallery["id"]}, {"title", gallery["title"]}});
      for (const Data &part : data["parts"])
        links.push_back({{"id", part["id"]}, {"title", part["head"]}});
      data["nav"] = {{"links", std::move(links)}};
      return fill("study", data);
    }

    std::string markdown(const View &view, const StudyResults &results)
    {
      std::string text = "# " + view.title + ": " + results.scene_name + "\n\n";
      if (const std::string answer = answer_of(view); !answer.empty())
        text += answer + "\n\n";
      for (const std::string &finding : view.findings)
        text += "- " + finding + "\n";
      text += view.findings.empty() ? "" : "\n";
      for (const std::string &warning : results.warnings)
        text += "Warning: " + warning + ".\n\n";
      if (!view.verdicts.rows.empty())
        text += to_markdown(view.verdicts);
      if (!view.question.empty())
        text += "\n" + view.question + "\n";
      for (const Part &part : view.parts)
        if (page::is_shown(part) && !part.is_excerpt)
        {
          text += "\n## " + part.head + "\n\n" + (part.lead.empty() ? "" : part.lead + "\n\n") +
                  (part.table.rows.empty() ? "" : to_markdown(part.table)) +
                  (part.words.empty() ? "" : "\n" + part.words + "\n");
          for (const std::string &item : part.items)
            text += "- " + item + "\n";
        }
      return text + "\n## The scene as read\n\n```\n" + results.scene_text + "```\n";
    }

    void draw(const View &view, const std::filesystem::path &folder)
    {
      std::vector<DataChart> charts;
      std::vector<std::string> pictures;
      std::string script;
      for (const Gallery &gallery : view.galleries)
      {
        charts.insert(charts.end(), gallery.charts.begin(), gallery.charts.end());
        for (const Picture &picture : gallery.pictures)
        {
          script += picture.script;
          pictures.push_back(picture.name + ".svg");
          std::filesystem::remove(folder / pictures.back());
          if (!picture.data.rows.empty())
            write_file(folder / (picture.name + ".csv"), to_csv(picture.data));
        }
      }
      for (const DataTable &one : view.tables)
        write_file(folder / (one.name + ".csv"), to_csv(one.table));
      write_charts(charts, folder);
      if (pictures.empty())
        return;
      write_file(folder / "pictures.gp", script);
      run_gnuplot(folder, "pictures.gp", pictures);
      for (const std::string &picture : pictures)
        sharpen(folder / picture);
    }

    void write_table(const Part &part, const std::filesystem::path &folder)
    {
      const std::string name = page::file_of(part);
      write_file(folder / (name + ".csv"), to_csv(part.table));
      write_file(folder / (name + ".md"), to_markdown(part.table));
      write_file(folder / (name + ".tex"), to_latex(part.table));
    }
  } // namespace

  Part model_part(const std::string &words)
  {
    return {"model", "The model", words};
  }

  Part omitted_part(const std::vector<std::string> &phrases)
  {
    Part part{"omitted", "What was left out of the model", ""};
    part.items = phrases;
    return part;
  }

  void write_study(const View &view, const StudyResults &results,
                   const std::filesystem::path &folder)
  {
    write_file(folder / (files_of(view, results).numbers + ".json"), io::to_json(results));
    write_view(view, results, folder);
  }

  void write_view(const View &view, const StudyResults &results,
                  const std::filesystem::path &folder)
  {
    const FileNames files = files_of(view, results);
    write_file(folder / (files.page + ".md"), markdown(view, results));
    for (const Part &part : page::with_rows(view.parts))
      if (!part.is_excerpt)
        write_table(part, folder / files.tables);
    write_with_pictures(
        folder / (files.page + ".html"), [&] { draw(view, folder / files.charts); },
        [&] { return page_of(view, results, folder); });
  }
} // namespace plumbline::report
