#include "reference/local/local_limit.h"

#include "reference/local/deal_mesh.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools.h>

namespace plumbline::reference
{
  namespace
  {
    constexpr unsigned int degree = 2;

    class Constraint : public dealii::Function<2>
    {
    public:
      explicit Constraint(const scene::Problem &problem)
          : Function<2>(problem.n_components), problem_(problem)
      {
      }
      double value(const Point<2> &x, unsigned int component) const override
      {
        return problem_.constraint.value(x, component);
      }

    private:
      const scene::Problem &problem_;
    };

    struct System
    {
      dealii::AffineConstraints<double> constraints;
      dealii::SparsityPattern pattern;
      dealii::SparseMatrix<double> matrix;
      dealii::Vector<double> right_hand_side, solution;
    };

    void assemble(const scene::Problem &problem, const DealMesh &mesh,
                  const dealii::DoFHandler<2> &dofs, System &system)
    {
      const auto &element = dofs.get_fe();
      const physics::LocalLimit limit = problem.kernel.limit();
      dealii::Quadrature<2> gauss = dealii::QGauss<2>(degree + 2);
      if (!mesh.triangulation.all_reference_cells_are_hyper_cube())
        gauss = dealii::QWitherdenVincentSimplex<2>(degree + 2);
      dealii::FEValues<2> values(*mesh.mapping, element, gauss,
                                 dealii::update_values | dealii::update_gradients |
                                     dealii::update_quadrature_points | dealii::update_JxW_values);
      const unsigned int n = element.n_dofs_per_cell();
      dealii::FullMatrix<double> matrix(n, n);
      dealii::Vector<double> load(n);
      std::vector<dealii::types::global_dof_index> indices(n);
      for (const auto &cell : dofs.active_cell_iterators())
      {
        values.reinit(cell);
        matrix = 0;
        load = 0;
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
          {
            const unsigned int c = element.system_to_component_index(i).first;
            const auto &v = values.shape_grad(i, q);
            const double b =
                problem.load.series ? (*problem.load.series)(x, c) : problem.load.value(x, c);
            load[i] += weight * b * values.shape_value(i, q);
            for (unsigned int j = 0; j < n; ++j)
            {
              const unsigned int d = element.system_to_component_index(j).first;
              const auto &u = values.shape_grad(j, q);
              if (problem.n_components == 1)
                matrix(i, j) += weight * a * limit.diffusion * (u * v);
              else
                matrix(i, j) += weight * (lambda * v[c] * u[d] +
                                          a * limit.mu * (v[d] * u[c] + (c == d ? u * v : 0)));
            }
          }
        }
        cell->get_dof_indices(indices);
        system.constraints.distribute_local_to_global(matrix, load, indices, system.matrix,
                                                      system.right_hand_side);
      }
    }
  } // namespace

  MeshSolution solve_local(const scene::Problem &problem)
  {
    const base::MemoryGauge memory;
    base::CpuTimer timer;
    const DealMesh mesh(*problem.mesh);
    const dealii::FESystem<2> element(*mesh.element(true, degree), problem.n_components);
    dealii::DoFHandler<2> dofs(mesh.triangulation);
    dofs.distribute_dofs(element);

    System system;
    dealii::VectorTools::interpolate_boundary_values(*mesh.mapping, dofs, 0, Constraint(problem),
                                                     system.constraints);
    system.constraints.close();
    dealii::DynamicSparsityPattern pattern(dofs.n_dofs());
    dealii::DoFTools::make_sparsity_pattern(dofs, pattern, system.constraints, false);
    system.pattern.copy_from(pattern);
    system.matrix.reinit(system.pattern);
    system.right_hand_side.reinit(dofs.n_dofs());
    system.solution.reinit(dofs.n_dofs());
    assemble(problem, mesh, dofs, system);

    const auto space = std::make_shared<const MeshSpace>(problem.mesh, true, degree);
    const unsigned int nc = problem.n_components;
    MeshSolution result{{space, std::make_shared<const MeshCells>(*problem.mesh), nc,
                         std::vector<double>(space->n_dofs() * nc)},
                        {},
                        {}};
    result.cost.setup_seconds = timer.seconds();
    timer.restart();
    dealii::SparseDirectUMFPACK solver;
    solver.initialize(system.matrix);
    solver.vmult(system.solution, system.right_hand_side);
    system.constraints.distribute(system.solution);

    // the same nodal functions, in the order of the mesh's own space
    std::vector<dealii::types::global_dof_index> indices(element.n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
    {
      const std::size_t own = mesh.cell[cell->active_cell_index()];
      cell->get_dof_indices(indices);
      for (unsigned int k = 0; k < indices.size(); ++k)
      {
        const auto x =
            mesh.mapping->transform_unit_to_real_cell(cell, element.unit_support_point(k));
        const unsigned int *const nearest = std::min_element(
            space->dofs(own), space->dofs(own) + space->shapes().size(),
            [&](unsigned int a, unsigned int b) {
              return space->support(a).distance_square(x) < space->support(b).distance_square(x);
            });
        result.field.values[*nearest * nc + element.system_to_component_index(k).first] =
            system.solution[indices[k]];
      }
    }
    result.cost.solve_seconds = timer.seconds();
    result.cost.peak_bytes = memory.peak_bytes();
    result.cost.n_unknowns = dofs.n_dofs() - system.constraints.n_constraints();
    result.cost.n_bonds = system.matrix.n_nonzero_elements();
    result.diagnostics.operator_backend = "sparse, direct";
    return result;
  }
} // namespace plumbline::reference
