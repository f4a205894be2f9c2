// Linear peridynamic solids in space as nu -> 1/2, m = 3: conjugate gradients with sine transforms
// of each component beside multipliers on the constrained nodes. CPU time on one core.
// Run: build/release/benchmarks/nearly_incompressible [LARGEST_N [MOST_ITERATIONS]]

#include "algebra/multiplier_system.h"
#include "base/cost.h"
#include "base/error.h"
#include "meshfree/lattice/stencil.h"
#include "meshfree/rules/rules.h"
#include "physics/state_based.h"
#include "reference/lattice/solid_stencil.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

using namespace plumbline;

namespace
{
  constexpr double m = 3;

  physics::Dilatation<3> solid(double nu, double h)
  {
    return {physics::influence_function<3>({{1, -1}}, m * h),
            [nu](const auto &)
            { return physics::lame_from_young(1, nu, physics::PlaneState::strain); },
            false, true};
  }

  algebra::Stencil stencil(const std::string &method, double nu, int n)
  {
    const double h = 1. / (method == "Q1" ? n + 1 : n);
    const auto dilatation = solid(nu, h);
    const auto bonds = physics::deviatoric_kernel(dilatation.influence, dilatation.material({}).mu);
    if (method == "Q1")
      return reference::galerkin_stencil(bonds, h, reference::AxisShapes(true, 1), dilatation);
    return meshfree::state_based_stencil(
        dilatation, meshfree::lattice_bonds(method == "FA" ? meshfree::full_area(bonds)
                                                           : meshfree::recalibrated(bonds, 2),
                                            bonds, h, geometry::Backend::fast));
  }

  /// A smooth displacement's values, with some short waves: what the solver is to find.
  algebra::Vector displacement(int n)
  {
    algebra::Vector u(3 * static_cast<std::size_t>(n) * n * n);
    std::size_t place = 0;
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i, ++place)
          {
            const double x = (i + .5) / n, y = (j + .5) / n, z = (k + .5) / n;
            u[place] = std::array{x * x * x * y * y + z * z * z * z, y * y * z * z * z + x * z,
                                  x * x * y * z + y * y * y}[c] +
                       1e-3 * std::sin(static_cast<double>(place));
          }
    return u;
  }

  void row(const char *solver, const std::function<std::unique_ptr<algebra::LinearSystem>()> &make,
           const algebra::Vector &exact, const algebra::Vector &b, unsigned int most_iterations)
  {
    const base::MemoryGauge memory;
    base::CpuTimer timer;
    const auto system = make();
    const double setup = timer.seconds();
    algebra::Vector u(b.size()), residual(b.size());
    timer.restart();
    try
    {
      const auto solved = system->solve(u, b, {1e-12, most_iterations});
      const double seconds = timer.seconds();
      system->vmult(residual, u);
      residual -= b;
      u -= exact;
      std::printf("   %-11s %4u iterations, setup %6.2f s, solve %7.2f s, %4.0f B per unknown, "
                  "residual %.1e, error %.1e\n",
                  solver, solved.n_iterations, setup, seconds,
                  static_cast<double>(memory.peak_bytes()) / static_cast<double>(b.size()),
                  residual.l2_norm() / b.l2_norm(), u.linfty_norm());
    }
    catch (const NumericalError &error)
    {
      std::printf("   %-11s after %.2f s: %s\n", solver, timer.seconds(), error.what());
    }
    std::fflush(stdout);
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const int largest = argc > 1 ? std::atoi(argv[1]) : 64;
  const unsigned int most_iterations = argc > 2 ? std::atoi(argv[2]) : 500;
  for (const std::string method : {"FA", "IPA-AC-R2", "Q1"})
    for (const double nu : {.2, .45, .495, .4999, .49999, .499999})
      for (int n = std::min(16, largest); n <= largest; n *= 2)
      {
        const algebra::Stencil matrix = stencil(method, nu, n);
        const geometry::BoxNodes nodes{{n, n, n}};
        const algebra::Vector exact = displacement(n);
        algebra::Vector b(exact.size());
        make_operator(matrix, nodes)->vmult(b, exact);
        std::printf("%s, nu = %g, n = %d: (lambda + 2 mu) / mu = %.3g\n", method.c_str(), nu, n,
                    algebra::coupling(matrix));
        if (nu < .4999) // beyond it they take more than 1000 iterations
          row(
              "sines",
              [&]
              {
                return std::make_unique<algebra::StencilSystem>(
                    matrix, nodes, algebra::OperatorBackend::automatic);
              },
              exact, b, most_iterations);
        row(
            "multipliers",
            [&]
            {
              return std::make_unique<algebra::MultiplierSystem>(
                  matrix, nodes.n, algebra::OperatorBackend::automatic);
            },
            exact, b, most_iterations);
      }
}
