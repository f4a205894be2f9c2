#include "study/transient.h"

#include "base/number_text.h"
#include "scene/models/model.h"
#include "study/bound_log.h"
#include "study/expectations.h"
#include "study/model_facts.h"
#include "study/solution_record.h"
#include "study/trend.h"
#include "study/weigh_proof.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace plumbline::study
{
  namespace
  {
    /// What records of one trend have in common.
    bool is_alike(const Record &a, const Record &b)
    {
      return a.key.method == b.key.method && a.key.problem == b.key.problem &&
             a.key.series == b.key.series && a.text("scheme") == b.text("scheme");
    }

    /// The records with a scheme's shortest step: the last of each level.
    std::vector<std::vector<const Record *>> over_levels(const Records &records)
    {
      std::vector<std::vector<const Record *>> groups;
      for (const Record &record : records)
      {
        const auto group =
            std::find_if(groups.begin(), groups.end(),
                         [&](const auto &one) { return is_alike(*one.front(), record); });
        if (group == groups.end())
          groups.push_back({&record});
        else if (group->back()->key.level == record.key.level)
          group->back() = &record;
        else
          group->push_back(&record);
      }
      return groups;
    }

    Trend begin(const Record &record, const std::string &error)
    {
      Trend trend;
      trend.method = record.key.method;
      trend.family = record.key.family;
      trend.problem = record.key.problem;
      trend.series = record.key.series;
      trend.variant = record.text("scheme");
      trend.error = error;
      return trend;
    }

    /// How large u is, in an error's norm.
    double size_of(const Record &record, const std::string &error)
    {
      return norm_of_one(error, record["area of the domain"]) * record["extent of u"];
    }

    /// How waves grow in a record; empty: they do not.
    std::string growth_in(const Record &record)
    {
      constexpr int n_digits = 4;
      return record.has(growing_waves)
                 ? "waves grow at h = " + base::to_text(record.key.h, n_digits) +
                       ", the smallest ω² is " + base::to_text(record[growing_waves], n_digits)
                 : "";
    }

    /// Whether the finest step is no shorter than the coarsest one, so that the error in time
    /// stays.
    bool has_fixed_step(const std::vector<const Record *> &records)
    {
      constexpr double shorter = .9;
      return records.back()->has("time step") && records.front()->has("time step") &&
             (*records.back())["time step"] > shorter * (*records.front())["time step"];
    }

    /// A plateau may be the error of a step that is the same at all levels, and says nothing of the
    /// method then, unless its moments prove a wrong limit or the error in time is known to be
    /// less.
    void doubt_fixed_step(Trend &trend, const std::vector<const Record *> &records)
    {
      constexpr double margin = 3; // between the plateau and the error in time
      if (trend.outcome != Outcome::stalls || !has_fixed_step(records) ||
          trend.proof.answer == LimitProof::Answer::incompatible)
        return;
      const Record &finest = *records.back();
      const bool is_of_u = trend.error.find(base::word(scene::Norm::nodal_l2)) == 0;
      const bool is_known = is_of_u && finest.has(time_error);
      if (is_known && trend.values.back() > margin * finest[time_error])
        return;
      trend.outcome = Outcome::undecided;
      trend.reason =
          "the time step is the same at all levels and its error " +
          (is_known ? "is " + base::to_text(finest[time_error], 2) : std::string("is not known")) +
          ": it may dominate. Reduce the step with h, take a scheme of higher order, or give "
          "two steps in Time/steps to have the error in time measured; " +
          trend.reason;
    }

    Trend over_levels(const scene::Scene &scene, const std::vector<const Record *> &records,
                      const std::string &error)
    {
      // of the solution's size: what is left of 1e-12 in times, forces and references
      constexpr double rounding = 1e-10;
      Trend trend = begin(*records.back(), error);
      trend.axis = level_axis(scene.study.regime);
      std::string failure;
      std::vector<LimitProof> proofs;
      for (const Record *record : records)
      {
        if (!record->failure.empty())
          failure = record->failure;
        else if (failure.empty())
          failure = growth_in(*record);
        if (record->failure.empty() && record->has(error))
        {
          trend.x.push_back(coordinate(trend.axis, record->key));
          trend.values.push_back((*record)[error]);
          const LimitProof limit = limit_of(*record);
          trend.proof = proofs.empty() ? limit : weaker(trend.proof, limit);
          proofs.push_back(limit);
          trend.size = size_of(*record, error);
          trend.round_off = rounding * trend.size;
        }
      }
      judge(trend, scene.study.variable);
      if (!failure.empty())
      {
        trend.outcome = Outcome::failed;
        trend.reason = failure;
      }
      const scene::Regime regime = scene.study.regime;
      if (regime == scene::Regime::m || regime == scene::Regime::delta_m)
        trend.proof = prove_by_levels(regime, trend, proofs);
      // of small strains alone, where a law is not linear: enough to be wrong
      if (scene.material.model->is_linear() ||
          trend.proof.answer == LimitProof::Answer::incompatible)
        weigh_proof(trend);
      if (!trend.x.empty())
        doubt_fixed_step(trend, records);
      trend.verdict = verdict_of(scene.study.regime, trend);
      return trend;
    }

    /// Slope of the error in time over Δt, at the finest level.
    std::vector<Trend> orders(const Records &records)
    {
      constexpr double rounding = 1e-11; // of the solution's size: that of Runge-Kutta
      std::vector<Trend> all;
      for (const Record &record : records)
      {
        if (!record.has(time_error) || analysis::scheme(record.text("scheme")).is_runge_kutta)
          continue;
        auto same = std::find_if(all.begin(), all.end(),
                                 [&](const Trend &trend)
                                 {
                                   return trend.method == record.key.method &&
                                          trend.problem == record.key.problem &&
                                          trend.series == record.key.series &&
                                          trend.variant == record.text("scheme");
                                 });
        if (same == all.end())
          same = all.insert(all.end(), begin(record, time_error));
        same->axis = Axis::time_step;
        same->size = size_of(record, time_error);
        same->round_off = rounding * same->size;
        same->x.push_back(record["time step"]);
        same->values.push_back(record[time_error]);
      }
      for (Trend &trend : all)
      {
        std::vector<double> x, e;
        for (std::size_t i = 0; i < trend.x.size(); ++i)
        {
          if (i > 0)
            trend.rates.push_back(std::log(trend.values[i] / trend.values[i - 1]) /
                                  std::log(trend.x[i] / trend.x[i - 1]));
          if (trend.values[i] > trend.round_off)
          {
            x.push_back(trend.x[i]);
            e.push_back(trend.values[i]);
          }
        }
        if (x.size() < 2)
        {
          trend.reason = "fewer than two steps with errors above round-off";
          continue;
        }
        const Slope slope = fit_slope(x, e);
        trend.rate = slope.value;
        trend.rate_uncertainty = slope.uncertainty;
        trend.verdict = "order " + base::to_text(slope.value, 3);
        trend.reason = "of the scheme: " + std::to_string(analysis::scheme(trend.variant).order);
      }
      return all;
    }

    void expect_orders(const scene::Scene &scene, StudyResults &results)
    {
      for (const scene::Expected &expected : scene.expected.all)
      {
        if (expected.kind != scene::ExpectedKind::orders)
          continue;
        bool is_found = false;
        for (const Trend &trend : results.trends)
          if (trend.axis == Axis::time_step && trend.method == expected.method &&
              trend.variant == expected.problem)
          {
            is_found = true;
            results.expectations.push_back(
                {trend.method + ", " + trend.variant + ", " + trend.series + ": order in time",
                 base::to_text(expected.values.front(), 4) + " ± " +
                     base::to_text(scene.expected.rate_tolerance, 4),
                 std::isfinite(trend.rate) ? base::to_text(trend.rate, 4) : trend.reason,
                 std::abs(trend.rate - expected.values.front()) <= scene.expected.rate_tolerance});
          }
        if (!is_found)
          results.expectations.push_back(
              {expected.text, "order in time", "no such method and scheme was run", false});
      }
    }

    std::string number(double value)
    {
      return base::to_text(value, 6);
    }

    /// Of double wells by differences h^γ/ε² with data in C^(0,γ), γ <= 1: at a fixed horizon.
    /// Source: Jha & Lipton 2018, doi:10.1137/17M1112236, Theorems 3 and 4.
    const char *proven_rate(const scene::Scene &scene)
    {
      return scene.study.regime == scene::Regime::m ? "γ <= 1" : "none";
    }

    /// The model's constants, at the first horizon.
    void say_facts(const scene::Scene &scene, StudyResults &results)
    {
      auto &facts = results.facts;
      const double horizon = scene.study.series.front().levels.front().horizon;
      add_model_facts(scene, facts);
      facts["regime"] = base::word(scene.study.regime);
      facts["final time T"] = number(scene.time.final_time);
      facts["density ρ, damping η"] =
          number(scene.time.density) + ", " + number(scene.time.damping);
      for (const auto &[what, value] : scene.material.model->facts(scene, horizon))
        facts[what] = value;
      if (scene.time.shows_blow_up)
        facts["blow-up"] = "is shown";
      if (!scene.material.model->is_linear())
        facts["proven order of rules"] = proven_rate(scene);
    }

    void say_omissions(const scene::Scene &scene, StudyResults &results)
    {
      const auto leave_out =
          [&](const std::string &what, const std::string &why, const std::string &saving)
      { results.facts[left_out_of_model + what] = why + "; saves " + saving; };
      if (!scene.is_vector())
        scene.domain.is_in_space()
            ? leave_out("the second and third components",
                        "the kernel is scalar, so components do not couple",
                        "two thirds of the unknowns, eight ninths of the bonds' work")
            : leave_out("the second component", "the kernel is scalar, so components do not couple",
                        "half the unknowns, three quarters of the bonds' work");
      if (!scene.material.model->is_linear())
        leave_out("bond state", "double wells break by the law itself, without memory",
                  "a bit for each bond");
      else
      {
        leave_out("Newton's method and new tangents", "the model is linear",
                  "one linear solve a step of implicit schemes");
        if (scene.domain.mesh.is_lattice() && !scene.domain.is_free_body)
          leave_out("the stencil of each node", "the lattice's nodes are alike",
                    "all but one family of bonds");
      }
      if (scene.material.model->is_state_based() && !scene.has_dilatation())
        leave_out("the dilatation", "lambda = mu: only the bonds remain",
                  "half the reach of the stencil");
      if (scene.is_steady())
        leave_out("loads and constraint in time", "neither has t in it", "one set instead of 17");
    }

    /// One for each method whose waves grow, or whose operator is not symmetric, at some level.
    void say_warnings(const scene::Scene &scene, StudyResults &results)
    {
      std::set<std::string> growing, methods, steps;
      for (const Record &record : results.records)
      {
        if (const std::string warning = step_warning(scene, record);
            !warning.empty() && steps.insert(warning).second)
          results.warnings.push_back(warning);
        if (const std::string growth = growth_in(record);
            !growth.empty() && growing.insert(record.key.method).second)
          results.warnings.push_back(
              record.key.method + ": " + growth +
              ": the operator is not positive definite, and these waves grow exponentially for "
              "every time step. "
              "Change the rule or the ratio horizon / h; 'plumbline dispersion' shows the waves");
        if (record["symmetric"] == 0 && methods.insert(record.key.method).second)
          results.warnings.push_back(
              record.key.method +
              ": the operator is not symmetric, because a bond has different weights at its two "
              "ends. The critical time step is that of the symmetric part. Complex eigenvalues can "
              "make the solution grow with any time step; 'plumbline stability' computes them");
      }
    }
  } // namespace

  void conclude_transient(const scene::Scene &scene, StudyResults &results)
  {
    const bool is_known = scene.reference.method ||
                          (!scene.problem.solutions.empty() &&
                           scene.study.decisive_error.target == scene::Target::exact) ||
                          scene.study.decisive_error.target == scene::Target::local;
    const std::string decisive = is_known ? scene.study.decisive_error.text() : "";
    if (is_known)
    {
      results.decisive_error = decisive;
      for (const auto &records : over_levels(results.records))
        for (const std::string &error : {decisive, "velocity " + decisive})
          results.trends.push_back(over_levels(scene, records, error));
    }
    for (Trend &trend : orders(results.records))
      results.trends.push_back(std::move(trend));
    say_facts(scene, results);
    say_omissions(scene, results);
    say_warnings(scene, results);

    StudyResults statics; // expectations of levels are those of statics
    statics.decisive_error = results.decisive_error;
    statics.trends.assign(results.trends.begin(), results.trends.end());
    check_expectations(scene, statics);
    results.expectations = statics.expectations;
    expect_orders(scene, results);
  }
} // namespace plumbline::study
