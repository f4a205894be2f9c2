#pragma once

#include "physics/state_based.h"
#include "reference/mesh/cells.h"
#include "reference/mesh/pair_quadrature.h"
#include "reference/mesh/space.h"

namespace plumbline::reference
{
  /// Where ξ is replaced by M ξ near cracks and surfaces, with M = [∫ K ξ⊗ξ dξ]^-1 over the visible
  /// part of the ball, so that linear fields keep their divergence. Source: Fan et al. 2022,
  /// doi:10.1016/j.cma.2022.115340, eq. (3.21).
  enum class Correction
  {
    none,
    dilatation, ///< in θ alone, as meshfree rules with the surface terms `none` have it
    energy      ///< in θ and E: if f is symmetric, so is ∫ θ_u E_v, which then has an energy
  };

  /// At a point x of a mesh, as rows of numbers that multiply the unknowns of vector fields,
  ///   θ_u(x) = ∫ K ξ·(u(x+ξ) - u(x)) dξ  and  E_v(x) = ∫ f(x, x+ξ) K ξ·(v(x+ξ) - v(x)) dξ
  /// over the part of ball(x) that the mesh covers: few points on whole cells; on those that the
  /// circle cuts a rule for the curved piece or, for influence functions that are no polynomials
  /// and near x, polar about x. With cracks, both integrals are over the part that is visible from
  /// x. Accuracy: constants give 0 and, where the ball is covered or `Correction` is not none,
  /// linear fields their divergence to 1e-13. Not thread safe: give each thread its own copy.
  class DilatationRow
  {
  public:
    /// @param materials  of each cell; empty: they change inside of them
    /// @param smooth_degree  of polynomials that stand on a cell for functions that are none: the
    /// material of two-point models, shape functions through a bilinear map
    DilatationRow(const MeshSpace &space, const MeshCells &cells,
                  const physics::Dilatation<2> &dilatation, std::vector<physics::Lame> materials,
                  unsigned int smooth_degree, geometry::Backend backend,
                  Correction correction = Correction::none, std::vector<geometry::Cut> cracks = {});

    /// What a material has no part in is the same for pairs that are translations.
    bool is_geometry_alone() const { return dilatation_.is_symmetric() || !materials_.empty(); }

    /// f of two cells.
    /// @pre  is_geometry_alone(), materials are given
    double factor(std::size_t cell, std::size_t inner) const
    {
      return dilatation_.factor(materials_[cell], materials_[inner]);
    }

    /// ∫Kξφ over ball(x) ∩ cell, shape (n_shapes, 2), until the next call. Cracks are ignored.
    const std::vector<double> &integrate(const Point<2> &x, std::size_t inner);

    /// @param cell, unit  where x is
    /// @param near   cells, among them all in reach of x
    /// @param known  what `integrate` gives for each of them, if nothing is corrected; empty: not
    /// known
    /// @param slot   of each dof of these in the rows
    /// @param theta, test  rows of θ and E, shape (n_slots, 2), overwritten
    void evaluate(std::size_t cell, const Point<2> &unit, const std::vector<unsigned int> &near,
                  const std::vector<const double *> &known, const std::vector<unsigned int> &slot,
                  std::vector<double> &theta, std::vector<double> &test);

  private:
    double factor_of(std::size_t inner) const;
    const std::vector<double> &integrate_visible(const Point<2> &x, std::size_t inner);
    void add_region(const Point<2> &x, const geometry::ConvexCell &region, std::size_t inner);
    void add_ball(const geometry::Ball &ball, const SmoothEntries &influence,
                  const geometry::ConvexCell &region, std::size_t inner);
    const double *find_rule(const geometry::Ball &ball, const SmoothEntries &influence,
                            const geometry::ConvexCell &region, std::size_t inner);

    const MeshSpace &space_;
    const MeshCells &cells_;
    physics::Dilatation<2> dilatation_;
    KernelEntries profile_;
    std::vector<physics::Lame> materials_;
    unsigned int smooth_degree_;
    geometry::Backend backend_;
    Correction correction_;
    std::vector<geometry::Cut> cracks_;
    unsigned int degree_;          ///< of shape functions and of ξ, if that is integrated
    std::vector<ShapeRule> whole_; ///< on whole cells, exact to degree 2 i + 1

    physics::Lame own_{};              ///< the material at x
    std::vector<double> theta_, test_; ///< ∫Kξφ, ∫fKξφ of a cell, shape (n_shapes, 2); the latter
                                       ///< where materials change inside of cells
    dealii::Tensor<2, 2> moment_; ///< ∫Kξ⊗ξ, for the correction
    std::vector<geometry::Cut> between_;
    std::vector<geometry::Polygon> seen_;
    std::vector<double> phi_;
    geometry::CutRule rule_;
  };
} // namespace plumbline::reference
