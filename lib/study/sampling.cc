#include "study/sampling.h"

#include "base/error.h"
#include "base/number_text.h"
#include "study/cheapest_pair.h"
#include "study/exact_statistics.h"
#include "study/interpolation_error.h"
#include "study/rule_comparison.h"
#include "study/sampling_balance.h"
#include "study/sampling_findings.h"

#include <algorithm>
#include <cmath>

namespace plumbline::study
{
  using analysis::PointField;

  namespace
  {
    /// What Expected/sampling calls the share of a field's variance that its modes have.
    constexpr const char *const kept_of_modes = "variance kept";

    /// √(Σ area f²) of a field.
    double l2(const PointField &places, const std::function<double(std::size_t)> &value)
    {
      double sum = 0;
      for (std::size_t i = 0; i < places.areas.size() * places.n_components; ++i)
        sum += places.areas[i / places.n_components] * value(i) * value(i);
      return std::sqrt(sum);
    }

    /// Of a case what one set has gathered.
    struct SetSums
    {
      std::vector<double> weights; ///< of the samples that there are
      std::map<std::string, std::vector<double>> values;
      uq::FieldSums field;
      double seconds = 0;
    };

    struct CaseSums
    {
      Record first;
      std::vector<SetSums> sets;
      InterpolationError::Sums interpolation;
      // of the leading set, see CaseStatistics
      std::vector<std::size_t> samples = {};
      std::map<std::string, std::vector<std::optional<double>>> values = {};

      void add_row(std::size_t sample, const std::map<std::string, analysis::Scalar> &quantities)
      {
        for (const auto &[name, scalar] : quantities) // which others may lack
          values[name].resize(samples.size());
        samples.push_back(sample);
        for (auto &[name, known] : values)
        {
          const auto found = quantities.find(name);
          known.push_back(found == quantities.end() ? std::nullopt
                                                    : std::optional(found->second.value));
        }
      }
    };

    /// Where in each set a sample is, if it is.
    std::vector<std::vector<std::optional<double>>> weights_of(const SamplingPlan &plan)
    {
      std::vector<std::vector<std::optional<double>>> weights(
          plan.values.size(), std::vector<std::optional<double>>(plan.sets.size()));
      for (std::size_t s = 0; s < plan.sets.size(); ++s)
        for (std::size_t i = 0; i < plan.sets[s].samples.size(); ++i)
          weights[plan.sets[s].samples[i]][s] = plan.sets[s].weights[i];
      return weights;
    }

    /// @param sample   whose records they are
    /// @param leading  set
    void add(std::size_t sample, const Records &records,
             const std::vector<std::optional<double>> &weights, std::size_t leading,
             const InterpolationError &interpolation, std::vector<CaseSums> &cases)
    {
      for (const Record &one : records)
      {
        const std::vector<double> &field = sampled_field(one).values;
        auto found = std::find_if(cases.begin(), cases.end(),
                                  [&](const CaseSums &c) {
                                    return c.first.key.is_same_series(one.key) &&
                                           c.first.key.level == one.key.level;
                                  });
        if (found == cases.end())
        {
          cases.push_back(
              {one, std::vector<SetSums>(weights.size()), InterpolationError::Sums(interpolation)});
          found = cases.end() - 1;
        }
        if (!field.empty())
          found->interpolation.add(sample, field);
        for (std::size_t s = 0; s < weights.size(); ++s)
        {
          if (!weights[s])
            continue;
          SetSums &set = found->sets[s];
          set.weights.push_back(*weights[s]);
          set.seconds += one.cost.seconds();
          for (const auto &[name, scalar] : one.scalars)
            set.values[name].push_back(scalar.value);
          if (!field.empty())
            set.field.add(field, *weights[s]);
        }
        if (weights[leading])
          found->add_row(sample, one.scalars);
      }
    }

