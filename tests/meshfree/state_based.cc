#include "analysis/statics.h"
#include "base/error.h"
#include "meshfree/lattice/stencil.h"
#include "meshfree/method.h"
#include "scene/problem.h"
#include "tests/meshfree/state_based_problems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

using namespace plumbline;
using namespace plumbline::meshfree;

namespace
{
  const Lame lame{2.3, .7};

  /// A homogeneous solid with the field (α·x², β·x²) of monomials x², xy, y²: L u = -[μ Δu +
  /// (λ+μ) ∇div u] for the nonlocal operator too, since its moments of degree 4 do not count.
  StateBasedProblem quadratic(const std::array<double, 3> &a, const std::array<double, 3> &b)
  {
    const auto value = [](const std::array<double, 3> &c, const Point<2> &x)
    { return c[0] * x[0] * x[0] + c[1] * x[0] * x[1] + c[2] * x[1] * x[1]; };
    const double sum = lame.lambda + lame.mu;
    const Point<2> load(-lame.mu * 2 * (a[0] + a[2]) - sum * (2 * a[0] + b[1]),
                        -lame.mu * 2 * (b[0] + b[2]) - sum * (a[1] + 2 * b[2]));
    return {[](const Point<2> &) { return lame; },
            [=](const Point<2> &x) { return Point<2>(value(a, x) + x[1], value(b, x) - 3 * x[0]); },
            [=](const Point<2> &) { return load; },
            {},
            true,
            true};
  }

  const std::vector<StateBasedProblem> quadratics = {
      quadratic({1, 0, 0}, {}), quadratic({0, 1, 0}, {}), quadratic({0, 0, 1}, {}),
      quadratic({}, {1, 0, 0}), quadratic({.3, 2, -1}, {0, 1, 1})};

  NeighbourhoodQuadrature<2> recalibrated_2(const Kernel<2> &kernel)
  {
    return recalibrated(kernel, 2);
  }

  /// Smooth, λ ≠ μ, both not constant.
  StateBasedProblem varied(bool is_two_point)
  {
    auto problem = smooth_problem(.4);
    problem.is_two_point = is_two_point;
    return problem;
  }

  double largest(const std::vector<double> &values)
  {
    double result = 0;
    for (const double value : values)
      result = std::max(result, std::abs(value));
    return result;
  }

