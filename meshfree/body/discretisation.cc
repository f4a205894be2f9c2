#include "base/error.h"
#include "meshfree/body/network.h"
#include "meshfree/discretisations.h"
#include "meshfree/rules/family_statistics.h"
#include "meshfree/rules/partial_weights.h"
#include "meshfree/scattered/field.h"
#include "method/linear_motion.h"

#include <deal.II/lac/vector.h>

#include <sstream>

namespace plumbline::meshfree
{
  namespace
  {
    VariationalBody make_body(const problem::Problem<2> &problem)
    {
      const auto lame = problem.lame;
      return body_of_cells(*problem.body(), *problem.cells(),
                           {[lame](const Point<2> &x) { return lame(x).lambda + lame(x).mu; },
                            [lame](const Point<2> &x) { return 8 * lame(x).mu; }});
    }

    Bonds<2> bonds_of(const Rule &rule, const problem::Problem<2> &problem)
    {
      return lattice_bonds(rule.in_plane(problem.kernel), problem.kernel, problem.body()->h,
                           problem.settings.geometry.backend);
    }

    Kernel<2> influence_of(const problem::Problem<2> &problem)
    {
      return physics::influence_function<2>(problem.kernel.profile(), problem.horizon());
    }

    /// ∫ b over the free cells: on each quarter by a rule of degree 5, so that loads may jump at
    /// nodes.
    algebra::Vector cell_integrals(const VariationalBody &body, const problem::Problem<2> &problem)
    {
      constexpr unsigned int degree = 5;
      const geometry::NodeCells<2> &cells = *problem.cells();
      algebra::Vector result(2 * body.size());
      for (std::size_t cell = 0; cell < cells.n_free; ++cell)
        for (std::size_t piece = cells.first_piece[cell]; piece < cells.first_piece[cell + 1];
             ++piece)
          for (unsigned int quarter = 0; quarter < 4; ++quarter)
          {
            const Point<2> &x = cells.nodes[cell];
            const auto square = geometry::square(
                {x[0] - (quarter % 2) * body.h, x[1] - (quarter / 2) * body.h}, body.h);
            const geometry::Polygon part =
                geometry::overlap(geometry::view(cells.pieces[piece]), geometry::view(square));
            const auto rule = geometry::polygon_rule(geometry::view(part), degree);
            for (std::size_t q = 0; q < rule.points.size(); ++q)
              for (unsigned int c = 0; c < 2; ++c)
                result[c * body.size() + cells.source[cell]] +=
                    rule.weights[q] * problem.load.value(rule.points[q], c);
          }
      return result;
    }

    void check_constraint(const VariationalBody &body, const problem::Problem<2> &problem)
    {
      for (std::size_t i = 0; i < body.size(); ++i)
        for (unsigned int c = 0; c < 2 && body.is_fixed[i] != 0; ++c)
          if (const double value = problem.constraint.value(body.node(i), c); value != 0)
          {
            std::ostringstream message;
            message << "Problem/constraint is " << value << " at (" << body.node(i)
                    << "), but rules on free bodies hold the fixed part at 0; write 0, 0";
            throw InputError(message.str());
          }
    }
    class BodySystem : public algebra::LinearSystem
    {
    public:
      explicit BodySystem(std::shared_ptr<const BodyOperator> matrix) : matrix_(std::move(matrix))
      {
      }
      void vmult(algebra::Vector &y, const algebra::Vector &x) const override
      {
        matrix_->vmult(y, x);
      }
      algebra::LinearSolve solve(algebra::Vector &x, const algebra::Vector &b,
                                 const algebra::Stopping &stopping) const override
      {
        const auto solved = matrix_->solve(x, b, stopping.tolerance, stopping.max_iterations);
        return {solved.n_iterations, solved.relative_residual, matrix_->backend(),
                matrix_->n_bonds()};
      }

    private:
      std::shared_ptr<const BodyOperator> matrix_;
    };

    class RuleOnBody : public method::Discretisation
    {
    public:
      RuleOnBody(const problem::Problem<2> &problem, const Bonds<2> &bonds,
                 std::shared_ptr<const BodyOperator> matrix)
          : cells_(problem.cells()), loads_are_averages_(problem.settings.loads_are_averages),
            matrix_(std::move(matrix))
      {
        describe_weights(bonds.family, bonds.fit, diagnostics_);
        diagnostics_.notes = bonds.notes;
        const std::string violation = violation_of_a4(bonds, problem.horizon());
        diagnostics_.notes.push_back("assumption A4 of Pflug et al. 2026 on the weights " +
                                     (violation.empty() ? "holds" : "does not hold: " + violation));
      }

      std::size_t n_unknowns() const override { return 2 * cells_->n_free; }

