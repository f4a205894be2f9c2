// `plumbline check` as a user meets it: exit codes, messages, and the worked example.

#include "command.h"

#include "../meshfree/given_bonds.h"

#include "meshfree/families.h"
#include "meshfree/rules.h"
#include "scene/problem.h"

#include <algorithm>
#include <functional>

namespace
{
  using namespace plumbline::app;

  const fs::path folder = fs::path(PLUMBLINE_SCENES) / "check";
  const std::string nodes_file = (folder / "nodes.csv").string(),
                    bonds_file = (folder / "bonds.csv").string(),
                    scene_file = (folder / "check.prm").string();

  Outcome check(const std::string &nodes, const std::string &bonds, const std::string &more = "")
  {
    // files go where they are told to, or nowhere
    const bool is_silent =
        more.find("--json") != std::string::npos || more.find("--quiet") != std::string::npos;
    const std::string output = is_silent || more.find("-o ") != std::string::npos
                                   ? ""
                                   : " -o " + temporary("check").string();
    return run("check " + nodes + " " + bonds + " --scene " + scene_file + " " + more + output);
  }

  /// A text with one occurrence of a part replaced.
  std::string replace(std::string text, const std::string &part, const std::string &by)
  {
    const auto at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    return text.replace(at, part.size(), by);
  }

  void expect_refusal(const std::string &nodes, const std::string &bonds,
                      const std::vector<std::string> &fragments)
  {
    const Outcome outcome = check(nodes, bonds);
    EXPECT_EQ(outcome.exit_code, 2) << fragments[0];
    EXPECT_EQ(outcome.out, "");
    for (const std::string &fragment : fragments)
      expect_found(outcome.err, fragment);
  }
} // namespace

TEST(Check, finds_the_good_example_good)
{
  const Outcome outcome = check(nodes_file, bonds_file);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  expect_found(outcome.out, "64 free, 132 in the collar");
  expect_found(outcome.out, "m = 3: h = 0.125, horizon = 0.375");
  expect_found(outcome.out, "reproduces polynomials up to degree 3");
  expect_found(outcome.out, "second moments exact: asymptotically compatible");
  expect_found(outcome.out, "\npositive definite");
  expect_found(outcome.out, "averages L2 | reference");
  expect_found(outcome.out, "the weights are those of IPA-AC-R2");
  expect_found(outcome.out, "\nas required\n");
}

TEST(Check, names_the_node_with_the_wrong_weight)
{
  const std::string bonds = (folder / "bonds_wrong.csv").string();
  const Outcome outcome = check(nodes_file, bonds);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out, "first moments off by up to 4.23 % at node 77");
  expect_found(outcome.out, "out of line: the bond from node 77 to node 79 (line ");
  expect_found(outcome.out, "is expected: 2 times\n");

  const Outcome json = check(nodes_file, bonds, "--json");
  EXPECT_EQ(json.exit_code, 1);
  EXPECT_EQ(json.out.front(), '{');
  expect_found(json.out, "\"exit_code\": 1");
  const Outcome quiet = check(nodes_file, bonds, "--quiet");
  EXPECT_EQ(quiet.exit_code, 1);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST(Check, its_example_is_what_the_library_makes)
{
  using namespace plumbline;
  auto scene = scene::read_scene(scene_file);
  scene.mesh.kind = "squares";
  scene.nodes.kind = nodes_file;
  const auto problem = scene::make_problem(scene, 0, scene.series[0].levels[0]);
  const meshfree::Families families(meshfree::recalibrated(problem.kernel, 2), problem.kernel,
                                    *problem.cells, meshfree::Backend::fast);
  meshfree::Family family;
  std::ifstream good(bonds_file), wrong(folder / "bonds_wrong.csv");
  std::string row, wrong_row;
  std::getline(good, row);
  std::getline(wrong, wrong_row);
  EXPECT_EQ(row, "i,j,weight,qx,qy");
  EXPECT_EQ(row, wrong_row);
  for (std::size_t i = 0; i < families.size(); ++i)
  {
    families.make(i, family);
    for (std::size_t k = 0; k < family.bonds.size(); ++k)
    {
      const meshfree::Bond &bond = family.bonds[k];
      const std::size_t from = problem.cells->source[i] + 1,
                        to = problem.cells->source[family.neighbours[k]] + 1;
      ASSERT_TRUE(std::getline(good, row));
      std::istringstream in(row);
      std::size_t first = 0, second = 0;
      double weight = 0, qx = bond.xi[0], qy = bond.xi[1];
      char comma = 0;
      in >> first >> comma >> second >> comma >> weight >> comma;
      if (row.compare(row.size() - 2, 2, ",,") != 0)
        in >> qx >> comma >> qy;
      EXPECT_EQ(first, from);
      EXPECT_EQ(second, to);
      EXPECT_NEAR(weight, bond.weight, 1e-12);
      EXPECT_NEAR(qx, bond.kernel_point[0], 1e-12);
      EXPECT_NEAR(qy, bond.kernel_point[1], 1e-12);

      ASSERT_TRUE(std::getline(wrong, wrong_row));
      EXPECT_EQ(row == wrong_row, from != 77 || to != 79);
    }
  }
  EXPECT_FALSE(std::getline(good, row));
  EXPECT_FALSE(std::getline(wrong, wrong_row));
}

