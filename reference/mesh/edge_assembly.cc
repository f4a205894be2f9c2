#include "reference/mesh/edge_assembly.h"

#include "geometry/search.h"
#include "reference/mesh/edge_form.h"
#include "reference/mesh/rows.h"

#include <deal.II/base/work_stream.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::reference
{
  namespace
  {
    /// What is not symmetric: S with ∬ C φ_i(x) φ_j(y) = S_ij + S_ji, but for whole pairs; rows of
    /// free nodes hold all columns, those of others free ones.
    struct HalfMatrix
    {
      std::vector<std::size_t> start;
      std::vector<unsigned int> column;
      std::vector<double> value;

      std::size_t find(unsigned int row, unsigned int col) const
      {
        const auto first = column.begin() + static_cast<std::ptrdiff_t>(start[row]),
                   last = column.begin() + static_cast<std::ptrdiff_t>(start[row + 1]);
        const auto at = std::lower_bound(first, last, col);
        return static_cast<std::size_t>(at - column.begin());
      }
    };

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

    /// The edges of one first end, and what they give to rows of their nodes.
    struct Group
    {
      std::vector<unsigned int> rows, columns; ///< nodes, ascending
      std::vector<double> values;              ///< shape (n_rows, n_columns)
    };

    class EdgeAssembly
    {
    public:
      EdgeAssembly(const MeshSpace &space, const EdgeForm &form, const PairWays &ways,
                   const physics::RadialPotential &potential, const PowerPotential &whole)
          : space_(space), form_(form), ways_(ways), horizon_(potential.horizon()),
            has_whole_(!whole.is_none()), integrals_(potential, whole, form.longest),
            middles_(search_points(middles(form)))
      {
        for (const Edge &edge : form.edges)
          largest_radius_ = std::max(largest_radius_, edge.radius);
      }

      /// A worker's own memory.
      struct Scratch
      {
        std::vector<unsigned int> near, found, slot; ///< edges; of each node among the columns
        std::vector<Potentials> from_start, to_edge, sums; ///< Q and Σ J D
        std::vector<char> has_edge, ways;
      };

      void integrate(std::size_t first, std::size_t last, Scratch &scratch, Group &group) const
      {
        find_near(first, last, scratch);
        find_nodes(first, last, scratch, group);
        const std::size_t n_columns = group.columns.size();
        group.values.assign(group.rows.size() * n_columns, 0);
        scratch.ways.resize(group.rows.size() * n_columns);
        for (std::size_t r = 0; r < group.rows.size(); ++r)
          for (std::size_t c = 0; c < n_columns; ++c)
            scratch.ways[r * n_columns + c] =
                static_cast<char>(ways_(group.rows[r], group.columns[c]));

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

    private:
      static std::vector<Point<2>> middles(const EdgeForm &form)
      {
        std::vector<Point<2>> points;
        for (const Edge &edge : form.edges)
          points.push_back(edge.segment.middle());
        return points;
      }

      /// Whether their pair is needed: one of their nodes' pairs is neither whole nor none, or
      /// whole ones are no products.
      bool is_near(const Edge &e, const Edge &f) const
      {
        return e.segment.middle().distance(f.segment.middle()) <
                   ways_.farthest_out() + e.radius + f.radius &&
               (has_whole_ || sees_circle(e, f));
      }

      bool sees_circle(const Edge &e, const Edge &f) const
      {
        return e.segment.middle().distance(f.segment.middle()) > horizon_ - e.radius - f.radius;
      }

      /// Q, with what is cut at the circle where sides that see it may ask for it.
      Potentials from_point(const Point<2> &v, const Edge &e) const
      {
        const double margin = 2 * largest_radius_ + form_.longest;
        return integrals_.from_point(v, e.segment,
                                     v.distance(e.segment.middle()) > horizon_ - margin);
      }

      /// Edges that an edge of the group has a pair with, each pair once: numbers from first on.
      void find_near(std::size_t first, std::size_t last, Scratch &scratch) const
      {
        double reach = 0;
        const Point<2> &center = form_.edges[first].segment.start;
        for (std::size_t e = first; e < last; ++e)
          reach = std::max(reach, form_.edges[e].radius +
                                      form_.edges[e].segment.middle().distance(center));
        middles_.find(box_about(center, ways_.farthest_out() + reach + largest_radius_),
                      scratch.found);
        scratch.near.clear();
        for (const unsigned int f : scratch.found)
          if (f >= first && std::any_of(form_.edges.begin() + static_cast<std::ptrdiff_t>(first),
                                        form_.edges.begin() + static_cast<std::ptrdiff_t>(last),
                                        [&](const Edge &e) { return is_near(e, form_.edges[f]); }))
            scratch.near.push_back(f);
      }

      /// The nodes of the group's edges, and of all that are near them.
      void find_nodes(std::size_t first, std::size_t last, Scratch &scratch, Group &group) const
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
      void sum_partners(std::size_t e, const Group &group, Scratch &scratch) const
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

      void add_rows(const Edge &edge, Group &group, const Scratch &scratch) const
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

      const MeshSpace &space_;
      const EdgeForm &form_;
      const PairWays &ways_;
      double horizon_, largest_radius_ = 0;
      bool has_whole_;
      EdgeIntegrals integrals_;
      geometry::BoxSearch middles_;
    };

    HalfMatrix make_half(const MeshSpace &space, const EdgeForm &form, const PairWays &ways,
                         double horizon)
    {
      std::vector<Point<2>> points;
      for (std::size_t dof = 0; dof < space.n_dofs(); ++dof)
        points.push_back(space.support(dof));
      const geometry::BoxSearch nodes = search_points(points);
      const double largest = *std::max_element(form.radius.begin(), form.radius.end());
      std::vector<std::vector<unsigned int>> columns(space.n_dofs());
      in_parallel(
          space.n_dofs(),
          [&](std::size_t first, std::size_t last)
          {
            std::vector<unsigned int> found;
            for (std::size_t row = first; row < last; ++row)
            {
              const auto i = static_cast<unsigned int>(row);
              nodes.find(box_about(points[row], horizon + form.radius[row] + largest), found);
              for (const unsigned int j : found)
                if ((i < space.n_free() || j < space.n_free()) && ways(i, j) != PairWay::none)
                  columns[row].push_back(j);
            }
          });
      HalfMatrix half;
      half.start.assign(1, 0);
      for (const auto &row : columns)
        half.start.push_back(half.start.back() + row.size());
      half.column.reserve(half.start.back());
      for (auto &row : columns)
      {
        half.column.insert(half.column.end(), row.begin(), row.end());
        row = {};
      }
      half.value.assign(half.column.size(), 0);
      return half;
    }

    void add(const Group &group, HalfMatrix &half)
    {
      const double *value = group.values.data();
      for (const unsigned int row : group.rows)
      {
        std::size_t k = half.start[row];
        const std::size_t end = half.start[row + 1];
        for (const unsigned int column : group.columns)
        {
          while (k < end && half.column[k] < column)
            ++k;
          if (k < end && half.column[k] == column)
            half.value[k] += *value;
          ++value;
        }
      }
    }

    /// The first edges of groups in the order of assembly, and the end of the last.
    std::vector<std::size_t> group_starts(const EdgeForm &form)
    {
      std::vector<std::size_t> starts;
      for (std::size_t e = 0; e < form.n_active; ++e)
        if (e == 0 || form.edges[e].node[0] != form.edges[e - 1].node[0])
          starts.push_back(e);
      starts.push_back(form.n_active);
      return starts;
    }

    /// Sum of all groups of this rank's share.
    void add_groups(const MeshSpace &space, const EdgeForm &form, const PairWays &ways,
                    const physics::RadialPotential &potential, const PowerPotential &whole,
                    const base::Team &team, HalfMatrix &half)
    {
      const EdgeAssembly assembly(space, form, ways, potential, whole);
      const std::vector<std::size_t> starts = group_starts(form);
      const auto [first, last] = team.share(starts.size() - 1);
      std::vector<std::size_t> own(last - first);
      std::iota(own.begin(), own.end(), first);
      dealii::WorkStream::run(
          own.begin(), own.end(),
          [&](const std::vector<std::size_t>::iterator &g, EdgeAssembly::Scratch &scratch,
              Group &group) { assembly.integrate(starts[*g], starts[*g + 1], scratch, group); },
          [&](const Group &group) { add(group, half); }, EdgeAssembly::Scratch(), Group());
    }

    /// Add ∫C times the mass matrix of free rows.
    void add_mass(const MeshSpace &space, double of_ball, algebra::Rows &rows)
    {
      for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
      {
        const unsigned int *const dof = space.dofs(cell);
        const double share = of_ball * space.map(cell).determinant({}) / 24;
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3 && dof[a] < space.n_free(); ++b)
          {
            const auto first =
                           rows.column.begin() + static_cast<std::ptrdiff_t>(rows.start[dof[a]]),
                       last = rows.column.begin() +
                              static_cast<std::ptrdiff_t>(rows.start[dof[a] + 1]);
            const auto at = std::lower_bound(first, last, dof[b]);
            rows.value[static_cast<std::size_t>(at - rows.column.begin())] +=
                a == b ? 2 * share : share;
          }
      }
    }

    /// Entries ∬ C φ_i(x) (φ_j(x) - φ_j(y)) of free rows that this rank has a share in; what one
    /// rank alone must give, if `is_first`.
    algebra::Rows combine(const MeshSpace &space, const EdgeForm &form, const PairWays &ways,
                          const physics::Kernel<2> &kernel, HalfMatrix half, bool is_product,
                          bool is_first)
    {
      algebra::Rows rows;
      rows.start.assign(half.start.begin(),
                        half.start.begin() + static_cast<std::ptrdiff_t>(space.n_free()) + 1);
      rows.column.assign(half.column.begin(),
                         half.column.begin() + static_cast<std::ptrdiff_t>(rows.start.back()));
      rows.value.resize(rows.column.size());
      const double density = kernel.radial(kernel.horizon());
      in_parallel(space.n_free(),
                  [&](std::size_t first, std::size_t last)
                  {
                    for (std::size_t row = first; row < last; ++row)
                      for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
                      {
                        const auto i = static_cast<unsigned int>(row), j = rows.column[k];
                        double value = half.value[k] + half.value[half.find(j, i)];
                        const PairWay way = ways(i, j);
                        if (is_product && is_first &&
                            (way == PairWay::whole || way == PairWay::out))
                          value += density * (form.integral[i] * form.integral[j]);
                        rows.value[k] = -value;
                      }
                  });
      if (is_first)
        add_mass(space, kernel.moment({0, 0}), rows);
      return rows;
    }

    /// The largest distance of points that potentials are asked for.
    double reach(const MeshSpace &space, const EdgeForm &form, double horizon)
    {
      double largest = 0;
      for (const Edge &edge : form.edges)
        largest = std::max(largest, edge.radius);
      return PairWays(space, form, horizon).farthest_out() + 2 * largest + form.longest;
    }
  } // namespace

  std::string refuse_edges(const MeshSpace &space, const physics::Kernel<2> &kernel)
  {
    if (space.shapes().degree() != 1)
      return "the degree is not 1";
    if (kernel.structure() != physics::Structure::scalar)
      return "the kernel is a tensor";
    if (!kernel.breaks().empty() || kernel.profile().is_function())
      return "the kernel is no sum of powers";
    const EdgeForm form(space);
    constexpr double most_slender = 30; // terms are larger than their sum by its square
    if (form.most_slender > most_slender)
      return "some triangle is more than " + std::to_string(static_cast<int>(most_slender)) +
             " times longer than high";
    const double horizon = kernel.horizon(), width = geometry::collar_width(space.mesh());
    constexpr double rounding = 1e-8; // of meshes read from files
    const auto first_held =
        form.is_at_outside.begin() + static_cast<std::ptrdiff_t>(space.n_free());
    if (width < horizon * (1 - rounding) ||
        std::any_of(form.is_at_outside.begin(), first_held, [](char is) { return is != 0; }))
      return "balls reach beyond the mesh";
    double widest = 0; // of supports that end at the outside, where potentials do not see them
    for (std::size_t dof = space.n_free(); dof < space.n_dofs(); ++dof)
      if (form.is_at_outside[dof] != 0)
        widest = std::max(widest, form.radius[dof]);
    constexpr double farthest = 8; // pairs of nodes, in horizons: the length of tables
    if (width - widest < .2 * horizon || reach(space, form, horizon) > farthest * horizon)
      return "triangles are large in relation to the horizon";
    return "";
  }

  algebra::Rows assemble_by_edges(const MeshSpace &space, const physics::Kernel<2> &kernel,
                                  const base::Team &team)
  {
    const EdgeForm form(space);
    const PairWays ways(space, form, kernel.horizon());
    const PowerPotential whole(kernel);
    HalfMatrix half = make_half(space, form, ways, kernel.horizon());
    const double farthest = reach(space, form, kernel.horizon()) / kernel.horizon();
    const physics::RadialPotential potential(kernel, 1 - farthest * farthest);
    add_groups(space, form, ways, potential, whole, team, half);
    return combine(space, form, ways, kernel, std::move(half), whole.is_none(), team.rank() == 0);
  }
} // namespace plumbline::reference
