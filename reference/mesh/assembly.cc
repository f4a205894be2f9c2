#include "reference/mesh/assembly.h"

#include "base/error.h"
#include "reference/mesh/cell_constants.h"
#include "reference/mesh/edge_assembly.h"
#include "reference/mesh/number_set.h"
#include "reference/mesh/pair_quadrature.h"
#include "reference/mesh/polygon_pairs.h"
#include "reference/mesh/rectangle_pairs.h"
#include "reference/mesh/repeated_pairs.h"
#include "reference/mesh/rows.h"

#include <deal.II/base/parallel.h>
#include <deal.II/base/work_stream.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <mutex>

namespace plumbline::reference
{
  namespace
  {
    /// Whether pairs of these two cells take their outer points on the first: a cell of Ω before
    /// one of the collar, a smaller one before a larger, else the first in number.
    bool is_outer(const geometry::Mesh &mesh, const MeshCells &cells, std::size_t a, std::size_t b)
    {
      if (mesh.cells[a].is_inside != mesh.cells[b].is_inside)
        return mesh.cells[a].is_inside;
      const double ratio = cells.area(a) / cells.area(b);
      constexpr double clearly = 1e-6;
      return ratio < 1 - clearly || (ratio <= 1 + clearly && a <= b);
    }

    /// Blocks of pairs of cells by whichever way is exact.
    class PairIntegrator
    {
    public:
      PairIntegrator(const MeshSpace &space, const MeshCells &cells,
                     const physics::Kernel<2> &kernel, const KernelEntries &profile,
                     const std::optional<physics::Coefficient> &coefficient,
                     const AssemblyOptions &options)
          : cells_(cells), coefficient_(coefficient),
            of_cells_(coefficient
                          ? constants_in_cells(
                                space, cells, [&](const Point<2> &x) { return coefficient->at(x); })
                          : std::vector<double>()),
            by_quadrature_(space, cells, profile, kernel.horizon(),
                           of_cells_.empty() ? coefficient : std::nullopt, options.refinement,
                           options.backend),
            cracks_(options.cracks)
      {
        if (!options.exact_entries || has_changing_coefficient())
          return;
        if (space.shapes().n_vertices() == 4)
          by_correlation_.emplace(space.shapes(), profile, kernel.horizon(), options.backend);
        if ((!by_correlation_ || !are_rectangles()) && PolygonPairs::refuse(space, kernel).empty())
          for (const physics::Kernel<2> &part : kernel.parts())
            by_sides_.emplace_back(space, cells, part);
      }

      /// Whether quadrature, which knows straight sides alone, would be asked for curved ones.
      bool is_at_loss() const
      {
        return cells_.has_curves() &&
               (!cracks_.empty() || by_sides_.empty() || !by_sides_[0].exceptions().empty());
      }

      bool has_changing_coefficient() const { return coefficient_ && of_cells_.empty(); }

      bool has_curves() const { return cells_.has_curves(); }

      bool are_rectangles() const
      {
        for (std::size_t cell = 0; cell < cells_.size(); ++cell)
          if (!cells_.is_rectangle(cell))
            return false;
        return true;
      }

      bool is_exact(std::size_t a, std::size_t b) const
      {
        return is_correlation(a, b) || (!by_sides_.empty() && by_sides_[0].is_exact(a, b));
      }

      /// Of pairs that are not exact though others are, in words; empty: there are none.
      std::string exceptions() const { return by_sides_.empty() ? "" : by_sides_[0].exceptions(); }

      /// Past all cracks between two cells. @param between  overwritten with these
      geometry::Sight look(std::size_t outer, std::size_t inner,
                           std::vector<geometry::Cut> &between) const
      {
        return geometry::find_between(cracks_, cells_[outer].vertices(), cells_[inner].vertices(),
                                      between);
      }

      /// As `integrate`, past cracks.
      void integrate_visible(std::size_t outer, std::size_t inner,
                             const std::vector<geometry::Cut> &between, PairBlocks &blocks)
      {
        by_quadrature_.integrate(outer, inner, blocks, between);
      }

