#include "uq/covariance.h"

#include "base/error.h"
#include "base/number_text.h"

#include <cmath>
#include <string>
#include <utility>

namespace plumbline::uq
{
  namespace
  {
    constexpr double largest_smoothness = 1000;

    /// 2^(1-ν)/Γ(ν) x^ν K_ν(x), 1 at x = 0. K_ν overflows for large ν and small x, so from orders
    /// of at most 2 on by its recurrence, which for this product f has no negative terms: f_{ν+1} =
    /// f_ν + x² / (4ν(ν-1)) f_{ν-1}.
    double matern(double nu, double x)
    {
      constexpr double nothing = 700; // e^-x leaves the range of double
      if (x == 0)
        return 1;
      if (x > nothing)
        return 0;
      const auto direct = [x](double order)
      {
        return std::exp((1 - order) * M_LN2 - std::lgamma(order) + order * std::log(x)) *
               std::cyl_bessel_k(order, x);
      };
      if (nu <= 2)
        return direct(nu);
      const int n_steps = static_cast<int>(std::ceil(nu)) - 2;
      double order = nu - n_steps; // in (1, 2]
      double before = direct(order - 1), value = direct(order);
      for (int k = 0; k < n_steps; ++k, order += 1)
        before = std::exchange(value, value + x * x / (4 * order * (order - 1)) * before);
      return value;
    }

    [[noreturn]] void refuse(const std::string &what, double value, const std::string &allowed)
    {
      throw InputError("covariance: " + what + " = " + base::to_text(value, 6) +
                       " cannot be used; give " + allowed);
    }
  } // namespace

  double Covariance::operator()(double dx, double dy) const
  {
    if (is_separable())
      return variance * factor(0, dx) * factor(1, dy);
    const double r = std::hypot(dx / length[0], dy / length[1]);
    if (shape == CovarianceShape::exponential)
      return variance * std::exp(-r);
    return variance * matern(smoothness, std::sqrt(2 * smoothness) * r);
  }

  bool Covariance::is_separable() const
  {
    return shape == CovarianceShape::separable_exponential || shape == CovarianceShape::gaussian;
  }

  double Covariance::factor(unsigned int axis, double distance) const
  {
    const double r = distance / length[axis];
    return shape == CovarianceShape::gaussian ? std::exp(-r * r / 2) : std::exp(-std::abs(r));
  }

  void check(const Covariance &covariance)
  {
    // written so that numbers that are none fail, too
    if (!(covariance.variance >= 0) || !std::isfinite(covariance.variance))
      refuse("variance", covariance.variance, "a variance >= 0");
    for (const double length : covariance.length)
      if (!(length > 0) || !std::isfinite(length))
        refuse("correlation length", length, "lengths > 0, in the unit of the domain");
    if (covariance.shape == CovarianceShape::matern &&
        !(covariance.smoothness > 0 && covariance.smoothness <= largest_smoothness))
      refuse("smoothness", covariance.smoothness,
             "one in (0, 1000]: .5 is the exponential covariance; for a field smoother than that "
             "take the Gaussian one");
  }
} // namespace plumbline::uq
