#include "report/counted.h"
#include "report/text_table.h"
#include "report/view.h"
#include "study/study_results.h"
#include "study/trend.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::report
{
  namespace
  {
    using analysis::Curve;

    bool is_there(const Record &record)
    {
      return record.failure.empty();
    }

    std::string in_a_word(const study::LimitProof &proof)
    {
      using Answer = study::LimitProof::Answer;
      return proof.answer == Answer::compatible     ? "AC"
             : proof.answer == Answer::incompatible ? "not AC"
                                                    : "";
    }

    const char *rating(const study::Trend &trend)
    {
      return trend.outcome == study::Outcome::converges   ? "converges"
             : trend.outcome == study::Outcome::undecided ? "undecided"
                                                          : "stalls";
    }

    Table verdicts(const StudyResults &results)
    {
      Table table;
      table.columns = {"method",     "series", "verdict",    "proven",
                       "last error", "rate",   "explanation"};
      for (const study::Trend &t : results.trends)
      {
        const bool is_judged = t.outcome != study::Outcome::failed;
        table.rows.push_back(
            {text_cell(t.method), text_cell(t.series), text_cell(t.verdict),
             known(!in_a_word(t.proof).empty(), text_cell(in_a_word(t.proof))),
             known(!t.values.empty(), error_cell(t.values.empty() ? 0 : t.values.back())),
             known(is_judged, rate_cell(study::last_rate(t))),
             text_cell(t.reason + (t.proof.reason.empty() ? "" : "; proof: " + t.proof.reason))});
        table.rows.back()[2].look = rating(t);
      }
      return without_empty_columns(table);
    }

    /// The names of scalars that end so, without the end.
    std::vector<std::string> waves_with(const StudyResults &results, const std::string &end)
    {
      std::vector<std::string> found;
      for (const Record &record : results.records)
        for (const auto &[name, scalar] : record.scalars)
          if (name.size() > end.size() &&
              name.compare(name.size() - end.size(), end.size(), end) == 0)
            if (const std::string waves = name.substr(0, name.size() - end.size());
                std::find(found.begin(), found.end(), waves) == found.end())
              found.push_back(waves);
      return found;
    }

    Part long_waves(const StudyResults &results)
    {
      const auto finest = study::finest_records(results);
      std::vector<RecordColumn> columns;
      for (const std::string &waves : waves_with(results, ": error of long waves"))
        columns.push_back(error_column(waves, waves + ": error of long waves"));
      for (const char *const name :
           {"anisotropy", "anisotropy L", "anisotropy T", "anisotropy T1", "anisotropy T2"})
        columns.push_back(error_column(name, name));
      return {
          "long", "Long waves",
          "Errors of the phase speed as the wave number tends to 0, relative to the phase speed "
          "of the local limit. L waves are polarised along their direction, T waves perpendicular "
          "to it "
          "(in three dimensions, T1 also perpendicular to the third axis, and T2 perpendicular "
          "to T1). These errors are the defects of the second moments, and do not vanish as h "
          "and the horizon tend to 0 together. anisotropy: the speed along an axis minus that "
          "along the diagonal (in three dimensions, the face or space diagonal, whichever "
          "differs more), relative to the speed of the local limit.",
          table_of(results, with_place(results, columns),
                   [&](const Record &record)
                   { return std::find(finest.begin(), finest.end(), &record) != finest.end(); })};
    }

    Part levels(const StudyResults &results)
    {
      return {
          "levels", "Over the sweep",
          "local, nonlocal: the relative error of the longest wave's phase speed in the worst "
          "direction, against the local limit and against the nonlocal operator. largest: the "
          "largest value of the symbol over all wave numbers of the lattice, divided by "
          "Time/density [1/time^2]. critical step: 2 / sqrt(largest), the critical time step of "
          "central differences (velocity Verlet); step c/h: the same, relative to the time in "
          "which the fastest wave of the local limit crosses h. lumped: with the mass matrix made "
          "diagonal.",
          table_of(results,
                   with_place(results,
                              {error_column("local", "error against the local limit"),
                               error_column("nonlocal", "error against the nonlocal operator"),
                               number_column("largest", "largest squared frequency"),
                               number_column("critical step", "critical step"),
                               number_column("step c/h", "critical step, of the time in which a "
                                                         "wave crosses h")}),
                   is_there)};
    }

    /// Speeds over the wavelength of all methods at the finest level of a series.
    /// @param which  "phase" or "group"
    DataChart speeds(const std::vector<const Record *> &finest,
                     const std::vector<MethodName> &methods, const std::string &waves,
                     const std::string &which)
    {
      const std::string &series = finest.front()->key.series, speed = which + " speed";
      DataChart chart =
          named(which + (series.empty() ? "" : "_" + slug(series)) + "_" + slug(waves),
                series + ", " + waves + ": " + speed);
      Plot &plot = chart.plot;
      plot.is_y_log = false;
      plot.x_label = "wavelength [h]";
      plot.y_label = speed + ", relative to the local limit";
      plot.x_ticks = {2, 3, 5, 10, 20, 50, 100, 200};
      plot.frontier_label = "nonlocal";
      chart.data.columns = {"method", "series", "h", "wavelength over h", which, "nonlocal"};
      Range range{std::numeric_limits<double>::max(), 1};
      for (const Record *record : finest)
      {
        const Curve &curve = record->curves.at(waves);
        const double h = record->key.h, local = (*record)[waves + ": local speed"];
        const std::size_t at = which.front() == 'p' ? 1 : 2; // phase, group
        Line line{record->key.label(), style_of(methods, record->key.label()), 1.8, {}, 8};
        for (std::size_t i = 0; i < curve[0].values.size(); ++i)
        {
          const double x = 2 * M_PI / (curve[0].values[i] * h), y = curve[at].values[i] / local,
                       exact = curve[at + 2].values[i] / local;
          chart.data.rows.push_back({text_cell(record->key.label()), text_cell(series),
                                     number_cell(h), number_cell(x), number_cell(y),
                                     number_cell(exact)});
          if (record == finest.front() && std::isfinite(exact))
            plot.frontier.push_back({x, exact});
          if (std::isfinite(y))
            line.points.push_back({x, y});
          for (const double v : {y, exact})
            if (std::isfinite(v))
              range = {std::min(range.low, v), std::max(range.high, v)};
        }
        plot.lines.push_back(line);
      }
      const double margin = .05 * (range.high - std::min(range.low, 1.));
      plot.y_range = Range{range.low - margin, range.high + margin};
      return chart;
    }

    /// Shows differences of phase speeds whose curves coincide in the chart of speeds.
    DataChart deviations(const std::vector<const Record *> &finest,
                         const std::vector<MethodName> &methods, const std::string &waves)
    {
      const std::string &series = finest.front()->key.series;
      DataChart chart =
          named("deviation" + (series.empty() ? "" : "_" + slug(series)) + "_" + slug(waves),
                series + ", " + waves + ": deviation from the nonlocal operator");
      Plot &plot = chart.plot;
      plot.x_label = "wavelength [h]";
      plot.y_label = "|c/c(nonlocal) - 1| of the phase speed [1]";
      plot.x_ticks = {2, 3, 5, 10, 20, 50, 100, 200};
      plot.shows_round_off = true;
      chart.data.columns = {"method", "series", "h", "wavelength over h", "deviation"};
      for (const Record *record : finest)
      {
        const Curve &curve = record->curves.at(waves);
        const double h = record->key.h;
        Line line{record->key.label(), style_of(methods, record->key.label()), 1.8, {}, 8};
        for (std::size_t i = 0; i < curve[0].values.size(); ++i)
        {
          const double x = 2 * M_PI / (curve[0].values[i] * h),
                       y = std::abs(curve[1].values[i] / curve[3].values[i] - 1);
          if (!std::isfinite(y))
            continue;
          chart.data.rows.push_back({text_cell(record->key.label()), text_cell(series),
                                     number_cell(h), number_cell(x), error_cell(y)});
          if (y > 0)
            line.points.push_back({x, y});
        }
        plot.lines.push_back(line);
      }
      return chart;
    }

    std::vector<DataChart> charts(const StudyResults &results)
    {
      std::vector<DataChart> all = charts_of(
          {"errors",
           "error of the longest wave's phase speed",
           "|c/c(nonlocal) - 1|, worst direction [1]",
           [](const Record &record) { return record["error against the nonlocal operator"]; },
           {},
           "",
           true},
          results, is_there);
      const auto methods = methods_of(results, is_there);
      const std::vector<std::string> waves = waves_with(results, ": local speed");
      const std::string &first = results.facts.at("first direction");
      for (const std::string &series : series_of(results))
        for (const char *const which : {"phase", "group"})
          for (const std::string &one : waves)
          {
            std::vector<const Record *> finest;
            for (const Record *record : study::finest_records(results))
              if (record->key.series == series && record->curves.count(one) > 0)
                finest.push_back(record);
            const bool is_first = one.find(first) != std::string::npos;
            if (finest.empty())
              continue;
            if (which[0] == 'p' || is_first)
              all.push_back(speeds(finest, methods, one, which));
            if (which[0] == 'p' && is_first)
              all.push_back(deviations(finest, methods, one));
          }
      return all;
    }
  } // namespace

  View dispersion_view(const StudyResults &results)
  {
    View view{"Dispersion"};
    view.question =
        "Does the phase speed of the longest wave that fits into the domain (wavelength " +
        results.facts.at("longest wave") +
        ") converge to that of the nonlocal operator in every direction? The errors are those of "
        "the worst direction. As the horizon tends to 0, the phase speed of the nonlocal operator "
        "tends to that of the local limit. Proven: for rules, by the second moments of the "
        "stencil; for Galerkin methods, because their space contains the continuous piecewise "
        "linear functions.";
    view.verdicts = verdicts(results);
    view.facts = {counted(results.records.size(), "run")};
    for (const auto &[sign, word, outcome] : {std::tuple("✓ ", " converge", "converges"),
                                              {"? ", " undecided", "undecided"},
                                              {"✗ ", " do not converge", "stalls"}})
      view.facts.push_back(
          sign +
          std::to_string(std::count_if(results.trends.begin(), results.trends.end(),
                                       [&, name = std::string(outcome)](const study::Trend &t)
                                       { return name == rating(t); })) +
          word);
    view.parts = {long_waves(results), levels(results),
                  failures(results, "Levels without results", "reason")};
    view.galleries = {
        {"charts", "Charts",
         "Phase and group speeds at the finest level of each series, relative to those of the "
         "local limit. At a fixed ratio of horizon to h these curves do not depend on h. As h "
         "tends to 0, a wave of a given length moves to the right along them; a method is "
         "asymptotically compatible if its curve tends to 1 there.",
         charts(results)}};
    return view;
  }
} // namespace plumbline::report
