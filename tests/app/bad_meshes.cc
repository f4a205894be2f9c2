// Bad input for meshes and scattered nodes as a user meets it: exit codes, messages, no output.

#include "refusals.h"

#include <algorithm>

namespace
{
  using namespace plumbline::app;

  class BadMeshes : public Refusals
  {
  protected:
    BadMeshes()
        : Refusals("bad_meshes", "set Purpose = bad input\n"
                                 "subsection Domain\n  set mesh = squares\nend\n"
                                 "subsection Problem\n  set solution = x^2 + y\nend\n"
                                 "subsection Methods\n  set names = FA\nend\n"
                                 "subsection Study\n  set h = 0.25\n  set m = 2\n"
                                 "  set decisive error = averages L2 | exact\nend\n")
    {
    }
  };

  // two triangles of Ω in [0,1]², a square of collar in [1,2] × [0,1]
  const std::string names = "2\n2 1 \"omega\"\n2 2 \"collar\"\n",
                    vertices = "1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n",
                    triangle_1 = "1 2 2 1 1 1 2 5\n", triangle_2 = "2 2 2 1 1 1 5 4\n",
                    collar = "3 3 2 2 2 2 3 6 5\n";

  std::string msh(const std::string &physical_names, const std::string &nodes,
                  const std::string &elements)
  {
    const auto section = [](const std::string &name, const std::string &content)
    { return "$" + name + "\n" + content + "$End" + name + "\n"; };
    const auto counted = [](const std::string &lines)
    { return std::to_string(std::count(lines.begin(), lines.end(), '\n')) + "\n" + lines; };
    return section("MeshFormat", "2.2 0 8\n") +
           (physical_names.empty() ? "" : section("PhysicalNames", physical_names)) +
           section("Nodes", counted(nodes)) + section("Elements", counted(elements));
  }

  /// A lattice of nodes over the domain and its collar, and one more line.
  std::string csv(const std::string &header, const std::string &line)
  {
    std::ostringstream text;
    text << header << '\n';
    for (double y = -.375; y < 1.5; y += .25)
      for (double x = -.375; x < 1.5; x += .25)
        text << x << ',' << y << '\n';
    text << line << '\n';
    return text.str();
  }
} // namespace

TEST_F(BadMeshes, mesh_files_that_cannot_be_used_are_refused)
{
  write("hanging.msh", msh(names, vertices + "7 1 .5 0\n",
                           "1 3 2 1 1 1 2 5 4\n2 2 2 2 2 2 3 7\n3 2 2 2 2 7 6 5\n"
                           "4 2 2 2 2 7 3 6\n"));
  write("dart.msh", msh(names, "1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 .3 .3 0\n6 2 1 0\n",
                        "1 3 2 1 1 1 2 5 4\n2 2 2 2 2 2 3 6\n"));
  write("nameless.msh", msh("", vertices, "1 2 0 1 2 5\n"));
  write("omega.msh", msh("1\n2 1 \"omega\"\n", vertices, triangle_1 + triangle_2));
  write("double.msh", msh(names, vertices + "7 1 0 0\n8 1 1 0\n",
                          triangle_1 + triangle_2 + "3 3 2 2 2 7 3 6 8\n"));
  write("curved.msh", msh(names, vertices + "7 .5 0 0\n8 1 .5 0\n9 .5 .5 0\n",
                          "1 9 2 1 1 1 2 5 7 8 9\n" + triangle_2 + collar));
  write("solid.msh",
        msh("1\n3 1 \"omega\"\n", "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n", "1 4 2 1 1 1 2 3 4\n"));
  write("thin.msh", msh(names, vertices, triangle_1 + triangle_2 + collar));
  write("broken.geo", "Point(1) = {0, 0;\n");
  const auto refused = [](const std::string &name, std::vector<std::string> fragments)
  {
    fragments.push_back(name);
    return Trial{set("Domain/mesh", name), std::move(fragments)};
  };
  expect_refusals(
      {refused("hanging.msh", {"vertex 5 of cell 1 at (1, 0.5) lies inside a side of cell 0 (a "
                               "hanging vertex); make the mesh conforming"}),
       refused("dart.msh", {"cell 0 at (0.325, 0.325) is not convex; move its vertices"}),
       refused("nameless.msh", {"physical surfaces (none); give names that begin with 'omega' and "
                                "'collar'"}),
       refused("omega.msh", {"physical surfaces 'omega'; give names", "at least one of each"}),
       refused("double.msh", {"at (1, 0) lies where cell 0 has another vertex; let the cells"}),
       refused("curved.msh", {"gmsh's type 9; only triangles and quadrilaterals of first order"}),
       refused("solid.msh",
               {"reaches z = 1; only triangles and quadrilaterals in the plane z = 0"}),
       refused("missing.msh", {"cannot be read; check its name and folder"}),
       refused(
           "broken.geo",
           {"line 1 is refused by gmsh: a syntax error at ';'; mend the line, or the end of the "
            "one before (gmsh says: syntax error (;))"}),
       refused("thin.msh", {"the collar is 0 wide", "thinner than the horizon 0.5", "; widen"})});
}

