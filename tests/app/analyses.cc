#include "driver/analyses.h"
#include "command.h"

using namespace plumbline;

// files, journals and Python find an analysis by the name of its command
TEST(Analyses, are_called_as_their_commands)
{
  for (const driver::AnalysisRow &row : driver::analyses())
  {
    EXPECT_EQ(row.make({}).name, row.name);
    EXPECT_EQ(driver::find_analysis(row.name), &row);
    app::expect_found(app::run("help " + row.name).out, row.help);
  }
  EXPECT_EQ(driver::find_analysis("run"), nullptr); // it has two analyses; the scene's time decides
}
