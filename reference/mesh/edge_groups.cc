#include "reference/mesh/edge_groups.h"

#include <algorithm>
#include <limits>

namespace plumbline::reference
{
  namespace
  {
    std::vector<Point<2>> middles(const EdgeForm &form)
    {
      std::vector<Point<2>> points;
      for (const Edge &edge : form.edges)
        points.push_back(edge.segment.middle());
      return points;
    }

    std::size_t row_of(unsigned int node, const EdgeGroup &group)
    {
      const auto at = std::lower_bound(group.rows.begin(), group.rows.end(), node);
      return static_cast<std::size_t>(at - group.rows.begin());
    }

    constexpr unsigned int none = std::numeric_limits<unsigned int>::max(); ///< no slot

    unsigned char bit(PairWay way)
    {
      return static_cast<unsigned char>(1u << static_cast<unsigned int>(way));
    }
  } // namespace

  geometry::Box box_about(const Point<2> &x, double radius)
  {
    const Point<2> reach(radius, radius);
    return {Point<2>(x - reach), Point<2>(x + reach)};
  }

  geometry::BoxSearch<2> search_points(const std::vector<Point<2>> &points)
  {
    std::vector<geometry::Box> boxes;
    for (const Point<2> &x : points)
      boxes.push_back({x, x});
    return geometry::BoxSearch<2>(std::move(boxes));
  }

  template <unsigned int n>
  EdgeGroups<n>::EdgeGroups(const MeshSpace &space, const EdgeForm &form, const PairWays &ways,
                            const typename EdgeIntegrals<n>::Tables &potential,
                            const WholePotential &whole)
      : space_(space), form_(form), ways_(ways), horizon_(potential.horizon()),
        has_inside_(!whole.is_none_inside()), integrals_(potential, whole),
        middles_(search_points(middles(form)))
  {
    for (const Edge &edge : form.edges)
      largest_radius_ = std::max(largest_radius_, edge.radius);
  }

  template <unsigned int n>
  void EdgeGroups<n>::integrate(std::size_t first, std::size_t last, Scratch &scratch,
                                EdgeGroup &group) const
  {
    find_near(first, last, scratch);
    find_nodes(first, last, scratch, group);
    find_ways(group, scratch);
    group.values.assign(group.rows.size() * group.columns.size() * n, 0);
    group.n_pairs = 0;
    scratch.from_start.assign(scratch.near.size(), {});
    for (std::size_t e = first; e < last; ++e)
    {
      sum_partners(e, group, scratch);
      add_rows(form_.edges[e], group, scratch);
    }
    for (const unsigned int column : group.columns)
      scratch.slot[column] = none;
  }

  /// Whether nodes of theirs may be a pair that takes theirs.
  template <unsigned int n>
  bool EdgeGroups<n>::is_near(const Edge &e, const Edge &f) const
  {
    const double distance = e.segment.middle().distance(f.segment.middle()),
                 both = e.radius + f.radius;
    return distance < std::max(horizon_, ways_.farthest_whole()) + both &&
           (has_inside_ || distance > horizon_ - both);
  }

  /// Q, kept for the next who asks.
  template <unsigned int n>
  const Potentials<n> &EdgeGroups<n>::ask(Known &known, const Point<2> &v, const Edge &e,
                                          const Wanted &wanted) const
  {
    const Wanted missing = wanted.without(known.has);
    if (!missing.is_none())
    {
      known.value.add(1, integrals_.from_point(v, e.segment, missing));
      known.has.add(missing);
    }
    return known.value;
  }

  /// What pairs of their nodes take of a pair of edges, unless it is zero.
  template <unsigned int n>
  Wanted EdgeGroups<n>::wanted(const Edge &e, const Edge &f, const Scratch &scratch) const
  {
    unsigned int ways = 0;
    for (unsigned int k = 0; k < f.n_nodes; ++k)
      ways |= scratch.edge_ways[scratch.slot[f.node[k]]];
    const auto has = [&](PairWay way) { return (ways & bit(way)) != 0; };
    const geometry::PairPosition where = position(e, f, horizon_);
    return {has(PairWay::in) && where != geometry::PairPosition::apart,
            has(PairWay::whole) && (has_inside_ || where != geometry::PairPosition::inside)};
  }

  /// Edges that an edge of the group has a pair with, each pair once: numbers from first on.
  template <unsigned int n>
  void EdgeGroups<n>::find_near(std::size_t first, std::size_t last, Scratch &scratch) const
  {
    double reach = 0;
    const Point<2> &center = form_.edges[first].segment.start;
    for (std::size_t e = first; e < last; ++e)
      reach =
          std::max(reach, form_.edges[e].radius + form_.edges[e].segment.middle().distance(center));
    middles_.find(
        box_about(center, std::max(horizon_, ways_.farthest_whole()) + reach + largest_radius_),
        scratch.found);
    scratch.near.clear();
    for (const unsigned int f : scratch.found)
      if (f >= first && std::any_of(form_.edges.begin() + static_cast<std::ptrdiff_t>(first),
                                    form_.edges.begin() + static_cast<std::ptrdiff_t>(last),
                                    [&](const Edge &e) { return is_near(e, form_.edges[f]); }))
        scratch.near.push_back(f);
  }

