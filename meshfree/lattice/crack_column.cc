#include "meshfree/lattice/crack_column.h"

#include "base/error.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    /// The root of a function that grows from a negative value at low, to rounding.
    template <typename Function>
    double bisect(double low, double high, const Function &f)
    {
      while (true)
      {
        const double middle = .5 * (low + high);
        if (!(middle > low) || !(middle < high))
          return low;
        (f(middle) < 0 ? low : high) = middle;
      }
    }
  } // namespace

  CrackColumn::CrackColumn(const std::vector<WellBond> &bonds, double h, int n_free,
                           physics::WellPotential shape)
      : shape_(std::move(shape)), h_(h), n_free_(n_free), toughness_(lattice_toughness(bonds, 2, h))
  {
    for (const WellBond &bond : bonds)
      if (bond.k[1] > 0 && bond.strength != 0)
      {
        n_grip_ = std::max(n_grip_, bond.k[1]);
        rows_.push_back({bond.k[1], bond.way[1], bond.strength});
      }
    std::ostringstream message;
    if (!(h > 0) || !std::isfinite(h))
      message << "lattice: h = " << h << " must be positive and finite";
    else if (n_free % 2 != 0)
      message << n_free << " rows between the grips leave none for the crack to pass between: the "
              << "height must be an even number of h";
    else if (n_free < 4 * n_grip_)
      message << n_free << " rows between the grips are fewer than four horizons, " << 4 * n_grip_
              << " rows; raise the height or lower the horizon";
    else
      return;
    throw InputError(message.str());
  }

  double CrackColumn::density(double strain) const
  {
    double sum = 0; // bonds down count as much as those up
    for (const Row &row : rows_)
    {
      const double q = row.way * row.k * h_ * strain;
      sum += .5 * row.strength * shape_.value(q * q);
    }
    return sum;
  }

  double CrackColumn::most_strain() const
  {
    double stiffest = 0;
    for (const Row &row : rows_)
      stiffest = std::max(stiffest, row.way * row.k * h_);
    return std::sqrt(shape_.softening()) / stiffest;
  }

  double CrackColumn::strain(double energy) const
  {
    const double most = most_strain(), largest = density(most) * height();
    if (!(energy >= 0) || !(energy <= largest))
    {
      std::ostringstream message;
      message << "the strained strip stores W H = " << energy << ", " << energy / toughness_
              << " times its toughness G_c = " << toughness_ << "; beyond " << largest / toughness_
              << " times G_c bonds soften everywhere, not only at the tip: lower Crack/load or the "
                 "horizon (Study/h, Study/m), or make the strip higher (Domain/boxes)";
      throw InputError(message.str());
    }
    return bisect(0, most, [&](double g) { return density(g) * height() - energy; });
  }

  CrackColumn::Rest CrackColumn::relax(double strain, bool is_separated) const
  {
    constexpr int most_steps = 50;
    constexpr double tolerance = 1e-13; // of the grips' displacement
    const int n = n_rows();
    Rest rest{std::vector<double>(n), 0};
    const double top = strain * y(n_free_ + n_grip_);
    for (int j = 0; j < n; ++j) // halves move with their grip
      rest.u[j] = is_separated && !is_constrained(j) ? std::copysign(top, y(j)) : strain * y(j);
    using Matrix = Eigen::SparseMatrix<double>;
    for (int step = 0; step < most_steps; ++step)
    {
      std::vector<Eigen::Triplet<double>> entries;
      Eigen::VectorXd force = Eigen::VectorXd::Zero(n_free_);
      rest.energy = 0;
      const auto add = [&](int a, int b, double value)
      {
        if (!is_constrained(a) && !is_constrained(b))
          entries.emplace_back(a - n_grip_, b - n_grip_, value);
      };
      for (const Row &row : rows_)
        for (int a = 0, b = row.k; b < n; ++a, ++b)
        {
          if (is_separated && a < n / 2 && b >= n / 2)
            continue;
          const double q = row.way * (rest.u[b] - rest.u[a]),
                       pull = row.strength * row.way * q * shape_.derivative(q * q),
                       slope = row.strength * row.way * row.way * shape_.tangent(q * q);
          rest.energy += .5 * h_ * row.strength * shape_.value(q * q);
          if (!is_constrained(a))
            force[a - n_grip_] += pull;
          if (!is_constrained(b))
            force[b - n_grip_] -= pull;
          add(a, a, slope);
          add(b, b, slope);
          add(a, b, -slope);
          add(b, a, -slope);
        }
      Matrix stiffness(n_free_, n_free_);
      stiffness.setFromTriplets(entries.begin(), entries.end());
      const Eigen::SimplicialLDLT<Matrix> solver(stiffness);
      if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 0))
        break; // unstable
      const Eigen::VectorXd change = solver.solve(force);
      for (int i = 0; i < n_free_; ++i)
        rest.u[n_grip_ + i] += change[i];
      if (change.lpNorm<Eigen::Infinity>() <= tolerance * top)
        return rest;
    }
    std::ostringstream message;
    message << "the strip is not stable at the strain " << strain << ", before it has a crack; "
            << "lower the horizon or the load";
    throw NumericalError(message.str());
  }

  double CrackColumn::threshold() const
  {
    const auto excess = [&](double g)
    { return relax(g, false).energy - relax(g, true).energy - toughness_; };
    const double most = most_strain();
    if (!(excess(most) > 0))
      throw NumericalError("bonds soften all over the strip before a crack can grow; lower the "
                           "horizon or raise the height");
    // to 1e-12: equilibria are known to 1e-13
    double low = 0, high = most;
    while (high - low > 1e-12 * most)
    {
      const double middle = .5 * (low + high);
      (excess(middle) < 0 ? low : high) = middle;
    }
    return density(low) * height();
  }
} // namespace plumbline::meshfree
