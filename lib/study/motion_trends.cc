#include "base/number_text.h"
#include "scene/models/model.h"
#include "study/dynamics.h"
#include "study/expectations.h"
#include "study/trend.h"
#include "study/weigh_proof.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace plumbline::study
{
  namespace
  {
    const std::string time_error = "nodal L2 | time";

    /// What runs of one trend have in common.
    bool is_alike(const MotionRun &a, const MotionRun &b)
    {
      return a.method == b.method && a.problem == b.problem && a.series == b.series &&
             a.scheme == b.scheme;
    }

    /// The runs with a scheme's shortest step: the last of each level.
    std::vector<std::vector<const MotionRun *>> over_levels(const std::vector<MotionRun> &runs)
    {
      std::vector<std::vector<const MotionRun *>> groups;
      for (const MotionRun &run : runs)
      {
        const auto group =
            std::find_if(groups.begin(), groups.end(),
                         [&](const auto &one) { return is_alike(*one.front(), run); });
        if (group == groups.end())
          groups.push_back({&run});
        else if (group->back()->level == run.level)
          group->back() = &run;
        else
          group->push_back(&run);
      }
      return groups;
    }

    MotionTrend begin(const MotionRun &run, const std::string &error)
    {
      MotionTrend trend;
      trend.method = run.method;
      trend.family = run.family;
      trend.problem = run.problem;
      trend.series = run.series;
      trend.scheme = run.scheme;
      trend.error = error;
      return trend;
    }

    /// Of double wells by differences h^γ/ε² with data in C^(0,γ), γ <= 1: at a fixed horizon.
    /// Source: Jha & Lipton 2018, doi:10.1137/17M1112236, Theorems 3 and 4.
    std::string proven_rate(const scene::Scene &scene, const MotionTrend &trend)
    {
      if (scene.material.model->is_linear() || trend.family != MethodFamily::meshfree)
        return {};
      return scene.study.regime == scene::Regime::m ? "γ <= 1" : "none";
    }

    MotionTrend over_levels(const scene::Scene &scene, const std::vector<const MotionRun *> &runs,
                            const std::string &error)
    {
      // of the solution's size: what is left of 1e-12 in times, forces and references
      constexpr double rounding = 1e-10;
      MotionTrend trend = begin(*runs.back(), error);
      trend.steps = runs.back()->steps;
      trend.axis = level_axis(scene.study.regime);
      trend.proven = proven_rate(scene, trend);
      std::string failure;
      std::vector<LimitProof> proofs;
      for (const MotionRun *run : runs)
      {
        const auto found = run->errors.find(error);
        if (!run->failure.empty())
          failure = run->failure;
        else if (found != run->errors.end())
        {
          trend.x.push_back(coordinate(trend.axis, *run));
          trend.values.push_back(found->second);
          trend.proof = proofs.empty() ? run->limit : weaker(trend.proof, run->limit);
          proofs.push_back(run->limit);
          trend.size = norm_of_one(error, run->area) * run->size;
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
      trend.verdict = verdict_of(scene.study.regime, trend);
      return trend;
    }

    /// Slope of the error in time over Δt, at the finest level.
    std::vector<MotionTrend> orders(const std::vector<MotionRun> &runs)
    {
      constexpr double rounding = 1e-11; // of the solution's size: that of Runge-Kutta
      std::vector<MotionTrend> all;
      for (const MotionRun &run : runs)
      {
        const auto found = run.errors.find(time_error);
        if (found == run.errors.end() || analysis::scheme(run.scheme).is_runge_kutta)
          continue;
        const auto same =
            std::find_if(all.begin(), all.end(),
                         [&](const MotionTrend &trend)
                         {
                           return trend.method == run.method && trend.problem == run.problem &&
                                  trend.series == run.series && trend.scheme == run.scheme;
                         });
        const auto place = static_cast<std::size_t>(same - all.begin());
        if (place == all.size())
        {
          all.push_back(begin(run, time_error));
          all.back().axis = Axis::time_step;
        }
        MotionTrend &trend = all[place];
        trend.size = norm_of_one(time_error, run.area) * run.size;
        trend.round_off = rounding * trend.size;
        trend.x.push_back(run.step);
        trend.values.push_back(found->second);
      }
      for (MotionTrend &trend : all)
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
        trend.reason = "of the scheme: " + std::to_string(analysis::scheme(trend.scheme).order);
      }
      return all;
    }

    void expect_orders(const scene::Scene &scene, DynamicResults &results)
    {
      for (const scene::Expected &expected : scene.expected.all)
      {
        if (expected.kind != scene::ExpectedKind::orders)
          continue;
        bool is_found = false;
        for (const MotionTrend &trend : results.orders)
          if (trend.method == expected.method && trend.scheme == expected.problem)
          {
            is_found = true;
            results.expectations.push_back(
                {trend.method + ", " + trend.scheme + ", " + trend.series + ": order in time",
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

    /// The model's constants, at the first horizon.
    void say_facts(const scene::Scene &scene, DynamicResults &results)
    {
      const auto add = [&](const std::string &what, const std::string &value)
      { results.facts.emplace_back(what, value); };
      const double horizon = scene.study.series.front().levels.front().horizon;
      add("final time T", number(scene.time.final_time));
      add("density ρ, damping η", number(scene.time.density) + ", " + number(scene.time.damping));
      for (const auto &[what, value] : scene.material.model->facts(scene, horizon))
        add(what, value);
    }

    void say_omissions(const scene::Scene &scene, DynamicResults &results)
    {
      const auto leave_out = [&](const std::string &what, const std::string &why,
                                 const std::string &saving) {
        results.omissions.push_back({what, why, saving});
      };
      if (!scene.is_vector())
        leave_out("the second component", "the kernel is scalar, so components do not couple",
                  "half the unknowns, a quarter of the bonds' work");
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
        leave_out("the dilatation", "lambda = mu: the bonds are all",
                  "half the reach of the stencil");
      if (scene.is_steady())
        leave_out("loads and constraint in time", "neither has t in it", "one set instead of 17");
    }
    /// One for each method whose operator is not symmetric at some level.
    void say_warnings(DynamicResults &results)
    {
      std::set<std::string> methods;
      for (const MotionRun &run : results.runs)
        if (!run.is_symmetric && methods.insert(run.method).second)
          results.warnings.push_back(
              run.method +
              ": the operator is not symmetric, because a bond has different weights at its two "
              "ends. The critical time step is that of the symmetric part. Complex eigenvalues can "
              "make the solution grow with any time step; 'plumbline stability' computes them.");
    }
  } // namespace

  DynamicResults begin_results(const scene::Scene &scene, unsigned int n_levels)
  {
    DynamicResults results;
    results.scene_name = scene.name;
    results.purpose = scene.purpose;
    results.regime = base::word(scene.study.regime);
    results.variable = scene.study.variable;
    results.scene_text = scene.text;
    const bool is_known =
        scene.reference.method || (!scene.problem.solutions.empty() &&
                                   scene.study.decisive_error.target == scene::Target::exact);
    results.decisive_error = is_known ? scene.study.decisive_error.text() : "";
    results.final_time = scene.time.final_time;
    results.density = scene.time.density;
    results.damping = scene.time.damping;
    results.shows_blow_up = scene.time.shows_blow_up;
    results.n_levels = n_levels;
    return results;
  }

  void conclude(const scene::Scene &scene, DynamicResults &results)
  {
    results.trends.clear();
    results.facts.clear();
    results.omissions.clear();
    results.expectations.clear();
    results.warnings.clear();
    if (!results.decisive_error.empty())
      for (const auto &runs : over_levels(results.runs))
      {
        results.trends.push_back(over_levels(scene, runs, results.decisive_error));
        results.trends.push_back(over_levels(scene, runs, "velocity " + results.decisive_error));
      }
    results.orders = orders(results.runs);
    say_facts(scene, results);
    say_omissions(scene, results);
    say_warnings(results);

    Results statics; // expectations of levels are those of statics
    statics.decisive_error = results.decisive_error;
    statics.trends.assign(results.trends.begin(), results.trends.end());
    check_expectations(scene, statics);
    results.expectations = statics.expectations;
    expect_orders(scene, results);
  }
} // namespace plumbline::study
