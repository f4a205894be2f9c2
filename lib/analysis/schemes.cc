#include "analysis/schemes.h"

#include "base/error.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <mutex>

namespace plumbline::analysis
{
  namespace
  {
    /// Symmetric composition of six stages, for any splitting into two flows.
    /// Source: Blanes & Moan 2002, doi:10.1016/S0377-0427(01)00492-7, table 2, S6 of order 4.
    std::vector<Substep> blanes_moan()
    {
      const double a1 = .0792036964311957, a2 = .353172906049774, a3 = -.0420650803577195,
                   a4 = 1 - 2 * (a1 + a2 + a3);
      const double b1 = .209515106613362, b2 = -.143851773179818, b3 = .5 - (b1 + b2);
      return {{false, a1}, {true, b1},  {false, a2}, {true, b2},  {false, a3},
              {true, b3},  {false, a4}, {true, b3},  {false, a3}, {true, b2},
              {false, a2}, {true, b1},  {false, a1}};
    }

    /// Half the trace of a step of ü = -z² u with Δt = 1, whose determinant is 1: the solutions are
    /// bounded while it is less than 1.
    double half_trace(const std::vector<Substep> &substeps, double z)
    {
      double m[2][2] = {{1, 0}, {0, 1}};
      for (const Substep &substep : substeps)
        for (double(&column)[2] : m) // column: (u, v) from one of the unit vectors
          if (substep.is_kick)
            column[1] -= substep.coefficient * z * z * column[0];
          else
            column[0] += substep.coefficient * column[1];
      return .5 * (m[0][0] + m[1][1]);
    }
    const std::string theta_name = "theta";

    /// The one-step scheme with θ in [0, 1], of order 2 at ½ and 1 elsewhere. Kept for good, for
    /// callers hold references.
    /// Source: Jha & Lipton 2018, doi:10.1137/17M1112236, (18)-(19) and Theorem 4.
    const Scheme &theta_scheme(const std::string &name)
    {
      const std::string text = name.substr(theta_name.size());
      char *end = nullptr;
      const double theta = std::strtod(text.c_str(), &end);
      if (text.empty() || text.front() != ' ' || end == text.c_str() || *end != '\0' ||
          !(theta >= 0 && theta <= 1))
        throw InputError("time-stepping scheme = '" + name +
                         "' must be 'theta T' with a number T in [0, 1], for example theta 0.75 "
                         "(0: explicit Euler, 0.5: trapezoidal, 1: implicit Euler)");
      static std::mutex mutex;
      static std::map<std::string, Scheme> known;
      const std::lock_guard<std::mutex> lock(mutex);
      Scheme scheme{name,
                    "Jha & Lipton 2018, doi:10.1137/17M1112236, (18)-(19)",
                    theta == .5 ? 2 : 1,
                    {},
                    theta,
                    false,
                    theta == 0};
      return known.emplace(name, std::move(scheme)).first->second;
    }
  } // namespace

  const std::vector<Scheme> &schemes()
  {
    static const std::vector<Scheme> table = {
        {"explicit Euler", "unstable: there to show how it fails", 1, {}, 0, false, true},
        {"symplectic Euler",
         "velocity first; Jha & Lipton 2018, doi:10.1137/17M1112236, (14)-(15)",
         1,
         {{true, 1}, {false, 1}}},
        {"velocity Verlet",
         "half a kick, drift, half a kick; Verlet 1967, doi:10.1103/PhysRev.159.98",
         2,
         {{true, .5}, {false, 1}, {true, .5}}},
        {"Blanes-Moan",
         "symplectic, six stages; Blanes & Moan 2002, doi:10.1016/S0377-0427(01)00492-7", 4,
         blanes_moan()},
        {"trapezoidal", "theta = 1/2; Jha & Lipton 2018, (18)-(19)", 2, {}, .5},
        {"implicit Euler", "theta = 1, strongly damped; Jha & Lipton 2018, (18)-(19)", 1, {}, 1},
        {"Runge-Kutta",
         "SUNDIALS' ARKODE with steps of its own: exact in time; Reynolds et al. 2023, "
         "doi:10.1145/3594632",
         8,
         {},
         0,
         true},
    };
    return table;
  }

  const Scheme &scheme(const std::string &name)
  {
    std::string names;
    for (const Scheme &one : schemes())
    {
      if (one.name == name)
        return one;
      names += (names.empty() ? "" : ", ") + one.name;
    }
    if (name.compare(0, theta_name.size(), theta_name) == 0)
      return theta_scheme(name);
    throw InputError("time-stepping scheme = '" + name + "' is not known; choose one of: " + names +
                     ", theta T (T in [0, 1])");
  }

  double stability_limit(const Scheme &scheme)
  {
    constexpr double step = 1e-3, accuracy = 1e-10;
    if (scheme.is_runge_kutta)
      return std::numeric_limits<double>::infinity();
    // a step of ü = -z² u multiplies by √((1 + (1-θ)² z²) / (1 + θ² z²)), more than 1 below θ = ½
    if (scheme.is_implicit())
      return scheme.theta < .5 ? 0 : std::numeric_limits<double>::infinity();
    if (scheme.substeps.empty())
      return 0;
    // rounding of a trace that touches 1 is no instability
    const auto is_stable = [&](double z)
    { return std::abs(half_trace(scheme.substeps, z)) <= 1 + 1e-12; };
    double stable = 0;
    while (is_stable(stable + step))
      stable += step;
    double unstable = stable + step;
    while (unstable - stable > accuracy)
    {
      const double middle = .5 * (stable + unstable);
      (is_stable(middle) ? stable : unstable) = middle;
    }
    return stable;
  }
} // namespace plumbline::analysis
