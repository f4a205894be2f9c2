#pragma once

#include "physics/chebyshev_basis.h"

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace plumbline::physics
{
  /// A function of s >= 0 by polynomials of degree 9, sixteen for each doubling of 1 + s up to 2^64
  /// and the last value beyond. For functions that are smooth on the scale of 1 + s.
  class PiecewisePolynomial
  {
  public:
    /// By interpolation at Chebyshev points.
    /// @param function  double(double s)
    template <class Function>
    explicit PiecewisePolynomial(const Function &function)
    {
      constexpr unsigned int n = n_coefficients;
      const auto transform = chebyshev_transform(n), powers = monomials();
      for (int piece = 0; piece < n_pieces; ++piece)
      {
        std::array<double, n> chebyshev{};
        for (unsigned int i = 0; i < n; ++i)
        {
          const double value = function(place(piece, std::cos(M_PI * (i + .5) / n)));
          for (unsigned int k = 0; k < n; ++k)
            chebyshev[k] += transform[k * n + i] * value;
        }
        for (unsigned int i = n; i-- > 0;) // the highest power first
        {
          double sum = 0;
          for (unsigned int k = 0; k < n; ++k)
            sum += powers[k * n + i] * chebyshev[k];
          coefficients_.push_back(sum);
        }
      }
    }

    /// Of the lanes of a vector.
    template <class Vector>
    [[gnu::always_inline]] Vector operator()(Vector s) const
    {
      using Bits = decltype(s < s);
      constexpr int mantissa_bits = 52, exponent_bias = 1023;
      constexpr long long below = (1LL << (mantissa_bits - log_parts)) - 1,
                          one = static_cast<long long>(exponent_bias) << mantissa_bits;
      constexpr int width = sizeof(Vector) / sizeof(double);
      const Vector last = Vector{} + largest, sum_with_one = 1 + s,
                   t = sum_with_one < last ? sum_with_one : last; // not a number: the last
      const Bits bits = (Bits)t,
                 piece = (bits >> (mantissa_bits - log_parts)) - (exponent_bias << log_parts);
      const Vector x = ((Vector)((bits & below) | one) - 1) * (2 << log_parts) - 1;
      const double *from[width];
      for (int l = 0; l < width; ++l)
        from[l] = coefficients_.data() + piece[l] * n_coefficients;
      Vector sum{};
      for (unsigned int k = 0; k < n_coefficients; ++k)
      {
        Vector coefficient;
        for (int l = 0; l < width; ++l)
          coefficient[l] = from[l][k];
        sum = sum * x + coefficient;
      }
      return sum;
    }

    double operator()(double s) const
    {
      using One = double __attribute__((vector_size(sizeof(double))));
      return (*this)(One{s})[0];
    }

    static constexpr int n_pieces = 64 * 16;

    /// s of x in [-1, 1] on a piece.
    static double place(int piece, double x)
    {
      const double part = (piece % n_parts + .5 * (1 + x)) / n_parts;
      const int octave = piece / n_parts;
      return octave == 0 ? part : std::ldexp(1 + part, octave) - 1;
    }

    static constexpr double largest = 18446744073709549568.; ///< of 1 + s, before 2^64

  private:
    static constexpr int log_parts = 4, n_parts = 1 << log_parts;
    static constexpr unsigned int n_coefficients = 10;

    /// Of T_k, shape (n, n).
    static std::vector<double> monomials()
    {
      constexpr unsigned int n = n_coefficients;
      std::vector<double> rows(n * n);
      rows[0] = rows[n + 1] = 1;
      for (unsigned int k = 2; k < n; ++k)
        for (unsigned int i = 0; i < n; ++i)
          rows[k * n + i] = (i > 0 ? 2 * rows[(k - 1) * n + i - 1] : 0) - rows[(k - 2) * n + i];
      return rows;
    }

    std::vector<double> coefficients_; ///< shape (n_pieces, n_coefficients)
  };
} // namespace plumbline::physics
