#include "reference/mesh/triangle_pairs.h"

#include "geometry/polygon.h"
#include "reference/mesh/kernel_entries.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace plumbline::reference
{
  namespace
  {
    constexpr unsigned int n_sides = 3;
    constexpr unsigned int next[n_sides] = {1, 2, 0};

    double cross(const Vector2 &a, const Vector2 &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    /// Of centroids, in sums of radii: beyond it pairs are apart.
    constexpr double near = 3;
    constexpr double accuracy = 1e-15; ///< of rules for them

    bool is_constant(const physics::Kernel<2> &kernel)
    {
      return kernel.profile().degree() == 0 && kernel.profile().lowest_exponent() == 0;
    }
  } // namespace

  std::string TrianglePairs::refuse(const MeshSpace &space, const physics::Kernel<2> &kernel)
  {
    if (space.shapes().degree() > 1)
      return "the degree is more than 1";
    if (kernel.structure() != physics::Structure::scalar)
      return "the kernel is a tensor";
    if (!kernel.breaks().empty() || kernel.profile().is_function())
      return "the kernel is no sum of powers";
    return "";
  }

  TrianglePairs::Shared::Shared(const MeshSpace &space, const MeshCells &cells,
                                const physics::Kernel<2> &kernel)
  {
    const geometry::Mesh &mesh = space.mesh();
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> index;
    double largest = 0, longest = 0;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    {
      std::array<Side, n_sides> of_cell;
      double longest_side = 0;
      for (unsigned int k = 0; k < n_sides; ++k)
      {
        const unsigned int a = mesh.cells[cell].vertex[k], b = mesh.cells[cell].vertex[next[k]];
        const auto [place, is_new] =
            index.try_emplace(std::minmax(a, b), static_cast<unsigned int>(edges.size()));
        const auto [first, second] = place->first;
        if (is_new)
          edges.push_back({mesh.vertices[first], mesh.vertices[second] - mesh.vertices[first]});
        of_cell[k] = {place->second, first == a};
        longest_side = std::max(longest_side, edges[place->second].along.norm());
      }
      sides.push_back(of_cell);
      constexpr double most_slender = 30; // terms are larger than their sum by its square
      is_slender.push_back(longest_side * longest_side > 2 * most_slender * cells.area(cell));
      longest = std::max(longest, longest_side);
      largest = std::max(largest, cells.radius(cell));
    }
    const double reach = (kernel.horizon() + 4 * largest) / kernel.horizon();
    pairs = std::make_unique<EdgePairs>(kernel, longest, 1 - reach * reach);

    const unsigned int highest =
        2 + std::max<unsigned int>(degree_away_from_singularity(near, 1, accuracy),
                                   static_cast<unsigned int>(kernel.profile().degree()));
    const geometry::Polygon unit = {Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1)};
    for (unsigned int degree = 1; degree <= highest + 1; degree += 2)
    {
      const geometry::CutRule gauss = geometry::polygon_rule(geometry::view(unit), degree);
      ShapeRule rule{gauss.points, gauss.weights, {}};
      rule.phi.resize(rule.unit.size() * space.shapes().size());
      for (std::size_t q = 0; q < rule.unit.size(); ++q)
        space.shapes().values(rule.unit[q], &rule.phi[q * space.shapes().size()]);
      rules.push_back(std::move(rule));
    }
  }

  TrianglePairs::TrianglePairs(const MeshSpace &space, const MeshCells &cells,
                               const physics::Kernel<2> &kernel)
      : space_(space), cells_(cells), kernel_(kernel),
        shared_(std::make_shared<const Shared>(space, cells, kernel)), n_(space.shapes().size()),
        outer_(std::numeric_limits<std::size_t>::max())
  {
  }

  bool TrianglePairs::is_exact(std::size_t a, std::size_t b) const
  {
    return shared_->is_slender[a] == 0 && shared_->is_slender[b] == 0;
  }

  void TrianglePairs::integrate(std::size_t outer, std::size_t inner, PairBlocks &blocks)
  {
    blocks.reset(n_, 1);
    if (outer != outer_)
    {
      place_.resize(n_sides * shared_->edges.size(), 0);
      for (const std::size_t place : used_)
        place_[place] = 0;
      used_.clear();
      kept_.assign(1, {});
      outer_ = outer;
    }
    const double horizon = kernel_.horizon();
    const double between = cells_.centroid(outer).distance(cells_.centroid(inner));
    const double both = cells_.radius(outer) + cells_.radius(inner);
    constexpr double apart = .35;
    if (cells_.farthest(outer, inner) <= horizon)
      add_whole(outer, inner, blocks);
    else if (between - both > apart * horizon)
      add_sides(outer, inner, Part::in, 1, blocks);
    else
    {
      add_whole(outer, inner, blocks);
      add_sides(outer, inner, Part::out, -1, blocks);
    }
  }

  void TrianglePairs::add_whole(std::size_t outer, std::size_t inner, PairBlocks &blocks)
  {
    if (is_constant(kernel_))
      return add_product(outer, inner, blocks);
    if (kernel_.profile().is_even(false))
      return add_by_rule(outer, inner, shared_->rule(kernel_.profile().degree() + 2), blocks);
    const double between = cells_.centroid(outer).distance(cells_.centroid(inner));
    const double both = cells_.radius(outer) + cells_.radius(inner);
    if (between > near * both)
      add_by_rule(outer, inner,
                  shared_->rule(degree_away_from_singularity(between, both, accuracy) + 2), blocks);
    else
      add_sides(outer, inner, Part::whole, 1, blocks);
  }

  void TrianglePairs::add_product(std::size_t outer, std::size_t inner, PairBlocks &blocks) const
  {
    const double c =
        kernel_.radial(kernel_.horizon()) * cells_.area(outer) * cells_.area(inner) / (n_ * n_);
    const double of_mass = c * n_ * n_ / (n_ == 1 ? 1 : 12);
    for (unsigned int a = 0; a < n_; ++a)
      for (unsigned int b = 0; b < n_; ++b)
      {
        blocks.cross[a * n_ + b] += c;
        blocks.outer[a * n_ + b] += a == b && n_ > 1 ? 2 * of_mass : of_mass;
        blocks.inner[a * n_ + b] += a == b && n_ > 1 ? 2 * of_mass : of_mass;
      }
  }

  /// Triangles so far apart, or kernels so smooth, that a product of rules sees a polynomial.
  void TrianglePairs::add_by_rule(std::size_t outer, std::size_t inner, const ShapeRule &rule,
                                  PairBlocks &blocks) const
  {
    const CellMap &of_x = space_.map(outer), &of_y = space_.map(inner);
    const double factor = of_x.determinant({}) * of_y.determinant({});
    for (std::size_t i = 0; i < rule.unit.size(); ++i)
    {
      const Point<2> x = of_x.point(rule.unit[i]);
      const double *const p = &rule.phi[i * n_];
      for (std::size_t j = 0; j < rule.unit.size(); ++j)
      {
        const double *const q = &rule.phi[j * n_];
        const double value = factor * rule.weight[i] * rule.weight[j] *
                             kernel_.radial(x.distance(of_y.point(rule.unit[j])));
        for (unsigned int a = 0; a < n_; ++a)
          for (unsigned int b = 0; b < n_; ++b)
          {
            blocks.cross[a * n_ + b] += value * p[a] * q[b];
            blocks.outer[a * n_ + b] += value * p[a] * p[b];
            blocks.inner[a * n_ + b] += value * q[a] * q[b];
          }
      }
    }
  }

  const EdgeMoments &TrianglePairs::moments(unsigned int side, unsigned int edge, Part part)
  {
    const std::size_t key = n_sides * edge + side;
    if (place_[key] == 0)
    {
      place_[key] = static_cast<unsigned int>(kept_.size());
      used_.push_back(key);
      kept_.emplace_back();
    }
    auto &kept = kept_[place_[key]];
    Kept &own = kept[static_cast<std::size_t>(part)];
    if (!own.is_known)
    {
      const Segment &e = shared_->edges[shared_->sides[outer_][side].edge],
                    &f = shared_->edges[edge];
      if (part == Part::whole)
        own.moments = shared_->pairs->whole(e, f);
      else
        shared_->pairs->at_circle(e, f, part == Part::in ? &own.moments : nullptr,
                                  part == Part::out ? &own.moments : nullptr);
      own.is_known = true;
    }
    return own.moments;
  }

  std::array<TrianglePairs::Trace, 3> TrianglePairs::traces(std::size_t cell) const
  {
    std::array<Trace, n_sides> result;
    std::array<Point<2>, n_sides> corner;
    for (unsigned int k = 0; k < n_sides; ++k)
      corner[k] = space_.mesh().vertices[space_.mesh().cells[cell].vertex[k]];
    const auto along = [&](unsigned int k) { return Vector2(corner[next[k]] - corner[k]); };
    const double twice_area = cross(along(0), along(1));
    for (unsigned int k = 0; k < n_sides; ++k)
    {
      const bool is_forward = shared_->sides[cell][k].is_forward;
      Trace &trace = result[k];
      trace.sign = is_forward ? 1 : -1;
      if (n_ == 1)
      {
        trace.start[0] = 1;
        continue;
      }
      const unsigned int first = is_forward ? k : next[k], last = is_forward ? next[k] : k;
      trace.start[first] = 1;
      trace.change[first] = -1;
      trace.change[last] = 1;
      for (unsigned int i = 0; i < n_sides; ++i)
        trace.normal[i] = -(along(k) * along(next[i])) / twice_area;
    }
    return result;
  }

  void TrianglePairs::add_sides(std::size_t outer, std::size_t inner, Part part, double factor,
                                PairBlocks &blocks)
  {
    const auto of_x = traces(outer), of_y = traces(inner);
    const auto product_of_gradients = [&](std::size_t cell, unsigned int a, unsigned int b)
    {
      if (n_ == 1)
        return 0.;
      const auto j = space_.map(cell).inverse();
      const double gx[3] = {-j[0] - j[2], j[0], j[2]}, gy[3] = {-j[1] - j[3], j[1], j[3]};
      return gx[a] * gx[b] + gy[a] * gy[b];
    };
    for (unsigned int k = 0; k < n_sides; ++k)
      for (unsigned int l = 0; l < n_sides; ++l)
      {
        const Trace &p = of_x[k], &q = of_y[l];
        const EdgeMoments &m = moments(k, shared_->sides[inner][l].edge, part);
        const double signs = factor * p.sign * q.sign, sign_p = factor * p.sign,
                     sign_q = factor * q.sign;
        for (unsigned int a = 0; a < n_; ++a)
          for (unsigned int b = 0; b < n_; ++b)
          {
            blocks.cross[a * n_ + b] +=
                signs * (p.start[a] * (q.start[b] * m.both[0] + q.change[b] * m.both[2]) +
                         p.change[a] * (q.start[b] * m.both[1] + q.change[b] * m.both[3])) -
                sign_p * q.normal[b] * (p.start[a] * m.of_x[0] + p.change[a] * m.of_x[1]) -
                sign_q * p.normal[a] * (q.start[b] * m.of_y[0] + q.change[b] * m.of_y[2]) +
                factor * p.normal[a] * q.normal[b] * m.value;
            const double of_p = p.start[a] * p.change[b] + p.change[a] * p.start[b];
            blocks.outer[a * n_ + b] +=
                signs * (p.start[a] * p.start[b] * m.both[0] + of_p * m.both[1] +
                         p.change[a] * p.change[b] * m.both[4] +
                         2 * product_of_gradients(outer, a, b) * m.next) -
                sign_q * ((p.start[a] * p.normal[b] + p.normal[a] * p.start[b]) * m.of_y[0] +
                          (p.change[a] * p.normal[b] + p.normal[a] * p.change[b]) * m.of_y[1]);
            const double of_q = q.start[a] * q.change[b] + q.change[a] * q.start[b];
            blocks.inner[a * n_ + b] +=
                signs * (q.start[a] * q.start[b] * m.both[0] + of_q * m.both[2] +
                         q.change[a] * q.change[b] * m.both[5] +
                         2 * product_of_gradients(inner, a, b) * m.next) -
                sign_p * ((q.start[a] * q.normal[b] + q.normal[a] * q.start[b]) * m.of_x[0] +
                          (q.change[a] * q.normal[b] + q.normal[a] * q.change[b]) * m.of_x[2]);
          }
      }
  }
} // namespace plumbline::reference
