#pragma once

#include "analysis/statics.h"
#include "study/results.h"

#include <map>

namespace plumbline::study
{
  using analysis::Solution;

  /// P_κ of a field: its averages over the comparison cells, shape (n_cells, n_components). By
  /// exact integration of the field's series, or 6 × 6 Gauss points on each quarter of a cell.
  std::vector<double> cell_averages(const problem::Field<2> &field,
                                    const geometry::Lattice &lattice,
                                    const geometry::NodeSet &cells);

  /// The same over the cells of scattered nodes: by a rule of degree 9 on each piece.
  std::vector<double> cell_averages(const problem::Field<2> &field,
                                    const geometry::NodeCells<2> &cells, unsigned int n_components);

  /// Over whichever cells the problem is compared on.
  std::vector<double> cell_averages(const problem::Field<2> &field,
                                    const problem::Problem<2> &problem);

  /// The node of each comparison cell.
  std::vector<dealii::Point<2>> comparison_points(const problem::Problem<2> &problem);

  /// Of a comparison cell [length^2].
  double cell_area(const problem::Problem<2> &problem, std::size_t cell);

  /// Of Ω that each node stands for: all of them alike [length^2].
  double node_area(const problem::Problem<2> &problem, const Solution &solution);

  /// Averages over the comparison cells at h from averages over the lattice cells at h/2, which
  /// each square of side h is made of four of.
  /// @param fine  shape (n_fine_cells, n_components), of the lattice of h/2 with nodes at its
  /// centres
  std::vector<double> coarsen_averages(const std::vector<double> &fine,
                                       const geometry::NodeSet &fine_cells,
                                       const geometry::NodeSet &cells);

  /// √(Σ area |a - b|²): the L2 distance of two fields that are constant on the comparison cells.
  double averages_l2(const problem::Problem<2> &problem, const std::vector<double> &a,
                     const std::vector<double> &b);

  /// A field by its values.
  using Values = std::function<double(const dealii::Point<2> &, unsigned int component)>;

  /// The L2 distance of two fields over Ω, by a rule on each cell of the problem's lattice or mesh.
  /// @param degree  that the rule is exact to on each cell; 2 p for fields of degree p there
  double field_l2(const problem::Problem<2> &problem, const Values &a, const Values &b,
                  unsigned int degree);

  /// Cell averages that solutions are held against, each empty if there is none.
  struct Targets
  {
    std::vector<double> reference;
    std::vector<double> local; ///< of the local limit where it is computed
  };

  /// Cells along a side of a block of error maps, of which there are at most 32 along an axis: a
  /// divisor of both extents if there is a near one.
  int cells_per_block(const std::array<int, 2> &n);

  /// What maps show of solutions: in each block the mean of u, of |u| if it is a vector.
  class BlockMeans
  {
  public:
    explicit BlockMeans(std::size_t n_blocks) : sum_(n_blocks), n_(n_blocks) {}

    /// @param u  at a place of the block, n_components numbers
    void add(std::size_t block, const double *u, unsigned int n_components);

    /// NaN where a block has no place.
    /// @param ranks  each of which added its own places
    std::vector<double> means(const base::Communicator &ranks = base::Communicator::alone()) const;

  private:
    std::vector<double> sum_, n_;
  };

  /// The errors of nodal values, if the decisive error is nodal, or else of cell averages against
  /// the exact solution, or else other averages: the largest in each of at most 32 × 32 blocks of
  /// cells; and the same values of the solution itself.
  /// @param decisive  the norm
  ErrorMap error_map(scene::Norm decisive, const problem::Problem<2> &problem,
                     const Solution &solution, const std::vector<double> &target);

  /// The errors of a solution in these norms against every target there is, by "norm |
  /// target". Linf takes the largest component; nodal values are at the method's own nodes; field
  /// norms take 3 × 3 Gauss points on each quarter of a lattice cell, a rule of degree 9 on a cell
  /// of a mesh.
  std::map<std::string, double> errors(const std::vector<scene::Norm> &norms,
                                       const problem::Problem<2> &problem, const Solution &solution,
                                       const Targets &targets);
} // namespace plumbline::study
