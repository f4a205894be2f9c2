#include "reference/mesh/dilatation.h"

#include "reference/mesh/dilatation_row.h"
#include "reference/mesh/weighted_volume.h"

#include <deal.II/base/parallel.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/thread_local_storage.h>

#include <Eigen/Dense>

#include <algorithm>
#include <optional>

namespace plumbline::reference
{
  namespace
  {
    /// An outer cell, and what is within the horizon of it.
    struct OuterCell
    {
      unsigned int cell;
      std::vector<unsigned int> dofs; ///< ascending, the free ones first
    };

    /// Σ w Eᵀ θ of one outer cell, shape (2 n_free, 2 n_dofs), by its dofs.
    using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    struct OuterRule
    {
      std::vector<Point<2>> unit;
      std::vector<double> weight;
    };

    /// Gauss's points for products of shape functions on the parts of a unit cell.
    OuterRule outer_rule(const CellShapes &shapes, unsigned int refinement)
    {
      const unsigned int n = std::max(2u, shapes.degree() + 1), n_parts = 1u << refinement;
      const bool is_triangle = shapes.n_vertices() == 3;
      dealii::Quadrature<2> gauss = dealii::QGauss<2>(n);
      if (is_triangle)
        gauss = dealii::QWitherdenVincentSimplex<2>(n);
      const double size = 1. / n_parts;
      OuterRule rule;
      for (unsigned int i = 0; i < n_parts; ++i)
        for (unsigned int j = 0; j < n_parts; ++j)
          for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            const auto add = [&](double s, double t)
            {
              rule.unit.emplace_back(size * (i + s), size * (j + t));
              rule.weight.push_back(size * size * gauss.weight(q));
            };
            const Point<2> &at = gauss.point(q);
            if (!is_triangle || i + j < n_parts)
              add(at[0], at[1]);
            if (is_triangle && i + j + 1 < n_parts)
              add(1 - at[0], 1 - at[1]); // the other half of this square
          }
      return rule;
    }

    /// Blocks of outer cells. Not thread safe: give each thread its own copy.
    class BlockIntegrator
    {
    public:
      BlockIntegrator(const MeshSpace &space, const MeshCells &cells,
                      const physics::Dilatation &dilatation, const DilatationOptions &options)
          : space_(space), cells_(cells),
            row_(space, cells, dilatation, 2 + 2 * options.refinement, options.backend),
            horizon_(dilatation.influence.horizon()), slot_(space.n_dofs()),
            rule_(outer_rule(space.shapes(), options.refinement))
      {
        if (options.is_normalised)
          volume_.emplace(space.mesh(), dilatation.influence);
      }

      void integrate(const OuterCell &outer, Block &block);

    private:
      const MeshSpace &space_;
      const MeshCells &cells_;
      DilatationRow row_;
      double horizon_;
      std::vector<unsigned int> slot_, near_;
      OuterRule rule_;
      std::optional<WeightedVolume> volume_;
      std::vector<double> theta_, test_;
      Block thetas_, tests_; ///< by points
    };

    void BlockIntegrator::integrate(const OuterCell &outer, Block &block)
    {
      const auto n = static_cast<Eigen::Index>(outer.dofs.size());
      const auto end = std::lower_bound(outer.dofs.begin(), outer.dofs.end(), space_.n_free());
      const Eigen::Index n_free = end - outer.dofs.begin();
      for (Eigen::Index i = 0; i < n; ++i)
        slot_[outer.dofs[i]] = static_cast<unsigned int>(i);
      cells_.find_near(outer.cell, horizon_, near_);
      theta_.resize(2 * n);
      test_.resize(2 * n);
      const auto n_points = static_cast<Eigen::Index>(rule_.unit.size());
      thetas_.resize(n_points, 2 * n);
      tests_.resize(n_points, 2 * n_free);
      const CellMap &map = space_.map(outer.cell);
      for (Eigen::Index q = 0; q < n_points; ++q)
      {
        const Point<2> &unit = rule_.unit[q];
        row_.evaluate(outer.cell, unit, near_, slot_, theta_, test_);
        double weight = rule_.weight[q] * map.determinant(unit);
        if (volume_)
        {
          const double factor = 2 / (*volume_)(map.point(unit));
          weight *= factor * factor;
        }
        thetas_.row(q) = Eigen::Map<const Eigen::RowVectorXd>(theta_.data(), 2 * n);
        tests_.row(q) = weight * Eigen::Map<const Eigen::RowVectorXd>(test_.data(), 2 * n_free);
      }
      block.noalias() = tests_.transpose() * thetas_;
    }

