// Random numbers that are the same everywhere, and their distributions.
#include "uq/generator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using plumbline::uq::Generator;

namespace
{
  /// By how many standard errors the mean and the variance of 40,000 numbers are off those of their
  /// distribution: no more than 4 for one seed in 10,000.
  constexpr int n_numbers = 40'000;
  constexpr double most_standard_errors = 4;

  void expect_moments(const std::function<double()> &draw, double mean, double variance,
                      double fourth_moment)
  {
    double sum = 0, squares = 0;
    for (int i = 0; i < n_numbers; ++i)
    {
      const double x = draw() - mean;
      sum += x;
      squares += x * x;
    }
    EXPECT_LT(std::abs(sum / n_numbers), most_standard_errors * std::sqrt(variance / n_numbers));
    EXPECT_LT(std::abs(squares / n_numbers - variance),
              most_standard_errors * std::sqrt((fourth_moment - variance * variance) / n_numbers));
  }
} // namespace

TEST(Generator, gives_the_numbers_that_the_standard_specifies)
{
  // from seed_seq and mersenne_twister_engine of C++17 ([rand.util.seedseq], [rand.eng.mers]),
  // written anew in Python
  Generator first(1), second(20221, 7), third((5ull << 32) + 3, (1ull << 32) + 2);
  for (const double expected : {.4180840146625463, .3290213309830067, .155828085095028})
    EXPECT_EQ(first.uniform(), expected);
  for (const double expected : {.5258034498729791, .5484743001915134, .5958608259856204})
    EXPECT_EQ(second.uniform(), expected);
  for (const double expected : {.8547019778453402, .15260619689161126, .3917037346865243})
    EXPECT_EQ(third.uniform(), expected);
}

TEST(Generator, has_uniform_and_normal_numbers)
{
  Generator numbers(3);
  expect_moments([&] { return numbers.uniform(); }, .5, 1 / 12., 1 / 80.);
  expect_moments([&] { return numbers.normal(); }, 0, 1, 3);
}

TEST(Generator, has_normal_numbers_that_are_independent_within_their_pair)
{
  Generator numbers(4);
  double product = 0, squares = 0;
  for (int i = 0; i < n_numbers; ++i)
  {
    const double a = numbers.normal(), b = numbers.normal();
    product += a * b;
    squares += (a * a - 1) * (b * b - 1); // of variance 4
  }
  EXPECT_LT(std::abs(product / n_numbers), most_standard_errors / std::sqrt(n_numbers));
  EXPECT_LT(std::abs(squares / n_numbers), most_standard_errors * 2 / std::sqrt(n_numbers));
}

TEST(Generator, has_numbers_of_Poisson_whose_variance_is_their_mean)
{
  Generator numbers(5);
  for (const double mean : {.3, 4., 252.5})
    expect_moments([&] { return numbers.poisson(mean); }, mean, mean, mean + 3 * mean * mean);
  EXPECT_EQ(numbers.poisson(0), 0u);
}
