// `plumbline check --boundary periodic`: right weights pass wherever the nodes lie in the box, and
// mistakes at its sides are named.

#include "check_command.h"

#include "base/number_text.h"
#include "meshfree/rules/rules.h"

#include <nlohmann/json.hpp>

#include <deal.II/base/point.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace
{
  using namespace plumbline;
  using namespace plumbline::app;
  using dealii::Point;
  using meshfree::Bond;

  constexpr int n = 15;
  constexpr double h = 1. / n;
  const std::string periodic = "--boundary periodic --set Study/h=1/15 ";

  struct Row
  {
    int i = 0, j = 0;
    double weight = 0;
    Point<2> kernel_point;
    std::array<bool, 2> crosses{}; ///< the sides in x and y
  };

  /// The weights of a rule on a torus of n x n nodes; node (a, b) at ((a + offset) h, (b + offset)
  /// h).
  struct Torus
  {
    std::vector<Point<2>> nodes;
    std::vector<Row> rows;

    explicit Torus(double offset, const std::string &rule = "IPA-AC-R2")
    {
      const auto kernel = physics::Kernel<2>::with_diffusion(
          physics::kernel_type("linear-decay").profile, 3 * h, .5);
      const auto family = lattice_bonds(meshfree::find_rule(rule, "rule").in_plane(kernel), kernel,
                                        h, geometry::Backend::fast)
                              .family;
      for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a)
        {
          nodes.emplace_back((a + offset) * h, (b + offset) * h);
          for (const Bond<2> &bond : family)
          {
            const int c = a + static_cast<int>(std::lround(bond.xi[0] / h)),
                      d = b + static_cast<int>(std::lround(bond.xi[1] / h));
            rows.push_back({b * n + a,
                            (d + n) % n * n + (c + n) % n,
                            bond.weight,
                            bond.kernel_point,
                            {c < 0 || c >= n, d < 0 || d >= n}});
          }
        }
    }

    void keep(const std::function<bool(const Row &)> &is_kept)
    {
      std::vector<Row> kept;
      std::copy_if(rows.begin(), rows.end(), std::back_inserter(kept), is_kept);
      rows = kept;
    }

    Outcome check(const std::string &options = "") const
    {
      std::string of_nodes = "id,x,y,volume\n", of_bonds = "i,j,weight,qx,qy\n";
      const auto text = [](double value) { return base::to_text(value, 15); };
      for (std::size_t k = 0; k < nodes.size(); ++k)
        of_nodes += std::to_string(k + 1) + ',' + text(nodes[k][0]) + ',' + text(nodes[k][1]) +
                    ',' + text(h * h) + '\n';
      for (const Row &row : rows)
        of_bonds += std::to_string(row.i + 1) + ',' + std::to_string(row.j + 1) + ',' +
                    text(row.weight) + ',' + text(row.kernel_point[0]) + ',' +
                    text(row.kernel_point[1]) + '\n';
      return plumbline::app::check(write("torus_nodes.csv", of_nodes),
                                   write("torus_bonds.csv", of_bonds), periodic + options);
    }
  };
} // namespace

TEST(CheckPeriodic, right_weights_pass_wherever_the_nodes_lie)
{
  for (const double offset : {.5, 0., .25, 1.}) // 1: on the upper sides
  {
    const Outcome outcome = Torus(offset).check("--require ac,symmetric");
    EXPECT_EQ(outcome.exit_code, 0) << offset << outcome.out << outcome.err;
    expect_found(outcome.out, "225 in the periodic box; volumes equal the cells' areas");
    expect_found(outcome.out, "the weights are those of IPA-AC-R2");
    expect_found(outcome.out, "second moments exact: asymptotically compatible (AC)");
  }
  const auto found = parse_json(Torus(0).check("--json").out);
  EXPECT_EQ(found["n_free"], 225);
  EXPECT_EQ(found["n_collar"], 0);
  EXPECT_EQ(found["n_bonds"], Torus(0).rows.size());
  EXPECT_EQ(found["symmetry"]["n_unpaired"], 0);
  EXPECT_TRUE(found["outliers"].empty() && found["causes"].empty());
}

// FA in a periodic box has the moments of FA in the interior of any other
TEST(CheckPeriodic, inexact_moments_are_those_of_the_rule)
{
  const Outcome outcome = Torus(.5, "FA").check();
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.out, "the weights are those of FA");
  const auto found = parse_json(Torus(.5, "FA").check("--json").out);
  double second = 0, exact = 0; // of C(r) = 1 - r/3 in units of h
  for (int a = -3; a <= 3; ++a)
    for (int b = -3; b <= 3; ++b)
      second += std::max(0., 1 - std::hypot(a, b) / 3) * a * a;
  exact = M_PI * (std::pow(3., 4) / 4 - std::pow(3., 4) / 5);
  EXPECT_NEAR(found["second_moment"]["mean_ratio"], second / exact, 1e-9);
}

