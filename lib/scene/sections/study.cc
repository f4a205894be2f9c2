#include "base/error.h"
#include "physics/expression.h"
#include "scene/keys.h"
#include "scene/study_sections.h"
#include "scene/values.h"

namespace plumbline::scene
{
  using physics::split_outside_brackets;

  namespace
  {
    std::vector<Norm> to_norms(const std::string &text)
    {
      std::vector<Norm> norms;
      for (const std::string &name : to_names(text))
      {
        const auto norm = base::from_word<Norm>(name);
        if (!norm)
          throw InputError("'" + name +
                           "' is not a norm; choose from nodal Linf, nodal L2, averages Linf, "
                           "averages L2, field Linf, field L2");
        norms.push_back(*norm);
      }
      return norms;
    }

    DecisiveError to_decisive_error(const std::string &text)
    {
      const auto parts = split_outside_brackets(text, '|');
      const auto norm = base::from_word<Norm>(parts[0]);
      const auto target = base::from_word<Target>(parts.back());
      if (parts.size() != 2 || !norm || !target)
        throw InputError("'" + text +
                         "' must be 'norm | target' with a norm of Study/norms (add it there) and "
                         "a target, one of exact, local, reference, own finest level");
      return {*norm, *target};
    }

    /// One series for each value held fixed.
    template <class MakeLevel>
    std::vector<Series> make_series(const std::string &fixed, const std::vector<double> &values,
                                    const std::vector<double> &refined, const MakeLevel &level)
    {
      std::vector<Series> series;
      for (const double value : values)
      {
        series.push_back({fixed + " = " + short_number(value), {}});
        for (const double one : refined)
          series.back().levels.push_back(level(value, one));
      }
      return series;
    }

    Series h_and_m(const std::vector<double> &h, const std::vector<double> &m)
    {
      if (h.size() != m.size())
        throw InputError("Study/m has " + std::to_string(m.size()) + " values and Study/h has " +
                         std::to_string(h.size()) +
                         "; with regime = delta-m give one m for each h");
      Series series{"h and m = " + short_number(m.front()) + " to " + short_number(m.back()), {}};
      for (std::size_t i = 0; i < h.size(); ++i)
        series.levels.push_back({h[i], m[i] * h[i]});
      return series;
    }
  } // namespace

  void StudySection::declare(Keys &keys)
  {
    keys.add("regime", regime,
             "m: horizon fixed, h to 0. delta: m = horizon / h fixed, h to 0 (decides asymptotic "
             "compatibility). delta-m: pairs of h and m. horizon: h fixed, horizon varies. "
             "variable: h and m fixed, Study/variable varies.");
    keys.add("h", h, positive_numbers(),
             "Mesh sizes, separated by ',', coarse to fine; fractions as 1/12 are numbers too. "
             "[length]");
    keys.add("m", m, positive_numbers(),
             "Ratios horizon / h, real numbers >= 1 (delta, delta-m, variable).");
    keys.add("horizon", horizon, positive_numbers(), "Horizons (m, horizon). [length]");
    keys.add("variable", variable,
             "Name of one of Random/variables, which can replace any number of the scene: in "
             "expressions, or in other keys by Random/keys, e.g. 'Time/steps: dt'.");
    keys.add("values", values, numbers(),
             "Values of Study/variable, separated by ',', increasing.");
    keys.add(
        "norms", "nodal Linf, averages L2, field L2", any_text(),
        [this](const std::string &text) { norms = to_norms(text); },
        "Error norms, separated by ',': nodal Linf, nodal L2 (at the method's own nodes with equal "
        "weights: sqrt(area * mean e^2)), averages Linf, averages L2 (cell averages of the "
        "solution, weighted by area), field Linf, field L2 (of the function), truncation Linf, "
        "truncation L2 (of meshfree rules: the residual of their equations for the exact or "
        "local solution, in units of the load), bound Linf, bound L2 (of meshfree rules: the "
        "largest truncation error times the inf-norm of A^-1, and the L2 norm of the truncation "
        "error divided by the smallest eigenvalue of the symmetric part of A: bounds on the nodal "
        "error), energy (sqrt(a(e, e)) of the nodal error e, with the method's own bilinear form "
        "a; the energies of solutions are recorded with it).");
    keys.add(
        "decisive error", decisive_error.text(), any_text(),
        [this](const std::string &text) { decisive_error = to_decisive_error(text); },
        "The error that decides the verdicts, as 'norm | target'. Targets: exact, local, "
        "reference, own finest level (self-convergence in cell averages, for scenes without "
        "another target; each level should halve h, so that cells are nested).");
  }

  void StudySection::complete()
  {
    if (h.empty() || m.empty() || horizon.empty())
      throw InputError("Study/h, Study/m and Study/horizon need at least one value each");
    switch (regime)
    {
    case Regime::m:
      series = make_series("delta", horizon, h,
                           [](double delta, double size) {
                             return Level{size, delta};
                           });
      break;
    case Regime::delta:
      series = make_series("m", m, h,
                           [](double ratio, double size) {
                             return Level{size, ratio * size};
                           });
      break;
    case Regime::delta_m:
      series = {h_and_m(h, m)};
      break;
    case Regime::horizon:
      series = make_series("h", h, horizon,
                           [](double size, double delta) {
                             return Level{size, delta};
                           });
      break;
    case Regime::variable:
      series.clear();
      for (const double size : h)
        for (Series &of_m : make_series("h = " + short_number(size) + ", m", m, values,
                                        [size](double ratio, double value) {
                                          return Level{size, ratio * size, value};
                                        }))
          series.push_back(std::move(of_m));
      break;
    }
  }
} // namespace plumbline::scene
