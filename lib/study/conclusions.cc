#include "study/conclusions.h"

#include "base/number_text.h"
#include "scene/models/model.h"
#include "study/cheapest.h"
#include "study/expectations.h"
#include "study/model_facts.h"
#include "study/solution_record.h"
#include "study/target_words.h"
#include "study/tip_forces.h"
#include "study/trend.h"
#include "study/weigh_proof.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <set>
#include <tuple>

namespace plumbline::study
{
  namespace
  {
    const std::string other_targets =
        "compare with exact, reference or own finest level (Study/decisive error), or decrease the "
        "horizon with h (Study/regime = delta or delta-m)";

    /// A reference with fewer certified digits gives a warning.
    constexpr unsigned int few_digits = 2;

    bool is_against_reference(const std::string &error)
    {
      return is_against(error, scene::Target::reference);
    }

    /// Where the last level of a run's method, case and series is on the axis.
    double finest_place(const StudyResults &results, const Record &first, Axis axis)
    {
      double least = coordinate(axis, first.key);
      for (const Record &run : results.records)
        if (run.key.method == first.key.method && run.key.problem == first.key.problem &&
            run.key.series == first.key.series)
          least = std::min(least, coordinate(axis, run.key));
      return least;
    }

    /// A difference to the reference that is not ten times the reference's own estimate decides
    /// nothing.
    void doubt_reference(const StudyResults &results, Trend &trend)
    {
      if (!is_against_reference(trend.error) || trend.values.empty() ||
          trend.outcome == Outcome::failed)
        return;
      double estimate = 0;
      std::string remedy = "take a better reference (Reference/method)";
      for (const ErrorEstimate &one : results.references)
        if (one.problem == trend.problem && one.series == trend.series)
        {
          estimate = one.estimate;      // of the finest level, the last one
          if (std::isnan(one.p_change)) // there is no higher degree
            remedy = "refine Study/h";
          else if (one.p_change > 0 && one.p_change < one.h_change)
            remedy = "the reference's error decreases with h, not with the degree; refine Study/h, "
                     "or, if straight sides approximate curves, set Domain/sides = curved";
        }
      if (trend.values.back() < 10 * estimate)
      {
        trend.outcome = Outcome::undecided;
        trend.leaning = Leaning::none;
        trend.reason = "the last difference " + base::to_text(trend.values.back(), 4) +
                       " is not ten times the reference's own estimate " +
                       base::to_text(estimate, 4) + ": " + remedy;
      }
    }

    /// Errors against the local solution at a fixed horizon do not tell methods apart.
    void refuse_modelling_difference(scene::Regime regime, Trend &trend)
    {
      if (regime != scene::Regime::m || !is_against(trend.error, scene::Target::local) ||
          (trend.outcome != Outcome::stalls && trend.outcome != Outcome::undecided) ||
          trend.values.empty())
        return;
      trend.outcome = Outcome::undecided;
      trend.reason = "at a fixed horizon every convergent method tends to the difference of the "
                     "nonlocal from the local solution, not to 0; the last error is " +
                     base::to_text(trend.values.back(), 4) + ": " + other_targets;
    }

