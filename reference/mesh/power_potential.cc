#include "reference/mesh/power_potential.h"

#include <algorithm>
#include <cmath>

namespace plumbline::reference
{
  PowerPotential::PowerPotential(const physics::Kernel<2> &kernel)
      : horizon_(kernel.horizon()), is_tensor_(kernel.structure() == physics::Structure::tensor)
  {
    const double of_trace = is_tensor_ ? .5 : 1;
    for (const physics::PowerTerm &power : kernel.profile().powers())
    {
      const int k = power.exponent;
      const double c = kernel.constant() * power.coefficient * std::pow(horizon_, -k);
      term(k + 4).trace += of_trace * c / ((k + 2.) * (k + 2) * (k + 4) * (k + 4));
      if (is_tensor_ && k == 0)
        logarithm_ += c / 48;
      else if (is_tensor_)
        term(k + 2).rest += c / (k * (k + 2.) * (k + 4) * (k + 6));
    }
  }

  /// Of r^p.
  PowerPotential::Term &PowerPotential::term(int p)
  {
    std::vector<Term> &series = p % 2 == 0 ? even_ : odd_;
    const auto place = static_cast<std::size_t>(p / 2);
    series.resize(std::max(series.size(), place + 1));
    return series[place];
  }

  void PowerPotential::subtract(const std::array<double, 2> &a, const std::array<double, 2> &b)
  {
    const double square = horizon_ * horizon_;
    term(0).trace -= a[0] * square * square;
    term(2).trace -= a[1] * square;
    term(0).rest -= b[0] * square;
    term(2).rest -= b[1];
  }

  /// What integrals of r^p over a line are made of. Differences between its ends are formed from
  /// its length: those of powers would lose as many digits as it is far away.
  struct PowerPotential::Line
  {
    double from, length, h, a, b;
    double to = from + length, height2 = h * h;
    double r2_from = from * from + height2, r2_to = to * to + height2;
    double change = length * (from + to); ///< of r²

    /// asinh(to/h) - asinh(from/h)
    double asinh_change() const
    {
      const double r0 = std::sqrt(r2_from), r1 = std::sqrt(r2_to);
      double x0 = from, x1 = to; // the farther end positive
      if (x0 + x1 < 0)
        x0 = -to, x1 = -from;
      const double near = x0 == from ? r0 : r1, far = x0 == from ? r1 : r0;
      if (x0 < 0)
        return std::log((x1 + far) * (near - x0) / height2);
      return std::log1p(length * (1 + (x1 + x0) / (far + near)) / (x0 + near));
    }
  };

  void PowerPotential::add_series(const std::vector<Term> &series, bool is_odd, const Line &line,
                                  bool for_divergence, Entries &sum) const
  {
    // I = ∫ r^p = ([x r^p] + p h² I_(p-2)) / (p + 1), M = ∫ x r^p = [r^(p+2)] / (p + 2)
    int p = is_odd ? 1 : 0;
    double power_from = is_odd ? std::sqrt(line.r2_from) : 1,
           power_to = is_odd ? std::sqrt(line.r2_to) : 1;
    double change = is_odd ? line.change / (power_from + power_to) : 0; // of r^p
    double I = line.length;
    if (is_odd)
      I = .5 * (line.length * power_to + line.from * change +
                (line.height2 > 0 ? line.height2 * line.asinh_change() : 0));
    for (const Term &term : series)
    {
      change = change * line.r2_to + power_from * line.change;
      const double M = change / (p + 2);
      sum[0] += term.trace * (line.a * I + line.b * M) / (for_divergence ? p + 2 : 1);
      power_from *= line.r2_from;
      power_to *= line.r2_to;
      p += 2;
      const double next_I =
          (line.length * power_to + line.from * change + p * line.height2 * I) / (p + 1);
      if (is_tensor_) // H = ½(x² - h²) along the line, x h across
      {
        const double next_M = (change * line.r2_to + power_from * line.change) / (p + 2);
        const double factor = term.rest / (for_divergence ? p + 2 : 1);
        sum[1] += factor * (line.a * (.5 * next_I - line.height2 * I) +
                            line.b * (.5 * next_M - line.height2 * M));
        sum[2] += factor * line.h * (line.a * M + line.b * (next_I - line.height2 * I));
      }
      I = next_I;
    }
  }

