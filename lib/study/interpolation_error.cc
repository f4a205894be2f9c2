#include "study/interpolation_error.h"

#include "base/error.h"
#include "uq/interpolation.h"

#include <algorithm>
#include <cmath>

namespace plumbline::study
{
  namespace
  {
    constexpr std::size_t most_points = 32;      ///< that an interpolant is held against
    constexpr std::size_t most_samples = 20'000; ///< of a set whose interpolant is looked at

    std::optional<uq::Interpolant> interpolant(const scene::Scene &scene, const SampleSet &set)
    {
      const std::vector<uq::Law> laws = scene.random.laws();
      const bool is_bounded = std::all_of(laws.begin(), laws.end(),
                                          [](uq::Law law) { return law == uq::Law::uniform; });
      if (!is_bounded || set.n_modes != scene.random.n_modes || set.samples.size() > most_samples ||
          laws.empty())
        return {};
      switch (set.rule)
      {
      case uq::SampleRule::tensor:
        return uq::Interpolant::tensor(laws, set.count);
      case uq::SampleRule::chebyshev:
        return uq::Interpolant::chebyshev(laws.size(), set.count);
      case uq::SampleRule::smolyak:
        return uq::Interpolant::smolyak(laws, set.count, scene.sampling.growth);
      default:
        return {};
      }
    }

    /// Some of the samples of the last set of its rule that are not in a set, from its first to its
    /// last.
    std::vector<std::size_t> others(const SampleSet &last, const SampleSet &set)
    {
      std::vector<std::size_t> all;
      for (const std::size_t sample : last.samples)
        if (std::find(set.samples.begin(), set.samples.end(), sample) == set.samples.end())
          all.push_back(sample);
      if (all.size() <= most_points)
        return all;
      std::vector<std::size_t> some;
      for (std::size_t i = 0; i < most_points; ++i)
        some.push_back(all[i * (all.size() - 1) / (most_points - 1)]);
      return some;
    }
  } // namespace

  InterpolationError::InterpolationError(const scene::Scene &scene, const SamplingPlan &plan)
      : sets_(plan.sets.size())
  {
    const auto &variables = scene.random.variables;
    const auto at = [&](std::vector<double> standard)
    {
      for (std::size_t d = 0; d < variables.size(); ++d)
        standard[d] = variables[d].at(standard[d]);
      return standard;
    };
    const auto standard = [&](std::vector<double> values)
    {
      for (std::size_t d = 0; d < variables.size(); ++d)
        values[d] = (values[d] - variables[d].centre) / variables[d].scale;
      return values;
    };
    std::map<std::vector<double>, std::size_t> sample_of;
    for (std::size_t i = 0; i < plan.values.size(); ++i)
      sample_of.emplace(plan.values[i], i);
    for (std::size_t s = 0; s < plan.sets.size(); ++s)
    {
      const auto of = interpolant(scene, plan.sets[s]);
      if (!of)
        continue;
      Set &set = sets_[s];
      if (const auto found = of->lebesgue())
        set.lebesgue = Lebesgue{found->found, found->bound};
      std::vector<std::size_t> samples; // of the interpolant's points
      for (const auto &point : of->points())
        if (const auto found = sample_of.find(at(point)); found != sample_of.end())
          samples.push_back(found->second);
      if (samples.size() < of->points().size()) // some have no weight, and were not solved at
        continue;
      const std::vector<std::size_t> points = others(plan.sets[plan.last_like(s)], plan.sets[s]);
      set.n_points = points.size();
      for (std::size_t p = 0; p < points.size(); ++p)
      {
        const auto part = [&](std::size_t sample) -> double &
        {
          std::vector<double> &parts = set.parts[sample];
          parts.resize(points.size(), 0);
          return parts[p];
        };
        const std::vector<double> J = of->coefficients(standard(plan.values[points[p]]));
        for (std::size_t k = 0; k < samples.size(); ++k)
          part(samples[k]) -= J[k];
        part(points[p]) += 1;
      }
    }
  }

  InterpolationError::Sums::Sums(const InterpolationError &of)
      : of_(of), errors_(of.sets_.size()), n_added_(of.sets_.size(), 0)
  {
    for (std::size_t s = 0; s < errors_.size(); ++s)
      errors_[s].resize(of.sets_[s].n_points);
  }

  void InterpolationError::Sums::add(std::size_t sample, const std::vector<double> &field)
  {
    for (std::size_t s = 0; s < errors_.size(); ++s)
    {
      const auto found = of_.sets_[s].parts.find(sample);
      if (found == of_.sets_[s].parts.end())
        continue;
      ++n_added_[s];
      for (std::size_t p = 0; p < errors_[s].size(); ++p)
      {
        errors_[s][p].resize(field.size(), 0);
        for (std::size_t i = 0; i < field.size(); ++i)
          errors_[s][p][i] += found->second[p] * field[i];
      }
    }
  }

  std::optional<double> InterpolationError::Sums::largest(std::size_t set,
                                                          const analysis::PointField &places) const
  {
    if (errors_[set].empty() || n_added_[set] < of_.sets_[set].parts.size())
      return {};
    double largest = 0;
    for (const std::vector<double> &error : errors_[set])
    {
      double sum = 0;
      for (std::size_t i = 0; i < error.size(); ++i)
        sum += places.areas[i / places.n_components] * error[i] * error[i];
      if (!std::isfinite(sum))
        throw NumericalError("the interpolant between samples is not finite");
      largest = std::max(largest, std::sqrt(sum));
    }
    return largest;
  }
} // namespace plumbline::study
