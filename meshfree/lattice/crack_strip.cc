#include "meshfree/lattice/crack_strip.h"

#include "base/error.h"

#include <deal.II/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::meshfree
{
  namespace
  {
    using Vector = std::vector<double>;

    /// way·(u_to - u_from)
    double stretch(const Vector &u, std::size_t from, std::size_t to,
                   const std::array<double, 2> &way)
    {
      const std::size_t n = u.size() / 2;
      return way[0] * (u[to] - u[from]) + way[1] * (u[n + to] - u[n + from]);
    }

    double dot(const Vector &x, const Vector &y)
    {
      return std::inner_product(x.begin(), x.end(), y.begin(), 0.);
    }

    void add(Vector &x, double factor, const Vector &y)
    {
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += factor * y[i];
    }
  } // namespace

  CrackStrip::CrackStrip(const std::vector<WellBond> &bonds, const Shape &shape,
                         const physics::WellPotential &potential)
      : bonds_(bonds), potential_(potential), column_(bonds, shape.h, shape.n[1], potential),
        h_(shape.h), n_{shape.n[0], column_.n_rows()}, n_notch_(shape.n_notch),
        force_(bonds, shape.h, n_, Exterior::empty, {}, {}, potential)
  {
    if (n_notch_ < 1 || n_notch_ >= n_[0])
      throw InputError("notch: " + std::to_string(n_notch_) + " of " + std::to_string(n_[0]) +
                       " columns; its tip must lie inside the strip");
    // crossings in units of h from the first column, and heights of half an h, are whole numbers
    const int middle = n_[1] / 2;
    for (int j = middle; j < n_[1]; ++j)
      for (int i = 0; i < n_[0]; ++i)
        for (const WellBond &bond : bonds_)
        {
          const int to_i = i + bond.k[0], to_j = j + bond.k[1];
          if (bond.strength == 0 || to_i < 0 || to_i >= n_[0] || to_j < 0 || to_j >= middle)
            continue;
          const int above = 2 * (j - middle) + 1, below = 2 * (middle - to_j) - 1;
          if (2 * (i * below + to_i * above) < (2 * n_notch_ - 1) * (above + below))
            cuts_.push_back({static_cast<std::size_t>(j) * n_[0] + i,
                             static_cast<std::size_t>(to_j) * n_[0] + to_i, bond.way,
                             bond.strength});
        }
  }

  std::size_t CrackStrip::mirror(std::size_t node) const
  {
    const std::size_t row = node / n_[0];
    return (n_[1] - 1 - row) * n_[0] + node % n_[0];
  }

  // a node and its mirror image see their bonds in the same order
  template <typename Visit>
  void CrackStrip::visit_cuts(const Visit &visit) const
  {
    for (const Cut &cut : cuts_)
    {
      visit(cut.from, cut.to, cut.way, cut.strength);
      visit(mirror(cut.from), mirror(cut.to), std::array<double, 2>{cut.way[0], -cut.way[1]},
            cut.strength);
    }
  }

  void CrackStrip::hold(Vector &f) const
  {
    const std::size_t grip = static_cast<std::size_t>(column_.n_grip()) * n_[0];
    for (const std::size_t component : {std::size_t{0}, n_nodes()})
    {
      const auto begin = f.begin() + static_cast<std::ptrdiff_t>(component),
                 end = begin + static_cast<std::ptrdiff_t>(n_nodes());
      std::fill(begin, begin + static_cast<std::ptrdiff_t>(grip), 0.);
      std::fill(end - static_cast<std::ptrdiff_t>(grip), end, 0.);
    }
  }

  void CrackStrip::force(const Vector &u, Vector &f) const
  {
    force_.force(u, f);
    visit_cuts(
        [&](std::size_t from, std::size_t to, const std::array<double, 2> &way, double strength)
        {
          const double q = stretch(u, from, to, way),
                       pull = strength * q * potential_.derivative(q * q);
          f[from] -= pull * way[0];
          f[n_nodes() + from] -= pull * way[1];
        });
    hold(f);
  }

  void CrackStrip::tangent(const Vector &u, const Vector &v, Vector &f) const
  {
    Vector free = v;
    hold(free);
    force_.tangent(u, free, f);
    cut_tangent(u, free, f);
    hold(f);
  }

  void CrackStrip::cut_tangent(const Vector &u, const Vector &v, Vector &f) const
  {
    visit_cuts(
        [&](std::size_t from, std::size_t to, const std::array<double, 2> &way, double strength)
        {
          const double q = stretch(u, from, to, way),
                       pull = strength * potential_.tangent(q * q) * stretch(v, from, to, way);
          f[from] -= pull * way[0];
          f[n_nodes() + from] -= pull * way[1];
        });
  }

  double CrackStrip::energy(const Vector &u) const
  {
    double notch = 0;
    visit_cuts(
        [&](std::size_t from, std::size_t to, const std::array<double, 2> &way, double strength)
        {
          const double q = stretch(u, from, to, way);
          notch += .25 * strength * potential_.value(q * q);
        });
    return force_.energy(u) - h_ * h_ * notch;
  }

  Vector CrackStrip::at_rest(double strain, bool is_open) const
  {
    constexpr double tolerance = 1e-10;
    constexpr int most_steps = 20000;
    const Vector none(size());
    Vector u(size()), residual(size()), product(size());
    for (std::size_t node = 0; node < n_nodes(); ++node)
      u[n_nodes() + node] = strain * y(static_cast<int>(node / n_[0]));
    // of the grips' displacements as well, which direction is 0 at
    const auto apply = [&](const Vector &v, Vector &f)
    {
      force_.tangent(none, v, f);
      if (is_open)
        cut_tangent(none, v, f);
      hold(f);
    };
    apply(u, residual);
    Vector direction = residual;
    double square = dot(residual, residual);
    const double start = square;
    for (int step = 0; step < most_steps; ++step)
    {
      if (square <= tolerance * tolerance * start)
        return u;
      apply(direction, product);
      const double length = -square / dot(direction, product);
      add(u, length, direction);
      add(residual, length, product);
      const double before = square;
      square = dot(residual, residual);
      for (std::size_t i = 0; i < direction.size(); ++i)
        direction[i] = residual[i] + square / before * direction[i];
    }
    throw NumericalError("a strip at rest: conjugate gradients do not settle in " +
                         std::to_string(most_steps) + " steps");
  }

  void CrackStrip::add_softened(const Vector &u, int row, Softened &sums) const
  {
    for (int i = 0; i < n_[0]; ++i)
    {
      const std::size_t node = static_cast<std::size_t>(row) * n_[0] + i;
      for (const WellBond &bond : bonds_)
      {
        const int to_i = i + bond.k[0], to_j = row + bond.k[1];
        if (to_i < 0 || to_i >= n_[0] || to_j < 0 || to_j >= n_[1])
          continue;
        sums.all[node] += bond.strength;
        const double q = stretch(u, node, static_cast<std::size_t>(to_j) * n_[0] + to_i, bond.way);
        if (q * q <= potential_.softening())
          continue;
        sums.strength[node] += bond.strength;
        sums.energy[node] += .25 * h_ * h_ * bond.strength * potential_.value(q * q);
      }
    }
  }

  void CrackStrip::find_tip(const Vector &u, View &view) const
  {
    double shortest = 0; // way of the bond (0, 1)
    for (const WellBond &bond : bonds_)
      if (bond.k == std::array<int, 2>{0, 1})
        shortest = bond.way[1];
    const int first = column_.n_grip(), last = n_[1] - column_.n_grip();
    const std::size_t n = n_nodes();
    const double soft = potential_.softening();
    view.tip = notch_tip();
    double before = 0;
    for (int i = n_notch_; i < n_[0]; ++i)
    {
      double largest = 0;
      int n_cracks = 0, last_soft = -n_[1];
      for (int j = first; j + 1 < last; ++j)
      {
        const std::size_t node = n + static_cast<std::size_t>(j) * n_[0] + i;
        const double q = shortest * (u[node + n_[0]] - u[node]), square = q * q;
        largest = std::max(largest, square);
        if (square <= soft)
          continue;
        n_cracks += j - last_soft > column_.n_grip() ? 1 : 0;
        last_soft = j;
      }
      if (n_cracks == 0)
      {
        if (i > n_notch_)
          view.tip += h_ * (before - soft) / (before - largest);
        return;
      }
      view.tip = x(i);
      view.n_branches = std::max(view.n_branches, n_cracks);
      before = largest;
    }
  }

  CrackStrip::View CrackStrip::view(const Vector &u) const
  {
    Softened sums{Vector(n_nodes()), Vector(n_nodes()), Vector(n_nodes())};
    dealii::parallel::apply_to_subranges(
        0, n_[1],
        [&](int from, int to)
        {
          for (int j = from; j < to; ++j)
            add_softened(u, j, sums);
        },
        16);
    visit_cuts(
        [&](std::size_t from, std::size_t to, const std::array<double, 2> &way, double strength)
        {
          const double q = stretch(u, from, to, way);
          if (q * q > potential_.softening()) // counted as soft, but there is nothing in it
            sums.energy[from] -= .25 * h_ * h_ * strength * potential_.value(q * q);
          else
            sums.strength[from] += strength;
        });
    View view;
    view.damage.resize(n_nodes());
    for (std::size_t node = 0; node < n_nodes(); ++node)
    {
      view.damage[node] = sums.strength[node] / sums.all[node];
      view.soft_energy += sums.energy[node];
    }
    find_tip(u, view);
    return view;
  }

  double CrackStrip::asymmetry(const Vector &u) const
  {
    double largest = 0;
    const std::size_t n = n_nodes();
    for (std::size_t node = 0; node < n; ++node)
    {
      const std::size_t other = mirror(node);
      largest =
          std::max({largest, std::abs(u[node] - u[other]), std::abs(u[n + node] + u[n + other])});
    }
    return largest;
  }
} // namespace plumbline::meshfree
