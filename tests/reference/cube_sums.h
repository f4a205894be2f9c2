// Entries of DGP0 on six tetrahedra per cube, added up over the cells of cubes.
#pragma once

#include "algebra/csr_matrix.h"
#include "algebra/stencil.h"
#include "reference/tetrahedra/space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace plumbline::reference
{
  /// The largest error of the sums against the entries of DGQ0 on cubes of side 1, relative to the
  /// diagonal.
  /// @param matrix  six rows, of the cells of the cube at the origin
  inline double error_of_cube_sums(const algebra::CsrMatrix &matrix, const TetrahedralSpace &space,
                                   const algebra::Stencil &stencil)
  {
    std::map<std::array<int, 3>, double> sums;
    for (std::size_t k = 0; k < matrix.start[6]; ++k)
    {
      std::array<int, 3> cube{};
      for (unsigned int d = 0; d < 3; ++d)
        cube[d] = static_cast<int>(std::floor(space.support(matrix.column[k])[d]));
      sums[cube] += matrix.value[k];
    }
    double worst = 0;
    for (const auto &[cube, sum] : sums)
      worst = std::max(worst, std::abs(sum - stencil(0, 0, cube[0], cube[1], cube[2])));
    return worst / stencil(0, 0, 0, 0, 0);
  }
} // namespace plumbline::reference