    void conclude_field(const SetSums &sums, const PointField &places, bool independent,
                        const std::optional<ExactStatistics> &exact, SetStatistics &set,
                        std::vector<double> &mean, std::vector<double> &deviation)
    {
      const std::size_t n_independent = independent ? sums.weights.size() : 0;
      mean = sums.field.mean();
      deviation = sums.field.deviation(n_independent);
      const std::vector<double> variance = sums.field.variance(n_independent);
      double area = 0;
      for (const double part : places.areas)
        area += part;
      for (std::size_t i = 0; i < variance.size(); ++i)
        if (variance[i] < 0)
          set.negative_part += places.areas[i / places.n_components] / area / places.n_components;
      set.mean_size = l2(places, [&](std::size_t i) { return mean[i]; });
      const bool has_deviation = set.negative_part == 0;
      if (has_deviation)
        set.deviation_size = l2(places, [&](std::size_t i) { return deviation[i]; });
      if (independent && has_deviation)
        set.standard_error =
            *set.deviation_size / std::sqrt(static_cast<double>(sums.weights.size()));
      if (!exact)
        return;
      set.mean_error = l2(places, [&](std::size_t i) { return mean[i] - exact->mean[i]; });
      set.mean_uncertainty = exact->mean_uncertainty;
      if (!has_deviation || exact->deviation.empty())
        return;
      set.deviation_error =
          l2(places, [&](std::size_t i) { return deviation[i] - exact->deviation[i]; });
      set.deviation_uncertainty = exact->deviation_uncertainty;
    }

    /// Weights that sum to 1 again where independent samples have failed.
    std::vector<double> normalised(std::vector<double> weights)
    {
      double sum = 0;
      for (const double weight : weights)
        sum += weight;
      for (double &weight : weights)
        weight /= sum;
      return weights;
    }

    /// A rule that lacks points says nothing; independent samples do without some.
    bool says_something(const SampleSet &set, const SetSums &sums)
    {
      return !sums.weights.empty() &&
             (set.is_independent() || sums.weights.size() == set.samples.size());
    }

    SetStatistics conclude_set(const SampleSet &set, const SetSums &sums)
    {
      SetStatistics result;
      result.rule = set.rule;
      result.count = set.count;
      result.n_modes = set.n_modes;
      result.n_samples = sums.weights.size();
      result.n_missing = set.samples.size() - sums.weights.size();
      result.sum_of_sizes = set.sum_of_sizes;
      result.noise = set.noise;
      result.seconds = sums.seconds;
      if (!says_something(set, sums))
        return result;
      const std::vector<double> weights = normalised(sums.weights);
      for (const auto &[name, values] : sums.values)
        if (values.size() == weights.size())
          result.quantities[name] = uq::statistics(values, weights, set.is_independent());
      return result;
    }

    /// Of the leading set at the finest level, at the places of another one; nothing where samples
    /// of it are missing.
    std::optional<ExactStatistics> own_statistics(const SamplingPlan &plan, const CaseSums &finest,
                                                  const PointField &places)
    {
      const std::size_t leading = plan.last_like(0);
      const SampleSet &set = plan.sets[leading];
      const SetSums &sums = finest.sets[leading];
      if (!says_something(set, sums))
        return {};
      const std::size_t n_independent = set.is_independent() ? sums.weights.size() : 0;
      const std::vector<double> variance = sums.field.variance(n_independent);
      const bool has_deviation =
          std::all_of(variance.begin(), variance.end(), [](double one) { return one >= 0; });
      const ExactStatistics own{sums.field.mean(), has_deviation
                                                       ? sums.field.deviation(n_independent)
                                                       : std::vector<double>()};
      return at_places(own, sampled_field(finest.first), places);
    }

    /// Quantities that some samples of a set lack.
    void find_partial_quantities(const CaseSums &sums, const SampleSet &of, const SetSums &set,
                                 bool has_several_rules, std::vector<std::string> &findings)
    {
      for (const auto &[name, values] : set.values)
        if (const std::size_t n = set.weights.size(); values.size() < n)
          findings.push_back(name + " of " + sums.first.key.method + " is available for " +
                             std::to_string(values.size()) + " of " + std::to_string(n) +
                             " samples" + (has_several_rules ? " of " + base::word(of.rule) : "") +
                             ", so that it has no statistics");
    }

