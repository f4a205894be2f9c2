#pragma once

#include "geometry/mesh.h"

#include <array>

namespace plumbline::reference
{
  using geometry::Point;

  /// Lagrange shape functions of degree 0 to 4 on the unit triangle (0,0), (1,0), (0,1) or the unit
  /// square, in this order: vertices (counter-clockwise), inner points of the sides (side k runs
  /// from vertex k to vertex k + 1), inner points. Triangles have equidistant points, squares
  /// the Gauss-Lobatto points of deal.II's FE_Q.
  class CellShapes
  {
  public:
    static constexpr unsigned int most = 25; ///< shape functions on a cell, Q4

    CellShapes(unsigned int n_vertices, unsigned int degree);

    unsigned int n_vertices() const { return n_vertices_; }
    unsigned int degree() const { return degree_; }
    unsigned int size() const { return static_cast<unsigned int>(support_.size()); }
    const std::vector<Point<2>> &support() const { return support_; } ///< unit coordinates

    /// Of quadrilaterals: the points on an axis, and which two of them a shape function belongs to.
    const std::vector<double> &axis_nodes() const { return nodes_; }
    const std::array<unsigned int, 3> &axis_index(unsigned int a) const { return index_[a]; }

    /// All shape functions at a point of the unit cell (or beyond it). @param phi  shape (size())
    void values(const Point<2> &unit, double *phi) const;

    /// Their derivatives by the coordinates of the unit cell. @param gradient  shape (size())
    void gradients(const Point<2> &unit, dealii::Tensor<1, 2> *gradient) const;

  private:
    unsigned int n_vertices_, degree_;
    std::vector<double> nodes_;                      ///< on an axis, shape (degree + 1)
    std::vector<std::array<unsigned int, 3>> index_; ///< per function: barycentric or axis indices
    std::vector<Point<2>> support_;
  };

  /// From the unit cell to a straight-sided cell: affine for triangles and parallelograms, else
  /// bilinear.
  class CellMap
  {
  public:
    CellMap() = default;
    explicit CellMap(const geometry::Polygon &cell);

    bool is_affine() const { return bilinear_[0] == 0 && bilinear_[1] == 0; }
    Point<2> point(const Point<2> &unit) const;
    double determinant(const Point<2> &unit) const; ///< of the Jacobian [length^2]

    /// Inverse, to round-off for points in a convex cell.
    Point<2> unit(const Point<2> &x) const
    {
      const double dx = x[0] - origin_[0], dy = x[1] - origin_[1];
      const Point<2> affine(inverse_[0] * dx + inverse_[1] * dy,
                            inverse_[2] * dx + inverse_[3] * dy);
      return is_affine() ? affine : unit_by_newton(x, affine);
    }

    /// A gradient by x, from that by coordinates of the unit cell.
    dealii::Tensor<1, 2> gradient(const Point<2> &unit, const dealii::Tensor<1, 2> &of_unit) const;

    /// J^{-1} at the origin, row-major; of an affine map, everywhere.
    const std::array<double, 4> &inverse() const { return inverse_; }

  private:
    Point<2> unit_by_newton(const Point<2> &x, Point<2> unit) const;

    Point<2> origin_;
    std::array<double, 4> inverse_{};
    std::array<double, 2> first_{}, second_{},
        bilinear_{}; ///< x = origin + s first + t second + s t b
  };
} // namespace plumbline::reference
