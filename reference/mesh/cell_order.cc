#include "reference/mesh/cell_order.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

namespace plumbline::reference
{
  namespace
  {
    using geometry::Point;

    class GrowingBox
    {
    public:
      void add(const Point<2> &x)
      {
        for (unsigned int d = 0; d < 2; ++d)
        {
          lower_[d] = std::min(lower_[d], x[d]);
          upper_[d] = std::max(upper_[d], x[d]);
        }
      }

      const Point<2> &lower() const { return lower_; }
      double side(unsigned int d) const { return std::max(0., upper_[d] - lower_[d]); }
      double area() const { return side(0) * side(1); }

    private:
      static constexpr double far = std::numeric_limits<double>::max();
      Point<2> lower_{far, far}, upper_{-far, -far};
    };

    Point<2> middle(const geometry::Mesh &mesh, std::size_t cell)
    {
      const geometry::MeshCell &one = mesh.cells[cell];
      Point<2> sum;
      for (unsigned int v = 0; v < one.n_vertices; ++v)
        sum += mesh.vertices[one.vertex[v]] / one.n_vertices;
      return sum;
    }

    /// Whether runs of the cells of Ω, as they are, lie together.
    bool is_in_places(const geometry::Mesh &mesh, const std::vector<Point<2>> &middles,
                      unsigned int n_ranks)
    {
      constexpr double most = 1.5; // of the whole area
      std::vector<std::size_t> inside;
      GrowingBox all;
      for (std::size_t cell = 0; cell < middles.size(); ++cell)
        if (mesh.cells[cell].is_inside)
        {
          inside.push_back(cell);
          all.add(middles[cell]);
        }
      double area = 0;
      for (unsigned int rank = 0; rank < n_ranks; ++rank)
      {
        GrowingBox run;
        for (std::size_t i = inside.size() * rank / n_ranks;
             i < inside.size() * (rank + 1) / n_ranks; ++i)
          run.add(middles[inside[i]]);
        area += run.area();
      }
      return area <= most * all.area();
    }

    /// The place along the curve: bits of both coordinates in turn, the highest first.
    std::uint64_t place_on_curve(const Point<2> &x, const Point<2> &lower, double side)
    {
      constexpr unsigned int n_bits = 20;
      std::uint64_t place = 0;
      std::array<std::uint64_t, 2> number{};
      for (unsigned int d = 0; d < 2; ++d)
        number[d] = static_cast<std::uint64_t>((x[d] - lower[d]) / side * ((1 << n_bits) - 1));
      for (unsigned int bit = n_bits; bit-- > 0;)
        for (unsigned int d = 2; d-- > 0;)
          place = place << 1 | (number[d] >> bit & 1);
      return place;
    }
  } // namespace

  std::vector<unsigned int> order_for_ranks(const geometry::Mesh &mesh, unsigned int n_ranks)
  {
    std::vector<Point<2>> middles;
    GrowingBox box;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    {
      middles.push_back(middle(mesh, cell));
      box.add(middles.back());
    }
    const double side = std::max(box.side(0), box.side(1));
    if (n_ranks == 1 || side == 0 || is_in_places(mesh, middles, n_ranks))
      return {};
    std::vector<std::uint64_t> place;
    for (const Point<2> &x : middles)
      place.push_back(place_on_curve(x, box.lower(), side));
    std::vector<unsigned int> order(mesh.cells.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](unsigned int a, unsigned int b) { return place[a] < place[b]; });
    return order;
  }
} // namespace plumbline::reference
