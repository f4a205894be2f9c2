#pragma once

#include "base/communicator.h"

#include <functional>
#include <vector>

namespace plumbline::analysis
{
  using Vector = std::vector<double>;

  struct State
  {
    Vector u, v; ///< of size n
    double t = 0;
  };

  /// ü = a(u, t) - η u̇ for n unknowns. Lumped masses and densities are divided out; the tangent is
  /// symmetric then only if they are all the same.
  struct Motion
  {
    std::size_t n = 0;
    /// a(u, t); 0 where u is constrained. Overwrites the last argument, of size n.
    std::function<void(const Vector &u, double t, Vector &a)> acceleration;
    /// ∂a/∂u v, symmetric; implicit schemes and critical steps need it.
    std::function<void(const Vector &u, const Vector &v, Vector &out)> tangent = {};
    double damping = 0; ///< η >= 0 [1/time]
    /// Called after each step and its observer: whether a has changed at this state because bonds
    /// broke; a is then evaluated again. Empty: a depends on u and t alone.
    std::function<bool(const State &)> changes = {};
    /// That have a part of the unknowns each: n is this one's, and functions are collective.
    base::Communicator ranks = base::Communicator::alone();
  };

  /// @param ranks  that have a part of the vectors each
  double norm(const Vector &x, const base::Communicator &ranks = base::Communicator::alone());
  double dot(const Vector &x, const Vector &y,
             const base::Communicator &ranks = base::Communicator::alone());

  /// x += factor y
  void add(Vector &x, double factor, const Vector &y);
} // namespace plumbline::analysis
