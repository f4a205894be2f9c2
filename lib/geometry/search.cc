#include "geometry/search.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <type_traits>

namespace plumbline::geometry
{
  namespace
  {
    template <class Box>
    constexpr unsigned int n_axes = std::is_same_v<Box, Cuboid> ? 3 : 2;

    template <class Box>
    double longest_side(const Box &box)
    {
      double side = 0;
      for (unsigned int d = 0; d < n_axes<Box>; ++d)
        side = std::max(side, box.upper[d] - box.lower[d]);
      return side;
    }

    template <class Box>
    bool overlap(const Box &a, const Box &b) // without branches, which would be hard to predict
    {
      bool result = true;
      for (unsigned int d = 0; d < n_axes<Box>; ++d)
        result &= (a.lower[d] <= b.upper[d]) & (b.lower[d] <= a.upper[d]);
      return result;
    }

    template <class Box>
    void check(const std::vector<Box> &boxes)
    {
      for (std::size_t i = 0; i < boxes.size(); ++i)
      {
        const auto &a = boxes[i].lower, &b = boxes[i].upper;
        bool is_right = true;
        for (unsigned int d = 0; d < n_axes<Box>; ++d)
          is_right = is_right && a[d] <= b[d] && std::isfinite(b[d] - a[d]);
        if (is_right)
          continue;
        const auto words = [](const auto &x)
        {
          std::ostringstream text;
          for (unsigned int d = 0; d < n_axes<Box>; ++d)
            text << (d == 0 ? "(" : ", ") << x[d];
          return text.str() + ")";
        };
        throw InputError("box " + std::to_string(i) + " from " + words(a) + " to " + words(b) +
                         " cannot be searched for; give finite corners, the lower one first");
      }
    }
  } // namespace

  template <int dim>
  double BoxSearch<dim>::Grid::bin(double x, unsigned int axis) const
  {
    const double last = n_bins[axis];
    return std::max(-1., std::min(last, std::floor((x - origin[axis]) / bin_size)));
  }

  template <int dim>
  BoxSearch<dim>::BoxSearch(std::vector<Box> boxes) : boxes_(std::move(boxes))
  {
    check(boxes_);
    std::map<int, std::vector<unsigned int>> like_size; // by the power of two in the longest side
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      like_size[std::ilogb(longest_side(boxes_[i]))].push_back(i);
    for (const auto &[power, members] : like_size)
      grids_.push_back(make_grid(members));
  }

  template <int dim>
  typename BoxSearch<dim>::Grid
  BoxSearch<dim>::make_grid(const std::vector<unsigned int> &members) const
  {
    Point<dim> first = boxes_[members[0]].lower, last = first; // lower corners
    double side = 0;
    for (unsigned int i : members)
    {
      side = std::max(side, longest_side(boxes_[i]));
      for (unsigned int d = 0; d < dim; ++d)
      {
        first[d] = std::min(first[d], boxes_[i].lower[d]);
        last[d] = std::max(last[d], boxes_[i].lower[d]);
      }
    }
    // then coordinates of a box's two corners are at most one bin apart, in spite of rounding
    side *= 1 + 1e-6;
    const double n = members.size();
    double volume_side = 1, length = 0;
    for (unsigned int d = 0; d < dim; ++d)
    {
      volume_side *= std::pow((last[d] - first[d]) / n, 1. / dim);
      length += last[d] - first[d];
    }
    volume_side *= std::pow(n, (dim - 1.) / dim);
    const double bin_size = std::max({side, volume_side, length / n});
    Grid grid;
    grid.origin = first;
    grid.bin_size = bin_size > 0 ? bin_size : 1;
    grid.members.resize(members.size());
    for (unsigned int d = 0; d < dim; ++d)
      grid.n_bins[d] = 1 + static_cast<std::size_t>((last[d] - first[d]) / grid.bin_size);

    const auto bin = [&](unsigned int i)
    {
      std::size_t number = 0;
      for (unsigned int d = dim; d-- > 0;)
        number =
            number * grid.n_bins[d] + static_cast<std::size_t>(grid.bin(boxes_[i].lower[d], d));
      return number;
    };
    grid.start.assign(grid.n_bins[0] * grid.n_bins[1] * grid.n_bins[2] + 1, 0);
    for (unsigned int i : members)
      ++grid.start[bin(i) + 1];
    for (std::size_t b = 1; b < grid.start.size(); ++b)
      grid.start[b] += grid.start[b - 1];
    std::vector<std::size_t> next = grid.start;
    for (unsigned int i : members)
      grid.members[next[bin(i)]++] = {boxes_[i], i};
    return grid;
  }

  template <int dim>
  void BoxSearch<dim>::find(const Box &box, std::vector<unsigned int> &found) const
  {
    std::size_t n_found = 0;
    for (const Grid &grid : grids_)
    {
      std::array<std::ptrdiff_t, 3> from{}, to{};
      for (unsigned int d = 0; d < dim; ++d)
      {
        from[d] = std::max(0., grid.bin(box.lower[d], d) - 1);
        to[d] = std::min(grid.n_bins[d] - 1., grid.bin(box.upper[d], d));
      }
      if (from[0] > to[0])
        continue;
      for (std::ptrdiff_t k = from[2]; k <= to[2]; ++k)
        for (std::ptrdiff_t j = from[1]; j <= to[1]; ++j)
        {
          const std::size_t *row = grid.start.data() + (k * grid.n_bins[1] + j) * grid.n_bins[0];
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

  template class BoxSearch<2>;
  template class BoxSearch<3>;

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
