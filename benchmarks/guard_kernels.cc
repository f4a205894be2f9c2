#include "guard_kernels.h"

#include "algebra/direct.h"
#include "algebra/sparse.h"
#include "geometry/mesh_input.h"
#include "geometry/vertex_cells.h"
#include "meshfree/lattice/stencil.h"
#include "meshfree/rules/rules.h"
#include "meshfree/scattered/state_based_operator.h"
#include "parts.h"
#include "reference/lattice/stencil.h"
#include "reference/mesh/dilatation.h"
#include "reference/mesh/edge_assembly.h"
#include "reference/mesh/pair_quadrature.h"
#include "reference/mesh/polygon_pairs.h"
#include "reference/mesh/rectangle_pairs.h"

#include <cmath>
#include <functional>
#include <memory>

namespace plumbline::benchmarks
{
  namespace
  {
    using geometry::Backend;
    using geometry::Point;

    volatile double sink; ///< what is computed is used

    /// Unit squares all around the circle of radius 3, cut and not.
    GuardKernel ball_cell(const std::string &name, Backend backend, int n_cells,
                          unsigned int n_passes)
    {
      std::vector<std::array<Point<2>, 4>> cells;
      for (int i = 0; i < n_cells; ++i)
      {
        const double angle = 2 * M_PI * (i + .3) / n_cells;
        cells.push_back(
            geometry::square(Point<2>(3 * std::cos(angle) - .5, 3 * std::sin(angle) - .5), 1));
      }
      return {name, "call", static_cast<double>(n_cells), n_passes,
              [=]
              {
                for (const auto &cell : cells)
                  sink = geometry::intersect({Point<2>(), 3}, geometry::view(cell), backend).area;
              }};
    }

    GuardKernel polar_rule()
    {
      const auto rule = std::make_shared<geometry::CutRule>();
      return {"polar rule", "call", 1, 64,
              [=]
              {
                const auto cell = geometry::square(Point<2>(2, 1), 1);
                geometry::polar_rule({Point<2>(), 3}, geometry::view(cell), 16, 10, *rule);
                sink = rule->weights[0];
              }};
    }

    GuardKernel family(
        const std::string &rule,
        const std::function<meshfree::NeighbourhoodQuadrature<2>(const physics::Kernel<2> &)> &of)
    {
      return {"family " + rule, "family", 1, 8,
              [=]
              {
                const auto kernel = make_kernel("linear-decay", 3);
                sink =
                    meshfree::lattice_bonds(of(kernel), kernel, 1, Backend::fast).family[0].weight;
              }};
    }

    /// One operator on 64 × 64 nodes, m = 3.
    struct Field
    {
      algebra::Stencil stencil;
      geometry::NodeSet nodes;
      std::vector<double> x, y;

      Field() : stencil(1, 0)
      {
        constexpr int n = 64;
        const auto kernel = make_kernel("linear-decay", 3. / n);
        stencil = meshfree::lattice_operator(
            kernel, meshfree::lattice_bonds(meshfree::improved_partial_area(kernel), kernel, 1. / n,
                                            Backend::fast));
        const geometry::Lattice lattice({{{Point<2>(0, 0), Point<2>(1, 1)}}, {}}, 1. / n);
        nodes = free_nodes(lattice, {{.5, false, 0}}, 1);
        x.assign(nodes.size(), 1.);
        y.assign(nodes.size(), 0.);
      }
    };

    GuardKernel stencil_apply()
    {
      const auto field = std::make_shared<Field>();
      const auto matrix = std::make_shared<algebra::DirectStencil>(field->stencil, field->nodes.n);
      const double bonds = static_cast<double>(field->stencil.n_entries() * field->nodes.size());
      return {"stencil apply", "bond", bonds, 4,
              [=]
              {
                matrix->apply(field->x.data(), field->y.data());
                sink = field->y[0];
              }};
    }

    /// The plain loop over rows that any sparse matrix comes down to: what stencils save.
    GuardKernel row_apply()
    {
      const auto field = std::make_shared<Field>();
      const auto rows =
          std::make_shared<algebra::CsrMatrix>(algebra::assemble(field->stencil, field->nodes));
      return {"rows apply", "entry", static_cast<double>(rows->value.size()), 4,
              [=]
              {
                for (std::size_t i = 0; i < rows->n_rows(); ++i)
                {
                  double sum = 0;
                  for (std::size_t k = rows->start[i]; k < rows->start[i + 1]; ++k)
                    sum += rows->value[k] * field->x[rows->column[k]];
                  field->y[i] = sum;
                }
                sink = field->y[0];
              }};
    }