TEST_F(BadMeshes, files_of_other_programs_are_named_with_what_to_convert_them_to)
{
  const auto refused = [](const std::string &name, const std::string &what) {
    return Trial{set("Domain/mesh", name), {"Domain/mesh = " + name + what, "in", "msh"}};
  };
  const std::string remedy = ", which is not read; convert it to gmsh's .msh format 2.2 or 4.1";
  expect_refusals({refused("plate.e", " is an Exodus file" + remedy),
                   refused("plate.EXO", " is an Exodus file" + remedy),
                   refused("a/plate.vtu", " is a VTK file" + remedy),
                   refused("plate.inp", " is an Abaqus file" + remedy),
                   refused("plate.foo", " is a file of the unknown kind .foo" + remedy),
                   refused("plate.MSH", ": names of gmsh files end in .msh or .geo, in small")});
}

TEST_F(BadMeshes, of_other_units_than_the_mesh_size_are_refused_before_they_fill_the_memory)
{
  const std::string ring =
      "Point(1) = {0, 0, 0, SIZE};\nFor k In {0:3}\n"
      "Point(2 + k) = {R * Cos(k * Pi / 2), R * Sin(k * Pi / 2), 0, SIZE};\n"
      "Point(6 + k) = {2 * R * Cos(k * Pi / 2), 2 * R * Sin(k * Pi / 2), 0, SIZE};\nEndFor\n"
      "For k In {0:3}\nCircle(1 + k) = {2 + k, 1, 2 + (k + 1) % 4};\n"
      "Circle(5 + k) = {6 + k, 1, 6 + (k + 1) % 4};\nEndFor\n"
      "Curve Loop(1) = {1:4}; Curve Loop(2) = {5:8};\n"
      "Plane Surface(1) = {1}; Plane Surface(2) = {2, 1};\n"
      "Physical Surface(\"omega\") = {1}; Physical Surface(\"collar\") = {2};\n";
  const auto with = [&](const std::string &radius, const std::string &size)
  { return "DefineConstant[ h = .1 ];\nR = " + radius + "; SIZE = " + size + ";\n" + ring; };
  write("scaled.geo", with("1", "h") + "Mesh.ScalingFactor = 1000;\n"); // mm, to h = 0.1 m
  write("large.geo", with("1000", "h"));                                // gmsh would not end
  write("coarse.geo", with("1000", "300"));
  write("small.geo", with("0.001", "0.0003")); // m, to h = 0.1 mm
  const std::string ball = set("Domain/mesh", "hyper_ball") + set("Domain/inside", "1");
  const std::string units = "are the lengths of mesh and scene in the same unit?",
                    level = set("Study/h", "0.1");
  std::vector<Trial> trials;
  for (const std::string methods : {"FA", "P1"})
    for (const std::string name : {"scaled.geo", "small.geo"})
      trials.push_back(
          {set("Methods/names", methods) + level + set("Domain/mesh", name),
           {"Domain/mesh = " + name + ": its cells are some", "Study/h = 0.1", units}});
  for (const std::string name : {"coarse.geo", "large.geo"})
    trials.push_back({level + set("Domain/mesh", name),
                      {"its geometry is 4000 by 4000", "squares of the mesh size h", "same unit"}});
  trials.push_back({level + ball + set("Domain/arguments", "0, 0 : 0.0001 : false"), {units}});
  trials.push_back(
      {level + set("Domain/mesh", "squares") + set("Domain/map", "1e4*x, 1e4*y"), {units}});
  expect_refusals(trials);
}

