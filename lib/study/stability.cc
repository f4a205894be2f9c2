#include "study/stability.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "method/discretisation.h"
#include "method/discretisation_in_space.h"
#include "scene/capabilities.h"
#include "study/preflight.h"
#include "study/solution_record.h"
#include "study/strain_growth.h"
#include "study/trend.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace plumbline::study
{
  namespace
  {
    std::string place(const Record &record, const std::string &variable)
    {
      const Key &key = record.key;
      return "m = " + base::to_text(key.m(), 4) + ", h = " + base::to_text(key.h, 4) +
             (variable.empty() ? "" : ", " + variable + " = " + base::to_text(key.value, 4));
    }

    bool is_sound(const Record &record)
    {
      return record.failure.empty() && is_definite(record);
    }

    /// What keeps a sound level from being good; empty: nothing.
    std::string doubt(const Record &record)
    {
      constexpr double rounding = 1e-12;
      const double ratio = record["smallest weight"];
      std::string text;
      const auto add = [&](bool is, const std::string &what)
      { text += is ? (text.empty() ? "" : ", ") + what : ""; };
      add(record.count("negative weights") > 0 && ratio < -rounding,
          std::to_string(record.count("negative weights")) + " negative weights, down to " +
              base::to_text(ratio, 4) + " of their area");
      add(record.count("moment rank") < record.count("moment conditions"),
          "moment conditions of rank " + std::to_string(record.count("moment rank")) + " of " +
              std::to_string(record.count("moment conditions")));
      add(record.count("parts") > 1,
          "bonds leave " + std::to_string(record.count("parts")) + " separate parts");
      return text;
    }

    bool is_good(const Record &record)
    {
      return is_sound(record) && doubt(record).empty();
    }

    std::string defect(const Record &record)
    {
      if (!record.failure.empty())
        return record.failure;
      if (record.count("zero modes") > 0)
        return zero_modes(record) + " zero-energy modes";
      if (!is_definite(record))
        return "the symmetric part is not positive definite, smallest eigenvalue " +
               base::to_text(record["smallest eigenvalue"], 4) + " of " +
               base::to_text(record["largest eigenvalue"], 4);
      return doubt(record);
    }

    /// The m from which on all levels are so and below which none is.
    std::optional<double> threshold(const Records &records,
                                    const std::function<bool(const Record &)> &is)
    {
      double lowest = std::numeric_limits<double>::infinity(), highest_not = 0;
      for (const Record &record : records)
        if (is(record))
          lowest = std::min(lowest, record.key.m());
        else
          highest_not = std::max(highest_not, record.key.m());
      if (std::isfinite(lowest) && lowest > highest_not * (1 + 1e-9))
        return lowest;
      return {};
    }

    /// The slope of log y over log x at the finest three levels that have a value.
    double power(const std::vector<double> &x, const std::vector<double> &y)
    {
      constexpr std::size_t n_levels = 3;
      constexpr double least_ratio = 2; // between sizes, for a trend
      std::vector<double> last_x, last_y;
      for (std::size_t i = x.size(); i-- > 0 && last_x.size() < n_levels;)
        if (y[i] > 0)
        {
          last_x.insert(last_x.begin(), x[i]);
          last_y.insert(last_y.begin(), y[i]);
        }
      if (last_x.size() < n_levels || last_x.front() < least_ratio * last_x.back())
        return std::numeric_limits<double>::quiet_NaN();
      return fit_slope(last_x, last_y).value;
    }
  } // namespace

  bool is_m_matrix(const Record &record)
  {
    return record.has("asymmetry") && record.count("rows with positive entries") == 0 &&
           record.count("rows not dominant") == 0 && record.count("rows not tied") == 0;
  }

  bool is_definite(const Record &record)
  {
    return record["smallest eigenvalue"] > 1e-10 * record["largest eigenvalue"];
  }

  std::string zero_modes(const Record &record)
  {
    const std::size_t n = record.count("zero modes");
    return std::to_string(n) + (n < algebra::most_zero_modes ? "" : " or more");
  }

  std::vector<Power> stability_powers(const Records &records)
  {
    std::vector<Power> powers;
    for (const Record &first : records)
    {
      if (std::any_of(powers.begin(), powers.end(),
                      [&](const Power &p)
                      { return p.method == first.key.method && p.series == first.key.series; }))
        continue;
      std::vector<double> h, horizon;
      std::map<std::string, std::vector<double>> values;
      for (const Record &record : records)
        if (record.key.is_same_series(first.key))
        {
          h.push_back(record.key.h);
          horizon.push_back(record.key.horizon);
          for (const char *const name :
               {"smallest eigenvalue", "largest eigenvalue", "inverse norm"})
            values[name].push_back(record[name]);
          if (!is_sound(record))
            values["smallest eigenvalue"].back() = 0;
        }
      Power result{first.key.method,
                   first.key.series,
                   h.front() == h.back() ? Axis::horizon : Axis::mesh_size,
                   {}};
      for (const auto &[name, y] : values)
        if (const double p = power(result.axis == Axis::horizon ? horizon : h, y); std::isfinite(p))
          result.of[name] = p;
      powers.push_back(result);
    }
    return powers;
  }

  Verdict judge_stability(const Records &records, const std::string &variable)
  {
    constexpr double most_decay = .5;
    Verdict result{records.front().key.method, "", "unstable", Rating::bad, "", ""};
    const auto first_not = [&](const auto &is)
    { return std::find_if_not(records.begin(), records.end(), is); };
    for (const Power &power : stability_powers(records))
      if (const auto found = power.of.find("smallest eigenvalue");
          found != power.of.end() && found->second > most_decay)
      {
        result.explanation = "the coercivity constant falls like " + base::word(power.axis) +
                             " to the power " + base::to_text(found->second, 4) + " in series " +
                             power.series;
        return result;
      }
    const Record *lowest = nullptr;
    for (const Record &record : records)
      if (is_sound(record) &&
          (lowest == nullptr || record["smallest eigenvalue"] < (*lowest)["smallest eigenvalue"]))
        lowest = &record;
    if (lowest == nullptr)
    {
      result.explanation = "no level is sound: " + defect(records.back());
      return result;
    }
    const std::string coercive = "coercive with " +
                                 base::to_text((*lowest)["smallest eigenvalue"], 4) +
                                 " or more (least at " + place(*lowest, variable) + ")";
    if (first_not(is_good) == records.end())
    {
      result.verdict = "stable";
      result.rating = Rating::good;
      result.explanation = coercive;
      return result;
    }
    result.verdict = "conditionally stable";
    result.rating = Rating::doubtful;
    for (const auto &is : {is_good, is_sound})
      if (const auto m = threshold(records, is))
      {
        const auto bad = first_not(is);
        result.condition =
            bad == records.end() ? "A stays positive definite" : "m >= " + base::to_text(*m, 4);
        const auto doubtful =
            std::find_if(records.begin(), records.end(),
                         [&](const Record &record) { return is(record) && !is_good(record); });
        result.explanation = coercive;
        if (bad != records.end())
          result.explanation += "; at " + place(*bad, variable) + " " + defect(*bad);
        if (doubtful != records.end())
          result.explanation += "; at " + place(*doubtful, variable) + " " + doubt(*doubtful);
        return result;
      }
    result.verdict = "unstable";
    result.rating = Rating::bad;
    const auto bad = first_not(is_sound);
    result.explanation = "at " + place(*bad, variable) + " " + defect(*bad) +
                         ", and no bound on m separates this "
                         "from levels where it is not so";
    return result;
  }

  namespace
  {
    /// Levels of operators, without waves on strains.
    Records operators(const Records &records, const std::string &method)
    {
      Records own;
      for (const Record &record : records)
        if (record.key.method == method && record.key.variant.empty())
          own.push_back(record);
      return own;
    }

    void conclude(const scene::Scene &scene, StudyResults &results)
    {
      Records all;
      for (std::size_t i = 0; i < results.records.size(); ++i)
        if (const std::string &method = results.records[i].key.method;
            i == 0 || results.records[i - 1].key.method != method)
        {
          const Records own = operators(results.records, method);
          results.verdicts.push_back(judge_stability(own, results.variable));
          all.insert(all.end(), own.begin(), own.end());
        }
      if (results.variable.empty()) // else no length varies, which powers would be of
        results.powers = stability_powers(all);
      for (const scene::Expected &expected : scene.expected.all)
        if (expected.kind == scene::ExpectedKind::stability)
        {
          const auto found =
              std::find_if(results.verdicts.begin(), results.verdicts.end(),
                           [&](const Verdict &v) { return v.method == expected.method; });
          const bool is_found = found != results.verdicts.end();
          results.expectations.push_back({expected.text, expected.verdict,
                                          is_found ? found->verdict : "no such method",
                                          is_found && found->verdict == expected.verdict});
        }
      for (Expectation &one : check_growth(scene, results.records))
        results.expectations.push_back(std::move(one));
    }

    auto discretise(const Method &method, const problem::Problem<2> &problem)
    {
      return method.discretise(problem, base::Communicator::alone());
    }

    auto discretise(const Method &method, const problem::Problem<3> &problem)
    {
      return method.discretise_in_space(problem);
    }

    method::DiscreteOperator operator_of(const method::Discretisation &discretisation,
                                         const problem::Problem<2> &)
    {
      return discretisation.matrix();
    }

    /// From the rows that every method in space has.
    /// @param problem  with a load of 1 for each component
    method::DiscreteOperatorOf<3> operator_of(const method::DiscretisationInSpace &discretisation,
                                              const problem::Problem<3> &problem)
    {
      const auto *able = dynamic_cast<const method::HasLinearEquations<3> *>(&discretisation);
      if (able == nullptr)
        return {};
      const method::Diagnostics of = discretisation.diagnostics();
      constexpr double bytes_of_entry = 40; // in whole rows, in those of free nodes, and solving
      base::require_memory(bytes_of_entry * static_cast<double>(discretisation.n_unknowns()) *
                               (of.n_neighbours + 1.) * problem.n_components,
                           "the rows of " + std::to_string(discretisation.n_unknowns()) +
                               " unknowns",
                           "choose a larger h or a smaller m (Study/h, Study/m), or run the first "
                           "levels only (--levels)");
      return method::discrete_operator(able->equations(problem));
    }

    template <int dim>
    Record measured(const Place &place, const Method &method, const problem::Problem<dim> &problem)
    {
      const auto discretisation = discretise(method, problem);
      const auto matrix = operator_of(*discretisation, problem);
      if (matrix.size() == 0)
        throw InputError("Methods/names: '" + method.name() +
                         "' shows no operator, so nothing can be measured; leave it out "
                         "(--methods)");
      Stability stability = analysis::measure(matrix);
      stability.diagnostics = discretisation->diagnostics();
      return stability_record(
          place.record("stability", method), stability,
          analysis::check_consistency(matrix, problem),
          critical_steps(*discretisation, problem, stability, place.scene().time.density));
    }

    Records analyse(const Place &place, const Method &method)
    {
      const scene::Scene &scene = place.scene();
      if (scene.domain.is_in_space())
      {
        const problem::Field<3> unit{[](const dealii::Point<3> &, unsigned int) { return 1.; }};
        return {measured(place, method,
                         scene::make_problem_in_space(scene, 0, place.level(), 0, &unit))};
      }
      const problem::Problem<2> &problem = place.problem();
      Records records = {measured(place, method, problem)};
      if (place.is_finest() && problem.double_well && problem.is_periodic())
        for (Record &record : strain_records(place, method, records.front()["critical step"]))
          records.push_back(std::move(record));
      return records;
    }
  } // namespace

  Record stability_record(Record record, const Stability &s, const Consistency &consistency,
                          const CriticalSteps &steps)
  {
    const auto set =
        [&](bool is_known, const std::string &name, double value, const std::string &unit = "")
    {
      if (is_known)
        record.set(name, value, unit);
    };
    record.cost.n_unknowns = s.n_unknowns;
    set(true, "unknowns", static_cast<double>(s.n_unknowns));
    set(true, "smallest eigenvalue", s.smallest, "b / u");
    set(true, "largest eigenvalue", s.largest, "b / u");
    set(true, "zero modes", s.n_zero);
    const algebra::Eigenvalues &e = s.eigenvalues;
    const bool has_own = e.n_computed > 0;
    set(has_own, "least real part", e.smallest_real, "b / u");
    set(has_own, "least modulus", e.smallest_modulus, "b / u");
    set(has_own, "largest modulus", e.largest_modulus, "b / u");
    set(has_own, "largest imaginary part", e.largest_imaginary, "b / u");
    set(s.has_signs, "asymmetry", s.signs.asymmetry);
    set(s.has_signs, "rows with positive entries", static_cast<double>(s.signs.n_positive));
    set(s.has_signs, "rows not dominant", static_cast<double>(s.signs.n_weak));
    set(s.has_signs, "rows not tied", static_cast<double>(s.signs.n_loose));
    set(s.has_signs, "parts", static_cast<double>(s.signs.n_parts));
    set(s.inverse_norm > 0, "inverse norm", s.inverse_norm, "u / b");
    set(s.inverse_norm > 0, "inverse norm is exact", s.is_norm_exact ? 1 : 0);
    set(consistency.barrier > 0, "barrier", consistency.barrier, "u / b");
    set(consistency.n_inner > 0, "inner nodes", static_cast<double>(consistency.n_inner));
    set(consistency.n_inner > 0, "exact degree", consistency.degree);
    set_weights(record, s.diagnostics);
    set(steps.largest > 0, "density", steps.density);
    set(steps.largest > 0, "largest eigenvalue in motion", steps.largest, "1/time^2");
    set(steps.largest > 0, "critical step", steps.own(), "time");
    set(steps.largest_lumped > 0, "largest eigenvalue in motion, lumped", steps.largest_lumped,
        "1/time^2");
    set(steps.largest_lumped > 0, "critical step, lumped", steps.lumped(), "time");
    set(steps.largest > 0, "grows", steps.is_oscillating ? 0 : 1);
    record.notes = s.diagnostics.notes;
    analysis::PointField places{s.modes.n_components, {}, {}};
    for (const dealii::Point<3> &x : s.modes.nodes)
    {
      places.points.emplace_back(x[0], x[1]);
      if (s.modes.dimension == 3)
        places.z.push_back(x[2]);
    }
    for (std::size_t k = 0; k < s.modes.values.size(); ++k)
    {
      analysis::PointField &mode = record.fields["mode " + std::to_string(k + 1)] = places;
      mode.values = s.modes.values[k];
    }
    return record;
  }

  Analysis stability_analysis()
  {
    Analysis analysis{"stability", "Stability"};
    analysis.prepare = [](scene::Scene &scene)
    { scene.solver.is_mixed = false; }; // the operator on displacements is measured
    analysis.choose_methods = [](const scene::Scene &scene, const Methods &available,
                                 unsigned int n_levels, unsigned int n_jobs)
    {
      check_analysis(scene, scene::Analysis::stability);
      Methods methods = study::choose_methods(scene, available);
      check_memory(scene, methods, available, n_levels, n_jobs);
      return methods;
    };
    analysis.analyse = analyse;
    analysis.conclude = conclude;
    analysis.sampled = {"smallest eigenvalue", "largest eigenvalue", "zero modes", "inverse norm",
                        "critical step"};
    return analysis;
  }
} // namespace plumbline::study
