#pragma once

#include "study/sampling.h"

#include <vector>

namespace plumbline::study
{
  /// How far the interpolants u^Q of sets are from the solutions at other values of the variables:
  /// max over ξ of ‖u(ξ) - u^Q(ξ)‖, L2 over Ω (Fan et al. 2022, doi:10.1016/j.cma.2022.115340,
  /// theorem 4, with that norm). The solutions are those of the last set of its rule, at most 32 of
  /// its samples that are not in the set: no further solves, and a lower bound on the maximum. For
  /// uniform variables only: if one is unbounded, sets extrapolate to the outer samples of the last
  /// set, and there is no maximum.
  class InterpolationError
  {
  public:
    InterpolationError(const scene::Scene &scene, const SamplingPlan &plan);

    /// Of the points that a set interpolates at; nothing where it does not (Monte Carlo).
    struct Lebesgue
    {
      double found = 0, bound = 0; ///< see uq::Interpolant::Lebesgue
    };
    std::optional<Lebesgue> lebesgue(std::size_t set) const { return sets_[set].lebesgue; }

    /// Errors of the fields of one case, sample by sample, so that no sample is kept.
    class Sums
    {
    public:
      explicit Sums(const InterpolationError &of);
      void add(std::size_t sample, const std::vector<double> &field);

      /// Nothing where there are no other samples, or some are missing.
      std::optional<double> largest(std::size_t set, const analysis::PointField &places) const;

    private:
      const InterpolationError &of_;
      std::vector<std::vector<std::vector<double>>> errors_; ///< of each set at each point
      std::vector<std::size_t> n_added_;                     ///< of the samples that a set needs
    };

  private:
    struct Set
    {
      std::optional<Lebesgue> lebesgue;
      /// By sample, what it adds at each point, shape (n_points); of samples that add something.
      std::map<std::size_t, std::vector<double>> parts;
      std::size_t n_points = 0; ///< that solutions are known at
    };
    std::vector<Set> sets_;
  };
} // namespace plumbline::study
