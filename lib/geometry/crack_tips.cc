#include "geometry/crack_tips.h"

#include "base/number_text.h"
#include "geometry/search.h"

#include <cmath>

namespace plumbline::geometry
{
  namespace
  {
    using dealii::Tensor;

    /// Bonds between some places, as seen from a point that they may pass through.
    std::size_t n_through(const std::vector<Tensor<1, 2>> &places, double horizon)
    {
      const double tolerance = on_crack * horizon;
      std::size_t n = 0;
      for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t j = i + 1; j < places.size(); ++j)
        {
          const Tensor<1, 2> &a = places[i], &b = places[j];
          const double length = (b - a).norm();
          if (a * b < 0 && length <= horizon + tolerance &&
              std::abs(a[0] * b[1] - a[1] * b[0]) <= tolerance * length)
            ++n;
        }
      return n;
    }
  } // namespace

  std::string TipOnBonds::text(const Point<2> &origin) const
  {
    constexpr int digits = 12;
    return std::to_string(n_bonds) + (n_bonds == 1 ? " bond passes" : " bonds pass") +
           " through the end (" + base::to_text(origin[0] + tip[0], digits) + ", " +
           base::to_text(origin[1] + tip[1], digits) + ") of crack " + std::to_string(crack) +
           " (Domain/cracks) and " + (n_bonds == 1 ? "counts" : "count") +
           " as intact; a slightly longer crack cuts " + (n_bonds == 1 ? "it" : "them") +
           ". Move the end by a fraction of h to decide";
  }

  std::vector<TipOnBonds> tips_on_bonds(const std::vector<Polyline> &cracks,
                                        const std::vector<Point<2>> &nodes, double horizon)
  {
    std::vector<Box> boxes;
    for (const Point<2> &x : nodes)
      boxes.push_back({x, x});
    const BoxSearch<2> search(boxes);
    std::vector<TipOnBonds> result;
    std::vector<unsigned int> near;
    for (std::size_t c = 0; c < cracks.size(); ++c)
    {
      const Polyline &crack = cracks[c];
      if (crack.size() < 2 || crack.front().distance(crack.back()) <= on_crack * horizon)
        continue; // closed
      for (const Point<2> &tip : {crack.front(), crack.back()})
      {
        const Point<2> margin(horizon, horizon);
        search.find({Point<2>(tip - margin), tip + margin}, near);
        std::vector<Tensor<1, 2>> places;
        for (const unsigned int k : near)
          places.push_back(nodes[k] - tip);
        if (const std::size_t n = n_through(places, horizon); n > 0)
          result.push_back({c, tip, n});
      }
    }
    return result;
  }
} // namespace plumbline::geometry
