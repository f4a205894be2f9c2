#include "report/page_parts.h"

#include "report/page_script.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

namespace plumbline::report::page
{
  namespace
  {
    void replace_all(std::string &text, const std::string &from, const std::string &to)
    {
      for (std::size_t at = text.find(from); at != std::string::npos;
           at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    }

    /// Drop what stands between two marks, the first time.
    void erase(std::string &text, const std::string &from, const std::string &to)
    {
      const std::size_t begin = text.find(from);
      const std::size_t end = begin == std::string::npos ? begin : text.find(to, begin);
      if (end != std::string::npos)
        text.erase(begin, end + to.size() - begin);
    }
  } // namespace

  std::string marker(const Style &style)
  {
    static const char *const shapes[] = {"<circle cx='14' cy='8' r='4'/>",
                                         "<rect x='10.4' y='4.4' width='7.2' height='7.2'/>",
                                         "<path d='M14 3.2 L18.6 11 H9.4 Z'/>",
                                         "<path d='M14 3 L19 8 L14 13 L9 8 Z'/>",
                                         "<path d='M14 12.8 L18.6 5 H9.4 Z'/>",
                                         "<path d='M14 3.4 L18.5 6.7 L16.8 12 H11.2 L9.5 6.7 Z'/>"};
    const std::string fill = style.is_dashed ? "#fff" : style.colour;
    return "<svg class=\"marker\" width=\"28\" height=\"16\" aria-hidden=\"true\" stroke=\"" +
           style.colour + "\" stroke-width=\"1.6\" fill=\"" + fill + "\"><path d='M0 8 H28'" +
           (style.is_dashed ? " stroke-dasharray='5 3'" : "") + "/>" + shapes[style.symbol] +
           "</svg>";
  }

  std::string inline_svg(const std::string &svg, const std::string &prefix,
                         const std::string &label)
  {
    const std::size_t begin = svg.find("<svg"), end = svg.find('>', begin);
    if (begin == std::string::npos || end == std::string::npos)
      return "";
    const std::string tag = svg.substr(begin, end - begin);
    std::string box;
    if (const std::size_t at = tag.find("viewBox=\""); at != std::string::npos)
      box = tag.substr(at, tag.find('"', at + 9) + 1 - at);

    std::string body = svg.substr(end + 1);
    erase(body, "<title>", "</title>"); // the first is the program's
    erase(body, "<desc>", "</desc>");
    replace_all(body, "xlink:href=", "href=");
    for (const char *quote : {"'", "\""})
    {
      replace_all(body, std::string(" id=") + quote, std::string(" id=") + quote + prefix);
      replace_all(body, std::string("href=") + quote + "#",
                  std::string("href=") + quote + "#" + prefix);
    }
    replace_all(body, "url(#", "url(#" + prefix);
    return "<svg " + box + " role=\"img\" aria-label=\"" + escape_html(label) + "\">" + body;
  }

  std::string inline_svg(const std::filesystem::path &picture, const std::string &prefix,
                         const std::string &label)
  {
    std::ifstream in(picture, std::ios::binary);
    return inline_svg(std::string(std::istreambuf_iterator<char>(in), {}), prefix, label);
  }

  Data begin(const std::string &page, const std::string &scene_name, const std::string &purpose,
             const std::vector<std::string> &facts)
  {
    return {{"page", page},  {"name", scene_name},  {"purpose", purpose}, {"facts", facts},
            {"setting", ""}, {"is_partial", false}, {"nav", Data()}};
  }

