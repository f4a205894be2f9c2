#include "study/motion_data.h"

#include "base/control_points.h"
#include "base/cost.h"
#include "base/error.h"
#include "method/equation_of_motion.h"
#include "physics/expression.h"
#include "scene/problem.h"
#include "study/comparison.h"

#include <algorithm>
#include <utility>

namespace plumbline::study
{
  namespace
  {
    using analysis::TimeSeries;
    using analysis::Vector;

    problem::Field<2> given(const std::string &key, const std::string &text,
                            const physics::Names &names)
    {
      const physics::Expression u(key, text, names);
      return {[u](const dealii::Point<2> &x, unsigned int c) { return u(x, c); }, {}};
    }

    /// Places in Ω, spread evenly.
    std::vector<dealii::Point<2>> some_places(const problem::Problem<2> &problem)
    {
      constexpr std::size_t n_places = 128;
      const std::vector<dealii::Point<2>> all = comparison_points(problem);
      std::vector<dealii::Point<2>> places;
      for (const double s : base::control_points(std::min(n_places, all.size())))
        places.push_back(all[static_cast<std::size_t>(s * static_cast<double>(all.size()))]);
      return places;
    }

    problem::Field<2> nothing()
    {
      return {[](const dealii::Point<2> &, unsigned int) { return 0.; }, {}};
    }
  } // namespace

  const problem::Problem<2> &ProblemsInTime::at(double t)
  {
    auto &problem = problems_[t];
    if (!problem)
    {
      const base::CpuTimer timer;
      const std::tuple key(case_index_, level_.horizon, t);
      const auto known = loads_.find(key);
      problem = std::make_unique<const problem::Problem<2>>(
          make_problem(scene_, case_index_, level_, t,
                       known == loads_.end() ? nullptr : &known->second, first_.get()));
      if (!first_)
        first_ = std::make_unique<const problem::Problem<2>>(*problem);
      if (known == loads_.end() && problem->load.series) // a series stands on the box, not on h
        loads_.emplace(key, problem->load);
      seconds_ += timer.seconds();
    }
    return *problem;
  }

  std::size_t ProblemsInTime::points_in_time()
  {
    if (n_points_)
      return *n_points_;
    const std::vector<dealii::Point<2>> places = some_places(at(0));
    const scene::ProblemSection &problem = scene_.problem;
    std::size_t most = 0;
    const auto look_at = [&](const std::string &key, const std::string &text)
    {
      const auto values = [&](double t)
      {
        const physics::Expression u(key, text, scene_.names(level_.horizon, t));
        Vector result;
        for (const auto &x : places)
          for (unsigned int c = 0; c < u.n_components(); ++c)
            result.push_back(u(x, c));
        return result;
      };
      const auto n = TimeSeries::points(values, scene_.time.final_time);
      if (!n)
        throw InputError(key + " = '" + text +
                         "' varies so fast in t that 65 Chebyshev points up to Time/final time do "
                         "not resolve it; shorten the time, or give a field that is smoother in t");
      most = std::max(most, *n);
    };
    if (!problem.solutions.empty())
      look_at("Problem/solution", problem.solutions[case_index_].expression);
    if (!problem.loads.empty())
      look_at("Problem/load", problem.loads[case_index_].expression);
    if (problem.constraint)
      look_at("Problem/constraint", *problem.constraint);
    n_points_ = most;
    return most;
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
                       : TimeSeries::resolve(at, time.final_time, tolerance, what,
                                             problems.points_in_time());
    };
    const problem::Problem<2> &first = problems.at(0);
    MotionData data{{},
                    {},
                    {},
                    series("Problem/load", [&](const problem::Problem<2> &instant)
                           { return equation.drive(instant); }),
                    {}};
    if (!is_steady)
    {
      const auto of = [&](const problem::Problem<2> &instant)
      {
        if (is_manufactured && instant.solution)
          return equation.inertia(instant);
        problem::Problem<2> constrained = instant; // a load that is given holds Ω's part itself
        constrained.solution = nothing();
        return equation.inertia(constrained);
      };
      const TimeSeries rate = series("Problem/solution", of).derivative();
      data.drive.add(time.density, rate.derivative());
      data.drive.add(time.density * time.damping, rate);
    }
    if (first.solution)
      data.exact = series("Problem/solution", [&](const problem::Problem<2> &instant)
                          { return equation.state(*instant.solution); });

    physics::Names names = scene.names(first.horizon());
    names.constants["h"] = first.h; // for averages over cells
    if (!time.initial_displacement.empty())
      data.displacement = given("Time/initial displacement", time.initial_displacement, names);
    if (!time.initial_velocity.empty())
      data.velocity = given("Time/initial velocity", time.initial_velocity, names);
    data.start.u = data.displacement ? equation.state(*data.displacement)
                   : data.exact      ? data.exact->at(0)
                                     : Vector(equation.size());
    data.start.v = data.velocity              ? equation.state(*data.velocity)
                   : data.exact && !is_steady ? data.exact->derivative().at(0)
                                              : Vector(equation.size());
    return data;
  }
} // namespace plumbline::study
