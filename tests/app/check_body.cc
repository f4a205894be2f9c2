// `plumbline check` of bodies with free surfaces and cracks: right weights pass, and mistakes near
// surfaces are named.

#include "given_files.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>

namespace
{
  using namespace plumbline::app;
  using std::size_t;

  constexpr double h = .0625;
  const std::string free_boundary = "--boundary free";
  const std::string crack = "--crack '.3,.5 : .7,.5'";

  /// The weights of a rule on the unit square; without the nodes around it bonds to them are left
  /// out, as codes do at free surfaces.
  struct Body
  {
    std::vector<Point<2>> nodes;
    size_t n_free = 0;
    std::vector<std::map<size_t, Bond<2>>> families;

    explicit Body(bool is_free = true, const std::string &rule = "IPA-AC-R2",
                  double perturbation = 0, const std::vector<plumbline::scene::Override> &more = {})
    {
      std::vector<plumbline::scene::Override> overrides = more;
      overrides.push_back({"Study/h", "0.0625"});
      const Weights weights = example_weights(rule, perturbation, overrides);
      nodes = weights.problem.cells()->nodes;
      n_free = weights.families.size();
      if (is_free)
        nodes.resize(n_free);
      for (const Family<2> &family : weights.families)
      {
        families.emplace_back();
        for (size_t k = 0; k < family.bonds.size(); ++k)
          if (family.neighbours[k] < nodes.size())
            families.back()[family.neighbours[k]] = family.bonds[k];
      }
    }

    size_t at(double x, double y) const
    {
      for (size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].distance(Point<2>(x, y)) < .1 * h)
          return i;
      throw std::logic_error("no node there");
    }

    template <class Factor>
    void multiply(const Factor &factor)
    {
      for (size_t i = 0; i < families.size(); ++i)
        for (auto &[j, bond] : families[i])
          bond.weight *= factor(i, j);
    }

    /// Without bonds that cross y = .5 between two places.
    void cut(double from, double to)
    {
      for (size_t i = 0; i < families.size(); ++i)
        for (auto bond = families[i].begin(); bond != families[i].end();)
        {
          const Point<2> &p = nodes[i], &q = nodes[bond->first];
          const double t = (.5 - p[1]) / (q[1] - p[1]), x = p[0] + t * (q[0] - p[0]);
          bond = t > 0 && t < 1 && x > from && x < to ? families[i].erase(bond) : std::next(bond);
        }
    }

    void remove(size_t i, size_t j)
    {
      families[i].erase(j);
      families[j].erase(i);
    }

    std::vector<double> sums(const std::function<double(const Bond<2> &)> &of) const
    {
      std::vector<double> result;
      for (const auto &family : families)
      {
        result.push_back(0);
        for (const auto &[j, bond] : family)
          result.back() += of(bond);
      }
      return result;
    }

    Outcome check(const std::string &options) const
    {
      std::ostringstream of_nodes, of_bonds;
      of_nodes.precision(15);
      of_bonds.precision(15);
      of_nodes << "id,x,y,volume\n";
      of_bonds << "i,j,weight,qx,qy\n";
      for (size_t i = 0; i < nodes.size(); ++i)
        of_nodes << i + 1 << ',' << nodes[i][0] << ',' << nodes[i][1] << ',' << h * h << '\n';
      for (size_t i = 0; i < families.size(); ++i)
        for (const auto &[j, bond] : families[i])
          of_bonds << i + 1 << ',' << j + 1 << ',' << bond.weight << ',' << bond.kernel_point[0]
                   << ',' << bond.kernel_point[1] << '\n';
      return plumbline::app::check(write("body_nodes.csv", of_nodes.str()),
                                   write("body_bonds.csv", of_bonds.str()), options);
    }
  };

  nlohmann::json families_of(const nlohmann::json &found, const std::string &cut)
  {
    for (const auto &one : found["body"]["families"])
      if (one["cut"] == cut)
        return one;
    return {};
  }

  std::string name(size_t i, size_t j)
  {
    return std::to_string(std::min(i, j) + 1) + " and " + std::to_string(std::max(i, j) + 1);
  }
} // namespace

