#include "reference/tetrahedra/bond_deficit.h"

#include "geometry/tetrahedral_domain.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    constexpr unsigned int n_corners = 4;
    using Corners = std::array<Point<3>, n_corners>;

    std::vector<geometry::Cuboid> boxes_of(const std::vector<Interface> &interfaces)
    {
      std::vector<geometry::Cuboid> boxes;
      for (const Interface &one : interfaces)
        boxes.push_back(one.face.box());
      return boxes;
    }

    double determinant_of(const Corners &x)
    {
      return (x[1] - x[0]) * cross_product_3d(x[2] - x[0], x[3] - x[0]);
    }

    /// The rule on the eight parts of the unit tetrahedron: four at its corners, and the octahedron
    /// between them along a diagonal.
    dealii::Quadrature<3> on_eighths(const dealii::Quadrature<3> &whole)
    {
      TetrahedralMesh mesh;
      mesh.vertices = {Point<3>(), Point<3>(1, 0, 0), Point<3>(0, 1, 0), Point<3>(0, 0, 1)};
      mesh.cells = {{0, 1, 2, 3}};
      mesh.is_inside = {1};
      mesh = geometry::refine(mesh);
      std::vector<Point<3>> points;
      std::vector<double> weights;
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        for (unsigned int q = 0; q < whole.size(); ++q)
        {
          const auto &s = whole.point(q);
          const auto &v = mesh.cells[cell];
          const Point<3> &first = mesh.vertices[v[0]];
          points.push_back(first + s[0] * (mesh.vertices[v[1]] - first) +
                           s[1] * (mesh.vertices[v[2]] - first) +
                           s[2] * (mesh.vertices[v[3]] - first));
          weights.push_back(whole.weight(q) * geometry::determinant(mesh, cell));
        }
      return {points, weights};
    }

    /// The largest entry of a difference, but for what a linear function makes of it.
    template <class Value>
    double change_of(const CornerMatrix<Value> &before, const CornerMatrix<Value> &after,
                     double volume)
    {
      CornerMatrix<Value> difference{};
      std::array<Value, n_corners> sums{};
      for (unsigned int a = 0; a < n_corners; ++a)
        for (unsigned int b = 0; b < n_corners; ++b)
        {
          difference[a][b] = after[a][b] - before[a][b];
          sums[a] += difference[a][b];
        }
      subtract_linear_part(volume, sums, difference);
      double change = 0;
      for (const auto &of_corner : difference)
        for (const Value &value : of_corner)
          for (unsigned int c = 0; c < n_components_of<Value>; ++c)
            for (unsigned int d = 0; d < n_components_of<Value>; ++d)
              change = std::max(change, std::abs(component(value, c, d)));
      return change;
    }
  } // namespace

  template <class Value>
  void subtract_linear_part(double volume, const std::array<Value, 4> &sums,
                            CornerMatrix<Value> &matrix)
  {
    // ∫ λ_a λ_b = V (1 + δ_ab) / 20, ∫ λ_a λ_b λ_c = V / 120 times the factorials of powers
    constexpr double of_two = 20, of_three = 120, fifth = .2;
    Value total{};
    for (const Value &sum : sums)
      total += sum;
    for (unsigned int a = 0; a < n_corners; ++a)
      for (unsigned int b = 0; b < n_corners; ++b)
        for (unsigned int c = 0; c < n_corners; ++c)
        {
          const Value at_corner = (of_two / volume) * (sums[c] - fifth * total);
          const int n_equal = (a == b ? 1 : 0) + (b == c ? 1 : 0) + (a == c ? 1 : 0);
          const double factorials = n_equal == 3 ? 6 : n_equal == 1 ? 2 : 1;
          matrix[a][b] -= (volume / of_three * factorials) * at_corner;
        }
  }

  template <class Value>
  BondDeficit<Value>::BondDeficit(std::vector<Interface> interfaces, const SolidKernel &kernel,
                                  const BondFactors &factors)
      : interfaces_(std::move(interfaces)), search_(boxes_of(interfaces_)), factors_(factors)
  {
    for (const PotentialKernel &part : kernel.parts)
      fluxes_.emplace_back(part);
  }

  template <class Value>
  typename BondDeficit<Value>::Integrals BondDeficit<Value>::integrals(std::size_t mesh_cell,
                                                                       const Corners &corners,
                                                                       double tolerance) const
  {
    static const std::vector<dealii::Quadrature<3>> rules = []
    {
      const dealii::QWitherdenVincentSimplex<3> coarse(3), fine(5);
      return std::vector<dealii::Quadrature<3>>{coarse, fine, on_eighths(fine),
                                                on_eighths(on_eighths(fine))};
    }();
    Integrals result;
    const std::vector<Layer> layers = layers_about(mesh_cell, corners);
    if (layers.empty())
      return result;
    result.values = integrals(layers, corners, rules[0]);
    for (std::size_t level = 1; level < rules.size(); ++level)
    {
      const CornerMatrix<Value> finer = integrals(layers, corners, rules[level]);
      result.open = change_of(result.values, finer, determinant_of(corners) / 6);
      result.values = finer;
      if (result.open <= tolerance)
      {
        result.open = 0;
        break;
      }
    }
    return result;
  }

  template <class Value>
  std::vector<typename BondDeficit<Value>::Layer>
  BondDeficit<Value>::layers_about(std::size_t mesh_cell, const Corners &corners) const
  {
    geometry::Cuboid box{corners[0], corners[0]};
    for (const Point<3> &corner : corners)
      for (unsigned int d = 0; d < 3; ++d)
      {
        box.lower[d] = std::min(box.lower[d], corner[d] - 1);
        box.upper[d] = std::max(box.upper[d], corner[d] + 1);
      }
    std::vector<unsigned int> near;
    search_.find(box, near);
    std::vector<Layer> layers;
    for (const unsigned int k : near)
    {
      const Interface &one = interfaces_[k];
      const auto factor = [&](const std::optional<std::size_t> &cell)
      { return cell ? factors_.between(mesh_cell, *cell) : 0; };
      layers.push_back(
          {FaceSides(one.face), (factor(one.cells[0]) - factor(one.cells[1])) * one.normal});
    }
    return layers;
  }

  template <class Value>
  CornerMatrix<Value> BondDeficit<Value>::integrals(const std::vector<Layer> &layers,
                                                    const Corners &corners,
                                                    const dealii::Quadrature<3> &rule) const
  {
    const double determinant = determinant_of(corners);
    CornerMatrix<Value> result{};
    for (unsigned int q = 0; q < rule.size(); ++q)
    {
      const Point<3> &s = rule.point(q);
      const std::array<double, n_corners> lambda = {1 - s[0] - s[1] - s[2], s[0], s[1], s[2]};
      Point<3> x;
      for (unsigned int a = 0; a < n_corners; ++a)
        x += lambda[a] * corners[a];
      const Value deficit = at(x, layers);
      for (unsigned int a = 0; a < n_corners; ++a)
        for (unsigned int b = 0; b < n_corners; ++b)
          result[a][b] += (determinant * rule.weight(q) * lambda[a] * lambda[b]) * deficit;
    }
    return result;
  }

  template <class Value>
  Value BondDeficit<Value>::at(const Point<3> &x, const std::vector<Layer> &layers) const
  {
    Value sum{};
    for (const Layer &layer : layers)
      for (std::size_t part = 0; part < fluxes_.size(); ++part)
      {
        std::array<double, 2> is_part{};
        is_part[part] = 1;
        add_product(sum, is_part, fluxes_[part](x, layer.face), layer.weight);
      }
    symmetrise(sum);
    return sum;
  }

  template void subtract_linear_part(double, const std::array<double, 4> &, CornerMatrix<double> &);
  template void subtract_linear_part(double, const std::array<SolidValue, 4> &,
                                     CornerMatrix<SolidValue> &);
  template class BondDeficit<double>;
  template class BondDeficit<SolidValue>;
} // namespace plumbline::reference
