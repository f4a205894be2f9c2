#include "analysis/steps.h"

#include "base/error.h"

#include <cmath>
#include <sstream>

namespace plumbline::analysis
{
  namespace
  {
    constexpr double linear_tolerance = 1e-6; // of a Newton step: the next one mends the rest
    constexpr int most_linear = 1000, most_newton = 30;

    /// Solve (I - γ ∂a/∂u) x = b.
    /// @throws NumericalError  a direction in which the matrix is not positive
    void conjugate_gradients(const Motion &motion, const Vector &u, double gamma, const Vector &b,
                             Vector &x, Counts &counts)
    {
      Vector r = b, p = b, ap(b.size());
      x.assign(b.size(), 0);
      const double wanted = linear_tolerance * linear_tolerance * dot(b, b, motion.ranks);
      for (int k = 0; k < most_linear; ++k)
      {
        const double rr = dot(r, r, motion.ranks);
        if (rr <= wanted)
          return;
        motion.tangent(u, p, ap);
        ++counts.n_tangents;
        const double pp = dot(p, p, motion.ranks);
        const double growth = dot(p, ap, motion.ranks) / pp; // ≤ the largest eigenvalue
        if (!(gamma * growth < 1))
        {
          std::ostringstream message;
          message << "implicit step: softened bonds let a perturbation grow by exp("
                  << std::sqrt(growth) << " t), too fast for this step; take one below "
                  << std::sqrt(1 / (gamma * growth)) << " times it";
          throw NumericalError(message.str());
        }
        const double alpha = rr / (pp * (1 - gamma * growth));
        add(x, alpha, p);
        for (std::size_t i = 0; i < r.size(); ++i)
          r[i] -= alpha * (p[i] - gamma * ap[i]);
        const double ratio = dot(r, r, motion.ranks) / rr;
        for (std::size_t i = 0; i < p.size(); ++i)
          p[i] = r[i] + ratio * p[i];
      }
      throw NumericalError("implicit step: conjugate gradients do not settle in " +
                           std::to_string(most_linear) + " iterations; take a shorter step");
    }
  } // namespace

  void theta_step(const Motion &motion, double theta, double step, double tolerance, State &state,
                  Vector &a, Counts &counts)
  {
    const std::size_t n = motion.n;
    const double eta = motion.damping, t = state.t + step;
    const double kappa = step * theta / (1 + step * theta * eta), gamma = step * theta * kappa;
    // v⁺ = known_v + κ a⁺, u⁺ = known_u + γ a⁺
    Vector known_v(n), known_u(n), u = state.u, correction(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      known_v[i] =
          (state.v[i] + step * (1 - theta) * (a[i] - eta * state.v[i])) / (1 + step * theta * eta);
      known_u[i] = state.u[i] + step * (theta * known_v[i] + (1 - theta) * state.v[i]);
    }
    add(u, step, state.v);
    const double scale = norm(state.u, motion.ranks) + step * norm(state.v, motion.ranks) +
                         gamma * norm(a, motion.ranks);
    for (int k = 0;; ++k)
    {
      motion.acceleration(u, t, a);
      ++counts.n_accelerations;
      Vector residual(n);
      for (std::size_t i = 0; i < n; ++i)
        residual[i] = known_u[i] + gamma * a[i] - u[i];
      const double size = norm(residual, motion.ranks);
      if (size <= tolerance * scale)
        break;
      if (k == most_newton || !std::isfinite(size))
      {
        std::ostringstream message;
        message << "implicit step: Newton's method does not settle, its residual is " << size
                << " of " << scale << "; take a shorter step";
        throw NumericalError(message.str());
      }
      conjugate_gradients(motion, u, gamma, residual, correction, counts);
      add(u, 1, correction);
      ++counts.n_newton;
    }
    state.u = u;
    state.v = known_v;
    add(state.v, kappa, a);
    state.t = t;
  }
} // namespace plumbline::analysis
