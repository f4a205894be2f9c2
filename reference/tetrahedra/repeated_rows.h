#pragma once

#include "reference/tetrahedra/assembly.h"

namespace plumbline::reference
{
  /// The rows that assemble_by_faces makes of a mesh of six tetrahedra per cube. Translations map
  /// the unknowns of one cube onto those of another, so that the rows of one vertex, or of the six
  /// cells of one cube, are all that there is to integrate.
  class RepeatedRows
  {
  public:
    /// Symmetric to the last bit.
    RepeatedRows(const physics::Kernel<3> &kernel, double h, TetrahedralShapes shapes,
                 const FaceRule &rule, FaceRuleUse *use = nullptr,
                 const std::optional<physics::Dilatation<3>> &dilatation = {});

    /// Those of the free unknowns.
    /// @param space  on geometry::six_per_cube(lattice, layers_within(reach, h)), of the same
    /// kind
    algebra::CsrMatrix on(const TetrahedralSpace &space,
                          const geometry::CubeLattice &lattice) const;

    /// The largest difference of two entries, relative to the largest entry; NaN if one is.
    double difference(const RepeatedRows &other) const;

  private:
    /// An entry of a row, relative to the row's own vertex or cube.
    struct Entry
    {
      std::array<int, 3> offset{};
      std::size_t type = 0; ///< of a cube's cell, and of the component
      double value = 0;
    };

    void make_symmetric();

    TetrahedralShapes shapes_;
    unsigned int n_components_;
    int n_layers_;
    std::vector<std::vector<Entry>> rows_; ///< by type
  };
} // namespace plumbline::reference
