#include "reference/mesh/dilatation.h"

#include "reference/mesh/cell_constants.h"
#include "reference/mesh/dilatation_parts.h"
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
    /// Σ w Eᵀ θ of one outer cell, shape (2 n_dofs, 2 n_dofs), by its dofs.
    using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// The same without materials, shape ((2 n_near + 1) 2 n_shapes, 2 n_dofs): what each near cell
    /// has of E for f = 1, by its own functions v(x+ξ) and by those of the outer cell, -v(x); at
    /// the end the sum of the latter.
    using Family = Block;

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
      /// @pre  parts are there, the cell is not cut
      void integrate_family(const OuterCell &outer, Family &family);

    private:
      void find_slots(const OuterCell &outer)
      {
        for (unsigned int i = 0; i < outer.dofs.size(); ++i)
          slot_[outer.dofs[i]] = i;
      }
      /// At all outer points of a cell θ, and E by what is to be done with it.
      /// @param n_tests  numbers that `fill(q, weight)` writes to the row tests_(q)
      template <class Fill>
      void integrate(const OuterCell &outer, Eigen::Index n_tests, const Fill &fill, Block &block);

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

    template <class Fill>
    void BlockIntegrator::integrate(const OuterCell &outer, Eigen::Index n_tests, const Fill &fill,
                                    Block &block)
    {
      const auto n = static_cast<Eigen::Index>(outer.dofs.size());
      find_slots(outer);
      known_.clear();
      if (parts_.is_there() && !outer.is_cut)
        parts_.find(outer, known_);
      theta_.resize(2 * n);
      test_.resize(2 * n);
      const auto n_points = static_cast<Eigen::Index>(rule_.unit.size());
      thetas_.resize(n_points, 2 * n);
      tests_.resize(n_points, n_tests);
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
        fill(q, weight);
        for (const double *&known : known_)
          known += 2 * space_.shapes().size();
      }
      block.noalias() = tests_.transpose() * thetas_;
    }

    void BlockIntegrator::integrate(const OuterCell &outer, Block &block)
    {
      const auto n = static_cast<Eigen::Index>(2 * outer.dofs.size());
      integrate(
          outer, n,
          [&](Eigen::Index q, double weight)
          { tests_.row(q) = weight * Eigen::Map<const Eigen::RowVectorXd>(test_.data(), n); },
          block);
    }

    void BlockIntegrator::integrate_family(const OuterCell &outer, Family &family)
    {
      const unsigned int n = space_.shapes().size();
      std::vector<double> phi(n);
      integrate(
          outer, static_cast<Eigen::Index>(2 * n * (2 * outer.near.size() + 1)),
          [&](Eigen::Index q, double weight)
          {
            space_.shapes().values(rule_.unit[q], phi.data());
            double *to = &tests_(q, 0);
            std::array<double, 2> all{};
            for (const double *const part : known_)
            {
              std::array<double, 2> sum{};
              for (unsigned int i = 0; i < 2 * n; ++i)
              {
                *to++ = weight * part[i];
                sum[i % 2] += weight * part[i];
                all[i % 2] += weight * part[i];
              }
              for (unsigned int i = 0; i < 2 * n; ++i)
                *to++ = -phi[i / 2] * sum[i % 2];
            }
            for (unsigned int i = 0; i < 2 * n; ++i)
              *to++ = -phi[i / 2] * all[i % 2];
          },
          family);
    }

    /// Cells of this rank, in the order in which ranks share them.
    void keep_share(const MeshSpace &space, const base::Communicator &communicator,
                    std::vector<OuterCell> &outer)
    {
      std::vector<unsigned int> place(space.mesh().cells.size());
      for (unsigned int i = 0; i < place.size(); ++i)
        place[space.cell_at(i)] = i;
      std::stable_sort(outer.begin(), outer.end(), // several of one cell stay in order
                       [&](const OuterCell &a, const OuterCell &b)
                       { return place[a.cell] < place[b.cell]; });
      const auto [first, last] = communicator.owned_range(outer.size());
      outer.erase(outer.begin() + static_cast<std::ptrdiff_t>(last), outer.end());
      outer.erase(outer.begin(), outer.begin() + static_cast<std::ptrdiff_t>(first));
    }

    /// Zero rows whose columns are the unknowns of all outer cells that a dof is near to.
    algebra::CsrMatrix make_pattern(const MeshSpace &space, const std::vector<OuterCell> &outer)
    {
      std::vector<std::vector<unsigned int>> around(space.n_free());
      for (std::size_t i = 0; i < outer.size(); ++i)
        for (const unsigned int dof : outer[i].dofs)
          if (dof < space.n_free())
            around[dof].push_back(static_cast<unsigned int>(i));
      algebra::CsrMatrix rows;
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

    /// Add a row of a block to that of a component of a dof, if it is free.
    void add_row(const MeshSpace &space, const OuterCell &outer, unsigned int dof, unsigned int c,
                 double factor, const double *row, algebra::CsrMatrix &rows)
    {
      if (dof >= space.n_free())
        return;
      using Entries = Eigen::Array<double, Eigen::Dynamic, 1>;
      std::size_t k = rows.start[2 * dof + c];
      for (const OuterCell::Run &run : outer.runs)
      {
        while (rows.column[k] != 2 * run.dof)
          k += 2;
        Eigen::Map<Entries>(&rows.value[k], 2 * run.size) +=
            factor * Eigen::Map<const Entries>(row + 2 * run.place, 2 * run.size);
        k += 2 * run.size;
      }
    }

    void add(const MeshSpace &space, const OuterCell &outer, const Block &block,
             algebra::CsrMatrix &rows)
    {
      Eigen::Index from = 0;
      for (const unsigned int dof : outer.dofs)
        for (unsigned int c = 0; c < 2; ++c)
          add_row(space, outer, dof, c, 1, &block(from++, 0), rows);
    }

    /// A family with the materials of the outer cell and of those near to it.
    void add(const MeshSpace &space, const OuterCell &outer, const Family &family,
             const DilatationRow &row, algebra::CsrMatrix &rows)
    {
      const Eigen::Index n = 2 * space.shapes().size();
      const double own_factor = row.factor(outer.cell, outer.cell);
      Block own = own_factor * family.bottomRows(n);
      Eigen::Index from = 0;
      for (const unsigned int near : outer.near)
      {
        const double factor = row.factor(outer.cell, near);
        for (unsigned int i = 0; i < n; ++i)
          add_row(space, outer, space.dofs(near)[i / 2], i % 2, factor, &family(from + i, 0), rows);
        if (factor != own_factor)
          own += (factor - own_factor) * family.middleRows(from + n, n);
        from += 2 * n;
      }
      for (unsigned int i = 0; i < n; ++i)
        add_row(space, outer, space.dofs(outer.cell)[i / 2], i % 2, 1, &own(i, 0), rows);
    }

    /// Families that stand for several cells, the most frequent ones, no larger in all than the
    /// matrix.
    class SharedFamilies
    {
    public:
      /// @param alike  see find_alike; empty: none is shared
      template <class Integrate>
      SharedFamilies(const std::vector<OuterCell> &outer, const std::vector<std::size_t> &alike,
                     std::size_t n_shapes, std::size_t most_values, const Integrate &integrate)
          : place_(outer.size(), none)
      {
        std::vector<std::size_t> n_alike(outer.size()), classes, first;
        for (const std::size_t i : alike)
          if (n_alike[i]++ == 0)
            classes.push_back(i);
        std::stable_sort(classes.begin(), classes.end(),
                         [&](std::size_t a, std::size_t b) { return n_alike[a] > n_alike[b]; });
        std::size_t n_values = 0;
        constexpr std::size_t often = 3;
        for (const std::size_t i : classes)
        {
          n_values += 8 * n_shapes * (outer[i].near.size() + 1) * outer[i].dofs.size();
          if (n_alike[i] < often || n_values > most_values)
            break;
          place_[i] = first.size();
          first.push_back(i);
        }
        for (std::size_t i = 0; i < alike.size(); ++i)
          place_[i] = place_[alike[i]];
        families_.resize(first.size());
        integrate(first, families_);
      }

      const Family *find(std::size_t i) const
      {
        return place_[i] == none ? nullptr : &families_[place_[i]];
      }

    private:
      static constexpr std::size_t none = -1;
      std::vector<std::size_t> place_; ///< of each outer cell in families_
      std::vector<Family> families_;
    };
  } // namespace

  algebra::CsrMatrix assemble_dilatation(const MeshSpace &space, const MeshCells &cells,
                                         const physics::Dilatation<2> &dilatation,
                                         const DilatationOptions &options,
                                         const base::Communicator &communicator)
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
    std::vector<OuterCell> outer = find_outer(
        space, cells, translations, dilatation.influence.horizon(), options.cracks, options.gaps);
    const DilatationRow row(space, cells, dilatation, materials, 2 + 2 * options.refinement,
                            options.backend, options.correction, options.cracks);
    const DilatationParts parts(space, outer, translations, rule.unit, row);
    keep_share(space, communicator, outer);
    algebra::CsrMatrix rows = make_pattern(space, outer);

    dealii::Threads::ThreadLocalStorage<std::optional<BlockIntegrator>> integrators;
    const auto in_threads = [&](std::size_t n, const auto &action)
    {
      dealii::parallel::apply_to_subranges(
          static_cast<std::size_t>(0), n,
          [&](std::size_t first, std::size_t last)
          {
            std::optional<BlockIntegrator> &own = integrators.get();
            if (!own)
              own.emplace(space, row, rule, parts, volume ? &*volume : nullptr);
            for (std::size_t i = first; i < last; ++i)
              action(*own, i);
          },
          1);
    };
    const SharedFamilies shared(
        outer,
        parts.is_there() && !materials.empty() ? find_alike(outer, translations)
                                               : std::vector<std::size_t>(),
        space.shapes().size(), rows.value.size(),
        [&](const std::vector<std::size_t> &some, std::vector<Family> &families)
        {
          in_threads(some.size(), [&](BlockIntegrator &own, std::size_t i)
                     { own.integrate_family(outer[some[i]], families[i]); });
        });
    // blocks by threads, added in order
    std::vector<Block> blocks(4 * dealii::MultithreadInfo::n_threads());
    for (std::size_t begin = 0, end = 0; begin < outer.size(); begin = end)
    {
      std::vector<std::size_t> single;
      for (end = begin; end < outer.size() && single.size() < blocks.size(); ++end)
        if (shared.find(end) == nullptr)
          single.push_back(end);
      in_threads(single.size(), [&](BlockIntegrator &own, std::size_t i)
                 { own.integrate(outer[single[i]], blocks[i]); });
      auto next = blocks.begin();
      for (std::size_t i = begin; i < end; ++i)
        if (const Family *const family = shared.find(i))
          add(space, outer[i], *family, row, rows);
        else
          add(space, outer[i], *next++, rows);
    }
    return rows;
  }
} // namespace plumbline::reference
