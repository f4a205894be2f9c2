#include "reference/tetrahedra/hexahedra.h"

#include "geometry/hexahedron.h"
#include "geometry/search.h"
#include "reference/tetrahedra/face_potential.h"

#include <deal.II/base/parallel.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::reference
{
  namespace
  {
    using dealii::Point;
    using geometry::Hexahedron;

    constexpr unsigned int n_corners = 8;
    using Corners = std::array<Point<3>, n_corners>;
    using Block = std::array<std::array<double, n_corners>, n_corners>;

    /// A Gauss rule on a hexahedron, with what functions do in its points. [horizons]
    struct Points
    {
      Points(const Corners &corners, unsigned int n)
      {
        const Hexahedron hexahedron(corners);
        const dealii::QGauss<3> rule(n);
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          x.push_back(hexahedron.at(rule.point(q)));
          weight.push_back(rule.weight(q) * determinant(hexahedron.jacobian(rule.point(q))));
          slopes.push_back(hexahedron.slopes(rule.point(q)));
        }
      }

      std::vector<Point<3>> x;
      std::vector<double> weight;
      std::vector<Hexahedron::Slopes> slopes;
    };

    /// Σ weights slopes·slopes of two corners.
    Block products(const Points &points, const std::vector<double> &weights)
    {
      Block sum{};
      for (std::size_t q = 0; q < points.x.size(); ++q)
        for (unsigned int a = 0; a < n_corners; ++a)
          for (unsigned int b = 0; b <= a; ++b)
            sum[a][b] += weights[q] * (points.slopes[q][a] * points.slopes[q][b]);
      for (unsigned int a = 0; a < n_corners; ++a)
        for (unsigned int b = 0; b < a; ++b)
          sum[b][a] = sum[a][b];
      return sum;
    }

    /// ∬Λ (g(x) - g(y))·(g'(x) - g'(y)) over x in one hexahedron and y in another, g and g' being
    /// gradients of functions of either.
    struct PairBlocks
    {
      unsigned int other = 0; ///< the second hexahedron
      Block first{}, second{}, mixed{};
    };

    class Hexahedra
    {
    public:
      Hexahedra(const TetrahedralSpace &space, const physics::Kernel<3> &kernel, std::size_t n_rows,
                const HexahedralRule &rule)
          : rule_(rule), potential_(kernel, FacePotential::Kind::harmonic),
            ends_(potential_.ends()), corners_(scaled(space.mesh(), kernel.horizon())),
            search_(boxes_around(corners_))
      {
        for (std::size_t cell = 0; cell < size(); ++cell)
        {
          is_needed_.push_back(0);
          for (unsigned int k = 0; k < n_corners; ++k)
            if (space.corner_dof(cell, k) < n_rows)
              is_needed_.back() = 1;
        }
      }

      std::size_t size() const { return corners_.size(); }
      double diffusion() const { return potential_.diffusion(); }

      /// ∫∇φ_a·∇φ_b over a hexahedron. [horizons]
      Block local(std::size_t cell) const
      {
        const Points points(corners_[cell], rule_.n_cut);
        return products(points, points.weight);
      }

      /// The hexahedra of the same number or a larger one within the horizon, if one of both has
      /// rows that are asked for.
      std::vector<unsigned int> partners(std::size_t cell) const
      {
        geometry::Cuboid box = box_around(corners_[cell]);
        for (unsigned int d = 0; d < 3; ++d)
        {
          box.lower[d] -= 1;
          box.upper[d] += 1;
        }
        std::vector<unsigned int> found, result;
        search_.find(box, found);
        for (const unsigned int other : found)
          if (other >= cell && (is_needed_[cell] != 0 || is_needed_[other] != 0) &&
              gap(cell, other) < 1)
            result.push_back(other);
        std::sort(result.begin(), result.end());
        return result;
      }

      PairBlocks blocks(const std::array<Points, 2> &points, std::size_t cell,
                        unsigned int other) const
      {
        // points of n and n + 1 interlace: near a common face none come close to each other
        const bool is_smooth = is_smooth_pair(cell, other);
        return blocks(points[is_smooth ? 0 : 1],
                      Points(corners_[other], is_smooth ? rule_.n_smooth : rule_.n_cut + 1), other);
      }

      /// For blocks() as those of the first hexahedron: of smooth pairs and of others.
      std::array<Points, 2> points(std::size_t cell) const
      {
        return {Points(corners_[cell], rule_.n_smooth), Points(corners_[cell], rule_.n_cut)};
      }

    private:
      static std::vector<Corners> scaled(const TetrahedralMesh &mesh, double horizon)
      {
        std::vector<Corners> all;
        for (const auto &cell : mesh.hexahedra)
        {
          all.emplace_back();
          for (unsigned int k = 0; k < n_corners; ++k)
            all.back()[k] = Point<3>((mesh.vertices[cell[k]] - mesh.vertices.front()) / horizon);
        }
        return all;
      }

      static std::vector<geometry::Cuboid> boxes_around(const std::vector<Corners> &all)
      {
        std::vector<geometry::Cuboid> boxes;
        for (const Corners &corners : all)
          boxes.push_back(box_around(corners));
        return boxes;
      }

      static geometry::Cuboid box_around(const Corners &corners)
      {
        geometry::Cuboid box{corners[0], corners[0]};
        for (const Point<3> &x : corners)
          for (unsigned int d = 0; d < 3; ++d)
          {
            box.lower[d] = std::min(box.lower[d], x[d]);
            box.upper[d] = std::max(box.upper[d], x[d]);
          }
        return box;
      }

      static Point<3> middle(const Corners &corners)
      {
        return Hexahedron(corners).at(Point<3>(.5, .5, .5));
      }

      /// A distance that two hexahedra have at least, or less than 0. [horizons]
      double gap(std::size_t a, std::size_t b) const
      {
        dealii::Tensor<1, 3> along = middle(corners_[b]) - middle(corners_[a]);
        if (a == b)
          return -1;
        along /= along.norm();
        double from = -std::numeric_limits<double>::infinity(), to = -from;
        for (unsigned int k = 0; k < n_corners; ++k)
        {
          from = std::max(from, along * corners_[a][k]);
          to = std::min(to, along * corners_[b][k]);
        }
        return to - from;
      }

      /// Whether Λ is smooth for all distances of their points.
      bool is_smooth_pair(std::size_t a, std::size_t b) const
      {
        constexpr double apart = .3; // of a hexahedron: those that touch are nearer
        const double least = gap(a, b);
        double most = 0, size = 0;
        for (const Point<3> &x : corners_[a])
          for (const Point<3> &y : corners_[b])
            most = std::max(most, x.distance(y));
        for (const Point<3> &x : corners_[a])
          size = std::max(size, x.distance(corners_[a][0]));
        return least > apart * size &&
               std::none_of(ends_.begin(), ends_.end(),
                            [&](double end) { return least < end && end < most; });
      }

      PairBlocks blocks(const Points &p, const Points &q, unsigned int other) const
      {
        constexpr std::size_t most = FacePotential::most_points;
        const std::size_t n = q.x.size();
        std::vector<double> of_p(p.x.size()), of_q(n);
        PairBlocks result;
        result.other = other;
        std::array<double, most> squares, values; // filled up to the points at a time
        for (std::size_t i = 0; i < p.x.size(); ++i)
        {
          Hexahedron::Slopes sum{};
          for (std::size_t begin = 0; begin < n; begin += most)
          {
            const std::size_t end = std::min(begin + most, n);
            for (std::size_t j = begin; j < end; ++j)
              squares[j - begin] = p.x[i].distance_square(q.x[j]);
            potential_.values(squares.data(), values.data(),
                              static_cast<unsigned int>(end - begin));
            for (std::size_t j = begin; j < end; ++j)
            {
              const double weight = p.weight[i] * q.weight[j] * values[j - begin];
              of_p[i] += weight;
              of_q[j] += weight;
              for (unsigned int b = 0; b < n_corners; ++b)
                sum[b] += weight * q.slopes[j][b];
            }
          }
          for (unsigned int a = 0; a < n_corners; ++a)
            for (unsigned int b = 0; b < n_corners; ++b)
              result.mixed[a][b] -= p.slopes[i][a] * sum[b];
        }
        result.first = products(p, of_p);
        result.second = products(q, of_q);
        return result;
      }

      HexahedralRule rule_;
      FacePotential potential_;
      std::vector<double> ends_;
      std::vector<Corners> corners_; ///< [horizons]
      std::vector<char> is_needed_;
      geometry::BoxSearch<3> search_;
    };

    /// A symmetric matrix of which the entries on and above the diagonal are summed up.
    class UpperRows
    {
    public:
      /// @param partners  of each hexahedron, those of the same number or a larger one
      UpperRows(const TetrahedralSpace &space,
                const std::vector<std::vector<unsigned int>> &partners, std::size_t n_rows)
          : space_(space), rows_(n_rows)
      {
        std::vector<std::vector<unsigned int>> around(partners.size()), cells(n_rows);
        for (unsigned int cell = 0; cell < partners.size(); ++cell)
        {
          for (const unsigned int other : partners[cell])
          {
            around[cell].push_back(other);
            around[other].push_back(cell);
          }
          for (unsigned int corner = 0; corner < n_corners; ++corner)
            if (const unsigned int i = space.corner_dof(cell, corner); i < n_rows)
              cells[i].push_back(cell);
        }
        std::vector<unsigned int> columns;
        for (unsigned int i = 0; i < n_rows; ++i)
        {
          columns.clear();
          for (const unsigned int cell : cells[i])
            for (const unsigned int other : around[cell])
              for (unsigned int corner = 0; corner < n_corners; ++corner)
                columns.push_back(space.corner_dof(other, corner));
          std::sort(columns.begin(), columns.end());
          columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
          for (auto j = std::lower_bound(columns.begin(), columns.end(), i); j != columns.end();
               ++j)
            rows_[i].push_back({*j, 0});
        }
      }

      void add(std::size_t cell, std::size_t other, double factor, const Block &block)
      {
        for (unsigned int a = 0; a < n_corners; ++a)
          for (unsigned int b = 0; b < n_corners; ++b)
          {
            const unsigned int i = space_.corner_dof(cell, a), j = space_.corner_dof(other, b);
            if (i <= j && i < rows_.size())
              std::lower_bound(rows_[i].begin(), rows_[i].end(), Entry{j, 0}, before)->value +=
                  factor * block[a][b];
          }
      }

      algebra::CsrMatrix matrix(double factor) const
      {
        std::vector<std::vector<Entry>> all(rows_.size());
        for (unsigned int i = 0; i < rows_.size(); ++i)
          for (const Entry &entry : rows_[i])
            if (entry.column < rows_.size() && entry.column != i)
              all[entry.column].push_back({i, entry.value});
        algebra::CsrMatrix matrix;
        matrix.start.push_back(0);
        for (unsigned int i = 0; i < rows_.size(); ++i)
        {
          all[i].insert(all[i].end(), rows_[i].begin(), rows_[i].end());
          for (const Entry &entry : all[i])
          {
            matrix.column.push_back(entry.column);
            matrix.value.push_back(factor * entry.value);
          }
          matrix.start.push_back(matrix.column.size());
        }
        return matrix;
      }

    private:
      struct Entry
      {
        unsigned int column = 0;
        double value = 0;
      };
      static bool before(const Entry &a, const Entry &b) { return a.column < b.column; }

      const TetrahedralSpace &space_;
      std::vector<std::vector<Entry>> rows_;
    };

    Block transposed(const Block &block)
    {
      Block result{};
      for (unsigned int a = 0; a < n_corners; ++a)
        for (unsigned int b = 0; b < n_corners; ++b)
          result[b][a] = block[a][b];
      return result;
    }
  } // namespace

  algebra::CsrMatrix assemble_on_hexahedra(const TetrahedralSpace &space,
                                           const physics::Kernel<3> &kernel, std::size_t n_rows,
                                           const HexahedralRule &rule)
  {
    const Hexahedra cells(space, kernel, n_rows, rule);
    std::vector<std::vector<unsigned int>> partners;
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
      partners.push_back(cells.partners(cell));
    UpperRows rows(space, partners, n_rows);
    constexpr std::size_t n_at_once = 64; // some 10 MB of blocks
    for (std::size_t first = 0; first < cells.size(); first += n_at_once)
    {
      const std::size_t last = std::min(first + n_at_once, cells.size());
      std::vector<std::vector<PairBlocks>> found(last - first);
      dealii::parallel::apply_to_subranges(
          first, last,
          [&](std::size_t begin, std::size_t end)
          {
            for (std::size_t cell = begin; cell < end; ++cell)
            {
              if (partners[cell].empty())
                continue;
              const auto points = cells.points(cell);
              for (const unsigned int other : partners[cell])
                found[cell - first].push_back(cells.blocks(points, cell, other));
            }
          },
          1);
      for (std::size_t cell = first; cell < last; ++cell)
        for (const PairBlocks &pair : found[cell - first])
        {
          const double factor = pair.other == cell ? -.5 : -1;
          rows.add(cell, cell, factor, pair.first);
          rows.add(pair.other, pair.other, factor, pair.second);
          rows.add(cell, pair.other, factor, pair.mixed);
          rows.add(pair.other, cell, factor, transposed(pair.mixed));
        }
    }
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
      if (!partners[cell].empty() && partners[cell].front() == cell)
        rows.add(cell, cell, cells.diffusion(), cells.local(cell));
    return rows.matrix(kernel.constant() * std::pow(kernel.horizon(), 6)); // of ∬γ
  }
} // namespace plumbline::reference
