#include "physics/radial_profile.h"

#include "base/error.h"
#include "physics/gauss.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace plumbline::physics
{
  namespace
  {
    constexpr unsigned int n_samples = 128; ///< of an interval, at Chebyshev's points
    constexpr unsigned int n_levels = 8;    ///< intervals of length 1, 1/2, ...
    /// Accuracies that degrees are known for, of the largest value. Chebyshev coefficients below
    /// the first are the rounding of the samples.
    constexpr std::array<double, 5> accuracies = {4e-15, 1e-12, 1e-9, 1e-7, 1e-5};
    using Degrees = std::array<unsigned int, accuracies.size()>;

    /// Raise degrees to those of polynomials that are equal to f on [from, to] to each accuracy.
    void raise_degrees(const std::function<double(double)> &f, double from, double to,
                       double largest, Degrees &degrees)
    {
      static const std::vector<double> cosines = [] // cos(π k / 2n), k < 4n
      {
        std::vector<double> result;
        for (unsigned int k = 0; k < 4 * n_samples; ++k)
          result.push_back(std::cos(M_PI * k / (2 * n_samples)));
        return result;
      }();
      std::array<double, n_samples> value{};
      for (unsigned int i = 0; i < n_samples; ++i)
        value[i] = f(from + .5 * (to - from) * (1 + cosines[2 * i + 1]));
      for (unsigned int k = n_samples - 1; k > 0; --k)
      {
        double coefficient = 0;
        for (unsigned int i = 0; i < n_samples; ++i)
          coefficient += value[i] * cosines[k * (2 * i + 1) % (4 * n_samples)];
        const double share = std::abs(coefficient) * 2 / n_samples / largest;
        for (std::size_t i = 0; i < accuracies.size(); ++i)
          if (share > accuracies[i])
            degrees[i] = std::max(degrees[i], k);
      }
    }

    /// ∫ t^n a t^e over [from, to].
    double integral(const PowerTerm &term, int n, double from, double to)
    {
      const int p = term.exponent + n + 1;
      if (p == 0)
        return term.coefficient * std::log(to / from);
      return term.coefficient * (std::pow(to, p) - (from > 0 ? std::pow(from, p) : 0)) / p;
    }
  } // namespace

  /// A function and what is known of it.
  struct RadialProfile::Function
  {
    std::function<double(double)> value;
    bool is_even = false;
    int exponent = 0;                     ///< value is t to it, times a smooth function
    std::array<Degrees, n_levels> degree; ///< on intervals of length 1, 1/2, ...
  };

  RadialProfile::RadialProfile(Powers powers)
  {
    if (!powers.empty())
      pieces_ = {{1, std::move(powers)}};
  }

  RadialProfile RadialProfile::make(std::function<double(double)> value, bool is_even, int exponent)
  {
    Function function{std::move(value), is_even, exponent, {}};
    const auto smooth = [&](double t) { return function.value(t) / std::pow(t, exponent); };
    double largest = 0;
    for (unsigned int i = 1; i <= n_samples; ++i)
    {
      const double t = static_cast<double>(i) / n_samples, found = smooth(t);
      if (!std::isfinite(found))
        throw InputError("kernel: the radial profile is " + std::to_string(found) +
                         " at r = " + std::to_string(t) + " horizons; it must be finite in (0, 1]");
      largest = std::max(largest, std::abs(found));
    }
    for (unsigned int level = 0; level < n_levels; ++level)
      for (unsigned int i = 0; i < 1u << level; ++i)
        raise_degrees(smooth, std::ldexp(i, -static_cast<int>(level)),
                      std::ldexp(i + 1, -static_cast<int>(level)), largest, function.degree[level]);
    // a part takes no higher degree than the whole, unless the whole's points missed a feature of
    // it
    constexpr std::size_t digits = 1; // beyond the rounding of values
    const bool is_hidden = std::any_of(
        function.degree.begin(), function.degree.end(),
        [&](const Degrees &degrees) { return degrees[digits] > function.degree[0][digits] + 1; });
    if (function.degree[0][0] >= n_samples - 4 || is_hidden)
      throw InputError("kernel: the radial profile varies so fast that " +
                       std::to_string(n_samples) +
                       " points do not resolve it; it must be smooth in [0, 1]. Take a smaller "
                       "horizon or a wider profile");
    return RadialProfile(std::make_shared<const Function>(std::move(function)));
  }

  RadialProfile RadialProfile::smooth(std::function<double(double)> value, bool is_even)
  {
    return make(std::move(value), is_even, 0);
  }

  RadialProfile RadialProfile::table(std::vector<std::array<double, 2>> rows)
  {
    constexpr std::size_t most_rows = 1000;
    if (rows.size() < 2 || rows.size() > most_rows)
      throw InputError("kernel: the table of the radial profile has " +
                       std::to_string(rows.size()) + " rows; give 2 to " +
                       std::to_string(most_rows));
    double largest = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      std::ostringstream message;
      message << "kernel: row " << i + 1
              << " of the table of the radial profile has t = " << rows[i][0]
              << " and rho = " << rows[i][1] << "; ";
      if (!std::isfinite(rows[i][0]) || !std::isfinite(rows[i][1]))
        throw InputError(message.str() + "both must be finite");
      if (i == 0 ? rows[i][0] != 0 : !(rows[i][0] > rows[i - 1][0]))
        throw InputError(message.str() + "t = r / horizon must increase from 0 to 1");
      if (i + 1 == rows.size() && rows[i][0] != 1)
        throw InputError(message.str() +
                         "the last t must be 1: give the profile up to the horizon");
      largest = std::max(largest, std::abs(rows[i][1]));
    }
    constexpr double rounding = 4e-16; // rows on a line with their neighbours make no break
    RadialProfile result;
    std::array<double, 2> from = rows[0];
    for (std::size_t i = 1; i < rows.size(); ++i)
    {
      const auto &[t, value] = rows[i];
      const double slope = (value - from[1]) / (t - from[0]);
      if (i + 1 < rows.size() &&
          std::abs(value + slope * (rows[i + 1][0] - t) - rows[i + 1][1]) <=
              rounding * largest * (rows[i + 1][0] - from[0]) / (t - from[0]))
        continue;
      result.pieces_.push_back({t, {{from[1] - slope * from[0], 0}, {slope, 1}}});
      from = rows[i];
    }
    return result;
  }

  double RadialProfile::other(double t) const
  {
    if (function_)
      return function_->value(t);
    const auto piece =
        std::lower_bound(pieces_.begin(), pieces_.end() - 1, t,
                         [](const PowerPiece &one, double at) { return one.end < at; });
    return sum(piece->powers, t);
  }

  double RadialProfile::moment(int n, double from) const
  {
    double result = 0;
    if (function_)
    {
      // small moments of narrow functions keep their digits; parts of them are asked for often
      const unsigned int degree = this->degree(1 - from) + std::max(0, n + function_->exponent);
      const auto &rule = gauss(from == 0 ? n_samples : degree / 2 + 1);
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const double t = from + (1 - from) * rule.point(q)[0];
        result += (1 - from) * rule.weight(q) * std::pow(t, n) * function_->value(t);
      }
      return result;
    }
    for (const PowerPiece &piece : pieces_)
    {
      for (const PowerTerm &term : piece.powers)
        if (term.coefficient != 0 && from < piece.end)
          result += integral(term, n, from, piece.end);
      from = std::max(from, piece.end);
    }
    return result;
  }

  double RadialProfile::size() const
  {
    double result = 0;
    if (!function_ && pieces_.size() == 1)
    {
      for (const PowerTerm &term : powers())
        result += std::abs(term.coefficient) / (term.exponent + 2);
      return result;
    }
    double from = 0;
    for (const Piece &piece : pieces())
    {
      const auto &rule = gauss(n_samples / 2);
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const double t = from + (piece.end - from) * rule.point(q)[0];
        result += (piece.end - from) * rule.weight(q) * t * std::abs(piece.profile(t));
      }
      from = piece.end;
    }
    return result;
  }

  int RadialProfile::lowest_exponent() const
  {
    if (function_)
      return function_->exponent;
    int lowest = std::numeric_limits<int>::max();
    for (const PowerPiece &piece : pieces_)
      for (const PowerTerm &term : piece.powers)
        if (term.coefficient != 0)
          lowest = std::min(lowest, term.exponent);
    return lowest == std::numeric_limits<int>::max() ? 0 : lowest;
  }

  unsigned int RadialProfile::degree(double length, double accuracy) const
  {
    if (function_)
    {
      unsigned int level = 0;
      while (level + 1 < n_levels && std::ldexp(1, -static_cast<int>(level) - 1) >= length)
        ++level;
      std::size_t i = 0;
      while (i + 1 < accuracies.size() && accuracies[i + 1] <= accuracy)
        ++i;
      return function_->degree[level][i];
    }
    const int lowest = lowest_exponent();
    int highest = lowest;
    for (const PowerPiece &piece : pieces_)
      for (const PowerTerm &term : piece.powers)
        highest = std::max(highest, term.exponent);
    return static_cast<unsigned int>(highest - lowest);
  }

  bool RadialProfile::is_even(bool is_tensor) const
  {
    if (function_)
      return function_->is_even && !is_tensor;
    if (pieces_.size() > 1)
      return false;
    return std::all_of(powers().begin(), powers().end(),
                       [&](const PowerTerm &term)
                       {
                         return term.coefficient == 0 ||
                                (term.exponent % 2 == 0 && term.exponent >= (is_tensor ? 2 : 0));
                       });
  }

  std::vector<double> RadialProfile::breaks() const
  {
    std::vector<double> result;
    for (std::size_t i = 0; i + 1 < pieces_.size(); ++i)
      result.push_back(pieces_[i].end);
    return result;
  }

  std::vector<RadialProfile::Piece> RadialProfile::pieces() const
  {
    if (pieces_.size() <= 1)
      return {{1, *this}};
    std::vector<Piece> result;
    for (const PowerPiece &piece : pieces_)
      result.push_back({piece.end, RadialProfile(piece.powers)});
    return result;
  }

  std::vector<RadialProfile::Piece> RadialProfile::parts() const
  {
    std::vector<Piece> result = pieces();
    for (std::size_t i = 0; i + 1 < result.size(); ++i) // of a table: what the slope changes by
    {
      Powers powers = pieces_[i].powers;
      for (std::size_t k = 0; k < powers.size(); ++k)
        powers[k].coefficient = (powers[k].coefficient - pieces_[i + 1].powers[k].coefficient) *
                                std::pow(pieces_[i].end, powers[k].exponent);
      result[i].profile = powers;
    }
    return result;
  }

  RadialProfile RadialProfile::over_t() const
  {
    if (function_)
      return make([value = function_->value](double t) { return value(t) / t; }, false,
                  function_->exponent - 1);
    RadialProfile result = *this;
    for (PowerPiece &piece : result.pieces_)
      for (PowerTerm &term : piece.powers)
        --term.exponent;
    return result;
  }
} // namespace plumbline::physics
