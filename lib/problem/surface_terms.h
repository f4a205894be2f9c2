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
    energy       ///< as none, with the correction in the forces, too: they derive from an energy
  };
} // namespace plumbline::problem

namespace plumbline::base
{
  template <>
  inline constexpr auto words<problem::SurfaceTerms> =
      std::array{"automatic", "published", "none", "consistent", "uncorrected", "energy"};
} // namespace plumbline::base
