#pragma once

#include "analysis/record.h"
#include "analysis/transient.h"
#include "physics/one_step_bound.h"
#include "scene/scene.h"

#include <utility>
#include <vector>

namespace plumbline::study
{
  /// The a priori bounds of Jha & Lipton 2018, doi:10.1137/17M1112236, for one motion of double
  /// wells: the norms of u that enter them, estimated from the computed motion, the bounds,
  /// and the errors and energies that they are to hold for.
  class BoundLog
  {
  public:
    /// @param nodes  where nodal values of `equation` are, one in a cell of size h. Hölder norms
    ///               compare nodes that are h, 2h, 4h, ... apart, along axes and diagonals
    /// @param h, measure  [length], |Ω| [length^dim]
    /// Both references must outlive it.
    BoundLog(const scene::Scene &scene, double horizon, const analysis::Transient &transient,
             const method::SemiDiscreteMotion &equation, const std::vector<dealii::Point<2>> &nodes,
             double h, double measure);

    /// The initial state, then others in the order of time.
    void observe(const analysis::State &state);

    /// Whether a tenth of the time has passed since it last said so: for errors that cost much.
    bool is_tenth(const analysis::State &state);

    /// ‖u - û‖ + ‖u_t - û_t‖ in L² over nodes at some time.
    void add_error(double error);

    /// After the last step.
    /// @param step  of the scheme, all of them equal
    void enter(analysis::Record &record, const analysis::Scheme &scheme, double step,
               std::uint64_t n_steps) const;

  private:
    double l2(const analysis::Vector &state) const;
    double holder(const analysis::Vector &state) const;

    const analysis::Transient &transient_;
    const method::SemiDiscreteMotion &equation_;
    physics::DoubleWell law_;
    double final_time_, exponent_, h_, measure_, shift_;
    struct Pair
    {
      std::size_t first = 0, second = 0; ///< nodes
      double distance = 1;               ///< to the power γ
    };
    std::vector<Pair> pairs_;
    physics::SolutionNorms norms_;
    double next_tenth_ = 0;
    double error_ = -1, first_energy_ = -1, energy_ = 0; ///< the largest; -1: none
    double impulse_ = 0, last_load_ = 0, last_time_ = 0; ///< ∫ ‖b‖ dt
  };

  /// A warning, if a scheme has θ > 0 and steps not below (53), with the numbers. Empty: none.
  std::string step_warning(const scene::Scene &scene, const analysis::Record &record);
} // namespace plumbline::study
