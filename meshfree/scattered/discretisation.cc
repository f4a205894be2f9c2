#include "meshfree/discretisations.h"

#include "base/error.h"
#include "meshfree/scattered/double_well_motion.h"
#include "meshfree/scattered/field.h"
#include "meshfree/scattered/motion.h"
#include "meshfree/scattered/state_based_operator.h"
#include "method/lattice_discretisation.h"
#include "method/limit_proof.h"
#include "problem/damage.h"

#include <deal.II/lac/vector.h>

#include <cmath>
#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    using method::Vector;

    algebra::SparseOptions solver_options(const problem::Problem<2> &problem)
    {
      algebra::SparseOptions options;
      options.is_symmetric = false;
      options.n_components = problem.n_components;
      if (problem.settings.solver.is_mixed)
        options.n_first = problem.n_components * problem.cells()->n_free;
      const auto &nodes = problem.cells()->nodes;
      options.nodes.assign(nodes.begin(),
                           nodes.begin() + static_cast<std::ptrdiff_t>(problem.cells()->n_free));
      return options;
    }

    class RuleOnNodes : public method::SparseDiscretisation
    {
    public:
      RuleOnNodes(const problem::Problem<2> &problem, const base::Communicator &communicator,
                  ScatteredOperator matrix)
          : SparseDiscretisation(problem.settings.solver, solver_options(problem), communicator),
            cells_(problem.cells()), n_components_(problem.n_components),
            is_mixed_(problem.settings.solver.is_mixed)
      {
        const auto n = static_cast<std::size_t>(
            communicator.largest(static_cast<double>(matrix.rows.free.n_rows())));
        for (algebra::CsrMatrix *rows :
             {&matrix.rows.free, &matrix.rows.constrained}) // ranks that gave none
          rows->start.resize(n + 1, rows->column.size());
        set_rows(std::move(matrix.rows));
        tips_ = std::move(matrix.tips);
        diagnostics_ = matrix.statistics.diagnostics(communicator);
        diagnostics_.limit = method::limit_of(problem, diagnostics_.limit);
        if (problem.damage.is_there() && problem.dilatation)
          is_ghost_ = find_ghosts(problem.damage, *cells_);
      }

      method::CaseData data(const problem::Problem<2> &problem) const override
      {
        method::CaseData result;
        result.load.reinit(static_cast<unsigned int>(n_unknowns()));
        communicator().together([&] { add_data(problem, result.load); });
        result.field = [this](const Vector &u) { return field(u); };
        if (communicator().any(!tips_.empty()))
          result.tip_forces = [this, constrained = collar(problem), horizon = problem.horizon()](
                                  const Vector &u) { return tip_forces(u, constrained, horizon); };
        return result;
      }

      method::LinearEquations<2> equations(const problem::Problem<2> &problem) const override
      {
        if (is_mixed_)
          throw InputError("the mixed formulation (Solver/dilatation = mixed) has unknowns besides "
                           "the displacements; write condensed");
        Vector load(static_cast<unsigned int>(n_unknowns()));
        add_load(problem, load);
        return {n_components_,
                cells_->nodes,
                cells_->n_free,
                method::join(*free(), *constrained()),
                {load.begin(), load.end()},
                collar(problem),
                masses()};
      }

      method::DiscreteOperator matrix() const override
      {
        method::DiscreteOperator result;
        result.n_components = n_components_;
        result.nodes = free_nodes();
        result.mass = masses();
        result.rows = by_volumes(*free(), *cells_, n_components_);
        return result;
      }

      std::unique_ptr<method::EquationOfMotion> motion(bool) const override
      {
        if (is_mixed_)
          return nullptr;
        return move_nodes<2>(cells_, n_components_, *free(), *constrained(),
                             [this](const problem::Problem<2> &instant)
                             { return collar(instant); });
      }

      method::Diagnostics diagnostics() const override { return diagnostics_; }

    private:
      /// This rank's share of the load, and what its rows take from the collar.
      void add_data(const problem::Problem<2> &problem, Vector &load) const
      {
        add_load(problem, load);
        method::subtract_constrained(*constrained(), collar(problem), load);
      }

      void add_load(const problem::Problem<2> &problem, Vector &load) const
      {
        const auto [first, last] = communicator().owned_range(cells_->n_free);
        const problem::Field<2> &b = problem.load;
        for (std::size_t i = first; i < last; ++i)
          for (unsigned int c = 0; c < n_components_; ++c)
            load[i * n_components_ + c] = b(cells_->nodes[i], c);
      }

      std::vector<double> collar(const problem::Problem<2> &problem) const
      {
        std::vector<double> values;
        for (std::size_t i = cells_->n_free; i < cells_->size(); ++i)
          for (unsigned int c = 0; c < n_components_; ++c)
            values.push_back(!is_ghost_.empty() && is_ghost_[i] != 0
                                 ? 0
                                 : problem.constraint.value(cells_->nodes[i], c));
        return values;
      }

      /// Of tips that have surface terms about them.
      /// @param constrained  u of the collar
      std::vector<method::TipForce>
      tip_forces(const Vector &u, const std::vector<double> &constrained, double horizon) const
      {
        const auto n_free = static_cast<std::ptrdiff_t>(cells_->n_free * n_components_);
        std::vector<double> all(u.begin(), u.begin() + n_free); // dilatations come after
        all.insert(all.end(), constrained.begin(), constrained.end());
        const auto n_tips =
            static_cast<std::size_t>(communicator().largest(static_cast<double>(tips_.size())));
        std::vector<method::TipForce> result;
        for (std::size_t t = 0; t < n_tips; ++t)
        {
          method::TipForce one;
          dealii::Tensor<1, 2> sum;
          if (t < tips_.size())
            for (const dealii::Tensor<1, 2> &force : tips_[t].forces(all))
            {
              sum += force;
              one.sum_of_norms += force.norm();
            }
          one.sum_of_norms = communicator().sum(one.sum_of_norms);
          for (unsigned int d = 0; d < 2; ++d)
          {
            one.tip[d] = t < tips_.size() ? tips_[t].place[d] : 0;
            one.force[d] = sum[d] = communicator().sum(sum[d]);
          }
          one.norm = sum.norm();
          one.over_root = one.norm / std::sqrt(horizon);
          if (one.sum_of_norms > 0)
            result.push_back(one);
        }
        return result;
      }

      std::vector<Point<2>> free_nodes() const
      {
        const auto n = static_cast<std::ptrdiff_t>(cells_->n_free);
        return {cells_->nodes.begin(), cells_->nodes.begin() + n};
      }

      std::vector<double> masses() const
      {
        const auto n = static_cast<std::ptrdiff_t>(cells_->n_free);
        return {cells_->area.begin(), cells_->area.begin() + n};
      }

      method::Field field(const Vector &u) const
      {
        const auto n = static_cast<std::ptrdiff_t>(cells_->n_free);
        method::Field result;
        result.nodes.assign(cells_->nodes.begin(), cells_->nodes.begin() + n);
        result.nodal.assign(u.begin(), u.begin() + n * n_components_); // dilatations come after
        result.averages = cell_averages(*cells_, result.nodal, n_components_);
        const auto field =
            std::make_shared<const ScatteredField>(cells_, result.nodal, n_components_);
        result.value = [field](const Point<2> &x, unsigned int c) { return field->value(x, c); };
        result.write_vtu = [field](const std::string &file) { field->write_vtu(file); };
        return result;
      }

      std::shared_ptr<const geometry::NodeCells<2>> cells_;
      unsigned int n_components_;
      bool is_mixed_;
      std::vector<char> is_ghost_; ///< of each node, or empty
      std::vector<TipRows> tips_;
      method::Diagnostics diagnostics_;
    };

    Families<2> families_of(const Rule &rule, const problem::Problem<2> &problem)
    {
      return {rule.in_plane(problem.kernel), problem.kernel, *problem.cells(),
              problem.settings.geometry.backend};
    }

    /// Double wells; rows are those of their small strains.
    class WellsOnNodes : public RuleOnNodes
    {
    public:
      WellsOnNodes(const Rule &rule, const problem::Problem<2> &problem,
                   const base::Communicator &communicator, ScatteredOperator matrix)
          : RuleOnNodes(problem, communicator, std::move(matrix)), rule_(rule), problem_(problem)
      {
      }

      std::unique_ptr<method::EquationOfMotion> motion(bool) const override
      {
        return move_double_well(problem_, families_of(rule_, problem_));
      }

    private:
      Rule rule_;
      problem::Problem<2> problem_; ///< shares mesh and cells
    };

    /// A kept dilatation's system is on the first rank alone.
    ScatteredOperator make_operator(const Rule &rule, const problem::Problem<2> &problem,
                                    const base::Communicator &communicator,
                                    std::pair<std::size_t, std::size_t> share)
    {
      const Families<2> families = families_of(rule, problem);
      if (!problem.dilatation)
        return scattered_operator(families, problem, share);
      const auto make = [&](std::size_t node, Family<2> &family) { families.make(node, family); };
      const StateBasedBody body{problem.cells().get(),
                                *problem.dilatation,
                                {problem.damage.cracks,
                                 find_ghosts(problem.damage, *problem.cells()),
                                 problem.damage.surface_terms, problem.damage.outside},
                                problem.has_collar_dilatation,
                                problem.settings.ball_order};
      if (!problem.settings.solver.is_mixed)
        return state_based_operator(make, body, share);
      return communicator.rank() == 0 ? state_based_system(make, body) : ScatteredOperator();
    }
  } // namespace

  std::unique_ptr<method::Discretisation> discretise_on_scattered_nodes(
      const std::function<ScatteredOperator(std::pair<std::size_t, std::size_t> share)> &make,
      const problem::Problem<2> &problem, const base::Communicator &communicator)
  {
    ScatteredOperator matrix;
    communicator.together([&]
                          { matrix = make(communicator.owned_range(problem.cells()->n_free)); });
    return std::make_unique<RuleOnNodes>(problem, communicator, std::move(matrix));
  }

  std::unique_ptr<method::Discretisation>
  discretise_on_scattered_nodes(const Rule &rule, const problem::Problem<2> &problem,
                                const base::Communicator &communicator)
  {
    const auto make = [&](std::pair<std::size_t, std::size_t> share)
    { return make_operator(rule, problem, communicator, share); };
    if (!problem.double_well)
      return discretise_on_scattered_nodes(make, problem, communicator);
    ScatteredOperator matrix;
    communicator.together([&]
                          { matrix = make(communicator.owned_range(problem.cells()->n_free)); });
    return std::make_unique<WellsOnNodes>(rule, problem, communicator, std::move(matrix));
  }

  double expected_bytes(const method::ProblemSize &size)
  {
    const double n_components = size.n_components;
    const problem::Level &level = size.level;
    // rows that grow as vectors do, Trilinos' copy and a preconditioner; measured
    constexpr double of_entry = 40, of_node = 1000;
    if (size.is_scattered)
    {
      constexpr double of_cell = 8000; // a polyhedron, in the layer around the box, too
      const double m = size.reach() / level.h, width = 2 * (m + 1);
      const double in_ball = 4 * M_PI / 3 * std::pow(m + .25, 3);
      return size.extents[0] * size.extents[1] * size.depth * in_ball * std::pow(n_components, 2) *
                 of_entry +
             (size.extents[0] + width) * (size.extents[1] + width) * (size.depth + width) * of_cell;
    }
    if (size.is_lattice())
      return method::expected_lattice_bytes(size, 1, size.n_components, size.reach() / level.h + 1);
    if (size.is_body) // two sums more by transforms than on a lattice
    {
      method::ProblemSize box = size;
      box.extents.fill(std::sqrt(size.n_cells * size.cell_area) / level.h);
      return 2 * method::expected_lattice_bytes(box, 1, 2, 2 * level.horizon / level.h + 1);
    }
    const double m = size.reach() / std::sqrt(size.cell_area) + .75;
    return size.n_free * (M_PI * m * m * n_components * n_components * of_entry + of_node);
  }
} // namespace plumbline::meshfree
