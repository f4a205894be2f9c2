// State-based solids: a bar of half a million unknowns, operator applications per bond, linear
// peridynamic solids with θ kept and eliminated, and what the smallest model saves over the full
// one. Run: build/release/benchmarks/solids
// All figures are CPU time on one core; compare them within one run, and with what that core can do
// at most.

#include "analysis/statics.h"
#include "base/cost.h"
#include "geometry/vertex_cells.h"
#include "meshfree/body/operator.h"
#include "meshfree/method.h"
#include "meshfree/rules/families.h"
#include "meshfree/rules/rules.h"
#include "meshfree/scattered/state_based_operator.h"
#include "reference/method.h"
#include "scene/problem.h"
#include "summary.h"

#include <deal.II/base/mpi.h>

#include <cmath>

using namespace plumbline;

namespace
{
  /// The bar of Pflug, Stingl & Zetzmann 2026, eq. (18), by PA-AC.
  struct Bar
  {
    meshfree::VariationalBody body;
    meshfree::VariationalOperator matrix;

    Bar(double n, double horizon, algebra::OperatorBackend backend)
        : body(meshfree::body_on_vertices(
              geometry::Lattice({{{{0, 0}, {2, 1}}}, {}}, 1 / n),
              {{{0, 0}, {.1, 0}, {.1, 1}, {0, 1}}},
              {[](const auto &) { return 100.; }, [](const auto &) { return 800.; }})),
          matrix(body, influence(horizon),
                 meshfree::lattice_bonds(meshfree::partial_area(influence(horizon)),
                                         influence(horizon), 1 / n, geometry::Backend::fast),
                 backend)
    {
    }

    static physics::Kernel<2> influence(double horizon)
    {
      return physics::influence_function<2>({{1, -1}}, horizon);
    }
  };

  void bar_solve(benchmark::State &state)
  {
    const auto n = static_cast<double>(state.range(0));
    for (auto _ : state)
    {
      const base::MemoryGauge memory;
      const Bar bar(n, .05, algebra::OperatorBackend::automatic);
      const auto load = meshfree::nodal_load(
          bar.body, [](const auto &x) { return dealii::Point<2>(x[0] > 1.9 - 1e-9 ? 100 : 0, 0); });
      algebra::Vector u(load.size());
      const auto solved = solve(bar.matrix, u, load, 1e-10, 1000);
      state.counters["iterations"] = solved.n_iterations;
      state.counters["unknowns"] = static_cast<double>(u.size());
      state.counters["MB"] = static_cast<double>(memory.peak_bytes()) / 1e6;
    }
  }

