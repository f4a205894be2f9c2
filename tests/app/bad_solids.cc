// Bad input for state-based solids as a user meets it: exit codes, messages, no output.

#include "refusals.h"

namespace
{
  using namespace plumbline::app;

  /// A scene of the unit square with u given around it, and nodes at the centres of its 4 × 4
  /// cells.
  class BadSolids : public Refusals
  {
  protected:
    BadSolids()
        : Refusals("bad_solids", "set Purpose = bad input\n"
                                 "subsection Domain\n  set mesh = squares\nend\n"
                                 "subsection Kernel\n  set type = 1/r\n  set limit = Navier\nend\n"
                                 "subsection Material\n  set model = LPS\n"
                                 "  set E = 1\n  set nu = 0.3\nend\n"
                                 "subsection Problem\n  set solution = x^2 + y, x*y\nend\n"
                                 "subsection Methods\n  set names = FA\nend\n"
                                 "subsection Study\n  set h = 0.25\n  set m = 2\nend\n")
    {
    }
  };

  /// A scene of a bar that is constrained on the left and pulled on the right.
  class BadBodies : public Refusals
  {
  protected:
    BadBodies()
        : Refusals(
              "bad_bodies",
              "set Purpose = bad input\n"
              "subsection Domain\n  set boxes = 0, 0 : 1, 0.5\n"
              "  set boundary = free\n  set fixed = 0, 0 : 0.25, 0.5\nend\n"
              "subsection Kernel\n  set type = 1/r\n  set limit = Navier\nend\n"
              "subsection Material\n  set model = variational\n"
              "  set k = 100\n  set l = 400\nend\n"
              "subsection Problem\n  set load = 1, 0\n  set constraint = 0, 0\n"
              "  set local solution = none\nend\n"
              "subsection Methods\n  set names = PA-AC\n  set nodes = vertices\nend\n"
              "subsection Study\n  set regime = m\n  set h = 0.125\n  set horizon = 0.25\n"
              "  set norms = averages L2\n  set decisive error = averages L2 | reference\nend\n"
              "subsection Reference\n  set method = DGQ0\n  set estimate = none\nend\n"
              "subsection Quadrature\n  set tolerance = 0\nend\n")
    {
    }
  };

  const std::string no_E = set("Material/E", "") + set("Material/nu", "");
} // namespace

