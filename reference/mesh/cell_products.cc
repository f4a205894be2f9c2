#include "reference/mesh/cell_products.h"

#include "geometry/polygon.h"

#include <algorithm>
#include <cmath>

namespace plumbline::reference
{
  void CellProducts::clear()
  {
    points.clear();
    values.clear();
  }

  void CellProducts::add(const Point<2> &point, double weight, const double *phi, unsigned int n)
  {
    points.push_back(point);
    values.push_back(weight);
    for (unsigned int a = 0; a < n; ++a)
      values.push_back(weight * phi[a]);
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = a; b < n; ++b)
        values.push_back(weight * phi[a] * phi[b]);
  }

  UnitProducts::UnitProducts(const CellShapes &shapes, unsigned int degree)
  {
    const geometry::Polygon unit = CellShapes(shapes.n_vertices(), 1).support();
    const geometry::CutRule rule = geometry::polygon_rule(geometry::view(unit), degree);
    std::vector<double> phi(shapes.size());
    for (std::size_t q = 0; q < rule.points.size(); ++q)
    {
      shapes.values(rule.points[q], phi.data());
      unit_.add(rule.points[q], rule.weights[q], phi.data(), shapes.size());
    }
  }

  void UnitProducts::map(const CellMap &map, CellProducts &products) const
  {
    products = unit_;
    for (Point<2> &x : products.points)
      x = map.point(x);
    for (double &value : products.values)
      value *= map.determinant({});
  }

  namespace
  {
    /// Half the trace, ½(C_xx - C_yy) and C_xy, or the one entry.
    std::array<double, 3> entries(const physics::Kernel<2> &kernel, const dealii::Tensor<1, 2> &z)
    {
      const double square = z.norm_square(), value = kernel.radial(std::sqrt(square));
      if (kernel.structure() == physics::Structure::scalar)
        return {value, 0, 0};
      const double per_square = square > 0 ? 1 / square : 0;
      return {.5 * value, .5 * value * (z[0] * z[0] - z[1] * z[1]) * per_square,
              value * z[0] * z[1] * per_square};
    }
  } // namespace

  void add_products(const CellProducts &outer, const CellProducts &inner, unsigned int n,
                    const physics::Kernel<2> &kernel, PairBlocks &blocks)
  {
    const unsigned int n_entries = kernel.structure() == physics::Structure::scalar ? 1 : 3;
    const std::size_t n_functions = 1 + n + n * (n + 1) / 2;
    std::vector<double> sums(n_entries * n_functions); // over y, of each function
    for (std::size_t i = 0; i < outer.points.size(); ++i)
    {
      std::fill(sums.begin(), sums.end(), 0.);
      for (std::size_t j = 0; j < inner.points.size(); ++j)
      {
        const auto entry = entries(kernel, inner.points[j] - outer.points[i]);
        for (unsigned int e = 0; e < n_entries; ++e)
          for (std::size_t f = 0; f < n_functions; ++f)
            sums[e * n_functions + f] += entry[e] * inner.values[j * n_functions + f];
      }
      const double *const of_x = &outer.values[i * n_functions];
      for (unsigned int e = 0; e < n_entries; ++e)
      {
        const double *const sum = &sums[e * n_functions];
        const auto place = [&](unsigned int a, unsigned int b)
        { return (static_cast<std::size_t>(a) * n + b) * n_entries + e; };
        std::size_t product = 1 + n;
        for (unsigned int a = 0; a < n; ++a)
        {
          for (unsigned int b = 0; b < n; ++b)
            blocks.cross[place(a, b)] += of_x[1 + a] * sum[1 + b];
          for (unsigned int b = a; b < n; ++b, ++product)
          {
            blocks.outer[place(a, b)] += of_x[product] * sum[0];
            blocks.inner[place(a, b)] += of_x[0] * sum[product];
          }
        }
      }
    }
  }
} // namespace plumbline::reference
