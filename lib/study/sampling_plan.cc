#include "study/sampling.h"

namespace plumbline::study
{
  using uq::SamplePoints;
  using uq::SampleRule;

  namespace
  {
    SamplePoints draw(SampleRule rule, const scene::SamplingSection &sampling,
                      const std::vector<uq::Law> &laws, unsigned int count)
    {
      switch (rule)
      {
      case SampleRule::tensor:
        return uq::tensor_points(laws, count);
      case SampleRule::smolyak:
        return uq::smolyak_points(laws, count, sampling.growth);
      case SampleRule::chebyshev:
        return uq::chebyshev_points(laws.size(), count);
      case SampleRule::equidistant:
        return uq::equidistant_points(laws.size(), count);
      case SampleRule::quasi_monte_carlo:
        return uq::quasi_monte_carlo_points(laws, count);
      default:
        return uq::monte_carlo_points(laws, count, sampling.seed);
      }
    }

    /// Samples that several sets share are taken once.
    using Known = std::map<std::vector<double>, std::size_t>;

    /// A set of each count of a rule, all modes beyond n_modes being 0.
    /// @param of  its place among the rules
    void add_sets(const scene::Scene &scene, std::size_t of, unsigned int n_modes, Known &known,
                  SamplingPlan &plan)
    {
      const scene::SamplingSection &sampling = scene.sampling;
      const SampleRule rule = sampling.rules[of];
      const scene::RandomSection &random = scene.random;
      const std::vector<uq::Law> laws = random.laws(),
                                 varying(laws.begin(), laws.end() - random.n_modes + n_modes);
      const bool is_sequence =
          rule == SampleRule::monte_carlo || rule == SampleRule::quasi_monte_carlo;
      const std::size_t first = plan.values.size(); // of a sequence
      for (const unsigned int count : sampling.counts_of(of))
      {
        const SamplePoints points = draw(rule, sampling, varying, count);
        SampleSet set{rule,          count, n_modes, {}, points.weights, points.sum_of_sizes(),
                      points.noise()};
        for (std::size_t i = 0; i < points.points.size(); ++i)
        {
          std::vector<double> values = points.points[i];
          for (std::size_t d = 0; d < random.variables.size(); ++d)
            values[d] = random.variables[d].at(values[d]);
          values.resize(laws.size(), 0);
          // of sequences the first ones are the same; others share points that are equal
          std::size_t place = first + i;
          if (!is_sequence)
            place = known.emplace(values, plan.values.size()).first->second;
          if (place == plan.values.size())
            plan.values.push_back(std::move(values));
          set.samples.push_back(place);
        }
        plan.sets.push_back(std::move(set));
      }
    }
  } // namespace

  scene::Scene SamplingPlan::at(const scene::Scene &scene, std::size_t sample) const
  {
    return at_sample(scene, values[sample], static_cast<unsigned int>(sample) + 1);
  }

  std::size_t SamplingPlan::last_like(std::size_t set) const
  {
    std::size_t last = set;
    while (last + 1 < sets.size() && sets[last + 1].rule == sets[set].rule)
      ++last;
    return last;
  }

  SamplingPlan make_sampling_plan(const scene::Scene &scene)
  {
    std::vector<unsigned int> modes = scene.sampling.modes;
    if (modes.empty())
      modes = {scene.random.n_modes};
    SamplingPlan plan;
    Known known;
    for (std::size_t rule = 0; rule < scene.sampling.rules.size(); ++rule)
      for (const unsigned int n_modes : modes)
        add_sets(scene, rule, n_modes, known, plan);
    return plan;
  }
} // namespace plumbline::study
