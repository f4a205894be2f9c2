#pragma once

#include "reference/lattice/field.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>

namespace plumbline::reference
{
  /// A lattice field as deal.II sees it: the cells of Ω as a triangulation, FE_Q or FE_DGQ on them,
  /// and the vector of degrees of freedom.
  struct DealField
  {
    explicit DealField(const LatticeField &field);

    dealii::Triangulation<2> triangulation;
    dealii::FESystem<2> element;
    dealii::DoFHandler<2> dofs;
    dealii::Vector<double> values;
  };
} // namespace plumbline::reference
