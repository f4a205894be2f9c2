// What helps to find commands, keys and words: searches, hints, short scenes, texts from the
// parser.

#include "command.h"

#include "scene/scene.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace
{
  using namespace plumbline::app;

  const std::string scene = std::string(PLUMBLINE_SCENES) + "/ipa_ac/scalar_delta_convergence.prm";

  std::ptrdiff_t n_lines(const std::string &text)
  {
    return std::count(text.begin(), text.end(), '\n');
  }
} // namespace

TEST(Finding, describe_searches_names_and_help_and_ranks_names_first)
{
  const std::string young = run("describe \"Young's modulus\"").out;
  EXPECT_EQ(young.rfind("Material/E\n", 0), 0u) << young;
  EXPECT_LE(n_lines(young), 20);
  EXPECT_EQ(run("describe modulus").out.rfind("Kernel/bulk modulus\n", 0), 0u);
  EXPECT_EQ(run("describe HORIZON").out, run("describe Study/horizon").out);
  EXPECT_EQ(run("describe kernel").out, run("describe Kernel").out);
  // in any order; where no key has all words, those that have the most
  EXPECT_EQ(run("describe 'modulus bulk'").out.rfind("Kernel/bulk modulus\n", 0), 0u);
  const std::string some = run("describe 'bulk unobtainium modulus'").out;
  EXPECT_EQ(
      some.rfind(
          "no key matches all of these words; the following match 2 of 3\nKernel/bulk modulus\n",
          0),
      0u)
      << some;
  const Outcome none = run("describe horizn");
  EXPECT_EQ(none.exit_code, 2);
  expect_found(none.err, "did you mean Study/horizon?");
  EXPECT_EQ(none.err.find("Output/fields"), std::string::npos); // not all keys
}

TEST(Finding, keys_and_words_are_taken_in_any_case_and_without_a_section_where_one_is_meant)
{
  const std::string common =
      "run " + scene + " --json --levels 1 --methods FA --set Expected/rates= ";
  const fs::path folder = temporary("case");
  const std::string rest = " --set Expected/verdicts= --set Expected/errors= --set "
                           "Expected/bounds= -o " +
                           folder.string();
  const std::string settings = " --set h=1/12,0.05 --set 'kernel/LIMIT=-1/2 laplace'";
  const Outcome outcome = run(common + settings + rest);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "0.0833333333333333");
  expect_refused("run " + scene + " --set seed=1",
                 "key 'seed' is in several sections; write one of: "
                 "Random/seed");
  const std::string twice =
      write("twice.prm", "subsection Study\n set h = 0.1\n set H = 0.2\nend\n");
  expect_refused("run " + twice, "H is given in line 2 already");
}

TEST(Finding, refusals_name_what_may_be_meant)
{
  const std::string one = "run " + scene;
  expect_refused(one + " --set Study/horizn=1", "did you mean Study/horizon?");
  expect_refused(one + " --set Sudy/h=1", "did you mean Study/h?");
  expect_refused(one + " --set Kernel/type=linear-decy", "did you mean linear-decay?");
  expect_refused(one + " --methods IPA-AC-R3", "did you mean IPA-AC-R2 or IPA-AC-R4?");
  expect_refused(one + " --thread 2", "the argument '--thread 2' is not known");
  expect_refused(one + " --thread 2", "did you mean --threads?");
  expect_found(run("moduli 1 --threads 2").err, "the argument '1 --threads 2' is not known");
  expect_found(run("dispersoin").err, "did you mean dispersion?");
  expect_found(run("rnu x.prm").err, "'rnu' is not a command; did you mean run?");
  expect_found(run("list kernel").err, "did you mean kernels?");
  expect_found(run("template scalr").err, "did you mean scalar?");
  expect_refused(one + " --set Study/h=0.0833333", "(12.0000048 cells)");
  expect_refused(one + " --set Study/h=1/0", "Study/h = '1/0' is not allowed");
}

