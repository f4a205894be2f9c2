#include "study/bound_log.h"

#include "base/number_text.h"
#include "scene/models/model.h"
#include "study/motion_norms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace plumbline::study
{
  using analysis::Vector;

  namespace
  {
    using Cell = std::array<long, 2>;

    Cell cell_of(const dealii::Point<2> &x, const dealii::Point<2> &lower, double h)
    {
      return {std::lround(std::floor((x[0] - lower[0]) / h + 1e-9)),
              std::lround(std::floor((x[1] - lower[1]) / h + 1e-9))};
    }
  } // namespace

  BoundLog::BoundLog(const scene::Scene &scene, double horizon,
                     const analysis::Transient &transient,
                     const method::SemiDiscreteMotion &equation,
                     const std::vector<dealii::Point<2>> &nodes, double h, double measure)
      : transient_(transient), equation_(equation), law_(make_double_well(scene, horizon)),
        final_time_(scene.time.final_time), exponent_(scene.time.hoelder_exponent), h_(h),
        measure_(measure)
  {
    // differences over ± this time are off by its square times ω²/12, 1e-5 for the fastest wave
    constexpr double part_of_step = .005;
    const double critical = transient.critical_step(analysis::scheme("velocity Verlet"));
    shift_ = part_of_step * std::min(critical, final_time_);

    const geometry::Box &box = scene.domain.boxes.include.front();
    const bool is_line = scene.domain.dimension == 1, is_torus = scene.domain.is_periodic;
    std::map<Cell, std::size_t> places;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      places.emplace(cell_of(nodes[i], box.lower, h), i);
    Cell n{std::lround((box.upper[0] - box.lower[0]) / h),
           is_line ? 1 : std::lround((box.upper[1] - box.lower[1]) / h)};
    const std::array<Cell, 4> directions = {Cell{1, 0}, Cell{0, 1}, Cell{1, 1}, Cell{1, -1}};
    for (const auto &[cell, i] : places)
      for (const Cell &direction : directions)
        for (long k = 1; 2 * k <= n[0] && !(is_line && direction[1] != 0); k *= 2)
        {
          Cell other{cell[0] + k * direction[0], cell[1] + k * direction[1]};
          if (is_torus)
            other = {((other[0] % n[0]) + n[0]) % n[0], ((other[1] % n[1]) + n[1]) % n[1]};
          const auto found = places.find(other);
          if (found == places.end())
            continue;
          dealii::Tensor<1, 2> difference = nodes[found->second] - nodes[i];
          for (unsigned int a = 0; is_torus && a < (is_line ? 1u : 2u); ++a)
          {
            const double side = box.upper[a] - box.lower[a];
            difference[a] -= side * std::round(difference[a] / side);
          }
          pairs_.push_back({i, found->second, std::pow(difference.norm(), exponent_)});
        }
  }

  double BoundLog::l2(const Vector &state) const
  {
    return norm_of(equation_.nodal(state), equation_.n_components(), measure_, false);
  }

  double BoundLog::holder(const Vector &state) const
  {
    const std::vector<double> u = equation_.nodal(state);
    const unsigned int n = equation_.n_components();
    double slope = 0;
    for (const Pair &pair : pairs_)
    {
      double square = 0;
      for (unsigned int c = 0; c < n; ++c)
        square += std::pow(u[n * pair.second + c] - u[n * pair.first + c], 2);
      slope = std::max(slope, std::sqrt(square) / pair.distance);
    }
    return norm_of(u, n, measure_, true) + slope;
  }

  void BoundLog::observe(const analysis::State &state)
  {
    const analysis::Motion motion = transient_.motion();
    const std::size_t n = motion.n;
    Vector a(n), before(n), after(n), u(n), load(n);
    motion.acceleration(state.u, state.t, a);
    const auto at = [&](double shift, Vector &result)
    {
      for (std::size_t i = 0; i < n; ++i)
        u[i] = state.u[i] + shift * (state.v[i] + .5 * shift * a[i]);
      motion.acceleration(u, std::clamp(state.t + shift, 0., final_time_), result);
    };
    at(-shift_, before);
    at(shift_, after);
    Vector third(n), fourth(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      third[i] = (after[i] - before[i]) / (2 * shift_);
      fourth[i] = (after[i] - 2 * a[i] + before[i]) / (shift_ * shift_);
    }
    const auto raise = [](double &largest, double value) { largest = std::max(largest, value); };
    raise(norms_.second, l2(a));
    raise(norms_.third, l2(third));
    raise(norms_.fourth, l2(fourth));
    raise(norms_.holder, holder(state.u));
    raise(norms_.holder_second, holder(a));

    const analysis::Energies energies = transient_.energies(state);
    const double energy = energies.kinetic + energies.bond;
    raise(energy_, energy);
    motion.acceleration(Vector(n), state.t, load); // no forces at rest: b, and what holds u
    const double size = l2(load);
    if (first_energy_ < 0)
      first_energy_ = energy;
    else
      impulse_ += .5 * (state.t - last_time_) * (last_load_ + size);
    last_load_ = size;
    last_time_ = state.t;
  }

  bool BoundLog::is_tenth(const analysis::State &state)
  {
    const double rounding = 1e-9 * final_time_;
    if (state.t < next_tenth_ - rounding && state.t < final_time_ - rounding)
      return false;
    next_tenth_ = state.t + .1 * final_time_;
    return true;
  }

  void BoundLog::add_error(double error)
  {
    error_ = std::max(error_, error);
  }

  void BoundLog::enter(analysis::Record &record, const analysis::Scheme &scheme, double step,
                       std::uint64_t n_steps) const
  {
    const double lipschitz = physics::lipschitz_constant(law_), in_time = physics::c_t(norms_),
                 in_space = physics::c_s(law_, norms_, exponent_, measure_),
                 of_space = in_space * std::pow(h_, exponent_) / std::pow(law_.horizon(), 2);
    record.set("C_t", in_time);
    record.set("C_s", in_space);
    record.set("C of (63)", physics::energy_constant(law_, measure_));
    record.set("largest energy", energy_, "force length");
    record.set("energy bound",
               physics::energy_bound(law_, measure_, first_energy_, final_time_, impulse_),
               "force length");
    if (error_ >= 0)
      record.set("largest error over time", error_);
    const auto bound = [&](const std::string &equation, double value)
    {
      record.set("error bound", value);
      if (std::isfinite(value))
        record.texts["error bound of"] = equation;
    };
    const bool is_of_theorem_3 = scheme.order == 1 && scheme.substeps.size() == 2; // (14)-(15)
    if (is_of_theorem_3)
      bound("(17)", physics::growth_factor(lipschitz, final_time_) * (in_time * step + of_space));
    else if (scheme.is_implicit() || scheme.is_explicit_euler)
    {
      const bool is_second = scheme.order == 2;
      if (is_second)
        record.set("C_t of (49)", physics::c_t_of_trapezoidal(norms_));
      const double truncation =
          of_space +
          (is_second ? physics::c_t_of_trapezoidal(norms_) * step * step : in_time * step);
      bound("(52)", physics::one_step_bound(lipschitz, scheme.theta, step, n_steps, truncation));
    }
  }

  std::string step_warning(const scene::Scene &scene, const analysis::Record &record)
  {
    if (scene.material.model->is_linear() || record.text("scheme").empty())
      return "";
    const analysis::Scheme &scheme = analysis::scheme(record.text("scheme"));
    const double step = record["time step"];
    if (!scheme.is_implicit() || !std::isfinite(step))
      return "";
    const physics::DoubleWell law = make_double_well(scene, record.key.horizon);
    const double printed = physics::printed_step_limit(law),
                 limit = physics::step_limit(law, scheme.theta);
    if (step < limit || limit == 0) // 0: C̄ is infinite, and there is no bound at any step
      return "";
    const auto number = [](double value) { return base::to_text(value, 4); };
    return scheme.name + ": steps of " + number(step) +
           (step < printed ? " are below ε²/C̄ = " : " are not below ε²/C̄ = ") + number(printed) +
           ", (53) of Jha & Lipton 2018, and not below " + number(limit) +
           ", the proof's limit with the factor 6 of (41): the error bound does not apply. The "
           "scheme itself works while I - Δt²θ² ∂F/∂u is positive definite, which is checked.";
  }
} // namespace plumbline::study
