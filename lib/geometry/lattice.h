#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace plumbline::geometry
{
  using dealii::Point;

  struct Box
  {
    Point<2> lower, upper; ///< [length]
  };

  /// A union of boxes, minus other boxes.
  struct Domain
  {
    std::vector<Box> include, exclude;
  };

  /// The square cells of Ω: those cells of a uniform lattice over the bounding box that a domain
  /// covers. Everything outside Ω within reach of the horizon is the interaction collar.
  class Lattice
  {
  public:
    /// @throws InputError  h <= 0; a box whose sides are not multiples of h apart; an empty domain
    Lattice(const Domain &domain, double h);

    /// Its cells cut into n × n.
    Lattice refined(int n) const;

    double h() const { return h_; }
    const Point<2> &origin() const { return origin_; }       ///< lower corner of cell (0,0)
    const std::array<int, 2> &n_cells() const { return n_; } ///< of the bounding box
    bool is_inside(int i, int j) const;                      ///< cell (i,j) lies in Ω
    bool is_rectangle() const;                               ///< Ω fills its bounding box
    Point<2> point(double s, double t) const;                ///< origin + h (s, t)

  private:
    double h_;
    Point<2> origin_;
    std::array<int, 2> n_;
    std::vector<char> inside_; ///< shape (n_[1], n_[0])
  };

  /// How one family of degrees of freedom sits on the lattice along one axis.
  struct AxisSpecies
  {
    double offset = 0;       ///< position in its cell, in [0, 1]
    bool at_vertex = false;  ///< shared by the cells on both sides (offset 0), not owned by one
    unsigned int mirror = 0; ///< the family it turns into when the axis is reversed
  };

  /// Degrees of freedom on a lattice: tensor-product families, each at positions (i, j) of a box of
  /// extents n; block index = component · n_families + family, family = s1 + s2 · axis.size().
  /// Vectors over a NodeSet have shape (n_blocks, n[1], n[0]) and vanish where nothing is free.
  struct NodeSet
  {
    std::vector<AxisSpecies> axis;
    unsigned int n_components = 1;
    std::array<int, 2> n{};
    std::vector<char> is_free; ///< shape (n_families, n[1], n[0]): the support lies in Ω

    unsigned int n_families() const { return static_cast<unsigned int>(axis.size() * axis.size()); }
    unsigned int n_blocks() const { return n_components * n_families(); }
    std::size_t n_positions() const { return static_cast<std::size_t>(n[0]) * n[1]; }
    std::size_t size() const { return n_blocks() * n_positions(); }
    std::size_t n_unknowns() const;                     ///< free degrees of freedom, all components
    bool free(unsigned int family, int i, int j) const; ///< false outside the box as well

    /// Where family s sits at position (i, j), in cells from the origin.
    Point<2> place(unsigned int family, int i, int j) const;
  };

  /// All degrees of freedom whose support lies in Ω: a family at a vertex along an axis needs the
  /// cells on both sides, every other family its own cell.
  NodeSet free_nodes(const Lattice &lattice, std::vector<AxisSpecies> axis,
                     unsigned int n_components);

  /// A range of cells [lower, upper) per axis.
  struct CellRange
  {
    std::array<int, 2> lower, upper;
  };

  /// The largest rectangles of cells in Ω: each lies in Ω and in no larger one. They cover Ω and
  /// overlap.
  std::vector<CellRange> maximal_rectangles(const Lattice &lattice);
} // namespace plumbline::geometry