namespace
{
  /// Coarser than the template, whose reference takes three minutes.
  const std::string coarse_bar =
      " --set Study/h=0.25 --set Study/horizon=0.5 --set 'Domain/fixed=0, 0 : 0.25, 1'";
} // namespace

TEST(Finding, short_templates_have_at_most_20_lines_and_run)
{
  for (const std::string model : {"scalar", "tensor", "LPS", "variational", "double-well"})
  {
    const std::string text = run("template " + model + " --short").out;
    EXPECT_LE(n_lines(text), 20) << model;
    EXPECT_NO_THROW(plumbline::scene::parse_scene("short.prm", text)) << model;
    const fs::path folder = temporary("short");
    const Outcome outcome = run("run " + write("short.prm", text) + " --levels 1 --methods FA -o " +
                                folder.string() + (model == "variational" ? coarse_bar : ""));
    EXPECT_EQ(outcome.exit_code, 0) << model << outcome.err;
  }
}

TEST(Finding, new_writes_a_scene_that_runs_and_overwrites_none)
{
  const fs::path name = temporary("new"), file = name.string() + ".prm";
  fs::remove(file);
  const std::string command = "new " + name.string() + " --kind elastic --methods FA,Q1";
  EXPECT_EQ(run(command + " --kernel bond-tensr").exit_code, 2);
  EXPECT_FALSE(fs::exists(file));
  const Outcome outcome = run(command);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "next: plumbline run " + file.string());
  const std::string text = read(file);
  expect_found(text, "set Methods/names = FA,Q1\n");
  EXPECT_EQ(run("run " + file.string() + " --levels 1 --quiet -o " + temporary("new_out").string())
                .exit_code,
            0);
  const Outcome again = run("new " + file.string());
  EXPECT_EQ(again.exit_code, 2);
  expect_found(again.err, "is there already and is not overwritten");
  EXPECT_EQ(read(file), text);
  const std::string cube = temporary("new_cube").string();
  fs::remove(cube + ".prm");
  EXPECT_EQ(run("new " + cube + " --kind elastic --domain cube").exit_code, 0);
  EXPECT_EQ(run("run " + cube + ".prm --levels 2 --quiet -o " + cube + "_out").exit_code, 0);
  const std::string solid = temporary("new_solid").string();
  fs::remove(solid + ".prm");
  EXPECT_EQ(run("new " + solid + " --kind LPS --domain cube").exit_code, 0);
  EXPECT_EQ(run("run " + solid + ".prm --levels 1 --quiet -o " + solid + "_out").exit_code, 0);
  const std::string bar = temporary("new_bar").string();
  fs::remove(bar + ".prm");
  EXPECT_EQ(run("new " + bar + " --kind variational").exit_code, 0);
  EXPECT_EQ(
      run("run " + bar + ".prm --levels 1 --methods FA --quiet -o " + bar + "_out" + coarse_bar)
          .exit_code,
      0);
  expect_found(run("new " + cube + "_k --kind variational --domain cube").err,
               "'cube', but --kind variational allows square only");
  expect_found(run("new " + name.string() + "2 --domain no.geo").err, "mesh file 'no.geo'");
  expect_found(run("new " + name.string() + "2 --domain no.stl").err, "a mesh file .geo or .msh");
  expect_found(run("new " + name.string() + "2 --kind variational --domain no.geo").err,
               "is a bar");
  expect_found(run("new " + name.string() + "2 --methods 'FA; Q1'").err,
               "no scene is written: Methods/names: method 'FA; Q1' is not known");
  expect_found(run("new " + name.string() + "2 --kind crack --methods Q1").err,
               "no scene is written: Methods/names = 'Q1' is not a meshfree rule");
  EXPECT_FALSE(fs::exists(name.string() + "2.prm"));
  expect_found(run("new " + name.string() + "2 --kind fluid").err, "model 'fluid' is not known");
}