      /// Without cracks, and without coefficients that are constant in cells.
      void integrate(std::size_t outer, std::size_t inner, PairBlocks &blocks)
      {
        const bool is_straight = !cells_.is_curved(outer) && !cells_.is_curved(inner);
        if ((is_straight && by_quadrature_.is_product(outer, inner)) || !is_exact(outer, inner))
          by_quadrature_.integrate(outer, inner, blocks);
        else if (is_correlation(outer, inner))
          by_correlation_->integrate(cells_[outer].box(), cells_[inner].box(), blocks);
        else
        {
          by_sides_[0].integrate(outer, inner, blocks);
          for (std::size_t part = 1; part < by_sides_.size(); ++part)
          {
            by_sides_[part].integrate(outer, inner, blocks_of_part_);
            blocks.add(blocks_of_part_);
          }
        }
      }

      /// Of the blocks.
      double factor(std::size_t outer, std::size_t inner) const
      {
        return of_cells_.empty() ? 1 : coefficient_->mean(of_cells_[outer], of_cells_[inner]);
      }

    private:
      bool is_correlation(std::size_t a, std::size_t b) const
      {
        return by_correlation_ && cells_.is_rectangle(a) && cells_.is_rectangle(b);
      }

      const MeshCells &cells_;
      std::optional<physics::Coefficient> coefficient_;
      std::vector<double> of_cells_; ///< empty: it changes inside of them
      PairQuadrature by_quadrature_;
      std::vector<geometry::Cut> cracks_;
      std::optional<RectanglePairs> by_correlation_;
      std::vector<PolygonPairs> by_sides_; ///< of each smooth part of the kernel
      PairBlocks blocks_of_part_;
    };

    /// Of each cell the pairs that have their outer points on it, for a share of the cells. A
    /// partner of another share is paired with itself: it still takes a diagonal block.
    std::vector<CellPairs> find_pairs(const MeshSpace &space, const MeshCells &cells,
                                      double horizon, const std::vector<std::size_t> &outer_cells)
    {
      const geometry::Mesh &mesh = space.mesh();
      std::vector<CellPairs> pairs(cells.size());
      in_parallel(outer_cells.size(),
                  [&](std::size_t first, std::size_t last)
                  {
                    std::vector<unsigned int> near;
                    NumberSet columns(space.n_dofs());
                    for (std::size_t i = first; i < last; ++i)
                    {
                      const std::size_t cell = outer_cells[i];
                      CellPairs &own = pairs[cell];
                      cells.find_near(cell, horizon, near);
                      std::copy_if(near.begin(), near.end(), std::back_inserter(own.partners),
                                   [&](unsigned int other)
                                   { return is_outer(mesh, cells, cell, other); });
                      for (const unsigned int partner : own.partners)
                        for (unsigned int b = 0; b < space.shapes().size(); ++b)
                          columns.insert(space.dofs(partner)[b]);
                      columns.take(own.columns);
                    }
                  });
      for (const std::size_t cell : outer_cells)
        for (const unsigned int partner : pairs[cell].partners)
          if (CellPairs &other = pairs[partner];
              other.partners.empty() && mesh.cells[partner].is_inside)
          {
            other.partners = {partner};
            other.columns.assign(space.dofs(partner), space.dofs(partner) + space.shapes().size());
            std::sort(other.columns.begin(), other.columns.end());
          }
      return pairs;
    }

    /// A worker's own memory.
    struct Scratch
    {
      PairIntegrator integrator;
      PairBlocks blocks;
      std::vector<unsigned int> slot;     ///< of each dof among the columns
      std::vector<geometry::Cut> between; ///< a pair of cells, cracks
    };

    /// Blocks of the pairs that stand for all others.
    std::vector<PairBlocks> integrate_first(const std::vector<RepeatedPairs::Pair> &first,
                                            const PairIntegrator &integrator)
    {
      std::vector<PairBlocks> blocks(first.size());
      constexpr unsigned int grain = 64;
      in_parallel(
          first.size(),
          [&](std::size_t from, std::size_t to)
          {
            PairIntegrator own = integrator;
            for (std::size_t k = from; k < to; ++k)
              own.integrate(first[k].first, first[k].second, blocks[k]);
          },
          grain);
      return blocks;
    }

