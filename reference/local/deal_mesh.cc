#include "reference/local/deal_mesh.h"

#include "base/error.h"
#include "reference/mesh/field.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>

#include <algorithm>
#include <fstream>

namespace plumbline::reference
{
  DealMesh::DealMesh(const geometry::Mesh &mesh)
  {
    std::vector<dealii::CellData<2>> cells;
    for (std::size_t i = 0; i < mesh.cells.size(); ++i)
      if (const geometry::MeshCell &one = mesh.cells[i]; one.is_inside)
      {
        cells.emplace_back(one.n_vertices);
        std::copy_n(one.vertex.begin(), one.n_vertices, cells.back().vertices.begin());
        if (one.n_vertices == 4) // deal.II counts along the axes
          std::swap(cells.back().vertices[2], cells.back().vertices[3]);
        cell.push_back(i);
      }
    std::vector<Point<2>> vertices = mesh.vertices;
    dealii::SubCellData none;
    std::vector<unsigned int> all;
    dealii::GridTools::delete_unused_vertices(vertices, cells, none);
    if (mesh.is_quads())
      dealii::GridTools::consistently_order_cells(cells);
    triangulation.create_triangulation(vertices, cells, none);
    if (mesh.is_quads())
      mapping = std::make_unique<dealii::MappingQ<2>>(1);
    else
      mapping = std::make_unique<dealii::MappingFE<2>>(dealii::FE_SimplexP<2>(1));
  }

  std::unique_ptr<dealii::FiniteElement<2>> DealMesh::element(bool is_continuous,
                                                              unsigned int degree) const
  {
    const bool is_quads = triangulation.all_reference_cells_are_hyper_cube();
    if (is_quads && is_continuous)
      return std::make_unique<dealii::FE_Q<2>>(degree);
    if (is_quads)
      return std::make_unique<dealii::FE_DGQ<2>>(degree);
    if (is_continuous)
      return std::make_unique<dealii::FE_SimplexP<2>>(degree);
    return std::make_unique<dealii::FE_SimplexDGP<2>>(degree);
  }

  void write_vtu(const MeshField &field, const std::string &file)
  {
    const DealMesh mesh(field.space->mesh());
    const bool is_quads = field.space->shapes().n_vertices() == 4;
    const unsigned int degree = std::clamp(field.space->shapes().degree(), 1u, is_quads ? 3u : 2u);
    const dealii::FESystem<2> element(*mesh.element(false, degree), field.n_components);
    dealii::DoFHandler<2> dofs(mesh.triangulation);
    dofs.distribute_dofs(element);
    dealii::Vector<double> values(dofs.n_dofs());
    std::vector<dealii::types::global_dof_index> indices(element.n_dofs_per_cell());
    double phi[CellShapes::most];
    for (const auto &cell : dofs.active_cell_iterators())
    {
      const std::size_t own = mesh.cell[cell->active_cell_index()];
      cell->get_dof_indices(indices);
      for (unsigned int k = 0; k < indices.size(); ++k)
      {
        const auto x =
            mesh.mapping->transform_unit_to_real_cell(cell, element.unit_support_point(k));
        field.space->values(own, field.space->map(own).unit(x), phi);
        const unsigned int c = element.system_to_component_index(k).first;
        for (unsigned int a = 0; a < field.space->shapes().size(); ++a)
          values[indices[k]] +=
              phi[a] * field.values[field.space->dofs(own)[a] * field.n_components + c];
      }
    }
    dealii::DataOut<2> output;
    output.attach_dof_handler(dofs);
    if (field.n_components == 1)
      output.add_data_vector(values, "u");
    else
      output.add_data_vector(values, std::vector<std::string>(2, "u"),
                             dealii::DataOut<2>::type_dof_data,
                             {2, dealii::DataComponentInterpretation::component_is_part_of_vector});
    output.build_patches(*mesh.mapping, degree);
    std::ofstream stream(file);
    if (!stream)
      throw InputError("cannot write '" + file + "'; give a writable output folder (-o)");
    output.write_vtu(stream);
    if (!stream.flush())
      throw InputError("cannot write all of '" + file +
                       "'; free some space, or give another output folder (-o)");
  }
} // namespace plumbline::reference