TEST(Finding, new_takes_dimension_sizes_and_cells_from_a_mesh_file)
{
  const auto made = [](const std::string &file)
  {
    const std::string name = temporary("new_mesh").string();
    fs::remove(name + ".prm");
    const Outcome outcome = run("new " + name + " --domain " + file);
    EXPECT_EQ(outcome.exit_code, 0) << file << outcome.err;
    EXPECT_EQ(run("run " + name + ".prm --levels 1 --quiet -o " + name + "_out").exit_code, 0);
    return outcome.out + read(name + ".prm");
  };
  const std::string meshes = std::string(PLUMBLINE_SCENES) + "/";
  const std::string disk = made(meshes + "meshes/disk.geo");
  expect_found(disk, "triangles, physical surfaces omega, collar");
  expect_found(disk, "set Study/h = 0.1, 0.07, 0.05, 0.035\n");
  const std::string plate = made(meshes + "meshes/plate_with_hole.geo");
  expect_found(plate, "quadrilaterals");
  expect_found(plate, "IPA-AC-R2, Q1\n");
  // two squares of Ω and a layer of width 1 around them, which has no sizes to change
  const auto square =
      [](const std::string &lower, const std::string &upper, const std::string &more)
  {
    const auto point = [](int i, const std::string &x, const std::string &y)
    { return "Point(" + std::to_string(i) + ") = {" + x + ", " + y + ", 0, .5};"; };
    return write("square.geo",
                 point(1, "0", "0") + point(2, "1", "0") + point(3, "1", "1") + point(4, "0", "1") +
                     point(5, lower, lower) + point(6, upper, lower) + point(7, upper, upper) +
                     point(8, lower, upper) +
                     "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};"
                     "Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};"
                     "Curve Loop(1) = {1:4}; Curve Loop(2) = {5:8}; Plane Surface(1) = {1};"
                     "Plane Surface(2) = {2, 1}; Physical Surface(\"omega\") = {1};"
                     "Physical Surface(\"collar\") = {2};" +
                     more + "\n");
  };
  expect_found(made(square("-1", "2", "")), "is the same at all levels: the scene has one level");
  // a layer of three sides of length √2 / 4, which four digits round up
  const std::string exact = made(square("-1.06066017177982", "2.06066017177982",
                                        "Transfinite Curve{1:4} = 5; Transfinite Surface{1};"));
  expect_found(exact, "set Study/m = 3\n");
  expect_found(exact, "set Study/h = 0.353553390");
  // tetrahedra have entries of bond tensors, too
  expect_found(made(meshes + "three_d/ball.geo --kind elastic"), "= FA, IPA-AC, IPA-AC-R2, P1\n");
}

TEST(Finding, several_words_are_one_phrase)
{
  EXPECT_EQ(run("describe plane stress").out, run("describe 'plane stress'").out);
  EXPECT_EQ(run("moduli --m 3 --state plane-stress").out,
            run("moduli --m 3 --state 'plane stress'").out);
  expect_refused("moduli --E 200GPa", "200 GPa are 200e9 in Pa");
  expect_refused(
      "run " + write("plain.prm", "set Problem/solution = x^2\nset Methods/names = FA\n"
                                  "set Material/E = 200GPa\n"),
      "plain.prm', line 3: Material/E = '200GPa' does not parse: a unit or an unknown name");
}

TEST(Finding, a_scene_that_is_not_there_is_told_with_its_folder_and_similar_names)
{
  expect_refused("run no/glas.prm", "no such file in '" + (fs::current_path() / "no").string());
  expect_refused("run no/glas.prm", "did you mean ");
  expect_refused("run no/glas.prm", "griffith/glass.prm? 'plumbline list scenes' lists");
}

