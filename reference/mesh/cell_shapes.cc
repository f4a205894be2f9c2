#include "reference/mesh/cell_shapes.h"

#include "reference/shapes.h"

#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    using Index = std::array<unsigned int, 3>;

    /// Barycentric indices (of vertices 0, 1, 2) that add up to the degree.
    std::vector<Index> triangle_indices(unsigned int p)
    {
      if (p == 0)
        return {{0, 0, 0}};
      std::vector<Index> list = {{p, 0, 0}, {0, p, 0}, {0, 0, p}};
      for (unsigned int side = 0; side < 3; ++side)
        for (unsigned int k = 1; k < p; ++k)
        {
          Index index{0, 0, 0};
          index[side] = p - k;
          index[(side + 1) % 3] = k;
          list.push_back(index);
        }
      for (unsigned int j = 1; j + 1 < p; ++j)
        for (unsigned int i = 1; i + j < p; ++i)
          list.push_back({p - i - j, i, j});
      return list;
    }

    /// Axis indices (i, j).
    std::vector<Index> square_indices(unsigned int p)
    {
      if (p == 0)
        return {{0, 0, 0}};
      std::vector<Index> list = {{0, 0, 0}, {p, 0, 0}, {p, p, 0}, {0, p, 0}};
      for (unsigned int k = 1; k < p; ++k)
        list.push_back({k, 0, 0});
      for (unsigned int k = 1; k < p; ++k)
        list.push_back({p, k, 0});
      for (unsigned int k = 1; k < p; ++k)
        list.push_back({p - k, p, 0});
      for (unsigned int k = 1; k < p; ++k)
        list.push_back({0, p - k, 0});
      for (unsigned int j = 1; j < p; ++j)
        for (unsigned int i = 1; i < p; ++i)
          list.push_back({i, j, 0});
      return list;
    }

    double cross(const std::array<double, 2> &a, const std::array<double, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }
  } // namespace

  CellShapes::CellShapes(unsigned int n_vertices, unsigned int degree)
      : n_vertices_(n_vertices), degree_(degree),
        index_(n_vertices == 3 ? triangle_indices(degree) : square_indices(degree))
  {
    if (n_vertices == 4)
    {
      const AxisShapes axis(degree > 0, degree);
      for (unsigned int a = 0; a <= degree; ++a)
        nodes_.push_back(axis.support_point(a));
    }
    for (const Index &index : index_)
      if (n_vertices == 4)
        support_.push_back(Point<2>(nodes_[index[0]], nodes_[index[1]]));
      else if (degree == 0)
        support_.push_back(Point<2>(1. / 3, 1. / 3));
      else
        support_.push_back(Point<2>(static_cast<double>(index[1]) / degree,
                                    static_cast<double>(index[2]) / degree));
  }

  void CellShapes::values(const Point<2> &unit, double *phi) const
  {
    if (degree_ == 0)
    {
      phi[0] = 1;
      return;
    }
    constexpr unsigned int n = 5;
    if (n_vertices_ == 3)
    {
      const double lambda[3] = {1 - unit[0] - unit[1], unit[0], unit[1]};
      if (degree_ == 1)
      {
        std::copy(lambda, lambda + 3, phi);
        return;
      }
      // Π_{s<i} (p λ - s) / (s + 1): 1 at λ = i/p, 0 at smaller multiples
      double factor[3][n];
      for (unsigned int v = 0; v < 3; ++v)
      {
        factor[v][0] = 1;
        for (unsigned int i = 1; i <= degree_; ++i)
          factor[v][i] = factor[v][i - 1] * (degree_ * lambda[v] - (i - 1)) / i;
      }
      for (const Index &index : index_)
        *phi++ = factor[0][index[0]] * factor[1][index[1]] * factor[2][index[2]];
      return;
    }
    double axis[2][n];
    for (unsigned int d = 0; d < 2; ++d)
      for (unsigned int a = 0; a <= degree_; ++a)
      {
        axis[d][a] = 1;
        for (unsigned int b = 0; b <= degree_; ++b)
          if (b != a)
            axis[d][a] *= (unit[d] - nodes_[b]) / (nodes_[a] - nodes_[b]);
      }
    for (const Index &index : index_)
      *phi++ = axis[0][index[0]] * axis[1][index[1]];
  }

  void CellShapes::gradients(const Point<2> &unit, dealii::Tensor<1, 2> *gradient) const
  {
    constexpr unsigned int n = 5, n_axes = 3;
    const bool is_triangle = n_vertices_ == 3;
    // factors of the functions and their derivatives, by barycentric or by axis coordinates
    double factor[n_axes][n], slope[n_axes][n];
    const double at[n_axes] = {is_triangle ? 1 - unit[0] - unit[1] : unit[0],
                               is_triangle ? unit[0] : unit[1], is_triangle ? unit[1] : 0};
    for (unsigned int v = 0; v < n_axes; ++v)
      for (unsigned int i = 0; i <= degree_; ++i)
      {
        factor[v][i] = 1;
        slope[v][i] = 0;
        const unsigned int n_zeros = is_triangle ? i : v < 2 ? degree_ + 1 : 0;
        for (unsigned int s = 0; s < n_zeros; ++s)
        {
          if (!is_triangle && s == i)
            continue;
          const double zero = is_triangle ? static_cast<double>(s) / degree_ : nodes_[s],
                       node = is_triangle ? static_cast<double>(i) / degree_ : nodes_[i];
          slope[v][i] = (slope[v][i] * (at[v] - zero) + factor[v][i]) / (node - zero);
          factor[v][i] *= (at[v] - zero) / (node - zero);
        }
      }
    for (const Index &index : index_)
    {
      double by[n_axes];
      for (unsigned int v = 0; v < n_axes; ++v)
      {
        const unsigned int a = (v + 1) % n_axes, b = (v + 2) % n_axes;
        by[v] = slope[v][index[v]] * factor[a][index[a]] * factor[b][index[b]];
      }
      (*gradient)[0] = is_triangle ? by[1] - by[0] : by[0];
      (*gradient)[1] = is_triangle ? by[2] - by[0] : by[1];
      ++gradient;
    }
  }

  CellMap::CellMap(const geometry::Polygon &cell) : origin_(cell[0])
  {
    for (unsigned int d = 0; d < 2; ++d)
    {
      first_[d] = cell[1][d] - cell[0][d];
      second_[d] = cell.back()[d] - cell[0][d];
      if (cell.size() == 4)
        bilinear_[d] = (cell[2][d] - cell[3][d]) - first_[d];
    }
    // round-off of coordinates does not make a parallelogram bilinear
    const double size = std::sqrt(std::abs(cross(first_, second_)));
    double largest = 0;
    for (const Point<2> &vertex : cell)
      largest = std::max(largest, std::abs(vertex[0]) + std::abs(vertex[1]));
    if (std::hypot(bilinear_[0], bilinear_[1]) <= 1e-14 * (size + largest))
      bilinear_ = {0, 0};
    const double det = cross(first_, second_);
    inverse_ = {second_[1] / det, -second_[0] / det, -first_[1] / det, first_[0] / det};
  }

  Point<2> CellMap::point(const Point<2> &unit) const
  {
    const double s = unit[0], t = unit[1];
    Point<2> x = origin_;
    for (unsigned int d = 0; d < 2; ++d)
      x[d] += s * first_[d] + t * second_[d] + s * t * bilinear_[d];
    return x;
  }

  double CellMap::determinant(const Point<2> &unit) const
  {
    return cross(first_, second_) + unit[0] * cross(first_, bilinear_) +
           unit[1] * cross(bilinear_, second_);
  }

  dealii::Tensor<1, 2> CellMap::gradient(const Point<2> &unit,
                                         const dealii::Tensor<1, 2> &of_unit) const
  {
    std::array<double, 2> ds{}, dt{};
    for (unsigned int d = 0; d < 2; ++d)
    {
      ds[d] = first_[d] + unit[1] * bilinear_[d];
      dt[d] = second_[d] + unit[0] * bilinear_[d];
    }
    dealii::Tensor<1, 2> result;
    const double det = cross(ds, dt);
    result[0] = (dt[1] * of_unit[0] - ds[1] * of_unit[1]) / det;
    result[1] = (ds[0] * of_unit[1] - dt[0] * of_unit[0]) / det;
    return result;
  }

  Point<2> CellMap::unit_by_newton(const Point<2> &x, Point<2> unit) const
  {
    const std::array<double, 2> r = {x[0] - origin_[0], x[1] - origin_[1]};
    // Newton's method: convex cells have a positive determinant throughout
    for (unsigned int step = 0; step < 20; ++step)
    {
      const double s = unit[0], t = unit[1];
      std::array<double, 2> residual{}, ds{}, dt{};
      for (unsigned int d = 0; d < 2; ++d)
      {
        residual[d] = r[d] - (s * first_[d] + t * second_[d] + s * t * bilinear_[d]);
        ds[d] = first_[d] + t * bilinear_[d];
        dt[d] = second_[d] + s * bilinear_[d];
      }
      const double slope = cross(ds, dt);
      const Point<2> change(cross(residual, dt) / slope, cross(ds, residual) / slope);
      unit += change;
      if (std::abs(change[0]) + std::abs(change[1]) < 1e-15)
        break;
    }
    return unit;
  }
} // namespace plumbline::reference