    CaseStatistics conclude_case(const scene::Scene &scene, const SamplingPlan &plan,
                                 const CaseSums &sums, const CaseSums &finest,
                                 const InterpolationError &interpolation,
                                 std::vector<std::string> &findings)
    {
      const bool is_finest = &sums == &finest,
                 is_own = scene.study.decisive_error.target == scene::Target::finest;
      CaseStatistics result;
      result.of = sums.first.key;
      result.is_finest = is_finest;
      result.is_target_level = is_finest && is_own;
      const PointField &places = sampled_field(sums.first);
      std::optional<ExactStatistics> exact;
      try
      {
        if (!places.values.empty())
          exact =
              is_own ? own_statistics(plan, finest, places) : exact_statistics(scene, sums.first);
      }
      catch (const InputError &error)
      {
        findings.push_back(std::string("errors of means are not known: ") + error.what());
      }
      for (std::size_t s = 0; s < plan.sets.size(); ++s)
      {
        const SampleSet &of = plan.sets[s];
        if (plan.last_like(s) == s)
          find_partial_quantities(sums, of, sums.sets[s], scene.sampling.has_several_rules(),
                                  findings);
        SetStatistics set = conclude_set(of, sums.sets[s]);
        const bool is_known = says_something(of, sums.sets[s]) && !places.values.empty();
        FieldStatistics field;
        const bool is_best = is_finest && s == plan.last_like(0);
        set.is_target = is_best && is_own;
        set.interpolation_error = sums.interpolation.largest(s, places);
        if (const auto found = interpolation.lebesgue(s))
        {
          set.lebesgue = found->found;
          set.lebesgue_bound = found->bound;
        }
        if (is_known)
          conclude_field(sums.sets[s], places, of.is_independent(),
                         set.is_target ? std::nullopt : exact, set, field.mean, field.deviation);
        if (is_known && is_best)
        {
          field.places = places;
          field.places.values.clear();
          result.field = std::move(field);
        }
        result.sets.push_back(std::move(set));
      }
      result.samples = sums.samples;
      result.values = sums.values;
      return result;
    }
  } // namespace

  std::optional<uq::Spectrum> field_spectrum(const scene::RandomSection &section)
  {
    if (!section.source || section.n_modes == 0)
      return {};
    return uq::spectrum_of(*section.source->expansion());
  }

  const PointField &sampled_field(const Record &record)
  {
    static const PointField none;
    return record.fields.empty() ? none : record.fields.begin()->second;
  }

  SamplingResults
  conclude_samples(const scene::Scene &scene, const SamplingPlan &plan,
                   const std::function<std::optional<Records>(std::size_t sample)> &read)
  {
    SamplingResults results;
    results.scene_name = scene.name;
    results.purpose = scene.purpose;
    results.scene_text = scene.text;
    results.random = scene.random;
    results.sampling = scene.sampling;
    results.target = base::word(scene.study.decisive_error.target);
    results.n_samples = plan.values.size();
    results.points = plan.values;
    for (const uq::Variable &variable : scene.random.variables)
      results.variables.push_back(variable.name);
    for (unsigned int k = 1; k <= scene.random.n_modes; ++k)
      results.variables.push_back("mode " + std::to_string(k));
    try
    {
      results.spectrum = field_spectrum(scene.random);
    }
    catch (const std::exception &error) // samples failed of it as well, and are listed
    {
      results.findings.push_back(std::string("the variance kept is not known: ") + error.what());
    }
    results.n_expected = static_cast<std::size_t>(
        std::count_if(scene.expected.all.begin(), scene.expected.all.end(),
                      [](const auto &one) { return one.kind == scene::ExpectedKind::sampling; }));
    const auto weights = weights_of(plan);
    const InterpolationError interpolation(scene, plan);
    std::vector<CaseSums> cases;
    std::size_t n_read = 0;
    for (std::size_t i = 0; i < plan.values.size(); ++i)
    {
      const std::optional<Records> records = read(i);
      if (!records)
        continue;
      ++n_read;
      if (!records->empty() && !records->front().failure.empty())
        results.failures.push_back({i, plan.values[i], records->front().failure});
      else
        add(i, *records, weights[i], plan.last_like(0), interpolation, cases);
    }
    results.is_complete = n_read == plan.values.size();
    for (const CaseSums &one : cases)
    {
      const CaseSums *finest = &one;
      for (const CaseSums &other : cases)
        if (other.first.key.is_same_series(one.first.key) &&
            other.first.key.level > finest->first.key.level)
          finest = &other;
      results.cases.push_back(
          conclude_case(scene, plan, one, *finest, interpolation, results.findings));
    }
    if (!scene.sampling.is_axis()) // else means are over an interval, and nobody asks for them
    {
      results.cheapest = find_cheapest(results.cases);
      results.balance = find_balance(results.cases);
      results.comparisons = compare_rules(results.cases);
    }
    for (const std::string &finding : find_findings(results))
      results.findings.push_back(finding);
    if (scene.fracture.is_there() && scene.sampling.analysis == scene::SampledAnalysis::of_scene)
      results.findings.push_back(
          std::string("cracks grow ") + (scene.fracture.is_corrected() ? "with" : "without") +
          " surface terms (Fan et al. 2022, eq. (3.19)), which lower K by some 7 % at nu = 1/4: "
          "hold it against numbers that are made " +
          (scene.fracture.is_corrected() ? "with them" : "without them"));
    return results;
  }