    /// The errors of one method, case and series over its levels.
    Trend collect(const scene::Scene &scene, const StudyResults &results, const Record &first,
                  const std::string &error)
    {
      Trend trend;
      trend.method = first.key.method;
      trend.family = first.key.family;
      trend.problem = first.key.problem;
      trend.series = first.key.series;
      trend.error = error;
      trend.axis = level_axis(scene.study.regime);
      std::vector<LimitProof> proofs;
      for (const Record &run : results.records)
      {
        if (run.key.method != first.key.method || run.key.problem != first.key.problem ||
            run.key.series != first.key.series)
          continue;
        if (!run.failure.empty())
        {
          trend.outcome = Outcome::failed;
          trend.reason = run.failure;
        }
        if (!run.has(error))
          continue;
        trend.size = std::max(trend.size, size_of(run, error));
        trend.round_off = std::max(trend.round_off, round_off_of(run, error));
        const LimitProof proof = limit_of(run);
        trend.proof = trend.x.empty() ? proof : weaker(trend.proof, proof);
        trend.x.push_back(coordinate(trend.axis, run.key));
        trend.values.push_back(run[error]);
        proofs.push_back(proof);
      }
      if (is_against(error, scene::Target::finest))
        trend.finest = finest_place(results, first, trend.axis);
      if (trend.outcome != Outcome::failed)
        judge(trend, scene.study.variable);
      doubt_reference(results, trend);
      if (scene.study.regime == scene::Regime::m || scene.study.regime == scene::Regime::delta_m)
        trend.proof = prove_by_levels(scene.study.regime, trend, proofs);
      weigh_proof(trend);
      refuse_modelling_difference(scene.study.regime, trend);
      if (scene.study.regime == scene::Regime::horizon && trend.outcome != Outcome::failed)
      {
        // no limit is approached: the rate tells how the error depends on the horizon
        trend.outcome = Outcome::undecided;
        if (std::isfinite(trend.rate))
          trend.reason =
              "error ~ horizon^" + base::to_text(trend.rate, 4) + " at the smallest horizons";
      }
      trend.verdict = verdict_of(scene.study.regime, trend);
      return trend;
    }

    /// Once, of a decisive error that decides nothing.
    void warn_of_target(StudyResults &results)
    {
      if (!is_between_models(results))
        return;
      const std::string warning =
          "Study/decisive error = " + results.decisive_error +
          " at a fixed horizon (Study/regime = m): every convergent method tends to the difference "
          "of the nonlocal from the local solution, not to 0, so that no method is called "
          "convergent or not; " +
          other_targets;
      if (std::find(results.warnings.begin(), results.warnings.end(), warning) ==
          results.warnings.end())
        results.warnings.push_back(warning);
    }

    /// Once for each case, of a reference whose digits are too few, at its finest level.
    void warn_of_reference(const scene::Scene &scene, StudyResults &results)
    {
      std::map<std::tuple<std::string, std::string>, const ErrorEstimate *> finest;
      for (const ErrorEstimate &one : results.references)
        finest[{one.problem, one.series}] = &one;
      for (const auto &[place, one] : finest)
      {
        if (!(one->estimate > 0) || one->certified_digits >= few_digits)
          continue;
        const std::string name = one->method;
        // digits are not counted where nothing is known of the entries' own error
        const bool is_unrefined = one->certified_digits == 0 && scene.quadrature.tolerance == 0 &&
                                  !scene.domain.mesh.is_lattice();
        const bool is_continuous = name.front() == 'Q' || name.front() == 'P';
        const std::string warning =
            "the reference " + name + " of " + one->problem + ", " + one->series + " has " +
            (one->certified_digits == 0
                 ? "no certified digit"
                 : std::to_string(one->certified_digits) + " certified digit") +
            " at h = " + base::to_text(one->h, 4) + ": " +
            (is_unrefined
                 ? "outer quadrature is not refined, so entries have an unknown error; set "
                   "Quadrature/tolerance above 0"
             : scene.domain.is_in_space()
                 ? "refine Study/h; where the solution or its data jump, as u may at the boundary, "
                   "the accuracy is low"
             : is_continuous
                 ? "where the solution or its data jump, a continuous space loses accuracy, so "
                   "take a discontinuous one (Reference/method = " +
                       std::string(name.front() == 'Q' ? "DGQ1" : "DGP1") +
                       "); where they are smooth, refine Study/h"
                 : "refine Study/h, or take a higher degree (Reference/method)");
        if (std::find(results.warnings.begin(), results.warnings.end(), warning) ==
            results.warnings.end())
          results.warnings.push_back(warning);
      }
    }

    void make_trends(const scene::Scene &scene, StudyResults &results)
    {
      std::set<std::tuple<std::string, std::string, std::string>> seen;
      for (const Record &run : results.records)
      {
        if (!seen.insert({run.key.method, run.key.problem, run.key.series}).second)
          continue;
        std::set<std::string> errors{scene.study.decisive_error.text()};
        for (const Record &other : results.records)
          if (other.key.method == run.key.method && other.key.problem == run.key.problem)
            for (const auto &entry : errors_of(other))
              errors.insert(entry.first);
        for (const std::string &error : errors)
          // the reference held against itself says nothing
          if (!is_against_reference(error) || results.references.empty() ||
              run.key.method != results.references.front().method)
            results.trends.push_back(collect(scene, results, run, error));
      }
    }