TEST(CheckBody, right_weights_pass_and_the_surface_effect_is_told)
{
  const Outcome outcome = Body().check(free_boundary);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  expect_found(outcome.out, "256 free, 0 in the interaction domain");
  expect_found(outcome.out, "no surface correction: bonds near free surfaces and cracks have the "
                            "weights of the interior");
  expect_found(outcome.out, "surface effect (156 families near surfaces; relative to the bulk");
  expect_found(outcome.out, "interior: second moments exact: asymptotically compatible");
  const auto found = parse_json(Body().check(free_boundary + " --json").out);
  EXPECT_EQ(found["n_free"], 256);
  EXPECT_EQ(found["body"]["n_families"], 256);
  EXPECT_TRUE(found["rule"]["name"] == "IPA-AC-R2" && found["body"]["missing"].empty());
  EXPECT_TRUE(found["outliers"].empty() && found["causes"].empty());
  const auto whole = families_of(found, "none"), cut = families_of(found, "surface");
  EXPECT_EQ(whole["n"], 100); // 10 x 10 nodes are 3 h away
  EXPECT_LT(whole["second_moments"]["worst"]["value"], 1e-10);
  EXPECT_NEAR(whole["weights_over_bulk"]["least"], 1, 1e-10);
  // a corner's ball: a fourth, and what the half cells beyond the node add
  EXPECT_GT(cut["visible_over_bulk"]["least"], .25);
  EXPECT_LT(cut["visible_over_bulk"]["least"], .6);
  EXPECT_NEAR(cut["weights_over_bulk"]["median"], cut["visible_over_bulk"]["median"], .05);
  EXPECT_LT(cut["second_moments"]["worst"]["value"], .1);
}

TEST(CheckBody, the_visible_part_is_integrated_exactly)
{
  // C = c(r) of linear decay; at distance d of a straight surface the trace of the second moments
  // is ∫∫ c r³ over the ball without its cap
  const Body body;
  const double delta = 3 * h, d = .5 * h;
  double cap = 0, ball = 0;
  constexpr int n = 4000;
  for (int k = 0; k < n; ++k)
  {
    const double r = delta * (k + .5) / n, c = (1 - r / delta) * r * r * r;
    ball += c * 2 * M_PI;
    cap += r > d ? c * 2 * std::acos(d / r) : 0;
  }
  const auto found = parse_json(body.check(free_boundary + " --json").out);
  const auto cut = families_of(found, "surface");
  // the corner: both caps, less twice their overlap's part; here by symmetry of axis and corner
  double overlap = 0;
  for (int k = 0; k < n; ++k)
  {
    const double r = delta * (k + .5) / n, c = (1 - r / delta) * r * r * r;
    if (r > d * std::sqrt(2.))
      overlap += c * std::max(0., 2 * std::acos(d / r) - M_PI / 2);
  }
  EXPECT_NEAR(cut["visible_over_bulk"]["least"], 1 - (2 * cap - overlap) / ball, 1e-4);
}

TEST(CheckBody, the_volume_correction_is_named)
{
  for (const bool is_partial : {true, false})
  {
    Body body;
    std::vector<double> V =
        body.sums([&](const Bond<2> &bond) { return is_partial ? bond.weight : h * h; });
    const double V0 = V[body.at(.5 + h / 2, .5 + h / 2)];
    body.multiply([&](size_t i, size_t j) { return 2 * V0 / (V[i] + V[j]); });
    const Outcome outcome = body.check(free_boundary);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    expect_found(outcome.out, "weights are multiplied by 2V0/(Vi+Vj): volume correction");
    expect_found(outcome.out, is_partial ? "V is the sum of the neighbours' partial volumes;"
                                         : "V is the sum of the neighbours' volumes;");
    const auto found = parse_json(body.check(free_boundary + " --json").out);
    EXPECT_EQ(found["body"]["correction"]["name"], "volume");
    EXPECT_LT(found["body"]["correction"]["difference_after"], 1e-10);
    const auto cut = families_of(found, "surface");
    EXPECT_GT(cut["weights_over_bulk"]["median"],
              1.05 * cut["visible_over_bulk"]["median"].get<double>());
    EXPECT_LT(cut["second_moments"]["worst"]["value"], .1); // with the correction undone
    EXPECT_EQ(body.check(free_boundary + " --quiet --require symmetric").exit_code, 0);
  }
  Body half; // of a code that forgot the 2
  const std::vector<double> V = half.sums([](const Bond<2> &bond) { return bond.weight; });
  const double V0 = V[half.at(.5 + h / 2, .5 + h / 2)];
  half.multiply([&](size_t i, size_t j) { return V0 / (V[i] + V[j]); });
  const Outcome outcome = half.check(free_boundary);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
  expect_found(outcome.out, "half"); // the factor of all weights
}

