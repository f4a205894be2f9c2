#include "reference/lattice/mass.h"

namespace plumbline::reference
{
  namespace
  {
    unsigned int power(unsigned int n, int exponent)
    {
      return exponent == 0 ? 1 : n * power(n, exponent - 1);
    }

    /// ∫ φ_s φ_t of families s, t with t's cell k cells from that of s.
    template <int dim>
    double entry(const Correlations &r, unsigned int n_axis, double h, unsigned int s,
                 unsigned int t, const std::array<int, 3> &k)
    {
      double result = 1;
      for (int d = 0; d < dim; ++d)
        result *= h;
      for (int d = 0; d < dim; ++d, s /= n_axis, t /= n_axis)
        result *= r(s % n_axis, t % n_axis, -k[d]);
      return result;
    }
  } // namespace

  template <int dim>
  algebra::Stencil mass_stencil(const AxisShapes &shapes, unsigned int n_components, double h)
  {
    const Correlations r(shapes);
    const auto n_axis = static_cast<unsigned int>(shapes.families().size());
    const unsigned int n_families = power(n_axis, dim);
    const int reach = shapes.is_continuous() ? 1 : 0, third = dim == 3 ? reach : 0;
    algebra::Stencil mass(n_components * n_families, {reach, reach, third});
    for (unsigned int c = 0; c < n_components; ++c)
      for (unsigned int s = 0; s < n_families; ++s)
        for (unsigned int t = 0; t < n_families; ++t)
          mass.for_each_offset(
              [&](int k1, int k2, int k3)
              {
                mass(c * n_families + s, c * n_families + t, k1, k2, k3) =
                    entry<dim>(r, n_axis, h, s, t, {k1, k2, k3});
              });
    return mass;
  }

  template algebra::Stencil mass_stencil<2>(const AxisShapes &, unsigned int, double);
  template algebra::Stencil mass_stencil<3>(const AxisShapes &, unsigned int, double);
} // namespace plumbline::reference
