#include "analysis/wave_growth.h"

#include "physics/double_well_stability.h"

#include <algorithm>
#include <cmath>

namespace plumbline::analysis
{
  namespace
  {
    using Direction = std::array<double, 2>;

    Vector standing_wave(const method::EquationOfMotion &equation, const Direction &k,
                         const Direction &along)
    {
      return equation.state({[&](const dealii::Point<2> &x, unsigned int c)
                             { return along[c] * std::cos(k[0] * x[0] + k[1] * x[1]); },
                             {}});
    }

    /// An eigenvector of the smallest eigenvalue, of norm 1.
    Direction softest(const physics::SymmetricMatrix &matrix)
    {
      const double least = matrix.eigenvalues()[0];
      const Direction first{matrix.xy, least - matrix.xx}, second{least - matrix.yy, matrix.xy};
      const double a = std::hypot(first[0], first[1]), b = std::hypot(second[0], second[1]);
      if (std::max(a, b) == 0) // all are
        return {1, 0};
      return a > b ? Direction{first[0] / a, first[1] / a}
                   : Direction{second[0] / b, second[1] / b};
    }

    /// -λ of the wave: its tangent in components.
    physics::SymmetricMatrix stiffness(const Transient &transient,
                                       const method::EquationOfMotion &equation,
                                       const Vector &about, const Direction &k)
    {
      const Vector waves[] = {standing_wave(equation, k, {1, 0}),
                              standing_wave(equation, k, {0, 1})};
      const auto tangent = transient.motion().tangent;
      const double size = dot(waves[0], waves[0]);
      Vector out(about.size());
      physics::SymmetricMatrix result;
      tangent(about, waves[0], out);
      result.xx = -dot(out, waves[0]) / size;
      result.xy = -dot(out, waves[1]) / size;
      tangent(about, waves[1], out);
      result.yy = -dot(out, waves[1]) / size;
      return result;
    }
  } // namespace

  WaveGrowth observe_growth(const method::EquationOfMotion &equation, const Transient &transient,
                            const Vector &about, const Direction &wave, double length,
                            double longest_time)
  {
    constexpr double small = 1e-10, folds = 12, of_critical = .05, least_growth = .5;
    const physics::SymmetricMatrix matrix = stiffness(transient, equation, about, wave);
    const double least = matrix.eigenvalues()[0], pace = std::sqrt(std::abs(least));
    WaveGrowth result;
    result.linear = least < 0 ? pace : 0;

    const Scheme &verlet = scheme("velocity Verlet");
    const Vector shape = standing_wave(equation, wave, softest(matrix));
    const double end = std::min(folds / pace, longest_time), size = dot(shape, shape);
    State state{about, Vector(about.size()), 0};
    add(state.u, small * length, shape);
    const auto amplitude = [&](const State &now)
    {
      double sum = 0;
      for (std::size_t i = 0; i < shape.size(); ++i)
        sum += (now.u[i] - about[i]) * shape[i];
      return std::abs(sum) / size;
    };
    double early = amplitude(state), late = 0, middle = early;
    integrate(transient.motion(), verlet, {of_critical * transient.critical_step(verlet)}, end,
              state,
              [&](const State &now)
              {
                const double a = amplitude(now);
                double &largest = now.t <= .5 * end ? early : late;
                largest = std::max(largest, a);
                if (now.t <= .5 * end)
                  middle = now.t;
              });
    const double growth = std::log(late / early);
    result.observed = growth > least_growth ? growth / (end - middle) : 0;
    return result;
  }
} // namespace plumbline::analysis
