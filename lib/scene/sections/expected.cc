#include "base/error.h"
#include "physics/expression.h"
#include "scene/keys.h"
#include "scene/study_sections.h"
#include "scene/values.h"

#include <algorithm>
#include <map>

namespace plumbline::scene
{
  using physics::split_outside_brackets;

  namespace
  {
    using Words = std::vector<std::string>;

    /// Possible verdicts; empty: numbers are expected.
    Words verdicts(ExpectedKind kind)
    {
      switch (kind)
      {
      case ExpectedKind::verdicts:
        return {"AC",
                "AC for this field only",
                "delta-m-convergent",
                "delta-m-convergent for this field only",
                "failed",
                "m-convergent",
                "m-convergent for this field only",
                "not AC",
                "not delta-m-convergent",
                "not m-convergent",
                "not self-convergent",
                "self-convergent",
                "self-convergent to a wrong limit",
                "undecided"};
      case ExpectedKind::monotone:
        return {"no", "yes"};
      case ExpectedKind::stability:
        return {"conditionally stable", "stable", "unstable"};
      default:
        return {};
      }
    }

    /// "method[, case][, series]: value"; the series is the part with '='.
    Expected to_expected(ExpectedKind kind, const std::string &text)
    {
      const Words allowed = verdicts(kind);
      const auto colon = text.rfind(':');
      if (colon == std::string::npos)
        throw InputError("'" + text + "' has no ':'; write 'method[, case][, series]: " +
                         (allowed.empty() ? "numbers'" : "verdict'"));
      Expected expected;
      expected.kind = kind;
      expected.text = text;
      const auto subject = to_names(text.substr(0, colon));
      for (std::size_t i = 0; i < subject.size(); ++i)
        if (i == 0)
          expected.method = method_name(subject[i]);
        else if (subject[i].find('=') != std::string::npos)
          expected.series = subject[i];
        else
          expected.problem = subject[i];
      if (allowed.empty())
      {
        std::string right = trim(text.substr(colon + 1));
        if (kind == ExpectedKind::values && right.rfind("<=", 0) == 0)
        {
          right = trim(right.substr(2));
          if (right.empty())
            throw InputError("'" + text +
                             "' has no bound after '<='; write a number, or the name of another "
                             "quantity of the same record");
          expected.verdict = "<= " + right;
          if (right.find_first_of("0123456789.+-") != 0)
            return expected; // another quantity
        }
        expected.values = to_numbers(right);
        if (expected.values.empty())
          throw InputError("'" + text + "' has no numbers after the ':'");
        if (!expected.verdict.empty() && expected.values.size() > 1)
          throw InputError("'" + text + "' has several numbers after '<='; give one");
        return expected;
      }
      expected.verdict = trim(text.substr(colon + 1));
      if (std::find(allowed.begin(), allowed.end(), expected.verdict) == allowed.end())
        throw InputError("'" + expected.verdict + "' is not a verdict; write one of " +
                         join(allowed, ", "));
      return expected;
    }
    std::string growth_words()
    {
      return join({growth_quantities.begin(), growth_quantities.end()}, ", ");
    }

    std::map<std::string, double> to_growth(const std::string &text)
    {
      std::map<std::string, double> values;
      for (const std::string &part : split_outside_brackets(text, ';'))
      {
        if (part.empty())
          continue;
        const auto colon = part.rfind(':');
        const std::string name = trim(part.substr(0, colon));
        if (colon == std::string::npos ||
            std::find(growth_quantities.begin(), growth_quantities.end(), name) ==
                growth_quantities.end())
          throw InputError("'" + part + "' must be 'quantity: value', the quantity one of " +
                           growth_words());
        values[name] = to_number(part.substr(colon + 1));
      }
      return values;
    }
  } // namespace

