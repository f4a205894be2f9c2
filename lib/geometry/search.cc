#include "geometry/search.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace plumbline::geometry
{
  namespace
  {
    double longer_side(const Box &box)
    {
      return std::max(box.upper[0] - box.lower[0], box.upper[1] - box.lower[1]);
    }

    bool overlap(const Box &a, const Box &b) // without branches, which would be hard to predict
    {
      return (a.lower[0] <= b.upper[0]) & (b.lower[0] <= a.upper[0]) & (a.lower[1] <= b.upper[1]) &
             (b.lower[1] <= a.upper[1]);
    }

    void check(const std::vector<Box> &boxes)
    {
      for (std::size_t i = 0; i < boxes.size(); ++i)
      {
        const auto &a = boxes[i].lower, &b = boxes[i].upper;
        if (a[0] <= b[0] && a[1] <= b[1] && std::isfinite(b[0] - a[0]) &&
            std::isfinite(b[1] - a[1]))
          continue;
        std::ostringstream message;
        message << "box " << i << " from (" << a[0] << ", " << a[1] << ") to (" << b[0] << ", "
                << b[1] << ") cannot be searched for; give finite corners, the lower one first";
        throw InputError(message.str());
      }
    }
  } // namespace

  double BoxSearch::Grid::bin(double x, int axis) const
  {
    const double last = n_bins[axis];
    return std::max(-1., std::min(last, std::floor((x - origin[axis]) / bin_size)));
  }

  BoxSearch::BoxSearch(std::vector<Box> boxes) : boxes_(std::move(boxes))
  {
    check(boxes_);
    std::map<int, std::vector<unsigned int>> like_size; // by the power of two in the longer side
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      like_size[std::ilogb(longer_side(boxes_[i]))].push_back(i);
    for (const auto &[power, members] : like_size)
      grids_.push_back(make_grid(members));
  }

  BoxSearch::Grid BoxSearch::make_grid(const std::vector<unsigned int> &members) const
  {
    Point<2> first = boxes_[members[0]].lower, last = first; // lower corners
    double side = 0;
    for (unsigned int i : members)
    {
      side = std::max(side, longer_side(boxes_[i]));
      for (int k = 0; k < 2; ++k)
      {
        first[k] = std::min(first[k], boxes_[i].lower[k]);
        last[k] = std::max(last[k], boxes_[i].lower[k]);
      }
    }
    // then x and y of a box's two corners are at most one bin apart, in spite of rounding
    side *= 1 + 1e-6;
    const double x = last[0] - first[0], y = last[1] - first[1], n = members.size();
    const double bin_size = std::max({side, std::sqrt(x / n) * std::sqrt(y), (x + y) / n});
    Grid grid{first, bin_size > 0 ? bin_size : 1, {}, {}, std::vector<Member>(members.size())};
    grid.n_bins = {1 + static_cast<std::size_t>(x / grid.bin_size),
                   1 + static_cast<std::size_t>(y / grid.bin_size)};

    const auto bin = [&](unsigned int i)
    {
      const auto &p = boxes_[i].lower;
      return static_cast<std::size_t>(grid.bin(p[1], 1)) * grid.n_bins[0] +
             static_cast<std::size_t>(grid.bin(p[0], 0));
    };
    grid.start.assign(grid.n_bins[0] * grid.n_bins[1] + 1, 0);
    for (unsigned int i : members)
      ++grid.start[bin(i) + 1];
    for (std::size_t b = 1; b < grid.start.size(); ++b)
      grid.start[b] += grid.start[b - 1];
    std::vector<std::size_t> next = grid.start;
    for (unsigned int i : members)
      grid.members[next[bin(i)]++] = {boxes_[i], i};
    return grid;
  }

  void BoxSearch::find(const Box &box, std::vector<unsigned int> &found) const
  {
    std::size_t n_found = 0;
    for (const Grid &grid : grids_)
    {
      std::array<std::ptrdiff_t, 2> from, to;
      for (int k = 0; k < 2; ++k)
      {
        from[k] = std::max(0., grid.bin(box.lower[k], k) - 1);
        to[k] = std::min(grid.n_bins[k] - 1., grid.bin(box.upper[k], k));
      }
      if (from[0] > to[0])
        continue;
      for (std::ptrdiff_t j = from[1]; j <= to[1]; ++j)
      {
        const std::size_t *row = grid.start.data() + j * grid.n_bins[0];
        const std::size_t first = row[from[0]], end = row[to[0] + 1];
        found.resize(n_found + (end - first));
        for (std::size_t m = first; m < end; ++m)
        {
          found[n_found] = grid.members[m].index;
          n_found += overlap(grid.members[m].box, box);
        }
      }
    }
    found.resize(n_found);
    std::sort(found.begin(), found.end());
  }

  Box bounding_box(ArrayView<const Point<2>> vertices)
  {
    Box box{vertices[0], vertices[0]};
    for (const auto &v : vertices)
      for (int k = 0; k < 2; ++k)
      {
        box.lower[k] = std::min(box.lower[k], v[k]);
        box.upper[k] = std::max(box.upper[k], v[k]);
      }
    return box;
  }
} // namespace plumbline::geometry
