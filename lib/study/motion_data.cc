#include "study/motion_data.h"

#include "base/cost.h"
#include "physics/expression.h"

#include <utility>

namespace plumbline::study
{
  namespace
  {
    using analysis::TimeSeries;
    using analysis::Vector;

    scene::Field given(const std::string &key, const std::string &text, const physics::Names &names)
    {
      const physics::Expression u(key, text, names);
      return {[u](const dealii::Point<2> &x, unsigned int c) { return u(x, c); }, {}};
    }

    scene::Field nothing()
    {
      return {[](const dealii::Point<2> &, unsigned int) { return 0.; }, {}};
    }
  } // namespace

  const scene::Problem &ProblemsInTime::at(double t)
  {
    auto &problem = problems_[t];
    if (!problem)
    {
      const base::CpuTimer timer;
      const std::tuple key(case_index_, level_.horizon, t);
      const auto known = loads_.find(key);
      problem = std::make_unique<const scene::Problem>(
          make_problem(scene_, case_index_, level_, t,
                       known == loads_.end() ? nullptr : &known->second, first_.get()));
      if (!first_)
        first_ = std::make_unique<const scene::Problem>(*problem);
      if (known == loads_.end() && problem->load.series) // a series stands on the box, not on h
        loads_.emplace(key, problem->load);
      seconds_ += timer.seconds();
    }
    return *problem;
  }

  MotionData motion_data(const scene::Scene &scene, const method::EquationOfMotion &equation,
                         ProblemsInTime &problems)
  {
    constexpr double tolerance = 1e-11;
    const scene::TimeSection &time = scene.time;
    const bool is_steady = scene.is_steady(), is_manufactured = scene.problem.loads.empty();
    const auto series = [&](const std::string &what, const auto &value)
    {
      const auto at = [&](double t) { return value(problems.at(t)); };
      return is_steady ? TimeSeries(at(0))
                       : TimeSeries::resolve(at, time.final_time, tolerance, what);
    };
    const scene::Problem &first = problems.at(0);
    MotionData data{{},
                    series("Problem/load",
                           [&](const scene::Problem &instant) { return equation.drive(instant); }),
                    {}};
    if (!is_steady)
    {
      const auto of = [&](const scene::Problem &instant)
      {
        if (is_manufactured && instant.solution)
          return equation.inertia(instant);
        scene::Problem held = instant; // a load that is given holds Ω's part itself
        held.solution = nothing();
        return equation.inertia(held);
      };
      const TimeSeries rate = series("Problem/solution", of).derivative();
      data.drive.add(time.density, rate.derivative());
      data.drive.add(time.density * time.damping, rate);
    }
    if (first.solution)
      data.exact = series("Problem/solution", [&](const scene::Problem &instant)
                          { return equation.state(*instant.solution); });

    physics::Names names = scene.names(first.horizon());
    names.constants["h"] = first.h; // for averages over cells
    data.start.u =
        !time.initial_displacement.empty()
            ? equation.state(given("Time/initial displacement", time.initial_displacement, names))
        : data.exact ? data.exact->at(0)
                     : Vector(equation.size());
    data.start.v =
        !time.initial_velocity.empty()
            ? equation.state(given("Time/initial velocity", time.initial_velocity, names))
        : data.exact && !is_steady ? data.exact->derivative().at(0)
                                   : Vector(equation.size());
    return data;
  }
} // namespace plumbline::study
