#include "reference/local/local_limit.h"

#include "reference/local/deal_mesh.h"
#include "reference/mesh/discretisation.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/numerics/matrix_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>

namespace plumbline::reference
{
  namespace
  {
    using method::Vector;
    constexpr unsigned int degree = 2;

    class Constraint : public dealii::Function<2>
    {
    public:
      explicit Constraint(const problem::Problem<2> &problem)
          : Function<2>(problem.n_components), problem_(problem)
      {
      }
      double value(const Point<2> &x, unsigned int component) const override
      {
        return problem_.constraint.value(x, component);
      }

    private:
      const problem::Problem<2> &problem_;
    };

    /// A rule on each of n² equal parts of the unit square or triangle.
    dealii::Quadrature<2> in_parts(const dealii::Quadrature<2> &rule, bool is_triangle,
                                   unsigned int n)
    {
      std::vector<Point<2>> points;
      std::vector<double> weights;
      const auto add = [&](double corner_x, double corner_y, double side)
      {
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          points.emplace_back(corner_x + side * rule.point(q)[0],
                              corner_y + side * rule.point(q)[1]);
          weights.push_back(side * side * rule.weight(q));
        }
      };
      const double side = 1. / n;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          if (!is_triangle || i + j < n)
          {
            add(i * side, j * side, side);
            if (is_triangle && i + j + 1 < n) // the one turned around
              add((i + 1) * side, (j + 1) * side, -side);
          }
      return {points, weights};
    }

    class DirectSystem : public algebra::LinearSystem
    {
    public:
      explicit DirectSystem(const dealii::SparseMatrix<double> &matrix) : matrix_(matrix)
      {
        inverse_.initialize(matrix);
      }
      void vmult(Vector &y, const Vector &x) const override { matrix_.vmult(y, x); }
      algebra::LinearSolve solve(Vector &x, const Vector &b,
                                 const algebra::Stopping &) const override
      {
        inverse_.vmult(x, b);
        return {0, 0, "sparse, direct", matrix_.n_nonzero_elements()};
      }

    private:
      const dealii::SparseMatrix<double> &matrix_;
      dealii::SparseDirectUMFPACK inverse_;
    };

    /// A state is 0 on the boundary, where the constraint is added.
    class LocalLimit : public method::Discretisation
    {
    public:
      explicit LocalLimit(const problem::Problem<2> &problem)
          : mesh_(*problem.mesh()), element_(*mesh_.element(true, degree), problem.n_components),
            dofs_(mesh_.triangulation), gauss_(dealii::QGauss<2>(degree + 2)),
            space_(std::make_shared<const MeshSpace>(problem.mesh(), true, degree)),
            cells_(std::make_shared<const MeshCells>(*problem.mesh())), averaged_(problem.cells())
      {
        if (!mesh_.triangulation.all_reference_cells_are_hyper_cube())
          gauss_ = dealii::QWitherdenVincentSimplex<2>(degree + 2);
        dofs_.distribute_dofs(element_);
        boundary_ = boundary_values(dealii::Functions::ZeroFunction<2>(problem.n_components));
        dealii::DynamicSparsityPattern pattern(dofs_.n_dofs());
        dealii::DoFTools::make_sparsity_pattern(dofs_, pattern);
        pattern_.copy_from(pattern);
        matrix_.reinit(pattern_);
        assemble(problem);
        constrained_matrix_.reinit(pattern_);
        constrained_matrix_.copy_from(matrix_);
        Vector ignored(dofs_.n_dofs()), also_ignored(dofs_.n_dofs());
        dealii::MatrixTools::apply_boundary_values(boundary_, constrained_matrix_, ignored,
                                                   also_ignored);
      }

      std::size_t n_unknowns() const override { return dofs_.n_dofs() - boundary_.size(); }

      method::CaseData data(const problem::Problem<2> &problem) const override
      {
        method::CaseData result;
        result.load = load(problem);
        const auto given = std::make_shared<Vector>(dofs_.n_dofs());
        for (const auto &[dof, value] : boundary_values(Constraint(problem)))
          (*given)[dof] = value;
        Vector reaction(dofs_.n_dofs());
        matrix_.vmult(reaction, *given);
        result.load -= reaction;
        for (const auto &[dof, zero] : boundary_)
          result.load[dof] = zero;
        result.field = [this, given](const Vector &u)
        {
          Vector whole = u;
          whole += *given;
          return as_field(in_own_space(whole), *averaged_);
        };
        return result;
      }

      std::unique_ptr<algebra::LinearSystem> tangent() const override
      {
        return std::make_unique<DirectSystem>(constrained_matrix_);
      }
      method::DiscreteOperator matrix() const override { return {}; } // it is no nonlocal method's
      method::Diagnostics diagnostics() const override { return {}; }

    private:
      std::map<dealii::types::global_dof_index, double>
      boundary_values(const dealii::Function<2> &given) const
      {
        std::map<dealii::types::global_dof_index, double> values;
        dealii::VectorTools::interpolate_boundary_values(*mesh_.mapping, dofs_, 0, given, values);
        return values;
      }

