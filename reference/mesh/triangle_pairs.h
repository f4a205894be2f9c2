#pragma once

#include "reference/mesh/cells.h"
#include "reference/mesh/edge_pairs.h"
#include "reference/mesh/pair_blocks.h"
#include "reference/mesh/shape_rules.h"
#include "reference/mesh/space.h"

#include <memory>

namespace plumbline::reference
{
  /// Blocks of pairs of triangles with a scalar kernel of powers and shape functions p, q up to
  /// degree 1, exact to rounding: by Green's identity in x and in y,
  ///   ∬_{T×T', |x-y|<δ} C p(x) q(y) = ∮_∂T ∮_∂T' (p ∂_nx - ∂_n p) (q ∂_ny - ∂_n q) Ψ(y - x),
  ///   ∬ C p(x) = ∮∮ (p ∂_nx - ∂_n p) ∂_ny Ψ + Δp ∮∮ ∂_nx ∂_ny Ψ₃ for p of degree 2, Δ²Ψ = C,
  /// with the potential cut off at the circle, or what lies beyond it taken from all of the pair.
  /// Accuracy, of C |T| |T'|: 1e-11 where neither is slender, 1e-13 for δ >= 4 h.
  /// Not thread safe: give each thread its own copy.
  class TrianglePairs
  {
  public:
    /// Empty if this way is open to a space and a kernel, else why it is not.
    static std::string refuse(const MeshSpace &space, const physics::Kernel<2> &kernel);

    TrianglePairs(const MeshSpace &space, const MeshCells &cells, const physics::Kernel<2> &kernel);

    /// Neither is so slender that terms are much larger than their sum.
    bool is_exact(std::size_t a, std::size_t b) const;

    void integrate(std::size_t outer, std::size_t inner, PairBlocks &blocks);

  private:
    struct Side
    {
      unsigned int edge = 0;
      bool is_forward = true; ///< runs as the edge does
    };
    /// What all threads read.
    struct Shared
    {
      Shared(const MeshSpace &space, const MeshCells &cells, const physics::Kernel<2> &kernel);

      const ShapeRule &rule(unsigned int degree) const { return rules[degree / 2]; }

      std::vector<Segment> edges;
      std::vector<std::array<Side, 3>> sides; ///< of each cell
      std::vector<char> is_slender;           ///< cells
      std::vector<ShapeRule> rules;           ///< index i is exact to degree 2 i + 1
      std::unique_ptr<EdgePairs> pairs;
    };
    /// The polynomials of a cell along one of its sides: values at the ends, and the derivative
    /// along the outer normal times the length.
    struct Trace
    {
      double sign = 1; ///< of the outer normal in terms of the edge's
      std::array<double, 3> start{}, change{}, normal{};
    };
    enum class Part : char
    {
      in,
      out,
      whole
    };

    const EdgeMoments &moments(unsigned int side, unsigned int edge, Part part);
    std::array<Trace, 3> traces(std::size_t cell) const;
    void add_sides(std::size_t outer, std::size_t inner, Part part, double factor,
                   PairBlocks &blocks);
    void add_product(std::size_t outer, std::size_t inner, PairBlocks &blocks) const;
    void add_by_rule(std::size_t outer, std::size_t inner, const ShapeRule &rule,
                     PairBlocks &blocks) const;
    void add_whole(std::size_t outer, std::size_t inner, PairBlocks &blocks);

    const MeshSpace &space_;
    const MeshCells &cells_;
    physics::Kernel<2> kernel_;
    std::shared_ptr<const Shared> shared_;
    unsigned int n_;    ///< shape functions
    std::size_t outer_; ///< whose sides' moments are kept
    struct Kept
    {
      EdgeMoments moments;
      bool is_known = false;
    };
    std::vector<std::array<Kept, 3>> kept_;
    std::vector<unsigned int> place_; ///< in kept_, of each side of outer_ and edge; 0: none
    std::vector<std::size_t> used_;
  };
} // namespace plumbline::reference