    /// The cheapest runs of methods that converge, to this field and to others, with an error of at
    /// most a target times how far their solution varies.
    std::vector<const Record *> cheapest_to(const StudyResults &results,
                                            const std::set<std::string> &methods,
                                            const std::string &problem, const std::string &series,
                                            double target)
    {
      std::vector<const Record *> runs;
      for (const Record &run : results.records)
      {
        if (run.key.problem == problem && run.key.series == series &&
            methods.count(run.key.method) > 0 &&
            relative_error(run, results.decisive_error) <= target)
          runs.push_back(&run);
      }
      return cheapest(runs);
    }

    Choice choice_of(const std::vector<const Record *> &runs, double target,
                     const std::string &error)
    {
      const Record &run = *runs.front();
      Choice choice{target, run.key.method, run.key.h, run[error], run.cost.seconds(), {}};
      for (std::size_t i = 1; i < runs.size(); ++i)
        choice.tied.push_back(runs[i]->key.method);
      return choice;
    }

    void give_advice(const scene::Scene &scene, StudyResults &results)
    {
      for (const std::string &problem : scene.problem.case_names())
        for (const auto &series : scene.study.series)
        {
          Advice advice{problem, series.name, {}, {}, {}};
          std::set<std::string> good;
          for (const Trend &trend : results.trends)
            if (trend.error == results.decisive_error && trend.problem == problem &&
                trend.series == series.name)
            {
              if (trend.outcome == Outcome::converges && !trend.proof.has_wrong_moments())
                good.insert(trend.method);
              else if (trend.outcome == Outcome::stalls)
                advice.stalling.push_back(trend.method);
              else if (trend.outcome == Outcome::field_only)
                advice.field_only.push_back(trend.method);
            }
          if (is_against(results.decisive_error, scene::Target::finest))
            good.clear(); // how near a method is to itself does not make it better than another
          for (const double target : {1e-2, 1e-4, 1e-6, 1e-8})
            if (const auto runs = cheapest_to(results, good, problem, series.name, target);
                !runs.empty())
              advice.choices.push_back(choice_of(runs, target, results.decisive_error));
          results.advice.push_back(advice);
        }
    }

    /// At the first horizon.
    void list_constants(const scene::Scene &scene, StudyResults &results)
    {
      const double horizon = scene.study.series.front().levels.front().horizon;
      for (const auto &[what, value] : scene.material.model->derived_constants(scene, horizon))
        results.facts[what] = value;
    }

    /// Verdicts rest on a reference, whose error is unknown if it is not estimated.
    void tell_unknown_reference(const scene::Scene &scene, StudyResults &results)
    {
      if (is_against_reference(results.decisive_error) && scene.reference.method &&
          scene.reference.estimate == scene::Estimate::none)
        results.facts["error of the reference"] =
            "not estimated (Reference/estimate = none); verdicts assume that it is at most a tenth "
            "of the last errors";
    }

    /// The run with most bonds, of those without a matrix or of all; null: there is none.
    const Record *largest_run(const Records &records, bool is_without_matrix)
    {
      const std::string sparse = base::word(base::OperatorBackend::sparse);
      const Record *largest = nullptr;
      for (const Record &run : records)
        if (run.failure.empty() &&
            !(is_without_matrix && run.text("operator").compare(0, sparse.size(), sparse) == 0) &&
            (largest == nullptr || run.cost.n_bonds > largest->cost.n_bonds))
          largest = &run;
      return largest;
    }

    std::string megabytes(double bytes)
    {
      return base::to_text(bytes / 1e6, 4) + " MB";
    }

    std::string where(const Record &run)
    {
      return " (" + run.key.method + ", h = " + base::to_text(run.key.h, 4) + ")";
    }

