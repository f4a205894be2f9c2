#include "study/strip_growth.h"

#include "base/error.h"

#include <algorithm>

namespace plumbline::study
{
  using analysis::Event;
  using analysis::Growth;

  StripGrowth measure_strip(const GrowthModel &strip, double W1, double from, double to)
  {
    constexpr double on_place = 1e-6; // of h
    const auto tips_of = [&](const Growth &growth) { return find_path(strip, growth.events).tips; };
    const auto has_come = [&](const dealii::Point<2> &tip, double x)
    { return tip[0] >= x - on_place * strip.h; };
    const Growth growth = analysis::grow(
        *strip.body, {}, {}, [&](const Growth &now) { return !has_come(tips_of(now).back(), to); });
    const std::vector<dealii::Point<2>> tips = tips_of(growth);
    const auto first_at = [&](double x)
    {
      const auto found =
          std::find_if(tips.begin(), tips.end(), [&](const auto &tip) { return has_come(tip, x); });
      if (found == tips.end())
        throw NumericalError("a crack does not come through its strip");
      return static_cast<std::size_t>(found - tips.begin());
    };
    const std::size_t first = first_at(from), last = first_at(to);
    StripGrowth result;
    for (std::size_t i = first + 1; i <= last; ++i)
    {
      const Event &event = growth.events[i];
      const double square = event.critical * event.critical;
      result.peak = std::max(result.peak, W1 * square);
      result.mean += W1 * square / static_cast<double>(last - first);
      result.released +=
          .5 * square * (event.reaction_before - event.reaction) / event.load / (to - from);
      result.bonds += (event.in_bonds - growth.events[i - 1].in_bonds) / (to - from);
    }
    return result;
  }

  std::optional<StripGrowth> grow_through_strip(const method::StripSolver &solver,
                                                const GrowingStrip &strip,
                                                const physics::Kernel<2> &influence)
  {
    const double h = strip.strip.h;
    const auto make = [&](int n_crack, problem::SurfaceTerms terms)
    {
      method::RiceStrip shape = strip.strip;
      shape.n_crack = n_crack;
      return solver.breakable_strip(shape, strip.lame, terms, influence, strip.backend);
    };
    const int n_crack = strip.strip.n_crack;
    const auto body = make(n_crack, strip.surface_terms);
    if (!body)
      return {};
    const auto energy = [&](int n)
    { return make(n, problem::SurfaceTerms::uncorrected)->body->response().energy; };
    const double W1 = (energy(n_crack) - energy(n_crack + 1)) / h, tip = n_crack * h;
    return measure_strip(*body, W1, tip + 2 * h, tip + (2 + strip.n_columns) * h);
  }
} // namespace plumbline::study
