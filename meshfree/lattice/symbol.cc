#include "meshfree/lattice/stencil.h"
#include "meshfree/solutions.h"
#include "study/limit_proof.h"

namespace plumbline::meshfree
{
  study::SymbolData lattice_symbol(const Rule &rule, const scene::Scene &scene,
                                   const scene::Problem &problem)
  {
    const double h = problem.lattice->h();
    const Bonds bonds =
        lattice_bonds(rule.recipe(problem.kernel), problem.kernel, h, scene.backend);
    const algebra::Stencil stencil = problem.dilatation
                                         ? state_based_stencil(*problem.dilatation, bonds)
                                         : lattice_operator(problem.kernel, bonds);
    algebra::Stencil mass(stencil.n_blocks(), 0);
    for (unsigned int s = 0; s < mass.n_blocks(); ++s)
      mass(s, s, 0, 0) = 1;
    // where its own cell a node sits in changes no wave
    return {{h, stencil, mass, problem.n_components, {{.5, .5}}},
            study::prove_by_moments(scene, problem, stencil, 1)};
  }
} // namespace plumbline::meshfree
