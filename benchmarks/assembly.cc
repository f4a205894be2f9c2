// Galerkin entries: stencils of lattices, blocks of one pair of cells after another, whole meshes.

#include "reference/mesh/assembly.h"
#include "geometry/mesh_input.h"
#include "parts.h"
#include "reference/lattice/stencil.h"
#include "reference/mesh/pair_quadrature.h"
#include "reference/mesh/rectangle_pairs.h"
#include "summary.h"

#include <algorithm>
#include <random>

namespace plumbline::benchmarks
{
  namespace
  {
    using geometry::Backend;
    using geometry::Point;

    void lattice_entries(benchmark::State &state, unsigned int degree)
    {
      const auto kernel = make_kernel("linear-decay", static_cast<double>(state.range(0)));
      const reference::AxisShapes shapes(true, degree);
      double n_entries = 0;
      for (auto _ : state)
        n_entries = static_cast<double>(
            reference::galerkin_stencil(kernel, 1, shapes, Backend::fast).n_entries());
      count(state, "entries", n_entries);
    }

    /// A unit square and its collar, the halves of squares or the squares.
    struct Body
    {
      std::shared_ptr<const geometry::Mesh> mesh;
      reference::MeshSpace space;
      reference::MeshCells cells;

      Body(bool is_triangles, unsigned int degree, double h, double horizon)
          : mesh(std::make_shared<const geometry::Mesh>(geometry::lattice_mesh(
                {{{Point<2>(0, 0), Point<2>(1, 1)}}, {}}, h, horizon, is_triangles))),
            space(mesh, true, degree), cells(*mesh)
      {
      }
    };

    using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

    /// All that a horizon couples, each once, a cell of Ω first.
    Pairs all_pairs(const Body &body, double horizon)
    {
      Pairs pairs;
      std::vector<unsigned int> near;
      for (std::size_t a = 0; a < body.cells.size(); ++a)
        if (body.mesh->cells[a].is_inside)
        {
          body.cells.find_near(a, horizon, near);
          for (const unsigned int b : near)
            if (!body.mesh->cells[b].is_inside || a <= b)
              pairs.emplace_back(a, b);
        }
      return pairs;
    }

    enum class Place
    {
      near,  ///< where a kernel like 1/r asks for rules in polar coordinates
      whole, ///< all pairs of points within the horizon, and not near
      cut    ///< by the circle
    };

    /// Pairs of a place, taken at random, always the same.
    Pairs sample(const Body &body, double horizon, Place place)
    {
      Pairs pairs = all_pairs(body, horizon);
      const auto is_elsewhere = [&](const auto &pair)
      {
        const auto [a, b] = pair;
        const double between = body.cells.centroid(a).distance(body.cells.centroid(b));
        // as in reference/mesh/pair_quadrature.cc
        const bool is_near = between <= 2 * (body.cells.radius(a) + body.cells.radius(b));
        const bool is_whole = body.cells.farthest(a, b) <= horizon;
        return place != (!is_whole ? Place::cut : is_near ? Place::near : Place::whole);
      };
      pairs.erase(std::remove_if(pairs.begin(), pairs.end(), is_elsewhere), pairs.end());
      std::shuffle(pairs.begin(), pairs.end(), std::mt19937(1));
      constexpr std::size_t most = 256;
      pairs.resize(std::min(pairs.size(), most));
      return pairs;
    }

    enum class Way
    {
      triangles,  ///< by quadrature
      squares,    ///< by quadrature, as any quadrilateral
      correlation ///< squares, exact
    };

