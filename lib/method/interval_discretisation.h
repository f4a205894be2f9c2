#pragma once

#include "algebra/linear_system.h"
#include "geometry/lattice.h"
#include "method/diagnostics.h"
#include "problem/on_line.h"

#include <deal.II/lac/vector.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace plumbline::method
{
  /// A solution on intervals, the same view for both families of methods.
  struct FieldOnLine
  {
    std::vector<double> nodes;             ///< coordinates of the method's own free nodes [length]
    std::vector<double> nodal;             ///< values there
    std::vector<double> averages;          ///< over the cells of Ω
    std::function<double(double x)> value; ///< u in the closed domain Ω
  };

  /// Nodes and values there by x, in 17 digits.
  /// @throws InputError  the file cannot be written
  void write_csv(const FieldOnLine &field, const std::string &file);

  /// Values of all families at positions -1 ... n, solution and constraint together.
  struct LineValues
  {
    int n = 0;
    std::vector<double> values; ///< shape (n_families, n + 2)

    double at(unsigned int family, int i) const
    {
      return values[family * (static_cast<std::size_t>(n) + 2) + static_cast<std::size_t>(i + 1)];
    }
  };

  /// A problem on intervals, as both families of methods have it: one stencil for all nodes, the
  /// constraint on those that are not free; the counterpart of BoxDiscretisation. A state has
  /// shape (n_families, n_cells of the hull).
  class IntervalDiscretisation
  {
  public:
    using Vector = algebra::Vector;

    /// @throws InputError  no node is free
    IntervalDiscretisation(const problem::Problem<1> &problem,
                           std::vector<geometry::AxisSpecies> families, algebra::Stencil stencil);
    virtual ~IntervalDiscretisation() = default;

    std::size_t n_unknowns() const;

    /// What one case brings: its load less what the constraint adds to the force.
    struct Data
    {
      Vector load;
      std::function<FieldOnLine(const Vector &u)> field;
    };
    Data data(const problem::Problem<1> &problem) const;

    /// One family of nodes: conjugate gradients on the operator of Solver/operator, preconditioned
    /// by sine transforms. Several: BandedSystem.
    /// @throws NumericalError  the stencil is not symmetric or not positive definite
    /// @throws InputError      Solver/operator = fft or sparse where there is none
    std::unique_ptr<algebra::LinearSystem> tangent() const;

    virtual Diagnostics diagnostics() const = 0;

    const algebra::Stencil &stencil() const { return stencil_; }

  protected:
    const geometry::IntervalLattice &lattice() const { return lattice_; }
    const std::vector<geometry::AxisSpecies> &families() const { return families_; }
    bool is_free(unsigned int family, int i) const; ///< false outside the hull
    double place(unsigned int family, int i) const; ///< its coordinate [length]
    double place_of_data(unsigned int family, int i) const;

  private:
    /// Whether a value there enters an equation, or an average over a cell.
    bool is_needed(unsigned int family, int i) const;

    /// Over the nodes, 0 where they are not free.
    virtual Vector load(const problem::Problem<1> &problem) const = 0;

    /// At s in [0, 1] of a cell.
    virtual double value_in(int cell, double s, const LineValues &values) const = 0;

    virtual double average_over(int cell, const LineValues &values) const = 0;

    /// The constraint at positions -reach - 1 ... n + reach of each family, less the middle of its
    /// range, which the operator does not see; 0 where nodes are free, or Ω is far away.
    struct Surroundings
    {
      int margin = 0;
      std::vector<double> values; ///< shape (n_families, n + 2 margin)
      double middle = 0;
    };
    Surroundings surroundings(const problem::Problem<1> &problem) const;
    FieldOnLine field(const Vector &u, const Surroundings &around) const;

    geometry::IntervalLattice lattice_;
    std::vector<geometry::AxisSpecies> families_;
    algebra::Stencil stencil_;
    std::vector<char> is_free_; ///< shape (n_families, n_cells)
    algebra::OperatorBackend backend_;
  };

  /// A method that solves problems on intervals.
  class MethodOnIntervals
  {
  public:
    virtual ~MethodOnIntervals() = default;

    /// Empty if the method can do them with this kernel, else why not.
    virtual std::string why_not_on_intervals(const physics::Kernel<1> &kernel) const = 0;

    /// @pre  why_not_on_intervals() of the kernel is empty
    virtual std::unique_ptr<IntervalDiscretisation>
    discretise_on_intervals(const problem::Problem<1> &problem) const = 0;
  };
} // namespace plumbline::method