  double largest_difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    EXPECT_EQ(a.size(), b.size());
    std::vector<double> difference;
    for (std::size_t i = 0; i < a.size(); ++i)
      difference.push_back(a[i] - b[i]);
    return largest(difference);
  }

  /// max |A_ij - A_ji| / max |A|
  double symmetry_defect(const algebra::CsrMatrix &rows)
  {
    std::map<std::pair<std::size_t, std::size_t>, double> entries;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        entries[{i, rows.column[k]}] = rows.value[k];
    double defect = 0;
    for (const auto &[place, value] : entries)
    {
      const auto twin = entries.find({place.second, place.first});
      defect = std::max(defect, std::abs(value - (twin == entries.end() ? 0 : twin->second)));
    }
    return defect / largest(rows.value);
  }

  /// |L u - b| of a problem's own field on a lattice, relative to the load.
  double stencil_defect(const StateBasedProblem &problem,
                        NeighbourhoodQuadrature<2> (*rule)(const Kernel<2> &))
  {
    const Square square(.1, .1, 0);
    const StateBasedCase one(problem, square, rule);
    const auto stencil = state_based_stencil(
        one.body.dilatation,
        lattice_bonds(rule(one.deviatoric()), one.deviatoric(), square.h, Backend::fast));
    const Point<2> load = problem.load({});
    Tensor<1, 2> defect = -load;
    for (unsigned int a = 0; a < 2; ++a)
      for (unsigned int b = 0; b < 2; ++b)
        for (int k = -stencil.reach(); k <= stencil.reach(); ++k)
          for (int l = -stencil.reach(); l <= stencil.reach(); ++l)
            defect[a] +=
                stencil(a, b, k, l) * problem.solution(square.h * Point<2>(1. * k, 1. * l))[b];
    return defect.norm() / std::max(1., load.norm());
  }

  std::string message_of(const std::function<void()> &action)
  {
    try
    {
      action();
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  std::string number_of_node(const Square &square, const Point<2> &x)
  {
    const auto &nodes = square.cells.nodes;
    const auto node = std::find_if(nodes.begin(), nodes.end(),
                                   [&](const Point<2> &y) { return x.distance(y) < 1e-9; });
    return "node " + std::to_string(node - nodes.begin()) + ' ';
  }

  /// Bonds of the node at (½, ½) h that a crack breaks, by their ends in cells, on a lattice of h =
  /// 1; the same from both ends.
  std::vector<std::array<int, 2>> broken(const std::vector<Point<2>> &crack)
  {
    const Square square(1, 3, .5, 2);
    const auto problem = quadratics[0];
    const StateBasedCase one(problem, square, full_area<2>);
    const BrokenBonds bonds({{crack}, {}}, square.cells, square.horizon);
    std::vector<std::array<int, 2>> result;
    Family<2> family, other;
    std::vector<char> is_intact, of_other;
    for (unsigned int i = 0; i < square.cells.n_free; ++i)
      if (square.cells.nodes[i].distance(Point<2>(.5, .5)) < .1)
      {
        one.families.make(i, family);
        bonds.find(i, family, is_intact);
        for (std::size_t k = 0; k < family.bonds.size(); ++k)
        {
          const unsigned int j = family.neighbours[k];
          one.families.make(j, other);
          bonds.find(j, other, of_other);
          const auto back = std::find(other.neighbours.begin(), other.neighbours.end(), i);
          EXPECT_EQ(of_other[back - other.neighbours.begin()], is_intact[k]);
          if (is_intact[k] == 0)
            result.push_back({static_cast<int>(std::lround(family.bonds[k].xi[0])),
                              static_cast<int>(std::lround(family.bonds[k].xi[1]))});
        }
      }
    std::sort(result.begin(), result.end());
    return result;
  }

  /// A heterogeneous solid with a crack on nodes that were moved.
  scene::Scene solid_scene(const std::vector<scene::Override> &changes)
  {
    return scene::parse_scene(
        "solid",
        "subsection Domain\n set mesh = squares\n set cracks = 0.52, -1 : 0.52, 0.5\nend\n"
        "subsection Kernel\n set type = 1/r\n set limit = Navier\nend\n"
        "subsection Material\n set model = LPS\n set E = 1 + x^2\n set nu = 0.45\nend\n"
        "subsection Problem\n set load = 1, y\n set constraint = x*y, x - y\nend\n"
        "subsection Methods\n set names = OPT\n set perturbation = 0.2\nend\n"
        "subsection Study\n set norms = averages L2\n"
        " set decisive error = averages L2 | reference\nend\n"
        "subsection Reference\n set method = Q1\nend\n",
        changes);
  }
} // namespace

TEST(StateBasedStencil, reproduces_quadratics_where_the_moments_are_exact)
{
  for (const StateBasedProblem &problem : quadratics)
  {
    EXPECT_LT(stencil_defect(problem, optimisation_based), 1e-11);
    EXPECT_LT(stencil_defect(problem, recalibrated_2), 1e-11);
    EXPECT_GT(stencil_defect(problem, improved_partial_area), .01);
  }
}

TEST(StateBasedStencil, is_symmetric_and_reaches_twice_as_far)
{
  const Square square(.1, .1, 0);
  const StateBasedCase one(quadratics[0], square);
  for (const Rule &rule : rules())
  {
    const auto bonds =
        lattice_bonds(rule.in_plane(one.deviatoric()), one.deviatoric(), square.h, Backend::fast);
    const auto stencil = state_based_stencil(one.body.dilatation, bonds);
    EXPECT_TRUE(stencil.is_even()) << rule.name;
    EXPECT_LT(stencil.symmetry_defect(), 1e-14) << rule.name;
    EXPECT_EQ(stencil.reach(), 2 * lattice_operator(one.deviatoric(), bonds).reach()) << rule.name;
  }
}

TEST(StateBasedOperator, is_the_stencil_where_nodes_are_a_lattice)
{
  for (const double m : {2.5, 3.})
  {
    const Square square(.1, .5, .5, m);
    const StateBasedCase sample(quadratics[0], square);
    for (const Rule &rule : rules())
    {
      const StateBasedCase one(quadratics[0], square, rule.in_plane);
      const auto stencil = state_based_stencil(
          one.body.dilatation, lattice_bonds(rule.in_plane(one.deviatoric()), one.deviatoric(),
                                             square.h, Backend::fast));
      const auto rows = one.system().rows;
      const auto cell = [&](std::size_t node, unsigned int axis)
      {
        return static_cast<int>(
            std::lround((square.cells.nodes[node][axis] - square.cells.nodes[0][axis]) / square.h));
      };
      double scale = 0, defect = 0;
      for (std::size_t i = 0; i < rows.n_rows(); ++i)
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        {
          const unsigned int j = rows.column[k];
          const double expected = stencil(i % 2, j % 2, cell(j / 2, 0) - cell(i / 2, 0),
                                          cell(j / 2, 1) - cell(i / 2, 1));
          scale = std::max(scale, std::abs(expected));
          defect = std::max(defect, std::abs(rows.value[k] - expected));
        }
      EXPECT_LT(defect, 1e-12 * scale) << rule.name << ' ' << m;
    }
  }
}

// The load is constant; -∫ of the collar's data is in it if rows reach as far as they must.
TEST(StateBasedOperator, solves_quadratics_exactly_on_nodes_that_were_moved)
{
  Square square(.125, .5, .5);
  for (std::size_t i = 0; i < square.cells.size(); ++i)
    square.cells.nodes[i] += .2 * square.h * Point<2>(std::sin(5. * i), std::cos(7. * i));
  for (const StateBasedProblem &problem : quadratics)
  {
    const StateBasedCase one(problem, square);
    EXPECT_LT(one.l2_error(solve(one.system()).values), 1e-11);
  }
  const StateBasedCase other(quadratics[0], square, improved_partial_area<2>);
  EXPECT_GT(other.l2_error(solve(other.system()).values), 1e-3);
}

TEST(StateBasedOperator, with_its_dilatation_kept_yields_the_same)
{
  const Square square(M_PI / 16, M_PI / 2, .5);
  for (const StateBasedProblem &problem :
       {varied(true), varied(false), interface_problem(.495), interface_crack_problem(.3)})
  {
    const StateBasedCase one(problem, square);
    const auto eliminated = solve(one.system()).values, whole = solve(one.system(true)).values;
    const std::vector<double> kept(whole.begin(), whole.begin() + eliminated.size());
    EXPECT_LT(largest_difference(eliminated, kept), 1e-12 * largest(kept));
  }
}

TEST(ScatteredNodes, yields_the_same_with_its_dilatation_kept)
{
  const auto solve = [](const std::string &dilatation)
  {
    const auto scene = solid_scene({{"Solver/dilatation", dilatation}});
    const auto all = methods();
    const auto method =
        std::find_if(all.begin(), all.end(), [](const auto &one) { return one->name() == "OPT"; });
    return analysis::solve(**method, make_problem(scene, 0, {.1, .25}));
  };
  const auto eliminated = solve("eliminated"), kept = solve("kept");
  EXPECT_LT(largest_difference(eliminated.nodal, kept.nodal), 1e-10 * largest(kept.nodal));
  EXPECT_LT(largest_difference(eliminated.averages, kept.averages), 1e-10 * largest(kept.nodal));
  const Point<2> x(.33, .71);
  EXPECT_NEAR(eliminated.value(x, 1), kept.value(x, 1), 1e-10 * largest(kept.nodal));
  EXPECT_EQ(eliminated.cost.n_unknowns, 200u);
  EXPECT_GT(kept.cost.n_unknowns, 300u); // dilatations in the collar too
}

TEST(ScatteredNodes, has_no_symmetric_operator_for_conjugate_gradients)
{
  const auto why_not = [](const scene::Scene &scene) {
    return methods().front()->why_not(make_problem(scene, 0, {.25, .5}));
  };
  const scene::Override cg{"Solver/iteration", "cg"};
  EXPECT_EQ(why_not(solid_scene({})), "");
  EXPECT_NE(why_not(solid_scene({cg})).find("harmonic means"), std::string::npos);
  EXPECT_NE(why_not(solid_scene({cg, {"Material/E", "1"}})).find("crack"), std::string::npos);
  const auto intact = solid_scene({cg, {"Material/E", "1"}, {"Domain/cracks", ""}});
  EXPECT_NE(why_not(intact).find("Solver/iteration = cg needs a symmetric operator, but on "
                                 "scattered nodes a bond has two weights"),
            std::string::npos);
}

TEST(Solver, iterations_and_dilatations_that_a_scene_cannot_have_are_refused)
{
  const auto refusal = [](std::vector<scene::Override> changes, bool is_lattice)
  {
    if (is_lattice)
      changes.insert(changes.end(), {{"Domain/mesh", "lattice"},
                                     {"Domain/cracks", ""},
                                     {"Material/E", "1"},
                                     {"Methods/perturbation", "0"}});
    return message_of([&] { (void)solid_scene(changes); });
  };
  const auto expect =
      [&](const std::vector<scene::Override> &changes, bool is_lattice, const std::string &words)
  {
    const std::string message = refusal(changes, is_lattice);
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  const scene::Override kept{"Solver/dilatation", "mixed"};
  EXPECT_EQ(refusal({{"Solver/iteration", "cg"}}, true), "");
  expect({{"Solver/iteration", "gmres"}}, true,
         "symmetric positive definite; write automatic or cg");
  EXPECT_EQ(refusal({{"Solver/iteration", "bicgstab"}}, false), "");
  expect({{"Solver/iteration", "bicgstab"}, {"Solver/linear solver", "direct"}}, false,
         "does not iterate");
  EXPECT_EQ(refusal({kept}, false), "");
  expect({kept}, true, "write condensed, or Domain/mesh = squares");
  EXPECT_EQ(refusal({kept, {"Solver/linear solver", "amg"}, {"Solver/iteration", "gmres"}}, false),
            "");
  expect({kept, {"Solver/linear solver", "jacobi"}}, false, "write Solver/linear solver = auto");
  expect({kept, {"Solver/iteration", "cg"}}, false, "automatic, gmres or bicgstab");
}

TEST(StateBasedOperator, shares_are_parts_of_the_whole)
{
  const Square square(M_PI / 8, M_PI / 2, .5);
  const auto problem = interface_crack_problem(.3);
  const StateBasedCase one(problem, square);
  const auto make = [&](std::size_t i, Family<2> &family) { one.families.make(i, family); };
  const auto whole = state_based_operator(make, one.body, {0, 64}),
             first = state_based_operator(make, one.body, {0, 23}),
             second = state_based_operator(make, one.body, {23, 64});
  for (const auto rows : {&method::PartitionedRows::free, &method::PartitionedRows::constrained})
  {
    const algebra::CsrMatrix &all = whole.rows.*rows;
    EXPECT_EQ((first.rows.*rows).column.size() + (second.rows.*rows).column.size(),
              all.column.size());
    for (std::size_t row = 0; row < all.n_rows(); ++row)
    {
      const algebra::CsrMatrix &part = (row < 46 ? first : second).rows.*rows;
      const std::size_t from = part.start[row];
      ASSERT_EQ(part.start[row + 1] - from, all.start[row + 1] - all.start[row]);
      for (std::size_t k = all.start[row]; k < all.start[row + 1]; ++k)
      {
        EXPECT_EQ(part.column[from + k - all.start[row]], all.column[k]);
        EXPECT_EQ(part.value[from + k - all.start[row]], all.value[k]);
      }
    }
  }
}

// One-point dilatations are those of an energy, so where both weights of a bond are one it is.
TEST(StateBasedOperator, is_symmetric_on_a_lattice_but_for_harmonic_means)
{
  const Square square(.125, .5, .5);
  const auto one_point = varied(false), two_point = varied(true);
  EXPECT_LT(symmetry_defect(StateBasedCase(one_point, square).system().rows), 1e-14);
  EXPECT_GT(symmetry_defect(StateBasedCase(two_point, square).system().rows), 1e-5);
}

TEST(Damage, breaks_the_bonds_that_cross_a_crack)
{
  using Ends = std::vector<std::array<int, 2>>;
  const Ends down = {{-1, -1}, {0, -2}, {0, -1}, {1, -1}};
  EXPECT_EQ(broken({Point<2>(-9, 0), Point<2>(9, 0)}), down);
  EXPECT_EQ(broken({Point<2>(-.9, 9), Point<2>(.2, .1), Point<2>(9, .2)}),
            (Ends{{-2, 0}, {-1, -1}, {-1, 0}, {-1, 1}, {0, -2}, {0, -1}, {1, -1}}));
  // from (½, ½) to (-½, -½) through the end of a crack, through a corner of it, and along it
  EXPECT_EQ(broken({Point<2>(-9, 0), Point<2>()}), Ends{});
  EXPECT_EQ(broken({Point<2>(), Point<2>(-9, 0)}), Ends{});
  EXPECT_EQ(broken({Point<2>(-9, 0), Point<2>(), Point<2>(9, 0)}), down);
  EXPECT_EQ(broken({Point<2>(-.25, -.25), Point<2>(.25, .25)}), Ends{});
  // a closed one around the node
  EXPECT_EQ(
      broken({Point<2>(0, 0), Point<2>(1, 0), Point<2>(1, 1), Point<2>(0, 1), Point<2>()}).size(),
      12u);
}

TEST(Damage, names_nodes_on_a_crack_ghosts_in_the_domain_and_isolated_nodes)
{
  const Square square(.25, 1, .5);
  const auto make = [&](const Damage &damage)
  {
    auto problem = quadratics[0];
    problem.damage = damage;
    return message_of([&] { (void)StateBasedCase(problem, square).system(); });
  };
  const std::string node = number_of_node(square, Point<2>(.125, .375));
  EXPECT_NE(make({{{Point<2>(-5, .375), Point<2>(5, .375)}}, {}}).find("move the crack"),
            std::string::npos);
  EXPECT_NE(make({{{Point<2>(0, 0), Point<2>(.125, .375)}}, {}}).find(node), std::string::npos);
  EXPECT_NE(make({{{Point<2>(0, 0), Point<2>(.2, .3), Point<2>(.2, .45), Point<2>(0, .45),
                    Point<2>(0, 0)}},
                  {}})
                .find("all bonds of " + node),
            std::string::npos);
  EXPECT_NE(make({{}, std::vector<char>(square.cells.size(), 1)})
                .find("lies in the domain and is a ghost"),
            std::string::npos);
  EXPECT_NE(make({{{Point<2>(0, 0)}}, {}}).find("crack 0"), std::string::npos);
  EXPECT_NE(make({{{Point<2>(0, 0), Point<2>(0, 0)}}, {}}).find("crack 0"), std::string::npos);
}

TEST(Damage, the_correction_makes_dilatations_of_linear_fields_exact)
{
  const Kernel<2> influence = physics::influence_function<2>({{1, -1}}, 1);
  const auto family = [](const std::vector<Point<2>> &ends)
  {
    Family<2> result;
    for (std::size_t k = 0; k < ends.size(); ++k)
      result.bonds.push_back({ends[k], .1 + .01 * k, ends[k], 1});
    return result;
  };
  // Σ w K ξ·M·(E ξ) = tr E
  const Family<2> spread =
      family({Point<2>(.5, .1), Point<2>(.3, -.6), Point<2>(-.2, -.4), Point<2>(.1, .9)});
  const std::vector<char> first_three = {1, 1, 1, 0};
  const Tensor<2, 2> M = remainder(influence, spread, first_three).correction;
  Tensor<2, 2> identity;
  for (unsigned int k = 0; k < 3; ++k)
  {
    const Point<2> &xi = spread.bonds[k].xi;
    identity += spread.bonds[k].weight * influence.radial(xi.norm()) * (M * outer_product(xi, xi));
  }
  EXPECT_NEAR(identity[0][0], 1, 1e-14);
  EXPECT_NEAR(identity[1][1], 1, 1e-14);
  EXPECT_NEAR(identity[0][1], 0, 1e-14);
  EXPECT_NEAR(identity[1][0], 0, 1e-14);

  // on a line: the stretch along it
  const Family<2> line = family({Point<2>(.3, .4), Point<2>(-.6, -.8)});
  const Remainder rest = remainder(influence, line, {1, 1});
  double theta = 0;
  for (const Bond<2> &bond : line.bonds)
    theta += bond.weight * influence.radial(bond.xi.norm()) *
             (bond.xi * (rest.correction * (2 * bond.xi)));
  EXPECT_NEAR(theta, 2, 1e-14);
  EXPECT_LT(Point<2>(rest.normal).distance(Point<2>(.6, .8)), 1e-14);

  // the normal is of the area that is left, whatever the kernel: -Σ w ξ, not along any one bond
  const Family<2> bent = family({Point<2>(.1, 0), Point<2>(.2, .3), Point<2>(0, .8)});
  const Point<2> inward(.10 * .1 + .11 * .2, .11 * .3 + .12 * .8);
  const Point<2> outward = -inward / inward.norm();
  EXPECT_LT(outward.distance(Point<2>(remainder(influence, bent, {1, 1, 1}).normal)), 1e-14);

  // no bonds; bonds missing on all sides alike
  EXPECT_EQ(remainder(influence, line, {0, 0}).correction.norm(), 0);
  Family<2> even = family({Point<2>(.5, .1), Point<2>(-.5, -.1)});
  even.bonds[1].weight = even.bonds[0].weight;
  EXPECT_EQ(remainder(influence, even, {1, 1}).normal.norm(), 0);
}
