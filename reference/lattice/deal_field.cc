#include "reference/lattice/deal_field.h"

#include "base/error.h"

#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/numerics/data_out.h>

#include <cmath>
#include <fstream>

namespace plumbline::reference
{
  namespace
  {
    dealii::FESystem<2> make_element(const LatticeField &field)
    {
      const unsigned int degree = field.shapes().degree();
      if (field.shapes().is_continuous())
        return dealii::FESystem<2>(dealii::FE_Q<2>(degree), field.n_components());
      return dealii::FESystem<2>(dealii::FE_DGQ<2>(degree), field.n_components());
    }

    void make_grid(const geometry::Lattice &lattice, dealii::Triangulation<2> &triangulation)
    {
      const auto &n = lattice.n_cells();
      dealii::Table<2, dealii::types::material_id> material(n[0], n[1]);
      for (int i = 0; i < n[0]; ++i)
        for (int j = 0; j < n[1]; ++j)
          material(i, j) = lattice.is_inside(i, j) ? 0 : dealii::numbers::invalid_material_id;
      const std::vector<std::vector<double>> spacing = {std::vector<double>(n[0], lattice.h()),
                                                        std::vector<double>(n[1], lattice.h())};
      dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, spacing, lattice.origin(),
                                                        material);
    }

    /// Index of the one-dimensional shape function with a given support point.
    unsigned int local_index(const AxisShapes &shapes, double x)
    {
      unsigned int best = 0;
      for (unsigned int a = 1; a < shapes.n_local(); ++a)
        if (std::abs(shapes.support_point(a) - x) < std::abs(shapes.support_point(best) - x))
          best = a;
      return best;
    }
  } // namespace

  DealField::DealField(const LatticeField &field) : element(make_element(field))
  {
    make_grid(field.lattice(), triangulation);
    dofs.reinit(triangulation);
    dofs.distribute_dofs(element);
    values.reinit(dofs.n_dofs());

    const geometry::Lattice &lattice = field.lattice();
    std::vector<dealii::types::global_dof_index> indices(element.n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
    {
      const dealii::Tensor<1, 2> place = (cell->center() - lattice.origin()) / lattice.h();
      const int i = static_cast<int>(std::floor(place[0])),
                j = static_cast<int>(std::floor(place[1]));
      cell->get_dof_indices(indices);
      for (unsigned int k = 0; k < indices.size(); ++k)
      {
        const dealii::Point<2> support = element.unit_support_point(k);
        values[indices[k]] = field.local(element.system_to_component_index(k).first, i, j,
                                         local_index(field.shapes(), support[0]),
                                         local_index(field.shapes(), support[1]));
      }
    }
  }

  void write_vtu(const LatticeField &field, const std::string &file)
  {
    const DealField deal(field);
    dealii::DataOut<2> output;
    output.attach_dof_handler(deal.dofs);
    if (field.n_components() == 1)
      output.add_data_vector(deal.values, "u");
    else
      output.add_data_vector(deal.values, std::vector<std::string>(2, "u"),
                             dealii::DataOut<2>::type_dof_data,
                             {2, dealii::DataComponentInterpretation::component_is_part_of_vector});
    output.build_patches(std::max(1u, field.shapes().degree()));
    std::ofstream stream(file);
    if (!stream)
      throw InputError("cannot write '" + file + "'; give a writable output folder (-o)");
    output.write_vtu(stream);
    if (!stream.flush())
      throw InputError("cannot write all of '" + file +
                       "'; free some space, or give another output folder (-o)");
  }
} // namespace plumbline::reference
