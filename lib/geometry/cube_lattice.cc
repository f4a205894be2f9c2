#include "geometry/cube_lattice.h"

#include "base/error.h"
#include "geometry/maximal_boxes.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

namespace plumbline::geometry
{
  namespace
  {
    constexpr double whole = 1e-6; // of a cell

    std::ostringstream message_on(double h)
    {
      constexpr int n_digits = 10; // 12.000005 cells are not 12
      std::ostringstream message;
      message << std::setprecision(n_digits) << "mesh size h = " << h;
      return message;
    }

    bool is_whole(double cells)
    {
      return std::abs(cells - std::round(cells)) <= whole;
    }

    void check_sides(const Cuboid &box, double h)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (const double cells = (box.upper[d] - box.lower[d]) / h;
            !(cells > .5) || !is_whole(cells))
        {
          auto message = message_on(h);
          message << " does not divide the box [" << box.lower << "; " << box.upper
                  << "] of Domain into whole cells (" << cells << " along "
                  << "xyz"[d]
                  << "); choose h so that every side is a multiple of it, as a fraction such as "
                     "1/12 if it has no short decimal";
          throw InputError(message.str());
        }
    }

    void check_place(const Cuboid &box, const dealii::Point<3> &origin, double h)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (const double cells = (box.lower[d] - origin[d]) / h; !is_whole(cells))
        {
          auto message = message_on(h);
          message << ": the box [" << box.lower << "; " << box.upper << "] of Domain begins "
                  << cells << " cells from the lower end of Domain/boxes along "
                  << "xyz"[d]
                  << "; choose h so that distances between parallel sides are multiples of it";
          throw InputError(message.str());
        }
    }

    Cuboid bounding_box(const std::vector<Cuboid> &boxes)
    {
      Cuboid all = boxes.front();
      for (const Cuboid &box : boxes)
        for (unsigned int d = 0; d < 3; ++d)
        {
          all.lower[d] = std::min(all.lower[d], box.lower[d]);
          all.upper[d] = std::max(all.upper[d], box.upper[d]);
        }
      return all;
    }

    std::array<int, 3> count_cells(const Cuboid &box, double h)
    {
      constexpr double most_cells = 1e9;
      double n_all = 1;
      for (unsigned int d = 0; d < 3; ++d)
        n_all *= std::round((box.upper[d] - box.lower[d]) / h);
      if (n_all > most_cells)
      {
        auto message = message_on(h);
        message << " makes more than " << most_cells << " cells; choose a larger h (Study/h)";
        throw InputError(message.str());
      }
      std::array<int, 3> n{};
      for (unsigned int d = 0; d < 3; ++d)
        n[d] = static_cast<int>(std::round((box.upper[d] - box.lower[d]) / h));
      return n;
    }
  } // namespace

  CubeLattice::CubeLattice(Solid solid, double h) : solid_(std::move(solid)), h_(h)
  {
    if (!(h > 0) || !std::isfinite(h))
      throw InputError("mesh size h = " + std::to_string(h) + " must be a positive length");
    if (solid_.include.empty())
      throw InputError("Domain/boxes is empty; give at least one box 'x0, y0, z0 : x1, y1, z1'");
    const Cuboid all = bounding_box(solid_.include);
    for (const auto &boxes : {solid_.include, solid_.exclude})
      for (const Cuboid &box : boxes)
      {
        check_sides(box, h);
        check_place(box, all.lower, h);
      }
    origin_ = all.lower;
    n_ = count_cells(all, h);
    size_ = static_cast<std::size_t>(n_[0]) * n_[1] * n_[2];
    if (solid_.include.size() == 1 && solid_.exclude.empty())
      return;
    is_inside_ = make_mask();
    size_ = std::count(is_inside_.begin(), is_inside_.end(), 1);
    if (size_ == 0)
      throw InputError("Domain: no cell is left; Domain/holes covers Domain/boxes");
    if (size_ == is_inside_.size())
      is_inside_.clear();
  }

  std::vector<char> CubeLattice::make_mask() const
  {
    constexpr char removed = 2;
    std::vector<char> cells(static_cast<std::size_t>(n_[0]) * n_[1] * n_[2], 0);
    const auto visit = [&](const Cuboid &box, const auto &action)
    {
      CubeRange range;
      for (unsigned int d = 0; d < 3; ++d)
        for (const bool is_upper : {false, true})
          (is_upper ? range.upper : range.lower)[d] = static_cast<int>(std::lround(std::clamp(
              ((is_upper ? box.upper : box.lower)[d] - origin_[d]) / h_, 0., n_[d] + 0.)));
      for_each_index(range.lower, range.upper,
                     [&](const std::array<int, 3> &cell) { action(cells[number(cell)]); });
    };
    for (const Cuboid &box : solid_.include)
      visit(box, [](char &cell) { cell = 1; });
    for (const Cuboid &box : solid_.exclude)
    {
      bool is_hole = false;
      visit(box,
            [&](char &cell)
            {
              is_hole = is_hole || cell != 0;
              cell = cell == 0 ? 0 : removed;
            });
      if (!is_hole)
      {
        std::ostringstream message;
        message
            << "the hole [" << box.lower << "; " << box.upper
            << "] (Domain/holes) is outside of Domain/boxes; move it into them, or leave it out";
        throw InputError(message.str());
      }
    }
    std::replace(cells.begin(), cells.end(), removed, char{0});
    return cells;
  }

  bool CubeLattice::fits(int n) const
  {
    const auto is_multiple = [&](const dealii::Point<3> &corner)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (std::lround((corner[d] - origin_[d]) / h_) % n != 0)
          return false;
      return true;
    };
    const auto fit = [&](const std::vector<Cuboid> &boxes)
    {
      return std::all_of(boxes.begin(), boxes.end(),
                         [&](const Cuboid &box)
                         { return is_multiple(box.lower) && is_multiple(box.upper); });
    };
    return fit(solid_.include) && fit(solid_.exclude);
  }

  std::vector<Cuboid> CubeLattice::boxes() const
  {
    if (is_box())
      return {cuboid()};
    std::vector<Cuboid> result;
    for (const CubeRange &box : maximal_boxes(is_inside_, n_))
      result.push_back(cuboid(box.lower, box.upper));
    return result;
  }

  std::size_t BoxNodes::n_free() const
  {
    return is_free.empty() ? n_positions()
                           : n_positions() - std::count(is_free.begin(), is_free.end(), 0);
  }

  std::optional<std::array<int, 3>> CubeLattice::cell_at(const dealii::Point<3> &x) const
  {
    constexpr double rounding = 1e-9;
    std::array<int, 3> lower{}, upper{};
    for (unsigned int d = 0; d < 3; ++d)
    {
      const double s = (x[d] - origin_[d]) / h_;
      if (!(s >= -1 && s <= n_[d] + 1.)) // also of points that are not finite
        return {};
      lower[d] = static_cast<int>(std::floor(s - rounding));
      upper[d] = static_cast<int>(std::floor(s + rounding)) + 1;
    }
    std::optional<std::array<int, 3>> found;
    for_each_index(lower, upper,
                   [&](const std::array<int, 3> &cell)
                   {
                     if (!found && is_inside(cell))
                       found = cell;
                   });
    return found;
  }

  BoxNodes cell_centres(const CubeLattice &lattice)
  {
    return {lattice.n_cells(), lattice.mask()};
  }

  BoxNodes inner_vertices(const CubeLattice &lattice)
  {
    BoxNodes nodes{lattice.n_cells()};
    for (int &n : nodes.n)
      --n;
    if (lattice.is_box())
      return nodes;
    const CellCounts cells(lattice.mask(), lattice.n_cells());
    for_each_index({0, 0, 0}, nodes.n,
                   [&](const std::array<int, 3> &at)
                   {
                     const CubeRange around = {at, {at[0] + 2, at[1] + 2, at[2] + 2}};
                     nodes.is_free.push_back(cells.is_filled(around) ? 1 : 0);
                   });
    return nodes;
  }
} // namespace plumbline::geometry
