#pragma once

#include "geometry/visible_part.h"
#include "meshfree/check/surface_correction.h"

namespace plumbline::meshfree
{
  /// Families that are cut in one way, and their moments relative to those of the bulk.
  struct CutFamilies
  {
    geometry::FamilyCut cut = geometry::FamilyCut::none;
    std::size_t n = 0;
    /// Difference of first and second moments from those of the visible part, as in MomentDefect,
    /// with a correction of the weights undone. Nodes are numbered as in their file.
    Worst first, second;
    double median_first = 0, median_second = 0;
    /// ∫ tr C |ξ|² over the visible part, over that of the ball; median and minimum.
    double exact = 1, least_exact = 1;
    double given = 1, least_given = 1; ///< the same of the weights as they are given
    std::vector<ElasticRange> elastic; ///< of the weights as they are given; empty for scalars
  };

  /// A bond, or a pair of nodes without one. Nodes are numbered as in their file.
  struct NodePair
  {
    std::size_t node = 0, neighbour = 0;
    double factor = 1; ///< by which its weight differs from those of like bonds in the bulk
  };

  /// What is found of weights on a body with free surfaces or cracks, besides the moments of whole
  /// balls.
  struct BodyCheck
  {
    std::size_t n_families = 0, n_bonds = 0;
    std::vector<CutFamilies> families; ///< of each cut that there is
    std::vector<NodePair> crossing;    ///< bonds across a crack, each pair once
    std::vector<NodePair> missing;     ///< bonds that are in the bulk, and cross no crack, once
    std::vector<NodePair> different;   ///< bonds of cut families with another weight
    std::size_t n_compared = 0;        ///< bonds of cut families that have the like in the bulk
    std::size_t n_at_ends =
        0; ///< pairs that touch the end of a crack: bonded or not, both is right
    FoundCorrection correction;
    SymmetryCheck symmetry; ///< of all families; nodes are numbered as in their file
    double spacing = 0;     ///< of the nodes [length]

    /// Bonds of cut families differ from those of the bulk in general, not one by one.
    bool is_different() const;
  };

  /// Checks what a body has beyond whole balls, and keeps of the weights what can be checked as on
  /// a domain without free surfaces: families of whole balls come first and are free, all other
  /// nodes count as constrained. A surface correction is undone.
  /// @param uncut_areas  of the cells, see GivenCells; put in the same order
  /// @param spacing      of the nodes [length]
  /// @throws InputError  no family is a whole ball
  /// Limits: bonds are compared with those of families whose neighbours have whole balls, too; if
  /// there are none, of all whole balls. A bond missing in a body that is not convex is named only
  /// if it lies in the body.
  BodyCheck check_body(GivenWeights<2> &given, std::vector<double> &uncut_areas,
                       const geometry::VisibleBody &body, const Kernel<2> &kernel, double spacing);
} // namespace plumbline::meshfree
