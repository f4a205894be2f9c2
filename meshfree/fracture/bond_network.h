#pragma once

#include "meshfree/rules/quadrature_rule.h"
#include "method/fracture_solver.h"
#include "physics/state_based.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace plumbline::meshfree
{
  using dealii::Tensor;

  using method::BreakingSolid;

  /// A solid on the nodes of a lattice, cell centres, as bonds: its energy is
  ///   E = Σ_bonds k/2 (way·Δu)² + Σ_nodes τ/2 θ²,  θ = Σ_bonds share ξ·Δu,  Δu = u_to - u_from,
  /// with k = V w 8μK, share = w K, τ = V (λ - μ), K the influence function of ∫K|ξ|² = 2. That is
  /// the linear peridynamic solid whose bonds end at free surfaces and cracks, without the
  /// correction M of its dilatation and without the terms that free surfaces of traction add,
  /// which make it unsymmetric, see SurfaceForces. λ = μ, plane strain of ν = 1/4, leaves the bonds
  /// alone. Where constants vary, k has the harmonic mean of both ends' μ and τ the node's own λ -
  /// μ, so that there is an energy still; with harmonic means of both, as statics has, there is
  /// none. Both have the same local limit.
  struct BondNetwork
  {
    struct Bond
    {
      unsigned int from = 0, to = 0;
      Tensor<1, 2> xi;      ///< from node to node [length]
      Tensor<1, 2> way;     ///< along which it pulls, of length 1
      double stiffness = 0; ///< k [force/length^2]
      double share = 0;     ///< of dilatations [1/length^2]
      double critical = 0;  ///< the stretch at which it breaks; infinite: never

      Bond reversed() const { return {to, from, -xi, -way, stiffness, share, critical}; }
    };

    double h = 0, horizon = 0; ///< [length]
    std::vector<Point<2>> nodes;
    std::vector<int> grip;                        ///< of each node, -1: free
    std::vector<Tensor<1, 2>> constrained;        ///< u of each node at load 1, 0 where it is free
    std::vector<Bond> bonds;                      ///< that are whole at the beginning, each once
    std::vector<double> toughness;                ///< G of each of them [force/length]
    std::vector<std::array<unsigned int, 2>> cut; ///< nodes of bonds that the notch has cut
    std::vector<double> dilatation;               ///< τ of each node; empty where λ = μ

    /// Of a solid whose dilatations are corrected at surfaces.
    struct Surfaces
    {
      problem::SurfaceTerms terms = problem::SurfaceTerms::published;
      /// Bonds that each node lacks from the beginning, from it to where no node is, or a notch is
      /// between.
      std::vector<Bond> gaps = {};
      std::vector<geometry::Polyline> notch = {};
      std::vector<physics::Lame> lame = {}; ///< of each node
    };
    std::optional<Surfaces> surfaces;

    /// The part of each node's bonds that is broken or cut, shape (n_nodes).
    std::vector<double> damage(const std::vector<std::size_t> &broken) const;
  };

  /// Critical stretches by G: with s0² = G / (4β (λ + μ)), β = ∫K r⁴ dr, the energy of all bonds
  /// across a straight cut of a continuum is G where dilatations are twice the stretch, which is
  /// exact for bonds (λ = μ). On the lattice itself it is .9158 G for m = 3, see lattice_toughness.
  /// Bonds between two materials have harmonic means of λ and μ, and G as BreakingSolid says.
  /// @param rule       with the deviatoric kernel of μ = 1
  /// @param influence  1/r, ∫K|ξ|² = 2
  /// @throws InputError  h that does not fit the boxes; grips that hold no node, or one grip alone;
  /// G <= 0 at a bond; a notch or an interface through a node, or that crosses no bond
  /// Source: Fan et al. 2022, eqs. (2.24)-(2.26); Silling & Askari 2005 for λ = μ,
  /// doi:10.1016/j.compstruc.2004.11.026.
  BondNetwork make_bond_network(const BreakingSolid &solid, const NeighbourhoodQuadrature<2> &rule,
                                const Kernel<2> &influence, double h, Backend backend);

  /// Energy of all bonds across an endless straight line that meets no node, each at its limit s0
  /// of G = 1, on a homogeneous lattice with λ = μ, per length: what a crack along it breaks.
  /// @param along  the line's direction in steps of the lattice, not (0, 0)
  double lattice_toughness(const NeighbourhoodQuadrature<2> &rule, const Kernel<2> &influence,
                           double h, Backend backend, std::array<int, 2> along = {1, 0});
} // namespace plumbline::meshfree
