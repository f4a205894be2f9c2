// What `plumbline check` says of weights that are spoilt on purpose: its text and its exit code.

#include "given_files.h"
#include "scene/problem.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace
{
  using namespace plumbline::app;
  using namespace plumbline::meshfree;

  std::size_t bond_to(const Family<2> &family, std::size_t j)
  {
    const auto at = std::find(family.neighbours.begin(), family.neighbours.end(), j);
    return static_cast<std::size_t>(at - family.neighbours.begin());
  }

  void remove_bond(Family<2> &family, std::size_t j)
  {
    const auto at = static_cast<std::ptrdiff_t>(bond_to(family, j));
    family.bonds.erase(family.bonds.begin() + at);
    family.neighbours.erase(family.neighbours.begin() + at);
  }

  void double_weights_to(Weights &weights, std::size_t node)
  {
    for (Family<2> &family : weights.families)
      for (std::size_t k = 0; k < family.bonds.size(); ++k)
        family.bonds[k].weight *= family.neighbours[k] == node ? 2 : 1;
  }

  /// In the file of the bonds.
  std::size_t line_of(const Weights &weights, std::size_t i, std::size_t k)
  {
    std::size_t line = 2 + k;
    for (std::size_t before = 0; before < i; ++before)
      line += weights.families[before].bonds.size();
    return line;
  }

  std::size_t count(const std::string &text, const std::string &part)
  {
    std::size_t n = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++n;
    return n;
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
      {"volume in the weights", "the weights of all bonds to node J are 2 times what is expected",
       [](Weights &w, std::size_t i, std::size_t k)
       { double_weights_to(w, w.families[i].neighbours[k]); }},
      {"volume in both", "is expected: 2 times",
       [](Weights &w, std::size_t i, std::size_t k)
       {
         const std::size_t j = w.families[i].neighbours[k];
         double_weights_to(w, j);
         w.volumes[j] *= 2;
       }},
      {"from the neighbour's side",
       "the bond from node J to node I (line B of the bonds) has the weight",
       [](Weights &w, std::size_t i, std::size_t k)
       {
         const std::size_t j = w.families[i].neighbours[k];
         w.families[j].bonds[bond_to(w.families[j], i)].weight *= 1.3;
       }},
      {"kernel point", "the bond from node I to node J (line L of the bonds) takes the kernel at",
       [](Weights &w, std::size_t i, std::size_t k)
       { w.families[i].bonds[k].kernel_point *= .5; }}};

  std::string with_ids(std::string text, std::size_t i, std::size_t j, std::size_t line,
                       std::size_t line_back)
  {
    for (const auto &[mark, value] : {std::pair{"node I", i}, std::pair{"node J", j},
                                      std::pair{"line L", line}, std::pair{"line B", line_back}})
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
      const std::size_t line = line_of(weights, i, k),
                        line_back = line_of(weights, j, bond_to(weights.families[j], i));
      one.plant(weights, i, k);
      const Files files = files_of(weights);
      const Outcome outcome = check(files.nodes, files.bonds, "--json --require moments=10");
      EXPECT_EQ(outcome.exit_code, 1) << one.name << ", " << perturbation << outcome.err;
      EXPECT_EQ(count(outcome.out, "outlier: "), 1u) << one.name << outcome.out;
      expect_found(outcome.out, with_ids(one.text, i + 1, j + 1, line, line_back), one.name);
      EXPECT_EQ(outcome.out.find("cause: "), std::string::npos) << one.name;
    }
}