      method::CaseData data(const problem::Problem<2> &problem) const override
      {
        check_constraint(matrix_->body(), problem);
        method::CaseData result;
        result.load = loads_are_averages_ ? cell_integrals(matrix_->body(), problem)
                                          : nodal_load(matrix_->body(),
                                                       [&](const Point<2> &x) {
                                                         return Point<2>(problem.load.value(x, 0),
                                                                         problem.load.value(x, 1));
                                                       });
        result.field = [this](const algebra::Vector &u) { return field(u); };
        return result;
      }

      std::unique_ptr<algebra::LinearSystem> tangent() const override
      {
        return std::make_unique<BodySystem>(matrix_);
      }
      method::DiscreteOperator matrix() const override { return make_discrete_operator(matrix_); }
      method::Diagnostics diagnostics() const override { return diagnostics_; }

      /// Masses are the cells' parts in the body, lumped.
      std::unique_ptr<method::EquationOfMotion> motion(bool) const override
      {
        const method::DiscreteOperator shown = matrix();
        std::vector<double> masses;
        for (const double mass : shown.mass)
          masses.insert(masses.end(), 2, mass);
        const auto at_free = [this](const problem::Problem<2> &instant)
        {
          const algebra::Vector load = data(instant).load;
          const VariationalBody &body = matrix_->body();
          std::vector<double> result;
          for (std::size_t i = 0; i < body.size(); ++i)
            if (body.V[i] > 0 && body.is_fixed[i] == 0)
              for (unsigned int c = 0; c < 2; ++c)
                result.push_back(load[c * body.size() + i]);
          return result;
        };
        const auto inertia = [this, at_free](const problem::Problem<2> &instant)
        {
          problem::Problem<2> of_solution = instant;
          of_solution.load = *instant.solution;
          return at_free(of_solution);
        };
        return method::move_linear<2>({shown.nodes,
                                       2,
                                       {},
                                       method::MassRoot(std::move(masses)),
                                       shown.action,
                                       {},
                                       at_free,
                                       inertia,
                                       1});
      }

    private:
      method::Field field(const algebra::Vector &u) const
      {
        method::Field result;
        for (std::size_t i = 0; i < cells_->n_free; ++i) // numbered as the lattice
        {
          result.nodes.push_back(cells_->nodes[i]);
          for (unsigned int c = 0; c < 2; ++c)
            result.nodal.push_back(u[c * matrix_->body().size() + cells_->source[i]]);
        }
        result.averages = result.nodal;
        const auto field = std::make_shared<const ScatteredField>(cells_, result.nodal, 2);
        result.value = [field](const Point<2> &x, unsigned int c) { return field->value(x, c); };
        result.write_vtu = [field](const std::string &file) { field->write_vtu(file); };
        return result;
      }

      std::shared_ptr<const geometry::NodeCells<2>> cells_;
      bool loads_are_averages_;
      std::shared_ptr<const BodyOperator> matrix_;
      method::Diagnostics diagnostics_;
    };
  } // namespace

  std::unique_ptr<method::Discretisation> discretise_on_body(const Rule &rule,
                                                             const problem::Problem<2> &problem)
  {
    const Bonds<2> bonds = bonds_of(rule, problem);
    return std::make_unique<RuleOnBody>(problem, bonds,
                                        std::make_shared<const VariationalOperator>(
                                            make_body(problem), influence_of(problem), bonds,
                                            problem.settings.solver.operator_backend));
  }

  std::unique_ptr<method::Discretisation> discretise_by_bonds(const Rule &rule,
                                                              const SurfaceCorrection &correction,
                                                              const problem::Problem<2> &problem)
  {
    if (problem.settings.solver.operator_backend == algebra::OperatorBackend::fft)
      throw InputError(
          "Solver/operator = fft does not support surface corrections, whose matrix is "
          "factored; write automatic or direct");
    const Bonds<2> bonds = bonds_of(rule, problem);
    return std::make_unique<RuleOnBody>(
        problem, bonds,
        std::make_shared<const NetworkOperator>(make_body(problem), influence_of(problem), bonds,
                                                correction));
  }

  method::DiscreteOperator make_discrete_operator(std::shared_ptr<const BodyOperator> matrix)
  {
    const VariationalBody &body = matrix->body();
    method::DiscreteOperator result;
    result.n_components = 2;
    result.is_collocated = false;
    std::vector<std::size_t> positions;
    for (std::size_t i = 0; i < body.size(); ++i)
      if (body.V[i] > 0 && body.is_fixed[i] == 0)
      {
        result.nodes.push_back(body.node(i));
        result.mass.push_back(body.V[i]);
        positions.push_back(i);
        positions.push_back(body.size() + i);
      }
    const std::size_t n = 2 * body.size();
    result.action = algebra::restrict(std::move(matrix), n, positions);
    return result;
  }
} // namespace plumbline::meshfree
