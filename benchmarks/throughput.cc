// How fast are the parts: operator applications per bond on every road, ball ∩ cell, rules,
// entries. Run: build/release/benchmarks/throughput [--benchmark_filter=...] All figures are CPU
// time on one core; compare them within one run.

#include "algebra/operator.h"
#include "geometry/ball_cell.h"
#include "meshfree/lattice_operator.h"
#include "meshfree/rules.h"
#include "reference/lattice_stencil.h"

#include <deal.II/base/mpi.h>

#include <benchmark/benchmark.h>

#include <map>
#include <random>
#include <vector>

using namespace plumbline;

namespace
{
  physics::Kernel<2> make_kernel(bool is_tensor, double horizon)
  {
    const auto profile = physics::kernel_type(is_tensor ? "bond-tensor" : "linear-decay").profile;
    return is_tensor ? physics::Kernel<2>::with_bulk_modulus(profile, horizon, 1)
                     : physics::Kernel<2>::with_diffusion(profile, horizon, .5);
  }

  /// y = L_h x for IPA-AC on n × n nodes; arguments: m, n.
  void apply(benchmark::State &state, bool is_tensor, algebra::Road road)
  {
    const auto m = static_cast<double>(state.range(0));
    const auto n = static_cast<double>(state.range(1));
    const auto kernel = make_kernel(is_tensor, m / n);
    const auto stencil = meshfree::lattice_operator(
        kernel, meshfree::lattice_bonds(meshfree::improved_partial_area(kernel), kernel, 1 / n,
                                        geometry::Backend::fast));
    const geometry::Lattice lattice({{{{0, 0}, {1, 1}}}, {}}, 1 / n);
    const auto nodes = free_nodes(lattice, {{.5, false, 0}}, kernel.n_components());
    const auto matrix = make_operator(stencil, nodes, road);
    algebra::Vector x(nodes.size()), y(nodes.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = std::sin(static_cast<double>(i));
    for (auto _ : state)
    {
      matrix->vmult(y, x);
      benchmark::DoNotOptimize(y[0]);
    }
    // a bond is a pair of nodes, whatever the number of components
    const double bonds =
        static_cast<double>(matrix->n_bonds()) / (kernel.n_components() * kernel.n_components());
    state.counters["bonds/s"] =
        benchmark::Counter(bonds, benchmark::Counter::kIsIterationInvariantRate);
  }

  void intersect(benchmark::State &state, geometry::Backend backend)
  {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> angle(0, 2 * M_PI);
    const auto ratio = static_cast<double>(state.range(0));
    std::vector<std::array<geometry::Point<2>, 4>> cells;
    for (int i = 0; i < 512; ++i)
    {
      const double a = angle(random);
      cells.push_back(geometry::square(
          geometry::Point<2>(ratio * std::cos(a) - .5, ratio * std::sin(a) - .5), 1));
    }
    const geometry::Ball ball{geometry::Point<2>(), ratio};
    std::size_t i = 0;
    for (auto _ : state)
      benchmark::DoNotOptimize(
          geometry::intersect(ball, geometry::view(cells[i++ % cells.size()]), backend).area);
  }

  void polar_rule(benchmark::State &state)
  {
    const auto cell = geometry::square(geometry::Point<2>(2, 1), 1);
    for (auto _ : state)
      benchmark::DoNotOptimize(
          geometry::polar_rule({geometry::Point<2>(), 3}, geometry::view(cell)).weights.size());
  }

  void rule(benchmark::State &state, const meshfree::Rule &rule)
  {
    const auto kernel = make_kernel(false, static_cast<double>(state.range(0)));
    for (auto _ : state)
      benchmark::DoNotOptimize(
          meshfree::lattice_bonds(rule.recipe(kernel), kernel, 1, geometry::Backend::fast)
              .family.size());
  }

  void galerkin_entries(benchmark::State &state, bool is_continuous, unsigned int degree)
  {
    const auto kernel = make_kernel(false, static_cast<double>(state.range(0)));
    const reference::AxisShapes shapes(is_continuous, degree);
    for (auto _ : state)
      benchmark::DoNotOptimize(
          reference::galerkin_stencil(kernel, 1, shapes, geometry::Backend::fast).reach());
  }

  void register_all()
  {
    using algebra::Road;
    const std::vector<std::pair<std::string, Road>> roads = {
        {"direct", Road::direct}, {"fft", Road::fft}, {"sparse", Road::sparse}};
    for (const bool is_tensor : {false, true})
      for (const auto &[name, road] : roads)
      {
        const std::string title =
            std::string("apply/") + (is_tensor ? "tensor/" : "scalar/") + name;
        auto *bench = benchmark::RegisterBenchmark(title.c_str(), [=](benchmark::State &s)
                                                   { apply(s, is_tensor, road); });
        bench->ArgNames({"m", "n"})->Unit(benchmark::kMillisecond);
        // sizes where the sparse matrix still fits
        for (const auto &[m, n] : {std::pair<int, int>{3, 256}, {8, 256}, {16, 256}, {32, 128}})
          if (!is_tensor || m <= 16)
            bench->Args({m, is_tensor && m == 16 ? 128 : n});
      }
    for (const int ratio : {1, 3, 32, 1000})
      benchmark::RegisterBenchmark("intersect/fast", intersect, geometry::Backend::fast)
          ->Arg(ratio);
    benchmark::RegisterBenchmark("intersect/cgal", intersect, geometry::Backend::cgal)->Arg(3);
    benchmark::RegisterBenchmark("polar rule", polar_rule);
    for (const meshfree::Rule &one : meshfree::rules())
      benchmark::RegisterBenchmark(("rule/" + one.name).c_str(), rule, one)
          ->ArgName("m")
          ->Arg(3)
          ->Arg(16)
          ->Unit(benchmark::kMicrosecond);
    for (unsigned int degree = 1; degree <= 3; ++degree)
      benchmark::RegisterBenchmark(("entries/Q" + std::to_string(degree)).c_str(), galerkin_entries,
                                   true, degree)
          ->ArgName("m")
          ->Arg(3)
          ->Arg(16)
          ->Arg(100)
          ->Unit(benchmark::kMillisecond);
  }
} // namespace

namespace
{
  /// The usual table, and after it how many times slower the sparse matrix is than the other roads.
  class RatioReporter : public benchmark::ConsoleReporter
  {
  public:
    void ReportRuns(const std::vector<Run> &runs) override
    {
      ConsoleReporter::ReportRuns(runs);
      for (const Run &run : runs)
        seconds_[run.benchmark_name()] = run.GetAdjustedCPUTime();
    }
    void Finalize() override
    {
      GetOutputStream() << "\nCPU time of the sparse matrix over that of the same operator by\n";
      for (const auto &[name, time] : seconds_)
        for (const std::string road : {"direct", "fft"})
          if (const auto at = name.find("/" + road + "/"); at != std::string::npos)
          {
            std::string sparse = name;
            sparse.replace(at + 1, road.size(), "sparse");
            if (seconds_.count(sparse) > 0)
              GetOutputStream() << "  " << name << ": " << seconds_.at(sparse) / time << '\n';
          }
    }

  private:
    std::map<std::string, double> seconds_;
  };
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  register_all();
  benchmark::Initialize(&argc, argv);
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
}