TEST(Check, names_a_volume_once_that_all_weights_to_its_node_were_made_with)
{
  // of rules whose ramps depend on the volume, and of others
  for (const std::string rule : {"FA", "LAMMPS", "QWJ", "PA-AC"})
    for (const double perturbation : {0., .2})
    {
      Weights weights = example_weights(rule, perturbation);
      const std::size_t j = 27;
      double_weights_to(weights, j);
      weights.volumes[j] *= 2;
      const Files files = files_of(weights);
      const Outcome outcome = check(files.nodes, files.bonds, "--json --require moments=10");
      EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
      EXPECT_EQ(count(outcome.out, "outlier: "), 1u) << rule << outcome.out;
      expect_found(outcome.out, "outlier: the volume of node 28 (line 29 of the nodes)");
      expect_found(outcome.out, "the weights are those of " + rule + ", except for");
    }
}

TEST(Check, names_both_lines_of_a_bond_whose_ends_differ)
{
  // weights that no rule makes and that differ by as much as the defect, alike from both ends
  Weights weights = example_weights("FA", .2);
  const auto size = [](std::size_t i) { return 1 + .04 * std::sin(double(i)); };
  for (std::size_t i = 0; i < weights.families.size(); ++i)
    for (std::size_t k = 0; k < weights.families[i].bonds.size(); ++k)
      weights.families[i].bonds[k].weight *= size(i) * size(weights.families[i].neighbours[k]);
  const std::size_t i = 27, k = some_bond(weights, i), j = weights.families[i].neighbours[k],
                    back = bond_to(weights.families[j], i);
  ASSERT_LT(j, i);
  for (const bool is_back : {false, true})
  {
    Weights wrong = weights;
    (is_back ? wrong.families[j].bonds[back] : wrong.families[i].bonds[k]).weight *= 1.25;
    const Files files = files_of(wrong);
    const Outcome outcome = check(files.nodes, files.bonds, "--json --require consistent");
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(count(outcome.out, "outlier: "), 1u) << outcome.out;
    const std::string there = std::to_string(line_of(weights, i, k)),
                      other = std::to_string(line_of(weights, j, back));
    expect_found(outcome.out, "the bond from node " + std::to_string((is_back ? j : i) + 1) +
                                  " to node " + std::to_string((is_back ? i : j) + 1) + " (line " +
                                  (is_back ? other : there) + " of the bonds) has w C / volume = ");
    expect_found(outcome.out, "the bond back (line " + (is_back ? there : other) + ") ");
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
      EXPECT_EQ(outcome.out.find("outlier: "), std::string::npos) << outcome.out;
      EXPECT_EQ(outcome.out.find("required ac") == std::string::npos, rule == "IPA-AC-R2");
      expect_found(outcome.out, "the weights are those of " + rule);
      EXPECT_EQ(check(files.nodes, files.bonds, "--quiet --require consistent").exit_code, 0)
          << rule << ", " << perturbation;
    }
}

TEST(Check, names_what_was_done_to_all_weights)
{
  using Change = std::function<void(Bond<2> &, const Weights &, std::size_t)>;
  const double m = 3;
  const std::vector<std::pair<std::string, Change>> all = {
      {"all weights have the wrong sign",
       [](Bond<2> &b, const Weights &, std::size_t) { b.weight *= -1; }},
      {"all weights are twice too large, as if made for the limit -Laplace, not -0.5 Laplace",
       [](Bond<2> &b, const Weights &, std::size_t) { b.weight *= 2; }},
      {"all weights are half of what they should be",
       [](Bond<2> &b, const Weights &, std::size_t) { b.weight *= .5; }},
      {"all weights carry the factor 3/(4 m) = 0.25, the volume of the horizon in 2D",
       [m](Bond<2> &b, const Weights &, std::size_t) { b.weight *= .75 / m; }},
      {"the kernel is evaluated at the midpoints of the bonds",
       [](Bond<2> &b, const Weights &, std::size_t) { b.kernel_point *= .5; }},
      {"the kernel points (qx, qy) are reversed",
       [](Bond<2> &b, const Weights &, std::size_t) { b.kernel_point *= -1; }},
      {"the kernel points (qx, qy) are absolute", [](Bond<2> &b, const Weights &w, std::size_t i)
       { b.kernel_point += dealii::Tensor<1, 2>(w.problem.cells()->nodes[i]); }}};
  for (const auto &[text, plant] : all)
  {
    Weights weights = example_weights("IPA-AC-R2", 0);
    for (std::size_t i = 0; i < weights.families.size(); ++i)
      for (Bond<2> &bond : weights.families[i].bonds)
        plant(bond, weights, i);
    const Files files = files_of(weights);
    const Outcome outcome = check(files.nodes, files.bonds, "--json");
    EXPECT_EQ(outcome.exit_code, 1) << text << outcome.err;
    expect_found(outcome.out, "cause: " + text);
    EXPECT_EQ(outcome.out.find("outlier: "), std::string::npos) << text;
  }
}

