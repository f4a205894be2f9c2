#pragma once

#include "reference/tetrahedra/face_pairs.h"
#include "reference/tetrahedra/face_potential.h"

#include <array>
#include <vector>

namespace plumbline::reference
{
  class FaceSides;

  /// Integrals over a pair of faces F and G for functions that jump across both, linearly along
  /// each. λ_a are the linear functions of a face's vertices, n its normal, about which its
  /// vertices are counter-clockwise, and h a height over its plane along n.
  struct JumpIntegrals
  {
    std::array<std::array<double, 3>, 3> values{}; ///< [a][b]: ∬_{F×G} λ_a(x) λ_b(y) Λ(r)
    std::array<double, 3> first{};                 ///< [a]: ∬_{F×G} λ_a(x) h_G(x) Ψ'(r)/r
    std::array<double, 3> second{};                ///< [b]: ∬_{F×G} λ_b(y) h_F(y) Ψ'(r)/r
    /// The last change by refinement where it was not below the tolerance at the finest level, in
    /// the unit of the tolerance, else 0; infinite where an integral is not finite.
    double open = 0;
  };

  /// JumpIntegrals of the potentials Λ and Ψ of FacePotential: over one of the two faces by
  /// integrals along its sides, which Gauss rules give to about 1e-8, over the other by quadrature.
  /// With H' = r g, the distance d of a point from the plane, its foot in the plane, the vector ρ
  /// from the foot, κ the distance of a side from the foot (> 0 from within), m its outward normal
  /// and ρ² = κ² + τ² along it,
  ///   ∫_G g = Σ κ ∫ (H(r) - H(d)) / (κ² + τ²) dτ,   ∫_G ρ g = Σ m ∫ H(r) dτ,
  /// since (H(r) - H(d)) ρ / ρ² and H have the divergence g and the gradient ρ g in the plane. H =
  /// Ψ for g = Ψ'/r, and H = -∫_r^1 t γ (t - r)²/2 dt for g = Λ; both vanish beyond the horizon;
  /// the cut of the sphere with G is not needed. The quadrature's integrand is smooth except on
  /// lines where the sphere touches a side of the other face, where three derivatives are
  /// continuous, and at sides and vertices that both faces share, where its points are clustered.
  class JumpPairs
  {
  public:
    /// @param tolerance  of Λ's integrals, and of the others divided by the face's size: rules are
    /// refined until the last change is below it, or the finest is used: see JumpIntegrals::open
    JumpPairs(const PotentialKernel &kernel, double tolerance);

    /// Those of (G, F) are the transpose, equal to the last bit. Thread safe.
    JumpIntegrals operator()(const PairFace &f, const PairFace &g) const;

  private:
    /// Points in barycentric coordinates, with weights that add up to 1.
    struct Rule
    {
      std::vector<std::array<double, 3>> points;
      std::vector<double> weights;
    };
    /// For r < end: -H of Λ, and r Ψ.
    struct Part
    {
      double end() const { return biharmonic.end(); }
      PotentialPart<double> harmonic, biharmonic; ///< their r f
    };
    /// H of both potentials.
    struct Values
    {
      double harmonic = 0, biharmonic = 0;
    };
    /// A side of a face, from the foot of a point.
    struct Side
    {
      double kappa = 0, from = 0, to = 0; ///< τ at its ends
    };
    /// Integrals over a face, for a fixed point.
    struct PointIntegrals
    {
      std::array<double, 3> values{}; ///< ∫ λ_b Λ
      double slope = 0;               ///< h ∫ Ψ'/r
    };

    /// Integrals of PointIntegrals over the other face.
    struct FaceIntegrals
    {
      std::array<std::array<double, 3>, 3> values{}; ///< ∬ λ_a λ_b Λ
      std::array<double, 3> slopes{};                ///< ∬ λ_a h Ψ'/r
      double open = 0;                               ///< see JumpIntegrals
    };

    /// Quadrature over the outer face of integrals along the sides of the inner one.
    FaceIntegrals integrate_over(const PairFace &outer, const PairFace &inner) const;
    FaceIntegrals integrate_over(const PairFace &outer, const FaceSides &inner,
                                 const std::array<unsigned int, 3> &order, const Rule &rule) const;
    PointIntegrals integrals_at(const dealii::Point<3> &point, const FaceSides &face) const;
    void add_side(const Part &part, const Side &side, double distance, const Values &foot,
                  Values &whole, double &moment) const;
    static void values(const Part &part, const double *r, double *harmonic, double *biharmonic,
                       unsigned int n);
    static Rule make_rule(unsigned int n_points);
    static Rule on_quarters(const Rule &whole);
    static Rule make_touching_rule(unsigned int n_shared, unsigned int n_points);

    std::vector<Part> parts_;
    double tolerance_;
    std::array<std::vector<Rule>, 4> rules_; ///< by number of shared vertices, finer ones last
  };
} // namespace plumbline::reference
