#pragma once

#include "base/choice.h"

namespace plumbline::problem
{
  /// The force that replaces that of missing bonds at surfaces of a linear peridynamic solid, so
  /// that they are free of traction.
  enum class SurfaceTerms
  {
    automatic,   ///< published in statics and transients, uncorrected in quasi-static fracture
    published,   ///< Fan et al. 2022, eqs. (3.19)-(3.22); they exert a net force at crack tips
    none,        ///< corrected dilatation alone
    consistent,  ///< exact in uniaxial stress along straight faces, and without a net force there
    uncorrected, ///< neither terms nor corrected dilatation; forces that have an energy
    energy       ///< none, and forces that have the energy of bonds and corrected dilatations: its
                 ///< adjoint
  };
} // namespace plumbline::problem

namespace plumbline::base
{
  template <>
  inline constexpr auto words<problem::SurfaceTerms> =
      std::array{"automatic", "published", "none", "consistent", "uncorrected", "energy"};
} // namespace plumbline::base
