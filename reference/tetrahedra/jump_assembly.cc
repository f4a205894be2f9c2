#include "reference/tetrahedra/jump_assembly.h"

#include "geometry/search.h"
#include "geometry/tetrahedral_check.h"
#include "reference/tetrahedra/exact_pairs.h"
#include "reference/tetrahedra/jump_pairs.h"
#include "reference/tetrahedra/lattice_faces.h"

#include <deal.II/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    constexpr unsigned int n_corners = 4;
    using Matrix = std::array<std::array<double, n_corners>, n_corners>;

    /// Entries of the unknowns of two cells.
    struct Block
    {
      unsigned int cell = 0; ///< the column's
      Matrix value{};
    };
    using BlockRow = std::vector<Block>; ///< cells ascending, each once

    void add(Matrix &to, const Matrix &value)
    {
      for (unsigned int a = 0; a < n_corners; ++a)
        for (unsigned int b = 0; b < n_corners; ++b)
          to[a][b] += value[a][b];
    }

    /// row += other.
    void add(BlockRow &row, const BlockRow &other)
    {
      BlockRow sum;
      sum.reserve(row.size() + other.size());
      auto here = row.begin();
      for (const Block &block : other)
      {
        while (here != row.end() && here->cell < block.cell)
          sum.push_back(*here++);
        sum.push_back(block);
        if (here != row.end() && here->cell == block.cell)
          add(sum.back().value, here++->value);
      }
      sum.insert(sum.end(), here, row.end());
      row = std::move(sum);
    }

    /// A cell of a face.
    struct JumpSide
    {
      unsigned int cell = 0;              ///< its number among the space's
      double sign = 0;                    ///< 1 where the normal points to, -1 on the other side
      std::array<int, n_corners> place{}; ///< of corners among the face's vertices, or -1
      std::array<Tensor<1, 3>, n_corners> slopes{}; ///< ∇λ [1 / horizon]
    };

    struct JumpFace
    {
      PairFace face; ///< [horizons]
      Tensor<1, 3> normal;
      boost::container::static_vector<JumpSide, 2> sides;
      double steepest = 0; ///< the largest |∇λ|
    };

    std::vector<JumpFace> make_jump_faces(const TetrahedralSpace &space, double horizon)
    {
      const TetrahedralMesh &mesh = space.mesh();
      const std::vector<geometry::TetrahedralSide> sides = geometry::sides_of(mesh);
      std::vector<JumpFace> faces;
      for (std::size_t k = 0; k < sides.size(); ++k)
      {
        const geometry::TetrahedralSide &side = sides[k];
        if (k == 0 || side.key != sides[k - 1].key)
        {
          PairFace::Vertices x;
          for (unsigned int v = 0; v < 3; ++v)
            x[v] = Point<3>((mesh.vertices[side.key[v]] - mesh.vertices.front()) / horizon);
          const Tensor<1, 3> area = cross_product_3d(x[1] - x[0], x[2] - x[0]);
          faces.push_back({PairFace(x, side.key), area / area.norm(), {}, 0});
        }
        JumpFace &face = faces.back();
        JumpSide own;
        own.cell = space.dof(side.cell, 0) / n_corners;
        own.slopes = gradients(mesh, side.cell);
        own.sign = own.slopes[side.opposite] * face.normal > 0 ? 1 : -1;
        for (unsigned int corner = 0; corner < n_corners; ++corner)
        {
          own.slopes[corner] *= horizon;
          face.steepest = std::max(face.steepest, own.slopes[corner].norm());
          const auto found =
              std::find(side.key.begin(), side.key.end(), mesh.cells[side.cell][corner]);
          own.place[corner] =
              found == side.key.end() ? -1 : static_cast<int>(found - side.key.begin());
        }
        face.sides.push_back(own);
      }
      return faces;
    }

    std::vector<geometry::Cuboid> boxes_of(const std::vector<JumpFace> &faces)
    {
      std::vector<geometry::Cuboid> boxes;
      for (const JumpFace &face : faces)
        boxes.push_back(face.face.box());
      return boxes;
    }

    /// All integrals of a pair of faces.
    struct PairIntegrals
    {
      ExactPairs::Integral slopes; ///< ∬Ψ
      JumpIntegrals jumps;
    };

    /// What the pair adds to entries of a cell of F and one of G.
    Matrix block_of(const JumpFace &f, const JumpSide &of_f, const JumpFace &g,
                    const JumpSide &of_g, const PairIntegrals &pair, double factor)
    {
      const double cosine = f.normal * g.normal;
      Matrix block{};
      for (unsigned int a = 0; a < n_corners; ++a)
        for (unsigned int b = 0; b < n_corners; ++b)
        {
          const int at = of_f.place[a], other = of_g.place[b];
          double sum = -cosine * (of_f.slopes[a] * of_g.slopes[b]) * pair.slopes.value;
          if (other >= 0)
            sum += (of_f.slopes[a] * g.normal) * pair.jumps.second[static_cast<std::size_t>(other)];
          if (at >= 0)
            sum += (of_g.slopes[b] * f.normal) * pair.jumps.first[static_cast<std::size_t>(at)];
          if (at >= 0 && other >= 0)
            sum += cosine *
                   pair.jumps.values[static_cast<std::size_t>(at)][static_cast<std::size_t>(other)];
          block[a][b] = factor * of_f.sign * of_g.sign * sum;
        }
      return block;
    }

    /// Sums over the faces G about a face F, each pair once: the matrix is the sum and its
    /// transpose.
    class JumpRows
    {
    public:
      JumpRows(const TetrahedralSpace &space, const physics::Kernel<3> &kernel, std::size_t n_rows,
               const FaceRule &rule)
          : n_needed_(n_rows / n_corners), faces_(make_jump_faces(space, kernel.horizon())),
            n_cells_(space.mesh().cells.size()), spacing_(rule.spacing / kernel.horizon()),
            potential_(kernel, FacePotential::Kind::biharmonic), search_(boxes_of(faces_))
      {
        double volume = 0;
        for (std::size_t cell = 0; cell < n_cells_; ++cell)
          volume += determinant(space.mesh(), cell) / 6 / std::pow(kernel.horizon(), 3);
        const double m0 = 4 * M_PI * kernel.profile().moment(2);
        const double of_cell = volume / static_cast<double>(n_cells_);
        constexpr double of_slopes = 2. / 3; // ∇λ are like 1 / length
        jumps_.emplace(kernel, rule.of_jumps * m0 * of_cell);
        if (rule.is_exact)
          exact_.emplace(kernel, FacePotential::Kind::biharmonic,
                         rule.tolerance * m0 * of_cell * std::pow(of_cell, of_slopes));
        else
          by_rule_.emplace(potential_, rule.refinement);
        for (const JumpFace &face : faces_)
          is_needed_.push_back(std::any_of(face.sides.begin(), face.sides.end(),
                                           [this](const JumpSide &side)
                                           { return side.cell < n_needed_; })
                                   ? 1
                                   : 0);
      }

      const std::vector<JumpFace> &faces() const { return faces_; }
      std::size_t n_cells() const { return n_cells_; }
      double diffusion() const { return potential_.diffusion(); }

      /// What a thread needs for itself.
      struct Workspace
      {
        std::vector<unsigned int> near, place; ///< place: of cells among columns + 1, else 0
        FaceRuleUse use;
        double open = 0; ///< of one face: see FaceRuleUse
      };

      /// For each cell of a face, what it adds to the cell's rows.
      std::array<BlockRow, 2> rows_of(std::size_t face, Workspace &work) const
      {
        const JumpFace &f = faces_[face];
        std::array<BlockRow, 2> rows;
        work.place.resize(n_cells_);
        geometry::Cuboid box = search_.box(static_cast<unsigned int>(face));
        for (unsigned int d = 0; d < 3; ++d)
        {
          box.lower[d] -= 1;
          box.upper[d] += 1;
        }
        search_.find(box, work.near);
        work.open = 0;
        for (const unsigned int other : work.near)
        {
          const JumpFace &g = faces_[other];
          if (other < face || (is_needed_[face] == 0 && is_needed_[other] == 0) ||
              are_out_of_reach(f.face, g.face))
            continue;
          const PairIntegrals pair = integrate(f, g, work);
          for (const JumpSide &of_g : g.sides)
          {
            if (work.place[of_g.cell] == 0)
            {
              for (BlockRow &row : rows)
                row.push_back({of_g.cell, {}});
              work.place[of_g.cell] = static_cast<unsigned int>(rows[0].size());
            }
            for (std::size_t side = 0; side < f.sides.size(); ++side)
              add(rows[side][work.place[of_g.cell] - 1].value,
                  block_of(f, f.sides[side], g, of_g, pair, other == face ? .5 : 1));
          }
        }
        work.use.open = std::max(work.use.open, work.open);
        for (const Block &block : rows[0])
          work.place[block.cell] = 0;
        for (std::size_t side = 0; side < f.sides.size(); ++side)
          arrange(rows[side], f.sides[side].cell < n_needed_);
        return rows;
      }

    private:
      /// @param is_needed  else columns that are
      void arrange(BlockRow &row, bool is_needed) const
      {
        if (!is_needed)
          row.erase(std::remove_if(row.begin(), row.end(),
                                   [this](const Block &block) { return block.cell >= n_needed_; }),
                    row.end());
        std::sort(row.begin(), row.end(),
                  [](const Block &a, const Block &b) { return a.cell < b.cell; });
      }

      PairIntegrals integrate(const JumpFace &f, const JumpFace &g, Workspace &work) const
      {
        PairIntegrals pair;
        if (const auto places = spacing_ > 0 ? places_on_lattice(f.face, g.face, spacing_)
                                             : std::optional<FacePlaces>())
          pair = known(*places, work);
        else
        {
          pair = make(f.face, g.face);
          count(pair, work);
        }
        // see block_of(): λ_a of one face by slopes of the other's cells
        if (pair.jumps.open > 0)
          work.open +=
              pair.jumps.open * (1 + f.face.radius() * g.steepest + g.face.radius() * f.steepest);
        work.use.error = std::max(work.use.error, pair.slopes.error * f.steepest * g.steepest);
        return pair;
      }

      static void count(const PairIntegrals &pair, Workspace &work)
      {
        ++work.use.n_pairs[pair.slopes.level];
        if (pair.jumps.open > 0)
          ++work.use.n_open;
      }

      PairIntegrals make(const PairFace &f, const PairFace &g) const
      {
        PairIntegrals pair;
        if (exact_)
          pair.slopes = (*exact_)(f, g);
        else
          pair.slopes.value = (*by_rule_)(f, g);
        pair.jumps = (*jumps_)(f, g);
        return pair;
      }

      /// By the places alone, so that all threads have the same.
      PairIntegrals known(const FacePlaces &places, Workspace &work) const
      {
        {
          const std::lock_guard<std::mutex> lock(mutex_);
          if (const auto found = known_.find(places); found != known_.end())
            return found->second;
        }
        const auto [f, g] = faces_at(places, spacing_);
        const PairIntegrals pair = make(f, g);
        const std::lock_guard<std::mutex> lock(mutex_);
        if (known_.try_emplace(places, pair).second)
          count(pair, work);
        return pair;
      }

      std::size_t n_needed_; ///< cells whose rows are asked for
      std::vector<JumpFace> faces_;
      std::size_t n_cells_;
      double spacing_; ///< [horizons]
      FacePotential potential_;
      std::optional<JumpPairs> jumps_;
      std::optional<FacePairs> by_rule_;
      std::optional<ExactPairs> exact_;
      mutable std::map<FacePlaces, PairIntegrals> known_;
      mutable std::mutex mutex_;    ///< of what is known
      std::vector<char> is_needed_; ///< faces of cells that are
      geometry::BoxSearch<3> search_;
    };

    /// rows += ½κ ∫ g_i·g_j + κ Σ_F ∫_F n·{g_i} [φ_j], of which the matrix has the transpose, too.
    void add_local(const TetrahedralSpace &space, double horizon, const JumpRows &of_face,
                   std::vector<BlockRow> &rows, std::size_t n_needed)
    {
      constexpr double half = .5, third = 1. / 3;
      for (const JumpFace &face : of_face.faces())
        for (const JumpSide &own : face.sides)
          for (const JumpSide &other : face.sides)
          {
            if (own.cell >= n_needed && other.cell >= n_needed)
              continue;
            Block block{other.cell, {}};
            for (unsigned int a = 0; a < n_corners; ++a)
              for (unsigned int b = 0; b < n_corners; ++b)
                if (other.place[b] >= 0)
                  block.value[a][b] = of_face.diffusion() * half * (own.slopes[a] * face.normal) *
                                      other.sign * face.face.area() * third;
            add(rows[own.cell], BlockRow{block});
          }
      const TetrahedralMesh &mesh = space.mesh();
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      {
        const unsigned int number = space.dof(cell, 0) / n_corners;
        if (number >= n_needed)
          continue;
        const auto slopes = gradients(mesh, cell);
        Block block{number, {}};
        for (unsigned int a = 0; a < n_corners; ++a)
          for (unsigned int b = 0; b < n_corners; ++b)
            block.value[a][b] = half * of_face.diffusion() * determinant(mesh, cell) / 6 / horizon *
                                (slopes[a] * slopes[b]);
        add(rows[number], BlockRow{block});
      }
    }

    /// The sum of it and its transpose.
    void make_symmetric(std::vector<BlockRow> &rows, std::size_t n_needed)
    {
      std::vector<BlockRow> transposed(n_needed);
      for (std::size_t row = 0; row < rows.size(); ++row)
        for (const Block &block : rows[row])
          if (block.cell < n_needed)
          {
            Block other{static_cast<unsigned int>(row), {}};
            for (unsigned int a = 0; a < n_corners; ++a)
              for (unsigned int b = 0; b < n_corners; ++b)
                other.value[b][a] = block.value[a][b];
            transposed[block.cell].push_back(other);
          }
      rows.resize(n_needed);
      for (std::size_t row = 0; row < n_needed; ++row)
      {
        add(rows[row], transposed[row]);
        transposed[row] = {};
      }
    }

    double least_diagonal(const std::vector<BlockRow> &rows)
    {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t row = 0; row < rows.size(); ++row)
        for (const Block &block : rows[row])
          for (unsigned int a = 0; a < n_corners && block.cell == row; ++a)
            least = std::min(least, block.value[a][a]);
      return least;
    }

    algebra::CsrMatrix to_matrix(const std::vector<BlockRow> &rows, double factor)
    {
      algebra::CsrMatrix matrix;
      matrix.start.push_back(0);
      for (const BlockRow &row : rows)
        for (unsigned int a = 0; a < n_corners; ++a)
        {
          for (const Block &block : row)
            for (unsigned int b = 0; b < n_corners; ++b)
            {
              matrix.column.push_back(n_corners * block.cell + b);
              matrix.value.push_back(factor * block.value[a][b]);
            }
          matrix.start.push_back(matrix.column.size());
        }
      return matrix;
    }
  } // namespace

  algebra::CsrMatrix assemble_with_jumps(const TetrahedralSpace &space,
                                         const physics::Kernel<3> &kernel, std::size_t n_rows,
                                         const FaceRule &rule, FaceRuleUse *use)
  {
    const JumpRows of_face(space, kernel, n_rows, rule);
    const std::size_t n_needed = n_rows / n_corners, n_faces = of_face.faces().size();
    std::vector<BlockRow> rows(of_face.n_cells());
    std::mutex mutex;
    FaceRuleUse total;
    constexpr std::size_t n_at_once = 256; // some 50 MB of rows of faces
    std::vector<std::array<BlockRow, 2>> of_faces;
    for (std::size_t first = 0; first < n_faces; first += n_at_once)
    {
      const std::size_t last = std::min(first + n_at_once, n_faces);
      of_faces.assign(last - first, {});
      dealii::parallel::apply_to_subranges(
          first, last,
          [&](std::size_t begin, std::size_t end)
          {
            JumpRows::Workspace work;
            for (std::size_t face = begin; face < end; ++face)
              of_faces[face - first] = of_face.rows_of(face, work);
            const std::lock_guard<std::mutex> lock(mutex);
            for (unsigned int level = 0; level < total.n_pairs.size(); ++level)
              total.n_pairs[level] += work.use.n_pairs[level];
            total.error = std::max(total.error, work.use.error);
            total.n_open += work.use.n_open;
            total.open = std::max(total.open, work.use.open);
          },
          4);
      for (std::size_t face = first; face < last; ++face)
        for (std::size_t side = 0; side < of_face.faces()[face].sides.size(); ++side)
          if (const BlockRow &row = of_faces[face - first][side]; !row.empty())
            add(rows[of_face.faces()[face].sides[side].cell], row);
    }
    add_local(space, kernel.horizon(), of_face, rows, n_needed);
    make_symmetric(rows, n_needed);
    if (use != nullptr)
    {
      *use = total;
      use->error /= least_diagonal(rows);
      use->open /= least_diagonal(rows);
    }
    return to_matrix(rows, kernel.constant() * std::pow(kernel.horizon(), 6)); // of ∬γ
  }
} // namespace plumbline::reference
