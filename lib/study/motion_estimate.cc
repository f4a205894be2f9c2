#include "study/motion_estimate.h"

#include "analysis/statics.h"
#include "base/error.h"
#include "method/another_operator.h"
#include "method/box_discretisation.h"
#include "method/discretisation.h"
#include "study/motion_norms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace plumbline::study
{
  namespace
  {
    template <int dim>
    using Places = std::map<std::array<long long, dim>, std::size_t>;

    /// Nodes by where they are; empty where several share a place, as those of discontinuous
    /// functions do.
    template <int dim>
    Places<dim> places_of(const method::MotionOf<dim> &equation, double h)
    {
      constexpr double rounding = 1e-6; // of h, far below the distance of nodes
      Places<dim> places;
      for (std::size_t i = 0; i < equation.nodes().size(); ++i)
      {
        std::array<long long, dim> place;
        for (unsigned int d = 0; d < dim; ++d)
          place[d] = std::llround(equation.nodes()[i][d] / (rounding * h));
        if (!places.try_emplace(place, i).second)
          return {};
      }
      return places;
    }

    /// What a motion has beyond another at the nodes that both have.
    template <int dim>
    std::vector<double>
    change_at_shared(const method::MotionOf<dim> &from, const std::vector<double> &of_from,
                     const method::MotionOf<dim> &to, const std::vector<double> &of_to, double h)
    {
      const Places<dim> here = places_of(from, h), there = places_of(to, h);
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
    if (!method::is_reference(method) || scene.time.shows_blow_up)
      return false;
    const bool is_known = scene.reference.method.has_value() || !scene.problem.solutions.empty();
    return scene.reference.estimate == scene::Estimate::every ||
           (scene.reference.estimate == scene::Estimate::automatic && !is_known);
  }

  bool is_motion_shared(const scene::Scene &scene, const Method &method)
  {
    return scene.domain.mesh.is_lattice() && !wants_estimate(scene, method) &&
           scene.domain.cubes(scene.study.series.front().levels.front().h).is_box();
  }

  void share_motion(const scene::Scene &scene, const Method &method,
                    method::DiscretisationInSpace &discretisation, const base::Communicator &ranks)
  {
    if (ranks.n_ranks() > 1 && is_motion_shared(scene, method))
      discretisation.distribute(ranks);
  }

  void settle_quadrature(method::Discretisation &discretisation, const problem::Problem<2> &first)
  {
    if (first.is_floating())
      return;
    problem::Problem<2> pulled = first;
    pulled.load = {[](const dealii::Point<2> &, unsigned int) { return 1.; }, {}};
    pulled.constraint = {[](const dealii::Point<2> &, unsigned int) { return 0.; }, {}};
    analysis::settle_quadrature(discretisation, pulled);
  }

  analysis::State move_exactly(const scene::Scene &scene, const analysis::Transient &transient,
                               const analysis::State &start)
  {
    analysis::State state = start;
    analysis::integrate(transient.motion(), analysis::scheme("Runge-Kutta"),
                        {scene.time.final_time / 4}, scene.time.final_time, state);
    return state;
  }

  namespace
  {
    /// A motion to compare others with.
    template <int dim>
    class Own
    {
    public:
      Own(const scene::Scene &scene, const method::MotionOf<dim> &equation,
          const analysis::State &end, double area, double h)
          : scene_(scene), equation_(equation), u_(equation.nodal(end.u)), area_(area), h_(h)
      {
      }

      /// How far another one is off at the final time; 0: they share no nodes.
      double change_to(const method::MotionOf<dim> &other, ProblemsInTime<dim> &problems) const
      {
        const MotionData<dim> data = motion_data(scene_, other, problems);
        const analysis::Transient transient(other, data.drive, scene_.time.density,
                                            scene_.time.damping);
        const std::vector<double> change = change_at_shared(
            equation_, u_, other, other.nodal(move_exactly(scene_, transient, data.start).u), h_);
        return change.empty() ? 0 : norm_of(change, equation_.n_components(), area_, false);
      }

      double change_to(const Method &method, ProblemsInTime<dim> &problems) const
      {
        const auto other = discretise(method, problems.at(0));
        settle_quadrature(*other, problems.at(0));
        return change_to(*other->motion(scene_.time.is_lumped), problems);
      }

    private:
      const scene::Scene &scene_;
      const method::MotionOf<dim> &equation_;
      std::vector<double> u_;
      double area_, h_;
    };

    /// Largest part of an error that is left when h is halved, as far as 2 h tells.
    template <int dim>
    double ratio(const Own<dim> &own, const Method &method, double change,
                 ProblemsInTime<dim> &problems)
    {
      constexpr double slowest = .9; // errors ten times the change
      const double best = std::exp2(-static_cast<double>(method.order()));
      if constexpr (dim == 3)
        if (!problem::has_doubled(problems.at(0)))
          return std::max(best, .5);
      try
      {
        ProblemsInTime<dim> coarser = problems.resized(2 * problems.at(0).level().h);
        if (const double before = own.change_to(method, coarser); before > 0)
          return std::min(slowest, std::max(best, change / before));
      }
      catch (const InputError &) // 2 h does not fit the box, or the horizon
      {
      }
      return std::max(best, .5);
    }
  } // namespace

  template <int dim>
  std::optional<MotionEstimate> estimate_in_space(const scene::Scene &scene, const Method &method,
                                                  const method::MotionOf<dim> &equation,
                                                  const method::MotionOf<dim> *finer_quadrature,
                                                  const analysis::State &end, double area,
                                                  ProblemsInTime<dim> &problems)
  {
    constexpr double safety = 1.5;
    const double h = problems.at(0).level().h;
    const Own<dim> own(scene, equation, end, area, h);
    double degree = 0;
    if (dim == 2)
    {
      const auto higher = method.higher_degree();
      if (!higher)
        return {};
      degree = own.change_to(*higher, problems);
      if (degree == 0)
        return {};
    }
    ProblemsInTime<dim> finer = problems.resized(h / 2);
    const double half = own.change_to(method, finer);
    if (half == 0)
      return {};
    MotionEstimate estimate;
    estimate.space = safety * std::max(degree, half / (1 - ratio(own, method, half, problems)));
    if (finer_quadrature != nullptr)
      estimate.quadrature = own.change_to(*finer_quadrature, problems);
    return estimate;
  }

  template std::optional<MotionEstimate> estimate_in_space(const scene::Scene &, const Method &,
                                                           const method::MotionOf<2> &,
                                                           const method::MotionOf<2> *,
                                                           const analysis::State &, double,
                                                           ProblemsInTime<2> &);
  template std::optional<MotionEstimate> estimate_in_space(const scene::Scene &, const Method &,
                                                           const method::MotionOf<3> &,
                                                           const method::MotionOf<3> *,
                                                           const analysis::State &, double,
                                                           ProblemsInTime<3> &);
} // namespace plumbline::study
