#include "reference/mesh/edge_assembly.h"

#include "reference/mesh/edge_groups.h"
#include "reference/mesh/rows.h"

#include <deal.II/base/work_stream.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

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
      std::vector<double> value; ///< shape (n_columns, n_entries)
      std::uint64_t n_pairs = 0; ///< of edges in it

      std::size_t find(unsigned int row, unsigned int col) const
      {
        const auto first = column.begin() + static_cast<std::ptrdiff_t>(start[row]),
                   last = column.begin() + static_cast<std::ptrdiff_t>(start[row + 1]);
        const auto at = std::lower_bound(first, last, col);
        return static_cast<std::size_t>(at - column.begin());
      }
    };

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

    /// What this rank has of the assembly.
    struct Share
    {
      Share(const MeshSpace &space, const EdgeForm &form, const base::Communicator &communicator)
          : group_start(group_starts(form)), has_row(space.n_dofs())
      {
        std::tie(first_group, last_group) = communicator.owned_range(group_start.size() - 1);
        std::tie(first_node, last_node) = communicator.owned_range(space.n_free());
        for (std::size_t e = group_start[first_group]; e < group_start[last_group]; ++e)
          for (unsigned int k = 0; k < form.edges[e].n_nodes; ++k)
            has_row[form.edges[e].node[k]] = 1;
        for (std::size_t node = first_node; node < last_node; ++node)
          has_row[node] = 1;
      }

      /// Whether this rank gives what one alone must give to a pair of nodes, one of them free.
      bool owns(unsigned int i, unsigned int j) const
      {
        const std::size_t first = std::min(i, j); // free ones have the lower numbers
        return first_node <= first && first < last_node;
      }

      std::vector<std::size_t> group_start; ///< of all ranks
      std::size_t first_group = 0, last_group = 0;
      std::size_t first_node = 0, last_node = 0; ///< free ones that it owns
      std::vector<char> has_row; ///< of all nodes: those it owns, and those of its groups
    };

    /// Whether two boxes share a point.
    bool meet(const geometry::Box &a, const geometry::Box &b)
    {
      return a.lower[0] <= b.upper[0] && b.lower[0] <= a.upper[0] && a.lower[1] <= b.upper[1] &&
             b.lower[1] <= a.upper[1];
    }

    /// Around the nodes of a share.
    geometry::Box box_of(const MeshSpace &space, const Share &share)
    {
      constexpr double far = std::numeric_limits<double>::max();
      geometry::Box box{Point<2>(far, far), Point<2>(-far, -far)};
      for (std::size_t dof = 0; dof < space.n_dofs(); ++dof)
        for (unsigned int d = 0; d < 2 && share.has_row[dof] != 0; ++d)
        {
          box.lower[d] = std::min(box.lower[d], space.support(dof)[d]);
          box.upper[d] = std::max(box.upper[d], space.support(dof)[d]);
        }
      return box;
    }

    /// Places of pairs of nodes of which the share has a row, in both orders.
    HalfMatrix make_half(const MeshSpace &space, const EdgeForm &form, const PairWays &ways,
                         double horizon, unsigned int n_entries, const Share &share)
    {
      std::vector<Point<2>> points;
      for (std::size_t dof = 0; dof < space.n_dofs(); ++dof)
        points.push_back(space.support(dof));
      const geometry::BoxSearch<2> nodes = search_points(points);
      const geometry::Box all = box_of(space, share);
      const double largest = *std::max_element(form.radius.begin(), form.radius.end());
      std::vector<std::vector<unsigned int>> columns(space.n_dofs());
      in_parallel(space.n_dofs(),
                  [&](std::size_t first, std::size_t last)
                  {
                    std::vector<unsigned int> found, own;
                    for (std::size_t row = first; row < last; ++row)
                    {
                      const auto i = static_cast<unsigned int>(row);
                      const geometry::Box near =
                          box_about(points[row], horizon + form.radius[row] + largest);
                      if (!meet(near, all))
                        continue;
                      nodes.find(near, found);
                      own.clear();
                      for (const unsigned int j : found)
                        if ((share.has_row[i] != 0 || share.has_row[j] != 0) &&
                            (i < space.n_free() || j < space.n_free()) &&
                            ways(i, j) != PairWay::none)
                          own.push_back(j);
                      columns[row] = own; // no longer than it must be
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
        std::vector<unsigned int>().swap(row); // clearing would keep its memory
      }
      half.value.assign(half.column.size() * n_entries, 0);
      return half;
    }

    template <unsigned int n>
    void add(const EdgeGroup &group, HalfMatrix &half)
    {
      half.n_pairs += group.n_pairs;
      const double *value = group.values.data();
      for (const unsigned int row : group.rows)
      {
        std::size_t k = half.start[row];
        const std::size_t end = half.start[row + 1];
        for (const unsigned int column : group.columns)
        {
          while (k < end && half.column[k] < column)
            ++k;
          for (unsigned int i = 0; i < n && k < end && half.column[k] == column; ++i)
            half.value[k * n + i] += value[i];
          value += n;
        }
      }
    }

    /// Sum of all groups of this rank's share.
    template <unsigned int n>
    void add_groups(const MeshSpace &space, const EdgeForm &form, const PairWays &ways,
                    const physics::Kernel<2> &kernel, const WholePotential &whole,
                    const Share &share, HalfMatrix &half)
    {
      const typename EdgeIntegrals<n>::Tables potential(kernel, 0);
      const EdgeGroups<n> groups(space, form, ways, potential, whole);
      const std::vector<std::size_t> &starts = share.group_start;
      std::vector<std::size_t> own(share.last_group - share.first_group);
      std::iota(own.begin(), own.end(), share.first_group);
      using Scratch = typename EdgeGroups<n>::Scratch;
      dealii::WorkStream::run(
          own.begin(), own.end(),
          [&](const std::vector<std::size_t>::iterator &g, Scratch &scratch, EdgeGroup &group)
          { groups.integrate(starts[*g], starts[*g + 1], scratch, group); },
          [&](const EdgeGroup &group) { add<n>(group, half); }, Scratch(), EdgeGroup());
    }

    /// Take off half of ∬ C φ_i(x) φ_j(x), the mass matrix times ∫C, of pairs that the share owns.
    void subtract_mass(const MeshSpace &space, const Share &own, double of_ball,
                       unsigned int n_entries, HalfMatrix &half)
    {
      for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
      {
        const unsigned int *const dof = space.dofs(cell);
        const double share = of_ball * space.map(cell).determinant({}) / 24;
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            if (own.owns(dof[a], dof[b]))
              half.value[half.find(dof[a], dof[b]) * n_entries] -= a == b ? share : .5 * share;
      }
    }

    /// The entries of a 2 x 2 block, see Potentials.
    double entry(const std::array<double, 3> &value, unsigned int a, unsigned int b)
    {
      return a != b ? value[2] : a == 0 ? value[0] + value[1] : value[0] - value[1];
    }

    /// The constant term of a kernel, whose whole pairs are products.
    struct Constant
    {
      PairWays ways;
      double value;
    };

    /// Entries ∬ C φ_i(x) (φ_j(x) - φ_j(y)) of pairs of nodes.
    /// @param constants  of the parts of the kernel
    template <unsigned int n>
    class Entries
    {
    public:
      Entries(const EdgeForm &form, const Share &own, const std::vector<Constant> &constants,
              const HalfMatrix &half)
          : form_(form), own_(own), constants_(constants), half_(half)
      {
      }

      /// @param k, other  where (i, j) and (j, i) stand in the half
      std::array<double, n> operator()(std::size_t k, std::size_t other, unsigned int i,
                                       unsigned int j) const
      {
        std::array<double, n> value;
        for (unsigned int e = 0; e < n; ++e)
          value[e] = -(half_.value[k * n + e] + half_.value[other * n + e]);
        for (const Constant &constant : constants_)
          if (own_.owns(i, j) && constant.ways(i, j) == PairWay::whole)
            value[0] -= constant.value * (form_.integral[i] * form_.integral[j]);
        return value;
      }

    private:
      const EdgeForm &form_;
      const Share &own_;
      const std::vector<Constant> &constants_;
      const HalfMatrix &half_;
    };

    /// Free rows in place of the half: at the peak a scalar matrix takes 12 bytes an entry.
    algebra::CsrMatrix combine(const MeshSpace &space, const Entries<1> &entries, HalfMatrix &half)
    {
      const auto n_free = static_cast<unsigned int>(space.n_free());
      in_parallel(n_free,
                  [&](std::size_t first, std::size_t last)
                  {
                    for (auto i = static_cast<unsigned int>(first); i < last; ++i)
                      for (std::size_t k = half.start[i]; k < half.start[i + 1]; ++k)
                      {
                        const unsigned int j = half.column[k];
                        if (j < i)
                          continue; // with its mirror image
                        const std::size_t other = half.find(j, i);
                        half.value[k] = entries(k, other, i, j)[0];
                        if (j < n_free)
                          half.value[other] = half.value[k];
                      }
                  });
      half.start.resize(n_free + 1);
      half.column.resize(half.start.back());
      half.value.resize(half.start.back());
      return {std::move(half.start), std::move(half.column), std::move(half.value)};
    }

    /// The same of tensors, of which every pair of nodes has a block of 2 x 2.
    algebra::CsrMatrix combine(const MeshSpace &space, const Entries<3> &entries, HalfMatrix &half)
    {
      algebra::CsrMatrix rows;
      rows.start.assign(1, 0);
      for (unsigned int dof = 0; dof < space.n_free(); ++dof)
        for (unsigned int c = 0; c < 2; ++c)
          rows.start.push_back(rows.start.back() + 2 * (half.start[dof + 1] - half.start[dof]));
      rows.column.resize(rows.start.back());
      rows.value.resize(rows.start.back());
      const auto make_row = [&](unsigned int i)
      {
        for (std::size_t k = half.start[i]; k < half.start[i + 1]; ++k)
        {
          const unsigned int j = half.column[k];
          const std::array<double, 3> value = entries(k, half.find(j, i), i, j);
          for (unsigned int a = 0; a < 2; ++a)
            for (unsigned int b = 0; b < 2; ++b)
            {
              const std::size_t to = rows.start[i * 2 + a] + (k - half.start[i]) * 2 + b;
              rows.column[to] = j * 2 + b;
              rows.value[to] = entry(value, a, b);
            }
        }
      };
      in_parallel(space.n_free(),
                  [&](std::size_t first, std::size_t last)
                  {
                    for (std::size_t row = first; row < last; ++row)
                      make_row(static_cast<unsigned int>(row));
                  });
      return rows;
    }

    /// The largest distance of points that the whole potential is asked for.
    double reach(const EdgeForm &form, const PairWays &ways)
    {
      return ways.farthest_whole() + 2 * *std::max_element(form.radius.begin(), form.radius.end());
    }

    /// @param parts  of a kernel, without breaks, the one with the longest horizon first: places of
    /// the others are some of its
    template <unsigned int n>
    algebra::CsrMatrix
    assemble_parts(const MeshSpace &space, const std::vector<physics::Kernel<2>> &parts,
                   const base::Communicator &communicator, std::uint64_t *n_pairs)
    {
      const EdgeForm form(space);
      const Share share(space, form, communicator);
      HalfMatrix half = make_half(space, form, PairWays(space, form, parts.front()),
                                  parts.front().horizon(), n, share);
      std::vector<Constant> constants;
      for (const physics::Kernel<2> &part : parts)
      {
        const PairWays ways(space, form, part);
        const WholePotential whole(part, reach(form, ways), form.longest);
        add_groups<n>(space, form, ways, part, whole, share, half);
        subtract_mass(space, share, part.moment({0, 0}), n, half);
        constants.push_back({ways, whole.constant()});
      }
      if (n_pairs != nullptr)
        *n_pairs = half.n_pairs;
      return combine(space, Entries<n>(form, share, constants, half), half);
    }

    /// Why a kernel whose profile has no breaks cannot have its matrix; empty: it can.
    std::string refuse_smooth(const MeshSpace &space, const EdgeForm &form,
                              const physics::Kernel<2> &kernel)
    {
      const PairWays ways(space, form, kernel);
      const double horizon = kernel.horizon(), width = geometry::collar_width(space.mesh());
      constexpr double rounding = 1e-8; // of meshes read from files
      const auto first_constrained =
          form.is_at_outside.begin() + static_cast<std::ptrdiff_t>(space.n_free());
      if (width < horizon * (1 - rounding) ||
          std::any_of(form.is_at_outside.begin(), first_constrained,
                      [](char is) { return is != 0; }))
        return "balls reach beyond the mesh";
      double widest = 0; // of supports that end at the outside, where potentials do not see them
      for (std::size_t dof = space.n_free(); dof < space.n_dofs(); ++dof)
        if (form.is_at_outside[dof] != 0)
          widest = std::max(widest, form.radius[dof]);
      constexpr double farthest = 7; // points, in horizons: the length of tables
      if (width - widest < .2 * horizon || reach(form, ways) > farthest * horizon)
        return "triangles are large in relation to the horizon";
      return WholePotential::refuse(kernel);
    }
  } // namespace

  std::string refuse_edges(const MeshSpace &space, const physics::Kernel<2> &kernel)
  {
    if (space.shapes().degree() != 1)
      return "the degree is not 1";
    constexpr std::size_t most_breaks = 7; // each costs as much as a kernel
    if (kernel.breaks().size() > most_breaks)
      return "the kernel's profile has more than " + std::to_string(most_breaks) + " breaks";
    const EdgeForm form(space);
    constexpr double most_slender = 30; // terms are larger than their sum by its square
    if (form.most_slender > most_slender)
      return "some triangle is more than " + std::to_string(static_cast<int>(most_slender)) +
             " times longer than high";
    for (const physics::Kernel<2> &part : kernel.parts())
      if (const std::string reason = refuse_smooth(space, form, part); !reason.empty())
        return reason;
    return "";
  }

  algebra::CsrMatrix assemble_by_edges(const MeshSpace &space, const physics::Kernel<2> &kernel,
                                       const base::Communicator &communicator,
                                       std::uint64_t *n_pairs)
  {
    auto parts = kernel.parts();
    std::sort(parts.begin(), parts.end(),
              [](const auto &a, const auto &b) { return a.horizon() > b.horizon(); });
    return kernel.structure() == physics::Structure::scalar
               ? assemble_parts<1>(space, parts, communicator, n_pairs)
               : assemble_parts<3>(space, parts, communicator, n_pairs);
  }
} // namespace plumbline::reference