    /// All pairs of a cell.
    void integrate_cell(const MeshSpace &space, const CellPairs &pairs,
                        const std::vector<PairBlocks> &first, unsigned int n_entries,
                        std::size_t cell, Scratch &scratch, CellRows &part)
    {
      const unsigned int n = space.shapes().size();
      const std::size_t block = static_cast<std::size_t>(n) * n * n_entries;
      const std::size_t n_columns = pairs.columns.size();
      part.cell = cell;
      part.is_exact = true;
      for (unsigned int k = 0; k < n_columns; ++k)
        scratch.slot[pairs.columns[k]] = k;
      part.values.assign(n * n_columns * n_entries, 0.);
      part.diagonal.assign(pairs.partners.size() * block, 0.);

      const std::size_t own = static_cast<std::size_t>(
          std::lower_bound(pairs.partners.begin(), pairs.partners.end(), cell) -
          pairs.partners.begin());
      for (std::size_t i = 0; i < pairs.partners.size(); ++i)
      {
        const unsigned int partner = pairs.partners[i];
        const geometry::Sight sight = scratch.integrator.look(cell, partner, scratch.between);
        if (sight == geometry::Sight::hidden)
          continue;
        const bool is_partial = sight == geometry::Sight::partial;
        if (is_partial)
          scratch.integrator.integrate_visible(cell, partner, scratch.between, scratch.blocks);
        else if (pairs.same.empty())
          scratch.integrator.integrate(cell, partner, scratch.blocks);
        const PairBlocks &blocks =
            is_partial || pairs.same.empty() ? scratch.blocks : first[pairs.same[i]];
        part.is_exact = part.is_exact && (is_partial || scratch.integrator.is_exact(cell, partner));
        // the cell with itself: both orders are the same pair, each counts half
        const double factor = (i == own ? .5 : 1) * scratch.integrator.factor(cell, partner);
        for (std::size_t k = 0; k < block; ++k)
        {
          part.diagonal[own * block + k] += factor * blocks.outer[k];
          part.diagonal[i * block + k] += factor * blocks.inner[k];
        }
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
          {
            const std::size_t slot = scratch.slot[space.dofs(partner)[b]];
            for (unsigned int e = 0; e < n_entries; ++e)
              part.values[(a * n_columns + slot) * n_entries + e] -=
                  factor * blocks.cross[(a * n + b) * n_entries + e];
          }
      }
    }

    /// In the order in which ranks share them.
    std::vector<std::size_t> cells_inside(const MeshSpace &space)
    {
      std::vector<std::size_t> result;
      for (std::size_t i = 0; i < space.mesh().cells.size(); ++i)
        if (const std::size_t cell = space.cell_at(i); space.mesh().cells[cell].is_inside)
          result.push_back(cell);
      return result;
    }

    /// Integrate once what is the same up to a translation, unless entries change from place to
    /// place: each pair gets the number of its block.
    /// @param all  cells of all ranks, whose pairs stand for each other
    /// @return  none where nothing repeats
    std::vector<PairBlocks> integrate_repeated(const MeshSpace &space, const MeshCells &cells,
                                               double horizon, const PairIntegrator &integrator,
                                               const std::vector<std::size_t> &all,
                                               const base::Communicator &communicator,
                                               std::vector<CellPairs> &pairs)
    {
      if (integrator.has_changing_coefficient() || cells.has_curves())
        return {};
      std::vector<CellPairs> of_all;
      if (communicator.n_ranks() > 1)
        of_all = find_pairs(space, cells, horizon, all);
      const RepeatedPairs repeated(space.mesh(), of_all.empty() ? pairs : of_all, pairs);
      return integrate_first(repeated.first(), integrator);
    }

    bool is_linear_triangles(const MeshSpace &space)
    {
      return space.shapes().n_vertices() == 3 && space.is_continuous() &&
             space.shapes().degree() == 1;
    }

