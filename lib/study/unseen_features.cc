#include "study/unseen_features.h"

#include "base/error.h"
#include "base/number_text.h"
#include "geometry/polygon.h"
#include "physics/expression.h"
#include "scene/models/model.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::study
{
  using dealii::Point;

  namespace
  {
    /// Out of the range of nodes by less than this part is what smooth values are between nodes.
    constexpr double clear = .1;

    /// In all cells together, and in each of them.
    constexpr double n_samples = 4e5, fewest = 4, most = 100;

    struct Range
    {
      double least = std::numeric_limits<double>::infinity(), largest = -least;

      void add(double value)
      {
        least = std::min(least, value);
        largest = std::max(largest, value);
      }
      void add(const Range &other)
      {
        least = std::min(least, other.least);
        largest = std::max(largest, other.largest);
      }
      bool is_empty() const { return !(least <= largest); }
      bool holds(double value) const
      {
        const double size = std::max({std::abs(least), std::abs(largest), std::abs(value)});
        return value >= least - clear * size && value <= largest + clear * size;
      }
      std::string text() const
      {
        return least == largest
                   ? base::to_text(least, 4)
                   : "from " + base::to_text(least, 4) + " to " + base::to_text(largest, 4);
      }
    };

    /// The range of a value at the nodes about a place: squares as large as a cell of a node, each
    /// with its eight neighbours.
    class NearbyNodes
    {
    public:
      NearbyNodes(const std::vector<Point<2>> &nodes, double side) : side_(side)
      {
        Point<2> lower = nodes.front(), upper = lower;
        for (const Point<2> &x : nodes)
          for (unsigned int d = 0; d < 2; ++d)
          {
            lower[d] = std::min(lower[d], x[d]);
            upper[d] = std::max(upper[d], x[d]);
          }
        for (unsigned int d = 0; d < 2; ++d)
        {
          origin_[d] = lower[d] - 1.5 * side; // nodes of a lattice in the middle, a margin about
          n_[d] = static_cast<std::size_t>((upper[d] - lower[d]) / side) + 4;
        }
        for (const Point<2> &x : nodes)
          square_.push_back(square(x));
      }

      /// Of values at the nodes, by square.
      std::vector<Range> ranges(const std::vector<double> &values) const
      {
        std::vector<Range> own(n_[0] * n_[1]), result = own;
        for (std::size_t i = 0; i < values.size(); ++i)
          own[square_[i]].add(values[i]);
        for (std::size_t j = 1; j + 1 < n_[1]; ++j)
          for (std::size_t i = 1; i + 1 < n_[0]; ++i)
            for (std::size_t l = j - 1; l <= j + 1; ++l)
              for (std::size_t k = i - 1; k <= i + 1; ++k)
                result[j * n_[0] + i].add(own[l * n_[0] + k]);
        return result;
      }

      std::size_t square(const Point<2> &x) const
      {
        std::array<std::size_t, 2> k{};
        for (unsigned int d = 0; d < 2; ++d)
          k[d] = static_cast<std::size_t>(
              std::clamp((x[d] - origin_[d]) / side_, 0., static_cast<double>(n_[d]) - 1));
        return k[1] * n_[0] + k[0];
      }

    private:
      double side_;
      Point<2> origin_;
      std::array<std::size_t, 2> n_{};
      std::vector<std::size_t> square_; ///< of each node
    };

    /// Points of the unit square that fill it evenly, however many (Roberts' R2 sequence).
    class EvenPoints
    {
    public:
      std::array<double, 2> next()
      {
        constexpr std::array<double, 2> step = {0.7548776662466927, 0.5698402909980532};
        for (unsigned int d = 0; d < 2; ++d)
          at_[d] = std::fmod(at_[d] + step[d], 1);
        return at_;
      }

    private:
      std::array<double, 2> at_ = {.5, .5};
    };

    /// Calls f with n points of a convex polygon.
    template <class F>
    void sample(const geometry::Polygon &cell, double n, EvenPoints &points, const F &f)
    {
      const double whole = geometry::area(geometry::view(cell));
      for (std::size_t k = 1; k + 1 < cell.size(); ++k)
      {
        const std::array<Point<2>, 3> corner{cell[0], cell[k], cell[k + 1]};
        const double part = geometry::area({corner.data(), 3}) / whole;
        for (auto left = static_cast<long>(std::ceil(n * part)); left > 0; --left)
        {
          auto [s, t] = points.next();
          if (s + t > 1)
          {
            s = 1 - s;
            t = 1 - t;
          }
          f(Point<2>(corner[0] + s * (corner[1] - corner[0]) + t * (corner[2] - corner[0])));
        }
      }
    }

    /// What one value is where no node near sees it.
    struct Found
    {
      std::size_t n_cells = 0, n_bonds = 0;
      Range there, at_nodes;
    };

    Found look(const SpatialValue &value, const PlacesBetweenNodes &places,
               const NearbyNodes &nearby)
    {
      std::vector<double> at_nodes;
      for (const Point<2> &x : places.nodes)
        at_nodes.push_back(value.at(x));
      const std::vector<Range> ranges = nearby.ranges(at_nodes);
      Found found;
      const auto is_unseen = [&](const Point<2> &x)
      {
        const Range &near = ranges[nearby.square(x)];
        const double here = value.at(x);
        if (near.is_empty() || near.holds(here))
          return false;
        found.there.add(here);
        found.at_nodes.add(near);
        return true;
      };
      EvenPoints points;
      const double n_each =
          std::clamp(n_samples / static_cast<double>(std::max<std::size_t>(1, places.cells.size())),
                     fewest, most);
      for (const geometry::Polygon &cell : places.cells)
      {
        bool is_any = false;
        sample(cell, n_each, points, [&](const Point<2> &x) { is_any = is_unseen(x) || is_any; });
        found.n_cells += is_any ? 1 : 0;
      }
      for (const Point<2> &x : places.middles_of_bonds)
        found.n_bonds += is_unseen(x) ? 1 : 0;
      return found;
    }

    std::string sentence(const std::string &key, const Found &found,
                         const PlacesBetweenNodes &places, double h)
    {
      const auto of = [](std::size_t n, std::size_t all, const std::string &what)
      { return std::to_string(n) + " of " + std::to_string(all) + " " + what; };
      std::string where = of(found.n_cells, places.cells.size(), "cells");
      if (!places.middles_of_bonds.empty())
        where += " and at the midpoints of " +
                 of(found.n_bonds, places.middles_of_bonds.size(), "bonds");
      return key +
             " has features between nodes that no node resolves: at h = " + base::to_text(h, 4) +
             " it is " + found.there.text() + " in " + where + ", but " + found.at_nodes.text() +
             " at the surrounding nodes";
    }
  } // namespace

  std::vector<std::string> unseen_features(const std::vector<SpatialValue> &values,
                                           const PlacesBetweenNodes &places, double h)
  {
    std::vector<std::string> result;
    if (values.empty() || places.nodes.empty())
      return result;
    double area = 0;
    for (const geometry::Polygon &cell : places.cells)
      area += geometry::area(geometry::view(cell));
    const NearbyNodes nearby(places.nodes,
                             std::sqrt(area / static_cast<double>(places.nodes.size())));
    for (const SpatialValue &value : values)
      if (const Found found = look(value, places, nearby); found.n_cells + found.n_bonds > 0)
        result.push_back(sentence(value.key, found, places, h));
    return result;
  }

  std::vector<std::string> unseen_features(const scene::Case &one)
  {
    const problem::Problem<2> &problem = one.problem;
    if (!problem.cells())
      return {};
    std::vector<std::string> result = unseen_features(
        problem.spatial_values, {problem.cells()->nodes, problem.cells()->pieces, {}}, problem.h);
    for (std::string &sentence : result)
      sentence +=
          "; methods that evaluate it at nodes ignore these features, and quadrature may miss "
          "them, too; refine Study/h, or place nodes there";
    return result;
  }
} // namespace plumbline::study
