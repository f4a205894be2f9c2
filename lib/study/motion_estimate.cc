#include "study/motion_estimate.h"

#include "analysis/statics.h"
#include "study/motion_norms.h"

#include <cmath>
#include <map>

namespace plumbline::study
{
  namespace
  {
    using Places = std::map<std::pair<long long, long long>, std::size_t>;

    /// Nodes by where they are; empty where several share a place, as those of discontinuous
    /// functions do.
    Places places_of(const method::EquationOfMotion &equation, double h)
    {
      constexpr double rounding = 1e-6; // of h, far below the distance of nodes
      Places places;
      for (std::size_t i = 0; i < equation.nodes().size(); ++i)
      {
        const auto &x = equation.nodes()[i];
        if (!places
                 .try_emplace(
                     {std::llround(x[0] / (rounding * h)), std::llround(x[1] / (rounding * h))}, i)
                 .second)
          return {};
      }
      return places;
    }

    /// What a motion has beyond another at the nodes that both have.
    std::vector<double> change_at_shared(const method::EquationOfMotion &from,
                                         const std::vector<double> &of_from,
                                         const method::EquationOfMotion &to,
                                         const std::vector<double> &of_to, double h)
    {
      const Places here = places_of(from, h), there = places_of(to, h);
      const unsigned int n = from.n_components();
      std::vector<double> change;
      for (const auto &[place, i] : here)
        if (const auto found = there.find(place); found != there.end())
          for (unsigned int c = 0; c < n; ++c)
            change.push_back(of_to[found->second * n + c] - of_from[i * n + c]);
      return change;
    }
  } // namespace

  bool wants_estimate(const scene::Scene &scene, const Method &method)
  {
    if (method.side() != Side::reference || scene.time.shows_blow_up)
      return false;
    const bool is_known = scene.reference.method.has_value() || !scene.problem.solutions.empty();
    return scene.reference.estimate == scene::Estimate::every ||
           (scene.reference.estimate == scene::Estimate::automatic && !is_known);
  }

  void settle_quadrature(const scene::Scene &scene, method::Discretisation &discretisation,
                         const scene::Problem &first)
  {
    if (scene.domain.is_floating)
      return;
    scene::Problem pulled = first;
    pulled.load = {[](const dealii::Point<2> &, unsigned int) { return 1.; }, {}};
    pulled.constraint = {[](const dealii::Point<2> &, unsigned int) { return 0.; }, {}};
    analysis::settle_quadrature(discretisation, pulled);
  }

  analysis::State move_exactly(const scene::Scene &scene, const method::EquationOfMotion &equation,
                               ProblemsInTime &problems)
  {
    const MotionData data = motion_data(scene, equation, problems);
    const analysis::Transient transient(equation, data.drive, scene.time.density,
                                        scene.time.damping);
    analysis::State state = data.start;
    analysis::integrate(transient.motion(), analysis::scheme("Runge-Kutta"),
                        {scene.time.final_time / 4}, scene.time.final_time, state);
    return state;
  }

  std::optional<MotionEstimate> estimate_in_space(const scene::Scene &scene, const Method &method,
                                                  const method::Discretisation &discretisation,
                                                  const method::EquationOfMotion &equation,
                                                  const analysis::State &end, double area,
                                                  ProblemsInTime &problems)
  {
    const auto higher = method.higher_degree();
    if (!higher)
      return {};
    const std::vector<double> own = equation.nodal(end.u);
    const auto change_to = [&](const method::EquationOfMotion &other)
    {
      return change_at_shared(equation, own, other,
                              other.nodal(move_exactly(scene, other, problems).u),
                              problems.at(0).h);
    };
    const auto norm = [&](const std::vector<double> &change)
    { return norm_of(change, equation.n_components(), area, false); };
    const auto finer_space = higher->discretise(problems.at(0), base::Team::alone());
    settle_quadrature(scene, *finer_space, problems.at(0));
    const std::vector<double> change = change_to(*finer_space->motion(scene.time.is_lumped));
    if (change.empty())
      return {};
    MotionEstimate estimate;
    estimate.space = norm(change);
    if (const auto finer = discretisation.finer_motion(scene.time.is_lumped))
      estimate.quadrature = norm(change_to(*finer));
    return estimate;
  }
} // namespace plumbline::study
