#include "reference/tetrahedra/assembly.h"

#include "reference/tetrahedra/entry_values.h"
#include "reference/tetrahedra/face_sweep.h"
#include "reference/tetrahedra/jump_assembly.h"

#include <deal.II/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using dealii::Point;

    /// @tparam Value  double, or SolidValue
    template <class Value>
    struct Entry
    {
      unsigned int column = 0;
      Value value{};
    };
    template <class Value>
    using Row = std::vector<Entry<Value>>; ///< columns ascending, each once

    /// row += factor × other.
    template <class Value>
    void add(Row<Value> &row, double factor, const Row<Value> &other)
    {
      Row<Value> sum;
      sum.reserve(row.size() + other.size());
      auto here = row.begin();
      for (const Entry<Value> &entry : other)
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

    /// What a pair of faces adds to an entry, besides their jumps.
    /// @param parts  the integral of each part of a SolidKernel
    void add_pair(double &sum, double jump, bool is_continuous, const SpaceFace &f,
                  const SpaceFace &g, const std::array<double, 2> &parts)
    {
      sum += jump * parts[0] * (is_continuous ? -1 : f.normal * g.normal);
    }

    void add_pair(SolidValue &sum, double jump, bool is_continuous, const SpaceFace &f,
                  const SpaceFace &g, const std::array<double, 2> &parts)
    {
      const double cosine = f.normal * g.normal,
                   isotropic = jump * parts[0] * (is_continuous ? -1 : cosine),
                   directional = jump * parts[1] * (is_continuous ? -cosine : 1);
      for (unsigned int a = 0; a < 3; ++a)
      {
        sum[a][a] += isotropic;
        for (unsigned int b = 0; b < 3; ++b)
          sum[a][b] += directional * f.normal[a] * g.normal[b];
      }
    }

    /// Sums over the faces G about a face F, each pair once: those with G = F by half, and others
    /// with one order of F and G, so that the matrix is the sum and its transpose.
    template <class Value>
    class FaceRows
    {
    public:
      FaceRows(const TetrahedralSpace &space, const SolidKernel &kernel, std::size_t n_rows,
               const FaceRule &rule)
          : space_(space), n_rows_(n_rows), faces_(make_faces(space)),
            sorted_(space.mesh(), vertices_of(faces_), kernel.reach)
      {
        std::vector<SpaceFace> sorted;
        std::vector<double> largest_jump;
        std::vector<char> is_needed;
        for (const std::size_t number : sorted_.order())
        {
          const SpaceFace &face = sorted.emplace_back(faces_[number]);
          largest_jump.push_back(0);
          for (const SpaceFace::Jump &jump : face.jumps)
            largest_jump.back() = std::max(largest_jump.back(), std::abs(jump.value));
          is_needed.push_back(std::any_of(face.jumps.begin(), face.jumps.end(),
                                          [n_rows](const SpaceFace::Jump &jump)
                                          { return jump.dof < n_rows; })
                                  ? 1
                                  : 0);
        }
        faces_ = std::move(sorted);
        const bool is_continuous = space.is_continuous();
        sweep_.emplace(
            sorted_, kernel,
            is_continuous ? FacePotential::Kind::biharmonic : FacePotential::Kind::harmonic, rule,
            is_continuous ? std::pow(sorted_.volume_of_vertex(), 5. / 3) : sorted_.volume_of_cell(),
            std::move(largest_jump), std::move(is_needed));
      }

      const std::vector<SpaceFace> &faces() const { return faces_; }
      const std::vector<std::size_t> &blocks() const { return sorted_.blocks(); }
      std::array<double, 2> diffusion() const { return sweep_->diffusion(); }

      using FaceRow = Row<Value>;

      /// What a thread needs for itself.
      struct Workspace
      {
        void add_use(FaceRuleUse &total) const { of_pairs.add_use(total); }

        std::vector<unsigned int> columns;
        std::vector<Value> sums;     ///< of all unknowns, 0 between calls
        std::vector<char> is_summed; ///< of all unknowns, 0 between calls
        FaceSweep::Workspace of_pairs;
      };

      /// rows = sums of the faces of a block.
      /// @param rows  as many as the block has faces
      void add_block(std::size_t block, FaceRow *rows, Workspace &work) const
      {
        sweep_->for_each_face(block, work.of_pairs,
                              [&](std::size_t face, const std::vector<unsigned int> &near)
                              { rows[face - blocks()[block]] = make_row(face, near, work); });
      }

    private:
      static std::vector<SortedFaces::Vertices> vertices_of(const std::vector<SpaceFace> &faces)
      {
        std::vector<SortedFaces::Vertices> vertices;
        for (const SpaceFace &face : faces)
          vertices.push_back(face.vertices);
        return vertices;
      }

      /// Of unknowns j, what add_pair() says of F and each G times j's jump there.
      Row<Value> make_row(std::size_t face, const std::vector<unsigned int> &near,
                          Workspace &work) const
      {
        work.sums.resize(space_.n_dofs());
        work.is_summed.resize(space_.n_dofs());
        work.columns.clear();
        for (std::size_t k = 0; k < near.size(); ++k)
        {
          const unsigned int other = near[k];
          std::array<double, 2> values = work.of_pairs.values(k);
          for (double &value : values)
            value *= other == face ? .5 : 1;
          if (values[0] == 0 && values[1] == 0)
            continue;
          const SpaceFace &f = faces_[face], &g = faces_[other];
          for (const auto &[dof, jump] : g.jumps)
          {
            if (work.is_summed[dof] == 0)
              work.columns.push_back(dof);
            work.is_summed[dof] = 1;
            add_pair(work.sums[dof], jump, space_.is_continuous(), f, g, values);
          }
        }
        std::sort(work.columns.begin(), work.columns.end());
        Row<Value> row;
        for (const unsigned int dof : work.columns)
        {
          if (work.sums[dof] != Value() && (sweep_->is_needed(face) || dof < n_rows_))
            row.push_back({dof, work.sums[dof]}); // else all cancels
          work.sums[dof] = Value();
          work.is_summed[dof] = 0;
        }
        return row;
      }

      const TetrahedralSpace &space_;
      std::size_t n_rows_;
      std::vector<SpaceFace> faces_;
      SortedFaces sorted_;
      std::optional<FaceSweep> sweep_;
    };

    /// Of faces before `last`, what they add to the rows of unknowns.
    template <class Value>
    class DofRows
    {
    public:
      DofRows(const std::vector<SpaceFace> &faces, std::size_t n_dofs, std::size_t n_rows)
          : n_rows_(n_rows), shares_(n_dofs), n_done_(n_dofs), rows_(n_dofs)
      {
        for (std::size_t face = 0; face < faces.size(); ++face)
          for (const auto &[dof, jump] : faces[face].jumps)
            shares_[dof].push_back({face, jump});
      }

      /// @param of_faces  from `first` to before `last`
      void add_faces(const std::vector<Row<Value>> &of_faces, std::size_t first, std::size_t last)
      {
        constexpr unsigned int grain = 64;
        dealii::parallel::apply_to_subranges(
            static_cast<std::size_t>(0), rows_.size(),
            [&](std::size_t begin, std::size_t end)
            {
              Row<Value> some;
              for (std::size_t i = begin; i < end; ++i)
                for (; n_done_[i] < shares_[i].size() && shares_[i][n_done_[i]].face < last;
                     ++n_done_[i])
                {
                  const auto &[face, jump] = shares_[i][n_done_[i]];
                  const Row<Value> &row = of_faces[face - first];
                  some.clear();
                  if (i >= n_rows_)
                    for (std::size_t k = 0; k < row.size() && row[k].column < n_rows_; ++k)
                      some.push_back(row[k]);
                  add(rows_[i], jump, i < n_rows_ ? row : some);
                }
            },
            grain);
      }

      /// The sum of it and its transpose.
      std::vector<Row<Value>> symmetric()
      {
        std::vector<Row<Value>> below(n_rows_);
        for (std::size_t row = 0; row < rows_.size(); ++row)
          for (const auto &[column, value] : rows_[row])
            if (column < n_rows_)
              below[column].push_back({static_cast<unsigned int>(row), transposed(value)});
        rows_.resize(n_rows_);
        for (std::size_t row = 0; row < n_rows_; ++row)
        {
          add(rows_[row], 1, below[row]);
          below[row] = {};
        }
        return std::move(rows_);
      }

    private:
      struct Share
      {
        std::size_t face = 0;
        double jump = 0;
      };

      std::size_t n_rows_;
      std::vector<std::vector<Share>> shares_; ///< faces ascending
      std::vector<std::size_t> n_done_;        ///< of each unknown's shares
      std::vector<Row<Value>> rows_;           ///< beyond n_rows only columns before it
    };

    /// rows += those of the local operator, see add_product().
    template <class Value>
    void add_local(const TetrahedralSpace &space, const std::array<double, 2> &factors,
                   std::vector<Row<Value>> &rows)
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
          Row<Value> local;
          for (unsigned int j = 0; j < 4; ++j)
          {
            local.push_back({space.dof(cell, j)});
            add_product(local.back().value, factors, slopes[i], slopes[j]);
          }
          std::sort(local.begin(), local.end(),
                    [](const Entry<Value> &a, const Entry<Value> &b)
                    { return a.column < b.column; });
          add(rows[space.dof(cell, i)], volume, local);
        }
      }
    }

    template <class Value>
    double least_diagonal(const std::vector<Row<Value>> &rows)
    {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t row = 0; row < rows.size(); ++row)
        for (const Entry<Value> &entry : rows[row])
          for (unsigned int a = 0; entry.column == row && a < n_components_of<Value>; ++a)
            least = std::min(least, component(entry.value, a, a));
      return least;
    }

    template <class Value>
    algebra::CsrMatrix to_matrix(const std::vector<Row<Value>> &rows, double factor)
    {
      constexpr unsigned int n = n_components_of<Value>;
      algebra::CsrMatrix matrix;
      matrix.start.push_back(0);
      for (const Row<Value> &row : rows)
        for (unsigned int a = 0; a < n; ++a)
        {
          for (const auto &[column, value] : row)
            for (unsigned int b = 0; b < n; ++b)
            {
              matrix.column.push_back(n * column + b);
              matrix.value.push_back(factor * component(value, a, b));
            }
          matrix.start.push_back(matrix.column.size());
        }
      return matrix;
    }

    template <class Value>
    algebra::CsrMatrix assemble(const TetrahedralSpace &space, const SolidKernel &kernel,
                                std::size_t n_rows, const FaceRule &rule, FaceRuleUse *use)
    {
      const FaceRows<Value> of_face(space, kernel, n_rows, rule);
      DofRows<Value> sums(of_face.faces(), space.n_dofs(), n_rows);
      constexpr std::size_t n_at_once = 2048; // some 15 MB of rows of faces, of bond tensors 75
      const FaceRuleUse total =
          for_each_group(of_face, n_at_once,
                         [&sums](const auto &of_faces, std::size_t first, std::size_t last)
                         { sums.add_faces(of_faces, first, last); });
      std::vector<Row<Value>> rows = sums.symmetric();
      // lengths of ∬γ in reaches: 6; of derivatives of φ_i and φ_j: -1 each; of ∫∇φ·∇φ: 1
      double unit = kernel.constant * std::pow(kernel.reach, 6);
      if (space.is_continuous())
      {
        unit *= kernel.reach * kernel.reach;
        std::array<double, 2> factors = of_face.diffusion();
        for (double &factor : factors)
          factor /= std::pow(kernel.reach, 3);
        add_local(space, factors, rows);
      }
      if (use != nullptr)
      {
        *use = total;
        use->error /= least_diagonal(rows);
      }
      return to_matrix(rows, unit);
    }
  } // namespace

  algebra::CsrMatrix assemble_by_faces(const TetrahedralSpace &space,
                                       const physics::Kernel<3> &kernel, std::size_t n_rows,
                                       const FaceRule &rule, FaceRuleUse *use,
                                       const std::optional<physics::Dilatation<3>> &dilatation)
  {
    if (!space.is_continuous() && space.degree() == 1)
      return assemble_with_jumps(space, kernel, n_rows, rule, use, dilatation);
    const SolidKernel parts(kernel, dilatation);
    return parts.parts.size() == 1 ? assemble<double>(space, parts, n_rows, rule, use)
                                   : assemble<SolidValue>(space, parts, n_rows, rule, use);
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
        if (!(std::abs(change) <= worst) && !std::isnan(worst)) // NaN is larger than all
          worst = std::abs(change);
    }
    return worst / largest;
  }
} // namespace plumbline::reference
