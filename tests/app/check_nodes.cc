// `plumbline check`: the table of nodes says how many findings name each of them.

#include "check_command.h"

#include <map>
#include <sstream>

using namespace plumbline::app;

TEST(CheckNodes, count_the_outliers_that_name_them_at_either_end)
{
  const fs::path out = temporary("check_nodes");
  EXPECT_EQ(
      check(nodes_file, (folder / "bonds_wrong.csv").string(), "-o " + out.string()).exit_code, 1);
  std::istringstream rows(read(out / "nodes.csv"));
  std::string row;
  std::getline(rows, row);
  EXPECT_EQ(row.substr(row.rfind(',') + 1), "outliers");
  std::map<std::string, std::string> flagged; // by id
  while (std::getline(rows, row))
    if (const std::string count = row.substr(row.rfind(',') + 1); count != "0")
      flagged[row.substr(0, row.find(','))] = count;
  // the weight from 77 to 79 alone is wrong
  EXPECT_EQ(flagged, (std::map<std::string, std::string>{{"77", "1"}, {"79", "1"}}));
}
