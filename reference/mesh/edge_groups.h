#pragma once

#include "geometry/search.h"
#include "reference/mesh/edge_form.h"
#include "reference/mesh/edge_integrals.h"

namespace plumbline::reference
{
  geometry::Box box_about(const Point<2> &x, double radius);
  geometry::BoxSearch search_points(const std::vector<Point<2>> &points);

  /// What edges with one first end give to rows of their nodes.
  struct EdgeGroup
  {
    std::vector<unsigned int> rows, columns; ///< nodes, ascending
    std::vector<double> values;              ///< shape (n_rows, n_columns)
  };

  /// Sums over pairs of edges, Σ_{e,f} J_i(e) J_j(f) D(e, f), each pair once and an edge with
  /// itself by half, so that the sum and its transpose are all pairs. Thread safe.
  class EdgeGroups
  {
  public:
    EdgeGroups(const MeshSpace &space, const EdgeForm &form, const PairWays &ways,
               const physics::RadialPotential &potential, const PowerPotential &whole);

    /// A worker's own memory.
    struct Scratch
    {
      std::vector<unsigned int> near, found, slot;       ///< edges; of each node among the columns
      std::vector<Potentials> from_start, to_edge, sums; ///< Q and Σ J D
      std::vector<char> has_edge, ways;
    };

    /// The pairs of edges first ... last - 1, which have their first end in common, with later
    /// ones. @param group  overwritten
    void integrate(std::size_t first, std::size_t last, Scratch &scratch, EdgeGroup &group) const;

  private:
    bool is_near(const Edge &e, const Edge &f) const;
    bool sees_circle(const Edge &e, const Edge &f) const;
    Potentials from_point(const Point<2> &v, const Edge &e) const;
    void find_near(std::size_t first, std::size_t last, Scratch &scratch) const;
    void find_nodes(std::size_t first, std::size_t last, Scratch &scratch, EdgeGroup &group) const;
    void sum_partners(std::size_t e, const EdgeGroup &group, Scratch &scratch) const;
    void add_rows(const Edge &edge, EdgeGroup &group, const Scratch &scratch) const;

    const MeshSpace &space_;
    const EdgeForm &form_;
    const PairWays &ways_;
    double horizon_, largest_radius_ = 0;
    bool has_whole_;
    EdgeIntegrals integrals_;
    geometry::BoxSearch middles_;
  };
} // namespace plumbline::reference
