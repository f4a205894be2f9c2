#include "physics/double_well_stability.h"

#include "base/error.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace plumbline::physics
{
  namespace
  {
    using Direction = std::array<double, 2>;

    double of(const SymmetricMatrix &matrix, const Direction &e)
    {
      return e[0] * e[0] * matrix.xx + 2 * e[0] * e[1] * matrix.xy + e[1] * e[1] * matrix.yy;
    }

    /// (1/ω_dim) ∫ over the unit ball of J(t) T(r (e·E e)²) g(t, e) e⊗e with T = f' +
    /// 2s f'' and r = ε t.
    /// @param n  Gauss points in the radius, in parts of at most 64, whose rule is cheap to find;
    /// in 2D 4n angles
    template <typename Integrand>
    SymmetricMatrix integrate(const DoubleWell &law, const SymmetricMatrix &strain, unsigned int n,
                              const Integrand &g)
    {
      constexpr unsigned int most = 64;
      const unsigned int n_parts = (n + most - 1) / most;
      const dealii::QIterated<1> gauss(dealii::QGauss<1>((n + n_parts - 1) / n_parts), n_parts);
      const unsigned int n_angles = law.dim() == 1 ? 2 : 4 * n;
      SymmetricMatrix sum;
      for (unsigned int k = 0; k < n_angles; ++k)
      {
        const double angle = 2 * M_PI * k / n_angles;
        const Direction e = law.dim() == 1 ? Direction{k == 0 ? 1. : -1., 0}
                                           : Direction{std::cos(angle), std::sin(angle)};
        const double s = of(strain, e);
        double radial = 0;
        for (unsigned int i = 0; i < gauss.size(); ++i)
        {
          const double t = gauss.point(i)[0], r = law.horizon() * t;
          radial += gauss.weight(i) * (law.dim() == 1 ? 1 : t) * law.influence(r) *
                    law.tangent(r * s * s) * g(t, e);
        }
        // the unit sphere has the area dim ω_dim
        radial *= static_cast<double>(law.dim()) / n_angles;
        sum.xx += radial * e[0] * e[0];
        sum.xy += radial * e[0] * e[1];
        sum.yy += radial * e[1] * e[1];
      }
      return sum;
    }

    constexpr unsigned int n_long_waves = 48; // Gauss points, for q up to 30

    double smallest(const DoubleWell &law, const SymmetricMatrix &matrix)
    {
      return law.dim() == 1 ? matrix.xx : matrix.eigenvalues()[0];
    }

    /// Acoustic tensors of the directions (n1, n2): n1² first + n1 n2 mixed + n2² second.
    struct AcousticTensors
    {
      SymmetricMatrix first, mixed, second;

      AcousticTensors(const DoubleWell &law, const SymmetricMatrix &strain)
          : first(integrate(law, strain, n_long_waves,
                            [](double t, const Direction &e) { return 2 * t * e[0] * e[0]; })),
            mixed(integrate(law, strain, n_long_waves,
                            [](double t, const Direction &e) { return 4 * t * e[0] * e[1]; })),
            second(integrate(law, strain, n_long_waves,
                             [](double t, const Direction &e) { return 2 * t * e[1] * e[1]; }))
      {
      }

      SymmetricMatrix at(const Direction &n) const
      {
        const double a = n[0] * n[0], b = n[0] * n[1], c = n[1] * n[1];
        return {a * first.xx + b * mixed.xx + c * second.xx,
                a * first.xy + b * mixed.xy + c * second.xy,
                a * first.yy + b * mixed.yy + c * second.yy};
      }
    };

    /// The least eigenvalue of the acoustic tensor over all directions.
    double least_stiffness(const DoubleWell &law, const SymmetricMatrix &strain)
    {
      const AcousticTensors tensors(law, strain);
      const auto at = [&](double degrees)
      {
        const double angle = degrees * M_PI / 180;
        return smallest(law, tensors.at({std::cos(angle), std::sin(angle)}));
      };
      if (law.dim() == 1)
        return at(0);
      double best = 0, value = at(0);
      for (int degrees = 1; degrees < 180; ++degrees)
        if (const double other = at(degrees); other < value)
        {
          value = other;
          best = degrees;
        }
      for (double width = 1; width > 1e-6; width /= 2)
        for (const double side : {-width / 2, width / 2})
          if (const double other = at(best + side); other < value)
          {
            value = other;
            best += side;
          }
      return value;
    }

    /// The first X at which a function of the strain falls to 0.
    double first_root(const DoubleWell &law, const SymmetricMatrix &direction,
                      const std::function<double(const SymmetricMatrix &)> &f)
    {
      constexpr double step = .05, most = 20, accuracy = 1e-11;
      const auto at = [&](double x)
      {
        const double g = std::sqrt(x / (law.beta() * law.horizon()));
        return f({g * direction.xx, g * direction.xy, g * direction.yy});
      };
      double lower = 0;
      while (at(lower + step) > 0)
      {
        lower += step;
        if (lower > most)
          throw NumericalError("double well: no loss of stability up to beta eps g^2 = 20");
      }
      double upper = lower + step;
      while (upper - lower > accuracy)
      {
        const double middle = .5 * (lower + upper);
        (at(middle) > 0 ? lower : upper) = middle;
      }
      return lower;
    }
  } // namespace

  std::array<double, 2> SymmetricMatrix::eigenvalues() const
  {
    const double mean = .5 * (xx + yy), radius = std::hypot(.5 * (xx - yy), xy);
    return {mean - radius, mean + radius};
  }

  SymmetricMatrix wave_symbol(const DoubleWell &law, const SymmetricMatrix &strain,
                              const Direction &k)
  {
    const double horizon = law.horizon(), size = std::hypot(k[0], k[1]) * horizon;
    const auto n = n_long_waves + static_cast<unsigned int>(std::ceil(size));
    const auto factor = [&](double t, const Direction &e)
    {
      const double half = .5 * horizon * t * (k[0] * e[0] + k[1] * e[1]);
      return 8 * std::sin(half) * std::sin(half) / (t * horizon * horizon);
    };
    return integrate(law, strain, n, factor);
  }

  SymmetricMatrix acoustic_tensor(const DoubleWell &law, const SymmetricMatrix &strain,
                                  const Direction &n)
  {
    return AcousticTensors(law, strain).at(n);
  }

  SymmetricMatrix local_stability(const DoubleWell &law, const SymmetricMatrix &strain)
  {
    return integrate(law, strain, n_long_waves, [](double, const Direction &) { return 1; });
  }

  Thresholds stability_thresholds(const DoubleWell &law, const SymmetricMatrix &direction)
  {
    return {first_root(law, direction,
                       [&](const SymmetricMatrix &strain) { return least_stiffness(law, strain); }),
            first_root(law, direction,
                       [&](const SymmetricMatrix &strain)
                       { return smallest(law, local_stability(law, strain)); })};
  }
} // namespace plumbline::physics