// a crack across a small body: no family of a whole ball has such neighbours only
TEST(CheckBody, the_volume_correction_is_named_where_it_changes_all_weights)
{
  Body body(true, "FA");
  body.cut(.3, .7);
  const std::vector<double> V = body.sums([](const Bond<2> &) { return h * h; });
  const double V0 = *std::max_element(V.begin(), V.end());
  body.multiply([&](size_t i, size_t j) { return 2 * V0 / (V[i] + V[j]); });
  const Outcome outcome = body.check(free_boundary + " " + crack + " --require moments=0.3");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  expect_found(outcome.out, "volume correction (Le & Bobaru 2018), where V is the sum of the "
                            "neighbours' volumes;");
  expect_found(outcome.out, "interior: the weights are those of FA");
}

TEST(CheckBody, families_scaled_to_the_full_ball_are_a_mistake)
{
  Body body;
  const std::vector<double> V = body.sums([](const Bond<2> &bond) { return bond.weight; });
  const double V0 = V[body.at(.5 + h / 2, .5 + h / 2)];
  body.multiply([&](size_t i, size_t) { return V0 / V[i]; });
  const Outcome outcome = body.check(free_boundary);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out, "cause: weights are multiplied by V0/Vi, where V is the sum of the "
                            "neighbours' partial volumes: families near free surfaces and cracks "
                            "are normalised to the full ball");
  expect_found(outcome.out, "\nNOT as required");
  const Outcome symmetric = body.check(free_boundary + " --require symmetric");
  expect_found(symmetric.out, "required symmetric: w C of a pair differs from end to end");
}

TEST(CheckBody, missing_bonds_at_a_free_surface_are_named)
{
  Body body;
  const size_t i = body.at(h / 2, .5 + h / 2), j = body.at(3 * h / 2, .5 + h / 2);
  body.remove(i, j);
  const Outcome outcome = body.check(free_boundary);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out, "1 pair of nodes has no bond, though no crack is between them and like "
                            "pairs in the interior have one: " +
                                name(i, j));
}

TEST(CheckBody, a_wrong_weight_at_a_free_surface_is_named)
{
  Body body;
  const size_t i = body.at(h / 2, .5 + h / 2), j = body.at(3 * h / 2, .5 + h / 2);
  body.families[i][j].weight *= 2;
  const Outcome outcome = body.check(free_boundary);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out, "outlier: the bond from node " + std::to_string(i + 1) + " to node " +
                                std::to_string(j + 1) +
                                " has 2 times the weight of like bonds in the interior");
}

TEST(CheckBody, families_of_full_balls_at_a_surface_are_off)
{
  // moments of each family made exact for the ball, direction by direction: no common factor
  Body body;
  body.multiply(
      [&](size_t i, size_t j)
      {
        return std::abs(body.nodes[j][0] - body.nodes[i][0]) > h / 2 &&
                       std::min(body.nodes[i][0], 1 - body.nodes[i][0]) < h
                   ? 2.
                   : 1.;
      });
  const Outcome outcome = body.check(free_boundary);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out, "required ac: near surfaces second moments are off those of the "
                            "visible part by ");
  expect_found(outcome.out, "more than h/horizon = 33.3 %");
}

TEST(CheckBody, bonds_across_a_crack_are_named)
{
  for (const bool is_free : {true, false})
  {
    const std::string options = crack + (is_free ? " " + free_boundary : "");
    Body body(is_free);
    const size_t i = body.at(.5 + h / 2, .5 - h / 2), j = body.at(.5 + h / 2, .5 + h / 2);
    const Bond<2> bond = body.families[i][j];
    const Outcome whole = body.check(options);
    EXPECT_EQ(whole.exit_code, 1) << whole.err;
    expect_found(whole.out, "pairs of nodes have bonds across a crack, which must be absent: ");
    body.cut(.3, .7);
    const Outcome right = body.check(options);
    EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
    expect_found(right.out, "effect of cracks (");
    body.families[i][j] = bond;
    const Outcome wrong = body.check(options);
    EXPECT_EQ(wrong.exit_code, 1) << wrong.err;
    expect_found(wrong.out,
                 "1 pair of nodes has bonds across a crack, which must be absent: " + name(i, j));
  }
}

