#include "reference/mesh/pair_quadrature.h"

#include <algorithm>
#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    /// Relative accuracy of inner rules for kernels that are smooth on a cell: a refinement of the
    /// outer rule gains about a digit.
    double inner_accuracy(unsigned int refinement)
    {
      return std::pow(.1, std::min(11u, 5 + refinement));
    }
    /// Nearer than so many radii of a cell, a kernel that is no polynomial is taken in polar form.
    constexpr double near = 2;

    /// @param farthest  a bound of the distance of the cell's points from the ball's centre
    bool is_whole(const geometry::Ball &ball, const geometry::ConvexCell &cell, double farthest)
    {
      return farthest <= ball.radius ||
             std::all_of(cell.vertices().begin(), cell.vertices().end(),
                         [&](const Point<2> &v)
                         { return (v - ball.centre).norm_square() <= ball.radius * ball.radius; });
    }
  } // namespace

  PairQuadrature::PairQuadrature(const MeshSpace &space, const MeshCells &cells,
                                 const KernelEntries &profile, double horizon,
                                 std::optional<physics::Coefficient> coefficient,
                                 unsigned int refinement, geometry::Backend backend)
      : space_(space), cells_(cells), profile_(profile), horizon_(horizon),
        coefficient_(std::move(coefficient)), refinement_(refinement),
        accuracy_(inner_accuracy(refinement)), backend_(backend),
        rules_(std::make_shared<const PairRules>(pair_rules(space.shapes(), refinement))),
        n_(space.shapes().size()),
        has_moments_(profile.is_constant() && !coefficient_ && space.shapes().degree() <= 1 &&
                     space.shapes().n_vertices() == 3)
  {
    sum_.resize(profile.n_entries());
    first_.resize(n_ * profile.n_entries());
    second_.resize(n_ * n_ * profile.n_entries());
    phi_.resize(n_);
    outer_phi_.resize(n_);
  }

  void PairQuadrature::integrate(std::size_t outer, std::size_t inner, PairBlocks &blocks,
                                 const std::vector<geometry::Cut> &between)
  {
    between_ = between;
    // loops of a length known to the compiler for linear triangles, the common case
    const bool is_linear = n_ == 3;
    if (profile_.is_tensor())
      is_linear ? integrate_as<3, 3>(outer, inner, blocks)
                : integrate_as<3, 0>(outer, inner, blocks);
    else
      is_linear ? integrate_as<1, 3>(outer, inner, blocks)
                : integrate_as<1, 0>(outer, inner, blocks);
  }

  bool PairQuadrature::is_product(std::size_t outer, std::size_t inner) const
  {
    return profile_.is_constant() && !coefficient_ && cells_.farthest(outer, inner) <= horizon_ &&
           space_.map(outer).is_affine() && space_.map(inner).is_affine();
  }

  template <int n_entries, int n_shapes>
  void PairQuadrature::integrate_as(std::size_t outer, std::size_t inner, PairBlocks &blocks)
  {
    if (between_.empty() && is_product(outer, inner))
      return integrate_constant(outer, inner, blocks);
    blocks.reset(n_, n_entries);
    const double between = cells_.centroid(outer).distance(cells_.centroid(inner));
    const bool is_smooth =
        between_.empty() && !is_cut(between, outer, inner) && !profile_.is_function() &&
        (profile_.is_smooth() || between > near * (cells_.radius(outer) + cells_.radius(inner)));
    const ShapeRule *rule = &rules_->outer;
    if (refinement_ > 0)
      rule = is_smooth ? smooth_rule(between, outer, inner) : nullptr;
    if (rule == nullptr)
      return integrate_part<n_entries, n_shapes>({0, 0, 1, false}, 0, outer, inner, blocks);
    for (std::size_t q = 0; q < rule->unit.size(); ++q)
      integrate_point<n_entries, n_shapes>(outer, inner, rule->unit[q], rule->weight[q],
                                           &rule->phi[q * n_], blocks);
  }

  /// The outer rule of a pair whose integrand is smooth in x, of a degree that its error stays
  /// below those of pairs that the circle cuts; none: it would be too high.
  const ShapeRule *PairQuadrature::smooth_rule(double between, std::size_t outer,
                                               std::size_t inner) const
  {
    const double radius = cells_.radius(outer) + cells_.radius(inner);
    const SmoothEntries &kernel = profile_.circles().back().entries;
    unsigned int degree = 2 * space_.shapes().degree();
    if (profile_.is_smooth())
      degree += kernel.degree(radius, accuracy_);
    else
      degree += degree_away_from_singularity(between, radius, 100 * accuracy_);
    if (coefficient_) // any function: its error falls with each refinement
      degree += 2 * refinement_;
    const unsigned int i = degree / 2;
    return i < rules_->whole.size() ? &rules_->whole[i] : nullptr;
  }

  template <int n_entries, int n_shapes>
  void PairQuadrature::integrate_point(std::size_t outer, std::size_t inner, const Point<2> &unit,
                                       double weight, const double *phi, PairBlocks &blocks)
  {
    const CellMap &map = space_.map(outer);
    integrate_inner<n_entries, n_shapes>(map.point(unit), inner);
    if (sum_[0] == 0 && sum_[n_entries - 1] == 0)
      return;
    weight *= map.determinant(unit);
    for (unsigned int a = 0; a < n_; ++a)
    {
      const double row = weight * phi[a];
      double *const outer_row = &blocks.outer[a * n_ * n_entries];
      double *const cross_row = &blocks.cross[a * n_ * n_entries];
      double *const inner_row = &blocks.inner[a * n_ * n_entries];
      for (unsigned int b = 0; b < n_; ++b)
        for (int e = 0; e < n_entries; ++e)
        {
          outer_row[b * n_entries + e] += row * phi[b] * sum_[e];
          cross_row[b * n_entries + e] += row * first_[b * n_entries + e];
          inner_row[b * n_entries + e] += weight * second_[(a * n_ + b) * n_entries + e];
        }
    }
  }

  template <int n_entries, int n_shapes>
  void PairQuadrature::integrate_part(const Part &part, unsigned int level, std::size_t outer,
                                      std::size_t inner, PairBlocks &blocks)
  {
    const Kink kink = find_kink(part, outer, inner);
    if (level == refinement_ || kink == Kink::at_side ||
        (3 * level >= refinement_ && kink == Kink::none))
    {
      const ShapeRule &rule =
          kink == Kink::at_side ? rules_->graded[refinement_ - level] : rules_->refined;
      for (std::size_t q = 0; q < rule.unit.size(); ++q)
      {
        const Point<2> unit = part.point(rule.unit[q]);
        space_.shapes().values(unit, outer_phi_.data());
        integrate_point<n_entries, n_shapes>(
            outer, inner, unit, rule.weight[q] * part.size * part.size, outer_phi_.data(), blocks);
      }
      return;
    }
    const double half = part.size / 2;
    for (const double i : {0., 1.})
      for (const double j : {0., 1.})
      {
        // a triangle has no part in the far corner of its square: there its middle is meant, which
        // lies turned over in the near one
        const bool is_middle =
            space_.shapes().n_vertices() == 3 && i == j && (i == 1) != part.is_turned;
        const double s = part.s + (is_middle ? 1 - i : i) * half;
        const double t = part.t + (is_middle ? 1 - j : j) * half;
        const Part child{s, t, half, part.is_turned != is_middle};
        integrate_part<n_entries, n_shapes>(child, level + 1, outer, inner, blocks);
      }
  }

  /// A circle about a point of E, where the kernel is not smooth, may cut E'.
  bool PairQuadrature::is_cut(double between, std::size_t outer, std::size_t inner) const
  {
    const double farthest = cells_.farthest(outer, inner);
    if (farthest > horizon_ || !profile_.has_breaks())
      return farthest > horizon_;
    const double nearest = between - cells_.radius(outer) - cells_.radius(inner);
    const auto &circles = profile_.circles();
    return std::any_of(circles.begin(), circles.end(),
                       [&](const KernelEntries::Ball &circle)
                       { return nearest < circle.radius && circle.radius < farthest; });
  }

  /// Of the inner integral, for x in this part.
  PairQuadrature::Kink PairQuadrature::find_kink(const Part &part, std::size_t outer,
                                                 std::size_t inner) const
  {
    const CellMap &map = space_.map(outer);
    const bool is_triangle = space_.shapes().n_vertices() == 3;
    const double middle = is_triangle ? 1. / 3 : .5;
    const Point<2> centre = map.point(part.point(Point<2>(middle, middle)));
    // parts keep as far from a kink as they are wide, so that Gauss's rule sees a smooth function;
    // a bilinear map stretches some parts more than others
    const double reach = 2 * part.size * cells_.radius(outer) * (map.is_affine() ? 1 : 1.5);
    const auto vertices = cells_[inner].vertices();
    if (geometry::is_at_shadow(centre, reach, between_, vertices))
      return Kink::at_circle;
    Kink kink = Kink::none;
    for (unsigned int v = 0; v < vertices.size(); ++v)
    {
      const Point<2> &a = vertices[v];
      const dealii::Tensor<1, 2> side = vertices[(v + 1) % vertices.size()] - a, from = centre - a;
      const double length = side.norm(), along = (from * side) / length;
      const double across = std::abs(side[0] * from[1] - side[1] * from[0]) / length;
      const bool is_beside = along > -reach && along < length + reach;
      for (const KernelEntries::Ball &circle : profile_.circles())
        if (std::abs(from.norm() - circle.radius) <= reach ||
            (is_beside && std::abs(across - circle.radius) <= reach))
          return Kink::at_circle;
      if (!profile_.is_smooth() && is_beside && across <= reach)
        kink = Kink::at_side;
    }
    return kink;
  }

  /// All of both cells, a constant kernel: products of integrals.
  void PairQuadrature::integrate_constant(std::size_t outer, std::size_t inner,
                                          PairBlocks &blocks) const
  {
    const double c = profile_.constant() * cells_.area(outer) * cells_.area(inner);
    blocks.resize(n_, 1);
    for (unsigned int a = 0; a < n_; ++a)
      for (unsigned int b = 0; b < n_; ++b)
      {
        blocks.outer[a * n_ + b] = blocks.inner[a * n_ + b] = c * rules_->mass[a * n_ + b];
        blocks.cross[a * n_ + b] = c * rules_->integrals[a] * rules_->integrals[b];
      }
  }

  /// Of the kernel on a cell, as a rule must take it.
  unsigned int PairQuadrature::kernel_degree(const SmoothEntries &kernel, double distance,
                                             double radius) const
  {
    if (kernel.is_smooth())
      return kernel.degree(2 * radius, accuracy_);
    return degree_away_from_singularity(distance, radius, accuracy_) +
           kernel.degree_of_function(2 * radius, accuracy_);
  }

  /// sum_, first_, second_ of ball(x) ∩ cell.
  template <int n_entries, int n_shapes>
  void PairQuadrature::integrate_inner(const Point<2> &x, std::size_t inner)
  {
    std::fill(sum_.begin(), sum_.end(), 0.);
    const geometry::ConvexCell &cell = cells_[inner];
    const double distance = x.distance(cells_.centroid(inner)), radius = cells_.radius(inner);
    if (distance >= horizon_ + radius)
      return;
    if (has_moments_ && between_.empty())
      return add_moments(is_whole({x, horizon_}, cell, distance + radius)
                             ? cell.moments()
                             : geometry::intersect({x, horizon_}, cell, backend_),
                         inner);

    std::fill(first_.begin(), first_.end(), 0.);
    std::fill(second_.begin(), second_.end(), 0.);
    if (coefficient_)
      a_x_ = coefficient_->at(x);
    if (between_.empty())
      add_region<n_entries, n_shapes>(x, {cell, distance, radius}, inner);
    else
    {
      geometry::find_visible(x, cell.vertices(), between_, seen_);
      for (const geometry::Polygon &part : seen_)
      {
        const geometry::ConvexCell polygon(part);
        const Point<2> &centroid = polygon.moments().centroid;
        double farthest = 0;
        for (const Point<2> &vertex : part)
          farthest = std::max(farthest, vertex.distance(centroid));
        add_region<n_entries, n_shapes>(x, {polygon, x.distance(centroid), farthest, false}, inner);
      }
    }
    for (unsigned int a = 0; a < n_; ++a)
      for (unsigned int b = 0; b < a; ++b)
        for (int e = 0; e < n_entries; ++e)
          second_[(a * n_ + b) * n_entries + e] = second_[(b * n_ + a) * n_entries + e];
  }

  template <int n_entries, int n_shapes>
  void PairQuadrature::add_region(const Point<2> &x, const Region &region, std::size_t inner)
  {
    profile_.for_balls(region.distance - region.radius, region.distance + region.radius,
                       [&](double ball_radius, const SmoothEntries &kernel) {
                         add_ball<n_entries, n_shapes>({x, ball_radius}, kernel, region, inner);
                       });
  }

  /// A kernel without breaks on ball ∩ cell.
  template <int n_entries, int n_shapes>
  void PairQuadrature::add_ball(const geometry::Ball &ball, const SmoothEntries &kernel,
                                const Region &region, std::size_t inner)
  {
    const Point<2> &x = ball.centre;
    const geometry::ConvexCell &cell = region.polygon;
    const double distance = region.distance, radius = region.radius;
    if (!kernel.is_smooth() && distance < near * radius)
    {
      // along a ray the integrand is a polynomial: two shape functions, r C(r)
      const unsigned int p = space_.shapes().degree();
      const unsigned int along =
          (space_.shapes().n_vertices() - 2) * 2 * p + kernel.degree(2 * radius, accuracy_) + 1;
      geometry::polar_rule(ball, cell, 5 + p + std::min(6u, refinement_), along / 2 + 1, rule_,
                           backend_);
      return add_points<n_entries, n_shapes>(x, kernel, inner, rule_);
    }
    // of two shape functions, along an axis; on quadrilaterals their total degree is twice that
    const unsigned int p = 2 * space_.shapes().degree();
    const unsigned int degree = kernel_degree(kernel, distance, radius);
    if (const unsigned int i = (p + degree) / 2;
        region.is_all && i < rules_->whole.size() && is_whole(ball, cell, distance + radius))
      return add_whole<n_entries, n_shapes>(x, kernel, inner, rules_->whole[i]);
    const bool is_quad = space_.shapes().n_vertices() == 4;
    geometry::cut_rule(ball, cell, (is_quad ? 2 * p : p) + degree, rule_, backend_);
    add_points<n_entries, n_shapes>(x, kernel, inner, rule_);
  }

  template <int n_entries, int n_shapes>
  void PairQuadrature::add(const Point<2> &x, const SmoothEntries &kernel, const Point<2> &y,
                           double weight, const double *phi)
  {
    double entries[n_entries];
    kernel.template operator()<n_entries>(y[0] - x[0], y[1] - x[1], entries);
    if (coefficient_)
      weight *= coefficient_->mean(a_x_, coefficient_->at(y));
    const unsigned int n = n_shapes > 0 ? n_shapes : n_;
    for (int e = 0; e < n_entries; ++e)
    {
      const double value = weight * entries[e];
      sum_[e] += value;
      double *const first = first_.data() + e;
      double *const second = second_.data() + e;
      for (unsigned int a = 0; a < n; ++a)
      {
        const double row = value * phi[a];
        first[a * n_entries] += row;
        for (unsigned int b = a; b < n; ++b)
          second[(a * n + b) * n_entries] += row * phi[b];
      }
    }
  }

  template <int n_entries, int n_shapes>
  void PairQuadrature::add_points(const Point<2> &x, const SmoothEntries &kernel, std::size_t inner,
                                  const geometry::CutRule &rule)
  {
    const CellMap &map = space_.map(inner);
    for (std::size_t q = 0; q < rule.points.size(); ++q)
    {
      space_.shapes().values(map.unit(rule.points[q]), phi_.data());
      add<n_entries, n_shapes>(x, kernel, rule.points[q], rule.weights[q], phi_.data());
    }
  }

  template <int n_entries, int n_shapes>
  void PairQuadrature::add_whole(const Point<2> &x, const SmoothEntries &kernel, std::size_t inner,
                                 const ShapeRule &rule)
  {
    const CellMap &map = space_.map(inner);
    for (std::size_t q = 0; q < rule.unit.size(); ++q)
      add<n_entries, n_shapes>(x, kernel, map.point(rule.unit[q]),
                               rule.weight[q] * map.determinant(rule.unit[q]), &rule.phi[q * n_]);
  }

  /// A constant kernel on functions that are linear: area, centroid and second moments are all.
  void PairQuadrature::add_moments(const geometry::Moments &moments, std::size_t inner)
  {
    const double mass = profile_.constant() * moments.area;
    sum_[0] = mass;
    if (n_ == 1)
    {
      first_[0] = second_[0] = mass;
      return;
    }
    const CellMap &map = space_.map(inner);
    const Point<2> unit = map.unit(moments.centroid);
    const double phi[3] = {1 - unit[0] - unit[1], unit[0], unit[1]};
    const auto j = map.inverse();
    const double gx[3] = {-j[0] - j[2], j[0], j[2]}, gy[3] = {-j[1] - j[3], j[1], j[3]};
    const auto &m = moments.second;
    for (unsigned int a = 0; a < 3; ++a)
    {
      first_[a] = mass * phi[a];
      const double mx = profile_.constant() * (m[0] * gx[a] + m[1] * gy[a]);
      const double my = profile_.constant() * (m[1] * gx[a] + m[2] * gy[a]);
      for (unsigned int b = 0; b < 3; ++b)
        second_[a * 3 + b] = mass * phi[a] * phi[b] + mx * gx[b] + my * gy[b];
    }
  }
} // namespace plumbline::reference