TEST(Check, says_how_wrong_the_limit_is)
{
  // all weights 20 % too large: the solution tends to 1 / 1.2 of the right one
  std::ifstream in(bonds_file);
  std::string text, row;
  std::getline(in, row);
  text = row + '\n';
  while (std::getline(in, row))
  {
    const auto from = row.find(',', row.find(',') + 1) + 1, to = row.find(',', from);
    std::ostringstream weight;
    weight.precision(15);
    weight << 1.2 * std::stod(row.substr(from, to - from));
    text += row.substr(0, from) + weight.str() + row.substr(to) + '\n';
  }
  const Outcome outcome = check(nodes_file, write("scaled.csv", text));
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out, "cause: all weights carry a common factor of 1.2; without that the "
                            "moments are off by nothing instead of 20 %");
  expect_found(outcome.out, "second moments off by 20 % on average (worst 20 % at node");
  expect_found(outcome.out, "tends to a wrong limit, off by about 16.7 %");
}

TEST(Check, a_matrix_that_is_not_definite_is_wrong)
{
  // node 77 pushed away from all its neighbours
  std::ifstream in(bonds_file);
  std::string text, row;
  while (std::getline(in, row))
    text += (row.compare(0, 3, "77,") == 0 ? replace(row, ",0.", ",-0.") : row) + '\n';
  const Outcome outcome = check(nodes_file, write("indefinite.csv", text));
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out, "NOT positive definite");
  expect_found(outcome.out, "second moments are off by 200 % at node 77");
}

TEST(Check, refuses_nodes_that_cannot_be_used)
{
  const std::string text = read(nodes_file), node = "1,-0.3125,-0.3125,0.015625\n";
  const auto refuse = [&](const std::string &by, const std::vector<std::string> &fragments)
  { expect_refusal(write("nodes.csv", replace(text, node, by)), bonds_file, fragments); };
  refuse("1,-0.3125,here,0.015625\n", {"nodes.csv', line 2: y = 'here' is not a finite number"});
  refuse("1,nan,-0.3125,0.015625\n", {"line 2: x = 'nan' is not a finite number"});
  refuse("1.5,-0.3125,-0.3125,0.015625\n", {"line 2: id = '1.5' is not an integer"});
  refuse("1,-0.3125,-0.3125,0\n", {"line 2: the volume", "of node 1 is not positive; give"});
  refuse("1,-0.3125\n", {"line 2: y = '' is not a finite number"});
  refuse("2,-0.3125,-0.3125,0.015625\n", {"line 3: id 2 is that of line 2 already; give"});
  refuse("1,-0.1875,-0.3125,0.015625\n",
         {"line 3: node 2 lies at (-0.1875, -0.3125), where that of line 2 is; take"});
  refuse("1,-0.3125,-0.4125,0.015625\n",
         {"line 2: node 1 at (-0.3125, -0.4125) lies outside of the domain and its collar at the "
          "level m = 3: h = 0.125, horizon = 0.375; take"});
  expect_refusal(write("nodes.csv", replace(text, "volume", "area")), bonds_file,
                 {"has no column volume in its first line 'id,x,y,area'"});
  expect_refusal(write("nodes.csv", "id,x,y,volume\n1,7,7,1\n"), bonds_file,
                 {"none of the 1 nodes lies in the domain"});
  expect_refusal("no_such_nodes.csv", bonds_file, {"'no_such_nodes.csv' cannot be read; check"});
}

