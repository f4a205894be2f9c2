#pragma once

#include "meshfree/check/bond_outliers.h"

namespace plumbline::meshfree
{
  /// Nodes whose weights are right whatever those of others are: their moments of degree 1 and 2
  /// are exact, to rounding of the files. Around a node that is moved or missing such weights
  /// differ from those elsewhere.
  template <int dim>
  class ExactFamilies
  {
  public:
    explicit ExactFamilies(const GivenBonds<dim> &given);

    /// Takes out what is said of such nodes, or of weights to a node that only such nodes have.
    void acquit(std::vector<Outlier<dim>> &outliers) const;

  private:
    bool is_right(const Outlier<dim> &outlier) const;

    std::vector<bool> is_exact_;       ///< shape (n_families)
    std::vector<bool> is_to_by_exact_; ///< all bonds to a node are those of exact families, shape
                                       ///< (n_nodes)
  };
} // namespace plumbline::meshfree
