#include "study/torus_reference.h"

#include "base/control_points.h"
#include "base/error.h"
#include "base/number_text.h"
#include "study/motion_estimate.h"
#include "study/motion_norms.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::study
{
  using analysis::Transient;

  std::vector<double> Torus::at(const std::vector<dealii::Point<2>> &nodes,
                                const std::vector<double> &of) const
  {
    std::vector<double> values;
    for (const auto &node : nodes)
      for (unsigned int c = 0; c < equation->n_components(); ++c)
        values.push_back(equation->value(of, node, c));
    return values;
  }

  namespace
  {
    /// The largest difference of a field to the trigonometric polynomial through its values, of its
    /// largest value, at control points.
    double unresolved_part(const method::ContinuousMotion &equation, const scene::Scene &scene,
                           const analysis::Vector &values, const problem::Field<2> &field)
    {
      constexpr std::size_t n_line = 400, n_plane = 60; // along each axis
      const geometry::Box &box = scene.domain.boxes.include.front();
      const bool is_line = scene.domain.dimension == 1;
      double largest = 0, worst = 0;
      for (const double t : base::control_points(is_line ? 1 : n_plane))
        for (const double s : base::control_points(is_line ? n_line : n_plane))
        {
          const dealii::Point<2> x(box.lower[0] + s * (box.upper[0] - box.lower[0]),
                                   is_line ? box.lower[1]
                                           : box.lower[1] + t * (box.upper[1] - box.lower[1]));
          for (unsigned int c = 0; c < equation.n_components(); ++c)
          {
            const double value = field(x, c);
            largest = std::max(largest, std::abs(value));
            worst = std::max(worst, std::abs(value - equation.value(values, x, c)));
          }
        }
      return largest > 0 ? worst / largest : 0;
    }

    /// Of what a motion begins with and is driven by.
    double unresolved_part(const method::ContinuousMotion &equation, const scene::Scene &scene,
                           const MotionData<2> &data, ProblemsInTime<2> &problems)
    {
      double worst = 0;
      const double end = scene.is_steady() ? 0 : scene.time.final_time;
      for (const double t : {0., end / 2, end}) // points of the series in time
        worst = std::max(worst, unresolved_part(equation, scene, equation.drive(problems.at(t)),
                                                problems.at(t).load));
      for (const auto &[field, values] :
           {std::pair(data.displacement, data.start.u), std::pair(data.velocity, data.start.v)})
        if (field)
          worst = std::max(worst, unresolved_part(equation, scene, values, *field));
      return worst;
    }

    /// By the first method that can.
    std::shared_ptr<const method::ContinuousMotion>
    make_torus(const scene::Scene &scene, const Methods &available, double horizon, unsigned int n)
    {
      for (const auto &method : available)
        if (auto motion = method->continuous_motion(make_double_well(scene, horizon),
                                                    scene.domain.boxes.include.front(),
                                                    scene.domain.dimension, n))
          return motion;
      throw InputError(
          "Reference/method = torus: none of the methods of this program moves a torus "
          "without a mesh; set Reference/method = none");
    }

    /// States at equal times from 0 to the end.
    std::vector<TorusSolution::Instant> path_of(const scene::Scene &scene,
                                                const Transient &transient, analysis::State state,
                                                unsigned int n_parts)
    {
      const analysis::Motion motion = transient.motion();
      std::vector<TorusSolution::Instant> path;
      const auto keep = [&](const analysis::State &now)
      {
        analysis::Vector acceleration(now.u.size());
        motion.acceleration(now.u, now.t, acceleration);
        path.push_back({now, acceleration});
      };
      keep(state);
      const double part = scene.time.final_time / n_parts;
      for (unsigned int k = 1; k <= n_parts; ++k) // what an observer sees is interpolated by ARKODE
      {
        analysis::integrate(motion, analysis::scheme("Runge-Kutta"), {part}, k * part, state);
        keep(state);
      }
      return path;
    }

    /// Doubles the number of times until the polynomials between those of the last path give the
    /// states halfway to 1e-8 of the largest value. The kept path has half the spacing; degree 5
    /// makes it 64 times as accurate.
    void follow(const scene::Scene &scene, const Transient &transient, const analysis::State &start,
                TorusSolution &solution)
    {
      constexpr unsigned int fewest = 4, most = 1024;
      constexpr double tolerance = 1e-8;
      solution.path = path_of(scene, transient, start, fewest);
      for (unsigned int n = 2 * fewest; n <= most; n *= 2)
      {
        auto finer = path_of(scene, transient, start, n);
        double change = 0, size = 0;
        for (std::size_t k = 1; k < finer.size(); k += 2)
        {
          const analysis::State between = solution.at(finer[k].state.t);
          for (std::size_t i = 0; i < between.u.size(); ++i)
          {
            change = std::max(change, std::abs(between.u[i] - finer[k].state.u[i]));
            size = std::max(size, std::abs(finer[k].state.u[i]));
          }
        }
        solution.path = std::move(finer);
        if (change <= tolerance * size)
          return;
      }
      throw InputError(
          "Time/a priori bounds = true: " + std::to_string(most) +
          " states of the torus reference are too few for errors over all of Time/final "
          "time = " +
          base::to_text(scene.time.final_time, 6) +
          "; shorten it, or write Time/a priori bounds = false");
    }
  } // namespace

  analysis::State TorusSolution::at(double t) const
  {
    std::size_t right = 1;
    while (right + 1 < path.size() && path[right].state.t < t)
      ++right;
    const Instant &a = path[right - 1], &b = path[right];
    const double length = b.state.t - a.state.t, s = (t - a.state.t) / length;
    analysis::State state{analysis::Vector(a.state.u.size()), analysis::Vector(a.state.u.size()),
                          t};
    for (std::size_t i = 0; i < state.u.size(); ++i)
    {
      // u = Σ c_k s^k: c_0, c_1, c_2 from the left, the others from what is left at the right
      const double c0 = a.state.u[i], c1 = length * a.state.v[i],
                   c2 = .5 * length * length * a.acceleration[i],
                   value = b.state.u[i] - (c0 + c1 + c2),
                   slope = length * b.state.v[i] - (c1 + 2 * c2),
                   bend = length * length * b.acceleration[i] - 2 * c2,
                   c3 = 10 * value - 4 * slope + .5 * bend, c4 = -15 * value + 7 * slope - bend,
                   c5 = 6 * value - 3 * slope + .5 * bend;
      state.u[i] = c0 + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5))));
      state.v[i] = (c1 + s * (2 * c2 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / length;
    }
    return state;
  }

  TorusSolution solve_torus(const scene::Scene &scene, const Methods &available, double horizon,
                            ProblemsInTime<2> &problems)
  {
    constexpr double tolerance = 1e-8;
    constexpr double of_data = 1e-6; // of the largest value: loads are seen by the motion's average
    double missed = 0;
    const base::CpuTimer timer;
    std::optional<MotionData<2>> last;
    Torus coarse;
    TorusSolution solution;
    Torus &fine = solution.torus;
    using Sizes = std::vector<unsigned int>;
    for (const unsigned int n :
         scene.domain.dimension == 1 ? Sizes{32, 48, 72, 108, 162} : Sizes{16, 24, 36, 54})
    {
      coarse = std::move(fine);
      fine.equation = make_torus(scene, available, horizon, n);
      last = motion_data<2>(scene, *fine.equation, problems);
      const MotionData<2> &data = *last;
      const Transient transient(*fine.equation, data.drive, scene.time.density, scene.time.damping);
      fine.state = move_exactly(scene, transient, data.start);
      solution.n_points = n;
      if (!coarse.equation)
        continue;
      const std::vector<double> exact = fine.at(coarse.equation->nodes(), fine.state.u);
      const unsigned int n_components = fine.equation->n_components();
      solution.change = norm_of(difference(coarse.equation->nodal(coarse.state.u), exact),
                                n_components, 1, false);
      // both may have missed the same feature
      missed = unresolved_part(*fine.equation, scene, data, problems);
      if (solution.change <= tolerance * extent_of(exact, n_components) && missed <= of_data)
        break;
    }
    if (missed > of_data)
      throw InputError(
          "Reference/method = torus: " + std::to_string(solution.n_points) +
          " points per side do not resolve the load or the initial data (relative error " +
          base::to_text(missed, 2) +
          "); use smoother fields, or set Reference/method = none and the target exact "
          "(Study/decisive error); without Problem/solution the errors of Galerkin methods are "
          "then estimated");
    if (scene.time.has_bounds)
      follow(scene, Transient(*fine.equation, last->drive, scene.time.density, scene.time.damping),
             last->start, solution);
    solution.seconds = timer.seconds();
    return solution;
  }
} // namespace plumbline::study
