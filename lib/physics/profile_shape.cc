#include "physics/profile_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::physics
{
  namespace
  {
    constexpr double rounding = 16 * std::numeric_limits<double>::epsilon(); // of sums of terms

    using Polynomial = std::vector<double>; ///< coefficients of t^0, t^1, ...

    double value(const Polynomial &p, double t)
    {
      double sum = 0;
      for (std::size_t k = p.size(); k-- > 0;)
        sum = sum * t + p[k];
      return sum;
    }

    double size(const Polynomial &p)
    {
      double sum = 0;
      for (const double coefficient : p)
        sum += std::abs(coefficient);
      return sum;
    }

    Polynomial derivative(const Polynomial &p)
    {
      Polynomial result;
      for (std::size_t k = 1; k < p.size(); ++k)
        result.push_back(static_cast<double>(k) * p[k]);
      return result;
    }

    /// Where it changes sign in [from, to], ascending: once at most between two zeros of its
    /// derivative.
    std::vector<double> sign_changes(const Polynomial &p, double from, double to)
    {
      std::vector<double> ends{from};
      if (p.size() > 2)
        for (const double t : sign_changes(derivative(p), from, to))
          ends.push_back(t);
      ends.push_back(to);
      std::vector<double> found;
      for (std::size_t i = 1; i < ends.size(); ++i)
      {
        double low = ends[i - 1], high = ends[i];
        const bool is_negative = value(p, low) < 0;
        if (is_negative == (value(p, high) < 0))
          continue;
        for (double t = .5 * (low + high); t > low && t < high; t = .5 * (low + high))
          ((value(p, t) < 0) == is_negative ? low : high) = t;
        found.push_back(low);
      }
      return found;
    }

    LeastValue least(const Polynomial &p, double from, double to)
    {
      LeastValue result{from, value(p, from), rounding * size(p)};
      std::vector<double> candidates = sign_changes(derivative(p), from, to);
      candidates.push_back(to);
      for (const double t : candidates)
        if (const double found = value(p, t); found < result.value)
          result = {t, found, result.rounding};
      return result;
    }

    /// t^-lowest Σ a t^e.
    Polynomial polynomial(const RadialProfile::Powers &powers, int lowest)
    {
      Polynomial result(1);
      for (const PowerTerm &term : powers)
        if (term.coefficient != 0)
        {
          const auto k = static_cast<std::size_t>(term.exponent - lowest);
          result.resize(std::max(result.size(), k + 1));
          result[k] += term.coefficient;
        }
      return result;
    }

    /// t^(1-lowest) ρ' of ρ = t^lowest p.
    Polynomial slope(const Polynomial &p, int lowest)
    {
      Polynomial result = p;
      for (std::size_t k = 0; k < p.size(); ++k)
        result[k] *= static_cast<double>(k) + lowest;
      return result;
    }

    Polynomial times(double factor, Polynomial p)
    {
      for (double &coefficient : p)
        coefficient *= factor;
      return p;
    }

    /// Values of a smooth function over [from, to], t > 0.
    std::vector<std::array<double, 2>> samples(const RadialProfile &profile, double from, double to)
    {
      constexpr unsigned int n = 2048;
      std::vector<std::array<double, 2>> result;
      for (unsigned int i = 0; i <= n; ++i)
      {
        const double t = from + (to - from) * .5 * (1 - std::cos(M_PI * i / n));
        if (t > 0)
          result.push_back({t, profile(t)});
      }
      return result;
    }
  } // namespace

  LeastValue least_value(const RadialProfile &profile)
  {
    LeastValue result{0, std::numeric_limits<double>::infinity(), 0};
    const int lowest = profile.lowest_exponent();
    double from = 0;
    for (const RadialProfile::Piece &piece : profile.pieces())
    {
      LeastValue here{from, std::numeric_limits<double>::infinity(), 0};
      if (!piece.profile.is_function())
        here = least(polynomial(piece.profile.powers(), lowest), from, piece.end);
      else
        for (const auto &[t, rho] : samples(piece.profile, from, piece.end))
        {
          const double found = rho * std::pow(t, -lowest);
          here.rounding = std::max(here.rounding, rounding * std::abs(found));
          if (found < here.value)
          {
            here.t = t;
            here.value = found;
          }
        }
      if (here.value < result.value)
        result = here;
      from = piece.end;
    }
    return result;
  }

  bool is_positive_and_non_increasing(const RadialProfile &profile, double sign)
  {
    const int lowest = profile.lowest_exponent();
    double from = 0;
    for (const RadialProfile::Piece &piece : profile.pieces())
    {
      if (piece.profile.is_function())
      {
        double before = std::numeric_limits<double>::infinity(), largest = 0;
        for (const auto &[t, rho] : samples(piece.profile, from, piece.end))
        {
          largest = std::max(largest, std::abs(rho));
          if (sign * rho < 0 || sign * rho > before + rounding * largest)
            return false;
          before = sign * rho;
        }
      }
      else
      {
        const Polynomial p = times(sign, polynomial(piece.profile.powers(), lowest));
        const LeastValue of_value = least(p, from, piece.end),
                         of_fall = least(times(-1, slope(p, lowest)), from, piece.end);
        if (of_value.value < -of_value.rounding || of_fall.value < -of_fall.rounding)
          return false;
      }
      from = piece.end;
    }
    return true;
  }
} // namespace plumbline::physics
