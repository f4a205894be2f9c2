#include "report/stability_pictures.h"

#include "report/charts.h"
#include "report/formats.h"
#include "report/small_multiples.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    using study::StabilityResults;
    using study::StabilityRow;

    /// Values fill a logarithmic axis from this ratio on.
    constexpr double wide = 20;

    /// What a chart shows of a level; 0: nothing.
    struct Measure
    {
      const char *name, *title, *axis;
      double (*value)(const StabilityRow &);
      double (*bound)(const StabilityRow &); ///< drawn in grey; nullptr: none
    };

    const Measure measures[] = {
        {"coercivity", "smallest eigenvalue of the symmetric part", "coercivity constant [b / u]",
         [](const StabilityRow &row)
         {
           const study::Stability &s = row.stability; // of zero modes it is round-off
           return s.is_definite() ? s.smallest : std::min(s.smallest, 0.);
         },
         nullptr},
        {"inverse", "how far u moves at most by a load of size 1", "|A⁻¹| [u / b]",
         [](const StabilityRow &row) { return row.stability.inverse_norm; },
         [](const StabilityRow &row)
         { return row.stability.signs.is_m_matrix() ? row.consistency.barrier : 0; }},
        {"largest", "largest eigenvalue of the symmetric part", "largest eigenvalue [b / u]",
         [](const StabilityRow &row) { return row.stability.largest; }, nullptr}};

    /// Everything drawn of one series.
    struct Series
    {
      std::string name;
      study::Axis axis = study::Axis::horizon; ///< unless h or a variable varies
      std::vector<const StabilityRow *> rows;

      double x(const StabilityRow &row) const { return coordinate(axis, row); }
      std::string suffix() const { return name.empty() ? "" : "_" + slug(name); }
      std::string title() const { return name.empty() ? "" : name + ": "; }
    };

    std::vector<Series> all_series(const StabilityResults &results)
    {
      std::vector<Series> all;
      for (const StabilityRow &row : results.rows)
      {
        auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Series &s) { return s.name == row.series; });
        if (found == all.end())
          found = all.insert(
              all.end(), {row.series,
                          results.variable.empty() ? study::Axis::horizon : study::Axis::variable,
                          {}});
        if (!found->rows.empty() && row.h != found->rows[0]->h)
          found->axis = study::Axis::mesh_size;
        found->rows.push_back(&row);
      }
      return all;
    }

    bool has_levels(const Series &series)
    {
      return std::any_of(series.rows.begin(), series.rows.end(),
                         [&](const StabilityRow *row)
                         { return series.x(*row) != series.x(*series.rows[0]); });
    }

    bool is_drawn(double value)
    {
      return value > 0 && std::isfinite(value);
    }

    bool has_points(const Series &series, const Measure &measure)
    {
      return has_levels(series) &&
             std::any_of(series.rows.begin(), series.rows.end(),
                         [&](const StabilityRow *row) { return is_drawn(measure.value(*row)); });
    }

    std::vector<MethodName> methods_of(const StabilityResults &results)
    {
      std::vector<MethodName> methods;
      for (const StabilityRow &row : results.rows)
        if (methods.empty() || methods.back().name != row.method)
          methods.push_back({row.method, row.side});
      return methods;
    }

    Plot plot_of(const StabilityResults &results, const Series &series, const Measure &measure)
    {
      Plot plot;
      plot.file = std::string(measure.name) + series.suffix() + ".svg";
      plot.title = series.title() + measure.title;
      plot.x_label = label(series.axis, results.variable);
      plot.y_label = measure.axis;
      const auto methods = methods_of(results);
      bool has_bound = false;
      Range range{std::numeric_limits<double>::max(), 0};
      for (const MethodName &method : methods)
      {
        Line line{method.name, style_of(methods, method.name), 1.8, {}}, bound;
        for (const StabilityRow *row : series.rows)
        {
          if (row->method != method.name)
            continue;
          const double x = series.x(*row), value = measure.value(*row),
                       limit = measure.bound != nullptr ? measure.bound(*row) : 0;
          plot.x_ticks.push_back(x);
          if (is_drawn(value))
            line.points.push_back({x, value});
          if (is_drawn(limit))
            bound.points.push_back({x, limit});
          for (const double y : {value, limit})
            if (is_drawn(y))
              range = {std::min(range.low, y), std::max(range.high, y)};
        }
        if (!bound.points.empty())
        {
          bound.style = {"#999999", line.style.symbol, true};
          bound.width = 1;
          bound.label = has_bound ? "" : "barriers (M-matrices)";
          has_bound = true;
          plot.lines.push_back(bound);
        }
        plot.lines.push_back(line);
      }
      plot.is_x_log = is_logarithmic(series.axis, plot.x_ticks);
      if (!plot.is_x_log)
        plot.x_ticks.clear();
      plot.is_y_log = range.high > wide * range.low;
      return plot;
    }

    Table data_of(const StabilityResults &results, const Series &series, const Measure &measure)
    {
      Table table;
      table.columns = {"method", "series", "h", "horizon", measure.name};
      if (!results.variable.empty())
        table.columns.emplace_back(results.variable);
      if (measure.bound != nullptr)
        table.columns.emplace_back("barrier");
      for (const StabilityRow *row : series.rows)
      {
        const auto cell = [](double v) { return v == 0 ? empty_cell() : number_cell(v); };
        table.rows.push_back({text_cell(row->method), text_cell(row->series), number_cell(row->h),
                              number_cell(row->horizon), cell(measure.value(*row))});
        if (!results.variable.empty())
          table.rows.back().push_back(number_cell(row->value));
        if (measure.bound != nullptr)
          table.rows.back().push_back(cell(measure.bound(*row)));
      }
      return table;
    }

    /// One field of one operator.
    struct ModePanel
    {
      std::string title;
      const study::Modes *modes;
      std::size_t index;
    };

    struct ModePicture
    {
      std::string name, title;
      std::vector<ModePanel> panels;
    };

    /// The level to draw modes of; nullptr: none.
    const StabilityRow *drawn_level(const Series &series, const std::string &method)
    {
      constexpr std::size_t most_nodes = 1600;
      const StabilityRow *chosen = nullptr;
      for (const StabilityRow *row : series.rows) // coarse to fine
        if (row->method == method && row->failure.empty() && !row->stability.modes.values.empty() &&
            (chosen == nullptr || row->stability.modes.nodes.size() <= most_nodes))
          chosen = row;
      return chosen;
    }

    std::vector<ModePicture> mode_pictures(const StabilityResults &results)
    {
      std::vector<ModePicture> lowest, zero;
      for (const Series &series : all_series(results))
      {
        ModePicture picture{"lowest-modes" + series.suffix(),
                            series.title() + "modes of the smallest eigenvalue λ",
                            {}};
        for (const MethodName &method : methods_of(results))
        {
          const StabilityRow *const row = drawn_level(series, method.name);
          if (row == nullptr)
            continue;
          const study::Stability &s = row->stability;
          if (s.n_zero == 0)
          {
            const bool is_finest =
                std::none_of(series.rows.begin(), series.rows.end(),
                             [&](const StabilityRow *other)
                             { return other->method == row->method && other->h < row->h; });
            picture.panels.push_back({method.name + ": λ = " + rounded(s.smallest) +
                                          (is_finest ? "" : ", h = " + rounded(row->h)),
                                      &s.modes, 0});
            continue;
          }
          zero.push_back({"zero-modes_" + slug(method.name) + series.suffix(),
                          series.title() + method.name + ", h = " + rounded(row->h) + ": " +
                              s.zero_modes() + " zero-energy modes",
                          {}});
          for (std::size_t i = 0; i < s.modes.values.size(); ++i)
            zero.back().panels.push_back({std::to_string(i + 1), &s.modes, i});
        }
        if (!picture.panels.empty())
          lowest.push_back(picture);
      }
      lowest.insert(lowest.end(), zero.begin(), zero.end());
      return lowest;
    }

    double size_at(const ModePanel &panel, std::size_t node)
    {
      const auto &modes = *panel.modes;
      const double *const u = &modes.values[panel.index][node * modes.n_components];
      return modes.n_components == 1 ? std::abs(u[0]) : std::hypot(u[0], u[1]);
    }

    /// x, y, the field over its largest size there: a value, or a size and an arrow.
    std::string data(const ModePanel &panel, double arrow)
    {
      const study::Modes &modes = *panel.modes;
      const auto &values = modes.values[panel.index];
      std::size_t at = 0;
      for (std::size_t i = 0; i < modes.nodes.size(); ++i)
        at = size_at(panel, i) > size_at(panel, at) ? i : at;
      // with a sign that makes the largest value positive
      const double largest = size_at(panel, at),
                   sign = values[at * modes.n_components] < 0 ? -1 : 1,
                   scale = largest > 0 ? sign / largest : 0;
      std::ostringstream out;
      out.precision(5);
      for (std::size_t i = 0; i < modes.nodes.size(); ++i)
      {
        out << modes.nodes[i][0] << " " << modes.nodes[i][1] << " ";
        if (modes.n_components == 1)
          out << scale * values[i] << "\n";
        else
          out << std::abs(scale) * size_at(panel, i) << " " << arrow * scale * values[2 * i] << " "
              << arrow * scale * values[2 * i + 1] << "\n";
      }
      return out.str();
    }

    std::string script(const ModePicture &picture)
    {
      constexpr double arrow_in_spacings = 1.3;
      const study::Modes &first = *picture.panels.front().modes;
      const bool is_vector = first.n_components > 1;
      std::array<double, 2> lower, upper;
      for (unsigned int d = 0; d < 2; ++d)
      {
        lower[d] = upper[d] = first.nodes[0][d];
        for (const ModePanel &panel : picture.panels)
          for (const auto &node : panel.modes->nodes)
          {
            lower[d] = std::min(lower[d], node[d]);
            upper[d] = std::max(upper[d], node[d]);
          }
      }
      const double margin = .05 * std::max(upper[0] - lower[0], upper[1] - lower[1]);
      for (unsigned int d = 0; d < 2; ++d)
      {
        lower[d] -= margin;
        upper[d] += margin;
      }
      const std::size_t n = picture.panels.size();
      const SmallMultiples panels(n, n <= 4 ? std::min<std::size_t>(n, 2) : 3, lower, upper);
      std::ostringstream out, plots;
      out << "\nreset\n";
      for (std::size_t i = 0; i < picture.panels.size(); ++i)
      {
        const ModePanel &panel = picture.panels[i];
        const double spacing = std::sqrt((upper[0] - lower[0]) * (upper[1] - lower[1]) /
                                         static_cast<double>(panel.modes->nodes.size()));
        const double pixels = spacing / (upper[0] - lower[0]) * panels.panel_width();
        out << "$p" << i << " << EOD\n" << data(panel, arrow_in_spacings * spacing) << "EOD\n";
        plots << panels.panel(i, panel.title) << "plot $p" << i;
        if (is_vector)
          plots << " using ($1-.5*$4):($2-.5*$5):4:5:3 with vectors head filled size graph "
                << .35 * pixels / panels.panel_width() << ",24 lw 1.2 lc palette notitle";
        else
          plots << " using 1:2:3 with points pt 7 ps " << .12 * pixels << " lc palette notitle";
        plots << "\n" << SmallMultiples::next();
      }
      out << panels.begin(picture.name + ".svg", picture.title,
                          is_vector ? "|mode| over its largest" : "mode over its largest")
          << "set palette defined ("
          << (is_vector ? "0 '#c9d3dd', .5 '#4a9cc9', 1 '#00365c'"
                        : "-1 '#2166ac', -.5 '#92c5de', 0 '#dcdcdc', .5 '#f4a582', 1 '#b2182b'")
          << ")\nset cbrange [" << (is_vector ? 0 : -1) << ":1]\nset cbtics .5\n"
          << plots.str() << SmallMultiples::end();
      return out.str();
    }
  } // namespace

  std::vector<StabilityPicture> list_pictures(const StabilityResults &results)
  {
    std::vector<StabilityPicture> pictures;
    for (const Series &series : all_series(results))
      for (const Measure &measure : measures)
        if (has_points(series, measure))
          pictures.push_back(
              {measure.name + series.suffix(), series.title() + measure.title, false});
    for (const ModePicture &picture : mode_pictures(results))
      pictures.push_back({picture.name, picture.title, true});
    return pictures;
  }

  void write_pictures(const StabilityResults &results, const std::filesystem::path &dir)
  {
    const std::filesystem::path folder = dir / "stability";
    std::vector<Plot> plots;
    for (const Series &series : all_series(results))
      for (const Measure &measure : measures)
        if (has_points(series, measure))
        {
          plots.push_back(plot_of(results, series, measure));
          write_file(folder / (measure.name + series.suffix() + ".csv"),
                     to_csv(data_of(results, series, measure)));
        }
    std::string modes;
    std::vector<std::string> pictures;
    for (const ModePicture &picture : mode_pictures(results))
    {
      modes += script(picture);
      pictures.push_back(picture.name + ".svg");
    }
    if (plots.empty() && modes.empty())
      return;
    write_file(folder / "pictures.gp", gnuplot_script(plots) + modes);
    for (const Plot &plot : plots)
      pictures.push_back(plot.file);
    run_gnuplot(folder, "pictures.gp", pictures);
  }
} // namespace plumbline::report
