#include "base/cost.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <thread>
#include <vector>

using namespace plumbline::base;

namespace
{
  /// Works until the process has used so many more CPU seconds, by the C library's own clock.
  double work(double seconds)
  {
    const std::clock_t start = std::clock();
    const auto used = [&] { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; };
    volatile double sum = 0;
    while (used() < seconds)
      for (int i = 0; i < 1000; ++i)
        sum = sum + std::sqrt(static_cast<double>(i));
    return used();
  }

  constexpr std::size_t megabyte = 1000000;

  /// Memory that is not only asked for but used, so that it is resident.
  std::vector<char> resident(std::size_t n_bytes)
  {
    return std::vector<char>(n_bytes, 1);
  }
} // namespace

TEST(CostTimer, counts_cpu_seconds_and_not_the_time_that_passes)
{
  constexpr double clock_tick = .02; // of the clock that it is compared with, and more
  CpuTimer timer;
  const double used = work(.15);
  EXPECT_NEAR(timer.seconds(), used, clock_tick);
  timer.restart();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_LT(timer.seconds(), .1);
}

TEST(MemoryGauge, measures_the_peak_above_what_stood_before)
{
  const auto before = resident(100 * megabyte);
  const MemoryGauge gauge;
  {
    const auto block = resident(64 * megabyte);
    EXPECT_EQ(block.back(), before.back());
  }
  // pages, and what the allocator and the system add
  EXPECT_GT(gauge.peak_bytes(), 60 * megabyte);
  EXPECT_LT(gauge.peak_bytes(), 80 * megabyte);
}

TEST(MemoryGauge, forgets_a_higher_peak_of_the_past)
{
  const bool can_forget = (std::ofstream("/proc/self/clear_refs") << "5").flush().good();
  (void)resident(200 * megabyte);
  const MemoryGauge gauge;
  (void)resident(32 * megabyte);
  if (can_forget)
  {
    EXPECT_GT(gauge.peak_bytes(), 28 * megabyte);
    EXPECT_LT(gauge.peak_bytes(), 50 * megabyte);
  }
  else // the growth of the peak of all time: none
    EXPECT_LT(gauge.peak_bytes(), 4 * megabyte);
}