  /// Of H r² ln(r/δ), for the divergence H (r² ln(r/δ)/6 - r²/36).
  void PowerPotential::add_logarithm(const Line &line, bool for_divergence, Entries &sum) const
  {
    const double x0 = line.from, x1 = line.to, h = line.h, h2 = line.height2;
    const double s0 = line.r2_from, s1 = line.r2_to;
    const auto half_log = [&](double square) // ln(r/δ), where it counts
    { return square > 0 ? .5 * std::log(square / (horizon_ * horizon_)) : 0; };
    const double log0 = half_log(s0), log1 = half_log(s1);
    const double I0 = line.length, I2 = I0 * (x0 * x0 + x0 * x1 + x1 * x1) / 3 + h2 * I0,
                 I4 = (x1 * s1 * s1 - x0 * s0 * s0 + 4 * h2 * I2) / 5;
    // L_p = ∫ r^p ln r = ([x r^p ln r] + p h² L_(p-2) - I_p + h² I_(p-2)) / (p + 1)
    const double L0 = x1 * log1 - x0 * log0 - I0 + h * std::atan2(h * I0, h2 + x0 * x1);
    const double L2 = (x1 * s1 * log1 - x0 * s0 * log0 + 2 * h2 * L0 - I2 + h2 * I0) / 3;
    const double L4 = (x1 * s1 * s1 * log1 - x0 * s0 * s0 * log0 + 4 * h2 * L2 - I4 + h2 * I2) / 5;
    // M_p = ∫ x r^p, N_p = ∫ x r^p ln r = [r^(p+2) ln r] / (p + 2) - M_p / (p + 2)
    const double M2 = (s1 * s1 - s0 * s0) / 4, M4 = (s1 * s1 * s1 - s0 * s0 * s0) / 6;
    const double N2 = (s1 * s1 * log1 - s0 * s0 * log0 - M2) / 4,
                 N4 = (s1 * s1 * s1 * log1 - s0 * s0 * s0 * log0 - M4) / 6;
    const auto along = [&](double at_4, double at_2) { return .5 * at_4 - h2 * at_2; };
    Entries result{};
    result[1] = line.a * along(L4, L2) + line.b * along(N4, N2);
    result[2] = h * (line.a * N2 + line.b * (L4 - h2 * L2));
    if (for_divergence)
    {
      result[1] = result[1] / 6 - (line.a * along(I4, I2) + line.b * along(M4, M2)) / 36;
      result[2] = result[2] / 6 - h * (line.a * M2 + line.b * (I4 - h2 * I2)) / 36;
    }
    for (unsigned int i = 1; i < 3; ++i)
      sum[i] += logarithm_ * result[i];
  }

  PowerPotential::Entries PowerPotential::integrate(const Vector2 &e, double from, double length,
                                                    double h, double a, double b,
                                                    bool for_divergence) const
  {
    const Line line{from, length, h, a, b};
    Entries sum{};
    if (!odd_.empty())
      add_series(odd_, true, line, for_divergence, sum);
    if (!even_.empty())
      add_series(even_, false, line, for_divergence, sum);
    if (!is_tensor_)
      return sum;
    if (logarithm_ != 0)
      add_logarithm(line, for_divergence, sum);
    const double cosine = e[0] * e[0] - e[1] * e[1], sine = 2 * e[0] * e[1]; // of twice the angle
    return {sum[0], cosine * sum[1] - sine * sum[2], sine * sum[1] + cosine * sum[2]};
  }
} // namespace plumbline::reference
