#include "reference/tetrahedra/jump_assembly.h"

#include "geometry/tetrahedral_check.h"
#include "reference/tetrahedra/bond_deficit.h"
#include "reference/tetrahedra/face_sweep.h"
#include "reference/tetrahedra/jump_pairs.h"

#include <deal.II/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

    template <class Value>
    using Matrix = CornerMatrix<Value>;

    /// Entries of the unknowns of two cells, one of the row and one of the column.
    template <class Value>
    struct Block
    {
      unsigned int cell = 0; ///< the column's
      Matrix<Value> value{};
    };
    template <class Value>
    using BlockRow = std::vector<Block<Value>>; ///< cells ascending, each once

    template <class Value>
    void add(Matrix<Value> &to, const Matrix<Value> &value)
    {
      for (unsigned int a = 0; a < n_corners; ++a)
        for (unsigned int b = 0; b < n_corners; ++b)
          to[a][b] += value[a][b];
    }

    /// row += other.
    template <class Value>
    void add(BlockRow<Value> &row, const BlockRow<Value> &other)
    {
      BlockRow<Value> sum;
      sum.reserve(row.size() + other.size());
      auto here = row.begin();
      for (const Block<Value> &block : other)
      {
        while (here != row.end() && here->cell < block.cell)
          sum.push_back(*here++);
        sum.push_back(block);
        if (here != row.end() && here->cell == block.cell)
          add<Value>(sum.back().value, here++->value);
      }
      sum.insert(sum.end(), here, row.end());
      row = std::move(sum);
    }

    /// A cell of a face.
    struct JumpSide
    {
      unsigned int cell = 0;              ///< its number among the space's
      std::size_t mesh_cell = 0;          ///< and in the mesh
      double sign = 0;                    ///< 1 where the normal points to, -1 on the other side
      std::array<int, n_corners> place{}; ///< of corners among the face's vertices, or -1
      std::array<Tensor<1, 3>, n_corners> slopes{}; ///< ∇λ [1 / reach]
    };

    struct JumpFace
    {
      PairFace face; ///< [reaches]
      Tensor<1, 3> normal;
      boost::container::static_vector<JumpSide, 2> sides;
      double steepest = 0; ///< the largest |∇λ|
      /// Factors of bonds differ on its sides; where functions are continuous elsewhere, their
      /// values jump there alone.
      bool is_interface = false, has_jumps = true;
    };

    /// @param factors  of bonds; null: all are 1
    std::vector<JumpFace> make_jump_faces(const TetrahedralSpace &space, double reach,
                                          const BondFactors *factors, bool is_continuous)
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
            x[v] = Point<3>((mesh.vertices[side.key[v]] - mesh.vertices.front()) / reach);
          const Tensor<1, 3> area = cross_product_3d(x[1] - x[0], x[2] - x[0]);
          faces.push_back({PairFace(x, side.key), area / area.norm(), {}, 0, false, true});
        }
        JumpFace &face = faces.back();
        JumpSide own;
        own.cell = space.dof(side.cell, 0) / n_corners;
        own.mesh_cell = side.cell;
        own.slopes = gradients(mesh, side.cell);
        own.sign = own.slopes[side.opposite] * face.normal > 0 ? 1 : -1;
        for (unsigned int corner = 0; corner < n_corners; ++corner)
        {
          own.slopes[corner] *= reach;
          face.steepest = std::max(face.steepest, own.slopes[corner].norm());
          const auto found =
              std::find(side.key.begin(), side.key.end(), mesh.cells[side.cell][corner]);
          own.place[corner] =
              found == side.key.end() ? -1 : static_cast<int>(found - side.key.begin());
        }
        face.sides.push_back(own);
      }
      for (JumpFace &face : faces)
      {
        const bool is_outside = face.sides.size() == 1;
        face.is_interface =
            factors != nullptr &&
            (is_outside ? factors->is_surface_free()
                        : !factors->are_alike(face.sides[0].mesh_cell, face.sides[1].mesh_cell));
        face.has_jumps = !is_continuous || face.is_interface;
      }
      return faces;
    }

    /// All integrals of a pair of faces, of as many parts of a kernel as there are.
    struct PairIntegrals
    {
      std::array<double, 2> slopes{}; ///< ∬Ψ
      std::array<JumpIntegrals, 2> jumps;
    };

    /// What the pair adds to entries of a cell of F and one of G.
    template <class Value>
    Matrix<Value> block_of(const JumpFace &f, const JumpSide &of_f, const JumpFace &g,
                           const JumpSide &of_g, const PairIntegrals &pair, double factor)
    {
      const double cosine = f.normal * g.normal;
      const auto parts = [&](const auto &integral) -> std::array<double, 2> {
        return {integral(pair.jumps[0]), integral(pair.jumps[1])};
      };
      const std::array<double, 2> slopes = {-cosine * pair.slopes[0], -cosine * pair.slopes[1]};
      Matrix<Value> block{};
      for (unsigned int a = 0; a < n_corners; ++a)
        for (unsigned int b = 0; b < n_corners; ++b)
        {
          const int at = of_f.place[a], other = of_g.place[b];
          const auto i = static_cast<std::size_t>(at), j = static_cast<std::size_t>(other);
          Value sum{};
          add_product(sum, slopes, of_f.slopes[a], of_g.slopes[b]);
          if (other >= 0)
            add_product(sum, parts([j](const JumpIntegrals &part) { return part.second[j]; }),
                        of_f.slopes[a], g.normal);
          if (at >= 0)
            add_product(sum, parts([i](const JumpIntegrals &part) { return part.first[i]; }),
                        f.normal, of_g.slopes[b]);
          if (at >= 0 && other >= 0)
            add_product(sum, parts([i, j](const JumpIntegrals &part) { return part.values[i][j]; }),
                        f.normal, g.normal);
          sum *= factor * of_f.sign * of_g.sign;
          block[a][b] = sum;
        }
      return block;
    }

    /// Sums over the faces G about a face F, each pair once: the matrix is their sum plus its
    /// transpose.
    template <class Value>
    class JumpRows
    {
    public:
      JumpRows(const TetrahedralSpace &space, const SolidKernel &kernel, std::size_t n_rows,
               const FaceRule &rule, const BondFactors *factors, bool is_continuous)
          : n_needed_(n_rows / n_corners),
            faces_(make_jump_faces(space, kernel.reach, factors, is_continuous)),
            n_cells_(space.mesh().cells.size()), spacing_(rule.spacing / kernel.reach),
            sorted_(space.mesh(), vertices_of(faces_), kernel.reach), known_(spacing_)
      {
        std::vector<JumpFace> sorted;
        std::vector<double> steepest;
        std::vector<char> is_needed;
        for (const std::size_t number : sorted_.order())
        {
          const JumpFace &face = sorted.emplace_back(faces_[number]);
          steepest.push_back(face.steepest);
          is_needed.push_back(std::any_of(face.sides.begin(), face.sides.end(),
                                          [this](const JumpSide &side)
                                          { return side.cell < n_needed_; })
                                  ? 1
                                  : 0);
        }
        faces_ = std::move(sorted);
        const double of_cell = sorted_.volume_of_cell();
        constexpr double of_slopes = 2. / 3; // ∇λ are like 1 / length
        sweep_.emplace(sorted_, kernel, FacePotential::Kind::biharmonic, rule,
                       of_cell * std::pow(of_cell, of_slopes), std::move(steepest),
                       std::move(is_needed));
        for (const PotentialKernel &part : kernel.parts)
          jumps_.emplace_back(part, rule.of_jumps * kernel.m0 * of_cell);
      }

      const std::vector<JumpFace> &faces() const { return faces_; }
      const std::vector<std::size_t> &blocks() const { return sorted_.blocks(); }
      std::size_t n_cells() const { return n_cells_; }
      std::array<double, 2> diffusion() const { return sweep_->diffusion(); }

      using FaceRow = std::array<BlockRow<Value>, 2>; ///< of each cell of a face

      /// What a thread needs for itself.
      struct Workspace
      {
        void add_use(FaceRuleUse &total) const
        {
          of_pairs.add_use(total);
          total.n_open += use.n_open;
          total.open = std::max(total.open, use.open);
        }

        std::vector<unsigned int> place; ///< of cells among columns + 1, else 0
        FaceSweep::Workspace of_pairs;
        FaceRuleUse use; ///< of jumps
      };

      /// For each face of a block and each of its cells, what it adds to the cell's rows.
      /// @param rows  as many as the block has faces
      void add_block(std::size_t block, FaceRow *rows, Workspace &work) const
      {
        work.place.resize(n_cells_);
        sweep_->for_each_face(block, work.of_pairs,
                              [&](std::size_t face, const std::vector<unsigned int> &near)
                              { rows[face - blocks()[block]] = make_row(face, near, work); });
      }

    private:
      static std::vector<SortedFaces::Vertices> vertices_of(const std::vector<JumpFace> &faces)
      {
        std::vector<SortedFaces::Vertices> vertices;
        for (const JumpFace &face : faces)
          vertices.push_back(face.face.names());
        return vertices;
      }

      FaceRow make_row(std::size_t face, const std::vector<unsigned int> &near,
                       Workspace &work) const
      {
        const JumpFace &f = faces_[face];
        FaceRow rows;
        double open = 0;
        for (std::size_t k = 0; k < near.size(); ++k)
        {
          const JumpFace &g = faces_[near[k]];
          if (are_out_of_reach(f.face, g.face))
            continue;
          PairIntegrals pair;
          pair.slopes = work.of_pairs.values(k);
          if (f.has_jumps || g.has_jumps)
            pair.jumps = jumps_of(f, g, work, open);
          for (const JumpSide &of_g : g.sides)
          {
            if (work.place[of_g.cell] == 0)
            {
              for (BlockRow<Value> &row : rows)
                row.push_back({of_g.cell, {}});
              work.place[of_g.cell] = static_cast<unsigned int>(rows[0].size());
            }
            for (std::size_t side = 0; side < f.sides.size(); ++side)
              add<Value>(
                  rows[side][work.place[of_g.cell] - 1].value,
                  block_of<Value>(f, f.sides[side], g, of_g, pair, near[k] == face ? .5 : 1));
          }
        }
        work.use.open = std::max(work.use.open, open);
        for (const Block<Value> &block : rows[0])
          work.place[block.cell] = 0;
        for (std::size_t side = 0; side < f.sides.size(); ++side)
          arrange(rows[side], f.sides[side].cell < n_needed_);
        return rows;
      }

      /// @param is_needed  else columns that are
      void arrange(BlockRow<Value> &row, bool is_needed) const
      {
        if (!is_needed)
          row.erase(std::remove_if(row.begin(), row.end(),
                                   [this](const Block<Value> &block)
                                   { return block.cell >= n_needed_; }),
                    row.end());
        std::sort(row.begin(), row.end(),
                  [](const Block<Value> &a, const Block<Value> &b) { return a.cell < b.cell; });
      }

      using PartJumps = std::array<JumpIntegrals, 2>;

      /// @param open  what is added to for one face: see FaceRuleUse
      PartJumps jumps_of(const JumpFace &f, const JumpFace &g, Workspace &work, double &open) const
      {
        PartJumps parts;
        if (const auto places = spacing_ > 0 ? places_on_lattice(f.face, g.face, spacing_)
                                             : std::optional<FacePlaces>())
          parts = known(*places, work);
        else
          parts = made(f.face, g.face, work);
        // see block_of(): λ_a of one face by slopes of the other's cells
        for (const JumpIntegrals &part : parts)
          open += part.open * (1 + f.face.radius() * g.steepest + g.face.radius() * f.steepest);
        return parts;
      }

      PartJumps made(const PairFace &f, const PairFace &g, Workspace &work) const
      {
        PartJumps parts;
        for (std::size_t part = 0; part < jumps_.size(); ++part)
        {
          parts[part] = jumps_[part](f, g);
          work.use.n_open += parts[part].open > 0 ? 1 : 0;
        }
        return parts;
      }

      PartJumps known(const FacePlaces &places, Workspace &work) const
      {
        Workspace own;
        const auto [parts, is_new] = known_.find(places, [&](const PairFace &f, const PairFace &g)
                                                 { return made(f, g, own); });
        if (is_new)
          work.use.n_open += own.use.n_open;
        return parts;
      }

      std::size_t n_needed_; ///< cells whose rows are asked for
      std::vector<JumpFace> faces_;
      std::size_t n_cells_;
      double spacing_; ///< [reaches]
      SortedFaces sorted_;
      std::optional<FaceSweep> sweep_;
      std::vector<JumpPairs> jumps_; ///< of each part
      TranslatedPairs<PartJumps> known_;
    };

    /// rows += ½κ ∫ g_i·g_j + κ Σ_F ∫_F n·{g_i} [φ_j], of which the matrix has the transpose, too.
    template <class Value>
    void add_local(const TetrahedralSpace &space, double reach, const JumpRows<Value> &of_face,
                   std::vector<BlockRow<Value>> &rows, std::size_t n_needed)
    {
      constexpr double half = .5, third = 1. / 3;
      const std::array<double, 2> diffusion = of_face.diffusion();
      const auto times = [&](double factor) -> std::array<double, 2> {
        return {factor * diffusion[0], factor * diffusion[1]};
      };
      for (const JumpFace &face : of_face.faces())
        for (const JumpSide &own : face.sides)
          for (const JumpSide &other : face.sides)
          {
            if (own.cell >= n_needed && other.cell >= n_needed)
              continue;
            Block<Value> block{other.cell, {}};
            for (unsigned int a = 0; a < n_corners; ++a)
              for (unsigned int b = 0; b < n_corners; ++b)
                if (other.place[b] >= 0)
                  add_product(block.value[a][b],
                              times(half * other.sign * face.face.area() * third), own.slopes[a],
                              face.normal);
            add(rows[own.cell], BlockRow<Value>{block});
          }
      const TetrahedralMesh &mesh = space.mesh();
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      {
        const unsigned int number = space.dof(cell, 0) / n_corners;
        if (number >= n_needed)
          continue;
        const auto slopes = gradients(mesh, cell);
        Block<Value> block{number, {}};
        for (unsigned int a = 0; a < n_corners; ++a)
          for (unsigned int b = 0; b < n_corners; ++b)
            add_product(block.value[a][b], times(half * determinant(mesh, cell) / 6 / reach),
                        slopes[a], slopes[b]);
        add(rows[number], BlockRow<Value>{block});
      }
    }

    /// The sum of it and its transpose.
    template <class Value>
    void make_symmetric(std::vector<BlockRow<Value>> &rows, std::size_t n_needed)
    {
      std::vector<BlockRow<Value>> others(n_needed);
      for (std::size_t row = 0; row < rows.size(); ++row)
        for (const Block<Value> &block : rows[row])
          if (block.cell < n_needed)
          {
            Block<Value> other{static_cast<unsigned int>(row), {}};
            for (unsigned int a = 0; a < n_corners; ++a)
              for (unsigned int b = 0; b < n_corners; ++b)
                other.value[b][a] = transposed(block.value[a][b]);
            others[block.cell].push_back(other);
          }
      rows.resize(n_needed);
      for (std::size_t row = 0; row < n_needed; ++row)
      {
        add(rows[row], others[row]);
        others[row] = {};
        for (Block<Value> &block : rows[row])
          for (auto &of_corner : block.value)
            for (Value &value : of_corner)
              symmetrise(value);
      }
    }

    template <class Value>
    double least_diagonal(const std::vector<BlockRow<Value>> &rows)
    {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t row = 0; row < rows.size(); ++row)
        for (const Block<Value> &block : rows[row])
          for (unsigned int a = 0; a < n_corners && block.cell == row; ++a)
            for (unsigned int c = 0; c < n_components_of<Value>; ++c)
              least = std::min(least, component(block.value[a][a], c, c));
      return least;
    }

    std::vector<Interface> interfaces_of(const std::vector<JumpFace> &faces)
    {
      std::vector<Interface> interfaces;
      for (const JumpFace &face : faces)
        if (face.is_interface)
        {
          Interface one{face.face, face.normal, {}};
          for (const JumpSide &side : face.sides)
            one.cells[side.sign < 0 ? 0 : 1] = side.mesh_cell;
          interfaces.push_back(one);
        }
      return interfaces;
    }

    /// Multiply bonds by their factors. Rows annihilate constants, so that the linear part of the
    /// deficit of a cell, see BondDeficit, is known from the entries of two cells. Only the rest is
    /// by quadrature.
    template <class Value>
    void set_factors(const TetrahedralSpace &space, const SolidKernel &kernel,
                     const JumpRows<Value> &of_face, const BondFactors &factors, double of_jumps,
                     std::vector<BlockRow<Value>> &rows, FaceRuleUse &use)
    {
      const TetrahedralMesh &mesh = space.mesh();
      std::vector<std::size_t> mesh_cell(mesh.cells.size());
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        mesh_cell[space.dof(cell, 0) / n_corners] = cell;
      const BondDeficit<Value> deficit(interfaces_of(of_face.faces()), kernel, factors);
      std::mutex mutex;
      const auto finish = [&](std::size_t row)
      {
        const std::size_t own = mesh_cell[row];
        std::array<Point<3>, n_corners> corners;
        for (unsigned int a = 0; a < n_corners; ++a)
          corners[a] =
              Point<3>((mesh.vertices[mesh.cells[own][a]] - mesh.vertices.front()) / kernel.reach);
        const double volume = determinant(mesh, own) / 6 / std::pow(kernel.reach, 3);
        const auto [of_bonds, open] =
            deficit.integrals(own, corners, of_jumps * kernel.m0 * volume);
        std::array<Value, n_corners> sums{};
        Block<Value> *diagonal = nullptr;
        for (Block<Value> &block : rows[row])
        {
          const double factor = factors.between(own, mesh_cell[block.cell]);
          if (block.cell == row)
            diagonal = &block;
          for (unsigned int a = 0; a < n_corners; ++a)
            for (unsigned int b = 0; b < n_corners; ++b)
            {
              block.value[a][b] *= factor;
              if (block.cell == row)
                block.value[a][b] += of_bonds[a][b];
              sums[a] += block.value[a][b];
            }
        }
        subtract_linear_part(volume, sums, diagonal->value);
        if (open > 0)
        {
          const std::lock_guard<std::mutex> lock(mutex);
          ++use.n_open;
          use.open = std::max(use.open, open);
        }
      };
      dealii::parallel::apply_to_subranges(
          std::size_t(0), rows.size(),
          [&](std::size_t begin, std::size_t end)
          {
            for (std::size_t row = begin; row < end; ++row)
              finish(row);
          },
          4);
    }

    template <class Value>
    algebra::CsrMatrix to_matrix(const std::vector<BlockRow<Value>> &rows, double factor)
    {
      constexpr unsigned int n = n_components_of<Value>;
      algebra::CsrMatrix matrix;
      matrix.start.push_back(0);
      for (const BlockRow<Value> &row : rows)
        for (unsigned int a = 0; a < n_corners; ++a)
          for (unsigned int c = 0; c < n; ++c)
          {
            for (const Block<Value> &block : row)
              for (unsigned int b = 0; b < n_corners; ++b)
                for (unsigned int d = 0; d < n; ++d)
                {
                  matrix.column.push_back(n * (n_corners * block.cell + b) + d);
                  matrix.value.push_back(factor * component(block.value[a][b], c, d));
                }
            matrix.start.push_back(matrix.column.size());
          }
      return matrix;
    }

    template <class Value>
    algebra::CsrMatrix assemble(const TetrahedralSpace &space, const SolidKernel &kernel,
                                std::size_t n_rows, const FaceRule &rule, FaceRuleUse *use,
                                const BondFactors *factors, bool is_continuous)
    {
      const JumpRows<Value> of_face(space, kernel, n_rows, rule, factors, is_continuous);
      const std::size_t n_needed = n_rows / n_corners;
      std::vector<BlockRow<Value>> rows(of_face.n_cells());
      constexpr std::size_t n_at_once = 256; // some 50 MB of rows of faces
      FaceRuleUse total = for_each_group(
          of_face, n_at_once,
          [&](const auto &of_faces, std::size_t first, std::size_t last)
          {
            for (std::size_t face = first; face < last; ++face)
              for (std::size_t side = 0; side < of_face.faces()[face].sides.size(); ++side)
                if (const BlockRow<Value> &row = of_faces[face - first][side]; !row.empty())
                  add(rows[of_face.faces()[face].sides[side].cell], row);
          });
      add_local(space, kernel.reach, of_face, rows, n_needed);
      make_symmetric(rows, n_needed);
      if (factors != nullptr)
        set_factors(space, kernel, of_face, *factors, rule.of_jumps, rows, total);
      if (use != nullptr)
      {
        *use = total;
        use->error /= least_diagonal(rows);
        use->open /= least_diagonal(rows);
      }
      return to_matrix(rows, kernel.constant * std::pow(kernel.reach, 6)); // of ∬γ
    }

    algebra::CsrMatrix assemble_broken(const TetrahedralSpace &space, const SolidKernel &kernel,
                                       std::size_t n_rows, const FaceRule &rule, FaceRuleUse *use,
                                       const BondFactors *factors, bool is_continuous)
    {
      return kernel.parts.size() == 1
                 ? assemble<double>(space, kernel, n_rows, rule, use, factors, is_continuous)
                 : assemble<SolidValue>(space, kernel, n_rows, rule, use, factors, is_continuous);
    }
  } // namespace

  algebra::CsrMatrix assemble_with_jumps(const TetrahedralSpace &space,
                                         const physics::Kernel<3> &kernel, std::size_t n_rows,
                                         const FaceRule &rule, FaceRuleUse *use,
                                         const std::optional<physics::Dilatation<3>> &dilatation,
                                         const BondFactors *factors)
  {
    return assemble_broken(space, SolidKernel(kernel, dilatation), n_rows, rule, use, factors,
                           false);
  }

  algebra::CsrMatrix assemble_interfaces(const TetrahedralSpace &space,
                                         const physics::Kernel<3> &kernel, std::size_t n_rows,
                                         const FaceRule &rule, FaceRuleUse *use,
                                         const BondFactors &factors)
  {
    return assemble_broken(space, SolidKernel(kernel), n_rows, rule, use, &factors, true);
  }

  algebra::CsrMatrix joined(const TetrahedralSpace &continuous, const TetrahedralSpace &broken,
                            unsigned int n_components, const algebra::CsrMatrix &rows)
  {
    const TetrahedralMesh &mesh = broken.mesh();
    std::vector<unsigned int> joint(broken.n_dofs()); // of unknowns of the broken space
    std::vector<std::vector<unsigned int>> parts(continuous.n_free());
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      for (unsigned int corner = 0; corner < n_corners; ++corner)
      {
        const unsigned int dof = broken.dof(cell, corner);
        joint[dof] = continuous.dof(cell, corner);
        if (joint[dof] < parts.size())
          parts[joint[dof]].push_back(dof);
      }
    std::vector<double> sums(continuous.n_dofs() * n_components);
    std::vector<char> is_there(sums.size());
    algebra::CsrMatrix result;
    result.start.push_back(0);
    for (const std::vector<unsigned int> &of_row : parts)
      for (unsigned int c = 0; c < n_components; ++c)
      {
        std::vector<unsigned int> columns;
        for (const unsigned int part : of_row)
          for (std::size_t k = rows.start[part * n_components + c];
               k < rows.start[part * n_components + c + 1]; ++k)
          {
            const unsigned int column =
                joint[rows.column[k] / n_components] * n_components + rows.column[k] % n_components;
            if (is_there[column] == 0)
              columns.push_back(column);
            is_there[column] = 1;
            sums[column] += rows.value[k];
          }
        std::sort(columns.begin(), columns.end());
        for (const unsigned int column : columns)
        {
          result.column.push_back(column);
          result.value.push_back(sums[column]);
          sums[column] = 0;
          is_there[column] = 0;
        }
        result.start.push_back(result.column.size());
      }
    return result;
  }
} // namespace plumbline::reference