      void assemble(const problem::Problem<2> &problem)
      {
        const physics::LocalLimit limit = problem.kernel.limit();
        dealii::FEValues<2> values(*mesh_.mapping, element_, gauss_,
                                   dealii::update_gradients | dealii::update_quadrature_points |
                                       dealii::update_JxW_values);
        const unsigned int n = element_.n_dofs_per_cell();
        dealii::FullMatrix<double> local(n, n);
        std::vector<dealii::types::global_dof_index> indices(n);
        for (const auto &cell : dofs_.active_cell_iterators())
        {
          values.reinit(cell);
          local = 0;
          for (const unsigned int q : values.quadrature_point_indices())
          {
            const Point<2> &x = values.quadrature_point(q);
            const double weight = values.JxW(q);
            const double a = problem.coefficient ? problem.coefficient->at(x) : 1;
            double lambda = a * limit.lambda;
            if (problem.dilatation)
            {
              const physics::Lame lame = problem.dilatation->material(x);
              lambda += lame.lambda - lame.mu;
            }
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
              {
                const unsigned int c = element_.system_to_component_index(i).first,
                                   d = element_.system_to_component_index(j).first;
                const auto &v = values.shape_grad(i, q), &u = values.shape_grad(j, q);
                if (problem.n_components == 1)
                  local(i, j) += weight * a * limit.diffusion * (u * v);
                else
                  local(i, j) += weight * (lambda * v[c] * u[d] +
                                           a * limit.mu * (v[d] * u[c] + (c == d ? u * v : 0)));
              }
          }
          cell->get_dof_indices(indices);
          matrix_.add(indices, local);
        }
      }

      Vector load(const problem::Problem<2> &problem) const
      {
        constexpr unsigned int n_parts = 8; // of cells where b may jump, along each side
        const dealii::Quadrature<2> rule =
            in_parts(gauss_, !mesh_.triangulation.all_reference_cells_are_hyper_cube(),
                     problem.load.is_smooth() ? 1 : n_parts);
        dealii::FEValues<2> values(*mesh_.mapping, element_, rule,
                                   dealii::update_values | dealii::update_quadrature_points |
                                       dealii::update_JxW_values);
        const problem::Field<2> &b = problem.load;
        std::vector<dealii::types::global_dof_index> indices(element_.n_dofs_per_cell());
        Vector result(dofs_.n_dofs());
        for (const auto &cell : dofs_.active_cell_iterators())
        {
          values.reinit(cell);
          cell->get_dof_indices(indices);
          for (const unsigned int q : values.quadrature_point_indices())
          {
            const Point<2> &x = values.quadrature_point(q);
            std::array<double, 2> at{};
            for (unsigned int c = 0; c < problem.n_components; ++c)
              at[c] = values.JxW(q) * b(x, c);
            for (unsigned int i = 0; i < indices.size(); ++i)
              result[indices[i]] +=
                  at[element_.system_to_component_index(i).first] * values.shape_value(i, q);
          }
        }
        return result;
      }

      /// The same nodal functions, in the order of the mesh's own space.
      std::shared_ptr<const MeshField> in_own_space(const Vector &u) const
      {
        const unsigned int nc = element_.n_components();
        MeshField field{space_, cells_, nc, std::vector<double>(space_->n_dofs() * nc)};
        std::vector<dealii::types::global_dof_index> indices(element_.n_dofs_per_cell());
        for (const auto &cell : dofs_.active_cell_iterators())
        {
          const unsigned int *const own = space_->dofs(mesh_.cell[cell->active_cell_index()]);
          cell->get_dof_indices(indices);
          for (unsigned int k = 0; k < indices.size(); ++k)
          {
            const auto x =
                mesh_.mapping->transform_unit_to_real_cell(cell, element_.unit_support_point(k));
            const auto is_nearer = [&](unsigned int a, unsigned int b) {
              return space_->support(a).distance_square(x) < space_->support(b).distance_square(x);
            };
            const unsigned int *const nearest =
                std::min_element(own, own + space_->shapes().size(), is_nearer);
            field.values[*nearest * nc + element_.system_to_component_index(k).first] =
                u[indices[k]];
          }
        }
        return std::make_shared<const MeshField>(std::move(field));
      }

      DealMesh mesh_;
      dealii::FESystem<2> element_;
      dealii::DoFHandler<2> dofs_;
      dealii::Quadrature<2> gauss_;
      std::map<dealii::types::global_dof_index, double> boundary_; ///< with 0
      dealii::SparsityPattern pattern_;
      dealii::SparseMatrix<double> matrix_,
          constrained_matrix_; ///< of all unknowns; the boundary's constrained
      std::shared_ptr<const MeshSpace> space_;
      std::shared_ptr<const MeshCells> cells_;
      std::shared_ptr<const geometry::NodeCells<2>> averaged_;
    };
  } // namespace

  std::unique_ptr<method::Discretisation> discretise_local_limit(const problem::Problem<2> &problem)
  {
    return std::make_unique<LocalLimit>(problem);
  }
} // namespace plumbline::reference
