#include "reference/mesh/polygon_pairs.h"

#include "geometry/polygon.h"
#include "reference/mesh/kernel_entries.h"
#include "reference/mesh/side_functional.h"
#include "reference/mesh/whole_potential.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace plumbline::reference
{
  namespace
  {
    constexpr unsigned int n_parts = 3; ///< in, out, whole

    /// Of centroids, in sums of radii: beyond it pairs are apart.
    constexpr double near = 3;
    constexpr double accuracy = 1e-15; ///< of rules for them
    /// Cells, in horizons: beyond it the potential inside the circle needs few points.
    constexpr double apart = .35;
    /// Longer in terms of the height, and terms are larger than their sum by its square.
    constexpr double most_slender = 30;

    /// A bound of vertices' distances from the centroid.
    double largest_radius(const geometry::Mesh &mesh)
    {
      double largest = 0;
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      {
        const geometry::Polygon polygon = mesh.polygon(cell);
        const Point<2> centroid = geometry::centroid(geometry::view(polygon));
        for (const Point<2> &vertex : polygon)
          largest = std::max(largest, vertex.distance(centroid));
      }
      return largest;
    }

    /// The largest distance of points of pairs within the horizon, in horizons.
    double reach(double largest_radius, double horizon)
    {
      return 1 + 4 * largest_radius / horizon;
    }

    /// A polynomial that a kernel is to rounding where points of pairs are no farther apart than
    /// others by this length; of others than even ones but for the root in |ξ|.
    unsigned int degree(const physics::Kernel<2> &kernel, double length)
    {
      const physics::RadialProfile &profile = kernel.profile();
      const unsigned int lowest = std::max(0, profile.lowest_exponent());
      if (!profile.is_function())
        return lowest + profile.degree();
      const double part = length / kernel.horizon();
      return lowest + static_cast<unsigned int>(
                          std::ceil(profile.degree(std::min(1., part)) * std::max(1., part)));
    }

    bool is_even(const physics::Kernel<2> &kernel)
    {
      return kernel.profile().is_even(kernel.structure() == physics::Structure::tensor);
    }

    /// The kernel as powers up to where pairs are near; nothing if it cannot be had. Even ones need
    /// none: they are taken by rules.
    std::optional<physics::Kernel<2>> near_powers(const physics::Kernel<2> &kernel, double largest)
    {
      if (is_even(kernel))
        return physics::Kernel<2>(kernel.structure(), {{1, 2}}, kernel.horizon(), 1);
      const double farthest_out = apart * kernel.horizon() + 4 * largest;
      return WholePotential::as_powers(
          kernel, std::min(2 * (near + 1) * largest, std::max(kernel.horizon(), farthest_out)));
    }
  } // namespace

  std::string PolygonPairs::refuse(const MeshSpace &space, const physics::Kernel<2> &kernel)
  {
    constexpr unsigned int highest = 2; // in all, of potentials up to the fourth order
    if (SideTraces::total_degree(space.shapes()) > highest)
      return "the degree is more than " + std::to_string(space.shapes().n_vertices() == 3 ? 2 : 1);
    constexpr std::size_t most_breaks = 7; // each costs as much as a kernel
    if (kernel.breaks().size() > most_breaks)
      return "the kernel's profile has more than " + std::to_string(most_breaks) + " breaks";
    const double largest = largest_radius(space.mesh());
    for (const physics::Kernel<2> &part : kernel.parts())
    {
      constexpr double farthest = 10; // potentials at so many horizons are much larger than pairs
      if (reach(largest, part.horizon()) > farthest)
        return "cells are large in relation to the horizon or a break of the kernel";
      constexpr unsigned int most = 60; // pairs by rules of it cost more than by quadrature
      if (degree(part, 4 * largest) > most || !near_powers(part, largest))
        return "the kernel varies fast in relation to the horizon or the cells";
    }
    return "";
  }

  PolygonPairs::Shared::Shared(const MeshSpace &space, const MeshCells &cells,
                               const physics::Kernel<2> &kernel)
      : traces(space.shapes())
  {
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> index;
    const bool is_quads = space.shapes().n_vertices() == 4;
    double largest = 0, longest = 0;
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
    {
      const std::vector<unsigned int> &outline = cells.outline(cell);
      std::vector<Side> of_cell;
      double longest_side = 0;
      for (std::size_t k = 0; k < outline.size(); ++k)
      {
        const unsigned int a = outline[k], b = outline[(k + 1) % outline.size()];
        const auto [place, is_new] =
            index.try_emplace(std::minmax(a, b), static_cast<unsigned int>(edges.size()));
        const auto [first, second] = place->first;
        if (is_new)
          edges.emplace_back(cells.vertex(first), cells.vertex(second));
        of_cell.push_back({place->second, first == a});
        longest_side = std::max(longest_side, edges[place->second].along.norm());
      }
      most_sides = std::max(most_sides, of_cell.size());
      sides.push_back(std::move(of_cell));
      is_slender.push_back(longest_side * longest_side >
                           (is_quads ? 1 : 2) * most_slender * cells.area(cell));
      is_mapped.push_back(space.shapes().degree() > 0 && !space.map(cell).is_affine());
      longest = std::max(longest, longest_side);
      largest = std::max(largest, cells.radius(cell));
    }
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
      if (cells.is_curved(cell))
        find_traces(space, cells, cell, of_curved[cell]);
    const unsigned int total = SideTraces::total_degree(space.shapes());
    const double farthest = reach(largest, kernel.horizon());
    const auto make = [&](auto &pairs)
    {
      using Pairs = typename std::decay_t<decltype(pairs)>::element_type;
      pairs = std::make_unique<Pairs>(kernel, *near_powers(kernel, largest), total, longest,
                                      1 - farthest * farthest);
    };
    kernel.structure() == physics::Structure::scalar ? make(scalar) : make(tensor);

    const unsigned int highest =
        2 * total + degree(kernel, 4 * largest) +
        (is_even(kernel) ? 0 : degree_away_from_singularity(near, 1, accuracy));
    for (unsigned int of_rule = 1; of_rule <= highest + 1; of_rule += 2)
      rules.emplace_back(space.shapes(), of_rule);
  }

  PolygonPairs::PolygonPairs(const MeshSpace &space, const MeshCells &cells,
                             const physics::Kernel<2> &kernel)
      : space_(space), cells_(cells), kernel_(kernel),
        shared_(std::make_shared<const Shared>(space, cells, kernel)), n_(space.shapes().size()),
        degree_(SideTraces::total_degree(space.shapes())),
        n_entries_(kernel.structure() == physics::Structure::scalar ? 1 : 3),
        outer_(std::numeric_limits<std::size_t>::max())
  {
  }

  bool PolygonPairs::is_exact(std::size_t a, std::size_t b) const
  {
    const auto is_good = [&](std::size_t cell)
    { return shared_->is_slender[cell] == 0 && shared_->is_mapped[cell] == 0; };
    return is_good(a) && is_good(b);
  }

  std::string PolygonPairs::exceptions() const
  {
    const auto has = [](const std::vector<char> &some)
    { return std::find(some.begin(), some.end(), 1) != some.end(); };
    std::string text = has(shared_->is_mapped) ? "is no parallelogram" : "";
    if (has(shared_->is_slender))
      text += std::string(text.empty() ? "" : " or ") + "is more than " +
              std::to_string(static_cast<int>(most_slender)) + " times longer than high";
    return text;
  }

  void PolygonPairs::integrate(std::size_t outer, std::size_t inner, PairBlocks &blocks)
  {
    blocks.reset(n_, n_entries_);
    if (outer != outer_)
    {
      place_.resize(n_parts * shared_->most_sides * shared_->edges.size(), 0);
      for (const std::size_t place : used_)
        place_[place] = 0;
      used_.clear();
      kept_.clear();
      outer_ = outer;
      find_traces(outer, of_outer_);
    }
    const double horizon = kernel_.horizon();
    const double between = cells_.centroid(outer).distance(cells_.centroid(inner));
    const double both = cells_.radius(outer) + cells_.radius(inner);
    const geometry::PairPosition position = cells_.position(outer, inner, horizon);
    if (position == geometry::PairPosition::apart)
      return;
    if (position == geometry::PairPosition::inside)
      add_whole(outer, inner, blocks);
    else if (between - both > apart * horizon)
      add_sides(inner, Part::in, 1, blocks);
    else
    {
      add_whole(outer, inner, blocks);
      add_sides(inner, Part::out, -1, blocks);
    }
    mirror(blocks);
    if (n_entries_ == 3)
      find_components(blocks);
    take_own_functions(outer, inner, blocks);
  }

  /// xx, xy, yy of half the trace, ½(C_xx - C_yy) and C_xy.
  void PolygonPairs::find_components(PairBlocks &blocks) const
  {
    for (auto *block : {&blocks.outer, &blocks.cross, &blocks.inner})
      for (std::size_t k = 0; k < block->size(); k += n_entries_)
      {
        double *const entry = &(*block)[k];
        const double trace = entry[0], rest = entry[1];
        entry[0] = trace + rest;
        entry[1] = entry[2];
        entry[2] = trace - rest;
      }
  }

  /// Of cells whose nodes lie on curves.
  void PolygonPairs::take_own_functions(std::size_t outer, std::size_t inner,
                                        PairBlocks &blocks) const
  {
    const auto &of_outer = space_.own_functions(outer), &of_inner = space_.own_functions(inner);
    transform(of_outer, of_outer, n_, blocks.outer);
    transform(of_outer, of_inner, n_, blocks.cross);
    transform(of_inner, of_inner, n_, blocks.inner);
  }

  void PolygonPairs::add_whole(std::size_t outer, std::size_t inner, PairBlocks &blocks)
  {
    const double between = cells_.centroid(outer).distance(cells_.centroid(inner));
    const double both = cells_.radius(outer) + cells_.radius(inner);
    if (!is_even(kernel_) && between <= near * both)
      return add_sides(inner, Part::whole, 1, blocks);
    // cells so far apart, or kernels so smooth, that a product of rules sees a polynomial
    unsigned int of_rule = 2 * degree_;
    if (is_even(kernel_) || kernel_.profile().is_function())
      of_rule += degree(kernel_, 2 * both);
    if (!is_even(kernel_))
      of_rule += degree_away_from_singularity(between, both, accuracy);
    find_products(outer, of_rule, products_of_x_);
    find_products(inner, of_rule, products_of_y_);
    add_products(products_of_x_, products_of_y_, n_, kernel_, blocks);
  }

  void PolygonPairs::find_products(std::size_t cell, unsigned int degree,
                                   CellProducts &products) const
  {
    const CellMap &map = space_.map(cell);
    if (map.is_affine() && !cells_.is_curved(cell))
      return shared_->rule(degree).map(map, products);
    CellRule rule;
    rule_by_parts(space_, cells_, cell, degree, rule);
    products.clear();
    for (std::size_t q = 0; q < rule.points.size(); ++q)
      products.add(rule.points[q], rule.weights[q], &rule.phi[q * n_], n_);
  }

  /// Entries below the diagonal of what is symmetric.
  void PolygonPairs::mirror(PairBlocks &blocks) const
  {
    for (auto *block : {&blocks.outer, &blocks.inner})
      for (unsigned int a = 0; a < n_; ++a)
        for (unsigned int b = 0; b < a; ++b)
          for (unsigned int e = 0; e < n_entries_; ++e)
            (*block)[place(a, b, e)] = (*block)[place(b, a, e)];
  }

  const EdgeMoments *PolygonPairs::moments(std::size_t side, unsigned int edge, Part part)
  {
    const std::size_t key =
        n_parts * (shared_->most_sides * edge + side) + static_cast<std::size_t>(part);
    if (place_[key] == 0)
    {
      used_.push_back(key);
      const std::size_t first = kept_.size();
      kept_.resize(first + n_entries_);
      place_[key] = static_cast<unsigned int>(first + 1);
      const Segment &e = shared_->edges[shared_->sides[outer_][side].edge],
                    &f = shared_->edges[edge];
      const auto integrate = [&](const auto &pairs)
      {
        if (part == Part::whole)
          pairs.whole(e, f, &kept_[first]);
        else
          pairs.at_circle(e, f, part == Part::in ? &kept_[first] : nullptr,
                          part == Part::out ? &kept_[first] : nullptr);
      };
      shared_->scalar ? integrate(*shared_->scalar) : integrate(*shared_->tensor);
    }
    return &kept_[place_[key] - 1];
  }

  void PolygonPairs::Shared::find_traces(const MeshSpace &space, const MeshCells &cells,
                                         std::size_t cell, Traces &of_cell) const
  {
    const std::vector<Side> &own = sides[cell];
    of_cell.sign.resize(own.size());
    of_cell.of.resize(own.size());
    for (unsigned int k = 0; k < own.size(); ++k)
    {
      const Segment &edge = edges[own[k].edge];
      const double sign = own[k].is_forward ? 1 : -1;
      const Point<2> normal(sign * edge.along[1], -sign * edge.along[0]);
      of_cell.sign[k] = sign;
      if (cells.is_curved(cell))
        traces.find(space.map(cell), edge, normal, of_cell.of[k]);
      else
        traces.find(space.map(cell), k, own[k].is_forward, normal, of_cell.of[k]);
    }
  }

  void PolygonPairs::find_traces(std::size_t cell, Traces &own) const
  {
    if (!cells_.is_curved(cell))
      shared_->find_traces(space_, cells_, cell, own);
  }

  /// @param own  found before, if none are kept
  const PolygonPairs::Traces &PolygonPairs::traces(std::size_t cell, const Traces &own) const
  {
    return cells_.is_curved(cell) ? shared_->of_curved.at(cell) : own;
  }

  /// The outer cell is that of the kept moments.
  void PolygonPairs::add_sides(std::size_t inner, Part part, double factor, PairBlocks &blocks)
  {
    find_traces(inner, of_inner_);
    const Traces &of_outer = traces(outer_, of_outer_), &of_inner = traces(inner, of_inner_);
    SideTrace one;
    one.value[0][0] = 1;
    const unsigned int degree = 2 * degree_;
    const std::vector<Side> &sides = shared_->sides[inner];
    for (std::size_t k = 0; k < of_outer.of.size(); ++k)
      for (std::size_t l = 0; l < sides.size(); ++l)
      {
        const EdgeMoments *const m = moments(k, sides[l].edge, part);
        const auto &p = of_outer.of[k], &q = of_inner.of[l];
        const double sign_p = of_outer.sign[k], sign_q = of_inner.sign[l];
        for (unsigned int e = 0; e < n_entries_; ++e)
        {
          for (unsigned int b = 0; b < n_; ++b)
          {
            const SideFunctional functional = apply<true>(q[b], m[e], sign_p, sign_q, degree);
            for (unsigned int a = 0; a < n_; ++a)
              blocks.cross[place(a, b, e)] += factor * functional(p[a]);
          }
          const SideFunctional of_p = apply<true>(one, m[e], sign_p, sign_q, degree),
                               of_q = apply<false>(one, m[e], sign_q, sign_p, degree);
          unsigned int product = n_;
          for (unsigned int a = 0; a < n_; ++a)
            for (unsigned int b = a; b < n_; ++b, ++product)
            {
              blocks.outer[place(a, b, e)] += factor * of_p(p[product]);
              blocks.inner[place(a, b, e)] += factor * of_q(q[product]);
            }
        }
      }
  }
} // namespace plumbline::reference
