#pragma once

#include "geometry/search.h"
#include "reference/tetrahedra/assembly.h"
#include "reference/tetrahedra/exact_pairs.h"
#include "reference/tetrahedra/lattice_faces.h"
#include "reference/tetrahedra/solid_kernel.h"

#include <deal.II/base/parallel.h>

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace plumbline::reference
{
  /// Faces of a mesh in blocks of faces that are near each other: those whose centroids are in one
  /// cube, one to three vertex spacings wide. Lengths are in units of the kernel's reach.
  class SortedFaces
  {
  public:
    using Vertices = std::array<unsigned int, 3>;

    /// @param faces  all of the mesh, each once
    SortedFaces(const TetrahedralMesh &mesh, const std::vector<Vertices> &faces, double reach);

    std::size_t size() const { return order_.size(); }
    /// For each sorted face, its place among the faces that were given.
    const std::vector<std::size_t> &order() const { return order_; }
    const NumberedFace &numbered(std::size_t face) const { return numbered_[face]; }
    /// The first face of each block, and the number of faces.
    const std::vector<std::size_t> &blocks() const { return blocks_; }
    double volume_of_vertex() const { return of_vertex_; } ///< mean volume of the mesh per vertex
    double volume_of_cell() const { return of_cell_; }     ///< and per cell
    std::vector<geometry::Cuboid> boxes() const;

  private:
    void sort(const std::vector<PairFace::Vertices> &places);

    double of_vertex_ = 0, of_cell_ = 0;
    std::vector<std::size_t> order_, blocks_;
    std::vector<PairFace> scaled_;
    std::vector<NumberedFace> numbered_;
  };

  /// The integrals ∬_{F×G} of one potential over a face F and each of the faces G near it.
  class FaceIntegrals
  {
  public:
    /// @param kernel  a part of a SolidKernel
    /// @param largest_jump  of each face: the largest number that multiplies its integrals
    /// @param size_of_pair  the unit of FaceRule::tolerance [1]
    /// @param spacing  of a lattice, or 0 [reaches]
    FaceIntegrals(const PotentialKernel &kernel, FacePotential::Kind kind, const SortedFaces &faces,
                  const std::vector<double> &largest_jump, const FaceRule &rule, double spacing,
                  double size_of_pair)
        : faces_(faces), largest_jump_(largest_jump), potential_(kernel, kind), spacing_(spacing),
          known_(spacing)
    {
      if (rule.is_exact)
        exact_.emplace(kernel, kind, rule.tolerance * size_of_pair);
      else
        by_rule_.emplace(potential_, rule.refinement);
    }

    double diffusion() const { return potential_.diffusion(); }

    /// One for each thread.
    struct Workspace
    {
      std::vector<double> values; ///< of a face and each of those near it
      ExactPairs::Shared shared;
      std::vector<const NumberedFace *> others; ///< near faces whose integrals are not yet known
      std::vector<std::size_t> places;          ///< of these in `values`
      std::vector<ExactPairs::Integral> exact;  ///< their integrals
      FaceRuleUse use;
    };

    /// Prepare shared values for pairs of one of the first faces and one of the second.
    void start(const std::vector<const NumberedFace *> &first,
               const std::vector<const NumberedFace *> &second, Workspace &work) const
    {
      if (exact_)
        work.shared.start(first, second);
    }

    /// work.values[k] = the integral of the face and near[k].
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
    double noted(const NumberedFace &f, const NumberedFace &g, const ExactPairs::Integral &integral,
                 Workspace &work) const
    {
      work.use.error = std::max(work.use.error,
                                integral.error * largest_jump_[f.number] * largest_jump_[g.number]);
      return integral.value;
    }

    /// @return  whether both are faces of a lattice
    bool find_repeated(const NumberedFace &f, const NumberedFace &g, Workspace &work,
                       double &value) const
    {
      const auto places = places_on_lattice(*f.face, *g.face, spacing_);
      if (!places)
        return false;
      const auto [integral, is_new] = known_.find(
          *places, [this](const PairFace &x, const PairFace &y) { return (*exact_)(x, y); });
      if (is_new)
        ++work.use.n_pairs[integral.level];
      value = noted(f, g, integral, work);
      return true;
    }

    const SortedFaces &faces_;
    const std::vector<double> &largest_jump_;
    FacePotential potential_;
    double spacing_; ///< [reaches]
    std::optional<FacePairs> by_rule_;
    std::optional<ExactPairs> exact_;
    TranslatedPairs<ExactPairs::Integral> known_;
  };

  /// Integrals of the parts of a kernel over pairs of faces, each pair once, block by block: for
  /// each face F those with all faces G within reach that do not come before F. Thread safe.
  class FaceSweep
  {
  public:
    /// @param kind          of the potential
    /// @param size_of_pair  m₀ times it has the size of a diagonal entry, divided by the jumps of
    /// both faces: the unit of FaceRule::tolerance
    /// @param largest_jump  of each sorted face
    /// @param is_needed     of each sorted face; pairs of two faces that are not needed are left
    /// out
    FaceSweep(const SortedFaces &faces, const SolidKernel &kernel, FacePotential::Kind kind,
              const FaceRule &rule, double size_of_pair, std::vector<double> largest_jump,
              std::vector<char> is_needed);

    std::size_t n_parts() const { return integrals_.size(); }
    /// κ of each part; 0 for a second part that does not exist.
    std::array<double, 2> diffusion() const;
    bool is_needed(std::size_t face) const { return is_needed_[face] != 0; }

    /// One for each thread.
    struct Workspace
    {
      std::vector<unsigned int> near;
      std::array<FaceIntegrals::Workspace, 2> of_parts;

      /// The integral of each part over the current face and the k-th of those near it.
      std::array<double, 2> values(std::size_t k) const;
      void add_use(FaceRuleUse &total) const; ///< of pairs
    };

    /// Called for each face of a block; the workspace has its integrals with those near it.
    using Action = std::function<void(std::size_t face, const std::vector<unsigned int> &near)>;
    void for_each_face(std::size_t block, Workspace &work, const Action &action) const;

  private:
    void find_candidates(std::size_t first, std::size_t last, Workspace &work) const;
    bool are_partners(std::size_t face, std::size_t other) const;

    const SortedFaces &faces_;
    std::vector<double> largest_jump_;
    std::vector<char> is_needed_;
    std::vector<std::unique_ptr<const FaceIntegrals>> integrals_; ///< of each part
    geometry::BoxSearch<3> search_;
  };

  /// Blocks in groups of some n_at_once faces: the rows of a group's faces, whose blocks threads
  /// share, then add(rows, first, last) for its faces first ... last - 1.
  /// @tparam Rows  has a FaceRow, a Workspace, blocks() and add_block()
  template <class Rows, class Add>
  FaceRuleUse for_each_group(const Rows &of_face, std::size_t n_at_once, const Add &add)
  {
    const std::vector<std::size_t> &blocks = of_face.blocks();
    std::mutex mutex;
    FaceRuleUse total;
    std::vector<typename Rows::FaceRow> rows;
    for (std::size_t first = 0, last = 0; first + 1 < blocks.size(); first = last)
    {
      while (last + 1 < blocks.size() &&
             (last == first || blocks[last + 1] - blocks[first] <= n_at_once))
        ++last;
      rows.assign(blocks[last] - blocks[first], {});
      dealii::parallel::apply_to_subranges(
          first, last,
          [&](std::size_t begin, std::size_t end)
          {
            typename Rows::Workspace work;
            for (std::size_t block = begin; block < end; ++block)
              of_face.add_block(block, &rows[blocks[block] - blocks[first]], work);
            const std::lock_guard<std::mutex> lock(mutex);
            work.add_use(total);
          },
          1);
      add(rows, blocks[first], blocks[last]);
    }
    return total;
  }
} // namespace plumbline::reference