TEST(CheckBody, bonds_removed_beyond_a_crack_are_named)
{
  Body body(false);
  body.cut(.3, .85); // the crack ends at .7
  const Outcome outcome = body.check(crack);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out, "pairs of nodes have no bond, though no crack is between them");
  const auto found = parse_json(body.check(crack + " --json").out);
  EXPECT_TRUE(found["body"]["crossing"].empty());
  EXPECT_GT(found["body"]["missing"].size(), 10u);
}

TEST(CheckBody, bonds_through_the_end_of_a_crack_may_be_there_or_not)
{
  const std::string at_bond = "--crack '.3125,.5 : .7,.5'"; // halfway between two columns
  Body body(false);
  const size_t i = body.at(.3125 - h / 2, .5 - h / 2), j = body.at(.3125 + h / 2, .5 + h / 2);
  body.cut(.3126, .7);
  ASSERT_TRUE(body.families[i].count(j) > 0);
  EXPECT_EQ(body.check(at_bond + " --quiet").exit_code, 0);
  body.cut(.3124, .7);
  ASSERT_FALSE(body.families[i].count(j) > 0);
  const Outcome without = body.check(at_bond);
  EXPECT_EQ(without.exit_code, 0) << without.out;
  expect_found(without.out, "touch the end of a crack and may have a bond or not");
}

TEST(CheckBody, solids_are_softer_at_surfaces)
{
  const std::vector<plumbline::scene::Override> solid = {
      {"Kernel/type", "bond-tensor"}, {"Kernel/limit", "Navier"}, {"Problem/solution", "x, y"}};
  const std::string options = free_boundary +
                              " --set Kernel/type=bond-tensor --set Kernel/limit=Navier --set "
                              "'Problem/solution=x, y' --require moments=0.4 ";
  const Body body(true, "FA", 0, solid);
  const Outcome outcome = body.check(options);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  expect_found(outcome.out, "; E, plane stress: ");
  const auto found = parse_json(body.check(options + "--json").out);
  const auto elastic = [&](const std::string &cut)
  { return families_of(found, cut)["elastic"]["E, plane stress"]["median"].get<double>(); };
  EXPECT_LT(elastic("surface"), .95 * elastic("none"));
  EXPECT_GT(elastic("surface"), .4 * elastic("none"));
  EXPECT_LT(families_of(found, "surface")["second_moments"]["median"], .15);
}

// factors as Madenci & Oterkus 2014, sec. 4.2, by sums over the bonds that there are
TEST(CheckBody, corrections_by_uniaxial_strains_are_named)
{
  const std::string solid = " --set Kernel/type=bond-tensor --set Kernel/limit=Navier --set "
                            "'Problem/solution=x, y' --require moments=0.4 ";
  for (const auto &[name, power] : {std::pair("force density", 3), std::pair("energy", 4)})
  {
    Body body(
        true, "FA", 0,
        {{"Kernel/type", "bond-tensor"}, {"Kernel/limit", "Navier"}, {"Problem/solution", "x, y"}});
    std::array<std::vector<double>, 2> sums; // of c d_a^power / r², c = 1/r
    for (unsigned int a = 0; a < 2; ++a)
      sums[a] = body.sums(
          [&, p = power](const Bond<2> &bond) {
            return bond.weight * std::pow(std::abs(bond.xi[a]), p) / std::pow(bond.xi.norm(), 3);
          });
    const size_t inner = body.at(.5 + h / 2, .5 + h / 2);
    body.multiply(
        [&](size_t i, size_t j)
        {
          const auto d = body.nodes[j] - body.nodes[i];
          double sum = 0;
          for (unsigned int a = 0; a < 2; ++a)
            sum += std::pow(
                d[a] / d.norm() / (.5 * sums[a][inner] * (1 / sums[a][i] + 1 / sums[a][j])), 2);
          return 1 / std::sqrt(sum);
        });
    const Outcome outcome = body.check(free_boundary + solid);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    expect_found(outcome.out, std::string("the surface correction by the ") + name +
                                  " method (Le & Bobaru 2018)");
    const auto found = parse_json(body.check(free_boundary + solid + "--json").out);
    EXPECT_EQ(found["body"]["correction"]["name"], name);
    EXPECT_LT(found["body"]["correction"]["difference_after"], 1e-10);
  }
}