TEST(Check, names_a_ramp_that_is_missing_where_the_scene_means_one)
{
  const Files files = files_of(example_weights("FA", 0));
  const std::string require = "--json --require consistent ";
  const Outcome meant = check(files.nodes, files.bonds, require + "--set Methods/names=LAMMPS,Q1");
  EXPECT_EQ(meant.exit_code, 1) << meant.err;
  // (2, 2) and (3, 0) of 28 bonds of each of 64 nodes
  expect_found(
      meant.out,
      "cause: all weights are whole cells where the horizon cuts them: the partial areas "
      "of LAMMPS are missing at 512 of 1792 bonds, though Methods/names has that rule and "
      "not FA; the moments cannot decide: their error is 4.72 %, and 7.09 % with partial areas");
  expect_found(check(files.nodes, files.bonds, require + "--set Methods/names=HHB").out,
               "the partial areas of QWJ are missing at ");
  // where no ramp is meant: it cannot be told
  const Outcome open = check(files.nodes, files.bonds, require);
  EXPECT_EQ(open.exit_code, 0) << open.err;
  expect_found(
      open.out,
      "whole cells where the horizon cuts them; with partial areas the moments of most "
      "nodes would be off by 7.09 % with those of LAMMPS, 7.09 % with those of QWJ, 6.93 % "
      "with those of PA-AC, instead of 4.72 %, so that moments do not tell whether a ramp "
      "was left out: name the rule that is meant in Methods/names");
  // where whole cells are meant
  const Outcome named = check(files.nodes, files.bonds, require + "--set Methods/names=FA,OPT");
  expect_found(named.out, "the weights are those of FA");
  EXPECT_EQ(named.out.find("whole cells"), std::string::npos) << named.out;
  // where it makes no difference
  const Files two = files_of(example_weights("FA", 0, {{"Study/m", "2"}}));
  const Outcome same =
      check(two.nodes, two.bonds,
            "--json --require moments=1 --set Study/m=2 --set Methods/names=LAMMPS");
  EXPECT_EQ(same.exit_code, 0) << same.err << same.out;
  expect_found(same.out, "LAMMPS and QWJ would make the same operator here");
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
  expect_found(unknown.err, "--require 'exact' is not known; choose one of ac, consistent, ");
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
                   return plumbline::scene::make_problem(scene, 0, scene.study.series[0].levels[0]);
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
  const Outcome outcome = check(nodes_file, (plumbline::app::folder / "bonds_wrong.csv").string(),
                                "-o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.out, "report    " + (folder / "report.html").string());
  const std::string page = read(folder / "report.html");
  expect_found(page, "The weights are not as required");
  EXPECT_LT(page.find("The weights are not as required"), page.find("<h2>")); // the answer
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
       {std::pair{"LPS", "Material/model = LPS with its dilatation; write"},
        std::pair{"variational", "Domain/boundary = free; write"}})
  {
    const std::string scene = write("solid.prm", run(std::string("template ") + model).out);
    const Outcome outcome =
        run("check " + nodes_file + " " + bonds_file + " --quiet --scene " + scene);
    EXPECT_EQ(outcome.exit_code, 2) << model;
    expect_found(outcome.err, text);
  }
}