    /// Blocks of pairs one after another; the outer rule not refined.
    void pair_blocks(benchmark::State &state, Way way, const std::string &type, unsigned int degree,
                     Place place)
    {
      constexpr double h = 1. / 12, horizon = 6 * h;
      const Body body(way == Way::triangles, degree, h, horizon);
      const reference::KernelEntries profile(make_kernel(type, horizon));
      const Pairs pairs = sample(body, horizon, place);
      reference::PairBlocks blocks;
      const auto run = [&](auto &integrator, const auto &cell)
      {
        for (auto _ : state)
          for (const auto &[a, b] : pairs)
          {
            integrator.integrate(cell(a), cell(b), blocks);
            benchmark::DoNotOptimize(blocks.cross.data());
          }
      };
      if (way == Way::correlation)
      {
        reference::RectanglePairs by_correlation(body.space.shapes(), profile, horizon,
                                                 Backend::fast);
        run(by_correlation, [&](std::size_t cell) { return body.cells[cell].box(); });
      }
      else
      {
        reference::PairQuadrature by_quadrature(body.space, body.cells, profile, horizon, {}, 0,
                                                Backend::fast);
        run(by_quadrature, [](std::size_t cell) { return cell; });
      }
      const auto n = static_cast<double>(pairs.size());
      count(state, "pairs", n);
      const double n_shapes = body.space.shapes().size();
      count_also(state, "values", 3 * n_shapes * n_shapes * n);
    }

    /// The whole matrix: pairs are found, integrated, summed and the rows made. What it takes more
    /// than the blocks above, of cut and whole pairs in their shares, is the price of finding and
    /// summing.
    void mesh(benchmark::State &state, bool is_triangles, const std::string &type,
              unsigned int degree, bool is_exact)
    {
      constexpr double h = 1. / 16, horizon = 4 * h;
      const Body body(is_triangles, degree, h, horizon);
      const auto kernel = make_kernel(type, horizon);
      double n_entries = 0;
      for (auto _ : state)
        n_entries = static_cast<double>(reference::assemble(body.space, body.cells, kernel, {},
                                                            {0, is_exact, Backend::fast},
                                                            base::Communicator::alone())
                                            .rows.value.size());
      const Pairs pairs = all_pairs(body, horizon);
      const auto n = static_cast<double>(pairs.size());
      count(state, "pairs", n);
      state.counters["cut"] =
          static_cast<double>(
              std::count_if(pairs.begin(), pairs.end(),
                            [&](const auto &pair)
                            { return body.cells.farthest(pair.first, pair.second) > horizon; })) /
          n;
      count_also(state, "entries", n_entries);
    }

    void register_meshes(unsigned int degree, const std::string &type)
    {
      const bool is_singular = type == "1/r";
      const auto title = [&](const std::string &shape)
      {
        return shape + (shape == "triangles" ? "/P" : "/Q") + std::to_string(degree) + "/" +
               (is_singular ? "inverse" : type);
      };
      const std::vector<std::pair<std::string, Way>> ways = {{"triangles", Way::triangles},
                                                             {"squares", Way::squares},
                                                             {"correlation", Way::correlation}};
      std::vector<std::pair<std::string, Place>> places = {{"whole", Place::whole},
                                                           {"cut", Place::cut}};
      if (is_singular)
        places.insert(places.begin(), {"near", Place::near});
      for (const auto &[name, way] : ways)
        for (const auto &[where, place] : places)
          benchmark::RegisterBenchmark(("pairs/" + title(name) + "/" + where).c_str(), pair_blocks,
                                       way, type, degree, place)
              ->Unit(benchmark::kMicrosecond);
      for (const bool is_triangles : {false, true})
        benchmark::RegisterBenchmark(
            ("assembly/" + title(is_triangles ? "triangles" : "squares")).c_str(), mesh,
            is_triangles, type, degree, !is_triangles)
            ->Unit(benchmark::kMillisecond);
      if (degree == 1)
        benchmark::RegisterBenchmark(("assembly/" + title("triangles") + "/sides").c_str(), mesh,
                                     true, type, degree, true)
            ->Unit(benchmark::kMillisecond);
    }
  } // namespace

  void register_assembly()
  {
    for (unsigned int degree = 1; degree <= 3; ++degree)
      benchmark::RegisterBenchmark(("entries/Q" + std::to_string(degree)).c_str(), lattice_entries,
                                   degree)
          ->ArgName("m")
          ->Arg(3)
          ->Arg(16)
          ->Arg(100)
          ->Unit(benchmark::kMillisecond);
    for (const unsigned int degree : {1, 2})
      for (const std::string type : {"constant", "1/r"})
        register_meshes(degree, type);
  }
} // namespace plumbline::benchmarks
