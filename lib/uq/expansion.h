#pragma once

#include "uq/grid_field.h"

#include <optional>
#include <vector>

namespace plumbline::uq
{
  /// A random field by few random numbers: mean + Σ_k ξ_k √λ_k φ_k, the ξ_k uncorrelated, of mean 0
  /// and variance 1. The modes φ_k are orthonormal in L2 of the box; of all n-term expansions this
  /// has the least mean-square error. Source: Ghanem & Spanos 1991, sec. 2.3,
  /// doi:10.1007/978-1-4612-3094-6. (Fan et al. 2022, doi:10.1016/j.cma.2022.115340, eq. 5.5 prints
  /// ξ_k ~ N(0, λ_k²) for the amplitude of φ_k, which then depends on h: its variance is λ_k.)
  /// The unit of the field is called u.
  struct Expansion
  {
    Grid grid;
    std::vector<double> mean;       ///< at the nodes [u]
    std::vector<double> variance;   ///< of the whole field at the nodes [u²]
    std::vector<double> eigenvalue; ///< λ_k, descending, >= 0 [u² length²]
    std::vector<std::vector<double>>
        mode; ///< φ_k at the nodes, shape (n_modes, n[1], n[0]) [1/length]

    unsigned int n_modes() const { return static_cast<unsigned int>(eigenvalue.size()); }

    /// The variance integrated over the box: the sum of all eigenvalues, kept or not [u² length²].
    double total_variance() const;

    /// The share of it that the first n modes hold, in [0, 1]; 1 where there is none to hold.
    /// @throws InputError  n > n_modes()
    double variance_kept(unsigned int n) const;
    double variance_kept() const { return variance_kept(n_modes()); }

    /// The least number of modes that hold this share; none if n_modes() do not.
    std::optional<unsigned int> modes_for(double share) const;

    /// Of the first n modes at the nodes: Σ_k λ_k φ_k² [u²], shape (n[1], n[0]).
    std::vector<double> variance_of_modes(unsigned int n) const;

    /// The field for ξ; modes beyond its length are left out.
    /// @throws InputError  more numbers than modes
    GridField realise(const std::vector<double> &xi,
                      Interpolation between = Interpolation::linear) const;

    /// The ξ of n_modes() whose field is nearest to given values at the nodes; 0 for modes without
    /// variance.
    std::vector<double> coordinates(const std::vector<double> &values) const;
  };
} // namespace plumbline::uq
