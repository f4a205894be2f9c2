#pragma once

#include "geometry/lattice.h"
#include "reference/shapes.h"

#include <array>
#include <vector>

namespace plumbline::reference
{
  /// A function of a lattice space: Q_p or DGQ_p on the cells of Ω, boundary values included.
  class LatticeField
  {
  public:
    /// @param values  degrees of freedom at positions -1 ... n of each axis, data included:
    ///                shape (n_components n_families, n[1] + 2, n[0] + 2)
    LatticeField(geometry::Lattice lattice, AxisShapes shapes, unsigned int n_components,
                 std::vector<double> values);

    const geometry::Lattice &lattice() const { return lattice_; }
    const AxisShapes &shapes() const { return shapes_; }
    unsigned int n_components() const { return n_components_; }

    /// Degree of freedom of the local tensor shape function (a1, a2) on cell (i, j).
    double local(unsigned int component, int i, int j, unsigned int a1, unsigned int a2) const;

    double value(const geometry::Point<2> &x, unsigned int component) const;

    /// Where cells meet, on the one that value() takes.
    dealii::Tensor<1, 2> gradient(const geometry::Point<2> &x, unsigned int component) const;

    /// Averages over squares of side h around the given nodes (cell centres or vertices), exact.
    std::vector<double> averages(const geometry::NodeSet &cells) const;

  private:
    /// A cell that contains a point, and where the point is in it, in cells.
    struct Place
    {
      std::array<int, 2> cell{};
      std::array<double, 2> inner{};
    };
    Place place(const geometry::Point<2> &x) const;

    geometry::Lattice lattice_;
    AxisShapes shapes_;
    unsigned int n_components_;
    std::vector<double> values_;
  };

  /// Write a lattice field as a deal.II field (DoFHandler and vector) through DataOut.
  void write_vtu(const LatticeField &field, const std::string &file);
} // namespace plumbline::reference
