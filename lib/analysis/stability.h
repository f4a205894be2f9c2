#pragma once

#include "algebra/eigenvalues.h"
#include "algebra/spectrum.h"
#include "method/diagnostics.h"
#include "method/discrete_operator.h"
#include "problem/in_space.h"
#include "problem/problem.h"

namespace plumbline::analysis
{
  /// Fields of a discrete operator.
  struct Modes
  {
    unsigned int n_components = 1, dimension = 2;
    std::vector<dealii::Point<3>> nodes;     ///< z = 0 in the plane [length]
    std::vector<std::vector<double>> values; ///< of each, shape (n_nodes, n_components)
  };

  /// How stable a discrete operator A is, in the discrete L2 inner product (u, v) = Σ m_i u_i v_i;
  /// eigenvalues are those of M^(-1/2) A M^(-1/2) [unit of the operator: b / u].
  struct Stability
  {
    std::size_t n_unknowns = 0;
    bool is_collocated = true; ///< row i of A states the equation at node i
    double smallest = 0;       ///< eigenvalue of the symmetric part: the coercivity constant
    double largest = 0;        ///< from above, to 1e-4: what critical time steps are made of
    unsigned int n_zero = 0;   ///< zero-energy modes, up to algebra::most_zero_modes
    Modes modes;               ///< those, or else the one of the smallest eigenvalue
    /// Of M⁻¹A itself, which differ from those of the symmetric part where A is not symmetric;
    /// n_computed = 0: not known.
    algebra::Eigenvalues eigenvalues;
    bool has_signs = false;   ///< rows are there, so that `signs` is known
    algebra::SignCheck signs; ///< of A
    double inverse_norm = 0; ///< ‖A⁻¹M‖∞: how far u moves at most by b of size 1; 0: not known
    bool is_norm_exact = false;           ///< else it is a lower bound, near it as a rule
    method::Diagnostics diagnostics = {}; ///< weights, moments; not `measure`'s to know

    /// "3", or "12 or more".
    std::string zero_modes() const
    {
      return std::to_string(n_zero) + (n_zero < algebra::most_zero_modes ? "" : " or more");
    }

    bool is_symmetric() const { return !has_signs || signs.asymmetry < 1e-12; }

    /// Positive definite, the eigenvalues being known up to 1e-10 of the largest.
    bool is_definite() const { return smallest > 1e-10 * largest; }
  };

  /// The norm of the inverse: of an M-matrix by one solve, A u = M 1, exact; else by Hager's
  /// estimator on A⁻ᵀ, a lower bound. Where only A's action is there, rows are made of it up to
  /// 1500 unknowns. Source: Hager 1984, doi:10.1137/0905023; Higham 1988, doi:10.1145/50063.214386.
  /// @throws NumericalError  eigenvalues do not settle
  /// Cost: `algebra::spectrum`, up to 10 solves, and `algebra::eigenvalues` where A is not
  /// symmetric.
  template <int dim>
  Stability measure(const method::DiscreteOperatorOf<dim> &matrix);

  /// What theory asks of an operator.
  struct Consistency
  {
    std::size_t n_inner = 0; ///< nodes that nothing ties to the collar; 0: `degree` is not known
    /// Polynomials up to this degree, at most 4, are mapped there as by the nonlocal operator, to
    /// 1e-8. Not known for Galerkin methods, dilatations and coefficients.
    unsigned int degree = 0;
    /// Of scalar kernels: (a + reach)² / C, a the half-width of the nodes where they are narrower,
    /// C the second moment. It bounds ‖A⁻¹M‖∞ of an M-matrix, since A maps the barrier (a + reach)²
    /// - (x - centre)², which is >= 0 wherever data are given, to C or more; on scattered nodes C
    /// is the least over inner nodes, and the bound as good as that. 0: not known. As reach → δ, h
    /// → 0 this is Yang & Yin's (½ + δ)² / C, also where their lemma 4.2 fails.
    double barrier = 0;
  };

  template <int dim>
  Consistency check_consistency(const method::DiscreteOperatorOf<dim> &matrix,
                                const problem::Problem<dim> &problem);
} // namespace plumbline::analysis