    GuardKernel galerkin_entries()
    {
      const auto make = [](const physics::Kernel<2> &kernel) {
        return reference::galerkin_stencil(kernel, 1, reference::AxisShapes(true, 1),
                                           Backend::fast);
      };
      const auto kernel = make_kernel("linear-decay", 3);
      const double n_entries = static_cast<double>(make(kernel).n_entries());
      return {"lattice entries Q1", "entry", n_entries, 4,
              [=] { sink = make(kernel)(0, 0, 1, 1); }};
    }

    /// A unit square in cells of 1/8 and its collar.
    struct Body
    {
      static constexpr double horizon = .5;
      std::shared_ptr<const geometry::Mesh> mesh;
      reference::MeshSpace space;
      reference::MeshCells cells;
      reference::KernelEntries profile;

      Body(bool is_triangles, const std::string &kernel)
          : mesh(std::make_shared<const geometry::Mesh>(geometry::lattice_mesh(
                {{{Point<2>(0, 0), Point<2>(1, 1)}}, {}}, 1. / 8, horizon, is_triangles))),
            space(mesh, true, 1), cells(*mesh), profile(make_kernel(kernel, horizon))
      {
      }
    };

    /// Of a cell in the middle with all others, that the circle cuts or does not.
    GuardKernel mesh_pairs(const std::string &name, bool is_triangles, const std::string &kernel,
                           bool is_cut, bool is_exact, unsigned int n_passes)
    {
      const auto body = std::make_shared<const Body>(is_triangles, kernel);
      const Point<2> centre(.53, .51);
      const auto own = body->cells.locator().at(centre);
      std::vector<unsigned int> near, partners;
      body->cells.find_near(own, Body::horizon, near);
      for (const unsigned int other : near)
        if ((body->cells.farthest(own, other) > Body::horizon) == is_cut)
          partners.push_back(other);
      const auto blocks = std::make_shared<reference::PairBlocks>();
      const auto n = static_cast<double>(partners.size());
      if (is_exact)
      {
        const auto pairs = std::make_shared<reference::RectanglePairs>(
            body->space.shapes(), body->profile, Body::horizon, Backend::fast);
        return {name, "pair", n, n_passes,
                [=]
                {
                  for (const unsigned int other : partners)
                    pairs->integrate(body->cells[own].box(), body->cells[other].box(), *blocks);
                  sink = blocks->cross[0];
                }};
      }
      const auto pairs = std::make_shared<reference::PairQuadrature>(
          body->space, body->cells, body->profile, Body::horizon, std::nullopt, 0, Backend::fast);
      return {name, "pair", n, n_passes,
              [=, owner = body]
              {
                for (const unsigned int other : partners)
                  pairs->integrate(own, other, *blocks);
                sink = blocks->cross[0];
              }};
    }

    /// Exact entries of two cells in the middle with all others that the circle cuts: one after the
    /// other, so that no moments of sides are left of the last pass.
    GuardKernel side_pairs(const std::string &name, const physics::Kernel<2> &kernel,
                           unsigned int n_passes)
    {
      const auto body = std::make_shared<const Body>(true, "constant");
      std::vector<std::pair<std::size_t, unsigned int>> pairs;
      for (const Point<2> &centre : {Point<2>(.53, .51), Point<2>(.51, .53)})
      {
        const auto own = body->cells.locator().at(centre);
        std::vector<unsigned int> near;
        body->cells.find_near(own, Body::horizon, near);
        for (const unsigned int other : near)
          if (body->cells.farthest(own, other) > Body::horizon)
            pairs.emplace_back(own, other);
      }
      const auto blocks = std::make_shared<reference::PairBlocks>();
      const auto by_sides =
          std::make_shared<reference::PolygonPairs>(body->space, body->cells, kernel);
      return {name, "pair", static_cast<double>(pairs.size()), n_passes,
              [=, owner = body]
              {
                for (const auto &[own, other] : pairs)
                  by_sides->integrate(own, other, *blocks);
                sink = blocks->cross[0];
              }};
    }

