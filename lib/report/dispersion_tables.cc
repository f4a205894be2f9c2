#include "report/dispersion_tables.h"

#include "report/text_table.h"

#include <algorithm>
#include <cmath>

namespace plumbline::report
{
  const char *const long_waves_words =
      "Errors of the phase speed as the wave number tends to 0, relative to the local limit's, in "
      "directions from the first axis: L waves move along their direction, T waves across it. They "
      "are the defects of the second moments, and stay as h and horizon go to 0 together. "
      "anisotropy: the speed along an axis less that along the diagonal, over the local limit's.";

  const char *const wave_levels_words =
      "local, nonlocal: the worst relative error of the longest wave's phase speed over all "
      "directions, against the local limit and against the nonlocal operator. largest: of the "
      "symbol over all waves that the lattice carries, over Time/density [1/time^2]; critical "
      "step: 2 over "
      "its root, of central differences (velocity Verlet), and in steps in which the fastest local "
      "wave crosses h. lumped: the mass matrix made diagonal.";

  Table wave_verdicts_table(const study::DispersionResults &results)
  {
    Table table;
    table.columns = {"method", "series", "by waves", "proven", "last error", "rate", "explanation"};
    for (const study::Trend &t : results.trends)
    {
      const bool is_judged = t.values.size() > 1 && t.outcome != study::Outcome::failed;
      table.rows.push_back(
          {text_cell(t.method), text_cell(t.series), text_cell(t.verdict),
           known(!in_a_word(t.proof).empty(), text_cell(in_a_word(t.proof))),
           known(!t.values.empty(), error_cell(t.values.empty() ? 0 : t.values.back())),
           known(is_judged && !t.rates.empty(), rate_cell(t.rates.empty() ? 0 : t.rates.back())),
           text_cell(t.reason + (t.proof.reason.empty() ? "" : "; proof: " + t.proof.reason))});
    }
    return without_empty_columns(table);
  }

  Table long_waves_table(const study::DispersionResults &results)
  {
    Table table;
    table.columns = {"method", "series", "h", results.variable};
    const auto finest = finest_rows(results);
    if (finest.empty())
      return table;
    const auto names =
        physics::polarisations(finest[0]->anisotropy.size() == 1 ? physics::Structure::scalar
                                                                 : physics::Structure::tensor);
    for (const study::WaveCurve &curve : finest[0]->curves)
      table.columns.emplace_back(title(curve));
    for (const auto polarisation : names)
      table.columns.emplace_back("anisotropy" +
                                 (names.size() == 1 ? "" : " " + name(polarisation)));
    for (const study::DispersionRow *row : finest)
    {
      table.rows.push_back({text_cell(row->method), text_cell(row->series), number_cell(row->h),
                            variable_cell(results, *row)});
      for (const study::WaveCurve &curve : row->curves)
        table.rows.back().push_back(error_cell(curve.long_wave_error));
      for (const double difference : row->anisotropy)
        table.rows.back().push_back(error_cell(difference));
    }
    return without_empty_columns(table);
  }

  Table wave_levels_table(const study::DispersionResults &results)
  {
    Table table;
    table.columns = {"method",  "m",        "h",       results.variable,
                     "local",   "nonlocal", "largest", "critical step",
                     "step c/h"};
    for (const study::DispersionRow &row : results.rows)
    {
      if (!row.failure.empty())
        continue;
      const double fastest =
          std::max_element(row.curves.begin(), row.curves.end(),
                           [](const study::WaveCurve &a, const study::WaveCurve &b)
                           { return a.local_speed < b.local_speed; })
              ->local_speed;
      table.rows.push_back({text_cell(row.method), number_cell(row.m()), number_cell(row.h),
                            variable_cell(results, row), error_cell(row.worst_local_error()),
                            error_cell(row.worst_nonlocal_error()), number_cell(row.range.largest),
                            number_cell(row.critical_step()),
                            number_cell(row.critical_step() * fastest / row.h)});
    }
    return without_empty_columns(table);
  }

  Table missing_waves_table(const study::DispersionResults &results)
  {
    Table table;
    table.columns = {"method", "m", "h", results.variable, "no waves, because"};
    for (const study::DispersionRow &row : results.rows)
      if (!row.failure.empty())
        table.rows.push_back({text_cell(row.method), number_cell(row.m()), number_cell(row.h),
                              variable_cell(results, row), text_cell(row.failure)});
    return without_empty_columns(table);
  }

  std::string in_a_word(const study::LimitProof &proof)
  {
    using Answer = study::LimitProof::Answer;
    return proof.answer == Answer::compatible     ? "AC"
           : proof.answer == Answer::incompatible ? "not AC"
                                                  : "";
  }

  std::string title(const study::WaveCurve &curve)
  {
    const std::string way = name(curve.polarisation);
    return way + (way.empty() ? "" : ", ") + rounded(curve.angle) + "°";
  }

  std::vector<const study::DispersionRow *> finest_rows(const study::DispersionResults &results)
  {
    std::vector<const study::DispersionRow *> finest;
    for (const study::DispersionRow &row : results.rows)
      if (row.failure.empty())
      {
        const auto same =
            std::find_if(finest.begin(), finest.end(),
                         [&](const study::DispersionRow *other)
                         { return other->method == row.method && other->series == row.series; });
        if (same == finest.end())
          finest.push_back(&row);
        else
          *same = &row; // coarse to fine
      }
    return finest;
  }
} // namespace plumbline::report
