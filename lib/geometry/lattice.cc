#include "geometry/lattice.h"

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
    /// A length counts as a whole number of cells if it is one to this fraction of a cell.
    constexpr double whole = 1e-6;

    /// A lattice of this side has 1e8 cells: vectors of gigabytes, and days beyond it.
    constexpr double most_cells = 10000;

    int whole_cells(double length, double h, const Box &box)
    {
      const double cells = length / h;
      if (std::abs(cells - std::round(cells)) > whole)
      {
        constexpr int n_digits = 10; // 12.000005 cells are not 12
        std::ostringstream message;
        message
            << std::setprecision(n_digits) << "mesh size h = " << h << " does not divide the box ["
            << box.lower << "; " << box.upper << "] of Domain into whole cells (" << cells
            << " cells); choose h so that every side is a multiple of it, as a fraction such as "
            << "1/12 if it has no short decimal";
        throw InputError(message.str());
      }
      if (cells > most_cells)
      {
        std::ostringstream message;
        message << "mesh size h = " << h << " makes " << cells << " cells along a side, more than "
                << most_cells << "; choose a larger h (Study/h)";
        throw InputError(message.str());
      }
      return static_cast<int>(std::round(cells));
    }
  } // namespace

  Lattice::Lattice(const Domain &domain, double h) : h_(h)
  {
    if (!(h > 0) || !std::isfinite(h))
      throw InputError("mesh size h = " + std::to_string(h) + " must be a positive length");
    if (domain.include.empty())
      throw InputError("Domain/boxes is empty; give at least one box 'x0, y0 : x1, y1'");

    Point<2> upper = domain.include[0].upper;
    origin_ = domain.include[0].lower;
    for (const Box &box : domain.include)
      for (unsigned int d = 0; d < 2; ++d)
      {
        origin_[d] = std::min(origin_[d], box.lower[d]);
        upper[d] = std::max(upper[d], box.upper[d]);
      }
    for (unsigned int d = 0; d < 2; ++d)
      n_[d] = whole_cells(upper[d] - origin_[d], h, {origin_, upper});
    inside_.assign(static_cast<std::size_t>(n_[0]) * n_[1], 0);

    const auto fill = [&](const Box &box, char value)
    {
      std::array<int, 2> from{}, to{};
      for (unsigned int d = 0; d < 2; ++d)
      {
        from[d] = std::max(0, whole_cells(box.lower[d] - origin_[d], h, box));
        to[d] = std::min(n_[d], whole_cells(box.upper[d] - origin_[d], h, box));
      }
      for (int j = from[1]; j < to[1]; ++j)
        for (int i = from[0]; i < to[0]; ++i)
          inside_[static_cast<std::size_t>(j) * n_[0] + i] = value;
    };
    for (const Box &box : domain.include)
      fill(box, 1);
    for (const Box &box : domain.exclude)
      fill(box, 0);
    if (std::none_of(inside_.begin(), inside_.end(), [](char c) { return c != 0; }))
      throw InputError("Domain: no cell is left; Domain/holes covers Domain/boxes");
  }

  Lattice Lattice::refined(int n) const
  {
    Lattice fine = *this;
    fine.h_ /= n;
    fine.n_ = {n * n_[0], n * n_[1]};
    fine.inside_.resize(static_cast<std::size_t>(fine.n_[0]) * fine.n_[1]);
    for (int j = 0; j < fine.n_[1]; ++j)
      for (int i = 0; i < fine.n_[0]; ++i)
        fine.inside_[static_cast<std::size_t>(j) * fine.n_[0] + i] =
            static_cast<char>(is_inside(i / n, j / n));
    return fine;
  }

  bool Lattice::is_inside(int i, int j) const
  {
    return i >= 0 && j >= 0 && i < n_[0] && j < n_[1] &&
           inside_[static_cast<std::size_t>(j) * n_[0] + i] != 0;
  }

  bool Lattice::is_rectangle() const
  {
    return std::all_of(inside_.begin(), inside_.end(), [](char c) { return c != 0; });
  }

  Point<2> Lattice::point(double s, double t) const
  {
    return Point<2>(origin_[0] + h_ * s, origin_[1] + h_ * t);
  }

  std::size_t NodeSet::n_unknowns() const
  {
    return n_components * static_cast<std::size_t>(std::count_if(is_free.begin(), is_free.end(),
                                                                 [](char c) { return c != 0; }));
  }

  bool NodeSet::free(unsigned int family, int i, int j) const
  {
    return i >= 0 && j >= 0 && i < n[0] && j < n[1] &&
           is_free[(static_cast<std::size_t>(family) * n[1] + j) * n[0] + i] != 0;
  }

  Point<2> NodeSet::place(unsigned int family, int i, int j) const
  {
    return Point<2>(i + axis[family % axis.size()].offset, j + axis[family / axis.size()].offset);
  }

  NodeSet free_nodes(const Lattice &lattice, std::vector<AxisSpecies> axis,
                     unsigned int n_components)
  {
    NodeSet nodes;
    nodes.axis = std::move(axis);
    nodes.n_components = n_components;
    nodes.n = lattice.n_cells();
    nodes.is_free.resize(nodes.n_families() * nodes.n_positions());
    std::size_t index = 0;
    for (unsigned int s = 0; s < nodes.n_families(); ++s)
    {
      const int left = nodes.axis[s % nodes.axis.size()].at_vertex ? 1 : 0;
      const int below = nodes.axis[s / nodes.axis.size()].at_vertex ? 1 : 0;
      for (int j = 0; j < nodes.n[1]; ++j)
        for (int i = 0; i < nodes.n[0]; ++i)
        {
          bool is_free = true;
          for (int dj = -below; dj <= 0; ++dj)
            for (int di = -left; di <= 0; ++di)
              is_free = is_free && lattice.is_inside(i + di, j + dj);
          nodes.is_free[index++] = is_free;
        }
    }
    if (nodes.n_unknowns() == 0)
    {
      std::ostringstream message;
      message << "mesh size h = " << lattice.h()
              << " leaves no free node in the domain; refine (Study/h)";
      throw InputError(message.str());
    }
    return nodes;
  }

  std::vector<CellRange> maximal_rectangles(const Lattice &lattice)
  {
    const auto &n = lattice.n_cells();
    std::vector<char> is_inside;
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        is_inside.push_back(lattice.is_inside(i, j) ? 1 : 0);
    std::vector<CellRange> result;
    for (const CubeRange &box : maximal_boxes(is_inside, {n[0], n[1], 1}))
      result.push_back({{box.lower[0], box.lower[1]}, {box.upper[0], box.upper[1]}});
    return result;
  }
} // namespace plumbline::geometry
