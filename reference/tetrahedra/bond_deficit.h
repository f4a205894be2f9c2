#pragma once

#include "geometry/search.h"
#include "reference/tetrahedra/bond_factors.h"
#include "reference/tetrahedra/entry_values.h"
#include "reference/tetrahedra/layer_flux.h"
#include "reference/tetrahedra/solid_kernel.h"

#include <array>
#include <optional>
#include <vector>

namespace dealii
{
  template <int dim>
  class Quadrature;
}

namespace plumbline::reference
{
  /// A face on whose two sides the factors of bonds differ. [reaches]
  struct Interface
  {
    PairFace face;
    dealii::Tensor<1, 3> normal;
    /// Of the mesh, on both sides; the normal points to the second. Nothing: the outside.
    std::array<std::optional<std::size_t>, 2> cells;
  };

  /// Entries [a][b] of the linear functions λ_a and λ_b of a cell's corners.
  template <class Value>
  using CornerMatrix = std::array<std::array<Value, 4>, 4>;

  /// matrix -= ∫ λ_a λ_b e over a cell, where e is the linear function with ∫ λ_a e = sums[a].
  template <class Value>
  void subtract_linear_part(double volume, const std::array<Value, 4> &sums,
                            CornerMatrix<Value> &matrix);

  /// The deficit ∫ a(x, y) γ dy - a_TT m₀ at the points x of a cell T: the integral of the kernel
  /// over the bonds of x with their factors a, less the integral with the factor a_TT for all
  /// bonds. It is the sum of the fluxes of layers on the interfaces, see LayerFlux. Lengths are in
  /// units of the kernel's reach.
  template <class Value>
  class BondDeficit
  {
  public:
    /// @param factors  must outlive it
    BondDeficit(std::vector<Interface> interfaces, const SolidKernel &kernel,
                const BondFactors &factors);

    struct Integrals
    {
      CornerMatrix<Value> values{};
      double open = 0; ///< the last change, if it is above the tolerance at the finest level
    };

    /// The integrals of λ_a λ_b times the deficit over a cell. Quadrature is refined until the last
    /// change is below a tolerance. Not counted is the change that a linear function causes: the
    /// caller knows that part, see subtract_linear_part(). Thread safe.
    Integrals integrals(std::size_t mesh_cell, const std::array<dealii::Point<3>, 4> &corners,
                        double tolerance) const;

  private:
    /// An interface, and its normal times the difference of factors on its sides.
    struct Layer
    {
      FaceSides face;
      dealii::Tensor<1, 3> weight;
    };
    std::vector<Layer> layers_about(std::size_t mesh_cell,
                                    const std::array<dealii::Point<3>, 4> &corners) const;
    CornerMatrix<Value> integrals(const std::vector<Layer> &layers,
                                  const std::array<dealii::Point<3>, 4> &corners,
                                  const dealii::Quadrature<3> &rule) const;
    Value at(const dealii::Point<3> &x, const std::vector<Layer> &layers) const;

    std::vector<Interface> interfaces_;
    geometry::BoxSearch<3> search_;
    const BondFactors &factors_;
    std::vector<LayerFlux> fluxes_; ///< of the kernel's parts
  };
} // namespace plumbline::reference
