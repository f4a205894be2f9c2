#include "report/sampling_page.h"

#include "report/text_table.h"

#include <algorithm>

namespace plumbline::report
{
  namespace
  {
    using study::CaseStatistics;
    using study::SamplingResults;
    using study::SetStatistics;

    Cell known_error(const std::optional<double> &value)
    {
      return value ? error_cell(*value) : empty_cell();
    }

    std::vector<Cell> names(const CaseStatistics &one)
    {
      return {text_cell(one.of.method), known(!one.of.problem.empty(), text_cell(one.of.problem)),
              text_cell(one.of.series), number_cell(one.of.h)};
    }

    Cell deviation_cell(const uq::Statistics &s)
    {
      if (!s.deviation())
        return text_cell("unknown: variance " + rounded(s.variance));
      Cell cell = number_cell(*s.deviation());
      if (is_constant(s) && *s.deviation() > 0)
        cell.text = "round-off";
      return cell;
    }

    /// Only where sets differ by them.
    Cell modes_cell(const SamplingResults &results, unsigned int n_modes)
    {
      return results.sampling.modes.empty() ? empty_cell() : count_cell(n_modes);
    }

    Cell rule_cell(const SamplingResults &results, uq::SampleRule rule)
    {
      return known(results.sampling.has_several_rules(), text_cell(base::word(rule)));
    }

    /// Found, and its bound: two CSV fields.
    Cell lebesgue_cell(const SetStatistics &set)
    {
      Cell cell = empty_cell();
      cell.csv = {"", ""};
      if (set.lebesgue && set.lebesgue_bound)
      {
        constexpr double one = 1e-6; // relative: they are the same
        cell.csv = {exact(*set.lebesgue), exact(*set.lebesgue_bound)};
        cell.text = *set.lebesgue_bound > (1 + one) * *set.lebesgue
                        ? rounded(*set.lebesgue) + " to " + rounded(*set.lebesgue_bound)
                        : rounded(*set.lebesgue);
      }
      return cell;
    }

    /// Of the mean, with 95 % confidence: two CSV fields.
    Cell interval_cell(const uq::Statistics &s)
    {
      Cell cell = empty_cell();
      cell.csv = {"", ""};
      if (s.confidence > 0)
      {
        const double from = s.mean - s.confidence, to = s.mean + s.confidence;
        cell.csv = {exact(from), exact(to)};
        cell.text = rounded(from) + " to " + rounded(to);
      }
      return cell;
    }
  } // namespace

  bool is_constant(const uq::Statistics &s)
  {
    return s.deviation() && *s.deviation() <= round_off * std::abs(s.mean);
  }

  Table sampling_field_table(const SamplingResults &results)
  {
    Table table;
    table.columns = {"method",
                     "problem",
                     "series",
                     "h",
                     "rule",
                     "modes",
                     "count",
                     "samples",
                     "missing",
                     "‖mean‖",
                     "‖deviation‖",
                     "error of the mean",
                     "error of the deviation",
                     "error of the interpolant",
                     Column("Lebesgue constant", {"Lebesgue constant", "its bound"}),
                     "standard error",
                     Column("‖w‖₂", {"noise"}),
                     "CPU seconds"};
    for (const CaseStatistics &one : results.cases)
      for (const SetStatistics &set : one.sets)
      {
        std::vector<Cell> row = names(one);
        const bool is_random = set.rule == uq::SampleRule::monte_carlo;
        const bool has_field =
            set.deviation_size || set.negative_part > 0; // else spectra are sampled
        for (const Cell &cell :
             {rule_cell(results, set.rule), modes_cell(results, set.n_modes), count_cell(set.count),
              count_cell(set.n_samples), known(set.n_missing > 0, count_cell(set.n_missing)),
              known(has_field, number_cell(set.mean_size)),
              set.deviation_size ? number_cell(*set.deviation_size) : empty_cell(),
              known_error(set.mean_error), known_error(set.deviation_error),
              known_error(set.interpolation_error), lebesgue_cell(set),
              known(is_random, error_cell(set.standard_error)), number_cell(set.noise),
              number_cell(set.seconds)})
          row.push_back(cell);
        table.rows.push_back(std::move(row));
      }
    return without_empty_columns(table);
  }

  Table sampling_quantity_table(const SamplingResults &results)
  {
    Table table;
    table.columns = {"method",
                     "problem",
                     "series",
                     "h",
                     "quantity",
                     "rule",
                     "modes",
                     "count",
                     "samples",
                     "mean",
                     "deviation",
                     "standard error",
                     Column("mean, 95 %", {"mean from", "mean to"}),
                     Column("minimum", {"least"}),
                     Column("maximum", {"largest"})};
    for (const CaseStatistics &one : results.cases)
    {
      for (const SetStatistics &set : one.sets)
        for (const auto &[name, s] : set.quantities)
        {
          if (!one.is_finest)
            continue;
          std::vector<Cell> row = names(one);
          for (const Cell &cell :
               {text_cell(name), rule_cell(results, set.rule), modes_cell(results, set.n_modes),
                count_cell(set.count), count_cell(set.n_samples), number_cell(s.mean),
                deviation_cell(s), known(s.standard_error > 0, error_cell(s.standard_error)),
                interval_cell(s), number_cell(s.least), number_cell(s.largest)})
            row.push_back(cell);
          table.rows.push_back(std::move(row));
        }
    }
    return without_empty_columns(table);
  }

  Table sampling_cheapest_table(const SamplingResults &r)
  {
    Table table;
    table.columns = {"relative error of the mean <",
                     "method",
                     "problem",
                     "series",
                     "h",
                     "rule",
                     "modes",
                     "count",
                     "error",
                     "CPU seconds"};
    for (const study::CheapestPair &pair : r.cheapest)
      table.rows.push_back({text_cell(short_power(pair.target)), text_cell(pair.method),
                            known(!pair.problem.empty(), text_cell(pair.problem)),
                            text_cell(pair.series), number_cell(pair.h), rule_cell(r, pair.rule),
                            modes_cell(r, pair.n_modes), count_cell(pair.count),
                            error_cell(pair.error), number_cell(pair.seconds)});
    return without_empty_columns(table);
  }

  Table sampling_failure_table(const SamplingResults &r)
  {
    Table table;
    table.columns = {"sample", "values", "reason"};
    for (const study::SampleFailure &failure : r.failures)
    {
      std::string values;
      for (const double value : failure.values)
        values += (values.empty() ? "" : ", ") + rounded(value);
      table.rows.push_back(
          {count_cell(failure.sample), text_cell(values), text_cell(failure.reason)});
    }
    return table;
  }

  Table sampling_samples_table(const SamplingResults &results, const CaseStatistics &one,
                               std::size_t most_rows, std::size_t most_variables)
  {
    const std::size_t n_variables = std::min(most_variables, results.variables.size());
    Table table;
    table.columns = {"sample"};
    for (std::size_t d = 0; d < n_variables; ++d)
      table.columns.emplace_back(results.variables[d]);
    for (const auto &[name, values] : one.values)
      table.columns.emplace_back(name);
    for (std::size_t i = 0; i < std::min(most_rows, one.samples.size()); ++i)
    {
      std::vector<Cell> row = {count_cell(one.samples[i])};
      for (std::size_t d = 0; d < n_variables; ++d)
        row.push_back(number_cell(results.points[one.samples[i]][d]));
      for (const auto &[name, values] : one.values)
        row.push_back(values[i] ? number_cell(*values[i]) : empty_cell());
      table.rows.push_back(std::move(row));
    }
    return table;
  }
} // namespace plumbline::report
