#pragma once

#include "base/choice.h"
#include "meshfree/check/findings.h"

// What other codes keep of their bonds, made into the weights w of
//   L u_i = -Σ C(q) (u_j - u_i) w,  C(q) = c(|q|) for scalars, c(|q|) q⊗q/|q|² for solids.
namespace plumbline::meshfree
{
  enum class BondValues
  {
    weights,        ///< w [length^dim]
    stiffness,      ///< c(|q|) w: force density of node i per length of u_j - u_i
    force_constants ///< V_i c(|q|) w: force on node i per length of u_j - u_i
  };

  /// @throws InputError  another word, naming the key and the words that there are
  BondValues to_bond_values(const std::string &word, const std::string &key);

  /// Divide the values of all bonds by the kernel, and by the node's volume where they are forces.
  /// @pre they have been read as weights
  /// @throws InputError  a bond whose value is not 0 where the kernel is: it has no weight
  template <int dim>
  void to_weights(BondValues values, const Kernel<dim> &kernel, GivenWeights<dim> &given);
} // namespace plumbline::meshfree

namespace plumbline::base
{
  template <>
  inline constexpr auto words<meshfree::BondValues> =
      std::array{"weights", "stiffness", "force constants"};
} // namespace plumbline::base
