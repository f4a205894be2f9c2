#include "reference/mesh/dilatation.h"

#include "reference/mesh/cell_constants.h"
#include "reference/mesh/dilatation_parts.h"
#include "reference/mesh/weighted_volume.h"

#include <deal.II/base/parallel.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/thread_local_storage.h>

#include <Eigen/Dense>

#include <algorithm>
#include <map>
#include <optional>

namespace plumbline::reference
{
  namespace
  {
    /// Σ w Eᵀ θ of one outer cell, shape (2 n_dofs, 2 n_dofs), by its dofs.
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
      /// @param parts  must outlive the integrator
      BlockIntegrator(const MeshSpace &space, const DilatationRow &row, const OuterRule &rule,
                      const DilatationParts &parts, const WeightedVolume *volume)
          : space_(space), row_(row), rule_(rule), parts_(parts), volume_(volume),
            slot_(space.n_dofs())
      {
      }

      void integrate(const OuterCell &outer, Block &block);

    private:
      const MeshSpace &space_;
      DilatationRow row_;
      const OuterRule &rule_;
      const DilatationParts &parts_;
      const WeightedVolume *volume_; ///< none: θ is not normalised
      std::vector<unsigned int> slot_;
      std::vector<const double *> known_;
      std::vector<double> theta_, test_;
      Block thetas_, tests_; ///< by points
    };

    void BlockIntegrator::integrate(const OuterCell &outer, Block &block)
    {
      const auto n = static_cast<Eigen::Index>(outer.dofs.size());
      for (Eigen::Index i = 0; i < n; ++i)
        slot_[outer.dofs[i]] = static_cast<unsigned int>(i);
      if (parts_.is_there())
        parts_.find(outer, known_);
      theta_.resize(2 * n);
      test_.resize(2 * n);
      const auto n_points = static_cast<Eigen::Index>(rule_.unit.size());
      thetas_.resize(n_points, 2 * n);
      tests_.resize(n_points, 2 * n);
      const CellMap &map = space_.map(outer.cell);
      for (Eigen::Index q = 0; q < n_points; ++q)
      {
        const Point<2> &unit = rule_.unit[q];
        row_.evaluate(outer.cell, unit, outer.near, known_, slot_, theta_, test_);
        double weight = rule_.weight[q] * map.determinant(unit);
        if (volume_ != nullptr)
        {
          const double factor = 2 / (*volume_)(map.point(unit));
          weight *= factor * factor;
        }
        thetas_.row(q) = Eigen::Map<const Eigen::RowVectorXd>(theta_.data(), 2 * n);
        tests_.row(q) = weight * Eigen::Map<const Eigen::RowVectorXd>(test_.data(), 2 * n);
        for (const double *&known : known_)
          known += 2 * space_.shapes().size();
      }
      block.noalias() = tests_.transpose() * thetas_;
    }

