#include "reference/mesh/assembly.h"

#include "reference/mesh/edge_assembly.h"
#include "reference/mesh/number_set.h"
#include "reference/mesh/pair_quadrature.h"
#include "reference/mesh/rectangle_pairs.h"
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
      PairIntegrator(const MeshSpace &space, const MeshCells &cells, const KernelEntries &profile,
                     double horizon, const std::optional<physics::Coefficient> &coefficient,
                     const AssemblyOptions &options)
          : cells_(cells), by_quadrature_(space, cells, profile, horizon, coefficient,
                                          options.refinement, options.backend)
      {
        if (options.exact_entries && !coefficient && space.shapes().n_vertices() == 4)
          by_correlation_.emplace(space.shapes(), profile, horizon, options.backend);
      }

      bool is_exact(std::size_t a, std::size_t b) const
      {
        return by_correlation_ && cells_.is_rectangle(a) && cells_.is_rectangle(b);
      }

      void integrate(std::size_t outer, std::size_t inner, PairBlocks &blocks)
      {
        if (is_exact(outer, inner) && !by_quadrature_.is_product(outer, inner))
          by_correlation_->integrate(cells_[outer].box(), cells_[inner].box(), blocks);
        else
          by_quadrature_.integrate(outer, inner, blocks);
      }

    private:
      const MeshCells &cells_;
      PairQuadrature by_quadrature_;
      std::optional<RectanglePairs> by_correlation_;
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
      std::vector<unsigned int> slot; ///< of each dof among the columns
    };

    /// All pairs of a cell.
    void integrate_cell(const MeshSpace &space, const CellPairs &pairs, unsigned int n_entries,
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
      PairBlocks &blocks = scratch.blocks;
      for (std::size_t i = 0; i < pairs.partners.size(); ++i)
      {
        const unsigned int partner = pairs.partners[i];
        scratch.integrator.integrate(cell, partner, blocks);
        part.is_exact = part.is_exact && scratch.integrator.is_exact(cell, partner);
        // the cell with itself: both orders are the same pair, each counts half
        const double factor = i == own ? .5 : 1;
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
  } // namespace

  MeshMatrix assemble(const MeshSpace &space, const MeshCells &cells,
                      const physics::Kernel<2> &kernel,
                      const std::optional<physics::Coefficient> &coefficient,
                      const AssemblyOptions &options, const base::Team &team)
  {
    std::string way = "by quadrature";
    if (options.exact_entries && space.is_continuous() && space.shapes().n_vertices() == 3)
    {
      const std::string refusal =
          coefficient ? "the material changes from place to place" : refuse_edges(space, kernel);
      if (refusal.empty())
        return {assemble_by_edges(space, kernel, team), true,
                "exact by pairs of sides of the triangles"};
      way += ", not exact by pairs of sides: " + refusal;
    }
    const KernelEntries profile(kernel);
    std::vector<std::size_t> outer_cells;
    for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
      if (space.mesh().cells[cell].is_inside)
        outer_cells.push_back(cell);
    const auto [first, last] = team.share(outer_cells.size());
    outer_cells = {outer_cells.begin() + static_cast<std::ptrdiff_t>(first),
                   outer_cells.begin() + static_cast<std::ptrdiff_t>(last)};

    std::vector<CellPairs> pairs = find_pairs(space, cells, kernel.horizon(), outer_cells);
    MeshRows sum(space, profile.n_entries(), pairs);
    const Scratch scratch{
        PairIntegrator(space, cells, profile, kernel.horizon(), coefficient, options),
        {},
        std::vector<unsigned int>(space.n_dofs())};
    // an exception must not leave a thread: the first one is kept and thrown at the end
    std::exception_ptr failure;
    std::mutex mutex;
    dealii::WorkStream::run(
        outer_cells.begin(), outer_cells.end(),
        [&](const std::vector<std::size_t>::iterator &cell, Scratch &own, CellRows &part)
        {
          try
          {
            integrate_cell(space, pairs[*cell], profile.n_entries(), *cell, own, part);
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
    if (sum.is_exact)
      way = "of axis-aligned rectangles exact by correlation";
    return {sum.combine(kernel.n_components()), sum.is_exact, way};
  }
} // namespace plumbline::reference
