#pragma once

#include "base/choice.h"

namespace plumbline::base
{
  // What a scene may choose of the algebra, by words.

  /// How a stencil is applied.
  enum class OperatorBackend
  {
    automatic, ///< direct or fft, whichever is estimated to be faster
    fft,
    direct,
    sparse
  };

  enum class SparseSolver
  {
    automatic, ///< direct up to 1000 unknowns; above, amg if unknowns × n_components² outnumber the
               ///< entries of a row by more than 100, or n_first > 0, else jacobi
    direct, ///< MUMPS
    amg,    ///< iterations preconditioned by ML's algebraic multigrid
    jacobi  ///< iterations preconditioned by the diagonal
  };

  /// What amg and jacobi iterate with.
  enum class Iteration
  {
    automatic, ///< cg if is_symmetric, else gmres
    cg,        ///< conjugate gradients
    gmres,
    bicgstab ///< two products an iteration, and a few vectors where GMRES keeps a hundred
  };

  template <>
  inline constexpr auto words<OperatorBackend> = std::array{"automatic", "fft", "direct", "sparse"};
  template <>
  inline constexpr auto words<SparseSolver> = std::array{"automatic", "direct", "amg", "jacobi"};
  template <>
  inline constexpr auto words<Iteration> = std::array{"automatic", "cg", "gmres", "bicgstab"};
} // namespace plumbline::base