TEST_F(BadSolids, the_scene_itself_is_good)
{
  const auto outcomes =
      run({{set("Problem/solution", "x, y"), {}}, {set("Material/E", "1 + x/8"), {}}});
  for (const Outcome &outcome : outcomes)
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(BadSolids, constants_of_no_solid_are_refused)
{
  const auto variational = [](const std::string &k, const std::string &l)
  {
    return no_E + set("Material/model", "variational") + set("Material/k", k) +
           set("Material/l", l);
  };
  expect_refusals(
      {{set("Material/nu", "0.5"),
        {"Material/E and nu: Poisson's ratio nu = 0.5", "larger than -1 and smaller than 1/2",
         "for a nearly incompressible solid take .499"}},
       {set("Material/nu", "-1"), {"Material/E and nu: Poisson's ratio nu = -1", "larger than -1"}},
       {set("Material/E", "0"), {"Material/E and nu: Young's modulus E = 0", "must be positive"}},
       {no_E + set("Material/lambda", "-1") + set("Material/mu", "1"),
        {"Material/lambda and mu: lambda = -1", "larger than -mu = -1"}},
       {variational("-1", "8"), {"Material/k and l: the bulk constant k = -1", "be positive"}},
       {variational("1", "-8"), {"Material/k and l: the shear constant l = -8", "be positive"}},
       {no_E, {"Material/model = LPS needs one pair of constants: E and nu, lambda and mu, or k"}},
       {set("Material/model", "bond-based"),
        {"Material/nu = 0.3: pairwise forces along bonds imply nu = 1/4 in plane strain "
         "(1/3 "
         "in plane stress)",
         "write Material/nu = 0.25 or leave it empty",
         "Material/model = LPS, which 'plumbline run' and, for quasi-static fracture, 'plumbline "
         "grow' support, and 'plumbline crack' does not"}},
       {set("Material/model", "bond-based") + set("Material/nu", "") +
            set("Kernel/limit", "-Laplace"),
        {"Material/E = 1 is for bond tensors", "write Kernel/type = bond-tensor"}},
       {set("Material/model", "bond-based") + set("Material/nu", "") +
            set("Kernel/type", "bond-tensor") + set("Kernel/bulk modulus", "2"),
        {"Material/E and Kernel/bulk modulus set the same constant; clear one of them"}},
       {set("Material/model", "bond-based") + set("Material/nu", "") + set("Material/E", "1 + x") +
            set("Kernel/type", "bond-tensor"),
        {"Material/E = '1 + x' must be one number for Material/model = bond-based"}},
       {set("Material/model", "bond-based") + no_E + set("Material/mu", "1"),
        {"Material/mu with Material/model = bond-based", "Kernel/bulk modulus or Material/E"}},
       {set("Material/model", "double well") + set("Material/nu", "0.25"),
        {"Material/E needs Material/toughness", "give both, or c and beta"}},
       {set("Material/model", "double well") + no_E + set("Material/toughness", "1"),
        {"Material/toughness needs Material/E", "give both, or c and beta"}},
       {set("Material/model", "double well") + set("Material/nu", "") +
            set("Material/toughness", "8") + set("Material/beta", "2"),
        {"Material/E and toughness replace Material/c and beta; clear one of these pairs"}},
       {set("Material/model", "double well") + set("Material/nu", "") +
            set("Material/toughness", "-8"),
        {"Material/toughness = -8 must be positive and finite"}},
       {set("Material/model", "double well") + set("Material/nu", "") +
            set("Material/toughness", "8") + set("Kernel/type", "constant"),
        {"Time/density is not given"}}});
}

TEST_F(BadSolids, material_that_is_none_somewhere_is_refused_with_its_place)
{
  expect_refusals(
      {{set("Material/E", "x + 0.9"),
        {"Material/E and nu at (-1 ", "Young's modulus E = -0.1", "must be positive"}},
       {set("Material/nu", "0.3 + 0.2*(x > 1.9)"),
        {"Material/E and nu at (2 ", "Poisson's ratio nu = 0.5", "smaller than 1/2"}},
       {set("Material/E", "1 + x^2") + set("Material/nu", "-0.1"),
        {"Material/E and nu at (", "lambda = -0.", "harmonic means need it positive",
         "(nu > 0), or Material/model = variational"}},
       {set("Material/E", "1 + x^2") + set("Domain/mesh", "lattice"),
        {"Material/E or nu varies in space with Domain/mesh = lattice", "write Domain/mesh"}}});
}

TEST_F(BadSolids, collars_of_one_horizon_are_too_thin)
{
  const std::string lattice = set("Domain/mesh", "lattice");
  const std::vector<std::string> needs = {"twice the horizon, which the dilatation needs, 1",
                                          "balls would contain points without data"};
  const auto refused = [&](const std::string &settings, const std::string &what)
  {
    Trial trial{settings, needs};
    trial.fragments.push_back(what);
    return trial;
  };
  expect_refusals(
      {refused(lattice + set("Domain/collar", "0.75"),
               "Domain/interaction domain = 0.75 is thinner than"),
       refused(set("Domain/mesh", std::string(PLUMBLINE_SCENES) + "/meshes/disk.geo"),
               "disk.geo: the collar is 0."),
       refused(set("Domain/mesh", "hyper_cube") + set("Domain/arguments", "-0.5 : 1.5 : false") +
                   set("Domain/inside", "min(x*(1 - x), y*(1 - y))"),
               "Domain/mesh = hyper_cube: the collar is 0.5 wide")});
  // bonds alone need no more
  const auto outcomes =
      run({{lattice + set("Domain/collar", "0.5") + set("Material/nu", "0.25"), {}}});
  EXPECT_EQ(outcomes[0].exit_code, 0) << outcomes[0].err;
}

TEST_F(BadSolids, cracks_that_cannot_be_used_are_refused)
{
  const auto cracks = [](const std::string &value) { return set("Domain/cracks", value); };
  const std::string good = cracks("0.5, 0.5 : 0.7, 0.5"), above = set("Domain/outside", "y - 1");
  expect_refusals(
      {{cracks("0.375, 0.2 : 0.375, 0.9"),
        {"level h = 0.25", "Domain/cracks: crack 0 goes through node", "at (0.375 0.375)",
         "on its way from (0.375 0.2) to (0.375 0.9)", "move the crack"}},
       // between the nodes of the first level, through one of the second
       {cracks("0.5, 0.4 : 0.5, 0.9; 0.1, 0.3125 : 0.8, 0.3125") + set("Study/h", "0.25, 0.125"),
        {"level h = 0.125, horizon = 0.25: Domain/cracks: crack 1 goes through node",
         "0.3125) on its way from (0.1 0.3125) to (0.8 0.3125)", "move the crack"}},
       {set("Domain/outside", "delta < 0.3 ? y - 0.5 : y - 1") + set("Study/h", "0.25, 0.125"),
        {"level h = 0.125", "Domain/outside: node", "lies in the domain and is a ghost"}},
       {cracks("0.4, 0.4 : 0.4, 0.4"), {"crack 0 has its points 0 and 1 in one place", "take one"}},
       {cracks("0.4, 0.4"), {"Domain/cracks"}},
       {cracks("0.25, 0.25 : 0.5, 0.25 : 0.5, 0.5 : 0.25, 0.5 : 0.25, 0.25"),
        {"all bonds of node", "at (0.375 0.375) are broken", "move the crack"}},
       {set("Domain/outside", "x - 0.5"),
        {"lies in the domain and is a ghost; ghosts belong to the collar"}},
       {set("Domain/outside", "x, y"), {"Domain/outside = 'x, y' has 2 component(s), not 1"}},
       {good + set("Domain/mesh", "lattice"),
        {"Domain/cracks or Domain/outside is given", "write"}},
       {above + no_E + set("Material/model", "bond-based") + set("Kernel/type", "bond-tensor"),
        {"Material/model = bond-based does not support this scene: Domain/outside is given",
         "take LPS, or clear it"}},
       {above + set("Material/model", "variational"), {"take LPS, or clear it"}},
       {good + "--methods Q1",
        {"Galerkin methods have no forces in place of missing bonds",
         "Material/surface terms is published", "write energy or none"}},
       {above + set("Reference/method", "Q1"), {"Reference/method", "write energy or none"}},
       {good + set("Material/surface terms", "none") + set("Solver/iteration", "cg") +
            "--methods Q1",
        {"Solver/iteration = cg needs a symmetric operator", "Material/surface terms = none"}},
       {good + "--methods LOCAL", {"'LOCAL' cannot do", "Domain/cracks is given", "or clear it"}},
       {above + set("Problem/local solution", "computed"),
        {"Problem/local solution = computed needs u all around", "write none"}}});
}

TEST_F(BadBodies, the_scene_itself_is_good)
{
  const auto outcomes =
      run({{"--methods PA-AC,Q1,DGQ0", {}},
           {set("Domain/mesh", "triangles") + set("Reference/method", "P1"), {}}});
  for (const Outcome &outcome : outcomes)
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(BadBodies, bodies_that_are_not_held_or_not_free_are_refused)
{
  const auto fixed = [](const std::string &value) { return set("Domain/fixed", value); };
  expect_refusals(
      {{fixed(""),
        {"Domain/boundary = free needs a part where u is given", "3 rigid modes",
         "give Domain/fixed"}},
       {fixed("0, 0 : 1, 0.5"), {"the fixed part covers all of the body; give a smaller one"}},
       {fixed("2, 0 : 3, 0.5"), {"nothing of the body is fixed", "fix a part (Domain/fixed)"}},
       {fixed("0, 0 : 0.2, 0.5"), {"does not divide the box"}},
       {set("Domain/boundary", "constrained"),
        {"Domain/fixed is given, but u is prescribed in the interaction domain",
         "write Domain/boundary = free"}},
       {set("Problem/constraint", "0.5, 0"),
        {"Problem/constraint is 0.5 at (0 0)", "hold the fixed part at 0; write 0, 0"}},
       {set("Material/model", "LPS"), {"Domain/boundary = free; take variational, or write"}}});
}

TEST_F(BadBodies, what_bodies_cannot_do_is_refused)
{
  expect_refusals(
      {{"--methods P1", {"'P1' cannot do", "Domain/mesh = lattice", "take Q1"}},
       {"--methods LOCAL" + std::string(" ") + set("Study/regime", "delta"),
        {"'LOCAL' cannot do", "write Domain/boundary = constrained"}},
       {set("Reference/method", "P1"), {"Reference/method: 'P1' cannot", "take Q1"}},
       {set("Domain/boxes", "0, 0 : 1, 0.5; 0, 0 : 0.5, 1"),
        {"Domain/boundary = free needs one box", "write squares or triangles for several boxes, a "
                                                 ".geo or .msh file for any other shape"}},
       {set("Domain/holes", "0.5, 0.25 : 0.75, 0.5"),
        {"free needs one box (Domain/boxes) without"}},
       {set("Problem/solution", "x, y"), {"free needs Problem/load and", "Problem/solution empty"}},
       {set("Domain/collar", "0.5"), {"free needs Domain/interaction domain = auto"}},
       {set("Domain/cracks", "0.5, 0.1 : 0.5, 0.2"),
        {"Material/model = variational does not support", "clear it"}},
       {set("Domain/mesh", "squares") + set("Problem/local solution", "computed"),
        {"Problem/local solution = computed needs u all around", "write none"}}});
}

TEST_F(BadBodies, meshes_that_are_no_body_are_refused)
{
  const std::string corners = "Point(1) = {0, 0, 0, .2}; Point(2) = {1, 0, 0, .2};"
                              "Point(3) = {1, .5, 0, .2}; Point(4) = {0, .5, 0, .2};",
                    square = corners + "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4};"
                                       "Line(4) = {4, 1}; Curve Loop(1) = {1:4};"
                                       "Plane Surface(1) = {1};\n",
                    crossed = corners + "Line(1) = {1, 2}; Line(2) = {2, 4}; Line(3) = {4, 3};"
                                        "Line(4) = {3, 1}; Curve Loop(1) = {1:4};"
                                        "Plane Surface(1) = {1};\n",
                    omega = "Physical Surface(\"omega\") = {1};\n";
  write("body.geo", square + omega);
  write("nameless.geo", square);
  write("collar.geo", square + "Physical Surface(\"collar\") = {1};\n");
  write("crossed.geo", crossed + omega);
  const auto mesh = [](const std::string &name)
  { return set("Domain/mesh", name) + "--methods FA "; };
  const std::string no_reference = set("Reference/method", "DGP0");
  expect_refusals(
      {{mesh("nowhere.geo") + no_reference, {"nowhere.geo' cannot be read", "check its name"}},
       {mesh("nameless.geo") + no_reference,
        {"has the physical surfaces (none)", "begin with 'omega', at least one and no others"}},
       {mesh("collar.geo") + no_reference,
        {"has the physical surfaces 'collar'", "a body with a free boundary has no collar"}},
       {mesh("crossed.geo") + no_reference,
        {"crossed.geo' is refused by gmsh: curves of a surface cross; let them meet at their ends "
         "alone (gmsh says: Unable to recover the edge"}},
       {mesh("body.geo") + no_reference + set("Domain/fixed", "-1, -1 : 2, 2"),
        {"the fixed part covers all of the body"}},
       {mesh("body.geo") + no_reference + set("Domain/fixed", "0, 0.6 : 1, 1"),
        {"nothing of the body is fixed", "fix a part (Domain/fixed)"}},
       {mesh("body.geo") + no_reference + set("Domain/fixed", "0, 0 : 0.2, 1; 0, 0.6 : 1, 1"),
        {"the fixed box 0, 0.6 : 1, 1 lies beside the body", "(Domain/fixed)"}},
       {mesh("body.geo") + no_reference + set("Domain/fixed", "0, 0 : 0.02, 0.02"),
        {"Reference/method: 'DGP0' cannot", "no cell of Domain/mesh = body.geo has its centroid in "
                                            "Domain/fixed"}},
       {mesh("body.geo") + no_reference + set("Material/k", "1.04 - x") +
            set("Study/h", "0.25, 0.15"),
        {"level h = 0.15", "Material/k and l at (1.05",
         "the bulk constant k = -0.01, but it must be positive"}},
       {mesh("body.geo"), {"'DGQ0' cannot do", "are triangles", "take P1"}}});
  const auto outcomes = run({{mesh("body.geo") + no_reference, {}}});
  EXPECT_EQ(outcomes[0].exit_code, 0) << outcomes[0].err;
}

TEST_F(BadSolids, surface_corrections_are_for_free_bodies_of_bonds)
{
  const std::string scenes = "run " + std::string(PLUMBLINE_SCENES),
                    corrected = scenes + "/state_based/surface_corrections.prm --levels 1 --set "
                                         "Methods/names=FA+mirror";
  expect_refused(
      scenes + "/state_based/bar.prm --set Methods/names=FA+volume",
      "'FA+volume' cannot do this scene: Material/model = variational with its dilatation");
  expect_refused(scenes + "/state_based/bar.prm --set Methods/names=FA+volume",
                 "give constants without a dilatation term: lambda = mu, i.e. nu = 1/4 in plane "
                 "strain, or l = 4 k");
  expect_refused(scenes + "/check/check.prm --set Methods/names=FA+volume",
                 "'FA+volume' cannot do this scene: Domain/mesh = lattice");
  expect_refused(
      scenes + "/check/check.prm --set Methods/names=FA+volume --set "
               "Domain/mesh=squares",
      "it corrects bonds near the free surfaces of bodies; write Domain/boundary = free");
  expect_refused(corrected + " --set Domain/mesh=squares --set "
                             "'Domain/holes=0.75, -0.0625 : 0.875, 0.0625'",
                 "fictitious nodes (methods +mirror) need a body of one box");
  expect_refused(corrected + " --set Study/m=12", "the horizon of 12 h reaches across the box");
  expect_refused(corrected + "s", "'FA+mirrors' is not known");
}
