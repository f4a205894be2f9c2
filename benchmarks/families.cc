// Ball ∩ cell per call; families of every rule, on lattices and on scattered nodes.

#include "meshfree/rules/families.h"
#include "geometry/ball_cell.h"
#include "geometry/ball_polyhedron.h"
#include "geometry/mesh_input.h"
#include "meshfree/rules/rules.h"
#include "parts.h"
#include "summary.h"

#include <cmath>
#include <random>

namespace plumbline::benchmarks
{
  namespace
  {
    using geometry::Backend;
    using geometry::Point;

    physics::Kernel<2> make_kernel(double horizon)
    {
      return physics::Kernel<2>::with_diffusion(physics::kernel_type("linear-decay").profile,
                                                horizon, .5);
    }

    /// Unit squares whose centres lie on the circle of a radius, the argument.
    void intersect(benchmark::State &state, Backend backend)
    {
      std::mt19937 random(1);
      std::uniform_real_distribution<double> angle(0, 2 * M_PI);
      const auto ratio = static_cast<double>(state.range(0));
      std::vector<std::array<Point<2>, 4>> cells;
      for (int i = 0; i < 512; ++i)
      {
        const double a = angle(random);
        cells.push_back(
            geometry::square(Point<2>(ratio * std::cos(a) - .5, ratio * std::sin(a) - .5), 1));
      }
      const geometry::Ball ball{Point<2>(), ratio};
      std::size_t i = 0;
      for (auto _ : state)
        benchmark::DoNotOptimize(
            geometry::intersect(ball, geometry::view(cells[i++ % cells.size()]), backend).area);
      count(state, "calls", 1);
    }

    /// The cube of size 1 or, sheared by next to nothing, any polyhedron, which spheres of a
    /// radius, the argument in tenths, cut at random: volume and centroid.
    void intersect_solid(benchmark::State &state, bool is_box)
    {
      const double radius = static_cast<double>(state.range(0)) / 10, shear = is_box ? 0 : 1e-7;
      const geometry::ConvexPolyhedron cube = geometry::ConvexPolyhedron::box({}, {1, 1, 1});
      auto vertices = cube.vertices();
      std::vector<geometry::ConvexPolyhedron::Indices> faces;
      for (const auto &face : cube.faces())
        faces.push_back(face.vertices);
      for (auto &x : vertices)
        x[0] += shear * x[1];
      const geometry::ConvexPolyhedron cell(vertices, faces);
      std::mt19937 random(1);
      std::uniform_real_distribution<double> place(0, 1);
      std::normal_distribution<double> direction;
      std::vector<geometry::SolidBall> balls;
      while (balls.size() < 4096)
      {
        dealii::Point<3> centre;
        dealii::Tensor<1, 3> way;
        for (unsigned int k = 0; k < 3; ++k)
        {
          centre[k] = place(random);
          way[k] = direction(random);
        }
        const geometry::SolidBall ball{centre + radius / way.norm() * way, radius};
        const double volume = geometry::intersect(ball, cell, 0).volume;
        if (volume > 0 && volume < cell.moments().volume)
          balls.push_back(ball);
      }
      std::size_t i = 0;
      for (auto _ : state)
        benchmark::DoNotOptimize(geometry::intersect(balls[i++ % balls.size()], cell, 1).volume);
      count(state, "calls", 1);
    }

    void polar_rule(benchmark::State &state)
    {
      const auto cell = geometry::square(Point<2>(2, 1), 1);
      geometry::CutRule rule;
      for (auto _ : state)
      {
        geometry::polar_rule({Point<2>(), 3}, geometry::view(cell), 16, 10, rule);
        benchmark::DoNotOptimize(rule.weights.data());
      }
      count(state, "calls", 1);
      count_also(state, "points", static_cast<double>(rule.weights.size()));
    }

    /// The argument: m.
    void lattice_family(benchmark::State &state, const meshfree::Rule &rule)
    {
      const auto kernel = make_kernel(static_cast<double>(state.range(0)));
      std::size_t n_bonds = 0;
      for (auto _ : state)
        benchmark::DoNotOptimize(
            n_bonds = meshfree::lattice_bonds(rule.in_plane(kernel), kernel, 1, Backend::fast)
                          .family.size());
      count(state, "families", 1);
      state.counters["bonds/family"] = static_cast<double>(n_bonds);
      count_also(state, "bonds", static_cast<double>(n_bonds));
    }

    /// Nodes of the unit square, moved by up to .2 h each, with their Voronoi cells; the argument:
    /// m.
    void scattered_families(benchmark::State &state, const meshfree::Rule &rule)
    {
      constexpr double h = 1. / 24, perturbation = .2;
      const auto kernel = make_kernel(static_cast<double>(state.range(0)) * h);
      const geometry::Mesh mesh =
          geometry::lattice_mesh({{{Point<2>(0, 0), Point<2>(1, 1)}}, {}}, h,
                                 kernel.horizon() + (1 + perturbation) * h, false);
      const auto cells =
          geometry::voronoi_cells(geometry::lattice_nodes(mesh, h, perturbation, 1), mesh);
      const meshfree::Families<2> families(rule.in_plane(kernel), kernel, cells, Backend::fast);
      meshfree::Family<2> family;
      std::size_t n_bonds = 0;
      // one iteration is all families: the same nodes whatever the number of iterations
      for (auto _ : state)
      {
        n_bonds = 0;
        for (std::size_t node = 0; node < families.size(); ++node)
        {
          families.make(node, family);
          n_bonds += family.bonds.size();
        }
        benchmark::DoNotOptimize(n_bonds);
      }
      const auto n = static_cast<double>(families.size());
      count(state, "families", n);
      state.counters["bonds/family"] = static_cast<double>(n_bonds) / n;
      count_also(state, "bonds", static_cast<double>(n_bonds));
    }
  } // namespace

  void register_families()
  {
    for (const int ratio : {1, 3, 32, 1000})
      benchmark::RegisterBenchmark("intersect/fast", intersect, Backend::fast)->Arg(ratio);
    benchmark::RegisterBenchmark("intersect/cgal", intersect, Backend::cgal)->Arg(3);
    for (const int tenths : {5, 10, 20, 30, 50, 100, 1000, 10000})
    {
      benchmark::RegisterBenchmark("intersect/box", intersect_solid, true)->Arg(tenths);
      benchmark::RegisterBenchmark("intersect/polyhedron", intersect_solid, false)->Arg(tenths);
    }
    benchmark::RegisterBenchmark("polar rule", polar_rule);
    for (const meshfree::Rule &one : meshfree::rules())
      benchmark::RegisterBenchmark(("rule/lattice/" + one.name).c_str(), lattice_family, one)
          ->ArgName("m")
          ->Arg(3)
          ->Arg(16)
          ->Unit(benchmark::kMicrosecond);
    for (const meshfree::Rule &one : meshfree::rules())
      benchmark::RegisterBenchmark(("rule/scattered/" + one.name).c_str(), scattered_families, one)
          ->ArgName("m")
          ->Arg(3)
          ->Arg(6)
          ->Unit(benchmark::kMillisecond);
  }
} // namespace plumbline::benchmarks
