#include "reference/mesh/rectangle_pairs.h"

#include "reference/shapes.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>

namespace plumbline::reference
{
  namespace
  {
    /// Accuracy of what is integrated by rules for smooth functions.
    constexpr double accuracy = 1e-14;

    void lagrange(const std::vector<double> &nodes, double x, double *values)
    {
      for (std::size_t a = 0; a < nodes.size(); ++a)
      {
        values[a] = 1;
        for (std::size_t b = 0; b < nodes.size(); ++b)
          if (b != a)
            values[a] *= (x - nodes[b]) / (nodes[a] - nodes[b]);
      }
    }
  } // namespace

  RectanglePairs::RectanglePairs(const CellShapes &shapes, const KernelEntries &profile,
                                 double horizon, geometry::Backend backend)
      : shapes_(shapes), profile_(profile), ball_{Point<2>(), horizon}, backend_(backend),
        n_axis_(shapes.degree() + 1), n_modes_(2 * shapes.degree() + 2)
  {
    const dealii::QGauss<1> gauss(n_modes_);
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      gauss_points_.push_back(gauss.point(q)[0]);
      gauss_weights_.push_back(gauss.weight(q));
    }
    moments_.resize(profile.n_entries() * n_modes_ * n_modes_);
  }

  std::vector<RectanglePairs::Piece> RectanglePairs::correlate(double outer_lower,
                                                               double outer_upper,
                                                               double inner_lower,
                                                               double inner_upper) const
  {
    std::array<double, 4> breaks = {inner_lower - outer_upper, inner_lower - outer_lower,
                                    inner_upper - outer_upper, inner_upper - outer_lower};
    std::sort(breaks.begin(), breaks.end());
    const double outer_size = outer_upper - outer_lower, inner_size = inner_upper - inner_lower;
    const double reach = ball_.radius, sliver = 1e-14 * (outer_size + inner_size);

    std::vector<Piece> pieces;
    std::vector<double> mode(n_modes_), phi(n_axis_), psi(n_axis_);
    for (unsigned int k = 0; k < 3; ++k)
    {
      Piece piece{breaks[k], breaks[k + 1], {}};
      if (piece.upper - piece.lower <= sliver || piece.lower >= reach || piece.upper <= -reach)
        continue;
      for (auto &series : piece.series)
        series.assign(n_axis_ * n_axis_ * n_modes_, 0.);
      for (unsigned int q = 0; q < n_modes_; ++q)
      {
        const double shift = piece.lower + gauss_points_[q] * (piece.upper - piece.lower);
        const double from = std::max(outer_lower, inner_lower - shift);
        const double to = std::min(outer_upper, inner_upper - shift);
        legendre(2 * gauss_points_[q] - 1, n_modes_, mode.data());
        for (unsigned int m = 0; m < n_modes_; ++m)
          mode[m] *= (2 * m + 1) * gauss_weights_[q];
        for (unsigned int p = 0; p < n_modes_; ++p) // more points than needed, but at hand
        {
          const double x = from + gauss_points_[p] * (to - from);
          const double weight = gauss_weights_[p] * (to - from);
          lagrange(shapes_.axis_nodes(), (x - outer_lower) / outer_size, phi.data());
          lagrange(shapes_.axis_nodes(), (x + shift - inner_lower) / inner_size, psi.data());
          for (unsigned int a = 0; a < n_axis_; ++a)
            for (unsigned int b = 0; b < n_axis_; ++b)
            {
              const double product[n_kinds] = {phi[a] * phi[b], phi[a] * psi[b], psi[a] * psi[b]};
              for (unsigned int kind = 0; kind < n_kinds; ++kind)
                for (unsigned int m = 0; m < n_modes_; ++m)
                  piece.series[kind][(a * n_axis_ + b) * n_modes_ + m] +=
                      weight * product[kind] * mode[m];
            }
        }
      }
      pieces.push_back(std::move(piece));
    }
    return pieces;
  }

  void RectanglePairs::moments(const Piece &x, const Piece &y)
  {
    const std::array<Point<2>, 4> corners = {
        {Point<2>(x.lower, y.lower), Point<2>(x.upper, y.lower), Point<2>(x.upper, y.upper),
         Point<2>(x.lower, y.upper)}};
    const Point<2> centre(.5 * (x.lower + x.upper), .5 * (y.lower + y.upper));
    const double radius = centre.distance(corners[0]);
    std::fill(moments_.begin(), moments_.end(), 0.);
    profile_.for_balls(centre.norm() - radius, centre.norm() + radius,
                       [&](double ball_radius, const SmoothEntries &kernel)
                       {
                         find_rule(ball_radius, corners, kernel);
                         add_moments(x, y, kernel);
                       });
  }

  /// rule_ on ball ∩ rectangle.
  void RectanglePairs::find_rule(double ball_radius, const std::array<Point<2>, 4> &corners,
                                 const SmoothEntries &kernel)
  {
    const geometry::Ball ball{Point<2>(), ball_radius};
    const Point<2> centre = corners[0] + .5 * (corners[2] - corners[0]);
    const double radius = centre.distance(corners[0]);
    const unsigned int series_degree = 2 * (n_modes_ - 1);
    const unsigned int of_function = kernel.degree_of_function(2 * radius);
    if (kernel.is_smooth())
      geometry::cut_rule(ball, geometry::view(corners), series_degree + kernel.degree(2 * radius),
                         rule_, backend_);
    else if (centre.norm() < 3 * radius)
      geometry::polar_rule(ball, geometry::view(corners), 16 + of_function / 2,
                           std::max(10u, n_modes_ + 6) + of_function / 2, rule_, backend_);
    else
      geometry::cut_rule(ball, geometry::view(corners),
                         series_degree + of_function +
                             degree_away_from_singularity(centre.norm(), radius, accuracy),
                         rule_, backend_);
  }

  void RectanglePairs::add_moments(const Piece &x, const Piece &y, const SmoothEntries &kernel)
  {
    std::array<double, 2 * CellShapes::most> p{}, q{};
    for (std::size_t i = 0; i < rule_.points.size(); ++i)
    {
      const Point<2> &z = rule_.points[i];
      legendre(2 * (z[0] - x.lower) / (x.upper - x.lower) - 1, n_modes_, p.data());
      legendre(2 * (z[1] - y.lower) / (y.upper - y.lower) - 1, n_modes_, q.data());
      double entries[3];
      if (kernel.is_tensor())
        kernel.operator()<3>(z[0], z[1], entries);
      else
        kernel.operator()<1>(z[0], z[1], entries);
      double *moment = moments_.data();
      for (unsigned int e = 0; e < kernel.n_entries(); ++e)
        for (unsigned int m = 0; m < n_modes_; ++m)
        {
          const double row = rule_.weights[i] * entries[e] * p[m];
          for (unsigned int n = 0; n < n_modes_; ++n)
            *moment++ += row * q[n];
        }
    }
  }

  void RectanglePairs::contract(const Piece &x, const Piece &y, PairBlocks &blocks)
  {
    const unsigned int n = shapes_.size(), n_entries = profile_.n_entries();
    std::vector<double> *const block[n_kinds] = {&blocks.outer, &blocks.cross, &blocks.inner};
    std::array<double, 2 * CellShapes::most> along_y{};
    for (unsigned int kind = 0; kind < n_kinds; ++kind)
      for (unsigned int e = 0; e < n_entries; ++e)
        for (unsigned int pair_x = 0; pair_x < n_axis_ * n_axis_; ++pair_x)
        {
          const double *const series_x = &x.series[kind][pair_x * n_modes_];
          std::fill(along_y.begin(), along_y.begin() + n_modes_, 0.);
          for (unsigned int m = 0; m < n_modes_; ++m)
            for (unsigned int l = 0; l < n_modes_; ++l)
              along_y[l] += series_x[m] * moments_[(e * n_modes_ + m) * n_modes_ + l];
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
            {
              const auto &i = shapes_.axis_index(a), &j = shapes_.axis_index(b);
              if (i[0] * n_axis_ + j[0] != pair_x)
                continue;
              const double *const series_y = &y.series[kind][(i[1] * n_axis_ + j[1]) * n_modes_];
              double sum = 0;
              for (unsigned int l = 0; l < n_modes_; ++l)
                sum += series_y[l] * along_y[l];
              (*block[kind])[(a * n + b) * n_entries + e] += sum;
            }
        }
  }

  void RectanglePairs::integrate(const geometry::Box &outer, const geometry::Box &inner,
                                 PairBlocks &blocks)
  {
    blocks.reset(shapes_.size(), profile_.n_entries());
    const auto along_x = correlate(outer.lower[0], outer.upper[0], inner.lower[0], inner.upper[0]);
    const auto along_y = correlate(outer.lower[1], outer.upper[1], inner.lower[1], inner.upper[1]);
    for (const Piece &x : along_x)
      for (const Piece &y : along_y)
      {
        const double dx = std::max({x.lower, -x.upper, 0.}), dy = std::max({y.lower, -y.upper, 0.});
        if (dx * dx + dy * dy >= ball_.radius * ball_.radius)
          continue;
        moments(x, y);
        contract(x, y, blocks);
      }
  }
} // namespace plumbline::reference
