// Eigenvalues of matrices that are not symmetric, against closed forms.
#include "algebra/eigenvalues.h"
#include "base/error.h"
#include "tests/algebra/little_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

using namespace plumbline;
using namespace plumbline::algebra;

namespace
{
  using Complex = std::complex<double>;

  /// A tridiagonal Toeplitz matrix: convection and diffusion in one direction. Its eigenvalues are
  /// a + 2 √(lower upper) cos(π k / (n + 1)).
  struct Toeplitz
  {
    unsigned int n;
    double lower, diagonal, upper;

    double entry(unsigned int i, unsigned int j) const
    {
      return i == j ? diagonal : j + 1 == i ? lower : i + 1 == j ? upper : 0;
    }

    Complex eigenvalue(unsigned int k) const
    {
      return diagonal + 2. * std::sqrt(Complex(lower * upper)) * std::cos(M_PI * k / (n + 1));
    }
  };

  /// The sum over two directions, and its eigenvalues: sums of those in each.
  struct Plane
  {
    CsrMatrix rows;
    double smallest_real = 1e300, smallest_modulus = 1e300, largest_modulus = 0,
           largest_imaginary = 0;

    Plane(const Toeplitz &a, const Toeplitz &b)
    {
      rows.start.assign(1, 0);
      for (unsigned int i = 0; i < a.n * b.n; ++i)
      {
        const unsigned int ia = i % a.n, ib = i / a.n;
        for (unsigned int j = 0; j < a.n * b.n; ++j)
        {
          const unsigned int ja = j % a.n, jb = j / a.n;
          const double value = (ib == jb ? a.entry(ia, ja) : 0) + (ia == ja ? b.entry(ib, jb) : 0);
          if (value != 0)
          {
            rows.column.push_back(j);
            rows.value.push_back(value);
          }
        }
        rows.start.push_back(rows.column.size());
        const Complex value = a.eigenvalue(ia + 1) + b.eigenvalue(ib + 1);
        smallest_real = std::min(smallest_real, value.real());
        smallest_modulus = std::min(smallest_modulus, std::abs(value));
        largest_modulus = std::max(largest_modulus, std::abs(value));
        largest_imaginary = std::max(largest_imaginary, std::abs(value.imag()));
      }
    }
  };

  void expect_found(const Plane &plane)
  {
    const Eigenvalues found = eigenvalues(plane.rows);
    const double size = 1e-8 * plane.largest_modulus;
    EXPECT_NEAR(found.smallest_real, plane.smallest_real, size);
    EXPECT_NEAR(found.smallest_modulus, plane.smallest_modulus, size);
    EXPECT_NEAR(found.largest_modulus, plane.largest_modulus, size);
    EXPECT_NEAR(found.largest_imaginary, plane.largest_imaginary, size);
  }
} // namespace

TEST(Eigenvalues, of_convection_and_diffusion_are_those_in_closed_form)
{
  // few unknowns, then so many that iterations find them
  expect_found(Plane({8, -1.3, 2, -.7}, {6, -1.9, 2, .3}));
  expect_found(Plane({61, -1.1, 2, -.9}, {5, -1.05, 2, .95}));
}

TEST(Eigenvalues, that_cross_to_the_left_are_found_far_from_zero)
{
  // the smallest modulus is that of an inner one
  expect_found(Plane({61, -1.1, 2, -.9}, {5, -1.05, -1.5, .95}));
}

TEST(Eigenvalues, of_a_singular_matrix_are_found)
{
  const Toeplitz a{31, -1.1, 2, -.9}, b{11, -1.05, 2, -.95};
  const double least = a.eigenvalue(a.n).real() + b.eigenvalue(b.n).real();
  const Eigenvalues found = eigenvalues(Plane(a, {11, -1.05, 2 - least, -.95}).rows);
  EXPECT_NEAR(found.smallest_modulus, 0, 1e-12);
  EXPECT_NEAR(found.smallest_real, 0, 1e-12);
  EXPECT_GT(found.largest_modulus, 7);
}

#ifndef __SANITIZE_ADDRESS__ // which takes all of the address space
TEST(Eigenvalues, of_a_matrix_whose_factors_do_not_fit_are_refused)
{
  const Toeplitz one{120, -1, 2, -1};
  const Plane plane(one, one);
  const LittleMemory some(4'000'000); // factors take 9 MB
  try
  {
    eigenvalues(plane.rows);
    FAIL();
  }
  catch (const NumericalError &error)
  {
    const std::string text = error.what();
    EXPECT_NE(text.find("14400 unknowns: needs some "), std::string::npos) << text;
    EXPECT_NE(text.find("take a coarser level (--levels)"), std::string::npos) << text;
  }
}
#endif

TEST(Eigenvalues, of_values_that_are_no_numbers_are_refused)
{
  Plane plane({31, -1.1, 2, -.9}, {11, -1.05, 2, .95});
  plane.rows.value[7] = std::nan("");
  try
  {
    eigenvalues(plane.rows);
    ADD_FAILURE() << "no error";
  }
  catch (const NumericalError &error)
  {
    EXPECT_NE(std::string(error.what()).find("entries that are no numbers"), std::string::npos)
        << error.what();
  }
}
