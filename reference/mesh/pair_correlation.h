#pragma once

#include "physics/kernel.h"
#include "reference/mesh/cells.h"
#include "reference/mesh/pair_blocks.h"
#include "reference/mesh/space.h"

namespace plumbline::reference
{
  /// A convex polygon with the shape functions of a cell, that it is or is a part of.
  struct ShapedPolygon
  {
    const MeshSpace &space;
    std::size_t cell = 0;
    const geometry::Polygon &polygon;
  };

  /// Blocks of a pair of triangles or parallelograms, or of parts of such, by a way that has
  /// nothing in common with sides or outer rules, and is slow (2 ms for linear triangles): in polar
  /// coordinates of z = y - x,
  ///   ∬ C(y - x) p(x) q(y) = ∫ C(z) ∫_{T ∩ (T' - z)} p(x) q(x + z) dx dz,
  /// the correlation being a polynomial in |z| between the rays' crossings of the lines where a
  /// vertex of the one meets a side of the other. Accuracy: 1e-13 of C |T| |T'|.
  /// @pre  a profile without breaks, shape functions of degree 2 at most
  void integrate_correlation(const ShapedPolygon &outer, const ShapedPolygon &inner,
                             const physics::Kernel<2> &kernel, PairBlocks &blocks);

  /// Of two cells with straight sides.
  void integrate_correlation(const MeshSpace &space, std::size_t outer, std::size_t inner,
                             const physics::Kernel<2> &kernel, PairBlocks &blocks);
} // namespace plumbline::reference