TEST(CheckBody, scattered_nodes_are_compared_by_length)
{
  Body body(true, "FA", .1, {{"Kernel/type", "constant"}});
  for (auto &family : body.families)
    for (auto &[j, bond] : family)
      bond.weight = h * h; // all nodes have this volume
  const std::string options =
      free_boundary + " --set Kernel/type=constant --require moments=0.9 --json";
  const auto right = parse_json(body.check(options).out);
  EXPECT_TRUE(right["body"]["missing"].empty()) << right["body"]["missing"];
  EXPECT_EQ(right["body"]["correction"]["name"], "none");
  EXPECT_TRUE(right["body"]["different"].empty());
  // V0 is that of the ball, and V of no two families alike
  const std::vector<double> V = body.sums([](const Bond<2> &) { return h * h; });
  body.multiply([&](size_t i, size_t j) { return 2 * M_PI * 9 * h * h / (V[i] + V[j]); });
  const auto corrected = parse_json(body.check(options).out);
  EXPECT_EQ(corrected["body"]["correction"]["name"], "volume");
  EXPECT_EQ(corrected["body"]["correction"]["volume"], "the sum of the neighbours' volumes");
  EXPECT_LT(corrected["body"]["correction"]["difference_after"], 1e-9);
}

TEST(CheckBody, a_mesh_of_the_body_is_the_same_body)
{
  const Body body;
  const auto of_box = parse_json(body.check(free_boundary + " " + crack + " --json").out),
             of_mesh = parse_json(
                 body.check(free_boundary + " " + crack + " --json --set Domain/mesh=triangles")
                     .out);
  for (const std::string cut : {"surface", "crack"})
    for (const std::string part : {"first_moments", "second_moments", "visible_over_bulk"})
      EXPECT_NEAR(families_of(of_box, cut)[part]["median"],
                  families_of(of_mesh, cut)[part]["median"], 1e-9)
          << cut << part;
}

TEST(CheckBody, a_half_list_is_the_one_cause)
{
  Body body;
  for (size_t i = 0; i < body.families.size(); ++i)
    body.families[i].erase(body.families[i].begin(), body.families[i].upper_bound(i));
  const Outcome outcome = body.check(free_boundary);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out,
               "interior: cause: each pair of nodes is listed only once (a half list)");
  EXPECT_EQ(outcome.out.find("near surfaces second"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("no bond"), std::string::npos);
}

TEST(CheckBody, bad_input_is_refused)
{
  const Body body;
  const auto refuse = [&](const std::string &options, const std::string &message)
  {
    const Outcome outcome = body.check(options);
    EXPECT_EQ(outcome.exit_code, 2) << options << outcome.out;
    expect_found(outcome.err, message);
  };
  refuse("--boundary open", "--boundary = 'open' is not known; choose one of 'constrained'");
  refuse("--crack ''", "--crack: '' has no points; give 'x0, y0 : x1, y1', or leave it out");
  refuse(free_boundary + " --crack '30,50 : 70,50'",
         "--crack: crack 0 is farther than the horizon from all nodes");
  refuse("--crack .3,.5", "--crack: '.3,.5' is not allowed; write lines 'x0, y0 : x1, y1'");
  refuse(free_boundary + " --crack '.3,.5 : .3,.5'",
         "--crack: crack 0 has its points 0 and 1 in one place");
  const size_t i = body.at(.5 + h / 2, .5 + h / 2);
  refuse(free_boundary + " --crack '.3,.53125 : .7,.53125'", "--crack: crack 0 goes through node ");
  refuse(free_boundary + " --crack '.5,.53125 : .54,.53125'",
         "goes through node " + std::to_string(i + 1));
  refuse(free_boundary + " --set Study/m=9", "no node is a horizon away from free surfaces");
  refuse(free_boundary + " --set Domain/dimension=3", "Domain/");
  const Outcome series = check("'a_{h}.csv'", "'b_{h}.csv'", crack);
  EXPECT_EQ(series.exit_code, 2);
  expect_found(series.err, "--crack is for the files of one level; give names without {h}");
  // constrained nodes do not belong to a body
  const Outcome around = Body(false).check(free_boundary);
  EXPECT_EQ(around.exit_code, 2) << around.out;
  expect_found(around.err, "lies outside the domain");
}