TEST(Finding, what_is_wrong_after_the_scene_was_read_is_told_with_its_line)
{
  const std::string file = write("late.prm", "set Methods/names = FA\nset Study/h = 0.1, 0.05\n"
                                             "set Problem/solution = 1/(x-x)\n");
  expect_refused("run " + file, "late.prm', line 3: Problem/solution = '1/(x-x)' gives inf");
  expect_refused("run " + file + " --set 'Problem/solution=2/(x-x)'",
                 "plumbline: Problem/solution = '2/(x-x)' gives inf");
  expect_refused("run " +
                     write("early.prm", "set Methods/names = FA\n\nset Problem/solution = q\n"),
                 "early.prm', line 3: Problem/solution = 'q' does not parse");
  expect_refused("run " + file + " --set Problem/solution=x^2 --methods Foo",
                 "plumbline: Methods/names: method 'Foo' is not known");
  expect_refused("stability " + file + " --set Problem/solution=x^2 --methods Foo",
                 "plumbline: Methods/names: method 'Foo' is not known");
}

TEST(Finding, new_writes_a_crack_in_si_units_that_runs)
{
  const std::string name = temporary("new_crack").string(), file = name + ".prm";
  fs::remove(file);
  const Outcome outcome = run("new " + name + " --kind crack");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "next: plumbline crack " + file);
  const std::string text = read(file);
  EXPECT_LE(n_lines(text), 20);
  for (const std::string line : {"set Material/E = 72e9", "set Material/toughness = 8",
                                 "set Time/density = 2440", "# kg/m^3", "# Pa; bonds have nu ="})
    expect_found(text, line);
  const fs::path folder = temporary("new_crack_out");
  const Outcome crack = run("crack " + file + " -o " + folder.string());
  EXPECT_EQ(crack.exit_code, 0) << crack.err;
  expect_found(crack.out, "the crack runs");
  // by hand: lambda = mu = .4 E of nu = 1/4, so that c_T = sqrt(.4 E / rho), c_R = .9194 c_T
  const auto record = read_json(folder / "crack.json").at("records")[0].at("scalars");
  const double c_R = .9194 * std::sqrt(.4 * 72e9 / 2440);
  EXPECT_NEAR(record.at("c_R").at("value").get<double>(), c_R, 1e-3 * c_R);
  const double speed = record.at("speed").at("value");
  EXPECT_GT(speed, .4 * c_R);
  EXPECT_LT(speed, .7 * c_R);
  EXPECT_EQ(run("template crack --short").exit_code, 0);
  expect_found(run("new " + name + "2 --kind crack --domain cube").err, "a crack runs in a strip");
}

TEST(Finding, new_gives_kernels_a_profile)
{
  for (const std::string kernel :
       {"table", "bond-tensor table", "gaussian", "exponential", "polynomial"})
  {
    const std::string name = temporary("new_kernel").string();
    for (const char *const ending : {".prm", ".csv"})
      fs::remove(name + ending);
    const bool is_tensor = kernel.find("tensor") != std::string::npos;
    const Outcome outcome =
        run("new " + name + " --kernel '" + kernel + "'" + (is_tensor ? " --kind elastic" : ""));
    EXPECT_EQ(outcome.exit_code, 0) << kernel << outcome.err;
    const bool has_table = kernel.find("table") != std::string::npos;
    EXPECT_EQ(fs::exists(name + ".csv"), has_table) << kernel;
    if (has_table)
      expect_found(outcome.out, " and " + name + ".csv (t = r / horizon and rho");
    EXPECT_EQ(
        run("run " + name + ".prm --levels 1 --methods FA --quiet -o " + name + "_out").exit_code,
        0)
        << kernel;
  }
  // a table that is there is kept, and no scene is left
  const std::string name = temporary("new_kept").string();
  std::ofstream(name + ".csv") << "mine";
  fs::remove(name + ".prm");
  EXPECT_EQ(run("new " + name + " --kernel table").exit_code, 2);
  EXPECT_EQ(read(name + ".csv"), "mine");
  EXPECT_FALSE(fs::exists(name + ".prm"));
}

