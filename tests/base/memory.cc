#include "base/memory.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <cmath>
#include <string>

using namespace plumbline;
using namespace plumbline::base;

TEST(Memory, that_is_available_is_some)
{
  EXPECT_GT(available_memory(), 1e6);
}

TEST(Memory, of_more_than_there_is_is_refused_with_both_numbers_and_the_remedy)
{
  EXPECT_NO_THROW(require_memory(1, "a byte", "take less"));
  try
  {
    require_memory(1.23e30, "Q1 at h = 1", "take less");
    FAIL();
  }
  catch (const InputError &error)
  {
    const std::string text = error.what();
    EXPECT_EQ(text.find("Q1 at h = 1: needs some 1.2e+21 GB of memory, and "), 0u) << text;
    EXPECT_NE(text.find("B are available; take less"), std::string::npos) << text;
  }
}

TEST(Memory, of_processes_side_by_side_is_that_of_all_of_them)
{
  const double part = 1e-3 * available_memory();
  EXPECT_EQ(memory_fault(part, "Q1", "take less"), "");
  EXPECT_EQ(memory_fault(part, "Q1", "take less", 10), "");
  const std::string text = memory_fault(part, "Q1", "take less", 4000);
  EXPECT_NE(text.find(" of memory in each of 4000 processes (--jobs), and "), std::string::npos)
      << text;
  EXPECT_NE(text.find("; lower --jobs, or take less"), std::string::npos) << text;
  // where not one fits, fewer of them are no remedy
  const std::string large = memory_fault(1.23e30, "Q1", "take less", 4);
  EXPECT_NE(large.find("available; take less"), std::string::npos) << large;
}

TEST(Memory, is_said_to_two_digits)
{
  EXPECT_EQ(bytes_to_text(1.56e9), "1.6 GB");
  EXPECT_EQ(bytes_to_text(123e9), "120 GB");
  EXPECT_EQ(bytes_to_text(3.21e8), "320 MB");
  EXPECT_EQ(bytes_to_text(0), "0 MB");
}

#ifndef __SANITIZE_ADDRESS__ // which takes all of the address space
TEST(Memory, ends_where_the_address_space_does)
{
  const auto limited = []
  {
    const rlimit limit{std::size_t(6) << 30, std::size_t(6) << 30};
    setrlimit(RLIMIT_AS, &limit);
    std::exit(available_memory() <= 6.5e9 ? 0 : 1);
  };
  EXPECT_EXIT(limited(), testing::ExitedWithCode(0), "");
}
#endif
