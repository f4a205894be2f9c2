#include "study/motion_data.h"

#include "base/control_points.h"
#include "base/cost.h"
#include "base/error.h"
#include "method/box_discretisation.h"
#include "method/discretisation.h"
#include "method/distributed_motion.h"
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

    double value_of(const physics::Expression &u, const dealii::Point<2> &x, unsigned int c)
    {
      return u(x, c);
    }

    double value_of(const physics::Expression &u, const dealii::Point<3> &x, unsigned int c)
    {
      return u.at(x, c);
    }

    template <int dim>
    problem::Field<dim> given(const std::string &key, const std::string &text,
                              const physics::Names &names)
    {
      const physics::Expression u(key, text, names);
      return {[u](const dealii::Point<dim> &x, unsigned int c) { return value_of(u, x, c); }, {}};
    }

    /// Indices below a number, spread evenly.
    std::vector<std::size_t> some_of(std::size_t n_all)
    {
      constexpr std::size_t n_places = 128;
      std::vector<std::size_t> indices;
      for (const double s : base::control_points(std::min(n_places, n_all)))
        indices.push_back(static_cast<std::size_t>(s * static_cast<double>(n_all)));
      return indices;
    }

    /// Places in Ω, spread evenly.
    std::vector<dealii::Point<2>> some_places(const problem::Problem<2> &problem)
    {
      const std::vector<dealii::Point<2>> all = comparison_points(problem);
      std::vector<dealii::Point<2>> places;
      for (const std::size_t i : some_of(all.size()))
        places.push_back(all[i]);
      return places;
    }

    std::vector<dealii::Point<3>> some_places(const problem::Problem<3> &problem)
    {
      constexpr double middle = .5;
      const geometry::CubeLattice &lattice = problem.lattice;
      std::vector<dealii::Point<3>> all, places;
      lattice.for_each_cell(
          [&](const std::array<int, 3> &cell)
          {
            all.emplace_back(lattice.coordinate(0, cell[0] + middle),
                             lattice.coordinate(1, cell[1] + middle),
                             lattice.coordinate(2, cell[2] + middle));
          });
      for (const std::size_t i : some_of(all.size()))
        places.push_back(all[i]);
      return places;
    }

    problem::Problem<2> problem_at(const scene::Scene &scene, unsigned int case_index,
                                   const problem::Level &level, double t,
                                   const problem::Field<2> *known_load,
                                   const problem::Problem<2> *same_place)
    {
      return make_problem(scene, case_index, level, t, known_load, same_place);
    }

    problem::Problem<3> problem_at(const scene::Scene &scene, unsigned int case_index,
                                   const problem::Level &level, double t,
                                   const problem::Field<3> *known_load,
                                   const problem::Problem<3> *same_place)
    {
      return make_problem_in_space(scene, case_index, level, t, known_load,
                                   same_place != nullptr ? same_place->cells : nullptr);
    }

    problem::Field<2> nothing(const problem::Problem<2> &)
    {
      return {[](const dealii::Point<2> &, unsigned int) { return 0.; }, {}};
    }

    problem::Field<3> nothing(const problem::Problem<3> &problem)
    {
      problem::Field<3> zero{[](const dealii::Point<3> &, unsigned int) { return 0.; }};
      const geometry::Cuboid box = problem.lattice.cuboid();
      zero.series = physics::ChebyshevInSpace::resolve(zero.value, problem.n_components, box.lower,
                                                       box.upper);
      return zero;
    }
  } // namespace

  template <int dim>
  const problem::Problem<dim> &ProblemsInTime<dim>::at(double t)
  {
    auto &problem = problems_[t];
    if (!problem)
    {
      const base::CpuTimer timer;
      const std::tuple key(case_index_, level_.horizon, t);
      const auto known = loads_.find(key);
      problem = std::make_unique<const problem::Problem<dim>>(
          problem_at(scene_, case_index_, level_, t,
                     known == loads_.end() ? nullptr : &known->second, first_.get()));
      if (!first_)
        first_ = std::make_unique<const problem::Problem<dim>>(*problem);
      if (known == loads_.end() && problem->load.series) // a series stands on the box, not on h
        loads_.emplace(key, problem->load);
      seconds_ += timer.seconds();
    }
    return *problem;
  }

  template <int dim>
  std::size_t ProblemsInTime<dim>::points_in_time()
  {
    if (n_points_)
      return *n_points_;
    const std::vector<dealii::Point<dim>> places = some_places(at(0));
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
            result.push_back(value_of(u, x, c));
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
    if (!problem.local_expression.empty())
      look_at("Problem/local solution", problem.local_expression);
    n_points_ = most;
    return most;
  }

  template <int dim>
  MotionData<dim> motion_data(const scene::Scene &scene, const method::MotionOf<dim> &equation,
                              ProblemsInTime<dim> &problems)
  {
    constexpr double tolerance = 1e-11;
    const scene::TimeSection &time = scene.time;
    const bool is_steady = scene.is_steady(), is_manufactured = scene.problem.loads.empty();
    const auto series = [&](const std::string &what, const auto &value)
    {
      const auto at = [&](double t) { return value(problems.at(t)); };
      return is_steady ? TimeSeries(at(0))
                       : TimeSeries::resolve(at, time.final_time, tolerance, what,
                                             problems.points_in_time(), method::ranks_of(equation));
    };
    const problem::Problem<dim> &first = problems.at(0);
    MotionData<dim> data{{},
                         {},
                         {},
                         series("Problem/load", [&](const problem::Problem<dim> &instant)
                                { return equation.drive(instant); }),
                         {},
                         {}};
    if (!is_steady)
    {
      const auto of = [&](const problem::Problem<dim> &instant)
      {
        if (is_manufactured && instant.solution)
          return equation.inertia(instant);
        problem::Problem<dim> constrained = instant; // a load that is given holds Ω's part itself
        constrained.solution = nothing(instant);
        return equation.inertia(constrained);
      };
      const TimeSeries rate = series("Problem/solution", of).derivative();
      data.drive.add(time.density, rate.derivative());
      data.drive.add(time.density * time.damping, rate);
    }
    if (first.solution)
      data.exact = series("Problem/solution", [&](const problem::Problem<dim> &instant)
                          { return equation.state(*instant.solution); });

    if (scene.problem.local_solution == scene::LocalSolution::expression)
      data.local = series("Problem/local solution", [&](const problem::Problem<dim> &instant)
                          { return equation.state(*instant.local_solution); });

    physics::Names names = scene.names(first.horizon());
    names.constants["h"] = first.level().h; // for averages over cells
    if (!time.initial_displacement.empty())
      data.displacement = given<dim>("Time/initial displacement", time.initial_displacement, names);
    if (!time.initial_velocity.empty())
      data.velocity = given<dim>("Time/initial velocity", time.initial_velocity, names);
    data.start.u = data.displacement ? equation.state(*data.displacement)
                   : data.exact      ? data.exact->at(0)
                                     : Vector(equation.size());
    data.start.v = data.velocity              ? equation.state(*data.velocity)
                   : data.exact && !is_steady ? data.exact->derivative().at(0)
                                              : Vector(equation.size());
    return data;
  }

  std::unique_ptr<method::Discretisation> discretise(const method::Method &method,
                                                     const problem::Problem<2> &problem)
  {
    return method.discretise(problem, base::Communicator::alone());
  }

  std::unique_ptr<method::DiscretisationInSpace> discretise(const method::Method &method,
                                                            const problem::Problem<3> &problem)
  {
    return method.discretise_in_space(problem);
  }

  template class ProblemsInTime<2>;
  template class ProblemsInTime<3>;
  template MotionData<2> motion_data(const scene::Scene &, const method::MotionOf<2> &,
                                     ProblemsInTime<2> &);
  template MotionData<3> motion_data(const scene::Scene &, const method::MotionOf<3> &,
                                     ProblemsInTime<3> &);
} // namespace plumbline::study
