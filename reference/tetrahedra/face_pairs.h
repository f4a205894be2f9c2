#pragma once

#include "geometry/cube_lattice.h"
#include "reference/tetrahedra/face_potential.h"

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace plumbline::reference
{
  /// A triangle in space with points of quadrature, for the many pairs that it is in.
  class PairFace
  {
  public:
    using Vertices = std::array<dealii::Point<3>, 3>;

    PairFace(const Vertices &vertices, const std::array<unsigned int, 3> &names);

    const Vertices &vertices() const { return vertices_; }
    const std::array<unsigned int, 3> &names() const { return names_; } ///< of its vertices
    const dealii::Point<3> &centre() const { return centre_; }
    double radius() const { return radius_; } ///< about the centre, of a ball that holds it
    double area() const { return area_; }
    geometry::Cuboid box() const; ///< along the axes

  private:
    Vertices vertices_;
    std::array<unsigned int, 3> names_;
    dealii::Point<3> centre_;
    double radius_ = 0, area_ = 0;
  };

  /// Whether their projections on the line through their centres are at least a horizon (1) apart.
  bool are_out_of_reach(const PairFace &f, const PairFace &g);

  /// ∬_{F×G} f(|x - y|) of a FacePotential f, by quadrature in all four directions. Triangles that
  /// touch each other take the rules of Sauter & Schwab 2011, Boundary Element Methods, sec. 5.2,
  /// whose coordinates turn the singularity of 1/r into a smooth function; others products of
  /// symmetric rules (Witherden & Vincent 2015, doi:10.1016/j.camwa.2015.03.017), whose degree
  /// depends on how near they are to each other and to the horizon. Lengths are in horizons.
  /// Sums that a mesh makes of these integrals vanish for linear fields whatever the rule, because
  /// jumps do.
  class FacePairs
  {
  public:
    /// @param refinement  points more along a line than the rules of level 0 have
    FacePairs(const FacePotential &potential, unsigned int refinement);

    /// Symmetric in F and G to round-off. Thread safe.
    double operator()(const PairFace &f, const PairFace &g) const;

  private:
    /// Points in barycentric coordinates.
    struct Rule
    {
      std::vector<std::array<double, 3>> points;
      std::vector<double> weights; ///< they add up to 1
    };
    /// Pairs of points of two triangles whose first vertices, or sides, are shared: ends of rays
    /// from the first vertex, in which both points move and distances are linear.
    struct TouchingRule
    {
      std::vector<std::array<double, 4>> points; ///< ξ of the first, then of the second
      std::vector<double> weights;               ///< they add up to 4, for ∫_0^1 s³ ds = 1/4
    };

    const Rule &rule_for(const PairFace &f, const PairFace &g) const;
    double product(const PairFace &f, const PairFace &g, unsigned int depth) const;
    double touching(const PairFace &f, const PairFace &g, unsigned int n_shared) const;
    static Rule make_rule(unsigned int n_points);
    static TouchingRule make_touching_rule(unsigned int n_shared, unsigned int refinement);

    const FacePotential &potential_;
    std::vector<double> ends_;
    unsigned int refinement_;
    std::vector<Rule> rules_;                    ///< with 1, 2, ... points along a line
    std::array<TouchingRule, 3> touching_rules_; ///< with 1, 2 and 3 vertices shared
  };
} // namespace plumbline::reference
