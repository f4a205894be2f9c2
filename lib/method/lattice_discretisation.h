#pragma once

#include "method/discretisation.h"
#include "method/linear_equations.h"
#include "method/method.h"

namespace plumbline::method
{
  /// A stencil on the free nodes.
  /// @param mass  of the nodes of each family [length^2], or 1 where all are alike
  DiscreteOperator make_discrete_operator(const geometry::Lattice &lattice,
                                          const geometry::NodeSet &nodes,
                                          const algebra::Stencil &stencil,
                                          const std::vector<double> &mass);

  /// The places of the free nodes, family by family.
  std::vector<dealii::Point<2>> free_points(const geometry::Lattice &lattice,
                                            const geometry::NodeSet &nodes);

  /// A translation-invariant problem on a lattice, as both sides have it: one stencil for all
  /// nodes, the constraint on those that are not free. A state has the shape of the NodeSet.
  class LatticeDiscretisation : public Discretisation, public HasLinearEquations<2>
  {
  public:
    /// @param mass  as above
    LatticeDiscretisation(const problem::Problem<2> &problem, geometry::NodeSet nodes,
                          algebra::Stencil stencil, std::vector<double> mass);

    std::size_t n_unknowns() const override { return nodes_.n_unknowns(); }
    CaseData data(const problem::Problem<2> &problem) const override;
    std::unique_ptr<algebra::LinearSystem> tangent() const override;
    LinearEquations<2> equations(const problem::Problem<2> &problem) const override;

    /// Rows are there up to 2e7 entries.
    DiscreteOperator matrix() const override
    {
      return make_discrete_operator(lattice_, nodes_, stencil_, mass_);
    }

    std::optional<algebra::WaveOperator> waves() const override;
    std::unique_ptr<EquationOfMotion> motion(bool is_lumped) const override;

  protected:
    const geometry::Lattice &lattice() const { return lattice_; }
    const geometry::NodeSet &nodes() const { return nodes_; }
    const algebra::Stencil &stencil() const { return stencil_; }

  private:
    virtual Vector
    load(const problem::Problem<2> &problem) const = 0; ///< over the nodes, 0 if not free

    /// Row i states the equation at node i; else rows are tested by shape functions.
    virtual bool is_collocated() const { return true; }

    /// The mass matrix; the masses of the families unless a method has a consistent one.
    virtual algebra::Stencil mass_stencil() const;

    /// @param values  solution and, around it, the constraint at positions -1 ... n of each axis:
    /// shape (n_blocks, n[1] + 2, n[0] + 2)
    virtual Field field(std::vector<double> values) const = 0;

    geometry::Lattice lattice_;
    geometry::NodeSet nodes_;
    algebra::Stencil stencil_;
    std::vector<double> mass_;
    algebra::OperatorBackend backend_;
  };

  /// Memory of its static solution at the peak [bytes]: vectors, symbols of transforms on lengths
  /// that the reach pads, the stencil and a family. Measured on 13 methods and scenes: .6 to 1.2 of
  /// it.
  /// @param n_families  of nodes on each cell
  /// @param reach       of the stencil [cells]
  double expected_lattice_bytes(const ProblemSize &size, unsigned int n_families,
                                unsigned int n_components, double reach);
} // namespace plumbline::method
