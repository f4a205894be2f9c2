#include "geometry/cell_sides.h"
#include "study/growth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace plumbline::study
{
  using analysis::Event;
  using dealii::Point;

  namespace
  {
    constexpr double nearest = 1.01; // mesh sizes, of next neighbours

    using Ends = std::array<Point<2>, 2>;

    /// The sides between cells of next neighbours.
    class Sides
    {
    public:
      explicit Sides(const GrowthModel &model) : model_(model)
      {
        if (model.cells)
          for (const geometry::CellSide &side : geometry::shared_sides(*model.cells))
            shared_[side.nodes] = side.ends;
      }

      /// The side that the cells of a bond's nodes share, if they do.
      std::optional<Ends> between(std::array<unsigned int, 2> bond) const
      {
        if (model_.cells)
        {
          std::sort(bond.begin(), bond.end());
          const auto found = shared_.find(bond);
          return found == shared_.end() ? std::nullopt : std::optional<Ends>(found->second);
        }
        const Point<2> &a = model_.nodes[bond[0]], &b = model_.nodes[bond[1]];
        if (a.distance(b) >= nearest * model_.h)
          return {};
        dealii::Tensor<1, 2> half;
        half[0] = -.5 * (b[1] - a[1]);
        half[1] = .5 * (b[0] - a[0]);
        const Point<2> middle = a + .5 * (b - a);
        return Ends{middle - half, middle + half};
      }

    private:
      const GrowthModel &model_;
      std::map<std::array<unsigned int, 2>, Ends> shared_; ///< of scattered nodes
    };

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

    /// Ends of sides that are connected to the notch.
    class Joined
    {
    public:
      Joined(const GrowthModel &model, const std::vector<Ends> &notch) : model_(&model)
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
      /// The axis that a side is along.
      unsigned int axis(const Ends &ends) const
      {
        return lattice_place(*model_, ends[0])[0] == lattice_place(*model_, ends[1])[0] ? 1 : 0;
      }

      void insert(const Ends &ends)
      {
        for (const Point<2> &end : ends)
          if (model_->cells)
            points_.push_back(end);
          else
            places_[axis(ends)].insert(lattice_place(*model_, end));
      }

      /// At an end, or where a crack steps from one row to the next without parting neighbours; of
      /// scattered nodes, within a horizon.
      bool touches(const Ends &ends) const
      {
        if (model_->cells)
          return std::any_of(points_.begin(), points_.end(),
                             [&](const Point<2> &point) {
                               return std::min(point.distance(ends[0]), point.distance(ends[1])) <
                                      model_->horizon;
                             });
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
      std::vector<Point<2>> points_;                    ///< of scattered nodes
    };
  } // namespace

  namespace
  {
    /// Of the first next neighbours that part, if any do.
    std::vector<Ends> first_side(const GrowthModel &model, const Sides &sides,
                                 const std::vector<Event> &events)
    {
      for (const Event &event : events)
        for (const std::size_t b : event.bonds)
          if (const auto side = sides.between(model.bonds[b]))
            return {*side};
      return {};
    }

    /// Of all sides, projected onto the x-axis, once each.
    double projected_width(const std::vector<CrackSide> &sides, double h)
    {
      constexpr double rounding = 1e-9; // of h
      std::vector<std::array<double, 2>> intervals;
      for (const CrackSide &side : sides)
        if (const auto [from, to] = std::minmax(side.ends[0][0], side.ends[1][0]);
            to - from > rounding * h)
          intervals.push_back({from, to});
      std::sort(intervals.begin(), intervals.end());
      double width = 0, covered = -std::numeric_limits<double>::infinity();
      for (const auto &[from, to] : intervals)
      {
        width += std::max(0., to - std::max(from, covered));
        covered = std::max(covered, to);
      }
      return width;
    }
  } // namespace

  std::optional<Point<2>> find_nucleus(const GrowthModel &model, const std::vector<Event> &events)
  {
    const auto side = first_side(model, Sides(model), events);
    if (side.empty())
      return {};
    return side[0][0] + .5 * (side[0][1] - side[0][0]);
  }

  CrackPath find_path(const GrowthModel &model, const std::vector<Event> &events)
  {
    CrackPath path;
    const Sides sides(model);
    for (const auto &bond : model.cut)
      if (const auto side = sides.between(bond))
        path.notch.push_back(*side);
    Joined joined(model, path.notch.empty() ? first_side(model, sides, events) : path.notch);
    Point<2> tip = model.notch_tip;
    for (std::size_t e = 0; e < events.size(); ++e)
    {
      const std::size_t before = path.sides.size();
      for (const std::size_t b : events[e].bonds)
        if (const auto side = sides.between(model.bonds[b]))
          path.sides.push_back({*side, e, false});
      if (path.sides.size() > before)
        joined.grow(path.sides, e);
      for (const CrackSide &side : path.sides)
        for (const Point<2> &end : side.ends)
          if (side.is_joined && is_farther(model, end, tip))
            tip = end;
      path.tips.push_back(tip);
    }
    path.width = projected_width(path.sides, model.h);
    for (const CrackSide &side : path.sides)
      path.n_elsewhere += side.is_joined ? 0 : 1;
    return path;
  }
} // namespace plumbline::study
