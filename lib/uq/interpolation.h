#pragma once

#include "uq/sample_points.h"

#include <functional>
#include <map>
#include <optional>

namespace plumbline::uq
{
  /// The interpolant of a rule, J[v](ξ) = Σ_k v(ξ_k) J_k(ξ): of tensor products the Lagrange
  /// polynomials, of Smolyak's rule the same combination of products as of its weights. It is v at
  /// all points of tensor products and of nested grids, but not at every point of other sparse
  /// grids.
  /// Source: Fan et al. 2022, doi:10.1016/j.cma.2022.115340, eqs. (3.6)-(3.9).
  class Interpolant
  {
  public:
    /// @pre as tensor_points, chebyshev_points and smolyak_points
    static Interpolant tensor(const std::vector<Law> &laws, unsigned int n);
    static Interpolant chebyshev(std::size_t n_variables, unsigned int n);
    static Interpolant smolyak(const std::vector<Law> &laws, unsigned int level, Growth growth);

    /// All points that J needs; for Smolyak's rule, also points whose weight is 0. Shape (n,
    /// n_variables), each once.
    const std::vector<std::vector<double>> &points() const { return points_; }

    /// J_k(ξ), shape (n).
    std::vector<double> coefficients(const std::vector<double> &at) const;

    /// Λ = max Σ_k |J_k(ξ)| over [-1, 1]^n_variables: the operator norm of J (sup norm).
    struct Lebesgue
    {
      double found = 1; ///< a maximum that was found, which is Λ to 1e-6 for tensor products
      double bound = 1; ///< that Λ does not exceed: Σ |factor| Π Λ of each variable's points
    };
    /// Of tensor products by the largest value between neighbouring points; else by a search from
    /// the extrema in each variable, so that Λ lies between the two numbers.
    /// @return nothing where a variable is unbounded
    std::optional<Lebesgue> lebesgue() const;

  private:
    using Rule = std::pair<Law, unsigned int>; ///< and its level
    struct Line
    {
      std::vector<double> nodes, weights; ///< barycentric ones

      std::vector<double> values(double x) const; ///< of Lagrange's polynomials
      double sum_of_sizes(double x) const;
      /// Where that is largest, and how large.
      std::pair<double, double> largest() const;
    };
    /// factor times a product of rules.
    struct Product
    {
      double factor = 1;
      std::vector<Rule> rules;
      std::vector<std::size_t> places; ///< into points_, the first variable fastest
    };

    void add(double factor, const std::vector<Rule> &rules,
             const std::function<LineRule(Rule)> &make);
    double sum_of_sizes(const std::vector<double> &at) const;

    std::vector<std::vector<double>> points_;
    std::map<std::vector<double>, std::size_t> place_of_;
    std::map<Rule, Line> lines_;
    std::vector<Product> products_;
  };
} // namespace plumbline::uq
