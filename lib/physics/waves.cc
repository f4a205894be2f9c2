#include "physics/waves.h"

#include "base/error.h"
#include "physics/gauss.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace plumbline::physics
{
  namespace
  {
    /// 1 - J0(z) and J1, J2, J3 at z >= 0, each to 1e-15 relative where z is small.
    struct Bessel
    {
      double one_minus_j0, j1, j2, j3;
    };

    /// @tparam dim  2: Bessel's functions; 3: the spherical ones
    template <int dim>
    Bessel bessel(double z)
    {
      constexpr double small = 1; // below it, 1 - J0 loses digits and its series has few terms
      const auto j = [z](unsigned int n)
      { return dim == 2 ? std::cyl_bessel_j(n, z) : std::sph_bessel(n, z); };
      Bessel result{1 - j(0), j(1), j(2), j(3)};
      if (z < small)
      {
        result.one_minus_j0 = 0;
        double term = 1;
        for (int n = 1; n <= 10; ++n)
        {
          term *= -z * z / (dim == 2 ? 4. * n * n : 2. * n * (2 * n + 1));
          result.one_minus_j0 -= term;
        }
      }
      return result;
    }

    /// Value and derivative by k of an integrand.
    using Pair = std::array<double, 2>;

    /// ∫_0^δ f(r) dr with more and more Gauss points between breaks until it settles.
    template <int dim>
    Pair integrate(const Kernel<dim> &kernel, double k, const std::function<Pair(double r)> &f)
    {
      const double horizon = kernel.horizon();
      std::vector<double> ends = kernel.breaks();
      ends.push_back(horizon);
      constexpr double settled = 1e-14, acceptable = 1e-12;
      Pair scale{};
      const auto by = [&](unsigned int n)
      {
        const auto &rule = gauss(n);
        Pair sum{};
        scale = {};
        double from = 0;
        for (const double to : ends)
        {
          for (unsigned int q = 0; q < n; ++q)
          {
            const Pair value = f(from + (to - from) * rule.point(q)[0]);
            for (unsigned int i = 0; i < 2; ++i)
            {
              sum[i] += (to - from) * rule.weight(q) * value[i];
              scale[i] += (to - from) * rule.weight(q) * std::abs(value[i]);
            }
          }
          from = to;
        }
        return sum;
      };
      const double of_profile = kernel.profile().degree() / 2.,
                   most_points = 64 + of_profile + k * horizon;
      // three for each wave, and more; and what the profile takes
      auto n = static_cast<unsigned int>(std::max(16., of_profile) + k * horizon / 2);
      Pair coarse = by(n);
      double change = 0;
      while (n < most_points)
      {
        n += n / 2;
        const Pair fine = by(n);
        change = 0;
        for (unsigned int i = 0; i < 2; ++i)
          if (scale[i] > 0)
            change = std::max(change, std::abs(fine[i] - coarse[i]) / scale[i]);
        coarse = fine;
        if (change <= settled)
          break;
      }
      if (!(change <= acceptable))
        throw NumericalError("the exact wave at k = " + std::to_string(k) +
                             " does not settle: still moving by " + std::to_string(change) +
                             " of itself with " + std::to_string(n) + " radii");
      return coarse;
    }

    /// Of the bonds in the plane.
    Pair bonds(const Kernel<2> &kernel, Polarisation polarisation, double k, double r)
    {
      const Bessel b = bessel<2>(k * r);
      const double weight = kernel.radial(r) * r;
      switch (polarisation)
      {
      case Polarisation::scalar:
        return {2 * M_PI * weight * b.one_minus_j0, 2 * M_PI * weight * r * b.j1};
      case Polarisation::longitudinal: // J2' = (J1 - J3) / 2
        return {M_PI * weight * (b.one_minus_j0 + b.j2),
                M_PI * weight * r * (1.5 * b.j1 - .5 * b.j3)};
      default:
        return {M_PI * weight * (b.one_minus_j0 - b.j2),
                M_PI * weight * r * (.5 * b.j1 + .5 * b.j3)};
      }
    }

    /// Of those in space.
    Pair bonds(const Kernel<3> &kernel, Polarisation polarisation, double k, double r)
    {
      const Bessel b = bessel<3>(k * r);
      const double weight = 4 * M_PI * kernel.radial(r) * r * r;
      switch (polarisation)
      {
      case Polarisation::scalar:
        return {weight * b.one_minus_j0, weight * r * b.j1};
      case Polarisation::longitudinal: // J2' = (2 J1 - 3 J3) / 5
        return {weight / 3 * (b.one_minus_j0 + 2 * b.j2),
                weight / 3 * r * (1.8 * b.j1 - 1.2 * b.j3)};
      default:
        return {weight / 3 * (b.one_minus_j0 - b.j2), weight / 3 * r * (.6 * b.j1 + .6 * b.j3)};
      }
    }
  } // namespace

  std::vector<Branch> branches(Structure structure, unsigned int dimension)
  {
    if (structure == Structure::scalar)
      return {{Polarisation::scalar, ""}};
    if (dimension == 2)
      return {{Polarisation::longitudinal, "L"}, {Polarisation::transverse, "T"}};
    return {{Polarisation::longitudinal, "L"},
            {Polarisation::transverse, "T1"},
            {Polarisation::transverse, "T2"}};
  }

  template <int dim>
  Frequency exact_wave(const Kernel<dim> &kernel, const std::optional<Dilatation<dim>> &dilatation,
                       Polarisation polarisation, double k)
  {
    const Pair of_bonds =
        integrate(kernel, k, [&](double r) { return bonds(kernel, polarisation, k, r); });
    Frequency result{of_bonds[0], of_bonds[1]};
    if (dilatation && polarisation == Polarisation::longitudinal)
    {
      const Kernel<dim> &influence = dilatation->influence;
      const Pair g =
          integrate(influence, k,
                    [&](double r) -> Pair { // J1' = (J0 - J2) / 2, in space (J0 - 2 J2) / 3
                      const Bessel b = bessel<dim>(k * r);
                      const double weight =
                          2 * (dim - 1) * M_PI * influence.radial(r) * std::pow(r, dim);
                      const double slope = 1 - b.one_minus_j0 - (dim - 1) * b.j2;
                      return {weight * b.j1, weight * r * slope / dim};
                    });
      const Lame lame = dilatation->material({});
      const double factor = dilatation->factor(lame, lame);
      result.squared += factor * g[0] * g[0];
      result.slope += factor * 2 * g[0] * g[1];
    }
    return result;
  }

  template Frequency exact_wave(const Kernel<2> &, const std::optional<Dilatation<2>> &,
                                Polarisation, double);
  template Frequency exact_wave(const Kernel<3> &, const std::optional<Dilatation<3>> &,
                                Polarisation, double);

  double squared_local_speed(const LocalLimit &limit, const std::optional<Lame> &solid,
                             Polarisation polarisation)
  {
    if (polarisation == Polarisation::scalar)
      return limit.diffusion;
    if (polarisation == Polarisation::transverse)
      return limit.mu;
    return (solid ? solid->lambda : limit.lambda) + 2 * limit.mu;
  }
} // namespace plumbline::physics
