#include "meshfree/scattered/field.h"

#include "meshfree/rules/families.h"
#include "meshfree/vtu.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace plumbline::meshfree
{
  ScatteredField::ScatteredField(std::shared_ptr<const geometry::NodeCells<2>> cells,
                                 std::vector<double> values, unsigned int n_components)
      : cells_(std::move(cells)), values_(std::move(values)), n_components_(n_components),
        search_(bounding_boxes(*cells_, cells_->n_free))
  {
  }

  double ScatteredField::value(const Point<2> &x, unsigned int component) const
  {
    // the cell that holds x is found at once, unless rounding puts x outside Ω
    std::vector<unsigned int> found;
    for (double reach = 1e-9 * std::sqrt(cells_->area[0]); found.empty(); reach *= 2)
      search_.find(box_around(x, reach), found);
    const unsigned int nearest = *std::min_element(
        found.begin(), found.end(),
        [&](unsigned int a, unsigned int b)
        { return x.distance_square(cells_->nodes[a]) < x.distance_square(cells_->nodes[b]); });
    return values_[nearest * n_components_ + component];
  }

  namespace
  {
    constexpr double fit_reach = 2; // of the nodes that a plane is fitted to, in sizes of the cell

    /// Of a cell.
    template <int dim>
    double size_of(const geometry::NodeCells<dim> &cells, std::size_t i)
    {
      return std::pow(cells.area[i], 1. / dim);
    }

    /// The rise of a component from node i to i + shift, by the plane through it fitted to nodes by
    /// least squares with weights 1 / r²; 0 where these nodes lie on a line, or in space in a
    /// plane.
    template <int dim>
    double rise(const geometry::NodeCells<dim> &cells, const std::vector<unsigned int> &near,
                std::size_t i, const std::function<double(std::size_t node)> &value,
                const dealii::Tensor<1, dim> &shift)
    {
      constexpr double flat = dim == 2 ? 1e-3 : 1e-4;
      dealii::SymmetricTensor<2, dim> moments;
      dealii::Tensor<1, dim> rises;
      for (const unsigned int j : near)
        if (j != i)
        {
          const dealii::Tensor<1, dim> xi = cells.nodes[j] - cells.nodes[i];
          const double weight = 1 / xi.norm_square();
          moments += weight * symmetrize(outer_product(xi, xi));
          rises += weight * (value(j) - value(i)) * xi;
        }
      if (!(determinant(moments) > flat * std::pow(trace(moments), dim)))
        return 0;
      return rises * (invert(moments) * shift);
    }
  } // namespace

  std::vector<double> cell_averages(const geometry::NodeCells<2> &cells,
                                    const std::vector<double> &values, unsigned int n_components)
  {
    constexpr double same = 1e-10; // of a cell's size: node and centroid are one
    const geometry::BoxSearch<2> search(bounding_boxes(cells, cells.n_free));
    std::vector<double> averages = values;
    std::vector<unsigned int> near;
    for (std::size_t i = 0; i < cells.n_free; ++i)
    {
      const double size = size_of(cells, i);
      const dealii::Tensor<1, 2> shift = cells.centroid[i] - cells.nodes[i];
      if (shift.norm() < same * size)
        continue;
      search.find(box_around(cells.nodes[i], fit_reach * size), near);
      for (unsigned int c = 0; c < n_components; ++c)
        averages[i * n_components + c] += rise<2>(
            cells, near, i, [&](std::size_t j) { return values[j * n_components + c]; }, shift);
    }
    return averages;
  }

  NodalFieldInSpace::NodalFieldInSpace(std::shared_ptr<const geometry::NodeCells<3>> cells,
                                       std::vector<double> values, unsigned int n_components)
      : cells_(std::move(cells)), values_(std::move(values)), n_components_(n_components),
        search_(bounding_boxes(*cells_, cells_->n_free))
  {
  }

  std::size_t NodalFieldInSpace::nearest(const Point<3> &x) const
  {
    std::vector<unsigned int> found;
    for (double reach = 1e-9 * size_of(*cells_, 0); found.empty(); reach *= 2)
      search_.find(box_around(x, reach), found);
    return *std::min_element(
        found.begin(), found.end(),
        [&](unsigned int a, unsigned int b)
        { return x.distance_square(cells_->nodes[a]) < x.distance_square(cells_->nodes[b]); });
  }

  double NodalFieldInSpace::value(const Point<3> &x, unsigned int component) const
  {
    return values_[nearest(x) * n_components_ + component];
  }

  std::vector<double> NodalFieldInSpace::averages(const geometry::CubeLattice &lattice) const
  {
    std::vector<double> result;
    std::vector<unsigned int> near;
    lattice.for_each_cell(
        [&](const std::array<int, 3> &cell)
        {
          Point<3> centre;
          for (unsigned int d = 0; d < 3; ++d)
            centre[d] = lattice.coordinate(d, cell[d] + .5);
          const std::size_t i = nearest(centre);
          search_.find(box_around(cells_->nodes[i], fit_reach * size_of(*cells_, i)), near);
          for (unsigned int c = 0; c < n_components_; ++c)
            result.push_back(values_[i * n_components_ + c] +
                             rise<3>(
                                 *cells_, near, i,
                                 [&](std::size_t j) { return values_[j * n_components_ + c]; },
                                 centre - cells_->nodes[i]));
        });
    return result;
  }

  void ScatteredField::write_vtu(const std::string &file) const
  {
    std::vector<dealii::DataOutBase::Patch<2, 2>> triangles;
    for (std::size_t i = 0; i < cells_->n_free; ++i)
      for (std::size_t p = cells_->first_piece[i]; p < cells_->first_piece[i + 1]; ++p)
      {
        const geometry::Polygon &piece = cells_->pieces[p];
        for (std::size_t v = 2; v < piece.size(); ++v)
        {
          dealii::DataOutBase::Patch<2, 2> triangle;
          triangle.reference_cell = dealii::ReferenceCells::Triangle;
          triangle.vertices[0] = piece[0];
          triangle.vertices[1] = piece[v - 1];
          triangle.vertices[2] = piece[v];
          triangle.patch_index = static_cast<unsigned int>(triangles.size());
          triangle.data.reinit(n_components_, 3);
          for (unsigned int c = 0; c < n_components_; ++c)
            for (unsigned int k = 0; k < 3; ++k)
              triangle.data(c, k) = static_cast<float>(values_[i * n_components_ + c]);
          triangles.push_back(triangle);
        }
      }
    meshfree::write_vtu(triangles, n_components_, file);
  }
} // namespace plumbline::meshfree
