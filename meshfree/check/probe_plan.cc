#include "meshfree/check/probe_plan.h"

#include "base/error.h"
#include "base/number_text.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  using dealii::Point;

  namespace
  {
    /// Lengths that differ by less, in horizons, are alike: files are often written with six
    /// digits.
    constexpr double alike = 1e-5;

    std::string number(double value)
    {
      constexpr int digits = 6;
      return base::to_text(value, digits);
    }

    void check(const ProbeSettings &settings)
    {
      const auto check_length = [](const std::string &name, double value)
      {
        if (!(value > 0) || !std::isfinite(value))
          throw InputError("the " + name + " is " + number(value) +
                           "; give a positive length in the unit of the nodes");
      };
      check_length("horizon", settings.horizon);
      check_length("step of the displacements", settings.step);
      if (settings.n_nodes == 0)
        throw InputError("no node is displaced; give a number of nodes of at least 1 (--nodes)");
    }

    template <int dim>
    std::vector<std::size_t> nodes_in_middle(const std::vector<Point<dim>> &places,
                                             const ProbeSettings &settings)
    {
      const Point<dim> middle = dealii::BoundingBox<dim>(places).center();
      std::vector<double> distances;
      for (const Point<dim> &x : places)
      {
        double distance = 0;
        for (unsigned int d = 0; d < dim; ++d)
          distance = std::max(distance, std::abs(x[d] - middle[d]));
        distances.push_back(distance);
      }
      std::vector<double> sorted = distances;
      const auto last = sorted.begin() +
                        static_cast<std::ptrdiff_t>(std::min(settings.n_nodes, places.size()) - 1);
      std::nth_element(sorted.begin(), last, sorted.end());
      std::vector<std::size_t> nodes;
      for (std::size_t i = 0; i < places.size(); ++i)
        if (distances[i] <= *last + alike * settings.horizon)
          nodes.push_back(i);
      return nodes;
    }

    template <int dim>
    std::vector<std::vector<std::size_t>> neighbours_of(const std::vector<std::size_t> &nodes,
                                                        const std::vector<Point<dim>> &places,
                                                        double horizon)
    {
      const auto tree = dealii::pack_rtree_of_indices(places);
      const double reach = (1 + alike) * horizon;
      std::vector<std::vector<std::size_t>> result;
      for (const std::size_t node : nodes)
      {
        dealii::BoundingBox<dim> box({places[node], places[node]});
        box.extend(reach);
        std::vector<std::size_t> &near = result.emplace_back();
        for (const std::size_t i : tree | boost::geometry::index::adaptors::queried(
                                              boost::geometry::index::intersects(box)))
          if (i != node && places[i].distance(places[node]) <= reach)
            near.push_back(i);
        std::sort(near.begin(), near.end());
      }
      return result;
    }

    /// First-fit, by the nodes that each group reaches.
    std::vector<std::vector<std::size_t>>
    groups_of(const std::vector<std::size_t> &displaced,
              const std::vector<std::vector<std::size_t>> &neighbours, std::size_t n_nodes)
    {
      std::vector<std::vector<std::size_t>> groups;
      std::vector<std::vector<bool>> reached;
      for (std::size_t k = 0; k < displaced.size(); ++k)
      {
        std::size_t g = 0;
        const auto is_free = [&](std::size_t node) { return !reached[g][node]; };
        while (g < groups.size() &&
               !(is_free(displaced[k]) &&
                 std::all_of(neighbours[k].begin(), neighbours[k].end(), is_free)))
          ++g;
        if (g == groups.size())
        {
          groups.emplace_back();
          reached.emplace_back(n_nodes);
        }
        groups[g].push_back(k);
        reached[g][displaced[k]] = true;
        for (const std::size_t node : neighbours[k])
          reached[g][node] = true;
      }
      return groups;
    }
  } // namespace

  template <int dim>
  ProbePlan<dim> plan_probe(const std::vector<Point<dim>> &places, const ProbeSettings &settings)
  {
    check(settings);
    if (places.size() < 2)
      throw InputError("there are " + std::to_string(places.size()) +
                       "  nodes, too few for a bond; give a body that is several horizons wide");
    ProbePlan<dim> plan;
    plan.places = places;
    plan.settings = settings;
    plan.displaced = nodes_in_middle(places, settings);
    plan.neighbours = neighbours_of(plan.displaced, places, settings.horizon);
    for (std::size_t k = 0; k < plan.displaced.size(); ++k)
      if (plan.neighbours[k].empty())
      {
        double nearest = HUGE_VAL;
        for (std::size_t i = 0; i < places.size(); ++i)
          if (i != plan.displaced[k])
            nearest = std::min(nearest, places[i].distance(places[plan.displaced[k]]));
        throw InputError("the horizon " + number(settings.horizon) + " is less than the distance " +
                         number(nearest) +
                         " between a node and its nearest neighbour; give the horizon of the "
                         "program, in the length unit of the nodes");
      }
    plan.groups = groups_of(plan.displaced, plan.neighbours, places.size());
    return plan;
  }

  template ProbePlan<2> plan_probe(const std::vector<Point<2>> &, const ProbeSettings &);
  template ProbePlan<3> plan_probe(const std::vector<Point<3>> &, const ProbeSettings &);
} // namespace plumbline::meshfree