TEST(Finding, what_a_crack_lacks_is_named_at_once)
{
  const std::string bare = write("bare.prm", "set Methods/names = FA\nset Study/m = 4\n");
  const std::string has_them = "writes a scene that has them";
  expect_refused("crack " + bare, "these are missing: Crack/notch (the notch's length), "
                                  "Kernel/limit = Navier, Material/model = double well, "
                                  "Time/final time (the duration)");
  expect_refused("crack " + bare, "'plumbline new NAME --kind crack' " + has_them);
  const std::string glass =
      "crack " + (fs::path(PLUMBLINE_SCENES) / "griffith/glass.prm").string() + " --set ";
  for (const std::string nothing : {"0", "0.0", "0e0"})
    expect_refused(glass + "Crack/notch=" + nothing, "this is missing: Crack/notch");
  expect_refused(
      glass + "Material/E= --set Material/toughness=",
      "this is missing: Material/E and Material/toughness (G_c), or Material/c and beta");
  expect_refused(glass + "Kernel/limit=-Laplace", "write Kernel/limit = Navier, not -Laplace");
  expect_refused("grow " + bare, "these are missing: Fracture/toughness (G_c)");
  for (const std::string ratio : {"0.25", "0.35"})
    expect_refused(
        glass + "'Material/model=LPS' --set Material/nu=" + ratio,
        "'plumbline crack' simulates bonds of Material/model = double well, for which nu "
        "= 1/4 in plane strain; write double well, with Material/nu = 0.25 or empty. For "
        "another nu, Material/model = LPS is supported by 'plumbline run'");
  expect_refused("crack no_such.prm", "scene 'no_such.prm' is not there");
}

TEST(Finding, a_number_of_levels_is_at_least_1)
{
  const std::string scene = (fs::path(PLUMBLINE_SCENES) / "three_d/wave_rates.prm").string();
  for (const std::string command : {"run ", "stability "})
  {
    const Outcome outcome = run(command + scene + " --levels 0");
    EXPECT_EQ(outcome.exit_code, 2);
    expect_found(outcome.err, "--levels");
    expect_found(outcome.err, "1 to 1000");
  }
}

TEST(Finding, help_has_commands_lists_and_keys)
{
  expect_found(run("help").out, "dispersion");
  expect_found(run("help Run").out, "Usage: plumbline run");
  EXPECT_EQ(run("help kernels").out, run("list kernels").out);
  EXPECT_EQ(run("help Study/h").out, run("describe Study/h").out);
  EXPECT_EQ(run("help nonsense").exit_code, 2);
}

TEST(Finding, completions_and_the_page_for_man_are_derived_from_the_parser)
{
  const std::string script = write("completion.bash", run("completion bash").out);
  const auto completed = [&](const std::string &words, int at)
  {
    const fs::path out = temporary("completed");
    const std::string text =
        write("complete.sh", "source " + script + "\nCOMP_WORDS=(plumbline " + words +
                                 "); COMP_CWORD=" + std::to_string(at) +
                                 "; _plumbline; echo \"${COMPREPLY[@]}\"\n");
    EXPECT_EQ(std::system(("bash " + text + " >" + out.string()).c_str()), 0);
    return read(out);
  };
  EXPECT_EQ(completed("disp", 1), "dispersion\n");
  EXPECT_EQ(completed("run x.prm --lev", 3), "--levels\n");
  EXPECT_EQ(completed("sample --wor", 2), "\n"); // hidden
  const std::string zsh = run("completion zsh").out;
  expect_found(zsh, "#compdef plumbline\n");
  expect_found(zsh, "'--levels[Only the first N levels of each sweep]:value:_files'");
  expect_found(zsh, "'--quiet[Print nothing but errors]'");
  if (std::system("command -v zsh >/dev/null") == 0)
  { // it parses the script, and runs nothing
    EXPECT_EQ(std::system(("zsh -n " + write("_plumbline", zsh)).c_str()), 0);
  }
  expect_found(run("completion fish").err, "shell 'fish' is not known; choose bash or zsh");
  const std::string page = run("man").out;
  expect_found(page, ".SS dispersion\n");
  expect_found(page, ".TP\n\\fB\\-\\-levels VALUE\\fR\nOnly the first N levels of each sweep\n");
}