  /// Both passes, dilatation and forces, of a homogeneous solid; a bond is one neighbour of one
  /// node. At least, of two opposite bonds: 2 differences of displacements and 4 operations for θ,
  /// then 2 sums, the difference of θ, and 6 operations for each component of the force; of a bond,
  /// 2 loads and then 3. u and the result are moved; θ, the constants of each node and the padded
  /// fields are touched as well.
  void apply_lattice(benchmark::State &state, algebra::OperatorBackend backend)
  {
    const auto m = static_cast<double>(state.range(0));
    constexpr double n = 200;
    const Bar bar(n, m / n, backend);
    algebra::Vector x(2 * bar.body.size()), y(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = std::sin(static_cast<double>(i));
    for (auto _ : state)
    {
      bar.matrix.vmult(y, x);
      benchmark::DoNotOptimize(y[0]);
    }
    const auto bonds = static_cast<double>(bar.matrix.n_bonds());
    const double vectors = 2 * 8 * static_cast<double>(x.size());
    if (backend == algebra::OperatorBackend::direct)
      benchmarks::count(state, "bonds", bonds,
                        {10.5 * bonds, (2 + 3) * 8 * bonds, vectors, 4 * vectors});
    else
      benchmarks::count(state, "bonds", bonds);
  }

  /// Rows of a heterogeneous solid at m = 3 by OPT, θ eliminated or kept: u, or (u, θ). At
  /// least: 2 operations, 12 bytes (value and column) and a neighbour for each value, and the
  /// vectors.
  void apply_rows(benchmark::State &state, bool is_kept)
  {
    constexpr double h = 1. / 80, horizon = 3 * h;
    const auto cells =
        geometry::vertex_squares(geometry::Lattice({{{{0, 0}, {1, 1}}}, {}}, h), 2 * horizon);
    const auto influence = physics::influence_function<2>({{1, -1}}, horizon);
    const auto kernel = physics::deviatoric_kernel(influence, 1);
    const meshfree::Families<2> families(meshfree::optimisation_based(kernel), kernel, cells,
                                         geometry::Backend::fast);
    const auto source = [&](std::size_t node, meshfree::Family<2> &family)
    { families.make(node, family); };
    const meshfree::StateBasedBody body{&cells,
                                        {influence,
                                         [](const auto &x) {
                                           return physics::Lame{3 + x[0], 1 + x[1]};
                                         },
                                         true, false}};
    const auto rows = (is_kept ? state_based_system(source, body)
                               : state_based_operator(source, body, {0, cells.n_free}))
                          .rows.free;
    std::vector<double> x(rows.n_rows(), 1.), y(rows.n_rows());
    for (auto _ : state)
    {
      for (std::size_t i = 0; i < rows.n_rows(); ++i)
      {
        double sum = 0;
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          sum += rows.value[k] * x[rows.column[k]];
        y[i] = sum;
      }
      benchmark::DoNotOptimize(y[0]);
    }
    meshfree::Family<2> family;
    families.make(0, family);
    const auto n_values = static_cast<double>(rows.value.size());
    const double bytes = 12 * n_values + 16 * static_cast<double>(rows.n_rows());
    benchmarks::count(state, "bonds", static_cast<double>(cells.n_free * family.bonds.size()),
                      {2 * n_values, 20 * n_values, bytes, bytes});
    benchmarks::count_also(state, "blocks", n_values / 4);
  }

  /// A method on a template's scene with the smallest and with the full model.
  void model(benchmark::State &state, const std::string &model, const std::string &method,
             const std::string &size)
  {
    const scene::Scene scene = scene::parse_scene(
        "benchmark", scene::scene_template(model),
        {{"Methods/names", method}, {"Study/h", "0.025"}, {"Solver/model", size}});
    const problem::Problem<2> problem = make_problem(scene, 0, scene.study.series[0].levels[0]);
    auto methods = meshfree::methods();
    for (const auto &one : reference::methods())
      methods.push_back(one);
    for (const auto &one : methods)
      if (one->name() == method)
      {
        (void)analysis::solve(*one,
                              problem); // the first one starts threads and plans transforms
        for (auto _ : state)
        {
          const auto solution = analysis::solve(*one, problem);
          state.counters["unknowns"] = static_cast<double>(solution.cost.n_unknowns);
          state.counters["MB"] = static_cast<double>(solution.cost.peak_bytes) / 1e6;
        }
      }
  }

  /// A linear peridynamic solid whose Young's modulus varies, at m = 3 by OPT: all from families to
  /// solution; `solve` is the solution alone.
  void lps_solve(benchmark::State &state, const std::string &dilatation, const std::string &solver,
                 const std::string &nu)
  {
    const double h = 1. / static_cast<double>(state.range(0));
    const scene::Scene scene =
        scene::parse_scene("benchmark", scene::scene_template("LPS"),
                           {{"Domain/mesh", "squares"},
                            {"Material/E", "2 + sin(x)*sin(y)"},
                            {"Material/nu", nu},
                            {"Problem/solution", ""},
                            {"Problem/load", "0, 1"},
                            {"Problem/constraint", "x, sin(y)"},
                            {"Problem/local solution", "none"},
                            {"Study/decisive error", "averages L2 | reference"},
                            {"Reference/method", "Q1"},
                            {"Solver/dilatation", dilatation},
                            {"Solver/linear solver", solver}});
    const problem::Problem<2> problem = make_problem(scene, 0, {h, 3 * h});
    for (const auto &one : meshfree::methods())
      if (one->name() == "OPT")
        for (auto _ : state)
        {
          const auto cost = analysis::solve(*one, problem).cost;
          state.counters["unknowns"] = static_cast<double>(cost.n_unknowns);
          state.counters["iterations"] = cost.n_iterations;
          state.counters["solve ms"] = 1e3 * cost.solve_seconds;
          state.counters["MB"] = static_cast<double>(cost.peak_bytes) / 1e6;
        }
  }

  void register_all()
  {
    benchmark::RegisterBenchmark("bar/solve", bar_solve)
        ->Arg(90)
        ->Arg(180)
        ->Arg(360)
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
    for (const int m : {3, 8, 16})
    {
      benchmark::RegisterBenchmark("apply/lattice/direct", apply_lattice,
                                   algebra::OperatorBackend::direct)
          ->Arg(m)
          ->Unit(benchmark::kMillisecond);
      benchmark::RegisterBenchmark("apply/lattice/fft", apply_lattice,
                                   algebra::OperatorBackend::fft)
          ->Arg(m)
          ->Unit(benchmark::kMillisecond);
    }
    benchmark::RegisterBenchmark("apply/rows/eliminated", apply_rows, false)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("apply/rows/kept", apply_rows, true)
        ->Unit(benchmark::kMillisecond);
    for (const std::string nu : {"0.3", "0.495"})
      for (const std::string dilatation : {"kept", "eliminated"})
        for (const std::string solver : {"amg", "direct"})
          benchmark::RegisterBenchmark(
              ("lps/solve/nu = " + nu + "/" + dilatation + "/" + solver).c_str(), lps_solve,
              dilatation, solver, nu)
              ->RangeMultiplier(2)
              ->Range(32, 128)
              ->Iterations(1)
              ->Unit(benchmark::kMillisecond);
    for (const std::string one : {"scalar", "tensor", "LPS"})
      for (const std::string method : {"IPA-AC-R2", "Q1"})
        for (const std::string size : {"smallest", "full"})
          benchmark::RegisterBenchmark(("model/" + one + "/" + method + "/" + size).c_str(), model,
                                       one, method, size)
              ->Iterations(1)
              ->Unit(benchmark::kMillisecond);
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  register_all();
  benchmark::Initialize(&argc, argv);
  benchmarks::Summary summary;
  benchmark::RunSpecifiedBenchmarks(&summary);
  benchmark::Shutdown();
}
