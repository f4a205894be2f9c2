#include "base/error.h"
#include "scene/models/model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

using namespace plumbline;
using namespace plumbline::scene;

namespace
{
  Scene parse(const std::string &text)
  {
    return parse_scene("capable", "subsection Problem\n set solution = x\nend\n" +
                                      std::string("subsection Methods\n set names = FA\nend\n") +
                                      text);
  }

  std::string failure(const std::function<void()> &act)
  {
    try
    {
      act();
      return "";
    }
    catch (const InputError &error)
    {
      return error.what();
    }
  }
} // namespace

TEST(Capabilities, each_model_and_analysis_has_its_row)
{
  ASSERT_EQ(analyses().size(), base::words<Analysis>.size());
  for (const Model *const model : models())
    for (const auto &[name, settings] : model->templates())
      EXPECT_EQ(parse_scene("t.prm", scene_template(name)).material.model, model) << name;
  for (std::size_t i = 0; i < analyses().size(); ++i)
    EXPECT_EQ(analyses()[i].name, base::word(static_cast<Analysis>(i)));
}

TEST(Capabilities, whatever_a_scene_may_need_some_model_and_some_analysis_can)
{
  for (const auto &rows : {capable_models(), analyses()})
    for (const Capability one : all_capabilities())
      EXPECT_TRUE(std::any_of(rows.begin(), rows.end(),
                              [&](const Capable &row) { return row.can.count(one) > 0; }))
          << base::word(one);
}

TEST(Capabilities, refusals_say_what_is_missing_who_can_and_what_to_write)
{
  const Scene scene = parse("");
  const Capabilities needed = {Capability::lattice, Capability::periodic};
  EXPECT_EQ(refusal(scene, needed, all_capabilities(), "others"), "");
  EXPECT_EQ(refusal(scene, needed, all_but({Capability::periodic}), "others"),
            "Domain/boundary = periodic; take others, or write constrained");
  EXPECT_EQ(refusal(scene, needed, {}, ""),
            "Domain/mesh = lattice; write Domain/mesh = squares or triangles");
}

TEST(Capabilities, models_and_analyses_refuse_what_their_rows_leave_out)
{
  EXPECT_EQ(
      failure([] { (void)parse("subsection Domain\n set boundary = periodic\nend\n"); }),
      "scene 'capable': Material/model = bond-based does not support this scene: Domain/boundary = "
      "periodic; take double well, or write constrained");
  const Scene mesh = parse("subsection Domain\n set mesh = squares\nend\n");
  EXPECT_EQ(failure([&] { check_analysis(mesh, Analysis::statics); }), "");
  EXPECT_EQ(
      failure([&] { check_analysis(mesh, Analysis::dispersion); }),
      "dispersion does not support this scene: Domain/mesh = squares; write Domain/mesh = lattice");
}

TEST(Capabilities, cracks_in_equilibrium_are_what_their_analyses_can_do)
{
  const std::string solid =
                        "subsection Material\n set model = LPS\n set E = 1\n set nu = 0.25\nend\n"
                        "subsection Kernel\n set type = 1/r\n set limit = Navier\nend\n"
                        "subsection Methods\n set names = OPT\nend\n"
                        "subsection Study\n set h = 0.1\n set m = 2\nend\n",
                    strip = "subsection Strip\n set length = 4\n set crack = 2\nend\n",
                    plate = "subsection Domain\n set boundary = free\n set boxes = 0, 0 : 1, 1\n"
                            " set fixed = 0, 0.7 : 1, 1; 0, 0 : 1, 0.3\n"
                            " set cracks = -0.1, 0.5 : 0.5, 0.5\nend\n"
                            "subsection Problem\n set constraint = 0, y\nend\n"
                            "subsection Fracture\n set toughness = 1\nend\n",
                    kept = "subsection Solver\n set dilatation = kept\nend\n";
  const auto check = [&](const std::string &text, Analysis analysis)
  { return failure([&] { check_analysis(parse_scene("capable", solid + text), analysis); }); };
  EXPECT_EQ(check(strip, Analysis::strip), "");
  EXPECT_EQ(check(plate, Analysis::growth), "");
  EXPECT_EQ(failure([&] { (void)parse_scene("capable", solid + plate + kept); }).substr(0, 57),
            "scene 'capable': growth does not support this scene: Solv"); // before it is run
}

TEST(Capabilities, cracks_of_solids_change_dilatations_and_those_of_bonds_do_not)
{
  const std::string crack =
      "subsection Domain\n set mesh = squares\n set cracks = 0.2, 0.4 : 0.8, 0.4\nend\n"
      "subsection Methods\n set names = FA\nend\nsubsection Problem\n set solution = ";
  const Capabilities bonds = needs(parse_scene("bonds", crack + "x\nend\n"));
  EXPECT_EQ(bonds.count(Capability::cracks), 1u);
  EXPECT_EQ(bonds.count(Capability::damaged_dilatation), 0u);
  const Capabilities solid = needs(parse_scene(
      "solid", crack + "x, y\nend\nsubsection Kernel\n set type = 1/r\n set limit = Navier\nend\n"
                       "subsection Material\n set model = LPS\n set E = 1\n set nu = 0.25\nend\n"));
  EXPECT_EQ(solid.count(Capability::cracks), 1u);
  EXPECT_EQ(solid.count(Capability::damaged_dilatation), 1u);
}

TEST(Capabilities, those_that_can_do_the_same_share_a_row_of_the_table)
{
  const std::string table =
      problem::capability_table("of", {{"one", {Capability::lattice}}, {"two", {}}, {"three", {}}});
  EXPECT_EQ(table.rfind("| of | lattice | meshes |", 0), 0u) << table;
  EXPECT_NE(table.find("| one | yes | - |"), std::string::npos) << table;
  EXPECT_NE(table.find("| two, three | - | - |"), std::string::npos) << table;
}

TEST(Capabilities, are_needed_by_what_a_body_is_made_of)
{
  const auto needed = [](const std::string &of, const std::vector<Override> &settings = {})
  { return needs(parse_scene("t.prm", scene_template(of), settings)); };
  EXPECT_EQ(needed("scalar").count(Capability::dilatation), 0u);
  EXPECT_EQ(needed("LPS").count(Capability::dilatation), 1u);
  EXPECT_EQ(needed("LPS", {{"Material/nu", "0.25"}}).count(Capability::dilatation), 0u);
  const Capabilities torus = needed("double-well"),
                     collar = needed("double-well", {{"Domain/boundary", "constrained"},
                                                     {"Problem/solution", "x*t, y*t"},
                                                     {"Reference/method", "none"},
                                                     {"Study/decisive error", "nodal L2 | exact"}});
  for (const Capabilities &of : {torus, collar})
    EXPECT_EQ(of.count(Capability::double_well), 1u);
  EXPECT_EQ(torus.count(Capability::double_well_collar), 0u);
  EXPECT_EQ(collar.count(Capability::double_well_collar), 1u);
}
