#pragma once

#include "reference/mesh/cell_products.h"
#include "reference/mesh/cell_rules.h"
#include "reference/mesh/edge_pairs.h"
#include "reference/mesh/pair_blocks.h"
#include "reference/mesh/side_traces.h"
#include "reference/mesh/space.h"

#include <memory>
#include <unordered_map>

namespace plumbline::reference
{
  /// Blocks of pairs of cells with a scalar kernel or a bond tensor, its profile without breaks (a
  /// kernel with breaks is a sum of such ones, see Kernel::parts), exact to rounding: of triangles
  /// with shape functions of degree 2 at most, of parallelograms with bilinear ones, of any convex
  /// quadrilaterals with constants; sides of triangles may follow curves, see MeshCells. By Green's
  /// identity in x and in y, for polynomials p and q,
  ///   ∬_{T×T', |x-y|<δ} C p(x) q(y) = Σ_{m,n} ∮_∂T ∮_∂T' (Δ^m p ∂_nx - ∂_n Δ^m p)
  ///     (Δ^n q ∂_ny - ∂_n Δ^n q) Ψ_{2+m+n}(y - x), Δ^k Ψ_k = C,
  /// with the potentials cut off at the circle, or what lies beyond it taken from all of the pair.
  /// Pairs that are whole take rules where the kernel is a polynomial of ξ to rounding, or they are
  /// apart. Accuracy, of C |T| |T'| / 9 for degree 1 at most: 1e-11 where neither is
  /// slender, 2.5e-12 for δ >= 4 h, 1e-9 to where slender ones are left to quadrature; for degree 2
  /// 2e-11, and 1e-9 for kernels that are no polynomials of ξ (10,000 pairs of moved meshes, δ = .7
  /// to 5.5 h, against integrals in long double: 2e-12 and 2e-10); parallelograms with bilinear
  /// functions as triangles of degree 2. Not thread safe: give each thread its own copy.
  class PolygonPairs
  {
  public:
    /// Empty if this way is open to a space and all parts of a kernel, else why it is not.
    static std::string refuse(const MeshSpace &space, const physics::Kernel<2> &kernel);

    PolygonPairs(const MeshSpace &space, const MeshCells &cells, const physics::Kernel<2> &kernel);

    /// The shape functions of both are polynomials, and neither is so slender that terms are much
    /// larger than their sum.
    bool is_exact(std::size_t a, std::size_t b) const;

    /// Which pairs are not exact, in words; empty: all are.
    std::string exceptions() const;

    void integrate(std::size_t outer, std::size_t inner, PairBlocks &blocks);

  private:
    struct Side
    {
      unsigned int edge = 0;
      bool is_forward = true; ///< runs as the edge does
    };
    /// The functions of a cell on its sides.
    struct Traces
    {
      std::vector<double> sign; ///< of outer normals in terms of the edges'
      std::vector<std::vector<SideTrace>> of;
    };
    /// What all threads read.
    struct Shared
    {
      Shared(const MeshSpace &space, const MeshCells &cells, const physics::Kernel<2> &kernel);

      void find_traces(const MeshSpace &space, const MeshCells &cells, std::size_t cell,
                       Traces &of_cell) const;
      const UnitProducts &rule(unsigned int degree) const { return rules[degree / 2]; }

      std::vector<Segment> edges;
      std::vector<std::vector<Side>> sides;    ///< of each cell
      std::size_t most_sides = 0;              ///< of a cell
      std::vector<char> is_slender, is_mapped; ///< cells; mapped: shapes that are no polynomials
      std::vector<UnitProducts> rules;         ///< index i is exact to degree 2 i + 1
      SideTraces traces;
      std::unordered_map<std::size_t, Traces> of_curved; ///< cells, which cost more
      std::unique_ptr<EdgePairs<1>> scalar;              ///< one of both
      std::unique_ptr<EdgePairs<3>> tensor;
    };
    enum class Part : char
    {
      in,
      out,
      whole
    };

    const EdgeMoments *moments(std::size_t side, unsigned int edge, Part part);
    void find_traces(std::size_t cell, Traces &own) const;
    const Traces &traces(std::size_t cell, const Traces &own) const;
    void add_sides(std::size_t inner, Part part, double factor, PairBlocks &blocks);
    void find_products(std::size_t cell, unsigned int degree, CellProducts &products) const;
    void take_own_functions(std::size_t outer, std::size_t inner, PairBlocks &blocks) const;
    void add_whole(std::size_t outer, std::size_t inner, PairBlocks &blocks);
    void mirror(PairBlocks &blocks) const;
    void find_components(PairBlocks &blocks) const;
    std::size_t place(unsigned int a, unsigned int b, unsigned int entry) const
    {
      return (static_cast<std::size_t>(a) * n_ + b) * n_entries_ + entry;
    }

    const MeshSpace &space_;
    const MeshCells &cells_;
    physics::Kernel<2> kernel_;
    std::shared_ptr<const Shared> shared_;
    unsigned int n_, degree_;         ///< shape functions, and their degree in all
    unsigned int n_entries_;          ///< of the kernel, see EdgePairs
    std::size_t outer_;               ///< whose sides' moments are kept
    std::vector<EdgeMoments> kept_;   ///< shape (n kept, n_entries)
    std::vector<unsigned int> place_; ///< in kept_, of each edge, side of outer_ and part; 0: none
    std::vector<std::size_t> used_;
    Traces of_outer_, of_inner_; ///< those of cells with straight sides
    CellProducts products_of_x_, products_of_y_;
  };
} // namespace plumbline::reference
