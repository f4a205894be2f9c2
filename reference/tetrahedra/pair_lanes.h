#pragma once

#include "algebra/simd.h"

#include <cstddef>

namespace plumbline::reference
{
  /// Several pairs of faces, or planes, side by side, one in each lane of a vector register.
  constexpr unsigned int n_lanes = algebra::wide;
  using Lanes = double[n_lanes]; // NOLINT: what vector registers are loaded from

  /// Of one face F and several G, in general position: PairForm's factors of the integrals that
  /// pairs share.
  struct alignas(64) PairLanes
  {
    Lanes x[3][3], normal[3];         ///< of G: coordinates of vertices; of length 1
    Lanes base[3], base_of_first[3];  ///< points of G and F over which heights are measured
    Lanes is_own[3], is_own_first[3]; ///< 0 of shared vertices of G and F, else 1

    Lanes edges[3][3];         ///< of ∬_{e×e'} g, e of F
    Lanes first[3], second[3]; ///< of ∫_{v×G} g, ∫_{F×v'} g
    Lanes growth;              ///< of the sum's size, for the round-off of heights
    Lanes separation; ///< of projections on the line through both centres; < 0: they overlap
    Lanes is_parallel[3], is_parallel_first[3]; ///< 1: the edge to the other plane
  };

  /// F, in all lanes.
  struct FirstFace
  {
    double x[3][3], normal[3]; // NOLINT: see Lanes
  };

  /// @param rounding  of heights
  void find_factors(const FirstFace &first, double rounding, PairLanes &pairs);

  /// Polygons in planes, each seen from the foot of the origin there: see PlaneSide.
  struct alignas(64) PlaneLanes
  {
    Lanes x[4][3], normal[3]; ///< vertices of triangles, or of parallelograms w, a, b: see below
    Lanes distance, area, kappa[4], from[4], to[4];
    /// What an end leaves of sides, and its half axis in κ, and in r.
    Lanes low[4], high[4], axis[4], axis_in_space[4];
  };

  /// Sides of triangles x[0], x[1], x[2] about a normal.
  void measure_triangles(PlaneLanes &planes);
  /// Of {w + t b - s a}, x = w, a, b; and normals, and areas.
  void measure_parallelograms(PlaneLanes &planes);
  /// @param n  sides of each
  void clip(PlaneLanes &planes, unsigned int n, double end);

  /// Pieces of sides: of κ ∫ (H(r) - foot) / (κ² + τ²) dτ, τ = centre ± half, r² = κ² + τ² +
  /// height.
  struct alignas(64) PieceLanes
  {
    Lanes square, height, centre, half, foot, total; ///< κ²; the sum, without κ half
  };

  /// One of H's forms.
  struct PieceForm
  {
    enum class Kind
    {
      compact, ///< H = -(end - r)^power Σ c_j r^j / r², or of T_j(2 r - 1): see RadialPolynomial
      inside,  ///< H = r Σ c_j r^j, or of T_j
      outside  ///< H = (c_0 + c_1 r + c_2 r²) / r²
    };
    static constexpr std::size_t most_coefficients = 144; ///< few powers, or a series

    Kind kind = Kind::compact;
    bool is_series = false;
    double end = 0;
    int power = 0; ///< 5 or 7
    std::size_t n = 0;
    double c[most_coefficients] = {}; // NOLINT: see Lanes
  };

  /// @param points, weights  of a Gauss rule, n of each
  void sum_pieces(const PieceForm &form, const double *points, const double *weights,
                  unsigned int n, PieceLanes &pieces);
} // namespace plumbline::reference
