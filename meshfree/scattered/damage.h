#pragma once

#include "geometry/cracks.h"
#include "meshfree/rules/quadrature_rule.h"
#include "meshfree/scattered/faces.h"
#include "problem/surface_terms.h"

namespace plumbline::meshfree
{
  using dealii::Tensor;

  /// What of a body is broken.
  struct Damage
  {
    std::vector<geometry::Polyline> cracks;
    std::vector<char> is_ghost; ///< of each node: beyond a free surface, where it only completes
                                ///< the balls of others; empty: none is
    problem::SurfaceTerms surface_terms = problem::SurfaceTerms::published;
    /// Positive beyond free surfaces: where they are; empty: there are none, or only ghosts say so,
    /// and consistent terms find no face there.
    std::function<double(const Point<2> &)> outside = {};
  };

  /// Tells which bonds are broken: those that cross a crack and those to ghosts. A bond through an
  /// end of a crack is intact, and so is one that runs along a crack; to 1e-9 of the horizon.
  class BrokenBonds
  {
  public:
    /// @throws InputError  as geometry::check_cracks and check_ghosts
    BrokenBonds(const Damage &damage, const geometry::NodeCells<2> &cells, double horizon);

    /// Thread safe.
    /// @param is_intact  overwritten, of each bond
    /// @return           whether all are
    bool find(std::size_t node, const Family<2> &family, std::vector<char> &is_intact) const;

    bool is_ghost(std::size_t node) const { return !is_ghost_.empty() && is_ghost_[node] != 0; }

  private:
    struct Segment
    {
      Point<2> first, last;
      bool begins = false, ends = false; ///< the crack
    };

    bool crosses(const Segment &segment, const Point<2> &p, const Point<2> &q) const;

    const geometry::NodeCells<2> *cells_;
    std::vector<char> is_ghost_;
    double tolerance_; ///< [length]
    std::vector<Segment> segments_;
    geometry::BoxSearch<2> search_; ///< over the segments
  };

  /// The faces of a body on nodes, and the tips of its cracks.
  Faces find_faces(const Damage &damage, const geometry::NodeCells<2> &cells, double horizon);

  /// @throws InputError  of a node whose family is not whole: nothing of it is left
  void check_constrained(const std::vector<char> &is_intact, const geometry::NodeCells<2> &cells,
                         std::size_t node);

  /// What broken bonds make of a family.
  /// Source: Fan et al. 2022, doi:10.1016/j.cma.2022.115340, eqs. (3.21), (3.22).
  struct Remainder
  {
    Tensor<2, 2> correction; ///< M, with which the dilatation of a linear field is its divergence;
                             ///< a pseudo-inverse where the bonds left lie on a line
    Tensor<1, 2> normal;     ///< out of the body; 0 where bonds are missing on all sides alike
  };

  Remainder remainder(const Kernel<2> &influence, const Family<2> &family,
                      const std::vector<char> &is_intact);
} // namespace plumbline::meshfree