TEST_F(BadMeshes, generators_and_maps_that_do_not_work_are_refused)
{
  const std::string ball = set("Domain/mesh", "hyper_ball"), inside = set("Domain/inside", "1"),
                    arguments = set("Domain/arguments", "0, 0 : 1 : false");
  expect_refusals(
      {{set("Domain/mesh", "hyper_blob") + inside,
        {"mesh generator hyper_blob ()", "deal.II has no such generator", "by Domain/mesh"}},
       {ball + inside + set("Domain/arguments", "0, 0 : x"),
        {"(0, 0 : x) does not fit", "one of another kind", "by Domain/arguments"}},
       {ball + arguments, {"Domain/inside is empty", "an expression that is positive in Omega"}},
       {set("Domain/mesh", "Squares"),
        {"Domain/mesh = Squares: any name other than lattice, squares, triangles and files .msh or "
         ".geo is a generator"}},
       {ball + arguments + set("Domain/inside", "-1"),
        {"none of the 320 cells of the mesh lies in the domain; mark", "Domain/inside"}},
       {ball + arguments + set("Domain/inside", "0.8 - x^2 - y^2"),
        {"Domain/mesh = hyper_ball: the collar is 0.07", "the horizon 0.5", "widen the collar"}},
       {set("Domain/map", "-x, y"),
        {"choose another Domain/map", "cell 0 at (0.375, -0.375) is inverted"}},
       {set("Domain/map", "x, sqrt(y)"),
        {"Domain/map = 'x, sqrt(y)' gives", "at (x, y) = (-0.5, -0.5); it must be a finite"}},
       {set("Domain/map", "x, y") + set("Domain/mesh", "lattice"),
        {"Domain/map is given with Domain/mesh = lattice", "clear it or choose"}}});
}

TEST_F(BadMeshes, a_coefficient_that_is_not_positive_everywhere_is_refused)
{
  const auto refused = [](const std::string &value, const std::vector<std::string> &fragments,
                          const std::string &more = "") {
    return Trial{set("Kernel/coefficient", value) + more, fragments};
  };
  // the second one is negative around one vertex, the third without value at the outermost ones
  expect_refusals({refused("x - 0.5", {"Kernel/coefficient = 'x - 0.5' is -", "positive"}),
                   refused("1 - 2*exp(-1000000*((x - 0.25)^2 + (y - 0.5)^2))", {"is -1 at (0.25"}),
                   refused("sqrt(x + 0.45)", {"at (x, y) = (-0.5, ", "must be a finite number"}),
                   refused("1", {"Kernel/coefficient = '1' with Domain/mesh = lattice", "squares"},
                           set("Domain/mesh", "lattice"))});
}

TEST_F(BadMeshes, materials_that_do_not_fit_the_mesh_are_refused)
{
  const std::string file =
      set("Domain/mesh", std::string(PLUMBLINE_SCENES) + "/meshes/disk_in_disk.geo");
  expect_refusals(
      {{file + set("Kernel/materials", "omega_matrix: 1; omega_inclusion: 5"),
        {"no value for the physical surface 'collar'", "omega_matrix, omega_inclusion"}},
       {file + set("Kernel/materials", "omega_matrix: 1; omega_inclusion: 5; collar: 1; steel: 2"),
        {"no physical surface 'steel'"}},
       {file + set("Kernel/materials", "omega_matrix: 1; omega_inclusion: -5; collar: 1"),
        {"'omega_inclusion' is -5; it must be a positive number", "positive"}},
       {file + set("Kernel/materials", "omega_matrix: 1; omega_inclusion: hard; collar: 1"),
        {"Kernel/materials", "hard"}},
       {set("Kernel/materials", "collar: 1"), {"Kernel/materials is given", "Kernel/coefficient"}},
       {file + set("Kernel/materials", "collar: 1") + set("Kernel/coefficient", "1"),
        {"are both given", "clear one"}}});
}

