#include "reference/lattice/field.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::reference
{
  LatticeField::LatticeField(geometry::Lattice lattice, AxisShapes shapes,
                             unsigned int n_components, std::vector<double> values)
      : lattice_(std::move(lattice)), shapes_(std::move(shapes)), n_components_(n_components),
        values_(std::move(values))
  {
  }

  double LatticeField::local(unsigned int component, int i, int j, unsigned int a1,
                             unsigned int a2) const
  {
    const auto n_axis = shapes_.families().size();
    const auto x = shapes_.owner(a1), y = shapes_.owner(a2);
    const std::size_t block = component * n_axis * n_axis + x.family + y.family * n_axis;
    const std::size_t width = lattice_.n_cells()[0] + 2, height = lattice_.n_cells()[1] + 2;
    return values_[(block * height + j + y.shift + 1) * width + i + x.shift + 1];
  }

  LatticeField::Place LatticeField::place(const geometry::Point<2> &x) const
  {
    constexpr double rounding = 1e-9;
    std::array<double, 2> s{};
    std::array<std::array<int, 3>, 2> cells{}; // that hold x along an axis
    for (unsigned int d = 0; d < 2; ++d)
    {
      s[d] = (x[d] - lattice_.origin()[d]) / lattice_.h();
      const std::array<double, 3> beside = {0, -rounding, rounding};
      for (unsigned int k = 0; k < 3; ++k)
        cells[d][k] = std::clamp(static_cast<int>(std::floor(s[d] + beside[k])), 0,
                                 lattice_.n_cells()[d] - 1);
    }
    std::array<int, 2> cell = {cells[0].front(), cells[1].front()};
    bool is_found = lattice_.is_inside(cell[0], cell[1]);
    for (const int j : cells[1]) // on a side of Ω the cell in it
      for (const int i : cells[0])
        if (!is_found && lattice_.is_inside(i, j))
        {
          cell = {i, j};
          is_found = true;
        }
    return {cell, {s[0] - cell[0], s[1] - cell[1]}};
  }

  double LatticeField::value(const geometry::Point<2> &x, unsigned int component) const
  {
    const auto [cell, inner] = place(x);
    double sum = 0;
    for (unsigned int a2 = 0; a2 < shapes_.n_local(); ++a2)
    {
      double row = 0;
      for (unsigned int a1 = 0; a1 < shapes_.n_local(); ++a1)
        row += shapes_.value(a1, inner[0]) * local(component, cell[0], cell[1], a1, a2);
      sum += row * shapes_.value(a2, inner[1]);
    }
    return sum;
  }

  dealii::Tensor<1, 2> LatticeField::gradient(const geometry::Point<2> &x,
                                              unsigned int component) const
  {
    const auto [cell, inner] = place(x);
    dealii::Tensor<1, 2> sum;
    for (unsigned int a2 = 0; a2 < shapes_.n_local(); ++a2)
      for (unsigned int a1 = 0; a1 < shapes_.n_local(); ++a1)
      {
        const double u = local(component, cell[0], cell[1], a1, a2) / lattice_.h();
        sum[0] += u * shapes_.derivative(a1, inner[0]) * shapes_.value(a2, inner[1]);
        sum[1] += u * shapes_.value(a1, inner[0]) * shapes_.derivative(a2, inner[1]);
      }
    return sum;
  }

  std::vector<double> LatticeField::averages(const geometry::NodeSet &cells) const
  {
    // averages of the local shape functions over the part of a cell's axis that a square covers
    struct Part
    {
      int cell;
      std::vector<double> weights;
    };
    const auto part = [&](int cell, double from, double to)
    {
      const dealii::QGauss<1> gauss(shapes_.degree() / 2 + 1);
      Part result{cell, std::vector<double>(shapes_.n_local())};
      for (unsigned int q = 0; q < gauss.size(); ++q)
        for (unsigned int a = 0; a < shapes_.n_local(); ++a)
          result.weights[a] += (to - from) * gauss.weight(q) *
                               shapes_.value(a, from + (to - from) * gauss.point(q)[0]);
      return result;
    };
    const std::vector<Part> parts = cells.axis[0].at_vertex
                                        ? std::vector<Part>{part(-1, .5, 1), part(0, 0, .5)}
                                        : std::vector<Part>{part(0, 0, 1)};

    std::vector<double> result;
    result.reserve(cells.n_unknowns());
    for (int j = 0; j < cells.n[1]; ++j)
      for (int i = 0; i < cells.n[0]; ++i)
        for (unsigned int c = 0; c < n_components_; ++c)
        {
          if (cells.is_free[static_cast<std::size_t>(j) * cells.n[0] + i] == 0)
            continue;
          double sum = 0;
          for (const Part &x : parts)
            for (const Part &y : parts)
              for (unsigned int a2 = 0; a2 < shapes_.n_local(); ++a2)
                for (unsigned int a1 = 0; a1 < shapes_.n_local(); ++a1)
                  sum += x.weights[a1] * y.weights[a2] * local(c, i + x.cell, j + y.cell, a1, a2);
          result.push_back(sum);
        }
    return result;
  }
} // namespace plumbline::reference
