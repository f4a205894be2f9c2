// `plumbline check` as a user meets it: exit codes, messages, and the worked example.

#include "check_command.h"

#include "check/text.h"
#include "meshfree/rules/families.h"
#include "meshfree/rules/rules.h"
#include "report/text_table.h"
#include "scene/problem.h"

namespace
{
  using namespace plumbline::app;

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
  expect_found(outcome.out, "64 free, 132 in the interaction domain");
  expect_found(outcome.out, "m = 3: h = 0.125, horizon = 0.375");
  expect_found(outcome.out, "reproduces polynomials up to degree 3");
  expect_found(outcome.out, "second moments exact: asymptotically compatible");
  expect_found(outcome.out, "\npositive definite");
  expect_found(outcome.out, "averages L2 | reference");
  expect_found(outcome.out, "the weights are those of IPA-AC-R2");
  expect_found(outcome.out, "\nas required\n");
}

TEST(Check, ends_a_short_summary_with_the_answer)
{
  const Outcome outcome = check(nodes_file, (folder / "bonds_wrong.csv").string());
  const auto lines = plumbline::report::lines_of(outcome.out);
  EXPECT_EQ(lines.size(), 25u) << outcome.out; // all of them have more
  for (const std::string &line : lines)
    EXPECT_LE(line.size(), 120u) << line;
  EXPECT_EQ(lines.back(), "NOT as required");
  expect_found(outcome.out, " more lines in the report\n");
  const std::vector<std::string> many(20, "outlier: " + std::string(200, 'x'));
  EXPECT_EQ(
      plumbline::report::lines_of(plumbline::check::check_summary(outcome.out, many, "no")).size(),
      25u);
}

TEST(Check, says_that_it_assumes_a_horizon)
{
  const std::string assumed = "Study/m is not given: m = horizon / h = 3 is assumed";
  EXPECT_EQ(check(nodes_file, bonds_file).out.find("is assumed"), std::string::npos);
  const std::string text = read(scene_file),
                    scene = write("no_m.prm", replace(text, "  set m      = 3\n", ""));
  const std::string arguments = "check " + nodes_file + " " + bonds_file + " --scene " + scene +
                                " -o " + temporary("check").string();
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, assumed);
  EXPECT_EQ(run(arguments + " --set Study/m=3").out.find("is assumed"), std::string::npos);
}

TEST(Check, names_the_node_with_the_wrong_weight)
{
  const std::string bonds = (folder / "bonds_wrong.csv").string();
  const Outcome outcome = check(nodes_file, bonds);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out, "first moments off by up to 4.23 % at node 77");
  expect_found(outcome.out, "outlier: the bond from node 77 to node 79 (line ");
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
  scene.domain.mesh.name = "squares";
  scene.methods.nodes.name = nodes_file;
  const auto problem = scene::make_problem(scene, 0, scene.study.series[0].levels[0]);
  const meshfree::Families<2> families(meshfree::recalibrated(problem.kernel, 2), problem.kernel,
                                       *problem.cells(), meshfree::Backend::fast);
  meshfree::Family<2> family;
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
      const meshfree::Bond<2> &bond = family.bonds[k];
      const std::size_t from = problem.cells()->source[i] + 1,
                        to = problem.cells()->source[family.neighbours[k]] + 1;
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
  expect_found(outcome.out,
               "second moments are off at all nodes alike: their trace, the strength of "
               "the operator, by 20 %: as horizon");
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
  // nearer than 1e-12 of a cell, in the collar and among the free ones
  refuse("1,-0.18750000000005,-0.3125,0.015625\n",
         {"nodes.csv', line 3: node 2 lies 4.99",
          "e-14 from node 1 of line 2, nearer than 1e-12 of", "; take one of them out"});
  const std::string free_node = "46,0.0625,0.0625,0.015625\n";
  for (const std::string options : {"", "--set Methods/nodes=vertices"})
  {
    const Outcome near =
        check(write("nodes.csv", replace(text, free_node, "46,0.18749999999995,0.0625,0.015625\n")),
              bonds_file, options);
    EXPECT_EQ(near.exit_code, 2) << options;
    EXPECT_EQ(near.out, "");
    expect_found(near.err, "nodes.csv', line 48: node 47 lies");
    expect_found(near.err, "from node 46 of line 47, nearer than 1e-12 of the cells' size");
  }
  refuse("1,-0.3125,-0.4125,0.015625\n",
         {"line 2: node 1 at (-0.3125, -0.4125) lies outside the domain and interaction domain at "
          "level m = 3: h = 0.125, horizon = 0.375; if those are not"});
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

TEST(Check, says_whose_solution_the_solver_does_not_find)
{
  const Outcome outcome =
      check(nodes_file, bonds_file,
            "--quiet --set 'Solver/linear solver=jacobi' --set 'Solver/max iterations=2'");
  EXPECT_EQ(outcome.exit_code, 3);
  expect_found(
      outcome.err,
      "no solution by the reference Q1 of wave, m = 3: h = 0.125, horizon = 0.375: the "
      "sparse solver 'cg + jacobi' (Solver/linear solver, Solver/iteration) of 49 unknowns "
      "stops after 2 iterations, of 2 allowed (Solver/max iterations)");
}

TEST(Check, refuses_a_reference_that_is_no_galerkin_method)
{
  const Outcome outcome = check(nodes_file, bonds_file, "--set Reference/method=OPT");
  EXPECT_EQ(outcome.exit_code, 2);
  expect_found(outcome.err, "Reference/method = 'OPT' is no Galerkin method");
}

TEST(Check, refuses_a_study_over_a_variable)
{
  const Outcome outcome = check(nodes_file, bonds_file,
                                "--set 'Random/variables=a: uniform' --set Study/regime=variable "
                                "--set Study/variable=a --set Study/values=0,1");
  EXPECT_EQ(outcome.exit_code, 2);
  expect_found(outcome.err, "weights are those of one value of a; give it as Random/values");
}

TEST(Check, needs_neither_rules_nor_a_problem)
{
  const std::string text = read(folder / "check.prm");
  const std::string file =
      write("short.prm",
            [&]
            {
              std::string result = text;
              for (const std::string section : {"subsection Problem", "subsection Methods"})
              {
                const auto from = result.find(section);
                result.erase(from, result.find("end\n", from) + 4 - from);
              }
              return result;
            }());
  const Outcome outcome = run("check " + nodes_file + " " + bonds_file + " -o " +
                              temporary("short").string() + " --scene " + file);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "Problem/solution is not given: u = sin(3*x)*cos(2*y) is solved for");
  expect_found(outcome.out, "the weights are those of IPA-AC-R2");
  const Outcome given =
      run("check " + nodes_file + " " + bonds_file + " -o " + temporary("short").string() +
          " --scene " + file + " --set 'Problem/solution=x^2' --set Methods/names=FA");
  EXPECT_EQ(given.exit_code, 0) << given.err;
  EXPECT_EQ(given.out.find("is not given: u"), std::string::npos) << given.out;
  // what has no solution, but a load, is as before
  const Outcome loaded =
      run("check " + nodes_file + " " + bonds_file + " -o " + temporary("short").string() +
          " --scene " + file + " --set Problem/load=1");
  EXPECT_EQ(loaded.exit_code, 2);
  expect_found(loaded.err, "Problem/constraint = solution, but Problem/solution is empty");
}
