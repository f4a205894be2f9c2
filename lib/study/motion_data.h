#pragma once

#include "analysis/transient.h"
#include "method/method.h"
#include "scene/problem.h"
#include "scene/scene.h"

#include <map>
#include <memory>
#include <optional>
#include <tuple>

namespace plumbline::study
{
  /// The problems of one case and level at all times asked for, which all methods share.
  /// Instantiated for dim = 2 and 3.
  template <int dim>
  class ProblemsInTime
  {
  public:
    /// Loads by case, horizon and time, which lattices of several h share.
    using Loads = std::map<std::tuple<unsigned int, double, double>, problem::Field<dim>>;

    ProblemsInTime(const scene::Scene &scene, unsigned int case_index, const problem::Level &level,
                   Loads &loads)
        : scene_(scene), case_index_(case_index), level_(level), loads_(loads)
    {
    }

    const problem::Problem<dim> &at(double t);

    /// Those of another mesh size at the same horizon, for Galerkin methods that move: in space
    /// they stand on the lattice.
    ProblemsInTime resized(double h) const
    {
      scene::Scene scene = scene_;
      if (dim == 3)
        scene.methods.nodes = {};
      return {scene, case_index_, {h, level_.horizon}, loads_};
    }

    /// How many Chebyshev points in time the expressions take that change in it, by their values at
    /// some hundred places and many times; all that is made of them takes as many at least.
    /// @throws InputError  more than 65
    std::size_t points_in_time();

    double seconds() const { return seconds_; } ///< CPU that making them took

  private:
    scene::Scene scene_;
    unsigned int case_index_;
    problem::Level level_;
    Loads &loads_;
    std::map<double, std::unique_ptr<const problem::Problem<dim>>> problems_;
    std::unique_ptr<const problem::Problem<dim>> first_; ///< whose place all others take
    std::optional<std::size_t> n_points_;                ///< in time
    double seconds_ = 0;
  };

  /// What a motion begins with, what drives it, and what it should be.
  template <int dim>
  struct MotionData
  {
    analysis::State start;
    std::optional<problem::Field<dim>> displacement, velocity; ///< that it begins with, where given
    analysis::TimeSeries drive;
    std::optional<analysis::TimeSeries> exact; ///< states of the solution
    std::optional<analysis::TimeSeries> local; ///< states of a local solution that is given
  };

  /// Fields that change in time as polynomials in it, to 1e-11 of themselves, so that u_tt of a
  /// manufactured u is exact to some 1e-8 of itself, whatever its expression. What lasts less than
  /// .6 % of the time, or a sixteenth of it in less than a tenth of the domain, may be missed.
  /// Instantiated for dim = 2 and 3.
  /// @throws InputError  as TimeSeries::resolve; an initial state that is not finite
  template <int dim>
  MotionData<dim> motion_data(const scene::Scene &scene, const method::MotionOf<dim> &equation,
                              ProblemsInTime<dim> &problems);

  /// Of a problem of either dimension.
  std::unique_ptr<method::Discretisation> discretise(const method::Method &method,
                                                     const problem::Problem<2> &problem);
  std::unique_ptr<method::DiscretisationInSpace> discretise(const method::Method &method,
                                                            const problem::Problem<3> &problem);
} // namespace plumbline::study