  void ExpectedSection::declare(Keys &keys)
  {
    const auto add = [&](ExpectedKind kind, const std::string &help)
    {
      const auto read = [this, kind](const std::string &text)
      {
        all.erase(std::remove_if(all.begin(), all.end(),
                                 [kind](const Expected &one) { return one.kind == kind; }),
                  all.end());
        for (const std::string &part : split_outside_brackets(text, ';'))
          if (!part.empty())
            all.push_back(to_expected(kind, part));
      };
      keys.add(base::word(kind), "", any_text(), read, help);
    };
    add(ExpectedKind::verdicts,
        "'method[, case][, series]: verdict' separated by ';', e.g. 'IPA-AC: not AC; Q1: AC'.");
    add(ExpectedKind::errors,
        "'method[, case][, series]: e0 e1 ...', the decisive error at each level.");
    keys.add("error tolerance", error_tolerance, positive(),
             "Relative tolerance of Expected/errors.");
    add(ExpectedKind::rates, "'method[, case][, series]: p', the observed order of convergence "
                             "between the two finest levels.");
    keys.add("rate tolerance", rate_tolerance, positive(),
             "Absolute tolerance of Expected/rates and of the rates in Expected/strip.");
    add(ExpectedKind::bounds,
        "'method[, case][, series]: e', the decisive error stays below e at every level.");
    add(ExpectedKind::monotone, "'method[, case][, series]: yes' or 'no', whether the decisive "
                                "error decreases from every level to the next.");
    add(ExpectedKind::jitter,
        "'method[, case][, series]: minimum maximum', bounds of the sum of all increases of the "
        "decisive error between consecutive levels, relative to its first value; 0 if the error "
        "decreases monotonically.");
    add(ExpectedKind::orders, "'method, scheme: p', the observed order in time of a scheme at the "
                              "finest level, from Time/steps or Time/critical fractions.");
    keys.add(
        "crack", crack,
        "Expected outcome of 'plumbline crack': arrests, runs, branches, or too short to tell (the "
        "simulated time is too short to classify the crack). unknown: no expectation.");
    keys.add(
        "growth", "", any_text(), [this](const std::string &text) { growth = to_growth(text); },
        "'quantity: value' separated by ';', of 'plumbline grow': " + growth_words() +
            "; the tolerance is Expected/error tolerance.");
    keys.add("growth ends", growth_end,
             "Reason why 'plumbline grow' ends. separated: no path of bonds connects two grips. "
             "unloaded: Fracture/min reaction is reached. loaded: Fracture/max load is reached. "
             "whole: no further bond can break. unknown: no expectation.");
    add(ExpectedKind::stability,
        "'method: VERDICT' of 'plumbline stability': stable, conditionally stable or unstable.");
    add(ExpectedKind::sampling,
        "'method, quantity: value' of 'plumbline sample', from the largest set of samples at the "
        "finest level, to Expected/error tolerance; quantities as named in its table (the error of "
        "the interpolant: of the last set that has one), or variance kept, the fraction of a "
        "field's variance in its modes. With several rules these are of the first one; 'error of "
        "the mean by Monte Carlo' is of the rule that is named.");
    add(ExpectedKind::strip,
        "'method, quantity[, series]: q0 q1 ...' of 'plumbline strip' at each level, to "
        "Expected/error tolerance. Quantities: W1, tip energy, opening, G (relative to the local "
        "exact value; for Strip/edges = K field), and, as one number each, their limits and "
        "observed orders, e.g. tip energy limit and tip energy rate; orders to Expected/rate "
        "tolerance.");
    add(ExpectedKind::values,
        "'method, quantity[, series]: v0 v1 ...': the value of any quantity that an analysis "
        "records (see its JSON file) at each level, to Expected/error tolerance. '<= v' in place "
        "of the numbers: every value is at most v; '<= another quantity': at most that of the same "
        "record, e.g. 'FA, largest error over time: <= error bound'.");
    add(ExpectedKind::growth, "'method: d': growth rates of waves on uniformly strained "
                              "double-well bonds, observed by 'plumbline stability', differ from "
                              "those of the symbol by at most d times the largest rate.");
  }

  void ExpectedSection::complete(const std::vector<std::string> &cases) const
  {
    for (const Expected &one : all)
      if (one.kind != ExpectedKind::orders && one.kind != ExpectedKind::sampling &&
          one.kind != ExpectedKind::strip && one.kind != ExpectedKind::values &&
          !one.problem.empty() && std::find(cases.begin(), cases.end(), one.problem) == cases.end())
        throw InputError("Expected/" + base::word(one.kind) + ": '" + one.problem + "' in '" +
                         one.text + "' is neither a case of Problem nor a series like 'm = 3'");
  }
} // namespace plumbline::scene