TEST(Check, refuses_bonds_that_cannot_be_used)
{
  const std::string text = read(bonds_file), bond = "46,47,0.01482832303132,,\n";
  const auto refuse = [&](const std::string &by, const std::vector<std::string> &fragments)
  { expect_refusal(nodes_file, write("bonds.csv", replace(text, bond, by)), fragments); };
  refuse("46,47,heavy,,\n", {"bonds.csv', line 2: weight = 'heavy' is not a finite number"});
  refuse("46,47,nan,,\n", {"line 2: weight = 'nan' is not a finite number"});
  refuse("46,47,inf,,\n", {"line 2: weight = 'inf' is not a finite number"});
  refuse("46,47,.01,.1,\n", {"line 2: qy = '' is not a finite number"});
  refuse("46,470,.01,,\n", {"line 2: j = 470 is no node of", "nodes.csv'; take"});
  refuse("0,47,.01,,\n", {"line 2: i = 0 is no node of"});
  refuse("46,46,.01,,\n", {"line 2: a bond of node 46 with itself; take it out"});
  refuse(bond + bond, {"line 3: the bond from node 46 to node 47 is that of line 2 already; take"});
  refuse("46,47,.01,0,0\n", {"line 2: the kernel point (qx, qy) is 0"});
  expect_refusal(nodes_file, write("bonds.csv", replace(text, "qy", "qz")),
                 {"line 1: one of the columns qx and qy is missing; give both or none"});
  expect_refusal(nodes_file, write("bonds.csv", replace(text, "weight", "w")),
                 {"has no column weight in its first line 'i,j,w,qx,qy'"});
  expect_refusal(nodes_file, write("bonds.csv", "i,j,weight\n46,47,.1\n"),
                 {"nodes.csv', line 48: node 47 lies in the domain but has no bonds in"});
  expect_refusal(nodes_file, "no_such_bonds.csv", {"'no_such_bonds.csv' cannot be read; check"});
}

