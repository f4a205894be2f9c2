#include "reference/mesh/product_rule.h"

#include "geometry/polygon.h"

#include <algorithm>
#include <cmath>

namespace plumbline::reference
{
  ProductRule::ProductRule(const CellShapes &shapes, unsigned int degree)
      : n_(shapes.size()), n_functions_(1 + n_ + n_ * (n_ + 1) / 2)
  {
    const geometry::Polygon triangle = {Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1)};
    const geometry::CutRule rule = geometry::polygon_rule(geometry::view(triangle), degree);
    unit_ = rule.points;
    std::vector<double> phi(n_);
    for (std::size_t q = 0; q < unit_.size(); ++q)
    {
      const double weight = rule.weights[q];
      shapes.values(unit_[q], phi.data());
      value_.push_back(weight);
      for (const double value : phi)
        value_.push_back(weight * value);
      for (unsigned int a = 0; a < n_; ++a)
        for (unsigned int b = a; b < n_; ++b)
          value_.push_back(weight * phi[a] * phi[b]);
    }
  }

  void ProductRule::add(const CellMap &outer, const CellMap &inner,
                        const physics::Kernel<2> &kernel, PairBlocks &blocks) const
  {
    const unsigned int n_entries = kernel.structure() == physics::Structure::scalar ? 1 : 3;
    const double factor = outer.determinant({}) * inner.determinant({});
    std::vector<Point<2>> points;
    for (const Point<2> &unit : unit_)
      points.push_back(inner.point(unit));
    std::vector<double> sums(n_entries * n_functions_); // over y, of each function
    for (std::size_t i = 0; i < unit_.size(); ++i)
    {
      const Point<2> x = outer.point(unit_[i]);
      std::fill(sums.begin(), sums.end(), 0.);
      for (std::size_t j = 0; j < points.size(); ++j)
      {
        const dealii::Tensor<1, 2> z = points[j] - x;
        const double square = z.norm_square(), value = factor * kernel.radial(std::sqrt(square));
        std::array<double, 3> entry = {value, 0, 0};
        if (n_entries == 3)
        {
          const double per_square = square > 0 ? 1 / square : 0;
          entry = {.5 * value, .5 * value * (z[0] * z[0] - z[1] * z[1]) * per_square,
                   value * z[0] * z[1] * per_square};
        }
        for (unsigned int e = 0; e < n_entries; ++e)
          for (std::size_t f = 0; f < n_functions_; ++f)
            sums[e * n_functions_ + f] += entry[e] * value_[j * n_functions_ + f];
      }
      const double *const of_x = &value_[i * n_functions_];
      for (unsigned int e = 0; e < n_entries; ++e)
      {
        const double *const sum = &sums[e * n_functions_];
        const auto place = [&](unsigned int a, unsigned int b)
        { return (static_cast<std::size_t>(a) * n_ + b) * n_entries + e; };
        std::size_t product = 1 + n_;
        for (unsigned int a = 0; a < n_; ++a)
        {
          for (unsigned int b = 0; b < n_; ++b)
            blocks.cross[place(a, b)] += of_x[1 + a] * sum[1 + b];
          for (unsigned int b = a; b < n_; ++b, ++product)
          {
            blocks.outer[place(a, b)] += of_x[product] * sum[0];
            blocks.inner[place(a, b)] += of_x[0] * sum[product];
          }
        }
      }
    }
  }
} // namespace plumbline::reference
