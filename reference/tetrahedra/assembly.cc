#include "reference/tetrahedra/assembly.h"

#include "geometry/search.h"
#include "reference/tetrahedra/exact_pairs.h"
#include "reference/tetrahedra/jump_assembly.h"
#include "reference/tetrahedra/lattice_faces.h"
#include "reference/tetrahedra/solid_kernel.h"

#include <deal.II/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using dealii::Point;

    /// Of a pair of unknowns, components a and b: entries of bond tensors.
    using Block = dealii::Tensor<2, 3>;

    template <class Value>
    constexpr unsigned int n_components = 1;
    template <>
    constexpr unsigned int n_components<Block> = 3;

    double transposed(double value)
    {
      return value;
    }
    Block transposed(const Block &value)
    {
      return transpose(value);
    }

    double component(double value, unsigned int, unsigned int)
    {
      return value;
    }
    double component(const Block &value, unsigned int a, unsigned int b)
    {
      return value[a][b];
    }

    /// @tparam Value  double, or Block
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

    /// The faces of a mesh, those that are near to each other together.
    class SortedFaces
    {
    public:
      SortedFaces(const TetrahedralSpace &space, double horizon) : faces_(make_faces(space))
      {
        const TetrahedralMesh &mesh = space.mesh();
        double volume = 0;
        for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
          volume += determinant(mesh, cell) / 6 / std::pow(horizon, 3);
        of_vertex_ = volume / static_cast<double>(mesh.vertices.size());
        of_cell_ = volume / static_cast<double>(mesh.cells.size());
        sort(mesh, horizon);
        std::map<std::array<unsigned int, 2>, unsigned int> edges;
        for (const SpaceFace &face : faces_)
        {
          NumberedFace numbered;
          numbered.number = static_cast<unsigned int>(numbered_.size());
          for (unsigned int k = 0; k < 3; ++k)
          {
            std::array<unsigned int, 2> ends = {face.vertices[k], face.vertices[(k + 1) % 3]};
            std::sort(ends.begin(), ends.end());
            numbered.edges[k] =
                edges.try_emplace(ends, static_cast<unsigned int>(edges.size())).first->second;
          }
          numbered_.push_back(numbered);
        }
        for (const SpaceFace &face : faces_)
          scaled_.emplace_back(scale(mesh, horizon, face), face.vertices);
        for (NumberedFace &face : numbered_)
          face.face = &scaled_[face.number];
      }

      const std::vector<SpaceFace> &faces() const { return faces_; }
      const NumberedFace &numbered(std::size_t face) const { return numbered_[face]; }
      /// First faces of blocks, and the end.
      const std::vector<std::size_t> &blocks() const { return blocks_; }
      double volume_of_vertex() const { return of_vertex_; } ///< the mean [horizons]
      double volume_of_cell() const { return of_cell_; }     ///< the mean [horizons]

      std::vector<geometry::Cuboid> boxes() const
      {
        std::vector<geometry::Cuboid> boxes;
        for (const PairFace &face : scaled_)
          boxes.push_back(face.box());
        return boxes;
      }

    private:
      static PairFace::Vertices scale(const TetrahedralMesh &mesh, double horizon,
                                      const SpaceFace &face)
      {
        PairFace::Vertices x;
        for (unsigned int k = 0; k < 3; ++k)
          x[k] = Point<3>((mesh.vertices[face.vertices[k]] - mesh.vertices.front()) / horizon);
        return x;
      }

      /// By cubes a vertex or two wide, which are the blocks.
      void sort(const TetrahedralMesh &mesh, double horizon)
      {
        // values that pairs share fit into some 30 MB
        const double spacing = std::cbrt(of_vertex_), size = spacing * (spacing > .25   ? 3
                                                                        : spacing > .15 ? 2
                                                                                        : 1);
        using Key = std::array<long, 3>;
        std::vector<std::pair<Key, std::size_t>> keys;
        for (const SpaceFace &face : faces_)
        {
          const PairFace::Vertices x = scale(mesh, horizon, face);
          Key key{};
          for (unsigned int d = 0; d < 3; ++d)
            key[d] = std::lround(std::floor((x[0][2 - d] + x[1][2 - d] + x[2][2 - d]) / 3 / size));
          keys.emplace_back(key, keys.size());
        }
        std::sort(keys.begin(), keys.end());
        std::vector<SpaceFace> sorted;
        for (std::size_t k = 0; k < keys.size(); ++k)
        {
          if (k == 0 || keys[k].first != keys[k - 1].first)
            blocks_.push_back(k);
          sorted.push_back(faces_[keys[k].second]);
        }
        blocks_.push_back(keys.size());
        faces_ = std::move(sorted);
      }

      std::vector<SpaceFace> faces_;
      double of_vertex_ = 0, of_cell_ = 0;
      std::vector<std::size_t> blocks_;
      std::vector<PairFace> scaled_; ///< the faces [horizons]
      std::vector<NumberedFace> numbered_;
    };

    /// ∬_{F×G} of one potential, of a face F and those near it.
    class FaceIntegrals
    {
    public:
      /// @param kernel  a part of a SolidKernel
      /// @param largest_jump  of each face
      /// @param size_of_pair  by which round-off is measured [1]
      /// @param spacing  of a lattice, or 0 [reaches]
      FaceIntegrals(const PotentialKernel &kernel, FacePotential::Kind kind,
                    const SortedFaces &faces, const std::vector<double> &largest_jump,
                    const FaceRule &rule, double spacing, double size_of_pair)
          : faces_(faces), largest_jump_(largest_jump), potential_(kernel, kind), spacing_(spacing)
      {
        if (rule.is_exact)
          exact_.emplace(kernel, kind, rule.tolerance * size_of_pair);
        else
          by_rule_.emplace(potential_, rule.refinement);
      }

      double diffusion() const { return potential_.diffusion(); }

      /// What a thread needs for itself.
      struct Workspace
      {
        std::vector<double> values; ///< of a face and those near it
        ExactPairs::Shared shared;
        std::vector<const NumberedFace *> others; ///< of them, those that are not known
        std::vector<std::size_t> places;          ///< of those there
        std::vector<ExactPairs::Integral> exact;  ///< their integrals
        FaceRuleUse use;
      };

      /// For pairs of some faces, the first of each pair, with others.
      void start(const std::vector<const NumberedFace *> &first,
                 const std::vector<const NumberedFace *> &second, Workspace &work) const
      {
        if (exact_)
          work.shared.start(first, second);
      }

      /// work.values = those of a face and those near it.
      void find(std::size_t face, const std::vector<unsigned int> &near, Workspace &work) const
      {
        const NumberedFace &f = faces_.numbered(face);
        work.values.assign(near.size(), 0);
        if (!exact_)
          for (std::size_t k = 0; k < near.size(); ++k)
            work.values[k] = (*by_rule_)(*f.face, *faces_.numbered(near[k]).face);
        work.others.clear();
        work.places.clear();
        for (std::size_t k = 0; exact_ && k < near.size(); ++k)
          if (const NumberedFace &g = faces_.numbered(near[k]);
              spacing_ == 0 || !find_repeated(f, g, work, work.values[k]))
          {
            work.others.push_back(&g);
            work.places.push_back(k);
          }
        if (work.others.empty())
          return;
        (*exact_)(f, work.others, work.shared, work.exact);
        for (std::size_t k = 0; k < work.others.size(); ++k)
        {
          ++work.use.n_pairs[work.exact[k].level];
          work.values[work.places[k]] = noted(f, *work.others[k], work.exact[k], work);
        }
      }

    private:
      double noted(const NumberedFace &f, const NumberedFace &g,
                   const ExactPairs::Integral &integral, Workspace &work) const
      {
        work.use.error = std::max(work.use.error, integral.error * largest_jump_[f.number] *
                                                      largest_jump_[g.number]);
        return integral.value;
      }

      /// @return  whether both are faces of a lattice
      bool find_repeated(const NumberedFace &f, const NumberedFace &g, Workspace &work,
                         double &value) const
      {
        const auto places = places_on_lattice(*f.face, *g.face, spacing_);
        if (places)
          value = noted(f, g, known(*places, work), work);
        return places.has_value();
      }

      /// By the places alone, so that all threads have the same.
      ExactPairs::Integral known(const FacePlaces &places, Workspace &work) const
      {
        {
          const std::lock_guard<std::mutex> lock(mutex_);
          if (const auto found = known_.find(places); found != known_.end())
            return found->second;
        }
        const auto [f, g] = faces_at(places, spacing_);
        const ExactPairs::Integral integral = (*exact_)(f, g);
        const std::lock_guard<std::mutex> lock(mutex_);
        if (known_.try_emplace(places, integral).second)
          ++work.use.n_pairs[integral.level];
        return integral;
      }

      const SortedFaces &faces_;
      const std::vector<double> &largest_jump_;
      FacePotential potential_;
      double spacing_; ///< [reaches]
      std::optional<FacePairs> by_rule_;
      std::optional<ExactPairs> exact_;
      mutable std::map<FacePlaces, ExactPairs::Integral> known_;
      mutable std::mutex mutex_; ///< of what is known
    };

    /// What a pair of faces adds to an entry, besides their jumps.
    /// @param parts  the integral of each part of a SolidKernel
    void add_pair(double &sum, double jump, bool is_continuous, const SpaceFace &f,
                  const SpaceFace &g, const std::array<double, 2> &parts)
    {
      sum += jump * parts[0] * (is_continuous ? -1 : f.normal * g.normal);
    }

    void add_pair(Block &sum, double jump, bool is_continuous, const SpaceFace &f,
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
          : space_(space), n_rows_(n_rows), faces_(space, kernel.reach), search_(faces_.boxes())
      {
        for (const SpaceFace &face : faces_.faces())
        {
          largest_jump_.push_back(0);
          for (const SpaceFace::Jump &jump : face.jumps)
            largest_jump_.back() = std::max(largest_jump_.back(), std::abs(jump.value));
          is_needed_.push_back(std::any_of(face.jumps.begin(), face.jumps.end(),
                                           [n_rows](const SpaceFace::Jump &jump)
                                           { return jump.dof < n_rows; })
                                   ? 1
                                   : 0);
        }
        const FacePotential::Kind kind =
            space.is_continuous() ? FacePotential::Kind::biharmonic : FacePotential::Kind::harmonic;
        for (const PotentialKernel &part : kernel.parts)
          integrals_.push_back(std::make_unique<const FaceIntegrals>(
              part, kind, faces_, largest_jump_, rule, rule.spacing / kernel.reach,
              kernel.m0 * volume_of_pair()));
      }

      const std::vector<SpaceFace> &faces() const { return faces_.faces(); }
      const std::vector<std::size_t> &blocks() const { return faces_.blocks(); }
      std::size_t n_parts() const { return integrals_.size(); }
      double diffusion(std::size_t part) const { return integrals_[part]->diffusion(); }

      /// What a thread needs for itself.
      struct Workspace
      {
        std::vector<unsigned int> near, columns;
        std::vector<Value> sums;     ///< of all unknowns, 0 between calls
        std::vector<char> is_summed; ///< of all unknowns, 0 between calls
        std::array<FaceIntegrals::Workspace, 2> of_parts;
      };

      /// rows = sums of the faces of a block.
      /// @param rows  as many as the block has faces
      void add_block(std::size_t block, Row<Value> *rows, Workspace &work) const
      {
        const std::size_t first = blocks()[block], last = blocks()[block + 1];
        std::vector<std::vector<unsigned int>> near(last - first);
        std::vector<const NumberedFace *> own, all;
        find_candidates(first, last, work);
        std::vector<char> is_met(work.near.size());
        for (std::size_t face = first; face < last; ++face)
        {
          std::vector<unsigned int> &partners = near[face - first];
          for (std::size_t k = 0; k < work.near.size(); ++k)
            if (are_partners(face, work.near[k]))
            {
              partners.push_back(work.near[k]);
              if (is_met[k] == 0)
                all.push_back(&faces_.numbered(work.near[k]));
              is_met[k] = 1;
            }
          if (!partners.empty())
            own.push_back(&faces_.numbered(face));
        }
        for (std::size_t part = 0; part < integrals_.size(); ++part)
          integrals_[part]->start(own, all, work.of_parts[part]);
        for (std::size_t face = first; face < last; ++face)
          rows[face - first] = make_row(face, near[face - first], work);
      }

    private:
      /// What m₀ is multiplied by in a diagonal entry, divided by jumps. [reach^3]
      double volume_of_pair() const
      {
        return space_.is_continuous() ? std::pow(faces_.volume_of_vertex(), 5. / 3)
                                      : faces_.volume_of_cell();
      }

      /// Faces that may be partners of one of a block.
      void find_candidates(std::size_t first, std::size_t last, Workspace &work) const
      {
        geometry::Cuboid box = search_.box(static_cast<unsigned int>(first));
        for (std::size_t face = first; face < last; ++face)
        {
          const geometry::Cuboid &own = search_.box(static_cast<unsigned int>(face));
          for (unsigned int d = 0; d < 3; ++d)
          {
            box.lower[d] = std::min(box.lower[d], own.lower[d]);
            box.upper[d] = std::max(box.upper[d], own.upper[d]);
          }
        }
        for (unsigned int d = 0; d < 3; ++d)
        {
          box.lower[d] -= 1;
          box.upper[d] += 1;
        }
        search_.find(box, work.near);
        work.near.erase(work.near.begin(),
                        std::lower_bound(work.near.begin(), work.near.end(), first));
      }

      /// Each pair once, so near that f may not vanish, and with a row that is asked for.
      bool are_partners(std::size_t face, std::size_t other) const
      {
        if (other < face || (is_needed_[face] == 0 && is_needed_[other] == 0))
          return false;
        const PairFace &f = *faces_.numbered(face).face, &g = *faces_.numbered(other).face;
        const double reach = 1 + f.radius() + g.radius();
        return f.centre().distance_square(g.centre()) < reach * reach;
      }

      /// Of unknowns j, what add_pair() says of F and each G times j's jump there.
      Row<Value> make_row(std::size_t face, const std::vector<unsigned int> &near,
                          Workspace &work) const
      {
        work.sums.resize(space_.n_dofs());
        work.is_summed.resize(space_.n_dofs());
        work.columns.clear();
        for (std::size_t part = 0; part < integrals_.size(); ++part)
          integrals_[part]->find(face, near, work.of_parts[part]);
        for (std::size_t k = 0; k < near.size(); ++k)
        {
          const unsigned int other = near[k];
          std::array<double, 2> values{};
          for (std::size_t part = 0; part < integrals_.size(); ++part)
            values[part] = work.of_parts[part].values[k] * (other == face ? .5 : 1);
          if (values[0] == 0 && values[1] == 0)
            continue;
          const SpaceFace &f = faces()[face], &g = faces()[other];
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
          if (work.sums[dof] != Value() && (is_needed_[face] != 0 || dof < n_rows_))
            row.push_back({dof, work.sums[dof]}); // else all cancels
          work.sums[dof] = Value();
          work.is_summed[dof] = 0;
        }
        return row;
      }

      const TetrahedralSpace &space_;
      std::size_t n_rows_;
      SortedFaces faces_;
      std::vector<double> largest_jump_; ///< of each face
      std::vector<char> is_needed_;      ///< faces that rows asked for have
      std::vector<std::unique_ptr<const FaceIntegrals>> integrals_; ///< of each part of the kernel
      geometry::BoxSearch<3> search_;
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

    /// What ∫∇φ_i·∇φ_j (times the first factor) and ∫∇φ_i⊗∇φ_j (the second) of a cell add.
    void add_slopes(double &sum, const std::array<double, 2> &factors,
                    const dealii::Tensor<1, 3> &i, const dealii::Tensor<1, 3> &j)
    {
      sum += factors[0] * (i * j);
    }

    void add_slopes(Block &sum, const std::array<double, 2> &factors, const dealii::Tensor<1, 3> &i,
                    const dealii::Tensor<1, 3> &j)
    {
      for (unsigned int a = 0; a < 3; ++a)
      {
        sum[a][a] += factors[0] * (i * j);
        for (unsigned int b = 0; b < 3; ++b)
          sum[a][b] += factors[1] * (i[a] * j[b]);
      }
    }

    /// rows += those of the local operator, see add_slopes().
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
            add_slopes(local.back().value, factors, slopes[i], slopes[j]);
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
          for (unsigned int a = 0; entry.column == row && a < n_components<Value>; ++a)
            least = std::min(least, component(entry.value, a, a));
      return least;
    }

    template <class Value>
    algebra::CsrMatrix to_matrix(const std::vector<Row<Value>> &rows, double factor)
    {
      constexpr unsigned int n = n_components<Value>;
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
      const std::vector<std::size_t> &blocks = of_face.blocks();
      DofRows<Value> sums(of_face.faces(), space.n_dofs(), n_rows);
      std::mutex mutex;
      FaceRuleUse total;
      constexpr std::size_t n_at_once = 2048; // some 15 MB of rows of faces, of bond tensors 75
      std::vector<Row<Value>> of_faces;
      for (std::size_t first = 0, last = 0; first + 1 < blocks.size(); first = last)
      {
        while (last + 1 < blocks.size() &&
               (last == first || blocks[last + 1] - blocks[first] <= n_at_once))
          ++last;
        of_faces.assign(blocks[last] - blocks[first], {});
        dealii::parallel::apply_to_subranges(
            first, last,
            [&](std::size_t begin, std::size_t end)
            {
              typename FaceRows<Value>::Workspace work;
              for (std::size_t block = begin; block < end; ++block)
                of_face.add_block(block, &of_faces[blocks[block] - blocks[first]], work);
              const std::lock_guard<std::mutex> lock(mutex);
              for (const FaceIntegrals::Workspace &part : work.of_parts)
              {
                for (unsigned int level = 0; level < total.n_pairs.size(); ++level)
                  total.n_pairs[level] += part.use.n_pairs[level];
                total.error = std::max(total.error, part.use.error);
              }
            },
            1);
        sums.add_faces(of_faces, blocks[first], blocks[last]);
      }
      std::vector<Row<Value>> rows = sums.symmetric();
      // lengths of ∬γ in reaches: 6; of derivatives of φ_i and φ_j: -1 each; of ∫∇φ·∇φ: 1
      double unit = kernel.constant * std::pow(kernel.reach, 6);
      if (space.is_continuous())
      {
        unit *= kernel.reach * kernel.reach;
        std::array<double, 2> factors{};
        for (std::size_t part = 0; part < of_face.n_parts(); ++part)
          factors[part] = of_face.diffusion(part) / std::pow(kernel.reach, 3);
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
                                   : assemble<Block>(space, parts, n_rows, rule, use);
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
