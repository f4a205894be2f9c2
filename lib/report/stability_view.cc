#include "report/counted.h"
#include "report/small_multiples.h"
#include "report/text_table.h"
#include "report/view.h"
#include "study/stability.h"
#include "study/strain_growth.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    using analysis::PointField;
    using study::is_definite;
    using study::is_m_matrix;

    bool is_operator(const Record &record)
    {
      return record.failure.empty() && record.key.variant.empty();
    }

    bool has_growth(const Record &record)
    {
      return record.curves.count("growth") > 0;
    }

    /// @param is  whether its value is known
    template <class Is, class Make>
    RecordColumn column(const std::string &head, const Is &is, const Make &make)
    {
      return {head, [=](const Record &record) { return is(record) ? make(record) : empty_cell(); }};
    }

    Part measures(const StudyResults &results)
    {
      const auto has_signs = [](const Record &record) { return record.has("asymmetry"); };
      const auto has_norm = [](const Record &record) { return record.has("inverse norm"); };
      const auto has_conditions = [](const Record &record)
      { return record.count("moment conditions") > 0; };
      return {
          "measures", "Measures",
          "smallest, largest: eigenvalues of the symmetric part in the discrete L2 inner product; "
          "the smallest is the coercivity constant. asymmetry: of A, relative to its largest "
          "entry. "
          "|A^-1|: the largest |u| under loads of size 1; barrier: what the maximum "
          "principle "
          "bounds it by, of M-matrices. min weight: relative to its area. rank, singular: of the "
          "moments asked of a family, and the smallest singular value of their matrix scaled to "
          "norm 1. degree: of polynomials that are mapped exactly, at inner nodes.",
          table_of(results,
                   with_place(results,
                              {count_column("unknowns", "unknowns"),
                               number_column("smallest", "smallest eigenvalue"),
                               number_column("largest", "largest eigenvalue"),
                               {"zero modes",
                                [](const Record &record)
                                {
                                  Cell cell = count_cell(record.count("zero modes"));
                                  cell.text = study::zero_modes(record);
                                  return cell;
                                }},
                               number_column("asymmetry", "asymmetry"),
                               column("M-matrix", has_signs,
                                      [](const Record &record)
                                      { return text_cell(is_m_matrix(record) ? "yes" : "no"); }),
                               count_column("parts", "parts"),
                               column("|A^-1|", has_norm,
                                      [](const Record &record)
                                      {
                                        Cell cell = number_cell(record["inverse norm"]);
                                        if (record["inverse norm is exact"] == 0)
                                          cell.text = ">= " + cell.text;
                                        return cell;
                                      }),
                               column("barrier", is_m_matrix,
                                      [](const Record &record) {
                                        return known(record.has("barrier"),
                                                     number_cell(record["barrier"]));
                                      }),
                               number_column("min weight", "smallest weight"),
                               column("rank", has_conditions,
                                      [](const Record &record)
                                      {
                                        return text_cell(
                                            std::to_string(record.count("moment rank")) + "/" +
                                            std::to_string(record.count("moment conditions")));
                                      }),
                               number_column("singular", "smallest singular value"),
                               count_column("degree", "exact degree")}),
                   is_operator)};
    }

    Part eigenvalues(const StudyResults &results)
    {
      return {
          "eigenvalues", "Eigenvalues where A is not symmetric",
          "Of A itself in the discrete L2 inner product, where A is not symmetric; elsewhere they "
          "are those of the symmetric part. The imaginary part is the largest of those computed: "
          "the ones nearest to 0 and the outermost.",
          table_of(results,
                   with_place(results, {number_column("least real part", "least real part"),
                                        number_column("least modulus", "least modulus"),
                                        number_column("largest modulus", "largest modulus"),
                                        number_column("largest |imaginary part|",
                                                      "largest imaginary part")}),
                   [](const Record &record)
                   { return is_operator(record) && record["asymmetry"] >= 1e-12; })};
    }

    Part time_steps(const StudyResults &results)
    {
      return {
          "time-steps", "Critical time steps",
          "dt: critical time step of central differences, 2 / sqrt(lambda / rho), with the "
          "largest eigenvalue lambda of the equations linearised at rest (double-well bonds on a "
          "lattice: over all waves of the infinite lattice); of Galerkin methods with the mass "
          "matrix, and with lumped masses. grows: some eigenvalues are complex or negative, so "
          "solutions grow with any time step.",
          table_of(
              results,
              with_place(results,
                         {number_column("density", "density"),
                          number_column("lambda", "largest eigenvalue in motion"),
                          number_column("dt", "critical step"),
                          number_column("lambda, lumped", "largest eigenvalue in motion, lumped"),
                          number_column("dt, lumped", "critical step, lumped"),
                          {"grows", [](const Record &record)
                           { return known(record.count("grows") > 0, text_cell("yes")); }}}),
              [](const Record &record)
              { return is_operator(record) && record.has("critical step"); })};
    }

    Part strain_thresholds(const StudyResults &results)
    {
      return {
          "strains", "Where waves on strains begin to grow",
          "X = beta eps g^2 of the strain g, from which on waves grow: of any length on the whole "
          "plane (ellipticity of the local limit is lost); of this torus, four mesh sizes long or "
          "longer; by the symbol of the bonds; and from which on the local criterion (64) of Jha "
          "& Lipton 2018, doi:10.1137/17M1112236, says so: it is sufficient, but late where its X "
          "is larger. observed: the motion of the wave that grows fastest by the symbol, started "
          "at 1e-10 of the horizon; first seen is the first X of the samples at which it grew. "
          "Differences are over the symbol's largest rate: from the symbol, and from the rule's "
          "own tangent.",
          table_of(results,
                   {{"series", [](const Record &r) { return text_cell(r.key.series); }},
                    {"h", [](const Record &r) { return number_cell(r.key.h); }},
                    {"strain", [](const Record &r) { return text_cell(r.key.variant); }},
                    {"method", [](const Record &r) { return text_cell(r.key.method); }},
                    number_column("X, any wave", "ellipticity lost"),
                    number_column("X, of this torus", "first wave of the torus"),
                    number_column("X, (64)", "criterion (64)"),
                    number_column("first seen at X", "first seen"),
                    error_column("from symbol", "difference from the symbol"),
                    error_column("from tangent", "difference from the tangent"),
                    {"no motion, because", [](const Record &r)
                     { return known(!r.failure.empty(), text_cell(r.failure)); }}},
                   has_growth)};
    }

    Part spectral_radii(const StudyResults &results)
    {
      const auto has_radii = [](const Record &record) { return record.has("growth step"); };
      std::vector<RecordColumn> columns = {
          {"series", [](const Record &r) { return text_cell(r.key.series); }},
          {"strain", [](const Record &r) { return text_cell(r.key.variant); }},
          {"method", [](const Record &r) { return text_cell(r.key.method); }},
          number_column("rate", "growth rate"),
          number_column("dt", "growth step"),
          number_column("exp(rate dt)", "growth factor")};
      std::set<std::string> known;
      for (const Record &record : results.records)
        for (const auto &[name, scalar] : record.scalars)
          if (name.rfind(study::spectral_radius_of, 0) == 0 && known.insert(name).second)
            columns.push_back(
                number_column(name.substr(std::string(study::spectral_radius_of).size()), name));
      return {"spectral-radii", "Growth in one time step on the largest strain",
              "For the fastest-growing wave at the largest X of the samples: its rate from the "
              "rule's own tangent, its growth exp(rate dt) in one step, and the spectral radius of "
              "one step of each of Time/schemes, with the longest of Time/steps or Time/critical "
              "fractions. Of implicit Euler it is (65) of Jha & Lipton 2018, "
              "doi:10.1137/17M1112236, |1 + rate dt| / |1 - (rate dt)^2|. A scheme whose radius is "
              "not above 1 hides the instability.",
              table_of(results, columns, has_radii)};
    }

    /// Growth rates over X of all methods in one direction of a series.
    DataChart strain_chart(const std::vector<const Record *> &records)
    {
      const analysis::Key &key = records.front()->key;
      std::vector<MethodName> methods;
      for (const Record *record : records)
        methods.push_back({record->key.method, record->key.family});
      DataChart chart =
          named("growth_" + slug(key.variant) + (key.series.empty() ? "" : "_") + slug(key.series),
                key.series + ", h = " + rounded(key.h) + ": " + key.variant + ", growth of waves");
      chart.caption = chart.plot.title;
      chart.plot.x_label = "X = β ε g² [1]";
      chart.plot.y_label = "growth rate [1/time]";
      chart.plot.is_x_log = chart.plot.is_y_log = false;
      chart.plot.frontier_label = "symbol";
      chart.data.columns = {"method"};
      for (const analysis::Column &column : records.front()->curves.at("growth"))
        chart.data.columns.emplace_back(column.name);
      const double local_at = (*records.front())["criterion (64)"];
      Line criterion{"criterion (64)", {"#444444", 3, true}, 1.4, {{local_at, 0}}};
      if (records.front()->has("first wave of the torus"))
        chart.plot.frontier.push_back({(*records.front())["first wave of the torus"], 0});
      for (const Record *record : records)
      {
        const analysis::Curve &growth = record->curves.at("growth");
        const auto &x = growth[0].values, &symbol = growth[4].values, &local = growth[5].values,
                   &observed = growth[7].values;
        Line line{record->key.method, style_of(methods, record->key.method), 1.2, {}};
        for (std::size_t i = 0; i < x.size(); ++i)
        {
          line.points.push_back({x[i], observed[i]});
          chart.data.rows.push_back({text_cell(record->key.method)});
          for (const analysis::Column &column : growth)
            chart.data.rows.back().push_back(number_cell(column.values[i]));
          if (record != records.front())
            continue;
          if (symbol[i] > 0)
            chart.plot.frontier.push_back({x[i], symbol[i]});
          if (x[i] > local_at)
            criterion.points.push_back({x[i], local[i]});
        }
        if (!line.points.empty())
          chart.plot.lines.push_back(line);
      }
      const auto &x = records.front()->curves.at("growth")[0].values;
      const double end = x.empty() ? 0 : x.back();
      for (double tick = 0; tick <= end; tick += end < 2 ? .25 : end < 4 ? .5 : 1)
        chart.plot.x_ticks.push_back(tick);
      chart.plot.lines.push_back(criterion);
      return chart;
    }

    std::vector<DataChart> strain_charts(const StudyResults &results)
    {
      std::vector<std::vector<const Record *>> groups; // by series and direction
      for (const Record &record : results.records)
      {
        if (!has_growth(record))
          continue;
        const auto same = std::find_if(groups.begin(), groups.end(),
                                       [&](const auto &group)
                                       {
                                         const analysis::Key &key = group.front()->key;
                                         return key.series == record.key.series &&
                                                key.variant == record.key.variant;
                                       });
        (same == groups.end() ? *groups.insert(groups.end(), {{}}) : *same).push_back(&record);
      }
      std::vector<DataChart> charts;
      for (const auto &group : groups)
        charts.push_back(strain_chart(group));
      return charts;
    }

    std::vector<DataChart> measure_charts(const StudyResults &results)
    {
      const ChartView views[] = {
          {"coercivity", "smallest eigenvalue of the symmetric part", "coercivity constant [b / u]",
           [](const Record &record) // of zero modes it is round-off
           {
             const double smallest = record["smallest eigenvalue"];
             return is_definite(record) ? smallest : std::min(smallest, 0.);
           }},
          {"inverse", "largest |u| under loads of size 1", "|A⁻¹| [u / b]",
           [](const Record &record) { return record["inverse norm"]; },
           [](const Record &record) { return is_m_matrix(record) ? record["barrier"] : 0; },
           "barriers (M-matrices)"},
          {"largest", "largest eigenvalue of the symmetric part", "largest eigenvalue [b / u]",
           [](const Record &record) { return record["largest eigenvalue"]; }}};
      std::vector<DataChart> charts;
      for (const ChartView &view : views)
        for (DataChart &chart : charts_of(view, results, is_operator))
          charts.push_back(std::move(chart));
      return charts;
    }

    /// One field of one operator.
    struct ModePanel
    {
      std::string title;
      const PointField *mode;
    };

    double size_at(const PointField &mode, std::size_t node)
    {
      const double *const u = &mode.values[node * mode.n_components];
      return mode.n_components == 1 ? std::abs(u[0]) : std::hypot(u[0], u[1]);
    }

    /// x, y, the field over its largest size there: a value, or a size and an arrow.
    std::string data(const PointField &mode, double arrow)
    {
      std::size_t at = 0;
      for (std::size_t i = 0; i < mode.points.size(); ++i)
        at = size_at(mode, i) > size_at(mode, at) ? i : at;
      // with a sign that makes the largest value positive
      const double largest = size_at(mode, at),
                   sign = mode.values[at * mode.n_components] < 0 ? -1 : 1,
                   scale = largest > 0 ? sign / largest : 0;
      std::ostringstream out;
      out.precision(5);
      for (std::size_t i = 0; i < mode.points.size(); ++i)
      {
        out << mode.points[i][0] << " " << mode.points[i][1] << " ";
        if (mode.n_components == 1)
          out << scale * mode.values[i] << "\n";
        else
          out << std::abs(scale) * size_at(mode, i) << " " << arrow * scale * mode.values[2 * i]
              << " " << arrow * scale * mode.values[2 * i + 1] << "\n";
      }
      return out.str();
    }

    std::string script(const std::string &name, const std::string &title,
                       const std::vector<ModePanel> &modes)
    {
      constexpr double arrow_in_spacings = 1.3;
      const bool is_vector = modes.front().mode->n_components > 1;
      std::array<double, 2> lower, upper;
      for (unsigned int d = 0; d < 2; ++d)
      {
        lower[d] = upper[d] = modes.front().mode->points[0][d];
        for (const ModePanel &panel : modes)
          for (const auto &node : panel.mode->points)
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
      const std::size_t n = modes.size();
      const SmallMultiples panels(n, n <= 4 ? std::min<std::size_t>(n, 2) : 3, lower, upper);
      std::ostringstream out, plots;
      out << "\nreset\n";
      for (std::size_t i = 0; i < n; ++i)
      {
        const PointField &mode = *modes[i].mode;
        const double spacing = std::sqrt((upper[0] - lower[0]) * (upper[1] - lower[1]) /
                                         static_cast<double>(mode.points.size()));
        const double pixels = spacing / (upper[0] - lower[0]) * panels.panel_width();
        out << "$p" << i << " << EOD\n" << data(mode, arrow_in_spacings * spacing) << "EOD\n";
        plots << panels.panel(i, modes[i].title) << "plot $p" << i;
        if (is_vector)
          plots << " using ($1-.5*$4):($2-.5*$5):4:5:3 with vectors head filled size graph "
                << .35 * pixels / panels.panel_width() << ",24 lw 1.2 lc palette notitle";
        else
          plots << " using 1:2:3 with points pt 7 ps " << .12 * pixels << " lc palette notitle";
        plots << "\n" << SmallMultiples::next();
      }
      out << panels.begin(name + ".svg", title,
                          is_vector ? "|mode| over its largest" : "mode over its largest")
          << "set palette defined ("
          << (is_vector ? "0 '#c9d3dd', .5 '#4a9cc9', 1 '#00365c'"
                        : "-1 '#2166ac', -.5 '#92c5de', 0 '#dcdcdc', .5 '#f4a582', 1 '#b2182b'")
          << ")\nset cbrange [" << (is_vector ? 0 : -1) << ":1]\nset cbtics .5\n"
          << plots.str() << SmallMultiples::end();
      return out.str();
    }

    /// The level of a method and series to draw modes of; nullptr: none.
    const Record *drawn_level(const StudyResults &results, const std::string &method,
                              const std::string &series)
    {
      constexpr std::size_t most_nodes = 1600;
      const Record *chosen = nullptr;
      for (const Record &record : results.records) // coarse to fine
        if (record.key.method == method && record.key.series == series && is_operator(record) &&
            record.fields.count("mode 1") > 0 && record.fields.at("mode 1").z.empty() &&
            (chosen == nullptr || record.fields.at("mode 1").points.size() <= most_nodes))
          chosen = &record;
      return chosen;
    }

    std::vector<Picture> mode_pictures(const StudyResults &results)
    {
      std::vector<Picture> lowest, zero;
      for (const std::string &series : series_of(results))
      {
        const std::string suffix = series.empty() ? "" : "_" + slug(series),
                          head = series.empty() ? "" : series + ": ";
        std::vector<ModePanel> panels;
        for (const MethodName &method : methods_of(results, is_operator))
        {
          const Record *const record = drawn_level(results, method.name, series);
          if (record == nullptr)
            continue;
          const double h = record->key.h;
          if (record->count("zero modes") == 0)
          {
            const bool is_finest = std::none_of(
                results.records.begin(), results.records.end(),
                [&](const Record &r) { return r.key.is_same_series(record->key) && r.key.h < h; });
            panels.push_back({method.name + ": λ = " + rounded((*record)["smallest eigenvalue"]) +
                                  (is_finest ? "" : ", h = " + rounded(h)),
                              &record->fields.at("mode 1")});
            continue;
          }
          std::vector<ModePanel> own;
          for (std::size_t i = 1; record->fields.count("mode " + std::to_string(i)) > 0; ++i)
            own.push_back({std::to_string(i), &record->fields.at("mode " + std::to_string(i))});
          const std::string name = "zero-modes_" + slug(method.name) + suffix,
                            title = head + method.name + ", h = " + rounded(h) + ": " +
                                    study::zero_modes(*record) + " zero-energy modes";
          zero.push_back({name, title, script(name, title, own)});
        }
        const std::string name = "lowest-modes" + suffix,
                          title = head + "modes of the smallest eigenvalue λ";
        if (!panels.empty())
          lowest.push_back({name, title, script(name, title, panels)});
      }
      lowest.insert(lowest.end(), zero.begin(), zero.end());
      return lowest;
    }
  } // namespace

  View stability_view(const StudyResults &results)
  {
    View view{"Stability"};
    view.words =
        "stable: the symmetric part is positive definite at all levels with a constant that does "
        "not "
        "fall, no weight is negative, moments are independent, and bonds tie all nodes. "
        "conditionally stable: under the condition given. unstable: no condition on m = δ/h helps.";
    view.verdicts = verdict_table(results);
    view.facts = {counted(results.verdicts.size(), "method"),
                  counted(static_cast<std::size_t>(std::count_if(
                              results.records.begin(), results.records.end(),
                              [](const Record &record) { return record.key.variant.empty(); })),
                          "operator")};
    view.parts = {
        measures(results),
        eigenvalues(results),
        time_steps(results),
        strain_thresholds(results),
        spectral_radii(results),
        {"powers", "Over the sweep",
         "The powers of h, or of the horizon where h is fixed, that the measures follow at "
         "the finest three levels: 0 is bounded, -2 grows fourfold as it is halved.",
         power_table(results)},
        failures(results, "Levels without an operator", "no operator, because",
                 [](const Record &record) { return record.key.variant.empty(); })};
    view.galleries = {
        {"charts", "Measures over the sweep",
         "Levels where a value is not positive, or not known, have no point.",
         measure_charts(results)},
        {"strain-charts", "Waves on uniform strains", "", strain_charts(results)},
        {"modes",
         "Modes",
         "The field that costs the least energy, or all that cost none (any basis of them), at the "
         "finest level with at most 1600 nodes. Smooth and spread over the domain is as it should "
         "be; what changes from node to node, or sits at a few nodes, is the method's own.",
         {},
         mode_pictures(results),
         "The finest level: stability/*.vtu"}};
    return view;
  }
} // namespace plumbline::report
