#pragma once

#include "analysis/transient.h"
#include "method/method.h"

#include <map>
#include <memory>
#include <tuple>

namespace plumbline::study
{
  /// The problems of one case and level at all times asked for, which all methods share.
  class ProblemsInTime
  {
  public:
    /// Loads by case, horizon and time, which lattices of several h share.
    using Loads = std::map<std::tuple<unsigned int, double, double>, scene::Field>;

    ProblemsInTime(const scene::Scene &scene, unsigned int case_index, const scene::Level &level,
                   Loads &loads)
        : scene_(scene), case_index_(case_index), level_(level), loads_(loads)
    {
    }

    const scene::Problem &at(double t);

    /// Those of another mesh size at the same horizon.
    ProblemsInTime resized(double h) const
    {
      return {scene_, case_index_, {h, level_.horizon}, loads_};
    }

    double seconds() const { return seconds_; } ///< CPU that making them took

  private:
    const scene::Scene &scene_;
    unsigned int case_index_;
    scene::Level level_;
    Loads &loads_;
    std::map<double, std::unique_ptr<const scene::Problem>> problems_;
    std::unique_ptr<const scene::Problem> first_; ///< whose place all others take
    double seconds_ = 0;
  };

  /// What a motion begins with, what drives it, and what it should be.
  struct MotionData
  {
    analysis::State start;
    analysis::TimeSeries drive;
    std::optional<analysis::TimeSeries> exact; ///< states of the solution
  };

  /// Fields that change in time as polynomials in it, to 1e-11 of themselves, so that u_tt of a
  /// manufactured u is exact to some 1e-8 of itself, whatever its expression.
  /// @throws InputError  as TimeSeries::resolve; an initial state that is not finite
  MotionData motion_data(const scene::Scene &scene, const method::EquationOfMotion &equation,
                         ProblemsInTime &problems);
} // namespace plumbline::study
