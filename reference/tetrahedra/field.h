#pragma once

#include "geometry/search.h"
#include "problem/in_space.h"
#include "reference/tetrahedra/space.h"

#include <mutex>

namespace plumbline::reference
{
  /// A function of a space on tetrahedra.
  class TetrahedralField
  {
  public:
    /// @param values  of all unknowns
    TetrahedralField(std::shared_ptr<const TetrahedralSpace> space, std::vector<double> values);

    /// In the closed domain Ω. Thread safe.
    /// @throws NumericalError  a point outside Ω
    double value(const dealii::Point<3> &x) const;

    /// In a cell that contains x. Thread safe.
    /// @throws NumericalError  a point outside Ω
    dealii::Tensor<1, 3> gradient(const dealii::Point<3> &x) const;

    /// Over the cells of a lattice, which those of the mesh fill, and perhaps more space. Exact to
    /// round-off; of trilinear functions by a rule of degree 5 on each common part of a cube and a
    /// tetrahedron, which is exact in parallelepipeds.
    std::vector<double> averages(const geometry::CubeLattice &lattice) const;

  private:
    /// A tetrahedron of Ω that contains x.
    std::size_t place(const dealii::Point<3> &x) const;
    double value_in(std::size_t cell, const dealii::Point<3> &x) const;
    void make_search() const;

    std::shared_ptr<const TetrahedralSpace> space_;
    std::vector<double> values_;
    mutable std::once_flag is_search_made_;  ///< which few fields need
    mutable std::vector<std::size_t> inner_; ///< cells of Ω
    mutable std::unique_ptr<const geometry::BoxSearch<3>> search_;
  };

  /// ∫ b φ_i of the free unknowns and a component of b over Ω, by a rule of degree 5 on each cell
  /// (along each axis of a hexahedron).
  std::vector<double> tested_load(const problem::Field<3> &load, const TetrahedralSpace &space,
                                  unsigned int component = 0);

  /// A quarter of the tetrahedra around each free vertex, an eighth of the hexahedra, or the free
  /// cells. [length^3]
  std::vector<double> volumes(const TetrahedralSpace &space);
} // namespace plumbline::reference
