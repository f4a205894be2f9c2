#include "reference/mesh/edge_assembly.h"

#include "reference/mesh/edge_groups.h"
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

    void add(const EdgeGroup &group, HalfMatrix &half)
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
      const EdgeGroups groups(space, form, ways, potential, whole);
      const std::vector<std::size_t> starts = group_starts(form);
      const auto [first, last] = team.share(starts.size() - 1);
      std::vector<std::size_t> own(last - first);
      std::iota(own.begin(), own.end(), first);
      dealii::WorkStream::run(
          own.begin(), own.end(),
          [&](const std::vector<std::size_t>::iterator &g, EdgeGroups::Scratch &scratch,
              EdgeGroup &group) { groups.integrate(starts[*g], starts[*g + 1], scratch, group); },
          [&](const EdgeGroup &group) { add(group, half); }, EdgeGroups::Scratch(), EdgeGroup());
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
