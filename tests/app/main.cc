// Tests of the command, or, where the first word is no option, the command itself: samples begin
// their own program again.
#include "app/command.h"

#include <gtest/gtest.h>

int main(int argc, char **argv)
{
  if (argc > 1 && argv[1][0] != '-')
    return plumbline::app::command(argc, argv);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