TEST(CheckPeriodic, mistakes_at_the_sides_are_named)
{
  Torus open(.5);
  open.keep([](const Row &row) { return !row.crosses[0] && !row.crosses[1]; });
  Outcome outcome = open.check();
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.out, "cause: no bond crosses the sides of the periodic box in x and y: "
                            "the code finds neighbours without nearest images");
  Torus strip(.5);
  strip.keep([](const Row &row) { return !row.crosses[1]; });
  expect_found(strip.check().out, "no bond crosses the sides of the periodic box in y: ");

  Torus one_way(.5); // bonds to the right and up alone wrap
  one_way.keep([](const Row &row)
               { return !(row.crosses[0] && row.kernel_point[0] < 0 && row.i % n == 0); });
  outcome = one_way.check("--require symmetric");
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.out, "bonds without a partner");

  Torus twice(.5); // one bond across a side
  const auto wrong = std::find_if(twice.rows.begin(), twice.rows.end(),
                                  [](const Row &row) { return row.crosses[0]; });
  wrong->weight *= 2;
  outcome = twice.check();
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.out, "outlier: the bond from node " + std::to_string(wrong->i + 1) +
                                " to node " + std::to_string(wrong->j + 1));

  Torus half(.5);
  half.keep([](const Row &row) { return row.i < row.j; });
  outcome = half.check();
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.out, "a half list");
  Torus doubled(0);
  for (Row &row : doubled.rows)
    row.weight *= 2;
  expect_found(doubled.check().out, "all weights are twice too large");
}

// weights for m = 3 and a scene with m = 2: no cause is named in vain
TEST(CheckPeriodic, bonds_beyond_the_horizon_are_doubted)
{
  const Outcome outcome = Torus(.5, "FA").check("--set Study/m=2");
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.out, "the longest bond is ");
  expect_found(outcome.out, "give the h and the horizon of your bonds");
}

TEST(CheckPeriodic, what_is_no_periodic_box_is_refused)
{
  const auto expect_refused = [](const Outcome &outcome, const std::string &words)
  {
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    expect_found(outcome.err, words);
    EXPECT_EQ(outcome.out, "");
  };
  Torus ghosts(.5);
  ghosts.nodes.emplace_back(-h / 2, h / 2);
  expect_refused(ghosts.check(),
                 "node 226 at (-0.0333333, 0.0333333) lies outside of the periodic box "
                 "from (0, 0) to (1, 1); give each node once, inside of the box, "
                 "and leave out ghost nodes");
  Torus far(.5);
  for (Point<2> &x : far.nodes)
    x += Point<2>(100, -50);
  const std::string box = "--set 'Domain/boxes=100, -50 : 101, -49' ";
  EXPECT_EQ(far.check(box).exit_code, 0);
  far.nodes[0][0] -= h;
  expect_refused(far.check(box), "node 1 at (99.9667, -49.9667) lies outside of the periodic box "
                                 "from (100, -50) to (101, -49)");
  expect_refused(run("check " + write("alone.csv", "id,x,y,volume\n1,.5,.5,.0625\n") + " " +
                     bonds_file + " --scene " + scene_file),
                 "none of the 1 nodes lies in the interaction domain around the domain");
  Torus closed(0); // as by linspace with both ends
  closed.nodes.emplace_back(1, h);
  expect_refused(closed.check(), "node 226 is node 16 or its image on the opposite side");
  expect_refused(Torus(.5).check("--set Study/m=6.5"),
                 "the periodic box is 1 long in x, no more than "
                 "2 (horizon + h) = 1");
  expect_refused(Torus(.5).check("--crack '.3,.5 : .7,.5'"), "cracks in a periodic box");
  expect_refused(Torus(.5).check("--set 'Domain/holes=0.2, 0.2 : 0.4, 0.4'"),
                 "a periodic domain is one box without holes");
  expect_refused(run("check " + nodes_file + " " + bonds_file + " --scene " + scene_file +
                     " --boundary torus"),
                 "--boundary = 'torus' is not known; choose one of 'constrained'");
  expect_refused(run("check " + nodes_file + " " + bonds_file + " --scene " + scene_file +
                     " --set Domain/boundary=periodic"),
                 "Domain/boundary = periodic; write constrained, and give --boundary periodic");
}
