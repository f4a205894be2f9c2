// Galerkin entries on tetrahedra, per pair of faces: exact ones and those of quadrature, whose
// error is that of the entries, relative to the largest.

#include "geometry/tetrahedral_mesh.h"
#include "parts.h"
#include "reference/tetrahedra/assembly.h"
#include "summary.h"

#include <numeric>
#include <random>

namespace plumbline::benchmarks
{
  namespace
  {
    using dealii::Point;
    using reference::FaceRule;

    /// Continuous functions on six tetrahedra per cube of side 1 with all vertices moved; the
    /// horizon is 2, and one vertex is free.
    struct Body
    {
      physics::Kernel<3> kernel;
      reference::TetrahedralSpace space;

      explicit Body(const std::string &type)
          : kernel(physics::Kernel<3>::with_diffusion(physics::kernel_type(type).profile, 2, 1)),
            space(mesh(), true)
      {
      }

      static std::shared_ptr<const reference::TetrahedralMesh> mesh()
      {
        auto mesh = geometry::six_per_cube({{{{Point<3>(), Point<3>(2, 2, 2)}}, {}}, 1}, 2);
        std::mt19937 random(7);
        std::uniform_real_distribution<double> move(-.2, .2);
        for (Point<3> &x : mesh.vertices)
          for (unsigned int d = 0; d < 3; ++d)
            x[d] += move(random);
        return std::make_shared<const reference::TetrahedralMesh>(std::move(mesh));
      }

      algebra::CsrMatrix assemble(const FaceRule &rule, reference::FaceRuleUse *use = nullptr) const
      {
        return assemble_by_faces(space, kernel, space.n_free(), rule, use);
      }
    };

    void entries(benchmark::State &state, const std::string &type, const FaceRule &rule)
    {
      const Body body(type);
      reference::FaceRuleUse use;
      const algebra::CsrMatrix exact = body.assemble(FaceRule::exact(), &use);
      algebra::CsrMatrix matrix;
      for (auto _ : state)
        matrix = body.assemble(rule);
      count(state, "face pairs",
            static_cast<double>(std::accumulate(use.n_pairs.begin(), use.n_pairs.end(),
                                                static_cast<std::size_t>(0))));
      state.counters["error"] = rule.is_exact ? use.error : reference::difference(matrix, exact);
    }
  } // namespace

  void register_tetrahedra()
  {
    for (const std::string type : {"constant", "1/r"})
    {
      const std::string title = "tetrahedra/P1/" + std::string(type == "1/r" ? "inverse" : type);
      benchmark::RegisterBenchmark((title + "/exact").c_str(), entries, type, FaceRule::exact())
          ->Unit(benchmark::kMillisecond);
      for (const unsigned int refinement : {0, 2, 4})
        benchmark::RegisterBenchmark((title + "/quadrature/" + std::to_string(refinement)).c_str(),
                                     entries, type, FaceRule::quadrature(refinement))
            ->Unit(benchmark::kMillisecond);
    }
  }
} // namespace plumbline::benchmarks