    /// How entries came about, in words.
    std::string tell_way(const MeshSpace &space, const physics::Kernel<2> &kernel,
                         const PairIntegrator &integrator, const AssemblyOptions &options,
                         bool is_exact)
    {
      const std::string cells = space.shapes().n_vertices() == 3 ? "triangles" : "quadrilaterals";
      if (is_exact && integrator.has_curves())
        return "exact by sides of pairs of triangles, sides on curves by four straight parts each";
      if (is_exact)
        return integrator.are_rectangles() ? "of axis-aligned rectangles exact by correlation"
                                           : "exact by sides of pairs of " + cells;
      if (!options.exact_entries)
        return "by quadrature";
      std::string reason = PolygonPairs::refuse(space, kernel);
      if (integrator.has_changing_coefficient())
        reason = "the material changes inside of " + cells;
      else if (!reason.empty() && is_linear_triangles(space))
        reason = refuse_edges(space, kernel);
      return reason.empty()
                 ? "by sides of pairs of " + cells + ", but by quadrature where one of " + "them " +
                       integrator.exceptions()
                 : "by quadrature, not exact by sides of " + cells + ": " + reason;
    }
  } // namespace

  bool goes_by_edges(const MeshSpace &space, const MeshCells &cells,
                     const physics::Kernel<2> &kernel,
                     const std::optional<physics::Coefficient> &coefficient)
  {
    return !coefficient && is_linear_triangles(space) && !cells.has_curves() &&
           refuse_edges(space, kernel).empty();
  }

  MeshMatrix assemble(const MeshSpace &space, const MeshCells &cells,
                      const physics::Kernel<2> &kernel,
                      const std::optional<physics::Coefficient> &coefficient,
                      const AssemblyOptions &options, const base::Communicator &communicator)
  {
    if (options.exact_entries && options.cracks.empty() &&
        goes_by_edges(space, cells, kernel, coefficient))
      return {assemble_by_edges(space, kernel, communicator), true,
              "exact by pairs of sides of the triangles"};
    const KernelEntries profile(kernel);
    const std::vector<std::size_t> all_cells = cells_inside(space);
    const auto [first, last] = communicator.owned_range(all_cells.size());
    std::vector<std::size_t> outer_cells(all_cells.begin() + static_cast<std::ptrdiff_t>(first),
                                         all_cells.begin() + static_cast<std::ptrdiff_t>(last));

    std::vector<CellPairs> pairs = find_pairs(space, cells, kernel.horizon(), outer_cells);
    MeshRows sum(space, profile.n_entries(), pairs);
    const Scratch scratch{PairIntegrator(space, cells, kernel, profile, coefficient, options),
                          {},
                          std::vector<unsigned int>(space.n_dofs()),
                          {}};
    if (scratch.integrator.is_at_loss())
      throw InputError("Domain/sides = curved: entries would be " +
                       tell_way(space, kernel, scratch.integrator, options, false) +
                       "; write Domain/sides = straight, or change that");
    const std::vector<PairBlocks> first_blocks = integrate_repeated(
        space, cells, kernel.horizon(), scratch.integrator, all_cells, communicator, pairs);
    // an exception must not leave a thread: the first one is kept and thrown at the end
    std::exception_ptr failure;
    std::mutex mutex;
    dealii::WorkStream::run(
        outer_cells.begin(), outer_cells.end(),
        [&](const std::vector<std::size_t>::iterator &cell, Scratch &own, CellRows &part)
        {
          try
          {
            integrate_cell(space, pairs[*cell], first_blocks, profile.n_entries(), *cell, own,
                           part);
          }
          catch (...)
          {
            const std::lock_guard<std::mutex> lock(mutex);
            if (!failure)
              failure = std::current_exception();
          }
        },
        [&](const CellRows &part)
        {
          const std::lock_guard<std::mutex> lock(mutex);
          if (!failure)
            sum.add(part);
        },
        scratch, CellRows());
    if (failure)
      std::rethrow_exception(failure);
    pairs = {};
    std::string way = tell_way(space, kernel, scratch.integrator, options, sum.is_exact);
    if (!options.cracks.empty())
      way += ", those of pairs that see each other past a crack's end by quadrature";
    return {sum.combine(kernel.n_components()), sum.is_exact && options.cracks.empty(), way};
  }
} // namespace plumbline::reference
