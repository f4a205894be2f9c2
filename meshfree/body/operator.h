#pragma once

#include "algebra/convolution.h"
#include "algebra/operator.h"
#include "algebra/solve.h"
#include "meshfree/body/body.h"
#include "meshfree/body/sums.h"
#include "meshfree/rules/bonds.h"

#include <variant>

namespace plumbline::meshfree
{
  /// An operator on the fields of a body, with its solver.
  class BodyOperator : public algebra::Operator
  {
  public:
    virtual const VariationalBody &body() const = 0;

    /// Solve B u = f at the free nodes from u.
    /// @param tolerance  of the residual's Euclidean norm, relative to f's; of iterations alone
    /// @throws NumericalError  no solution
    virtual algebra::SolveResult solve(algebra::Vector &u, const algebra::Vector &f,
                                       double tolerance, unsigned int max_iterations) const = 0;
  };

  /// The family of all nodes of a lattice body by the weights of a rule.
  /// @throws InputError  as VariationalOperator
  std::vector<Neighbour> make_family(const VariationalBody &body, const Kernel<2> &influence,
                                     const Bonds<2> &bonds);

  /// The one-point meshfree form of a variational state-based solid in 2D,
  ///   uᵀBu = Σ_i V_i [τ_i T_i² + α_i Σ_j V_j w_ij ρ_ij (d·(u_j - u_i))²/r²],  d = x_j - x_i,
  ///   T_i = Σ_j V_j w_ij ρ_ij d·(u_j - u_i),  τ = (4k - l)/m²,  α = l/m,  m_i = Σ_j V_j w_ij ρ_ij
  ///   r²,
  /// on families that end where the body does. w = weight/h² of a lattice rule's whole cells, ρ is
  /// taken at the bond's kernel point. Symmetric; positive definite if something is fixed, also for
  /// τ < 0; else its zero modes are the three rigid motions. Bond-based if l = 4k.
  /// Matrix-free: memory O(unknowns), time O(unknowns × bonds) or by transforms.
  /// Source: Pflug, Stingl & Zetzmann 2026, "On the convergence of the discretized linear static
  /// state-based peridynamic equations", eqs. (16)-(23).
  class VariationalOperator : public BodyOperator
  {
  public:
    /// @param influence  ρ, up to a constant factor
    /// @param bonds      of a rule on a lattice of the body's h
    /// @throws InputError  k <= 0, l <= 0 or V outside [0, h²] at a node, another h,
    /// OperatorBackend::sparse
    /// @throws NumericalError  a node without neighbours
    VariationalOperator(VariationalBody body, const Kernel<2> &influence, const Bonds<2> &bonds,
                        algebra::OperatorBackend backend = algebra::OperatorBackend::automatic);

    void vmult(algebra::Vector &result, const algebra::Vector &input) const override;
    std::string backend() const override;
    std::uint64_t n_bonds() const override;

    /// uᵀBu by its form above, bond by bond.
    double energy(const algebra::Vector &u) const;

    const VariationalBody &body() const override { return body_; }
    /// By conjugate gradients, see the function below.
    algebra::SolveResult solve(algebra::Vector &u, const algebra::Vector &f, double tolerance,
                               unsigned int max_iterations) const override;
    const std::vector<Neighbour> &family() const { return family_; }

  private:
    void sum(std::vector<double> &output) const; ///< over all bonds, of input_

    VariationalBody body_;
    std::vector<Neighbour> family_;
    std::variant<algebra::Convolution, DirectSums> sums_;
    std::vector<double> tau_, alpha_;        ///< shape (n[1], n[0]), as all that follow
    std::array<std::vector<double>, 2> g_;   ///< Σ V_j w ρ d
    std::array<std::vector<double>, 3> own_; ///< Σ (α_i + α_j) V_j w ρ d⊗d/r²: 00, 01, 11
    mutable std::vector<double> input_, bonds_, forces_; ///< shape (3, n[1], n[0])
  };

  /// Solve B u = f at the free nodes by conjugate gradients from u, preconditioned component by
  /// component with sines and cosines on the rectangle around the free nodes: zero at sides beyond
  /// which nodes are fixed, mirrored at others, and scaled where cells are cut or l varies. On a
  /// homogeneous box that is constrained at a side the number of iterations does not depend on h.
  /// @param tolerance  of the residual's Euclidean norm, relative to f's
  /// @throws NumericalError  as algebra::solve
  algebra::SolveResult solve(const VariationalOperator &matrix, algebra::Vector &u,
                             const algebra::Vector &f, double tolerance,
                             unsigned int max_iterations);
} // namespace plumbline::meshfree