    Omission omitted_matrix(const Record &run)
    {
      constexpr double bytes_of_entry = 12;
      const double bonds = static_cast<double>(run.cost.n_bonds),
                   rows = std::max<double>(1., static_cast<double>(run.cost.n_unknowns));
      return {"a matrix", "uniform lattice and homogeneous kernel: all rows are one stencil",
              "an assembled matrix would hold " + base::to_text(bonds, 4) + " entries, " +
                  megabytes(bytes_of_entry * bonds) + "; the stencil holds " +
                  base::to_text(bonds / rows, 4) + " a row" + where(run)};
    }

    void list_omissions(const scene::Scene &scene, StudyResults &results)
    {
      const Record *const largest = largest_run(results.records, false);
      if (largest == nullptr)
        return;
      const double bonds = static_cast<double>(largest->cost.n_bonds);
      const Record *const by_stencil = largest_run(results.records, true);
      if (!scene.domain.mesh.is_lattice() && !scene.domain.is_in_space())
      {
        results.omissions.push_back({"exact geometry in every cell",
                                     "circles are cut in double precision, good to round-off",
                                     "a sample of cells is recomputed with exact geometry"});
        if (scene.is_homogeneous())
          results.omissions.push_back({"a coefficient at every bond", "the material is homogeneous",
                                       "one evaluation a quadrature point"});
      }
      else if (by_stencil != nullptr && scene.domain.mesh.is_lattice() &&
               scene.solver.operator_backend != base::OperatorBackend::sparse &&
               (!scene.domain.is_in_space() || scene.methods.nodes.are_lattice_centres()))
        results.omissions.push_back(omitted_matrix(*by_stencil));
      if (scene.domain.is_in_space() && scene.domain.mesh.is_file() && scene.is_homogeneous() &&
          !scene.domain.is_free_body)
        results.omissions.push_back(
            {"factors of bonds",
             "the material is homogeneous, and u is prescribed all around the domain",
             "quadrature near interfaces and free surfaces, which takes most of the time"});
      if (scene.solver.is_full_model)
      {
        results.omissions.clear();
        return;
      }
      if (scene.domain.dimension == 1)
        ; // one component is all there is
      else if (!scene.is_vector())
        results.omissions.push_back(
            {scene.domain.is_in_space() ? "the second and the third component"
                                        : "the second component",
             "the kernel is scalar, so components do not couple",
             scene.domain.is_in_space() ? "two thirds of the unknowns, 8/9 of the entries"
                                        : "half the unknowns, 3/4 of the entries"});
      else if (!scene.has_dilatation())
        results.omissions.push_back(
            {"the dilatation", "lambda = mu: only the bonds remain",
             "one unknown a node, a family pass, and half the width of the collar"});
      else if (scene.domain.mesh.is_lattice())
        results.omissions.push_back(
            {"the dilatation as an unknown",
             "homogeneous: condensed, it is part of one stencil of twice the reach",
             std::string(scene.domain.is_in_space() ? "a quarter" : "a third") +
                 " of the unknowns, and a system that stays positive definite"});
      if (scene.material.model->is_state_based() && scene.material.is_homogeneous)
        results.omissions.push_back({"means of the material at both ends of each bond",
                                     "the material is homogeneous",
                                     megabytes(16 * bonds) + where(*largest)});
      results.omissions.push_back(
          {"Newton's method", "the model is linear",
           (largest->cost.n_iterations == 0
                ? std::string("one direct solve a level")
                : "one solve of " + std::to_string(largest->cost.n_iterations) +
                      " iterations a level") +
               where(*largest)});
      if (!scene.domain.is_damaged())
        results.omissions.push_back(
            {"bond state", "no fracture: no bond can break",
             megabytes(bonds / 8) + " at one bit a bond" + where(*largest)});
    }
  } // namespace

  void conclude(const scene::Scene &scene, StudyResults &results)
  {
    results.trends.clear();
    results.advice.clear();
    results.omissions.clear();
    add_model_facts(scene, results.facts);
    make_trends(scene, results);
    warn_of_target(results);
    if (results.is_complete)
      warn_of_reference(scene, results);
    warn_of_tip_forces(results);
    check_expectations(scene, results);
    give_advice(scene, results);
    list_constants(scene, results);
    tell_unknown_reference(scene, results);
    list_omissions(scene, results);
  }
} // namespace plumbline::study