  const SetStatistics *CaseStatistics::last_of(uq::SampleRule rule) const
  {
    const SetStatistics *last = nullptr;
    for (const SetStatistics &set : sets)
      if (set.rule == rule)
        last = &set;
    return last;
  }

  const SetStatistics *CaseStatistics::leading() const
  {
    return sets.empty() ? nullptr : last_of(sets.front().rule);
  }

  std::optional<double> sampled_quantity(const CaseStatistics &one, const std::string &name)
  {
    for (const SetStatistics &other : one.sets)
      if (const std::string end = " by " + base::word(other.rule);
          name.size() > end.size() && name.substr(name.size() - end.size()) == end)
      {
        CaseStatistics of_rule;
        std::copy_if(one.sets.begin(), one.sets.end(), std::back_inserter(of_rule.sets),
                     [&](const SetStatistics &set) { return set.rule == other.rule; });
        return sampled_quantity(of_rule, name.substr(0, name.size() - end.size()));
      }
    if (one.sets.empty())
      return {};
    const SetStatistics &set = *one.leading();
    std::optional<double> of_interpolant; // of the last set that another one is held against
    for (const SetStatistics &other : one.sets)
      if (other.rule == set.rule && other.interpolation_error)
        of_interpolant = other.interpolation_error;
    std::map<std::string, std::optional<double>> known = {
        {"error of the mean", set.mean_error},
        {"error of the deviation", set.deviation_error},
        {"size of the mean", set.mean_size},
        {"size of the deviation", set.deviation_size},
        {"sum of sizes", set.sum_of_sizes},
        {"noise", set.noise},
        {"error of the interpolant", of_interpolant},
        {"Lebesgue constant", set.lebesgue},
        {"samples", static_cast<double>(set.n_samples)}};
    for (const auto &[quantity, statistics] : set.quantities)
    {
      known["mean of " + quantity] = statistics.mean;
      known["deviation of " + quantity] = statistics.deviation();
      known["variance of " + quantity] = statistics.variance;
    }
    const auto found = known.find(name);
    return found == known.end() ? std::nullopt : found->second;
  }

  std::vector<std::string> sampling_faults(const SamplingResults &results,
                                           const scene::ExpectedSection &expected)
  {
    std::vector<std::string> faults;
    for (const scene::Expected &one : expected.all)
    {
      if (one.kind != scene::ExpectedKind::sampling)
        continue;
      std::optional<double> found;
      if (results.spectrum && one.problem == kept_of_modes)
        found = results.spectrum->variance_kept();
      for (const CaseStatistics &known : results.cases) // coarse to fine: the finest is the last
        if (known.of.method == one.method)
          if (const auto value = sampled_quantity(known, one.problem))
            found = value;
      const std::string line = "Expected/sampling = '" + one.text + "', but ";
      if (!found)
        faults.push_back(line + "there is no such quantity of such a method");
      else if (one.values.size() != 1 || !(std::abs(*found - one.values[0]) <=
                                           expected.error_tolerance * std::abs(one.values[0])))
        faults.push_back(line + "it is " + base::to_text(*found, 6));
    }
    return faults;
  }
} // namespace plumbline::study
