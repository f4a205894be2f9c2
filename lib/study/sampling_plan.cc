#include "study/sampling.h"

namespace plumbline::study
{
  using uq::SamplePoints;
  using uq::SampleRule;

  namespace
  {
    SamplePoints draw(const scene::SamplingSection &sampling, const std::vector<uq::Law> &laws,
                      unsigned int count)
    {
      switch (sampling.rule)
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

    /// A set of each count, all modes beyond n_modes being 0.
    void add_sets(const scene::Scene &scene, unsigned int n_modes, Known &known, SamplingPlan &plan)
    {
      const scene::SamplingSection &sampling = scene.sampling;
      const scene::RandomSection &random = scene.random;
      const std::vector<uq::Law> laws = random.laws(),
                                 varying(laws.begin(), laws.end() - random.n_modes + n_modes);
      const bool is_sequence =
          plan.are_independent || sampling.rule == SampleRule::quasi_monte_carlo;
      const std::size_t first = plan.values.size(); // of a sequence
      for (const unsigned int count : sampling.counts)
      {
        const SamplePoints points = draw(sampling, varying, count);
        SampleSet set{count, n_modes, {}, points.weights, points.sum_of_sizes(), points.noise()};
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

  SamplingPlan make_sampling_plan(const scene::Scene &scene)
  {
    SamplingPlan plan;
    plan.are_independent = scene.sampling.rule == SampleRule::monte_carlo;
    Known known;
    if (scene.sampling.modes.empty())
      add_sets(scene, scene.random.n_modes, known, plan);
    for (const unsigned int n_modes : scene.sampling.modes)
      add_sets(scene, n_modes, known, plan);
    return plan;
  }
} // namespace plumbline::study