TEST_F(BadMeshes, curved_sides_where_nothing_can_follow_them_are_refused)
{
  const std::string curved = set("Domain/sides", "curved"),
                    disk = set("Domain/mesh", std::string(PLUMBLINE_SCENES) + "/meshes/disk.geo") +
                           set("Study/norms", "averages L2") +
                           set("Study/decisive error", "averages L2 | exact");
  expect_refusals(
      {{curved, {"Domain/sides = curved with Domain/mesh = squares", "has curves to follow"}},
       {curved + set("Domain/mesh", "triangles"), {"with Domain/mesh = triangles", "straight"}},
       {set("Domain/sides", "round"), {"Domain/sides", "round"}},
       {curved + disk + set("Quadrature/entries", "quadrature"),
        {"Domain/sides = curved and Quadrature/entries = quadrature", "write exact, or"}},
       {curved + disk + "--methods P1-quadrature",
        {"'P1-quadrature' cannot do this scene", "no entries by quadrature; take P1, or"}},
       {curved + disk + "--methods P3",
        {"Domain/sides = curved is for what pairs of sides can do", "the degree is more than 2",
         "write Domain/sides = straight"}},
       {curved + disk + set("Kernel/coefficient", "1 + x^2") + "--methods P1",
        {"Domain/sides = curved: entries would be by quadrature", "the material changes inside"}}});
}

TEST_F(BadMeshes, nodes_that_cannot_be_used_are_refused)
{
  write("nox.csv", csv("a,y", ""));
  write("word.csv", csv("x,y", "one,0"));
  write("nan.csv", csv("x,y", "nan,0"));
  write("twin.csv", csv("x,y", "0.125,0.375"));
  write("close.csv", csv("x,y", "0,0.3\n1e-15,0.3"));
  write("far.csv", csv("x,y", "3,3"));
  write("odd_0.25.csv", csv("x,y", "0,0,0"));
  write("outer.csv", "x,y\n+1.2,.5\n");
  const std::string lattice = set("Domain/mesh", "lattice"),
                    moved = set("Methods/perturbation", "0.3");
  const auto refused = [](const std::string &nodes, const std::vector<std::string> &fragments,
                          const std::string &more = "") {
    return Trial{set("Methods/nodes", nodes) + more, fragments};
  };
  expect_refusals(
      {refused("missing.csv", {"missing.csv' cannot be read; check its name and folder"}),
       refused("nox.csv", {"nox.csv' has no column x in its first line 'a,y'; name the columns"}),
       refused("word.csv", {"word.csv', line 66: x = 'one' is not a finite number; mend"}),
       refused("nan.csv", {"nan.csv', line 66: x = 'nan' is not a finite number; mend"}),
       refused("twin.csv", {"twin.csv', line 66: the node there lies where that of line 28 is; "
                            "take one of them out"}),
       refused("close.csv", {"close.csv', line 67: the node there lies 1e-15 from that of line 66, "
                             "nearer than 1e-12 of the cells' size 0.",
                             "take one of them out"}),
       refused("far.csv", {"far.csv'", "node 64 at (3, 3) lies outside of the domain and its "
                                       "collar; take it out, or move it in"}),
       refused("outer.csv", {"outer.csv'", "none of the 1 nodes lies in the domain; add nodes"}),
       refused("level_{h}.csv",
               {"Methods/nodes = level_{h}.csv: there is no file '", "level_0.25.csv",
                "' for h = 0.25; give one for each h of Study/h"}),
       refused("odd_{h}.csv",
               {"Methods/nodes = odd_{h}.csv: '", "odd_0.25.csv', line 66: '0,0,0' has 3 "
                                                  "values for 2 columns; take some out"}),
       refused("nox.csv", {"Methods/nodes = nox.csv: '"}),
       refused("middles", {"Methods/nodes = 'middles' is not known; write centres"}),
       refused("far.csv", {"far.csv with Domain/mesh = lattice", "write Domain/mesh"}, lattice),
       refused("centres", {"Methods/perturbation > 0 with Domain/mesh = lattice"}, lattice + moved),
       refused("mesh", {"Methods/perturbation moves centres", "Methods/nodes = mesh"}, moved)});
}

