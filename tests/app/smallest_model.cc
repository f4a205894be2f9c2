// The report says what the smallest model of a scene left out, and the full one leaves out nothing.

#include "command.h"

#include "io/results_json.h"

namespace
{
  using namespace plumbline;

  const std::string solid = "--set Kernel/type=1/r --set Kernel/limit=Navier "
                            "--set Material/model=LPS --set Material/E=1 "
                            "--set 'Problem/solution=x, y' ";

  /// What a run on one small level left out.
  std::vector<std::string> omissions(const std::string &settings)
  {
    const std::string scene = app::write("small.prm", "subsection Problem\n set solution = x\nend\n"
                                                      "subsection Methods\n set names = FA\nend\n"
                                                      "subsection Study\n set h = 0.25\nend\n");
    const app::fs::path folder = app::temporary("omissions");
    const auto outcome = app::run("run " + scene + " -o " + folder.string() + " " + settings);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::vector<std::string> names;
    for (const study::Omission &omission : io::read_results(folder / "results.json").omissions)
    {
      EXPECT_FALSE(omission.why.empty() || omission.saving.empty()) << omission.what;
      names.push_back(omission.what);
    }
    app::fs::remove(scene);
    app::fs::remove_all(folder);
    return names;
  }
} // namespace

TEST(SmallestModel, is_reported_by_what_it_left_out)
{
  const std::vector<std::string> linear = {"Newton's method", "bond state"};
  const auto expect = [&](const std::string &settings, std::vector<std::string> expected)
  {
    expected.insert(expected.end(), linear.begin(), linear.end());
    EXPECT_EQ(omissions(settings), expected) << settings;
  };
  const std::string means = "means of the material at both ends of each bond";
  expect("", {"a matrix", "the second component"});
  expect("--set Domain/mesh=squares",
         {"exact geometry in every cell", "a coefficient at every bond", "the second component"});
  expect(solid + "--set Material/nu=0.25", {"a matrix", "the dilatation", means});
  expect(solid + "--set Material/nu=0.3", {"a matrix", "the dilatation as an unknown", means});
  expect(solid + "--set Material/nu=0.3 --set Domain/mesh=squares --set 'Material/E=1 + x/8'",
         {"exact geometry in every cell"});
}

TEST(SmallestModel, that_can_crack_keeps_the_state_of_its_bonds)
{
  EXPECT_EQ(omissions(solid + "--set Material/nu=0.3 --set Domain/mesh=squares "
                              "--set 'Domain/cracks=0.5, 0.5 : 0.7, 0.5'")
                .back(),
            "Newton's method");
}

TEST(FullModel, leaves_out_nothing)
{
  for (const std::string &settings : {std::string(), solid + "--set Material/nu=0.25"})
    EXPECT_EQ(omissions(settings + " --model full"), std::vector<std::string>());
}
