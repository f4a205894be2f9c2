#include "reference/mesh/edge_groups.h"

#include <algorithm>

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
  } // namespace

  geometry::Box box_about(const Point<2> &x, double radius)
  {
    const Point<2> reach(radius, radius);
    return {Point<2>(x - reach), Point<2>(x + reach)};
  }

  geometry::BoxSearch search_points(const std::vector<Point<2>> &points)
  {
    std::vector<geometry::Box> boxes;
    for (const Point<2> &x : points)
      boxes.push_back({x, x});
    return geometry::BoxSearch(std::move(boxes));
  }

  EdgeGroups::EdgeGroups(const MeshSpace &space, const EdgeForm &form, const PairWays &ways,
                         const physics::RadialPotential &potential, const PowerPotential &whole)
      : space_(space), form_(form), ways_(ways), horizon_(potential.horizon()),
        has_whole_(!whole.is_none()), integrals_(potential, whole, form.longest),
        middles_(search_points(middles(form)))
  {
    for (const Edge &edge : form.edges)
      largest_radius_ = std::max(largest_radius_, edge.radius);
  }

  void EdgeGroups::integrate(std::size_t first, std::size_t last, Scratch &scratch,
                             EdgeGroup &group) const
  {
    find_near(first, last, scratch);
    find_nodes(first, last, scratch, group);
    const std::size_t n_columns = group.columns.size();
    group.values.assign(group.rows.size() * n_columns, 0);
    scratch.ways.resize(group.rows.size() * n_columns);
    for (std::size_t r = 0; r < group.rows.size(); ++r)
      for (std::size_t c = 0; c < n_columns; ++c)
        scratch.ways[r * n_columns + c] = static_cast<char>(ways_(group.rows[r], group.columns[c]));

    const Edge &edge = form_.edges[first];
    scratch.from_start.resize(scratch.near.size());
    for (std::size_t k = 0; k < scratch.near.size(); ++k)
      scratch.from_start[k] = from_point(edge.segment.start, form_.edges[scratch.near[k]]);
    for (std::size_t e = first; e < last; ++e)
    {
      sum_partners(e, group, scratch);
      add_rows(form_.edges[e], group, scratch);
    }
  }

  /// Whether their pair is needed: one of their nodes' pairs is neither whole nor none, or
  /// whole ones are no products.
  bool EdgeGroups::is_near(const Edge &e, const Edge &f) const
  {
    return e.segment.middle().distance(f.segment.middle()) <
               ways_.farthest_out() + e.radius + f.radius &&
           (has_whole_ || sees_circle(e, f));
  }

  bool EdgeGroups::sees_circle(const Edge &e, const Edge &f) const
  {
    return e.segment.middle().distance(f.segment.middle()) > horizon_ - e.radius - f.radius;
  }

  /// Q, with what is cut at the circle where sides that see it may ask for it.
  Potentials EdgeGroups::from_point(const Point<2> &v, const Edge &e) const
  {
    const double margin = 2 * largest_radius_ + form_.longest;
    return integrals_.from_point(v, e.segment, v.distance(e.segment.middle()) > horizon_ - margin);
  }

  /// Edges that an edge of the group has a pair with, each pair once: numbers from first on.
  void EdgeGroups::find_near(std::size_t first, std::size_t last, Scratch &scratch) const
  {
    double reach = 0;
    const Point<2> &center = form_.edges[first].segment.start;
    for (std::size_t e = first; e < last; ++e)
      reach =
          std::max(reach, form_.edges[e].radius + form_.edges[e].segment.middle().distance(center));
    middles_.find(box_about(center, ways_.farthest_out() + reach + largest_radius_), scratch.found);
    scratch.near.clear();
    for (const unsigned int f : scratch.found)
      if (f >= first && std::any_of(form_.edges.begin() + static_cast<std::ptrdiff_t>(first),
                                    form_.edges.begin() + static_cast<std::ptrdiff_t>(last),
                                    [&](const Edge &e) { return is_near(e, form_.edges[f]); }))
        scratch.near.push_back(f);
  }

  /// The nodes of the group's edges, and of all that are near them.
  void EdgeGroups::find_nodes(std::size_t first, std::size_t last, Scratch &scratch,
                              EdgeGroup &group) const
  {
    group.rows.clear();
    group.columns.clear();
    const auto take = [](const Edge &edge, std::vector<unsigned int> &nodes)
    { nodes.insert(nodes.end(), edge.node.begin(), edge.node.begin() + edge.n_nodes); };
    const auto sort = [](std::vector<unsigned int> &nodes)
    {
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    };
    for (std::size_t e = first; e < last; ++e)
      take(form_.edges[e], group.rows);
    for (const unsigned int f : scratch.near)
      take(form_.edges[f], group.columns);
    sort(group.rows);
    sort(group.columns);
    scratch.slot.resize(space_.n_dofs());
    for (unsigned int c = 0; c < group.columns.size(); ++c)
      scratch.slot[group.columns[c]] = c;
  }

  /// Σ_f J(f) D(e, f) over later edges f, e itself by half.
  void EdgeGroups::sum_partners(std::size_t e, const EdgeGroup &group, Scratch &scratch) const
  {
    const Edge &edge = form_.edges[e];
    scratch.sums.assign(group.columns.size(), {});
    scratch.to_edge.resize(group.columns.size());
    scratch.has_edge.assign(group.columns.size(), 0);
    const auto to_edge = [&](unsigned int node)
    {
      const unsigned int slot = scratch.slot[node];
      if (scratch.has_edge[slot] == 0)
        scratch.to_edge[slot] = from_point(space_.support(node), edge);
      scratch.has_edge[slot] = 1;
      return scratch.to_edge[slot];
    };
    for (std::size_t k = 0; k < scratch.near.size(); ++k)
    {
      const unsigned int f = scratch.near[k];
      const Edge &other = form_.edges[f];
      if (f < e || !is_near(edge, other))
        continue;
      Potentials d;
      if (EdgeIntegrals::is_parallel(edge.segment, other.segment))
        d = integrals_.between_parallel(edge.segment, other.segment, sees_circle(edge, other));
      else
        d = integrals_.between(edge.segment, other.segment,
                               {scratch.from_start[k], from_point(edge.segment.end(), other)},
                               {to_edge(other.node[0]), to_edge(other.node[1])});
      const double factor = f == e ? .5 : 1;
      for (unsigned int n = 0; n < other.n_nodes; ++n)
        scratch.sums[scratch.slot[other.node[n]]].add(factor * other.jump[n], d);
    }
  }

  void EdgeGroups::add_rows(const Edge &edge, EdgeGroup &group, const Scratch &scratch) const
  {
    const std::size_t n_columns = group.columns.size();
    for (unsigned int n = 0; n < edge.n_nodes; ++n)
    {
      const auto row = static_cast<std::size_t>(
          std::lower_bound(group.rows.begin(), group.rows.end(), edge.node[n]) -
          group.rows.begin());
      double *const to = &group.values[row * n_columns];
      const char *const way = &scratch.ways[row * n_columns];
      for (std::size_t c = 0; c < n_columns; ++c)
      {
        const Potentials &sum = scratch.sums[c];
        switch (static_cast<PairWay>(way[c]))
        {
        case PairWay::none:
          break;
        case PairWay::whole:
          to[c] += edge.jump[n] * sum.whole;
          break;
        case PairWay::in:
          to[c] += edge.jump[n] * sum.in;
          break;
        case PairWay::out:
          to[c] += edge.jump[n] * (sum.whole - sum.out);
        }
      }
    }
  }
} // namespace plumbline::reference
