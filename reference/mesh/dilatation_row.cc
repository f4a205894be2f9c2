#include "reference/mesh/dilatation_row.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace plumbline::reference
{
  namespace
  {
    /// Relative, of rules for influence functions that are no polynomials.
    constexpr double accuracy = 1e-13;
    /// Angles that suffice between any two corners for a function times 1/r (`polar_rule`).
    constexpr unsigned int most_angles = 16;

    /// Exact to degree 2 n - 1.
    dealii::Quadrature<2> gauss(unsigned int n_vertices, unsigned int n)
    {
      constexpr unsigned int most = 7;
      if (n_vertices == 4)
        return dealii::QGauss<2>(n);
      if (n <= most)
        return dealii::QWitherdenVincentSimplex<2>(n);
      return dealii::QDuffy(n + 1, 1.);
    }

    std::vector<ShapeRule> whole_rules(const CellShapes &shapes)
    {
      constexpr unsigned int n_rules = 11; // beyond, polar rules cost less
      std::vector<ShapeRule> rules;
      for (unsigned int n = 1; n <= n_rules; ++n)
      {
        const dealii::Quadrature<2> points = gauss(shapes.n_vertices(), n);
        ShapeRule rule{points.get_points(), points.get_weights(), {}};
        rule.phi.resize(points.size() * shapes.size());
        for (unsigned int q = 0; q < points.size(); ++q)
          shapes.values(rule.unit[q], &rule.phi[q * shapes.size()]);
        rules.push_back(std::move(rule));
      }
      return rules;
    }
  } // namespace

  DilatationRow::DilatationRow(const MeshSpace &space, const MeshCells &cells,
                               const physics::Dilatation<2> &dilatation,
                               std::vector<physics::Lame> materials, unsigned int smooth_degree,
                               geometry::Backend backend, Correction correction,
                               std::vector<geometry::Cut> cracks)
      : space_(space), cells_(cells), dilatation_(dilatation), profile_(dilatation.influence),
        materials_(std::move(materials)), smooth_degree_(smooth_degree), backend_(backend),
        correction_(correction), cracks_(std::move(cracks)),
        degree_(std::max(space.shapes().degree(), correction == Correction::none ? 0u : 1u)),
        whole_(whole_rules(space.shapes())), theta_(2 * space.shapes().size()),
        test_(2 * space.shapes().size())
  {
  }

  void DilatationRow::evaluate(std::size_t cell, const Point<2> &unit,
                               const std::vector<unsigned int> &near,
                               const std::vector<const double *> &known,
                               const std::vector<unsigned int> &slot, std::vector<double> &theta,
                               std::vector<double> &test)
  {
    const unsigned int n = space_.shapes().size();
    const Point<2> x = space_.map(cell).point(unit);
    own_ = materials_.empty() ? dilatation_.material(x) : materials_[cell];
    std::fill(theta.begin(), theta.end(), 0.);
    std::fill(test.begin(), test.end(), 0.);
    moment_.clear();
    std::array<double, 2> theta_sum{}, test_sum{};
    for (std::size_t k = 0; k < near.size(); ++k)
    {
      const unsigned int inner = near[k];
      if (x.distance(cells_.centroid(inner)) >=
          dilatation_.influence.horizon() + cells_.radius(inner))
        continue;
      const double *const part = known.empty() ? integrate_visible(x, inner).data() : known[k];
      const double factor = is_geometry_alone() ? factor_of(inner) : 1;
      const double *const of_test = is_geometry_alone() ? part : test_.data();
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int c = 0; c < 2; ++c)
        {
          const std::size_t to = 2 * slot[space_.dofs(inner)[a]] + c;
          theta[to] += part[2 * a + c];
          theta_sum[c] += part[2 * a + c];
          const double value = factor * of_test[2 * a + c];
          test[to] += value;
          test_sum[c] += value;
        }
    }
    phi_.resize(n);
    space_.shapes().values(unit, phi_.data());
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int c = 0; c < 2; ++c)
      {
        const std::size_t to = 2 * slot[space_.dofs(cell)[a]] + c;
        theta[to] -= phi_[a] * theta_sum[c];
        test[to] -= phi_[a] * test_sum[c];
      }
    if (correction_ == Correction::none || !known.empty())
      return;
    const dealii::Tensor<2, 2> correction = invert(moment_);
    const auto correct = [&](std::vector<double> &row)
    {
      for (auto xi = row.begin(); xi != row.end(); xi += 2)
      {
        const auto corrected = correction * dealii::Tensor<1, 2>({xi[0], xi[1]});
        std::copy(corrected.begin_raw(), corrected.end_raw(), xi);
      }
    };
    correct(theta);
    if (correction_ == Correction::energy)
      correct(test);
  }

  /// f of x and a cell.
  double DilatationRow::factor_of(std::size_t inner) const
  {
    return dilatation_.factor(own_, dilatation_.is_symmetric() ? own_ : materials_[inner]);
  }

  const std::vector<double> &DilatationRow::integrate(const Point<2> &x, std::size_t inner)
  {
    std::fill(theta_.begin(), theta_.end(), 0.);
    std::fill(test_.begin(), test_.end(), 0.);
    add_region(x, cells_[inner], inner);
    return theta_;
  }

  /// Of what is seen of the cell from x.
  const std::vector<double> &DilatationRow::integrate_visible(const Point<2> &x, std::size_t inner)
  {
    const auto vertices = cells_[inner].vertices();
    const geometry::Sight sight = geometry::find_between(cracks_, {&x, 1}, vertices, between_);
    if (sight == geometry::Sight::clear)
      return integrate(x, inner);
    std::fill(theta_.begin(), theta_.end(), 0.);
    std::fill(test_.begin(), test_.end(), 0.);
    if (sight == geometry::Sight::hidden)
      return theta_;
    geometry::find_visible(x, vertices, between_, seen_);
    for (const geometry::Polygon &part : seen_)
      add_region(x, geometry::ConvexCell(part), inner);
    return theta_;
  }

  /// @param region  the cell, or a part of it
  void DilatationRow::add_region(const Point<2> &x, const geometry::ConvexCell &region,
                                 std::size_t inner)
  {
    const double distance = x.distance(cells_.centroid(inner)), radius = cells_.radius(inner);
    profile_.for_balls(distance - radius, distance + radius,
                       [&](double ball_radius, const SmoothEntries &influence) {
                         add_ball({x, ball_radius}, influence, region, inner);
                       });
  }

  /// An influence function without breaks on ball ∩ region.
  void DilatationRow::add_ball(const geometry::Ball &ball, const SmoothEntries &influence,
                               const geometry::ConvexCell &region, std::size_t inner)
  {
    const Point<2> &x = ball.centre;
    const double *phi = find_rule(ball, influence, region, inner);
    const std::size_t n = space_.shapes().size();
    for (std::size_t q = 0; q < rule_.points.size(); ++q, phi += n)
    {
      const Point<2> &y = rule_.points[q];
      const double xi[2] = {y[0] - x[0], y[1] - x[1]};
      double k;
      influence.operator()<1>(xi[0], xi[1], &k);
      k *= rule_.weights[q];
      if (correction_ != Correction::none)
        moment_ += k * outer_product(dealii::Tensor<1, 2>(xi), dealii::Tensor<1, 2>(xi));
      for (std::size_t a = 0; a < n; ++a)
      {
        theta_[2 * a] += k * xi[0] * phi[a];
        theta_[2 * a + 1] += k * xi[1] * phi[a];
      }
      if (!is_geometry_alone())
      {
        k *= dilatation_.factor(own_, dilatation_.material(y));
        for (std::size_t a = 0; a < n; ++a)
        {
          test_[2 * a] += k * xi[0] * phi[a];
          test_[2 * a + 1] += k * xi[1] * phi[a];
        }
      }
    }
  }

  /// rule_ on ball(x) ∩ region. @return  shape functions at its points, shape (n_points, n_shapes)
  const double *DilatationRow::find_rule(const geometry::Ball &ball, const SmoothEntries &influence,
                                         const geometry::ConvexCell &region, std::size_t inner)
  {
    const Point<2> &x = ball.centre;
    const CellShapes &shapes = space_.shapes();
    const CellMap &map = space_.map(inner);
    const double distance = x.distance(cells_.centroid(inner)), radius = cells_.radius(inner);
    const unsigned int smooth = map.is_affine() && is_geometry_alone() ? 0 : smooth_degree_;
    const int highest = influence.highest_exponent(2 * radius);
    unsigned int kernel = 1 + highest;
    if (!influence.is_smooth())
      kernel += degree_away_from_singularity(distance, radius, accuracy);
    const bool is_whole =
        &region == &cells_[inner] &&
        std::all_of(region.vertices().begin(), region.vertices().end(),
                    [&](const Point<2> &v) { return v.distance(x) <= ball.radius; });
    if (const unsigned int i = (kernel + degree_ + smooth) / 2; i < whole_.size() && is_whole)
    {
      const ShapeRule &whole = whole_[i];
      rule_.points.resize(whole.unit.size());
      rule_.weights.resize(whole.unit.size());
      for (std::size_t q = 0; q < whole.unit.size(); ++q)
      {
        rule_.points[q] = map.point(whole.unit[q]);
        rule_.weights[q] = whole.weight[q] * map.determinant(whole.unit[q]);
      }
      return whole.phi.data();
    }
    // along a line shape functions of squares have twice their degree along an axis
    const unsigned int line = degree_ * (shapes.n_vertices() - 2) + smooth;
    if (influence.is_smooth())
      geometry::cut_rule(ball, region, kernel + line, rule_, backend_);
    else // along a ray Kξ and the factor r of the weights are a polynomial
      geometry::polar_rule(ball, region, std::min(most_angles, kernel / 2 + 1),
                           (2 + highest + line) / 2 + 1, rule_, backend_);
    phi_.resize(rule_.points.size() * shapes.size());
    for (std::size_t q = 0; q < rule_.points.size(); ++q)
      shapes.values(map.unit(rule_.points[q]), &phi_[q * shapes.size()]);
    return phi_.data();
  }
} // namespace plumbline::reference
