#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>
#include <limits>
#include <type_traits>

namespace plumbline::reference
{
  /// An unevaluated sum of two numbers, the second at most a rounding of the first: twice the
  /// digits of Part for some ten of its operations. Error-free sums and products as in Dekker 1971,
  /// doi:10.1007/BF01397083, with Knuth's sum of two numbers of any order.
  template <class Part>
  class TwoPartNumber
  {
  public:
    TwoPartNumber() = default;
    template <class Number, class = std::enable_if_t<std::is_arithmetic_v<Number>>>
    TwoPartNumber(Number value) // NOLINT: like a built-in type
        : first_(static_cast<Part>(value))
    {
    }

    explicit operator double() const { return static_cast<double>(first_ + second_); }

    TwoPartNumber operator-() const { return {-first_, -second_}; }

    friend TwoPartNumber operator+(const TwoPartNumber &a, const TwoPartNumber &b)
    {
      const TwoPartNumber high = sum(a.first_, b.first_), low = sum(a.second_, b.second_);
      const TwoPartNumber middle = ordered_sum(high.first_, high.second_ + low.first_);
      return ordered_sum(middle.first_, middle.second_ + low.second_);
    }
    friend TwoPartNumber operator-(const TwoPartNumber &a, const TwoPartNumber &b)
    {
      return a + -b;
    }
    friend TwoPartNumber operator*(const TwoPartNumber &a, const TwoPartNumber &b)
    {
      const TwoPartNumber high = product(a.first_, b.first_);
      return ordered_sum(high.first_, high.second_ + (a.first_ * b.second_ + a.second_ * b.first_));
    }
    friend TwoPartNumber operator/(const TwoPartNumber &a, const TwoPartNumber &b)
    {
      const Part first = a.first_ / b.first_;
      const TwoPartNumber rest = a - b * TwoPartNumber(first);
      const Part second = rest.first_ / b.first_;
      const TwoPartNumber last = rest - b * TwoPartNumber(second);
      return ordered_sum(first, second) + TwoPartNumber(last.first_ / b.first_);
    }
    TwoPartNumber &operator+=(const TwoPartNumber &b) { return *this = *this + b; }
    TwoPartNumber &operator-=(const TwoPartNumber &b) { return *this = *this - b; }
    TwoPartNumber &operator*=(const TwoPartNumber &b) { return *this = *this * b; }
    TwoPartNumber &operator/=(const TwoPartNumber &b) { return *this = *this / b; }

    friend bool operator<(const TwoPartNumber &a, const TwoPartNumber &b)
    {
      return a.first_ < b.first_ || (a.first_ == b.first_ && a.second_ < b.second_);
    }
    friend bool operator>(const TwoPartNumber &a, const TwoPartNumber &b) { return b < a; }
    friend bool operator==(const TwoPartNumber &a, const TwoPartNumber &b)
    {
      return a.first_ == b.first_ && a.second_ == b.second_;
    }
    friend bool operator!=(const TwoPartNumber &a, const TwoPartNumber &b) { return !(a == b); }
    friend bool operator<=(const TwoPartNumber &a, const TwoPartNumber &b)
    {
      return a < b || a == b;
    }
    friend bool operator>=(const TwoPartNumber &a, const TwoPartNumber &b) { return b <= a; }

    friend TwoPartNumber abs(const TwoPartNumber &a) { return a < TwoPartNumber(0) ? -a : a; }
    /// A step of Newton's for 1/√a, which keeps all digits.
    friend TwoPartNumber sqrt(const TwoPartNumber &a)
    {
      if (!(a.first_ > 0))
        return a;
      const Part root = std::sqrt(a.first_);
      const TwoPartNumber rest = a - product(root, root);
      return ordered_sum(root, rest.first_ / (2 * root));
    }
    friend TwoPartNumber log(const TwoPartNumber &a) { return TwoPartNumber(log(a.wide())); }
    friend TwoPartNumber atan2(const TwoPartNumber &y, const TwoPartNumber &x)
    {
      return TwoPartNumber(atan2(y.wide(), x.wide()));
    }

    static constexpr int digits = 2 * std::numeric_limits<Part>::digits - 4; ///< left of operations

  private:
    using Wide = boost::multiprecision::number<
        boost::multiprecision::cpp_bin_float<digits + 20, boost::multiprecision::digit_base_2>,
        boost::multiprecision::et_off>;

    TwoPartNumber(Part first, Part second) : first_(first), second_(second) {}
    explicit TwoPartNumber(const Wide &value)
        : first_(static_cast<Part>(value)), second_(static_cast<Part>(value - Wide(first_)))
    {
    }
    Wide wide() const { return Wide(first_) + Wide(second_); }

    /// Exact. @pre  |a| >= |b|, or a = 0
    static TwoPartNumber ordered_sum(Part a, Part b)
    {
      const Part sum = a + b;
      return {sum, b - (sum - a)};
    }
    static TwoPartNumber sum(Part a, Part b)
    {
      const Part sum = a + b, of_b = sum - a;
      return {sum, (a - (sum - of_b)) + (b - of_b)};
    }
    static TwoPartNumber product(Part a, Part b)
    {
      constexpr Part splitter =
          (static_cast<Part>(1) * (1ULL << ((std::numeric_limits<Part>::digits + 1) / 2))) + 1;
      const Part of_a = splitter * a, of_b = splitter * b;
      const Part a1 = of_a - (of_a - a), b1 = of_b - (of_b - b);
      const Part a2 = a - a1, b2 = b - b1, product = a * b;
      return {product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2};
    }

    Part first_ = 0, second_ = 0;
  };
} // namespace plumbline::reference

template <class Part>
class std::numeric_limits<plumbline::reference::TwoPartNumber<Part>>
    : public std::numeric_limits<Part>
{
public:
  static constexpr int digits = plumbline::reference::TwoPartNumber<Part>::digits;
  static plumbline::reference::TwoPartNumber<Part> epsilon()
  {
    return std::ldexp(static_cast<Part>(1), 1 - digits);
  }
};
