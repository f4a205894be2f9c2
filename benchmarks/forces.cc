// Forces of bonds with two wells.

#include "meshfree/lattice/double_well_force.h"
#include "meshfree/rules/rules.h"
#include "parts.h"
#include "summary.h"

#include <cmath>

namespace plumbline::benchmarks
{
  namespace
  {
    enum class What
    {
      force,
      energy,
      tangent
    };

    /// F(u) of FA on n × n nodes of a torus; arguments: m, n.
    /// What a bond asks for: a neighbour's two components, two differences, q by 3 operations and
    /// its square, 2^y by 4 and a polynomial of degree 11 (22), 3 for q times that, 4 to add it up.
    void forces(benchmark::State &state, What what, const physics::WellPotential &shape)
    {
      const auto m = static_cast<double>(state.range(0));
      const auto n = static_cast<int>(state.range(1));
      const physics::DoubleWell law(2, {{1, 0}, {-1, 1}}, 1, 1, m / n);
      const auto kernel = law.linear_kernel();
      const auto bonds =
          meshfree::well_bonds(law, meshfree::lattice_bonds(meshfree::full_area(kernel), kernel,
                                                            1. / n, geometry::Backend::fast));
      const meshfree::DoubleWellForce<2> force(bonds, 1. / n, {n, n}, meshfree::Exterior::periodic,
                                               {}, {}, shape);
      std::vector<double> u(force.size()), f(force.size());
      for (std::size_t i = 0; i < u.size(); ++i)
        u[i] = .1 * std::sin(static_cast<double>(i));
      double sum = 0;
      for (auto _ : state)
      {
        if (what == What::force)
          force.force(u, f);
        else if (what == What::tangent)
          force.tangent(u, u, f);
        else
          sum += force.energy(u);
        benchmark::DoNotOptimize(f[0]);
        benchmark::DoNotOptimize(sum);
      }
      const auto n_bonds = static_cast<double>(force.n_bonds());
      const double vectors = 8 * static_cast<double>(u.size());
      count(state, "bonds", n_bonds, {39 * n_bonds, 16 * n_bonds, 2 * vectors, 3 * vectors});
    }
  } // namespace

  void register_forces()
  {
    for (const auto &[name, what] : {std::pair{"double well/force", What::force},
                                     std::pair{"double well/tangent", What::tangent},
                                     std::pair{"double well/energy", What::energy}})
    {
      auto *bench = benchmark::RegisterBenchmark(name, [what = what](benchmark::State &state)
                                                 { forces(state, what, {}); });
      bench->ArgNames({"m", "n"})->Unit(benchmark::kMillisecond)->Args({4, 512});
      if (what == What::force)
        bench->Args({3, 512});
    }
    benchmark::RegisterBenchmark("double well/force by an expression",
                                 [](benchmark::State &state) {
                                   forces(state, What::force, {"Material/potential", "r/(1 + r)"});
                                 })
        ->ArgNames({"m", "n"})
        ->Unit(benchmark::kMillisecond)
        ->Args({4, 512});
  }
} // namespace plumbline::benchmarks