    void keep_share(const base::Team &team, std::vector<OuterCell> &outer)
    {
      const auto [first, last] = team.share(outer.size());
      outer.erase(outer.begin() + static_cast<std::ptrdiff_t>(last), outer.end());
      outer.erase(outer.begin(), outer.begin() + static_cast<std::ptrdiff_t>(first));
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

    void add(const MeshSpace &space, const OuterCell &outer, const Block &block,
             algebra::Rows &rows)
    {
      for (std::size_t i = 0; i < outer.dofs.size(); ++i)
        for (unsigned int c = 0; c < 2 && outer.dofs[i] < space.n_free(); ++c)
        {
          std::size_t k = rows.start[2 * outer.dofs[i] + c];
          const double *const row = &block(static_cast<Eigen::Index>(2 * i + c), 0);
          for (const OuterCell::Run &run : outer.runs)
          {
            while (rows.column[k] != 2 * run.dof)
              k += 2;
            const double *const from = row + 2 * run.place;
            for (unsigned int e = 0; e < 2 * run.size; ++e)
              rows.value[k + e] += from[e];
            k += 2 * run.size;
          }
        }
    }

    /// Numbers of materials that are one in each cell; empty: they change inside of cells.
    std::vector<unsigned int> number(const std::vector<physics::Lame> &materials)
    {
      std::map<std::pair<double, double>, unsigned int> known;
      std::vector<unsigned int> numbers;
      for (const physics::Lame &lame : materials)
        numbers.push_back(
            known.try_emplace({lame.lambda, lame.mu}, static_cast<unsigned int>(known.size()))
                .first->second);
      return numbers;
    }

    /// Blocks that stand for several cells, no larger in all than the matrix.
    class SharedBlocks
    {
    public:
      /// @param alike  see find_alike; empty: none is shared
      template <class Integrate>
      SharedBlocks(const std::vector<OuterCell> &outer, const std::vector<std::size_t> &alike,
                   std::size_t most_values, const Integrate &integrate)
          : place_(outer.size(), none)
      {
        std::vector<std::size_t> n_alike(outer.size()), first;
        for (const std::size_t i : alike)
          ++n_alike[i];
        std::size_t n_values = 0;
        constexpr std::size_t often = 3;
        for (std::size_t i = 0; i < alike.size(); ++i)
        {
          const std::size_t size = 4 * outer[i].dofs.size() * outer[i].dofs.size();
          if (alike[i] == i && n_alike[i] >= often && n_values + size <= most_values)
          {
            n_values += size;
            place_[i] = first.size();
            first.push_back(i);
          }
          place_[i] = place_[alike[i]];
        }
        blocks_.resize(first.size());
        integrate(first, blocks_);
      }

      const Block *find(std::size_t i) const
      {
        return place_[i] == none ? nullptr : &blocks_[place_[i]];
      }

    private:
      static constexpr std::size_t none = -1;
      std::vector<std::size_t> place_; ///< of each outer cell in blocks_
      std::vector<Block> blocks_;
    };
  } // namespace

  algebra::Rows assemble_dilatation(const MeshSpace &space, const MeshCells &cells,
                                    const physics::Dilatation &dilatation,
                                    const DilatationOptions &options, const base::Team &team)
  {
    const Translations translations(space.mesh());
    const std::vector<physics::Lame> materials =
        dilatation.is_homogeneous
            ? std::vector<physics::Lame>(cells.size(), dilatation.material({}))
            : constants_in_cells(space, cells, dilatation.material);
    const OuterRule rule = outer_rule(space.shapes(), options.refinement);
    std::optional<WeightedVolume> volume;
    if (options.is_normalised)
      volume.emplace(space.mesh(), dilatation.influence);
    std::vector<OuterCell> outer =
        find_outer(space, cells, translations, dilatation.influence.horizon());
    const DilatationRow row(space, cells, dilatation, materials, 2 + 2 * options.refinement,
                            options.backend);
    const DilatationParts parts(space, outer, translations, rule.unit, row);
    keep_share(team, outer);
    algebra::Rows rows = make_pattern(space, outer);

    dealii::Threads::ThreadLocalStorage<std::optional<BlockIntegrator>> integrators;
    const auto integrate = [&](const std::vector<std::size_t> &some, std::vector<Block> &blocks)
    {
      dealii::parallel::apply_to_subranges(
          static_cast<std::size_t>(0), some.size(),
          [&](std::size_t first, std::size_t last)
          {
            std::optional<BlockIntegrator> &own = integrators.get();
            if (!own)
              own.emplace(space, row, rule, parts, volume ? &*volume : nullptr);
            for (std::size_t i = first; i < last; ++i)
              own->integrate(outer[some[i]], blocks[i]);
          },
          1);
    };
    const bool can_share = translations.has_few_shapes() && !materials.empty();
    const SharedBlocks shared(outer,
                              can_share ? find_alike(outer, translations, number(materials))
                                        : std::vector<std::size_t>(),
                              rows.value.size(), integrate);
    // blocks by threads, added in order
    std::vector<Block> blocks(4 * dealii::MultithreadInfo::n_threads());
    for (std::size_t begin = 0, end = 0; begin < outer.size(); begin = end)
    {
      std::vector<std::size_t> single;
      for (end = begin; end < outer.size() && single.size() < blocks.size(); ++end)
        if (shared.find(end) == nullptr)
          single.push_back(end);
      integrate(single, blocks);
      auto next = blocks.begin();
      for (std::size_t i = begin; i < end; ++i)
        add(space, outer[i], shared.find(i) != nullptr ? *shared.find(i) : *next++, rows);
    }
    return rows;
  }
} // namespace plumbline::reference
