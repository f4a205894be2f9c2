// What moving costs beyond its forces, what two threads gain, and what memory it takes: bonds with
// two wells. Run: build/release/benchmarks/motion [STEPS]

#include "analysis/integrate.h"
#include "base/cost.h"
#include "meshfree/lattice/crack_strip.h"
#include "meshfree/rules/rules.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

using namespace plumbline;

namespace
{
  using Vector = std::vector<double>;
  using Force = meshfree::DoubleWellForce<2>;

  std::vector<meshfree::WellBond> bonds(int n, int m)
  {
    const physics::DoubleWell law(2, {{1, 0}, {-1, 1}}, 1, 1, static_cast<double>(m) / n);
    const auto kernel = law.linear_kernel();
    return well_bonds(
        law, lattice_bonds(meshfree::full_area(kernel), kernel, 1. / n, geometry::Backend::fast));
  }

  Force torus(int n, int m)
  {
    return {bonds(n, m), 1. / n, {n, n}, meshfree::Exterior::periodic};
  }

  analysis::State start(std::size_t size)
  {
    analysis::State state{Vector(size), Vector(size), 0};
    for (std::size_t i = 0; i < size; ++i)
      state.u[i] = 1e-2 * std::sin(static_cast<double>(i));
    return state;
  }

  /// @return CPU seconds of so many steps of velocity Verlet, and of the forces in them
  std::pair<double, double> cost_of_steps(const Force &force, int n_steps, double step)
  {
    base::CpuTimer all;
    double forces = 0;
    analysis::State state = start(force.size());
    all.restart();
    analysis::integrate({force.size(),
                         [&](const Vector &u, double, Vector &a)
                         {
                           const base::CpuTimer timer;
                           force.force(u, a);
                           forces += timer.seconds();
                         }},
                        analysis::scheme("velocity Verlet"), {step}, n_steps * step, state);
    return {all.seconds(), forces};
  }

  double wall_seconds(const Force &force, Vector &u, int n_times)
  {
    Vector f(force.size());
    force.force(u, f);
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < n_times; ++i)
      force.force(u, f);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    u = f;
    return time.count() / n_times;
  }

  void report_memory(int n, int m)
  {
    const base::MemoryGauge gauge;
    const auto own = std::make_unique<meshfree::CrackStrip>(
        bonds(n, m), meshfree::CrackStrip::Shape{{n, n}, n / 4, 1. / n});
    analysis::State state{Vector(own->size()), Vector(own->size()), 0};
    analysis::integrate(
        {own->size(), [&](const Vector &u, double, Vector &a) { own->force(u, a); }},
        analysis::scheme("velocity Verlet"), {.1 / n}, .3 / n, state);
    const double view = own->view(state.u).tip;
    std::printf("a strip of %d x %d nodes: %.0f bytes a node at most (tip at %.3f)\n", own->n()[0],
                own->n()[1],
                static_cast<double>(gauge.peak_bytes()) / static_cast<double>(own->n_nodes()),
                view);
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const int n_steps = argc > 1 ? std::atoi(argv[1]) : 1000;
  constexpr int n = 512, m = 3;
  const Force force = torus(n, m);
  const double step = .5 * m / n;
  const auto [all, forces] = cost_of_steps(force, n_steps, step);
  std::printf(
      "%d steps of %d x %d nodes, m = %d: %.2f CPU s, %.2f of them forces (%.2fe9 bonds/s): "
      "%.3f times as much\n",
      n_steps, n, n, m, all, forces,
      1e-9 * static_cast<double>(force.n_bonds()) * (n_steps + 1) / forces, all / forces);
  const Force wider = torus(n, 4);
  Vector one = start(wider.size()).u, two = one;
  const double serial = wall_seconds(wider, one, 40);
  dealii::MultithreadInfo::set_thread_limit(2);
  const double parallel = wall_seconds(wider, two, 40);
  std::printf(
      "forces with m = 4: %.2f ms on one thread, %.2f ms on two, %.2f times as fast, %s bits\n",
      1e3 * serial, 1e3 * parallel, serial / parallel, one == two ? "same" : "OTHER");
  dealii::MultithreadInfo::set_thread_limit(1);
  for (const int size : {512, 1024, 2048})
    report_memory(size, m);
  return one == two ? 0 : 1;
}
