#include "reference/lattice/mass.h"

namespace plumbline::reference
{
  algebra::Stencil mass_stencil(const AxisShapes &shapes, unsigned int n_components, double h)
  {
    const Correlations r(shapes);
    const auto n_axis = static_cast<unsigned int>(shapes.families().size());
    const unsigned int n_families = n_axis * n_axis;
    algebra::Stencil mass(n_components * n_families, shapes.is_continuous() ? 1 : 0);
    const int reach = mass.reach();
    for (unsigned int c = 0; c < n_components; ++c)
      for (unsigned int s = 0; s < n_families; ++s)
        for (unsigned int t = 0; t < n_families; ++t)
          for (int k2 = -reach; k2 <= reach; ++k2)
            for (int k1 = -reach; k1 <= reach; ++k1)
              mass(c * n_families + s, c * n_families + t, k1, k2) =
                  h * h * r(s % n_axis, t % n_axis, -k1) * r(s / n_axis, t / n_axis, -k2);
    return mass;
  }
} // namespace plumbline::reference
