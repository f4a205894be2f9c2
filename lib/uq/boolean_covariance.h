#pragma once

#include "uq/covariance.h"
#include "uq/ellipses.h"

namespace plumbline::uq
{
  /// Overlap of a randomly turned ellipse with itself moved by r, as share of its area: the mean
  /// over all angles θ of (2 arccos(ρ/2) - ρ √(1 - ρ²/4)) / π where ρ = r √(cos²θ/a² + sin²θ/b²) is
  /// less than 2, else of 0: the map that takes the ellipse to the unit disk takes the overlap to
  /// that of two disks, ρ apart.
  /// @param semi_axes  a, b > 0 [length]
  /// @param r          >= 0 [length]
  /// Accuracy: 1e-12; 1e-9 where r is within 1e-3 of the smaller axis 2b.
  double set_covariance(std::array<double, 2> semi_axes, double r);

  /// The covariance of what is 1 on grains that may overlap and 0 elsewhere: (1-f)² (e^{Λγ(r)} - 1)
  /// with Λ = -ln(1-f) and γ the set covariance, f (1-f) at r = 0: it is isotropic and 0 from r =
  /// 2 max(a, b) on. Source: Chiu, Stoyan, Kendall & Mecke 2013, "Stochastic Geometry and its
  /// Applications", sec. 3.1.4, doi:10.1002/9781118658222.
  /// @throws InputError  check(model); a model without overlap, which has no closed form
  CovarianceFunction boolean_covariance(const EllipseModel &model);
} // namespace plumbline::uq
