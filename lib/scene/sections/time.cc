#include "scene/time_section.h"

#include "base/error.h"
#include "scene/keys.h"
#include "scene/values.h"

#include <cmath>

namespace plumbline::scene
{
  void TimeSection::declare(Keys &keys)
  {
    keys.add("final time", final_time, any_number(),
             "Final time T > 0 of a transient analysis: rho u'' = F(u) + b - eta rho u' from t = 0 "
             "to T; expressions may depend on t. 0: statics. [time]");
    keys.add(
        "schemes", schemes.front(), any_text(),
        [this](const std::string &text) { schemes = to_names(text); },
        "Time-stepping schemes, separated by ',': explicit Euler (unstable, for demonstration), "
        "symplectic Euler, velocity Verlet, Blanes-Moan (order 4), trapezoidal, implicit Euler, "
        "Runge-Kutta (adaptive steps); 'theta T' with a number T in [0, 1], for example theta "
        "0.75, "
        "is the one-step scheme (18)-(19) of Jha & Lipton 2018: 0 explicit Euler, 0.5 trapezoidal, "
        "1 implicit Euler. For T < 0.5 every oscillation grows at any step size.");
    keys.add("steps", steps, numbers(),
             "Time steps, separated by ',', decreasing. Empty: see critical fractions. [time]");
    keys.add("critical fractions", fractions, numbers(),
             "Time steps as fractions of the critical time step of scheme, method and level; "
             "implicit schemes and Runge-Kutta, which have none, use that of velocity Verlet.");
    keys.add("density", density, any_number(),
             "rho > 0. [mass/length^3], with moduli in [force/length^2]");
    keys.add("damping", damping, any_number(), "eta >= 0. [1/time]");
    keys.add(
        "initial displacement", initial_displacement,
        "u at t = 0, expressions in x, y (and z in three dimensions), delta and h (the mesh size). "
        "Empty: from "
        "Problem/solution.");
    keys.add("initial velocity", initial_velocity,
             "u' at t = 0, expressions in the same variables. Empty: from Problem/solution, or 0.");
    keys.add("show blow-up", shows_blow_up, yes_or_no(),
             "Permit steps of explicit schemes that exceed the critical time step, to show the "
             "instability; otherwise they are refused.");
    keys.add("mass", is_lumped, "consistent", "lumped",
             "Mass matrix of Galerkin methods: consistent, solved exactly, or lumped, its scaled "
             "diagonal.");
    keys.add("a priori bounds", has_bounds, yes_or_no(),
             "For double wells: the error bounds (17), for symplectic Euler, and (52), for schemes "
             "with theta, and the energy bound (58) of Jha & Lipton 2018, with C_t, C_s and C, "
             "beside the largest error over time (against Problem/solution or the torus "
             "reference). The norms in C_t and C_s are the largest of the computed solution.");
    keys.add("Hoelder exponent", hoelder_exponent, any_number(),
             "gamma in (0, 1] of the Hoelder norms of these bounds; smooth data: 1.");
    keys.add("frames", n_frames, count(0, 100000),
             "Number of equidistant states written as VTU files, with a PVD file, for each method "
             "at the finest level with the first scheme and the shortest step.");
  }

  void TimeSection::complete() const
  {
    const auto require =
        [](bool is_good, const std::string &key, double value, const std::string &otherwise)
    {
      if (!is_good)
        throw InputError("Time/" + key + " = " + short_number(value) + " " + otherwise);
    };
    require(final_time >= 0 && std::isfinite(final_time), "final time", final_time,
            "must be positive and finite; give a time > 0, or 0 for statics");
    require(density > 0 && std::isfinite(density), "density", density,
            "must be positive and finite; give the mass per unit volume");
    require(damping >= 0 && std::isfinite(damping), "damping", damping,
            "must not be negative, which would add energy; give a rate >= 0");
    require(hoelder_exponent > 0 && hoelder_exponent <= 1, "Hoelder exponent", hoelder_exponent,
            "must be in (0, 1]; write 1 for smooth data");
    for (const double step : steps)
      require(step > 0 && std::isfinite(step), "steps", step, "must be positive; give a time > 0");
    for (const double fraction : fractions)
      require(fraction > 0 && std::isfinite(fraction), "critical fractions", fraction,
              "must be positive; give a fraction of the critical step such as 0.5");
    const std::vector<double> &given = steps.empty() ? fractions : steps;
    const std::string key = steps.empty() ? "critical fractions" : "steps";
    if (given.empty() || schemes.empty())
      throw InputError("Time/steps and Time/critical fractions are both empty, or Time/schemes is; "
                       "give at least one scheme and one step");
    for (std::size_t i = 1; i < given.size(); ++i)
      require(given[i] < given[i - 1], key, given[i],
              "follows a shorter or equal one; write steps in decreasing order");
  }
} // namespace plumbline::scene
