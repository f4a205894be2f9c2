#include "reference/tetrahedra/assembly.h"

#include "geometry/search.h"
#include "reference/tetrahedra/face_pairs.h"

#include <deal.II/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using dealii::Point;

    struct Entry
    {
      unsigned int column = 0;
      double value = 0;
    };
    using Row = std::vector<Entry>; ///< columns ascending, each once

    /// row += factor × other.
    void add(Row &row, double factor, const Row &other)
    {
      Row sum;
      sum.reserve(row.size() + other.size());
      auto here = row.begin();
      for (const Entry &entry : other)
      {
        while (here != row.end() && here->column < entry.column)
          sum.push_back(*here++);
        sum.push_back({entry.column, factor * entry.value});
        if (here != row.end() && here->column == entry.column)
          sum.back().value += here++->value;
      }
      sum.insert(sum.end(), here, row.end());
      row = std::move(sum);
    }

    /// Sums over the faces G about a face.
    class FaceRows
    {
    public:
      FaceRows(const TetrahedralSpace &space, const physics::Kernel<3> &kernel,
               unsigned int refinement)
          : space_(space), faces_(make_faces(space)),
            potential_(kernel, space.is_continuous() ? FacePotential::Kind::biharmonic
                                                     : FacePotential::Kind::harmonic),
            pairs_(potential_, refinement), search_(scale_faces(kernel.horizon()))
      {
      }

      const std::vector<SpaceFace> &faces() const { return faces_; }
      double diffusion() const { return potential_.diffusion(); }

      /// What a thread needs for itself.
      struct Workspace
      {
        std::vector<unsigned int> near, columns;
        std::vector<double> sums; ///< of all unknowns, 0 between calls
      };

      /// Of unknowns j: Σ_G ∬_{F×G} Λ n_F·n_j(G), or -Σ_G J_j(G) ∬_{F×G} Ψ.
      Row operator()(std::size_t face, Workspace &work) const
      {
        const PairFace &f = scaled_[face];
        auto [lower, upper] = search_.box(static_cast<unsigned int>(face));
        for (unsigned int d = 0; d < 3; ++d)
        {
          lower[d] -= 1;
          upper[d] += 1;
        }
        search_.find({lower, upper}, work.near);
        work.sums.resize(space_.n_dofs());
        work.columns.clear();
        for (const unsigned int other : work.near)
        {
          const double integral = pairs_(f, scaled_[other]);
          if (integral == 0)
            continue;
          const SpaceFace &g = faces_[other];
          const double factor =
              space_.is_continuous() ? -integral : integral * (faces_[face].normal * g.normal);
          for (const auto &[dof, jump] : g.jumps)
          {
            if (work.sums[dof] == 0)
              work.columns.push_back(dof);
            work.sums[dof] += factor * jump;
          }
        }
        std::sort(work.columns.begin(), work.columns.end());
        Row row;
        for (const unsigned int dof : work.columns)
        {
          if (work.sums[dof] != 0) // else it is listed twice, or all cancels
            row.push_back({dof, work.sums[dof]});
          work.sums[dof] = 0;
        }
        return row;
      }

    private:
      /// Fills scaled_.
      std::vector<geometry::Cuboid> scale_faces(double horizon)
      {
        const auto &vertices = space_.mesh().vertices;
        std::vector<geometry::Cuboid> boxes;
        for (const SpaceFace &face : faces_)
        {
          PairFace::Vertices x;
          geometry::Cuboid box;
          for (unsigned int k = 0; k < 3; ++k)
          {
            x[k] = Point<3>((vertices[face.vertices[k]] - vertices.front()) / horizon);
            for (unsigned int d = 0; d < 3; ++d)
            {
              box.lower[d] = k == 0 ? x[k][d] : std::min(box.lower[d], x[k][d]);
              box.upper[d] = k == 0 ? x[k][d] : std::max(box.upper[d], x[k][d]);
            }
          }
          scaled_.emplace_back(x, face.vertices);
          boxes.push_back(box);
        }
        return boxes;
      }

      const TetrahedralSpace &space_;
      std::vector<SpaceFace> faces_;
      FacePotential potential_;
      FacePairs pairs_;
      std::vector<PairFace> scaled_; ///< the faces [horizons]
      geometry::BoxSearch<3> search_;
    };

    /// rows += factor × ∫∇φ_i·∇φ_j.
    void add_local(const TetrahedralSpace &space, double factor, std::vector<Row> &rows)
    {
      const TetrahedralMesh &mesh = space.mesh();
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      {
        const auto slopes = gradients(mesh, cell);
        const double volume = determinant(mesh, cell) / 6;
        for (unsigned int i = 0; i < 4; ++i)
        {
          if (space.dof(cell, i) >= rows.size())
            continue;
          Row local;
          for (unsigned int j = 0; j < 4; ++j)
            local.push_back({space.dof(cell, j), volume * (slopes[i] * slopes[j])});
          std::sort(local.begin(), local.end(),
                    [](const Entry &a, const Entry &b) { return a.column < b.column; });
          add(rows[space.dof(cell, i)], factor, local);
        }
      }
    }

    algebra::CsrMatrix to_matrix(const std::vector<Row> &rows, double factor)
    {
      algebra::CsrMatrix matrix;
      matrix.start.push_back(0);
      for (const Row &row : rows)
      {
        for (const auto &[column, value] : row)
        {
          matrix.column.push_back(column);
          matrix.value.push_back(factor * value);
        }
        matrix.start.push_back(matrix.column.size());
      }
      return matrix;
    }
  } // namespace

  algebra::CsrMatrix assemble_by_faces(const TetrahedralSpace &space,
                                       const physics::Kernel<3> &kernel, std::size_t n_rows,
                                       unsigned int refinement)
  {
    const FaceRows of_face(space, kernel, refinement);
    const double horizon = kernel.horizon();
    struct Share
    {
      std::size_t face = 0;
      double jump = 0;
    };
    std::vector<std::vector<Share>> shares(n_rows); // of the rows, faces ascending
    std::vector<std::size_t> needed;
    for (std::size_t face = 0; face < of_face.faces().size(); ++face)
    {
      bool is_needed = false;
      for (const auto &[dof, jump] : of_face.faces()[face].jumps)
        if (dof < n_rows)
        {
          shares[dof].push_back({needed.size(), jump});
          is_needed = true;
        }
      if (is_needed)
        needed.push_back(face);
    }

    std::vector<Row> rows(n_rows), of_faces;
    std::vector<std::size_t> n_done(n_rows); // of each row's shares
    constexpr std::size_t n_at_once = 2048;  // some 30 MB of rows of faces
    constexpr unsigned int grain = 16;
    for (std::size_t first = 0; first < needed.size(); first += n_at_once)
    {
      const std::size_t last = std::min(needed.size(), first + n_at_once);
      of_faces.assign(last - first, {});
      dealii::parallel::apply_to_subranges(
          first, last,
          [&](std::size_t begin, std::size_t end)
          {
            FaceRows::Workspace work;
            for (std::size_t k = begin; k < end; ++k)
              of_faces[k - first] = of_face(needed[k], work);
          },
          grain);
      dealii::parallel::apply_to_subranges(
          static_cast<std::size_t>(0), n_rows,
          [&](std::size_t begin, std::size_t end)
          {
            for (std::size_t i = begin; i < end; ++i)
              for (; n_done[i] < shares[i].size() && shares[i][n_done[i]].face < last; ++n_done[i])
                add(rows[i], shares[i][n_done[i]].jump,
                    of_faces[shares[i][n_done[i]].face - first]);
          },
          grain);
    }
    // lengths of ∬γ in horizons: 6; of derivatives of φ_i and φ_j: -1 each; of ∫∇φ·∇φ: 1
    double unit = kernel.constant() * std::pow(horizon, 6);
    if (space.is_continuous())
    {
      unit *= horizon * horizon;
      add_local(space, of_face.diffusion() / std::pow(horizon, 3), rows);
    }
    return to_matrix(rows, unit);
  }

  double difference(const algebra::CsrMatrix &a, const algebra::CsrMatrix &b)
  {
    double worst = 0, largest = 0;
    std::map<unsigned int, double> changes;
    for (std::size_t row = 0; row < std::min(a.n_rows(), b.n_rows()); ++row)
    {
      changes.clear();
      for (std::size_t k = a.start[row]; k < a.start[row + 1]; ++k)
      {
        changes[a.column[k]] = a.value[k];
        largest = std::max(largest, std::abs(a.value[k]));
      }
      for (std::size_t k = b.start[row]; k < b.start[row + 1]; ++k)
        changes[b.column[k]] -= b.value[k];
      for (const auto &[column, change] : changes)
        worst = std::max(worst, std::abs(change));
    }
    return worst / largest;
  }
} // namespace plumbline::reference
