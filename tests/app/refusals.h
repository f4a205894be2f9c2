// A scene that is changed into bad ones, and what the command is to say to each.
#pragma once

#include "command.h"

#include <vector>

namespace plumbline::app
{
  struct Trial
  {
    std::string settings;               ///< after the scene
    std::vector<std::string> fragments; ///< of what is to be on stderr
  };

  inline std::string set(const std::string &key, const std::string &value)
  {
    return "--set '" + key + "=" + value + "' ";
  }

  /// A folder with the scene, for as long as the test runs.
  class Refusals : public testing::Test
  {
  protected:
    Refusals(const std::string &name, std::string scene)
        : folder_(temporary(name)), scene_(std::move(scene))
    {
    }
    void SetUp() override
    {
      fs::create_directory(folder_);
      write("scene.prm", scene_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    /// Beside the scene, so that its name will do.
    void write(const std::string &name, const std::string &text) const
    {
      std::ofstream(folder_ / name) << text;
    }

    fs::path output(std::size_t number) const { return folder_ / ("run" + std::to_string(number)); }

    std::vector<Outcome> run(const std::vector<Trial> &runs) const
    {
      std::vector<Outcome> outcomes;
      for (const Trial &trial : runs)
        outcomes.push_back(app::run("run " + (folder_ / "scene.prm").string() + " --threads 1 -o " +
                                    output(outcomes.size()).string() + " " + trial.settings));
      return outcomes;
    }

    void expect_refusals(const std::vector<Trial> &runs) const
    {
      const auto outcomes = run(runs);
      for (std::size_t i = 0; i < runs.size(); ++i)
      {
        EXPECT_EQ(outcomes[i].out, "") << runs[i].settings;
        EXPECT_FALSE(fs::exists(output(i))) << "partial output for " << runs[i].settings;
        expect(runs[i], outcomes[i], 2);
      }
    }

    static void expect(const Trial &run, const Outcome &outcome, int exit_code)
    {
      EXPECT_EQ(outcome.exit_code, exit_code) << run.settings << '\n' << outcome.err;
      for (const std::string &fragment : run.fragments)
        expect_found(outcome.err, fragment, "for " + run.settings);
    }

  private:
    const fs::path folder_;
    const std::string scene_;
  };
} // namespace plumbline::app