    /// All exact entries of linear triangles, by pairs of sides, δ = 4 h.
    GuardKernel edge_entries()
    {
      const auto body = std::make_shared<const Body>(true, "constant");
      const auto make = [=]
      {
        return assemble_by_edges(body->space, make_kernel("constant", Body::horizon),
                                 base::Communicator::alone());
      };
      return {"edges P1 constant", "entry", static_cast<double>(make().value.size()), 1,
              [=] { sink = make().value[0]; }};
    }

    /// The dilatation of 4 × 4 squares of degree 1, δ = 2 h, two materials in stripes, or one that
    /// varies, for which each cell has rows of its own.
    GuardKernel dilatation(const std::string &name, bool is_striped)
    {
      constexpr double h = 1. / 4, horizon = 2 * h;
      const auto mesh = std::make_shared<const geometry::Mesh>(
          geometry::lattice_mesh({{{Point<2>(0, 0), Point<2>(1, 1)}}, {}}, h, 2 * horizon, false));
      const auto space = std::make_shared<const reference::MeshSpace>(mesh, true, 1);
      const auto cells = std::make_shared<const reference::MeshCells>(*mesh);
      const auto material = [=](const Point<2> &x) {
        return physics::Lame{is_striped ? (x[0] < .5 ? 3. : 4.) : 3 + x[0], 1};
      };
      const physics::Dilatation<2> solid{physics::influence_function<2>({{1, -1}}, horizon),
                                         material, true, false};
      return {name, "node", static_cast<double>(space->n_free()), 1, [=, owner = mesh] {
                sink = assemble_dilatation(*space, *cells, solid, {}, base::Communicator::alone())
                           .value[0];
              }};
    }

    /// A linear peridynamic solid of varying material on 8 × 8 squares by OPT, m = 3, families
    /// included.
    GuardKernel solid_rows()
    {
      constexpr double h = 1. / 8, horizon = 3 * h;
      const auto cells = std::make_shared<const geometry::NodeCells<2>>(geometry::vertex_squares(
          geometry::Lattice({{{Point<2>(0, 0), Point<2>(1, 1)}}, {}}, h), 2 * horizon));
      const auto influence = physics::influence_function<2>({{1, -1}}, horizon);
      const auto kernel = physics::deviatoric_kernel(influence, 1);
      const auto families = std::make_shared<const meshfree::Families<2>>(
          meshfree::optimisation_based(kernel), kernel, *cells, Backend::fast);
      const auto material = [](const Point<2> &x) { return physics::Lame{3 + x[0], 1 + x[1]}; };
      const meshfree::StateBasedBody body{cells.get(), {influence, material, true, false}};
      return {"LPS rows", "node", static_cast<double>(cells->n_free), 4,
              [=, owner = cells]
              {
                const auto source = [&](std::size_t node, meshfree::Family<2> &family)
                { families->make(node, family); };
                sink = state_based_operator(source, body, {0, owner->n_free}).rows.free.value[0];
              }};
    }
  } // namespace

  std::vector<GuardKernel> guard_kernels()
  {
    std::vector<GuardKernel> kernels;
    kernels.push_back(ball_cell("ball-cell fast", Backend::fast, 64, 16));
    kernels.push_back(ball_cell("ball-cell exact", Backend::cgal, 16, 4));
    kernels.push_back(polar_rule());
    for (const meshfree::Rule &rule : meshfree::rules())
      kernels.push_back(family(rule.name, rule.in_plane));
    kernels.push_back(stencil_apply());
    kernels.push_back(row_apply());
    kernels.push_back(galerkin_entries());
    kernels.push_back(mesh_pairs("pairs P1 constant, whole", true, "constant", false, false, 16));
    kernels.push_back(mesh_pairs("pairs P1 constant, cut", true, "constant", true, false, 8));
    kernels.push_back(mesh_pairs("pairs P1 1/r, whole", true, "1/r", false, false, 4));
    kernels.push_back(mesh_pairs("pairs Q1 1/r, exact", false, "1/r", true, true, 4));
    kernels.push_back(
        side_pairs("sides P1 constant, cut", make_kernel("constant", Body::horizon), 4));
    kernels.push_back(side_pairs("sides P1 tensor, cut",
                                 physics::Kernel<2>::with_bulk_modulus(
                                     physics::kernel_type("bond-tensor").profile, Body::horizon, 1),
                                 4));
    kernels.push_back(edge_entries());
    kernels.push_back(dilatation("dilatation Q1, striped", true));
    kernels.push_back(dilatation("dilatation Q1, varying", false));
    kernels.push_back(solid_rows());
    return kernels;
  }
} // namespace plumbline::benchmarks
