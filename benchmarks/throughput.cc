// How fast are the parts: operator applications per bond by every backend, forces, ball ∩ cell,
// rules, entries, and how far each is from what one core of this machine can do. Run:
// build/release/benchmarks/throughput [--benchmark_filter=...] All figures are CPU time on one
// core; compare them within one run.

#include "parts.h"
#include "summary.h"

#include <deal.II/base/mpi.h>

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  namespace ours = plumbline::benchmarks;
  ours::register_operators();
  ours::register_families();
  ours::register_forces();
  ours::register_assembly();
  ours::register_tetrahedra();
  benchmark::Initialize(&argc, argv);
  ours::Summary summary;
  benchmark::RunSpecifiedBenchmarks(&summary);
  benchmark::Shutdown();
}
