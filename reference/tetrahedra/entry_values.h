#pragma once

#include <deal.II/base/tensor.h>

#include <array>

// The entry of two unknowns on tetrahedra: a double for scalar kernels, and for bond tensors the
// tensor of all components c and d.
namespace plumbline::reference
{
  using SolidValue = dealii::Tensor<2, 3>;

  template <class Value>
  inline constexpr unsigned int n_components_of = 1;
  template <>
  inline constexpr unsigned int n_components_of<SolidValue> = 3;

  inline double transposed(double value)
  {
    return value;
  }
  inline SolidValue transposed(const SolidValue &value)
  {
    return transpose(value);
  }

  inline double component(double value, unsigned int, unsigned int)
  {
    return value;
  }
  inline double component(const SolidValue &value, unsigned int c, unsigned int d)
  {
    return value[c][d];
  }

  /// Make a value symmetric in the components, as exact entries are.
  inline void symmetrise(double &) {}
  inline void symmetrise(SolidValue &value)
  {
    constexpr double half = .5;
    value = half * (value + transpose(value));
  }

  /// sum += parts[0] i·j for a scalar kernel, parts[0] i·j I + parts[1] i⊗j for a bond tensor.
  /// @param parts  an integral of each part of a kernel, see SolidKernel
  /// @param i, j   gradients, or normals multiplied by jumps
  inline void add_product(double &sum, const std::array<double, 2> &parts,
                          const dealii::Tensor<1, 3> &i, const dealii::Tensor<1, 3> &j)
  {
    sum += parts[0] * (i * j);
  }
  inline void add_product(SolidValue &sum, const std::array<double, 2> &parts,
                          const dealii::Tensor<1, 3> &i, const dealii::Tensor<1, 3> &j)
  {
    const double isotropic = parts[0] * (i * j);
    for (unsigned int c = 0; c < 3; ++c)
    {
      sum[c][c] += isotropic;
      for (unsigned int d = 0; d < 3; ++d)
        sum[c][d] += parts[1] * (i[c] * j[d]);
    }
  }
} // namespace plumbline::reference
