#include "io/point_vtu.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace
{
  using namespace plumbline;

  std::string written(const analysis::PointField &field)
  {
    const auto file = std::filesystem::temp_directory_path() /
                      ("plumbline_" + std::to_string(getpid()) + "_points") / "field.vtu";
    io::write_vtu(field, file);
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    std::filesystem::remove_all(file.parent_path());
    return text.str();
  }

  /// Of an array of doubles by its name.
  std::vector<double> values(const std::string &text, const std::string &name)
  {
    const auto at = text.find("<DataArray type=\"Float64\" Name=\"" + name + "\"");
    if (at == std::string::npos)
      return {};
    const auto begin = text.find('>', at) + 1;
    std::istringstream numbers(text.substr(begin, text.find('<', begin) - begin));
    std::vector<double> result;
    for (std::string word; numbers >> word;)
      result.push_back(std::strtod(word.c_str(), nullptr));
    return result;
  }
} // namespace

TEST(PointVtu, has_the_same_doubles_as_the_field)
{
  const std::string text = written({1, {{1. / 3, .1}, {2e-20, 5}}, {1 / 7., -3e300}});
  EXPECT_EQ(values(text, "points"), (std::vector<double>{1. / 3, .1, 0, 2e-20, 5, 0}));
  EXPECT_EQ(values(text, "u"), (std::vector<double>{1 / 7., -3e300}));
  EXPECT_EQ(text.find("Float32"), std::string::npos);
  EXPECT_NE(text.find("NumberOfPoints=\"2\" NumberOfCells=\"2\""), std::string::npos);
}

TEST(PointVtu, has_two_components_as_a_vector_and_more_by_number)
{
  EXPECT_EQ(values(written({2, {{0, 0}}, {.1, .2}}), "u"), (std::vector<double>{.1, .2, 0}));
  const std::string text = written({3, {{0, 0}, {1, 0}}, {.1, .2, .3, .4, .5, .6}});
  EXPECT_EQ(values(text, "u2"), (std::vector<double>{.2, .5}));
}