TEST_F(BadMeshes, methods_and_targets_that_do_not_fit_are_refused)
{
  const std::string lattice = set("Domain/mesh", "lattice"),
                    triangles = set("Domain/mesh", "triangles"),
                    nodal = set("Study/norms", "nodal Linf"),
                    reference = set("Reference/method", "Q1");
  const auto target = [](const std::string &value) { return set("Study/decisive error", value); };
  const std::string computed = set("Problem/local solution", "computed");
  expect_refusals(
      {{triangles + "--methods Q1", {"'Q1' cannot do", "triangles are triangles", "take P1"}},
       {"--methods DGP1", {"'DGP1' cannot do", "squares are quadrilaterals", "take Q1"}},
       {lattice + "--methods P1", {"'P1' cannot do", "Domain/mesh = lattice", "take Q1"}},
       {triangles + set("Reference/method", "Q2"),
        {"Reference/method: 'Q2' cannot", "take P1, P2"}},
       {set("Reference/method", "R2"),
        {"Reference/method: method 'R2' is not known; choose one of"}},
       {set("Reference/tolerance", "0.01"),
        {"Reference/tolerance = 0.01 needs a reference", "give Reference/method"}},
       {reference + set("Reference/tolerance", "0.01") + set("Reference/estimate", "none"),
        {"Reference/tolerance = 0.01 needs", "Reference/estimate = automatic"}},
       {lattice + computed,
        {"Problem/local solution = computed with Domain/mesh = lattice", "write Domain/mesh"}},
       {reference + nodal + target("averages L2 | reference"),
        {"Study/decisive error = 'averages L2 | reference'", "Study/norms (add it there)"}},
       {reference + nodal + target("nodal Linf | reference"), {"by cell averages; use averages"}},
       {computed + nodal + target("nodal Linf | local"), {"by cell averages; use averages"}}});
}

TEST_F(BadMeshes, what_cannot_be_solved_exits_with_3_and_keeps_the_rest)
{
  const std::string tight = set("Domain/mesh", "triangles") +
                            set("Quadrature/entries", "quadrature") +
                            set("Quadrature/tolerance", "1e-12");
  const std::vector<Trial> runs = {
      {tight + set("Quadrature/max refinements", "0") + "--methods P1,FA",
       {"no result: P1, u, m = 2, h = 0.25", "more than Quadrature/tolerance = 1e-12; raise"}},
      {tight + set("Quadrature/max refinements", "1") + "--methods P1,FA",
       {"no result: P1", "refinement 1", "Quadrature/max refinements or the tolerance"}},
      {set("Study/m", "1.2") + "--methods FA,IPA-AC-R4,Q1",
       {"no result: IPA-AC-R4, u, m = 1.2, h = 0.25",
        "up to degree 4 are infeasible at node 16, "
        "(0.125, 0.125): the 8 neighbours span rank 8 of 14",
        "; raise m = horizon / h", "or take a rule of lower degree"}},
      {set("Reference/method", "Q1") + set("Reference/tolerance", "1e-12"),
       {"the reference Q1 at h = 0.25 has an estimated error of 0.01",
        "more than Reference/tolerance = 1e-12; take a higher degree"}}};
  const auto outcomes = run(runs);
  for (std::size_t i = 0; i < runs.size(); ++i)
    expect(runs[i], outcomes[i], 3);

  for (std::size_t i = 0; i < 3; ++i) // the other methods are there, and the failed one says why
  {
    expect_found(outcomes[i].out, "failed");
    EXPECT_EQ(outcomes[i].err.find("no result: FA"), std::string::npos);
    EXPECT_TRUE(fs::exists(output(i) / "report.html"));
    expect_found(read(output(i) / "results.json"), "averages L2 | exact");
  }
  EXPECT_FALSE(fs::exists(output(3))); // nothing had been solved
}
