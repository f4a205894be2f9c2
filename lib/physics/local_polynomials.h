#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace plumbline::physics
{
  /// n functions of one variable that are evaluated together, each by a polynomial on every
  /// interval: short ones near 1, where potentials have a logarithm, longer ones far below. As good
  /// as Chebyshev's interpolant of ten points. A value; thread safe.
  template <unsigned int n>
  class LocalPolynomials
  {
  public:
    using Values = std::array<double, n>;

    LocalPolynomials() = default;

    /// @param function  double -> Values
    /// @param from, to  where it is wanted, to < 1
    template <class Function>
    LocalPolynomials(const Function &function, double from, double to)
        : far_(function, std::min(from, knee), knee, 1. / 16), near_(function, knee, to, 1. / 128)
    {
    }

    Values operator()(double x) const { return first<n>(x); }

    /// The first m functions; what is said of the others has no meaning.
    template <unsigned int m>
    Values first(double x) const
    {
      return x < knee ? far_.template first<m>(x) : near_.template first<m>(x);
    }

  private:
    static constexpr unsigned int n_terms = 10; ///< of a polynomial
    static constexpr double knee = -.5;

    class Intervals
    {
    public:
      Intervals() = default;

      template <class Function>
      Intervals(const Function &function, double from, double to, double length)
          : start_(from), length_(length)
      {
        const auto n_intervals = static_cast<std::size_t>(std::ceil((to - from) / length)) + 1;
        coefficients_.assign(n_intervals * n_terms, {});
        for (std::size_t i = 0; i < n_intervals; ++i)
          fit(function, from + length * i, &coefficients_[i * n_terms]);
      }

      template <unsigned int m>
      Values first(double x) const
      {
        const double place = (x - start_) * (1 / length_);
        const auto i = static_cast<unsigned int>(place);
        const Values *const c = &coefficients_[i * n_terms];
        const double t = 2 * (place - i) - 1, square = t * t;
        Values even = c[n_terms - 2], odd = c[n_terms - 1]; // two chains, side by side
        for (unsigned int k = n_terms - 2; k > 0;)
        {
          k -= 2;
#pragma GCC unroll 13
          for (unsigned int j = 0; j < m; ++j)
          {
            even[j] = even[j] * square + c[k][j];
            odd[j] = odd[j] * square + c[k + 1][j];
          }
        }
        for (unsigned int j = 0; j < m; ++j)
          even[j] += t * odd[j];
        return even;
      }

    private:
      /// Chebyshev's interpolant on an interval, in powers of t in (-1, 1).
      template <class Function>
      void fit(const Function &function, double from, Values *powers) const
      {
        std::array<Values, n_terms> value;
        for (unsigned int j = 0; j < n_terms; ++j)
          value[j] = function(from + length_ * (.5 + .5 * std::cos(M_PI * (j + .5) / n_terms)));
        std::array<double, n_terms> before{}, now{}; // powers of T_(k-1), T_k
        now[0] = 1;
        for (unsigned int k = 0; k < n_terms; ++k)
        {
          Values coefficient{};
          for (unsigned int j = 0; j < n_terms; ++j)
            for (unsigned int e = 0; e < n; ++e)
              coefficient[e] += (k == 0 ? 1. : 2.) / n_terms * value[j][e] *
                                std::cos(M_PI * k * (j + .5) / n_terms);
          for (unsigned int p = 0; p < n_terms; ++p)
            for (unsigned int e = 0; e < n; ++e)
              powers[p][e] += coefficient[e] * now[p];
          std::array<double, n_terms> next{};
          for (unsigned int p = 0; p < n_terms; ++p)
            next[p] = (p > 0 ? (k == 0 ? 1 : 2) * now[p - 1] : 0) - before[p];
          before = now;
          now = next;
        }
      }

      double start_ = 0, length_ = 1;
      std::vector<Values> coefficients_; ///< shape (n_intervals, n_terms)
    };

    Intervals far_, near_;
  };
} // namespace plumbline::physics
