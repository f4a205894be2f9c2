#include "meshfree/scattered/field.h"

#include "meshfree/rules/families.h"
#include "meshfree/vtu.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::meshfree
{
  using geometry::Point;

  ScatteredField::ScatteredField(std::shared_ptr<const geometry::NodeCells> cells,
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

  std::vector<double> cell_averages(const geometry::NodeCells &cells,
                                    const std::vector<double> &values, unsigned int n_components)
  {
    constexpr double same = 1e-10; // of a cell's size: node and centroid are one
    constexpr double reach = 2;    // of the nodes that a plane is fitted to, in sizes of the cell
    const geometry::BoxSearch search(bounding_boxes(cells, cells.n_free));
    std::vector<double> averages = values;
    std::vector<unsigned int> near;
    for (std::size_t i = 0; i < cells.n_free; ++i)
    {
      const double size = std::sqrt(cells.area[i]);
      const dealii::Tensor<1, 2> shift = cells.centroid[i] - cells.nodes[i];
      if (shift.norm() < same * size)
        continue;
      search.find(box_around(cells.nodes[i], reach * size), near);
      for (unsigned int c = 0; c < n_components; ++c)
      {
        double xx = 0, xy = 0, yy = 0, x = 0, y = 0; // least squares with weights 1 / r²
        for (const unsigned int j : near)
          if (j != i)
          {
            const dealii::Tensor<1, 2> xi = cells.nodes[j] - cells.nodes[i];
            const double weight = 1 / xi.norm_square();
            const double rise = values[j * n_components + c] - values[i * n_components + c];
            xx += weight * xi[0] * xi[0];
            xy += weight * xi[0] * xi[1];
            yy += weight * xi[1] * xi[1];
            x += weight * xi[0] * rise;
            y += weight * xi[1] * rise;
          }
        const double determinant = xx * yy - xy * xy;
        if (determinant > 1e-3 * (xx + yy) * (xx + yy)) // the nodes do not lie on a line
          averages[i * n_components + c] +=
              ((yy * x - xy * y) * shift[0] + (xx * y - xy * x) * shift[1]) / determinant;
      }
    }
    return averages;
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
