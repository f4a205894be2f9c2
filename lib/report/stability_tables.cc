#include "report/stability_tables.h"

#include "report/text_table.h"

#include <cmath>

namespace plumbline::report
{
  const char *const measures_words =
      "smallest, largest: eigenvalues of the symmetric part in the discrete L2 inner product; the "
      "smallest is the coercivity constant. asymmetry: of A, relative to its largest entry. "
      "|A^-1|: how far u moves at most by a load of size 1; barrier: what the maximum principle "
      "bounds it by, of M-matrices. min weight: relative to its area. rank, singular: of the "
      "moments asked of a family, and the smallest singular value of their matrix scaled to norm "
      "1. degree: of polynomials that are mapped exactly, at inner nodes.";

  const char *const eigenvalues_words =
      "Of A itself in the discrete L2 inner product, where A is not symmetric; elsewhere they are "
      "those of the symmetric part. The imaginary part is the largest of those computed: the ones "
      "nearest to 0 and the outermost.";

  const char *const powers_words =
      "The powers of h, or of the horizon where h is fixed, that the measures follow at the finest "
      "three levels: 0 is bounded, -2 grows fourfold as it is halved.";

  Table measures_table(const study::StabilityResults &results)
  {
    Table table;
    table.columns = {"method",  "m",          "h",         results.variable, "unknowns", "smallest",
                     "largest", "zero modes", "asymmetry", "M-matrix",       "parts",    "|A^-1|",
                     "barrier", "min weight", "rank",      "singular",       "degree"};
    for (const study::StabilityRow &row : results.rows)
    {
      if (!row.failure.empty())
        continue;
      const study::Stability &s = row.stability;
      const method::Diagnostics &d = s.diagnostics;
      const study::Consistency &c = row.consistency;
      Cell norm = number_cell(s.inverse_norm);
      if (!s.is_norm_exact)
        norm.text = ">= " + norm.text;
      Cell zeros = count_cell(s.n_zero);
      zeros.text = s.zero_modes();
      const std::string rank = std::to_string(d.rank) + "/" + std::to_string(d.n_conditions);
      table.rows.push_back(
          {text_cell(row.method), number_cell(row.m()), number_cell(row.h),
           variable_cell(results, row), count_cell(s.n_unknowns), number_cell(s.smallest),
           number_cell(s.largest), zeros, known(s.has_signs, number_cell(s.signs.asymmetry)),
           known(s.has_signs, text_cell(s.signs.is_m_matrix() ? "yes" : "no")),
           known(s.has_signs, count_cell(s.signs.n_parts)), known(s.inverse_norm > 0, norm),
           known(c.barrier > 0 && s.signs.is_m_matrix(), number_cell(c.barrier)),
           known(d.n_neighbours > 0, number_cell(d.smallest_weight_ratio)),
           known(d.n_conditions > 0, text_cell(rank)),
           known(d.n_conditions > 0, number_cell(d.smallest_singular_value)),
           known(c.n_inner > 0, count_cell(c.degree))});
    }
    return without_empty_columns(table);
  }

  Table eigenvalues_table(const study::StabilityResults &results)
  {
    Table table;
    table.columns = {"method",
                     "m",
                     "h",
                     results.variable,
                     "least real part",
                     "least modulus",
                     "largest modulus",
                     "largest |imaginary part|"};
    for (const study::StabilityRow &row : results.rows)
    {
      const study::Stability &s = row.stability;
      const algebra::Eigenvalues &e = s.eigenvalues;
      const auto value = [&](double v) { return known(e.n_computed > 0, number_cell(v)); };
      if (row.failure.empty() && !s.is_symmetric())
        table.rows.push_back({text_cell(row.method), number_cell(row.m()), number_cell(row.h),
                              variable_cell(results, row), value(e.smallest_real),
                              value(e.smallest_modulus), value(e.largest_modulus),
                              value(e.largest_imaginary)});
    }
    return without_empty_columns(table);
  }

  const char *const time_steps_words =
      "dt: critical time step of central differences, 2 / sqrt(lambda / rho), with the largest "
      "eigenvalue lambda of the equations linearised at rest (double-well bonds on a lattice: over "
      "all waves of the infinite lattice); of Galerkin methods with the mass matrix, and with "
      "lumped masses. grows: some eigenvalues are complex or negative, so solutions grow with any "
      "time step.";

  Table time_steps_table(const study::StabilityResults &results)
  {
    Table table;
    table.columns = {"method",     "m",      "h",  results.variable,
                     "density",    "lambda", "dt", "lambda, lumped",
                     "dt, lumped", "grows"};
    for (const study::StabilityRow &row : results.rows)
    {
      const study::CriticalSteps &steps = row.steps;
      if (steps.largest > 0)
        table.rows.push_back({text_cell(row.method), number_cell(row.m()), number_cell(row.h),
                              variable_cell(results, row), number_cell(steps.density),
                              number_cell(steps.largest), number_cell(steps.own()),
                              known(steps.largest_lumped > 0, number_cell(steps.largest_lumped)),
                              known(steps.largest_lumped > 0, number_cell(steps.lumped())),
                              known(!steps.is_oscillating, text_cell("yes"))});
    }
    return without_empty_columns(table);
  }

  Table powers_table(const study::StabilityResults &results)
  {
    Table table;
    table.columns = {"method", "series", "powers of", "smallest", "largest", "|A^-1|"};
    const auto power = [](double value) { return known(std::isfinite(value), rate_cell(value)); };
    for (const study::StabilityTrend &t : results.trends)
      if (std::isfinite(t.smallest) || std::isfinite(t.largest) || std::isfinite(t.inverse_norm))
        table.rows.push_back({text_cell(t.method), text_cell(t.series),
                              text_cell(base::word(t.axis)), power(t.smallest), power(t.largest),
                              power(t.inverse_norm)});
    return without_empty_columns(table);
  }

  Table stability_verdicts_table(const study::StabilityResults &results)
  {
    Table table;
    table.columns = {"method", "verdict", "condition", "explanation"};
    for (const study::StabilityVerdict &v : results.verdicts)
      table.rows.push_back({text_cell(v.method), text_cell(base::word(v.verdict)),
                            text_cell(v.condition), text_cell(v.explanation)});
    return table;
  }

  Table missing_operators_table(const study::StabilityResults &results)
  {
    Table table;
    table.columns = {"method", "m", "h", results.variable, "no operator, because"};
    for (const study::StabilityRow &row : results.rows)
      if (!row.failure.empty())
        table.rows.push_back({text_cell(row.method), number_cell(row.m()), number_cell(row.h),
                              variable_cell(results, row), text_cell(row.failure)});
    return without_empty_columns(table);
  }
} // namespace plumbline::report
