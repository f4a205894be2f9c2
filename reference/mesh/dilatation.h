#pragma once

#include "algebra/csr_matrix.h"
#include "reference/mesh/dilatation_row.h"

namespace plumbline::reference
{
  struct DilatationOptions
  {
    unsigned int refinement = 0; ///< of the outer rule: every cell in 4^refinement parts
    /// Whether θ is multiplied by 2 / ∫K|ξ|² over the part of the ball that the mesh covers: bodies
    /// whose families end at a free boundary. Bonds then want the coefficient μ(x) 2 / ∫K|ξ|²
    /// (`WeightedVolume`), arithmetic mean.
    bool is_normalised = false;
    geometry::Backend backend = geometry::Backend::fast;
    Correction correction = Correction::none;
    std::vector<geometry::Cut> cracks = {}; ///< see `DilatationRow`
    std::vector<geometry::Box> gaps = {};   ///< regions beyond free surfaces, without cells
  };

  /// What the dilatation adds to the Galerkin matrix of a state-based solid's bonds,
  ///   D(u, v) = ∫ θ_u(x) E_v(x) dx,
  ///   θ_u(x) = ∫ K ξ·(u(x+ξ) - u(x)) dξ,  E_v(x) = ∫ f(x, x+ξ) K ξ·(v(x+ξ) - v(x)) dξ,
  /// over Ω and its collar within δ of it. Outer points on all cells there, at each of them a row
  /// of θ and of E (`DilatationRow`). Threads share the cells (results do not depend on their
  /// number), ranks of the communicator too. Memory: the matrix, whose rows reach 2δ, and 4 bytes
  /// for each dof in the reach of each cell. Accuracy, relative (δ = 3 h, K = c/|ξ|, continuous):
  /// degree 1 on squares 1e-3, 4e-5, 3e-6, 2e-7 for refinements 0 to 3, degree 2 and triangles half
  /// of that or less; degree 0 loses a factor 8 a refinement, 3e-3 at first. Cost: .15 ms for each
  /// outer point on squares of degree 1, four of them a cell at first; once for all cells whose
  /// surroundings are translations of each other, whatever their materials, if these are constant
  /// in each cell. What is left then is to add to the matrix. Within δ of cracks and gaps this
  /// holds for no two cells, and the integrand of the outer rule has kinks where the end of a crack
  /// limits what is visible.
  /// @param space  its mesh has a collar 2δ wide, or ends at a free boundary
  /// @return  rows of the free unknowns, columns of all, as MeshMatrix::rows
  /// Sources: Fan et al. 2022, eqs. (2.5), (3.21); with normalised θ and degree 0 on squares Pflug,
  /// Stingl & Zetzmann 2026, eqs. (13)-(15).
  algebra::CsrMatrix assemble_dilatation(const MeshSpace &space, const MeshCells &cells,
                                         const physics::Dilatation<2> &dilatation,
                                         const DilatationOptions &options,
                                         const base::Communicator &communicator);
} // namespace plumbline::reference
