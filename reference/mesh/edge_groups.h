#pragma once

#include "geometry/search.h"
#include "reference/mesh/edge_form.h"
#include "reference/mesh/edge_integrals.h"

#include <cstdint>

namespace plumbline::reference
{
  geometry::Box box_about(const Point<2> &x, double radius);
  geometry::BoxSearch<2> search_points(const std::vector<Point<2>> &points);

  /// What edges with one first end give to rows of their nodes.
  struct EdgeGroup
  {
    std::vector<unsigned int> rows, columns; ///< nodes, ascending
    std::vector<double> values;              ///< shape (n_rows, n_columns, n entries)
    std::uint64_t n_pairs = 0;               ///< of edges that were integrated
  };

  /// Sums over pairs of edges, Σ_{e,f} J_i(e) J_j(f) D(e, f), each pair once and an edge with
  /// itself by half, so that the sum and its transpose are all pairs. Thread safe.
  /// @tparam n  entries, see Potentials
  template <unsigned int n>
  class EdgeGroups
  {
  public:
    EdgeGroups(const MeshSpace &space, const EdgeForm &form, const PairWays &ways,
               const typename EdgeIntegrals<n>::Tables &potential, const WholePotential &whole);

    /// Q, as far as it was asked for.
    struct Known
    {
      Wanted has;
      Potentials<n> value;
    };

    /// A worker's own memory.
    struct Scratch
    {
      std::vector<unsigned int> near, found;  ///< edges
      std::vector<unsigned int> slot;         ///< of each node among the columns
      std::vector<Known> from_start, to_edge; ///< Q of near edges, of columns
      std::vector<Potentials<n>> sums;        ///< Σ J D of columns
      std::vector<PairWay> ways;              ///< shape (n_rows, n_columns)
      std::vector<unsigned char> edge_ways;   ///< of an edge's nodes: bits by PairWay
    };

    /// The pairs of edges first ... last - 1, which have their first end in common, with later
    /// ones. @param group  overwritten
    void integrate(std::size_t first, std::size_t last, Scratch &scratch, EdgeGroup &group) const;

  private:
    bool is_near(const Edge &e, const Edge &f) const;
    Wanted wanted(const Edge &e, const Edge &f, const Scratch &scratch) const;
    const Potentials<n> &ask(Known &known, const Point<2> &v, const Edge &e,
                             const Wanted &wanted) const;
    void find_near(std::size_t first, std::size_t last, Scratch &scratch) const;
    void find_nodes(std::size_t first, std::size_t last, Scratch &scratch, EdgeGroup &group) const;
    void find_ways(const EdgeGroup &group, Scratch &scratch) const;
    void sum_partners(std::size_t e, EdgeGroup &group, Scratch &scratch) const;
    void add_rows(const Edge &edge, EdgeGroup &group, const Scratch &scratch) const;

    const MeshSpace &space_;
    const EdgeForm &form_;
    const PairWays &ways_;
    double horizon_, largest_radius_ = 0;
    bool has_inside_; ///< the whole potential is not zero there
    EdgeIntegrals<n> integrals_;
    geometry::BoxSearch<2> middles_;
  };
} // namespace plumbline::reference
