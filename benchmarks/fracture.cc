// What an event of a growing crack costs at 11.4 thousand unknowns: a stale factorisation with
// Woodbury's formula against a factorisation at every event and against multigrid, all on the same
// events.
//   build/release/benchmarks/fracture [COLUMNS ROWS]

#include "analysis/fracture.h"
#include "base/cost.h"
#include "meshfree/fracture/breaking_network.h"
#include "meshfree/rules/rules.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace
{
  using namespace plumbline;
  using dealii::Point;
  using dealii::Tensor;

  constexpr double h = 1;
  constexpr int m = 3;

  meshfree::BondNetwork<2> plate(int n1, int n2)
  {
    const double length = n1 * h, half = .5 * n2 * h;
    meshfree::BreakingSolid<2> solid;
    solid.domain.include = {{{0, -half}, {length, half}}};
    solid.grips = {{{0, half - m * h}, {length, half}}, {{0, -half}, {length, m * h - half}}};
    solid.notch = {{{-h, 0}, {std::floor(.25 * n1) * h, 0}}};
    solid.constrained = [](const Point<2> &x)
    {
      Tensor<1, 2> u;
      u[1] = x[1] > 0 ? .5 : -.5;
      return u;
    };
    solid.material = [](const Point<2> &) { return physics::Lame{1, 1}; };
    solid.toughness = [](const Point<2> &) { return 1.; };
    const auto K = physics::influence_function<2>(physics::kernel_type("1/r").profile, m * h);
    return make_bond_network(solid, meshfree::optimisation_based(physics::deviatoric_kernel(K, 1)),
                             K, h, geometry::Backend::fast);
  }

  double milliseconds(double seconds, std::size_t n)
  {
    return 1e3 * seconds / static_cast<double>(n);
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const int n1 = argc > 2 ? std::atoi(argv[1]) : 106, n2 = argc > 2 ? std::atoi(argv[2]) : 60;
  meshfree::BreakingNetwork<2> body(plate(n1, n2), problem::Stretch::linear);
  const base::CpuTimer timer;
  const analysis::Growth growth = analysis::grow(body, {});
  const double all = timer.seconds();
  const auto &work = body.work();
  double residual = 0, imbalance = 0;
  for (const analysis::Event &event : growth.events)
  {
    residual = std::max(residual, event.residual);
    imbalance = std::max(imbalance, event.imbalance());
  }
  std::printf("%zu unknowns, %zu bonds, %zu events\n", body.n_unknowns(), body.n_bonds(),
              growth.events.size());
  std::printf("stale factor: %.1f ms an event; %lu factorisations of %.0f ms, updates of %.1f ms, "
              "up to rank %lu\n",
              milliseconds(all, growth.events.size()), work.n_factorisations,
              milliseconds(work.factor_seconds, work.n_factorisations),
              milliseconds(work.update_seconds, work.n_updates), work.largest_rank);
  std::printf("residual <= %.1e, energy imbalance <= %.1e\n", residual, imbalance);

  const auto replay = [&](meshfree::BreakingNetwork<2> &again, std::size_t n)
  {
    const base::CpuTimer replaying;
    for (std::size_t i = 0; i < n; ++i)
      (void)again.break_bonds(growth.events[i].bonds);
    return replaying.seconds() / static_cast<double>(n);
  };
  meshfree::BreakingNetwork<2> always(plate(n1, n2), problem::Stretch::linear,
                                      problem::GrowthSolver::factor, meshfree::Refactor::always);
  const double each = replay(always, std::min<std::size_t>(20, growth.events.size())),
               mean = all / static_cast<double>(growth.events.size());
  std::printf("factored at every event: %.0f ms an event, %.1f times as much\n", 1e3 * each,
              each / mean);
  meshfree::BreakingNetwork<2> iterated(plate(n1, n2), problem::Stretch::linear,
                                        problem::GrowthSolver::multigrid);
  const double iterating = replay(iterated, std::min<std::size_t>(300, growth.events.size()));
  const auto &cycles = iterated.work();
  std::printf("multigrid: %.1f ms an event, %.1f times as much; %lu set-ups of %.0f ms, %.1f "
              "iterations an event, at most %lu\n",
              1e3 * iterating, iterating / mean, cycles.n_factorisations,
              milliseconds(cycles.factor_seconds, cycles.n_factorisations),
              static_cast<double>(cycles.n_iterations) /
                  static_cast<double>(cycles.n_factorisations + cycles.n_updates),
              cycles.most_iterations);
  return 0;
}
