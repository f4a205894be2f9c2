#include "geometry/cell_sides.h"

#include <algorithm>
#include <cmath>

namespace plumbline::geometry
{
  namespace
  {
    constexpr double tolerance = 1e-6; // of a cell's size

    /// Where a side begins and ends along a line, and the points there.
    class Extent
    {
    public:
      explicit Extent(const dealii::Tensor<1, 2> &along) : along_(along) {}

      void take(const Point<2> &x)
      {
        const double at = along_ * (x - Point<2>());
        if (is_empty_ || at < at_[0])
          set(0, x, at);
        if (is_empty_ || at > at_[1])
          set(1, x, at);
        is_empty_ = false;
      }
      bool is_longer_than(double length) const { return !is_empty_ && at_[1] - at_[0] > length; }
      const std::array<Point<2>, 2> &ends() const { return ends_; }

    private:
      void set(std::size_t end, const Point<2> &x, double at)
      {
        ends_[end] = x;
        at_[end] = at;
      }

      dealii::Tensor<1, 2> along_;
      std::array<Point<2>, 2> ends_;
      std::array<double, 2> at_{};
      bool is_empty_ = true;
    };
  } // namespace

  std::vector<CellSide> shared_sides(const NodeCells<2> &cells)
  {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < cells.size(); ++i)
      boxes.push_back(cells.bounding_box(i));
    const BoxSearch<2> search(boxes);
    std::vector<CellSide> sides;
    std::vector<unsigned int> near;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      const double small = tolerance * std::sqrt(cells.area[i]);
      dealii::Tensor<1, 2> margin;
      margin[0] = margin[1] = small;
      search.find({boxes[i].lower - margin, boxes[i].upper + margin}, near);
      for (const unsigned int j : near)
      {
        if (j <= i)
          continue;
        const dealii::Tensor<1, 2> xi = cells.nodes[j] - cells.nodes[i];
        const double distance = xi.norm();
        const Point<2> middle = cells.nodes[i] + .5 * xi;
        const auto is_on_bisector = [&](const Point<2> &x)
        { return std::abs(xi * (x - middle)) < small * distance; };
        Extent side(dealii::Tensor<1, 2>({-xi[1] / distance, xi[0] / distance}));
        for (std::size_t p = cells.first_piece[i]; p < cells.first_piece[i + 1]; ++p)
        {
          const Polygon &piece = cells.pieces[p];
          for (std::size_t k = 0; k < piece.size(); ++k)
            if (const Point<2> &a = piece[k], &b = piece[(k + 1) % piece.size()];
                is_on_bisector(a) && is_on_bisector(b))
            {
              side.take(a);
              side.take(b);
            }
        }
        if (side.is_longer_than(small))
          sides.push_back({{static_cast<unsigned int>(i), j}, side.ends()});
      }
    }
    return sides;
  }
} // namespace plumbline::geometry
