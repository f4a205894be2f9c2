#pragma once

#include "algebra/csr_matrix.h"
#include "physics/state_based.h"
#include "reference/tetrahedra/space.h"

#include <optional>

namespace plumbline::reference
{
  /// How integrals over pairs of faces are computed.
  struct FaceRule
  {
    static FaceRule exact() { return {}; } ///< see ExactPairs
    static FaceRule quadrature(unsigned int refinement)
    {
      FaceRule rule;
      rule.is_exact = false;
      rule.refinement = refinement;
      return rule;
    }

    bool is_exact = true;
    /// Largest round-off of a pair, relative to m₀ times a volume, which has the size of a diagonal
    /// entry. Thousands of pairs, whose round-off is random, add up to an entry.
    double tolerance = 1.5e-14;
    unsigned int refinement = 0; ///< of the quadrature
    /// Tolerance of the quadrature for jumps, per pair, in the unit of `tolerance`.
    double of_jumps = 1e-6;
    /// Pairs of faces with all vertices on a lattice of this spacing [length] that are translations
    /// of each other are integrated once; 0: they are not.
    double spacing = 0;
  };

  /// How they were computed, and with which errors.
  struct FaceRuleUse
  {
    /// Number of integrals over pairs of faces in double, in long double, with 124 and with 237
    /// bits; for bond tensors two for each pair.
    std::array<std::size_t, 4> n_pairs{};
    /// The largest bound of the round-off of one pair, as part of an entry, relative to the least
    /// diagonal entry.
    double error = 0;
    /// Pairs of faces whose quadrature for jumps did not reach its tolerance at the finest level.
    std::size_t n_open = 0;
    /// Bound of the sum of their last changes by refinement in the entries of one face, relative to
    /// the least diagonal entry. Infinite where an integral is not finite.
    double open = 0;
  };

  /// Rows ½∬C(x - y) (φ_i(x) - φ_i(y)) (φ_j(x) - φ_j(y)) of unknowns i = 0 ... n_rows - 1 by all
  /// unknowns j, in the units of the kernel, by the faces of cells: see FacePotential. Bond tensors
  /// have three rows and three columns for each unknown, one after another; f ∫θ_i θ_j of a
  /// homogeneous dilatation is added to them. Entries are exact to round-off, or up to the
  /// quadrature over pairs of faces; all else is exact, so that rows annihilate constants, and
  /// those of continuous functions linear fields, to round-off. Symmetric to the last bit. Linear
  /// functions that are not continuous: assemble_with_jumps().
  /// @pre  the supports of these unknowns are at least the reach of the kernel (with a dilatation
  /// two horizons) away from the outside of the mesh; FacePotential takes the kernel
  algebra::CsrMatrix
  assemble_by_faces(const TetrahedralSpace &space, const physics::Kernel<3> &kernel,
                    std::size_t n_rows, const FaceRule &rule, FaceRuleUse *use = nullptr,
                    const std::optional<physics::Dilatation<3>> &dilatation = {});

  /// The largest difference of two entries in rows that both have, relative to the largest entry
  /// there; NaN if an entry is.
  double difference(const algebra::CsrMatrix &a, const algebra::CsrMatrix &b);
} // namespace plumbline::reference