  Data table(const Table &table)
  {
    if (table.rows.empty())
      return {};
    Data columns = Data::array(), rows = Data::array(), groups = Data::array();
    bool has_groups = false;
    for (const Column &column : table.columns)
    {
      has_groups = has_groups || !column.group.empty();
      if (!groups.empty() && groups.back()["text"] == column.group)
        groups.back()["n"] = groups.back()["n"].get<std::size_t>() + 1;
      else
        groups.push_back({{"text", column.group}, {"n", std::size_t(1)}});
    }
    std::vector<bool> are_numbers; // a word in a column of numbers is aligned as they are
    for (std::size_t j = 0; j < table.columns.size(); ++j)
    {
      are_numbers.push_back(table.rows.front()[j].is_number);
      columns.push_back({{"text", table.columns[j].head}, {"is_number", are_numbers[j]}});
    }
    for (const auto &row : table.rows)
    {
      Data cells = Data::array();
      for (std::size_t j = 0; j < row.size(); ++j)
      {
        const Cell &cell = row[j];
        const bool is_number = cell.is_number || are_numbers[j];
        cells.push_back({{"text", cell.text},
                         {"is_number", is_number},
                         {"class", cell.look.empty() && is_number ? "n" : cell.look},
                         {"is_strong", cell.is_strong},
                         {"marker", cell.marker},
                         {"notes", cell.notes},
                         {"hint", cell.hint}});
      }
      rows.push_back({{"cells", std::move(cells)}});
    }
    return {{"columns", std::move(columns)},
            {"rows", std::move(rows)},
            {"groups", has_groups ? Data{{"heads", std::move(groups)}} : Data()},
            {"style", ""}};
  }

  Data figure(const Figure &figure)
  {
    const std::string coinciding = coinciding_lines(figure.picture);
    const std::string words = coinciding.empty() ? "" : "Lines that coincide: " + coinciding + ".";
    const bool has_both = !words.empty() && !figure.caption.empty();
    return {{"svg", inline_svg(figure.picture, figure.prefix, figure.title)},
            {"data", chart_data(figure.picture)},
            {"title", figure.title},
            {"caption", figure.caption + (has_both ? " " : "") + words},
            {"source", figure.source},
            {"file", figure.file},
            {"is_large", figure.is_large},
            {"again", figure.again}};
  }

  Data charts(const std::vector<DataChart> &charts, const std::filesystem::path &dir,
              const std::string &folder)
  {
    Data figures = Data::array();
    for (const DataChart &chart : charts)
      figures.push_back(
          figure({dir / folder / chart.plot.file, chart.name + "-", chart.plot.title, chart.caption,
                  "Data", (std::filesystem::path(folder) / (chart.name + ".csv")).string()}));
    return figures;
  }

  std::string file_of(const Part &part)
  {
    return part.file.empty() ? part.id + "_table" : part.file;
  }

  bool is_shown(const Part &part)
  {
    return !part.table.rows.empty() ||
           (part.table.columns.empty() &&
            !(part.lead.empty() && part.words.empty() && part.items.empty()));
  }

  std::vector<Part> with_rows(std::vector<Part> parts)
  {
    parts.erase(std::remove_if(parts.begin(), parts.end(),
                               [](const Part &part) { return part.table.rows.empty(); }),
                parts.end());
    return parts;
  }

  Data parts(const std::vector<Part> &parts, const std::string &folder)
  {
    Data list = Data::array();
    for (const Part &part : parts)
    {
      if (!is_shown(part))
        continue;
      const bool has_file = !folder.empty() && !part.table.rows.empty();
      Data data = {{"id", part.id},
                   {"head", part.head},
                   {"lead", part.lead},
                   {"is_warning", part.is_warning},
                   {"table", table(part.table)},
                   {"words", part.words},
                   {"file", has_file ? folder + "/" + file_of(part) + ".csv" : ""},
                   {"list", part.items.empty() ? Data() : Data{{"items", part.items}}},
                   {"is_open", part.fold == Fold::open},
                   {"folds", Data::array()}};
      if (part.fold == Fold::none || list.empty())
        list.push_back(std::move(data));
      else
        list.back()["folds"].push_back(std::move(data));
    }
    return list;
  }

  Data expectations(const study::StudyResults &results)
  {
    if (results.expectations.empty())
      return {};
    Data met = Data::array(), missed = Data::array();
    for (const study::Expectation &one : results.expectations)
      (one.holds ? met : missed)
          .push_back({{"holds", one.holds},
                      {"subject", one.subject},
                      {"expected", one.expected},
                      {"found", one.found}});
    const auto rows = [](const Data &list) { return list.empty() ? Data() : Data{{"rows", list}}; };
    return {{"n_hold", met.size()},
            {"n", results.expectations.size()},
            {"met", rows(met)},
            {"missed", rows(missed)}};
  }
} // namespace plumbline::report::page