  /// The nodes of the group's edges, and of all that are near them.
  template <unsigned int n>
  void EdgeGroups<n>::find_nodes(std::size_t first, std::size_t last, Scratch &scratch,
                                 EdgeGroup &group) const
  {
    scratch.slot.resize(space_.n_dofs(), none);
    const auto take = [&](const Edge &edge, std::vector<unsigned int> &nodes)
    {
      for (unsigned int k = 0; k < edge.n_nodes; ++k)
        if (unsigned int &slot = scratch.slot[edge.node[k]]; slot == none)
        {
          nodes.push_back(edge.node[k]);
          slot = 0;
        }
    };
    const auto sort = [&](std::vector<unsigned int> &nodes)
    {
      for (const unsigned int node : nodes)
        scratch.slot[node] = none;
      std::sort(nodes.begin(), nodes.end());
    };
    group.rows.clear();
    for (std::size_t e = first; e < last; ++e)
      take(form_.edges[e], group.rows);
    sort(group.rows);
    group.columns.clear();
    for (const unsigned int f : scratch.near)
      take(form_.edges[f], group.columns);
    sort(group.columns);
    for (unsigned int c = 0; c < group.columns.size(); ++c)
      scratch.slot[group.columns[c]] = c;
  }

  template <unsigned int n>
  void EdgeGroups<n>::find_ways(const EdgeGroup &group, Scratch &scratch) const
  {
    scratch.ways.clear();
    for (const unsigned int row : group.rows)
      for (const unsigned int column : group.columns)
        scratch.ways.push_back(ways_(row, column));
  }

  /// Σ_f J(f) D(e, f) over later edges f, e itself by half.
  template <unsigned int n>
  void EdgeGroups<n>::sum_partners(std::size_t e, EdgeGroup &group, Scratch &scratch) const
  {
    const Edge &edge = form_.edges[e];
    const std::size_t n_columns = group.columns.size();
    scratch.sums.assign(n_columns, {});
    scratch.to_edge.assign(n_columns, {});
    scratch.edge_ways.assign(n_columns, 0);
    for (unsigned int k = 0; k < edge.n_nodes; ++k)
    {
      const PairWay *const way = &scratch.ways[row_of(edge.node[k], group) * n_columns];
      for (std::size_t c = 0; c < n_columns; ++c)
        scratch.edge_ways[c] |= bit(way[c]);
    }
    for (std::size_t k = 0; k < scratch.near.size(); ++k)
    {
      const unsigned int f = scratch.near[k];
      const Edge &other = form_.edges[f];
      const Wanted asked = f < e ? Wanted() : wanted(edge, other, scratch);
      if (asked.is_none())
        continue;
      ++group.n_pairs;
      const Segment &a = edge.segment, &b = other.segment;
      Potentials<n> d;
      const Wanted by_rule = integrals_.by_rule(a, b, asked), by_ends = asked.without(by_rule);
      if (!by_ends.is_none())
        d = integrals_.between(
            a, b,
            {ask(scratch.from_start[k], a.start, other, by_ends),
             integrals_.from_point(a.end, b, by_ends)},
            {ask(scratch.to_edge[scratch.slot[other.node[0]]], b.start, edge, by_ends),
             ask(scratch.to_edge[scratch.slot[other.node[1]]], b.end, edge, by_ends)});
      if (!by_rule.is_none())
        d.take(by_rule, integrals_.between_parallel(a, b, by_rule));
      const double factor = f == e ? .5 : 1;
      for (unsigned int m = 0; m < other.n_nodes; ++m)
        scratch.sums[scratch.slot[other.node[m]]].add(factor * other.jump[m], d);
    }
  }

  template <unsigned int n>
  void EdgeGroups<n>::add_rows(const Edge &edge, EdgeGroup &group, const Scratch &scratch) const
  {
    const std::size_t n_columns = group.columns.size();
    for (unsigned int k = 0; k < edge.n_nodes; ++k)
    {
      const std::size_t row = row_of(edge.node[k], group);
      double *to = &group.values[row * n_columns * n];
      for (std::size_t c = 0; c < n_columns; ++c, to += n)
      {
        const Potentials<n> &sum = scratch.sums[c];
        const PairWay way = scratch.ways[row * n_columns + c];
        for (unsigned int i = 0; i < n; ++i)
          if (way == PairWay::whole)
            to[i] += edge.jump[k] * sum.whole[i];
          else if (way == PairWay::in)
            to[i] += edge.jump[k] * sum.in[i];
      }
    }
  }

  template class EdgeGroups<1>;
  template class EdgeGroups<3>;
} // namespace plumbline::reference
