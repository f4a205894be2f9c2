#include "study/growth.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace plumbline::study
{
  using analysis::Event;
  using dealii::Point;

  namespace
  {
    constexpr double nearest = 1.01; // mesh sizes, of next neighbours

    bool are_next(const GrowthModel &model, const std::array<unsigned int, 2> &bond)
    {
      return model.nodes[bond[0]].distance(model.nodes[bond[1]]) < nearest * model.h;
    }

    /// Of two places the one that is farther from the notch's tip; of two that are mirror images,
    /// which rounding tells apart, the upper one.
    bool is_farther(const GrowthModel &model, const Point<2> &x, const Point<2> &y)
    {
      constexpr double rounding = 1e-6; // of h
      const double difference = x.distance(model.notch_tip) - y.distance(model.notch_tip);
      if (std::abs(difference) > rounding * model.h)
        return difference > 0;
      const LatticePlace<2> a = lattice_place(model, x), b = lattice_place(model, y);
      return std::make_pair(a[1], a[0]) > std::make_pair(b[1], b[0]);
    }

    /// The side that the cells of two next neighbours share.
    std::array<Point<2>, 2> side_between(const GrowthModel &model,
                                         const std::array<unsigned int, 2> &bond)
    {
      const Point<2> &a = model.nodes[bond[0]], &b = model.nodes[bond[1]];
      dealii::Tensor<1, 2> half;
      half[0] = -.5 * (b[1] - a[1]);
      half[1] = .5 * (b[0] - a[0]);
      const Point<2> middle = a + .5 * (b - a);
      return {middle - half, middle + half};
    }

    /// Ends of sides that are connected to the notch.
    class Joined
    {
    public:
      Joined(const GrowthModel &model, const std::vector<std::array<Point<2>, 2>> &notch)
          : model_(&model)
      {
        for (const auto &ends : notch)
          insert(ends);
      }

      /// Take in sides that touch them, and all that these reach.
      void grow(std::vector<CrackSide> &sides, std::size_t event)
      {
        for (bool is_growing = true; is_growing;)
        {
          is_growing = false;
          for (CrackSide &side : sides)
            if (!side.is_joined && touches(side.ends))
            {
              side.is_joined = is_growing = true;
              side.joined = event;
              insert(side.ends);
            }
        }
      }

    private:
      using Ends = std::array<Point<2>, 2>;

      /// The axis that a side is along.
      unsigned int axis(const Ends &ends) const
      {
        return lattice_place(*model_, ends[0])[0] == lattice_place(*model_, ends[1])[0] ? 1 : 0;
      }

      void insert(const Ends &ends)
      {
        for (const Point<2> &end : ends)
          places_[axis(ends)].insert(lattice_place(*model_, end));
      }

      /// At an end, or where a crack steps from one row to the next without parting neighbours.
      bool touches(const Ends &ends) const
      {
        constexpr long step = 2; // one mesh size
        const unsigned int along = axis(ends);
        for (const Point<2> &end : ends)
        {
          LatticePlace<2> place = lattice_place(*model_, end);
          if (places_[0].count(place) > 0 || places_[1].count(place) > 0)
            return true;
          for (const long to : {-step, 2 * step})
          {
            place[1 - along] += to;
            if (places_[along].count(place) > 0)
              return true;
          }
        }
        return false;
      }

      const GrowthModel *model_;
      std::array<std::set<LatticePlace<2>>, 2> places_; ///< of sides along x and along y
    };
  } // namespace

  namespace
  {
    /// Of the first next neighbours that part, if any do.
    std::vector<std::array<Point<2>, 2>> first_side(const GrowthModel &model,
                                                    const std::vector<Event> &events)
    {
      for (const Event &event : events)
        for (const std::size_t b : event.bonds)
          if (are_next(model, model.bonds[b]))
            return {side_between(model, model.bonds[b])};
      return {};
    }
  } // namespace

  std::optional<Point<2>> find_nucleus(const GrowthModel &model, const std::vector<Event> &events)
  {
    const auto side = first_side(model, events);
    if (side.empty())
      return {};
    return side[0][0] + .5 * (side[0][1] - side[0][0]);
  }

  CrackPath find_path(const GrowthModel &model, const std::vector<Event> &events)
  {
    CrackPath path;
    for (const auto &bond : model.cut)
      if (are_next(model, bond))
        path.notch.push_back(side_between(model, bond));
    Joined joined(model, path.notch.empty() ? first_side(model, events) : path.notch);
    Point<2> tip = model.notch_tip;
    for (std::size_t e = 0; e < events.size(); ++e)
    {
      const std::size_t before = path.sides.size();
      for (const std::size_t b : events[e].bonds)
        if (are_next(model, model.bonds[b]))
          path.sides.push_back({side_between(model, model.bonds[b]), e, false});
      if (path.sides.size() > before)
        joined.grow(path.sides, e);
      for (const CrackSide &side : path.sides)
        for (const Point<2> &end : side.ends)
          if (side.is_joined && is_farther(model, end, tip))
            tip = end;
      path.tips.push_back(tip);
    }
    std::set<long> columns;
    for (const CrackSide &side : path.sides)
      if (const LatticePlace<2> a = lattice_place(model, side.ends[0]),
          b = lattice_place(model, side.ends[1]);
          a[0] != b[0])
        columns.insert(a[0] + b[0]);
    path.width = static_cast<double>(columns.size()) * model.h;
    for (const CrackSide &side : path.sides)
      path.n_elsewhere += side.is_joined ? 0 : 1;
    return path;
  }
} // namespace plumbline::study
