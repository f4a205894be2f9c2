#pragma once

#include "meshfree/rules/quadrature_rule.h"
#include "method/fracture_solver.h"
#include "physics/state_based.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace plumbline::meshfree
{
  using dealii::Tensor;

  using method::BreakingSolid;

  /// A solid on the nodes of a lattice, cell centres, as bonds: its energy is
  ///   E = Σ_bonds k/2 (way·Δu)² + Σ_nodes τ/2 θ²,  θ = Σ_bonds share ξ·Δu,  Δu = u_to - u_from,
  /// with k = V w 2 (dim + 2) μK, share = w K, τ = V (λ - μ), K the influence function of ∫K|ξ|² =
  /// dim. On scattered nodes V w is the mean of V_i w_ij and V_j w_ji, way = ξ/|ξ|, share = V w K
  /// and τ = (λ - μ)/V_i, so that V_i times the dilatation is what is squared. That is the linear
  /// peridynamic solid whose bonds end at free surfaces and cracks, without the correction M of its
  /// dilatation and without the terms that free surfaces of traction add, which make it
  /// unsymmetric, see SurfaceForces. λ = μ, ν = 1/4 in plane strain or space, leaves the bonds
  /// alone. Where constants vary, k has the harmonic mean of both ends' μ and τ the node's own λ -
  /// μ, so that there is an energy still; with harmonic means of both, as statics has, there is
  /// none. Both have the same local limit.
  template <int dim>
  struct BondNetwork
  {
    struct Bond
    {
      unsigned int from = 0, to = 0;
      Tensor<1, dim> xi;    ///< from node to node [length]
      Tensor<1, dim> way;   ///< along which it pulls, of length 1
      double stiffness = 0; ///< k [force/length^2 in the plane, force/length in space]
      double share = 0;     ///< of dilatations [1/length^2], on scattered nodes [1]
      double critical = 0;  ///< the stretch at which it breaks; infinite: never

      Bond reversed() const { return {to, from, -xi, -way, stiffness, share, critical}; }
    };

    double h = 0, horizon = 0; ///< of the lattice, or √(V) in the mean of scattered nodes [length]
    std::vector<Point<dim>> nodes;
    std::shared_ptr<const geometry::NodeCells<dim>> cells; ///< of scattered nodes; null: a lattice
    /// Of scattered nodes, as lattice_toughness: the mean over all directions of a cut, of the
    /// bonds of a node over the area of its cell, and of all nodes the median: beside surfaces
    /// nodes lack bonds.
    double cut_energy = 0;
    std::vector<int> grip;                   ///< of each node, -1: free
    std::vector<Tensor<1, dim>> constrained; ///< u of each node at load 1, 0 where it is free
    /// Dead load at load 1, shape (n_nodes), 0 at grips; empty: none [force].
    std::vector<Tensor<1, dim>> loads = {};
    std::vector<Bond> bonds;                      ///< that are whole at the beginning, each once
    std::vector<double> toughness;                ///< G of each of them [force/length]
    std::vector<std::array<unsigned int, 2>> cut; ///< nodes of bonds that the notch has cut
    std::vector<double> dilatation;               ///< τ of each node; empty where λ = μ

    /// Of a solid in the plane whose dilatations are corrected at surfaces.
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

    /// A bond to a fictitious node beyond a free surface, whose u is a combination of those of
    /// nodes. It has no dilatation. Not for bodies whose bonds break.
    struct Extrapolated
    {
      unsigned int from = 0;
      Tensor<1, dim> way;                              ///< along which it pulls, of length 1
      double stiffness = 0;                            ///< as of bonds
      std::vector<std::pair<unsigned int, double>> to; ///< nodes and their factors
    };
    std::vector<Extrapolated> extrapolated = {};

    /// The part of each node's bonds that is broken or cut, shape (n_nodes).
    std::vector<double> damage(const std::vector<std::size_t> &broken) const;
  };

  /// Critical stretches by G, see physics::crossing_energy. On the lattice itself the bonds across
  /// a straight cut hold less: .9158 G for 1/r and m = 3 in the plane, see lattice_toughness. Bonds
  /// between two materials have harmonic means of λ and μ, and G as BreakingSolid says.
  /// Instantiated for dim = 2 and 3.
  /// @param rule       with the deviatoric kernel of μ = 1
  /// @param influence  ∫K|ξ|² = dim
  /// @throws InputError  h that does not fit the boxes; grips that hold no node, or one grip alone;
  /// G <= 0 at a bond; a notch or an interface through a node, or that crosses no bond; surface
  /// terms in space or on scattered nodes; there, a rule that adjusts weights
  template <int dim>
  BondNetwork<dim> make_bond_network(const BreakingSolid<dim> &solid,
                                     const NeighbourhoodQuadrature<dim> &rule,
                                     const Kernel<dim> &influence, double h, Backend backend);

  /// Energy of all bonds across an infinite straight line, or a plane in space, that meets no node,
  /// each at its limit s0 of G = 1, on a homogeneous lattice with λ = μ, per length or area: what a
  /// crack along it breaks. Instantiated for dim = 2 and 3.
  /// @param normal  of the line or plane in steps of the lattice, not 0
  template <int dim>
  double lattice_toughness(const NeighbourhoodQuadrature<dim> &rule, const Kernel<dim> &influence,
                           double h, Backend backend, std::array<int, dim> normal = {0, 1});
} // namespace plumbline::meshfree
