#include "reference/lattice/solid_stencil.h"

#include "physics/dilatation_in_space.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace plumbline::reference
{
  namespace
  {
    using geometry::Point;
    using Cell = std::array<int, 3>; ///< [i, i+1] × [j, j+1] × [k, k+1] h

    constexpr unsigned int n_angles = 20, n_radii = 16; ///< Gauss points of an interval

    struct Rule
    {
      std::vector<Point<3>> points;
      std::vector<double> weights;
    };

    const dealii::QGauss<1> &gauss(unsigned int n)
    {
      static const dealii::QGauss<1> angles(n_angles), radii(n_radii);
      return n == n_angles ? angles : radii;
    }

    /// The square with lower corner (a, b), a, b >= 0, in polar coordinates about the origin.
    struct Square
    {
      double a, b, side;

      std::vector<double> breaks(double radius1, double radius2) const;
      double entry(double phi) const
      {
        return std::max(a == 0 ? 0 : a / std::cos(phi), b == 0 ? 0 : b / std::sin(phi));
      }
      double exit(double phi) const
      {
        return std::min((a + side) / std::cos(phi), (b + side) / std::sin(phi));
      }
    };

    /// Angles between which the bounds of the radius are smooth: corners, and where the circles
    /// cross the sides.
    std::vector<double> Square::breaks(double radius1, double radius2) const
    {
      const double lowest = std::atan2(b, a + side), highest = std::atan2(b + side, a);
      std::vector<double> result = {lowest, highest, std::atan2(b + side, a + side)};
      if (a > 0 || b > 0)
        result.push_back(std::atan2(b, a));
      for (const double radius : {radius1, radius2})
        for (const double offset : {0., side})
        {
          if (const double x = a + offset; x < radius)
            result.push_back(std::atan2(std::sqrt(radius * radius - x * x), x));
          if (const double y = b + offset; y < radius)
            result.push_back(std::atan2(y, std::sqrt(radius * radius - y * y)));
        }
      for (double &phi : result)
        phi = std::clamp(phi, lowest, highest);
      std::sort(result.begin(), result.end());
      return result;
    }

    /// f(φ, from, to, weight): the radii of the square between two circles, for Gauss points in
    /// the angle, which stand densely at breaks, where bounds may have square roots.
    template <typename Function>
    void for_each_angle(const Square &square, double radius1, double radius2, const Function &f)
    {
      const std::vector<double> breaks = square.breaks(radius1, radius2);
      const auto &rule = gauss(n_angles);
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      {
        const double length = breaks[i + 1] - breaks[i];
        for (unsigned int q = 0; q < rule.size() && length > 1e-15; ++q)
        {
          const double x = rule.point(q)[0],
                       phi = breaks[i] + length * .5 * (1 - std::cos(M_PI * x));
          const double from = std::max(square.entry(phi), radius1),
                       to = std::min(square.exit(phi), radius2);
          if (from < to)
            f(phi, from, to, rule.weight(q) * length * .5 * M_PI * std::sin(M_PI * x));
        }
      }
    }

    /// A kernel across I + excess z⊗z/|z|² that is smooth between two spheres.
    struct Shell
    {
      double inner = 0, outer = 0;
      std::function<physics::DilatationInSpace::Value(double r)> value;
    };

    /// Kernels of smooth profiles that add up to the bonds, and the two shells of the dilatation.
    std::vector<Shell> shells(const physics::Kernel<3> &kernel,
                              const std::optional<physics::Dilatation<3>> &dilatation)
    {
      using Value = physics::DilatationInSpace::Value;
      const bool is_scalar = kernel.structure() == physics::Structure::scalar;
      std::vector<Shell> result;
      for (const physics::Kernel<3> &part : kernel.parts())
        result.push_back({0, part.horizon(),
                          [part, is_scalar](double r)
                          {
                            const double value = part.radial(r);
                            return is_scalar ? Value{value, 0} : Value{0, value};
                          }});
      if (dilatation)
      {
        const physics::DilatationInSpace of_dilatation(dilatation->influence);
        const physics::Lame lame = dilatation->material({});
        const double factor = dilatation->factor(lame, lame), horizon = kernel.horizon();
        for (const double inner : {0., horizon})
          result.push_back({inner, inner + horizon,
                            [of_dilatation, factor](double r)
                            {
                              const Value value = of_dilatation(r);
                              return Value{factor * value.across, factor * value.excess};
                            }});
      }
      return result;
    }

    /// Quadrature on cell ∩ shell along rays from the cell's corner nearest to the origin: cell ∩
    /// outer ball is star-shaped about this corner, and each ray leaves the inner ball at most
    /// once.
    class Cones
    {
    public:
      Cones(const Cell &cell, double h, const Shell &shell)
          : h_(h), inner_(shell.inner), radius_(shell.outer),
            apex_(cell[0] * h, cell[1] * h, cell[2] * h)
      {
        for (unsigned int d = 0; d < 3; ++d)
          add_face(d);
        add_patch();
      }

      Rule rule;

    private:
      /// The cone over a surface element: weight times its distance from the apex along the normal.
      void add(const Point<3> &y, double weight)
      {
        const auto &along = gauss(n_radii);
        const double first = exit_of_inner(y);
        for (unsigned int q = 0; q < along.size(); ++q)
        {
          const double t = first + (1 - first) * along.point(q)[0];
          rule.points.push_back(apex_ + t * (y - apex_));
          rule.weights.push_back(weight * t * t * (1 - first) * along.weight(q));
        }
      }

      /// Where the ray from the apex, at 0, to y, at 1, leaves the inner ball.
      double exit_of_inner(const Point<3> &y) const
      {
        const double depth = inner_ * inner_ - apex_.square();
        if (depth <= 0)
          return 0;
        const auto ray = y - apex_;
        const double along = apex_ * ray, square = ray.norm_square();
        return std::min(1., depth / (along + std::sqrt(along * along + square * depth)));
      }

      /// The face away from the origin, normal to axis d.
      void add_face(unsigned int d)
      {
        const unsigned int e = (d + 1) % 3, f = (d + 2) % 3;
        const double x = apex_[d] + h_;
        if (x >= radius_)
          return;
        const auto &across = gauss(n_radii);
        for_each_angle({apex_[e], apex_[f], h_}, std::sqrt(std::max(0., inner_ * inner_ - x * x)),
                       std::sqrt(radius_ * radius_ - x * x),
                       [&](double phi, double from, double to, double weight)
                       {
                         for (unsigned int q = 0; q < across.size(); ++q)
                         {
                           const double r = from + (to - from) * across.point(q)[0];
                           Point<3> y;
                           y[d] = x;
                           y[e] = r * std::cos(phi);
                           y[f] = r * std::sin(phi);
                           add(y, weight * (to - from) * across.weight(q) * r * h_);
                         }
                       });
      }

      /// The part of the sphere in the cell, in polar angles from the first axis.
      void add_patch()
      {
        const auto squared = [&](double x) { return std::max(0., radius_ * radius_ - x * x); };
        const auto &across = gauss(n_radii);
        for_each_angle({apex_[1], apex_[2], h_}, std::sqrt(squared(apex_[0] + h_)),
                       std::sqrt(squared(apex_[0])),
                       [&](double phi, double from, double to, double weight)
                       {
                         const double first = std::asin(std::min(1., from / radius_)),
                                      last = std::asin(std::min(1., to / radius_));
                         for (unsigned int q = 0; q < across.size(); ++q)
                         {
                           const double gamma = first + (last - first) * across.point(q)[0];
                           const Point<3> n(std::cos(gamma), std::sin(gamma) * std::cos(phi),
                                            std::sin(gamma) * std::sin(phi));
                           const double distance = radius_ - n * apex_;
                           add(radius_ * n, weight * (last - first) * across.weight(q) * distance *
                                                radius_ * radius_ * std::sin(gamma));
                         }
                       });
      }

      double h_, inner_, radius_;
      Point<3> apex_;
    };

    /// A cell inside the shell, away from the origin.
    Rule product_rule(const Cell &cell, double h)
    {
      Rule rule;
      const auto &axis = gauss(n_radii);
      for (unsigned int i = 0; i < axis.size(); ++i)
        for (unsigned int j = 0; j < axis.size(); ++j)
          for (unsigned int k = 0; k < axis.size(); ++k)
          {
            rule.points.emplace_back((cell[0] + axis.point(i)[0]) * h,
                                     (cell[1] + axis.point(j)[0]) * h,
                                     (cell[2] + axis.point(k)[0]) * h);
            rule.weights.push_back(h * h * h * axis.weight(i) * axis.weight(j) * axis.weight(k));
          }
      return rule;
    }

    double distance(int i, int j, int k)
    {
      return std::sqrt(static_cast<double>(i * i + j * j + k * k));
    }

    constexpr std::array<std::array<unsigned int, 3>, 3> pair_of = {
        {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};

    /// ∫ over cell ∩ shells of C_ab(z) P_p(x) P_q(y) P_r(z) dz, x, y, z the cell's own coordinates
    /// in [-1, 1], of the cells i >= j >= k >= 0; those of the others are images.
    class SolidMomentTable
    {
    public:
      /// @param n_components  1 or 3
      SolidMomentTable(const std::vector<Shell> &shells, double h, unsigned int n_components,
                       unsigned int n_modes)
          : n_(static_cast<int>(std::ceil(shells.back().outer / h * (1 - 1e-14)))),
            n_modes_(n_modes), n_pairs_(n_components == 1 ? 1 : 6)
      {
        for (int i = 0; i < n_; ++i)
          for (int j = 0; j <= i; ++j)
            for (int k = 0; k <= j; ++k)
            {
              std::vector<double> moments;
              for (const Shell &shell : shells)
                integrate(shell, h, {i, j, k}, moments);
              sorted_.push_back(std::move(moments));
            }
      }

      int n_cells() const { return n_; }

      /// The moments of component a, b of any cell, shape (n_modes, n_modes, n_modes), [p][q][r];
      /// none outside the ball.
      std::vector<double> of(const Cell &cell, unsigned int a, unsigned int b) const
      {
        const auto fold = [](int i) { return i < 0 ? -i - 1 : i; };
        std::array<unsigned int, 3> axis{0, 1, 2}, place{};
        std::stable_sort(axis.begin(), axis.end(),
                         [&](unsigned int d, unsigned int e)
                         { return fold(cell[d]) > fold(cell[e]); });
        for (unsigned int s = 0; s < 3; ++s)
          place[axis[s]] = s;
        const std::vector<double> &moments =
            sorted_[slot({fold(cell[axis[0]]), fold(cell[axis[1]]), fold(cell[axis[2]])})];
        std::vector<double> result;
        if (moments.empty())
          return result;
        const unsigned int pair = n_pairs_ == 1 ? 0 : pair_of[place[a]][place[b]];
        std::array<unsigned int, 3> m{};
        for (m[0] = 0; m[0] < n_modes_; ++m[0])
          for (m[1] = 0; m[1] < n_modes_; ++m[1])
            for (m[2] = 0; m[2] < n_modes_; ++m[2])
            {
              double sign = 1;
              for (unsigned int d = 0; d < 3; ++d)
                if (cell[d] < 0 && (m[d] + (a == d) + (b == d)) % 2 == 1)
                  sign = -sign;
              result.push_back(
                  sign *
                  moments[((pair * n_modes_ + m[axis[0]]) * n_modes_ + m[axis[1]]) * n_modes_ +
                          m[axis[2]]]);
            }
        return result;
      }

    private:
      static std::size_t slot(const Cell &c)
      {
        const std::size_t i = c[0], j = c[1], k = c[2];
        return i * (i + 1) * (i + 2) / 6 + j * (j + 1) / 2 + k;
      }
      void integrate(const Shell &shell, double h, const Cell &cell,
                     std::vector<double> &moments) const;

      int n_;
      unsigned int n_modes_, n_pairs_;
      std::vector<std::vector<double>> sorted_;
    };

    void SolidMomentTable::integrate(const Shell &shell, double h, const Cell &cell,
                                     std::vector<double> &moments) const
    {
      const double nearest = h * distance(cell[0], cell[1], cell[2]),
                   farthest = h * distance(cell[0] + 1, cell[1] + 1, cell[2] + 1);
      if (nearest >= shell.outer || farthest <= shell.inner)
        return;
      const bool is_whole = cell[0] > 0 && nearest >= shell.inner && farthest <= shell.outer;
      const Rule rule = is_whole ? product_rule(cell, h) : Cones(cell, h, shell).rule;

      moments.resize(n_pairs_ * n_modes_ * n_modes_ * n_modes_);
      std::array<std::vector<double>, 3> values;
      values.fill(std::vector<double>(n_modes_));
      for (std::size_t i = 0; i < rule.points.size(); ++i)
      {
        const Point<3> &z = rule.points[i];
        for (unsigned int d = 0; d < 3; ++d)
          legendre(2 * (z[d] / h - cell[d]) - 1, n_modes_, values[d].data());
        const physics::DilatationInSpace::Value value = shell.value(z.norm());
        const double across = rule.weights[i] * value.across,
                     directed = rule.weights[i] * value.excess / z.square();
        double *moment = moments.data();
        for (unsigned int a = 0, pair = 0; a < 3; ++a)
          for (unsigned int b = a; b < 3 && pair < n_pairs_; ++b, ++pair)
          {
            const double factor = (a == b ? across : 0) + directed * z[a] * z[b];
            for (unsigned int p = 0; p < n_modes_; ++p)
              for (unsigned int q = 0; q < n_modes_; ++q)
              {
                const double row = factor * values[0][p] * values[1][q];
                for (unsigned int r = 0; r < n_modes_; ++r)
                  *moment++ += row * values[2][r];
              }
          }
      }
    }

    /// Two families along an axis and how far apart, with their correlation's Legendre series.
    struct AxisPair
    {
      unsigned int s, t;
      int d;
      const double *series;
    };

    std::vector<AxisPair> axis_pairs(const Correlations &r, unsigned int n_axis)
    {
      std::vector<AxisPair> pairs;
      for (unsigned int s = 0; s < n_axis; ++s)
        for (unsigned int t = 0; t < n_axis; ++t)
          for (int d = Correlations::first_interval; d < -Correlations::first_interval; ++d)
            if (const double *const series = r.coefficients(s, t, d); series != nullptr)
              pairs.push_back({s, t, d, series});
      return pairs;
    }

    /// Σ_p series[p] moments[p][...]
    std::vector<double> contract(const double *series, unsigned int n_modes,
                                 const std::vector<double> &moments)
    {
      const std::size_t n = moments.size() / n_modes;
      std::vector<double> result(n);
      for (unsigned int p = 0; p < n_modes; ++p)
        for (std::size_t i = 0; i < n; ++i)
          result[i] += series[p] * moments[p * n + i];
      return result;
    }

    /// What one cell of the ball adds to the stencil of one pair of components.
    void subtract_cell(algebra::Stencil &stencil, const std::vector<AxisPair> &pairs,
                       unsigned int n_axis, unsigned int n_modes, const Cell &cell, unsigned int a,
                       unsigned int b, const std::vector<double> &moments)
    {
      const unsigned int n_families = n_axis * n_axis * n_axis;
      for (const AxisPair &x : pairs)
      {
        const std::vector<double> plane = contract(x.series, n_modes, moments);
        for (const AxisPair &y : pairs)
        {
          const std::vector<double> line = contract(y.series, n_modes, plane);
          for (const AxisPair &z : pairs)
            stencil(a * n_families + x.s + n_axis * (y.s + n_axis * z.s),
                    b * n_families + x.t + n_axis * (y.t + n_axis * z.t), cell[0] - x.d,
                    cell[1] - y.d, cell[2] - z.d) -=
                std::inner_product(line.begin(), line.end(), z.series, 0.);
        }
      }
    }

    /// ∫ C_ab times the overlaps of the shape functions themselves.
    void add_mass(algebra::Stencil &stencil, const Correlations &r, unsigned int n_axis,
                  unsigned int a, unsigned int b, double mass)
    {
      const unsigned int n_families = n_axis * n_axis * n_axis;
      for (unsigned int s = 0; s < n_families; ++s)
        for (unsigned int t = 0; t < n_families; ++t)
          for (int k3 = -1; k3 <= 1; ++k3)
            for (int k2 = -1; k2 <= 1; ++k2)
              for (int k1 = -1; k1 <= 1; ++k1)
                stencil(a * n_families + s, b * n_families + t, k1, k2, k3) +=
                    mass * r(s % n_axis, t % n_axis, -k1) *
                    r(s / n_axis % n_axis, t / n_axis % n_axis, -k2) *
                    r(s / n_axis / n_axis, t / n_axis / n_axis, -k3);
    }
  } // namespace

  algebra::Stencil galerkin_stencil(const physics::Kernel<3> &kernel, double h,
                                    const AxisShapes &shapes,
                                    const std::optional<physics::Dilatation<3>> &dilatation)
  {
    const Correlations r(shapes);
    const unsigned int n_modes = r.n_modes();
    const auto n_axis = static_cast<unsigned int>(shapes.families().size());
    const unsigned int n_families = n_axis * n_axis * n_axis, n_components = kernel.n_components();
    const std::vector<AxisPair> pairs = axis_pairs(r, n_axis);
    const SolidMomentTable table(shells(kernel, dilatation), h, n_components, n_modes);
    const int n = table.n_cells();

    algebra::Stencil stencil(n_components * n_families, {n + 1, n + 1, n + 1});
    for (unsigned int a = 0; a < n_components; ++a)
      for (unsigned int b = 0; b < n_components; ++b)
      {
        double mass = 0; // ∫ C_ab as the sum of the cells, so that constants give zero
        for (int k = -n; k < n; ++k)
          for (int j = -n; j < n; ++j)
            for (int i = -n; i < n; ++i)
            {
              std::vector<double> moments = table.of({i, j, k}, a, b);
              if (moments.empty())
                continue;
              for (double &moment : moments)
                moment *= h * h * h;
              mass += moments[0];
              subtract_cell(stencil, pairs, n_axis, n_modes, {i, j, k}, a, b, moments);
            }
        add_mass(stencil, r, n_axis, a, b, mass);
      }
    return stencil;
  }
} // namespace plumbline::reference