    /// This rank's share of the cells that have free dofs within the horizon.
    std::vector<OuterCell> find_outer(const MeshSpace &space, const MeshCells &cells,
                                      double horizon, const base::Team &team)
    {
      std::vector<OuterCell> all(cells.size());
      dealii::parallel::apply_to_subranges(
          static_cast<std::size_t>(0), cells.size(),
          [&](std::size_t first, std::size_t last)
          {
            std::vector<unsigned int> near;
            for (std::size_t cell = first; cell < last; ++cell)
            {
              auto &dofs = all[cell].dofs;
              cells.find_near(cell, horizon, near);
              for (const unsigned int other : near)
                dofs.insert(dofs.end(), space.dofs(other),
                            space.dofs(other) + space.shapes().size());
              std::sort(dofs.begin(), dofs.end());
              dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
              all[cell].cell = static_cast<unsigned int>(cell);
            }
          },
          256);
      all.erase(std::remove_if(all.begin(), all.end(),
                               [&](const OuterCell &outer)
                               { return outer.dofs.front() >= space.n_free(); }),
                all.end());
      const auto [first, last] = team.share(all.size());
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(last), all.end());
      all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(first));
      return all;
    }

    /// Zero rows whose columns are the unknowns of all outer cells that a dof is near to.
    algebra::Rows make_pattern(const MeshSpace &space, const std::vector<OuterCell> &outer)
    {
      std::vector<std::vector<unsigned int>> around(space.n_free());
      for (std::size_t i = 0; i < outer.size(); ++i)
        for (const unsigned int dof : outer[i].dofs)
          if (dof < space.n_free())
            around[dof].push_back(static_cast<unsigned int>(i));
      algebra::Rows rows;
      rows.start.assign(1, 0);
      std::vector<std::size_t> last_row(space.n_dofs(), space.n_dofs());
      std::vector<unsigned int> columns;
      for (std::size_t row = 0; row < space.n_free(); ++row)
      {
        columns.clear();
        for (const unsigned int i : around[row])
          for (const unsigned int dof : outer[i].dofs)
            if (last_row[dof] != row)
            {
              last_row[dof] = row;
              columns.push_back(dof);
            }
        std::sort(columns.begin(), columns.end());
        for (unsigned int c = 0; c < 2; ++c)
        {
          for (const unsigned int dof : columns)
            rows.column.insert(rows.column.end(), {2 * dof, 2 * dof + 1});
          rows.start.push_back(rows.column.size());
        }
      }
      rows.value.assign(rows.column.size(), 0.);
      return rows;
    }

    void add(const OuterCell &outer, const Block &block, algebra::Rows &rows)
    {
      for (Eigen::Index i = 0; i < block.rows(); ++i)
      {
        std::size_t k = rows.start[2 * outer.dofs[i / 2] + i % 2];
        const double *from = &block(i, 0);
        for (const unsigned int dof : outer.dofs)
        {
          while (rows.column[k] != 2 * dof)
            k += 2;
          rows.value[k++] += *from++;
          rows.value[k++] += *from++;
        }
      }
    }
  } // namespace

  algebra::Rows assemble_dilatation(const MeshSpace &space, const MeshCells &cells,
                                    const physics::Dilatation &dilatation,
                                    const DilatationOptions &options, const base::Team &team)
  {
    const std::vector<OuterCell> outer =
        find_outer(space, cells, dilatation.influence.horizon(), team);
    algebra::Rows rows = make_pattern(space, outer);
    // blocks by threads, added in order
    dealii::Threads::ThreadLocalStorage<std::optional<BlockIntegrator>> integrators;
    std::vector<Block> blocks(4 * dealii::MultithreadInfo::n_threads());
    for (std::size_t begin = 0; begin < outer.size(); begin += blocks.size())
    {
      const std::size_t end = std::min(outer.size(), begin + blocks.size());
      dealii::parallel::apply_to_subranges(
          begin, end,
          [&](std::size_t first, std::size_t last)
          {
            std::optional<BlockIntegrator> &own = integrators.get();
            if (!own)
              own.emplace(space, cells, dilatation, options);
            for (std::size_t i = first; i < last; ++i)
              own->integrate(outer[i], blocks[i - begin]);
          },
          1);
      for (std::size_t i = begin; i < end; ++i)
        add(outer[i], blocks[i - begin], rows);
    }
    return rows;
  }
} // namespace plumbline::reference
