#include "reference/lattice/symbol.h"

#include "reference/lattice/dilatation.h"
#include "reference/lattice/stencil.h"
#include "study/limit_proof.h"

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

  study::SymbolData lattice_symbol(const scene::Scene &scene, const scene::Problem &problem,
                                   const AxisShapes &shapes)
  {
    const double h = problem.lattice->h();
    algebra::Stencil stencil = galerkin_stencil(problem.kernel, h, shapes, scene.backend);
    if (problem.dilatation)
    {
      const physics::Lame lame = problem.dilatation->material({});
      stencil = add(stencil, dilatation_stencil(problem.dilatation->influence,
                                                lame.lambda - lame.mu, h, shapes));
    }
    std::vector<geometry::Point<2>> places;
    for (const geometry::AxisSpecies &along_y : shapes.families())
      for (const geometry::AxisSpecies &along_x : shapes.families())
        places.emplace_back(along_x.offset, along_y.offset);
    study::SymbolData result{
        {h, stencil, mass_stencil(shapes, problem.n_components, h), problem.n_components, places},
        {}};
    result.limit = shapes.degree() == 0 ? study::prove_by_moments(scene, problem, stencil, h * h)
                                        : study::prove_galerkin(scene, problem, {});
    return result;
  }
} // namespace plumbline::reference
