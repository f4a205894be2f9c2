#include "base/communicator.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <string>

using namespace plumbline;

// MPI is not started here: one rank, as in a program that never does
TEST(Communicator, hands_on_what_an_action_throws_with_its_kind_and_words)
{
  const base::Communicator communicator = base::Communicator::all();
  int n_done = 0;
  communicator.together([&] { ++n_done; });
  EXPECT_EQ(n_done, 1);
  try
  {
    communicator.together([] { throw InputError("h = 0; give a length"); });
    FAIL() << "nothing was thrown";
  }
  catch (const InputError &error)
  {
    EXPECT_EQ(std::string(error.what()), "h = 0; give a length");
  }
  EXPECT_THROW(communicator.together([] { throw NumericalError("it does not settle"); }),
               NumericalError);
}
