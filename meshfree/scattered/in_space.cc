#include "meshfree/discretisations.h"
#include "meshfree/rules/families.h"
#include "meshfree/scattered/dilatation_rows.h"
#include "meshfree/scattered/field.h"
#include "meshfree/scattered/motion.h"
#include "method/limit_proof.h"

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    /// A sparse matrix with one row for each component of a node.
    class RuleOnNodes : public method::DiscretisationInSpace, public method::HasLinearEquations<3>
    {
    public:
      RuleOnNodes(const Families<3> &families, const problem::Problem<3> &problem)
          : cells_(problem.cells), lattice_(problem.lattice), n_components_(problem.n_components)
      {
        FamilyStatistics<3> statistics(*cells_, problem.settings.ball_order);
        const auto group = [&](std::size_t node)
        {
          const std::size_t n_parts = // of the cell
              problem.mesh->hexahedra.empty() ? 1 : geometry::n_in_hexahedron;
          return problem.mesh->group[n_parts * cells_->source[node]];
        };
        const auto make = [&](std::size_t i, Family<3> &family) { families.make(i, family); };
        algebra::CsrMatrix all =
            bond_rows<3>(make, problem.kernel, n_components_, {0, cells_->n_free},
                         [&](std::size_t i, const Family<3> &family, std::vector<double> &factors)
                         {
                           statistics.add(problem.kernel, cells_->nodes[i], family);
                           for (std::size_t k = 0; problem.factors && k < factors.size(); ++k)
                             factors[k] =
                                 problem.factors->between(group(i), group(family.neighbours[k]));
                         });
        if (problem.dilatation)
          all = algebra::add(all, dilatation_rows(make, *problem.dilatation, *cells_));
        method::PartitionedRows rows = method::part(std::move(all), n_unknowns());
        free_ = std::make_shared<const algebra::CsrMatrix>(std::move(rows.free));
        constrained_ = std::move(rows.constrained);
        diagnostics_ = statistics.diagnostics(base::Communicator::alone());
        diagnostics_.limit = method::limit_of(problem, diagnostics_.limit);
        options_.is_symmetric = false; // a bond has two weights, one for each end
        options_.n_components = n_components_;
        options_.solver = problem.settings.solver.linear_solver;
        options_.iteration = problem.settings.solver.iteration;
      }

      std::size_t n_unknowns() const override { return cells_->n_free * n_components_; }

      Data data(const problem::Problem<3> &problem) const override
      {
        Data result;
        result.load.reinit(static_cast<unsigned int>(n_unknowns()));
        for (std::size_t i = 0; i < cells_->n_free; ++i)
          for (unsigned int c = 0; c < n_components_; ++c)
            result.load[i * n_components_ + c] = problem.load(cells_->nodes[i], c);
        const Surroundings around = surroundings(problem);
        method::subtract_constrained(constrained_, around.values, result.load);
        result.field = [this, middle = around.middle](const Vector &u) { return field(u, middle); };
        return result;
      }

      method::LinearEquations<3> equations(const problem::Problem<3> &problem) const override
      {
        method::LinearEquations<3> result;
        result.n_components = n_components_;
        result.nodes = cells_->nodes;
        result.n_free = cells_->n_free;
        result.rows = method::join(*free_, constrained_);
        for (std::size_t i = 0; i < cells_->n_free; ++i)
          for (unsigned int c = 0; c < n_components_; ++c)
            result.load.push_back(problem.load(cells_->nodes[i], c));
        result.constraint = constraint_values(problem);
        const auto n = static_cast<std::ptrdiff_t>(cells_->n_free);
        result.volumes.assign(cells_->area.begin(), cells_->area.begin() + n);
        return result;
      }

      std::unique_ptr<algebra::LinearSystem> tangent() const override
      {
        return std::make_unique<algebra::SparseSystem>(free_, options_,
                                                       base::Communicator::alone());
      }

      std::unique_ptr<method::MotionOf<3>> motion(bool) const override
      {
        return move_nodes<3>(cells_, n_components_, *free_, constrained_,
                             [this](const problem::Problem<3> &instant)
                             { return constraint_values(instant); });
      }

      method::Diagnostics diagnostics() const override { return diagnostics_; }

    private:
      /// The constraint at the nodes that bonds reach, 0 at others, less the middle of its range:
      /// the operator does not see a constant, but the solver's tolerance and rounding would.
      struct Surroundings
      {
        std::vector<double> values; ///< shape (n_constrained, n_components)
        std::vector<double> middle; ///< of each component
      };

      std::vector<char> reached() const
      {
        std::vector<char> is_reached((cells_->size() - cells_->n_free) * n_components_);
        for (const unsigned int column : constrained_.column)
          is_reached[column] = 1;
        return is_reached;
      }

      /// The constraint at the nodes that bonds reach, 0 at others.
      std::vector<double> constraint_values(const problem::Problem<3> &problem) const
      {
        const std::vector<char> is_reached = reached();
        std::vector<double> values(is_reached.size());
        for (std::size_t k = 0; k < values.size(); ++k)
          if (is_reached[k] != 0)
            values[k] = problem.constraint.value(cells_->nodes[cells_->n_free + k / n_components_],
                                                 k % n_components_);
        return values;
      }

      Surroundings surroundings(const problem::Problem<3> &problem) const
      {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Surroundings around;
        around.values = constraint_values(problem);
        const std::vector<char> is_reached = reached();
        std::vector<double> low(n_components_, infinity), high(n_components_, -infinity);
        for (std::size_t k = 0; k < around.values.size(); ++k)
          if (is_reached[k] != 0)
          {
            const unsigned int c = k % n_components_;
            low[c] = std::min(low[c], around.values[k]);
            high[c] = std::max(high[c], around.values[k]);
          }
        for (unsigned int c = 0; c < n_components_; ++c)
          around.middle.push_back(low[c] <= high[c] ? low[c] + (high[c] - low[c]) / 2 : 0);
        for (std::size_t k = 0; k < around.values.size(); ++k)
          if (is_reached[k] != 0)
            around.values[k] -= around.middle[k % n_components_];
        return around;
      }

      method::FieldInSpace field(const Vector &u, const std::vector<double> &middle) const
      {
        const auto n = static_cast<std::ptrdiff_t>(cells_->n_free);
        method::FieldInSpace result;
        result.nodes.assign(cells_->nodes.begin(), cells_->nodes.begin() + n);
        result.volumes.assign(cells_->area.begin(), cells_->area.begin() + n);
        result.nodal.assign(u.begin(), u.end());
        for (std::size_t k = 0; k < result.nodal.size(); ++k)
          result.nodal[k] += middle[k % n_components_];
        const auto field =
            std::make_shared<const NodalFieldInSpace>(cells_, result.nodal, n_components_);
        result.averages = field->averages(lattice_);
        result.value = [field](const Point<3> &x, unsigned int c) { return field->value(x, c); };
        return result;
      }

      std::shared_ptr<const geometry::NodeCells<3>> cells_;
      geometry::CubeLattice lattice_;
      unsigned int n_components_;
      std::shared_ptr<const algebra::CsrMatrix> free_;
      algebra::CsrMatrix constrained_;
      algebra::SparseOptions options_;
      method::Diagnostics diagnostics_;
    };
  } // namespace

  std::unique_ptr<method::DiscretisationInSpace>
  discretise_on_nodes(const Rule &rule, const problem::Problem<3> &problem)
  {
    return std::make_unique<RuleOnNodes>(Families<3>(rule.in_space(problem.kernel), problem.kernel,
                                                     *problem.cells,
                                                     problem.settings.geometry.backend),
                                         problem);
  }
} // namespace plumbline::meshfree