TEST(Check, counts_the_bonds_of_collar_nodes_that_it_ignores)
{
  const Outcome outcome =
      check(nodes_file, write("collar.csv", read(bonds_file) + "1,2,.01,,\n1,46,-5,,\n"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "2 of collar nodes ignored");
}

TEST(Check, refuses_a_reference_that_is_no_galerkin_method)
{
  const Outcome outcome = check(nodes_file, bonds_file, "--set Reference/method=OPT");
  EXPECT_EQ(outcome.exit_code, 2);
  expect_found(outcome.err, "Reference/method = 'OPT' is no Galerkin method");
}

namespace
{
  using namespace plumbline::meshfree;

  /// Weights of a rule for the scene of the example, on its lattice or on nodes moved from there.
  Weights example_weights(const std::string &rule, double perturbation,
                          const std::vector<plumbline::scene::Override> &more = {})
  {
    std::vector<plumbline::scene::Override> overrides = {
        {"Domain/mesh", "squares"}, {"Methods/perturbation", std::to_string(perturbation)}};
    overrides.insert(overrides.end(), more.begin(), more.end());
    const auto scene = plumbline::scene::read_scene(scene_file, overrides);
    return weights_of(rule, plumbline::scene::make_problem(scene, 0, scene.series[0].levels[0]));
  }

  struct Files
  {
    std::string nodes, bonds;
  };

  /// As another code would write them; node k has the id k + 1.
  Files files_of(const Weights &weights)
  {
    std::ostringstream nodes, bonds;
    nodes.precision(15);
    bonds.precision(15);
    nodes << "id,x,y,volume\n";
    bonds << "i,j,weight,qx,qy\n";
    const auto &cells = *weights.problem.cells;
    for (std::size_t k = 0; k < cells.size(); ++k)
      nodes << k + 1 << ',' << cells.nodes[k][0] << ',' << cells.nodes[k][1] << ','
            << weights.volumes[k] << '\n';
    for (std::size_t i = 0; i < weights.families.size(); ++i)
      for (std::size_t k = 0; k < weights.families[i].bonds.size(); ++k)
      {
        const Bond &bond = weights.families[i].bonds[k];
        bonds << i + 1 << ',' << weights.families[i].neighbours[k] + 1 << ',' << bond.weight << ','
              << bond.kernel_point[0] << ',' << bond.kernel_point[1] << '\n';
      }
    return {write("given_nodes.csv", nodes.str()), write("given_bonds.csv", bonds.str())};
  }

  void remove_bond(Family &family, std::size_t j)
  {
    const auto at = std::find(family.neighbours.begin(), family.neighbours.end(), j);
    family.bonds.erase(family.bonds.begin() + (at - family.neighbours.begin()));
    family.neighbours.erase(at);
  }

  /// What is planted, and what the command is to say; I and J stand for the ids of the bond.
  struct Case
  {
    std::string name, text;
    std::function<void(Weights &, std::size_t i, std::size_t k)> plant;
  };

  const std::vector<Case> single_defects = {
      {"sign", "the bond from node I to node J (line L of the bonds) has the weight",
       [](Weights &w, std::size_t i, std::size_t k) { w.families[i].bonds[k].weight *= -1; }},
      {"one missing", "the bond from node I to node J is missing; a weight of",
       [](Weights &w, std::size_t i, std::size_t k)
       { remove_bond(w.families[i], w.families[i].neighbours[k]); }},
      {"both missing", "are missing from both ends",
       [](Weights &w, std::size_t i, std::size_t k)
       {
         const std::size_t j = w.families[i].neighbours[k];
         remove_bond(w.families[i], j);
         remove_bond(w.families[j], i);
       }},
      {"1.3 times", "is expected: 1.3 times",
       [](Weights &w, std::size_t i, std::size_t k) { w.families[i].bonds[k].weight *= 1.3; }},
      {"volume", "is expected: 2 times",
       [](Weights &w, std::size_t i, std::size_t k)
       { w.volumes[w.families[i].neighbours[k]] *= 2; }},
      {"kernel point", "the bond from node I to node J (line L of the bonds) takes the kernel at",
       [](Weights &w, std::size_t i, std::size_t k)
       { w.families[i].bonds[k].kernel_point *= .5; }}};

  std::string with_ids(std::string text, std::size_t i, std::size_t j, std::size_t line)
  {
    for (const auto &[mark, value] :
         {std::pair{"node I", i}, std::pair{"node J", j}, std::pair{"line L", line}})
      if (const auto at = text.find(mark); at != std::string::npos)
        text.replace(at + 5, 1, std::to_string(value));
    return text;
  }
} // namespace

TEST(Check, names_single_defects)
{
  // exact weights, so that nothing but the defect makes the exit code 1
  for (const double perturbation : {0., .2})
    for (const Case &one : single_defects)
    {
      Weights weights = example_weights("IPA-AC-R2", perturbation);
      const std::size_t i = 27, k = some_bond(weights, i), j = weights.families[i].neighbours[k];
      std::size_t line = 2 + k;
      for (std::size_t before = 0; before < i; ++before)
        line += weights.families[before].bonds.size();
      one.plant(weights, i, k);
      const Files files = files_of(weights);
      const Outcome outcome = check(files.nodes, files.bonds, "--json --require moments=10");
      EXPECT_EQ(outcome.exit_code, 1) << one.name << ", " << perturbation << outcome.err;
      expect_found(outcome.out, "out of line: ", one.name);
      expect_found(outcome.out, with_ids(one.text, i + 1, j + 1, line), one.name);
      EXPECT_EQ(outcome.out.find("cause: "), std::string::npos) << one.name;
    }
}

TEST(Check, names_nothing_in_sound_weights)
{
  for (const double perturbation : {0., .3})
    for (const std::string rule : {"FA", "LAMMPS", "IPA-AC", "IPA-AC-R2"})
    {
      const Files files = files_of(example_weights(rule, perturbation));
      const Outcome outcome = check(files.nodes, files.bonds, "--json");
      EXPECT_EQ(outcome.exit_code, rule == "IPA-AC-R2" ? 0 : 1) << rule << ", " << perturbation;
      EXPECT_EQ(outcome.out.find("out of line: "), std::string::npos) << outcome.out;
      EXPECT_EQ(outcome.out.find("required ac") == std::string::npos, rule == "IPA-AC-R2");
      expect_found(outcome.out, "the weights are those of " + rule);
      EXPECT_EQ(check(files.nodes, files.bonds, "--quiet --require consistent").exit_code, 0)
          << rule << ", " << perturbation;
    }
}

TEST(Check, names_what_was_done_to_all_weights)
{
  using Change = std::function<void(Bond &, const Weights &, std::size_t)>;
  const double m = 3;
  const std::vector<std::pair<std::string, Change>> all = {
      {"all weights have the wrong sign",
       [](Bond &b, const Weights &, std::size_t) { b.weight *= -1; }},
      {"all weights are twice too large, as if made for the limit -Laplace, not -0.5 Laplace",
       [](Bond &b, const Weights &, std::size_t) { b.weight *= 2; }},
      {"all weights are half of what they should be",
       [](Bond &b, const Weights &, std::size_t) { b.weight *= .5; }},
      {"all weights carry the factor 3/(4 m) = 0.25, the volume of the horizon in 2D",
       [m](Bond &b, const Weights &, std::size_t) { b.weight *= .75 / m; }},
      {"the kernel is taken at the midpoints of the bonds",
       [](Bond &b, const Weights &, std::size_t) { b.kernel_point *= .5; }},
      {"the kernel points (qx, qy) are reversed",
       [](Bond &b, const Weights &, std::size_t) { b.kernel_point *= -1; }},
      {"the kernel points (qx, qy) are absolute", [](Bond &b, const Weights &w, std::size_t i)
       { b.kernel_point += dealii::Tensor<1, 2>(w.problem.cells->nodes[i]); }}};
  for (const auto &[text, plant] : all)
  {
    Weights weights = example_weights("IPA-AC-R2", 0);
    for (std::size_t i = 0; i < weights.families.size(); ++i)
      for (Bond &bond : weights.families[i].bonds)
        plant(bond, weights, i);
    const Files files = files_of(weights);
    const Outcome outcome = check(files.nodes, files.bonds, "--json");
    EXPECT_EQ(outcome.exit_code, 1) << text << outcome.err;
    expect_found(outcome.out, "cause: " + text);
    EXPECT_EQ(outcome.out.find("out of line: "), std::string::npos) << text;
  }
}

TEST(Check, requires_what_it_is_told_to)
{
  const auto exit_code = [&](const std::string &required)
  { return check(nodes_file, bonds_file, "--quiet --require " + required).exit_code; };
  EXPECT_EQ(exit_code("ac,symmetric,m-matrix --require consistent,moments=1e-6"), 0);
  const Files moved = files_of(example_weights("IPA-AC-R2", .3));
  const Outcome outcome = check(moved.nodes, moved.bonds, "--json --require symmetric");
  EXPECT_EQ(outcome.exit_code, 1); // on moved nodes the weights of a bond differ
  expect_found(outcome.out, "required symmetric: w C of a pair differs from end to end by up to");
  const Files partial = files_of(example_weights("IPA-AC", 0)); // off by 9 %
  EXPECT_EQ(check(partial.nodes, partial.bonds, "--quiet --require moments=0.1").exit_code, 0);
  EXPECT_EQ(check(partial.nodes, partial.bonds, "--quiet --require moments=0.09").exit_code, 1);
  const Outcome unknown = check(nodes_file, bonds_file, "--require exact");
  EXPECT_EQ(unknown.exit_code, 2);
  expect_found(unknown.err, "--require 'exact' is not known; choose of ac, consistent, ");
  const Outcome negative = check(nodes_file, bonds_file, "--require moments=-1");
  EXPECT_EQ(negative.exit_code, 2);
  expect_found(negative.err, "'-1' is no positive number; write moments=0.05");
}

TEST(Check, takes_nodes_on_the_boundary_as_data_where_the_scene_does)
{
  // vertices of the lattice; the outermost of the collar are out of reach and stay out
  Weights weights =
      weights_of("FA",
                 []
                 {
                   const auto scene = plumbline::scene::read_scene(
                       scene_file, {{"Domain/mesh", "squares"}, {"Methods/nodes", "vertices"}});
                   return plumbline::scene::make_problem(scene, 0, scene.series[0].levels[0]);
                 }());
  const Files files = files_of(weights);
  // only those in the mesh: the collar is three cells wide
  std::istringstream in(read(files.nodes));
  std::string text, row;
  std::getline(in, text);
  text += '\n';
  while (std::getline(in, row))
  {
    double id = 0, x = 0, y = 0;
    char comma = 0;
    std::istringstream(row) >> id >> comma >> x >> comma >> y;
    if (std::max(std::abs(x - .5), std::abs(y - .5)) < .5 + .375 + 1e-9)
      text += row + '\n';
  }
  const std::string nodes = write("vertices.csv", text);
  const Outcome outcome =
      check(nodes, files.bonds, "--json --require consistent --set Methods/nodes=vertices");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  expect_found(outcome.out, "\"n_free\": 49");
  expect_found(outcome.out, "the weights are those of FA");
  const Outcome free = check(nodes, files.bonds);
  EXPECT_EQ(free.exit_code, 2);
  expect_found(free.err, "where nodes on the boundary carry data, write Methods/nodes = vertices");
}

TEST(Check, writes_a_page_unless_told_not_to)
{
  const fs::path folder = temporary("check_page");
  const Outcome outcome =
      check(nodes_file, (::folder / "bonds_wrong.csv").string(), "-o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.out, "written: " + (folder / "report.html").string());
  const std::string page = read(folder / "report.html");
  expect_found(page, "The weights are not as required");
  expect_found(page, "the bond from node 77 to node 79");
  expect_found(page, "<svg");
  expect_found(read(folder / "outliers.csv"), "77,79,");
  expect_found(read(folder / "nodes.csv"), "id,x,y,volume,cell_area,bonds,second_moment_ratio");
  expect_found(read(folder / "cells.vtu"), "second_moments");
  expect_found(read(folder / "check.json"), "\"exit_code\": 1");

  fs::remove_all(folder);
  EXPECT_EQ(check(nodes_file, bonds_file, "--quiet -o " + folder.string()).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "report.html"));
}

TEST(Check, refuses_scenes_of_which_bonds_are_not_all)
{
  for (const auto &[model, text] :
       {std::pair{"LPS", "Material/model = LPS: weights of bonds alone are checked; write"},
        std::pair{"variational", "checked"}})
  {
    const std::string scene = write("solid.prm", run(std::string("template ") + model).out);
    const Outcome outcome =
        run("check " + nodes_file + " " + bonds_file + " --quiet --scene " + scene);
    EXPECT_EQ(outcome.exit_code, 2) << model;
    expect_found(outcome.err, text);
  }
}
