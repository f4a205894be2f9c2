#include "analysis/checkpoint.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

using namespace plumbline;
using namespace plumbline::analysis;
namespace fs = std::filesystem;

namespace
{
  std::string temporary_file()
  {
    const fs::path file =
        fs::path(testing::TempDir()) / ("plumbline_" + std::to_string(getpid()) + "_checkpoint.h5");
    fs::remove(file);
    return file.string();
  }

  const Checkpoint some = {"a strip, = 'μ'\n", {{.1, -0., 1e-310}, {1. / 3, 2, 3}, .7}, {4, 5}};

  /// @return the message
  std::string refusal(const std::string &file)
  {
    try
    {
      (void)read_checkpoint(file);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return {};
  }
} // namespace

TEST(Checkpoint, comes_back_to_the_last_bit_and_replaces_what_was_there)
{
  const std::string file = temporary_file();
  EXPECT_FALSE(read_checkpoint(file));
  write_checkpoint(file, {"another", {{1}, {1}, 1}, {}});
  write_checkpoint(file, some);
  const auto back = read_checkpoint(file);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->subject, some.subject);
  EXPECT_EQ(back->state.u, some.state.u);
  EXPECT_TRUE(std::signbit(back->state.u[1]));
  EXPECT_EQ(back->state.v, some.state.v);
  EXPECT_EQ(back->state.t, some.state.t);
  EXPECT_EQ(back->records, some.records);
  EXPECT_FALSE(fs::exists(file + ".part"));
  fs::remove(file);
}

TEST(Checkpoint, that_is_broken_is_refused)
{
  const std::string file = temporary_file();
  write_checkpoint(file, some);
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  const std::string whole = text.str();
  for (const std::size_t n : {std::size_t{0}, std::size_t{7}, whole.size() / 2, whole.size() - 8})
  {
    std::ofstream(file, std::ios::binary) << whole.substr(0, n);
    EXPECT_NE(refusal(file).find("remove it to begin anew"), std::string::npos) << n;
  }
  for (std::size_t i = 0; i < whole.size(); i += 13) // a state, or an error, and no crash
  {
    std::string bad = whole;
    bad[i] = static_cast<char>(~bad[i]);
    std::ofstream(file, std::ios::binary) << bad;
    (void)refusal(file);
  }
  fs::remove(file);
}

TEST(Checkpoint, that_cannot_be_written_is_said_and_the_last_one_stays)
{
  const std::string file = temporary_file();
  write_checkpoint(file, some);
  fs::create_symlink("/dev/full", file + ".part");
  EXPECT_THROW(write_checkpoint(file, {"another", {{1}, {1}, 1}, {}}), InputError);
  EXPECT_EQ(read_checkpoint(file)->subject, some.subject);
  EXPECT_THROW(write_checkpoint("/nowhere/at/all.h5", some), InputError);
  fs::remove(file);
}
