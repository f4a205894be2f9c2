#pragma once

#include "method/discretisation.h"
#include "method/method.h"
#include "reference/mesh/field.h"

namespace plumbline::reference
{
  /// On the problem's mesh: entries exact by correlation on axis-aligned rectangles, else by an
  /// outer quadrature that is refined until solutions settle. Masses as of `discretise_on_lattice`.
  /// @param exact_entries  where a way is known, else all by quadrature
  /// @note Collective.
  /// @throws NumericalError  no degree of freedom is free
  std::unique_ptr<method::Discretisation>
  discretise_on_mesh(const problem::Problem<2> &problem, bool is_continuous, unsigned int degree,
                     bool exact_entries, const base::Communicator &communicator);

  /// Whether its matrices are symmetric.
  bool is_symmetric(const problem::Problem<2> &problem);

  /// Why a space cannot have its matrix where sides follow curves, and the remedy; empty: it can.
  std::string refuse_curves(const problem::Problem<2> &problem, bool is_continuous,
                            unsigned int degree);

  /// Memory of its static solution at the peak [bytes], see method::Method::expected_bytes.
  double expected_mesh_bytes(const method::ProblemSize &size, unsigned int n_vertices,
                             bool is_continuous, unsigned int degree);

  /// The view of a field that a study compares.
  method::Field as_field(std::shared_ptr<const MeshField> field,
                         const geometry::NodeCells<2> &cells);
} // namespace plumbline::reference
