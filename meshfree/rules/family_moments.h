#pragma once

#include "base/communicator.h"
#include "meshfree/rules/bonds.h"

#include <array>
#include <vector>

// Moments of the weights of families, by which a rule has the right limit or not.
namespace plumbline::meshfree
{
  /// The moments of a kernel's ball that the weights of families are held against. Instantiated for
  /// dim = 1, 2 and 3.
  template <int dim>
  class BallMoments
  {
  public:
    /// @param order  largest |α|, at most 6
    BallMoments(const Kernel<dim> &kernel, unsigned int order);

    /// Σ w C_ab ξ^α less ∫ C_ab ξ^α over the ball for all pairs a <= b and |α| = 1, 2, ..., order,
    /// over the largest exact second moment times horizon^(|α| - 2). Fixed places; of order 2: 5
    /// numbers for scalar kernels, 15 for tensors.
    std::vector<double> defects(const std::vector<Bond<dim>> &family) const;

    /// The largest size of them.
    double worst_defect(const std::vector<Bond<dim>> &family) const;

    /// Σ |w - area| |C| |ξ|² / Σ area |C| |ξ|².
    double area_defect(const std::vector<Bond<dim>> &family) const;

  private:
    Kernel<dim> kernel_;
    unsigned int order_;
    std::vector<std::array<int, dim>> exponents_; ///< of orders 1, 2, ...
    std::vector<double> exact_;                   ///< over that scale
    double scale_ = 0;                            ///< the largest second moment
  };

  /// Means and spreads of the defects of families, over the whole domain and over parts of it. A
  /// mean that is no chance is a bias, and the limit has it, whichever component it is of.
  template <int dim>
  class MomentBias
  {
  public:
    MomentBias() = default;
    /// @param lower, upper  corners of the box that the nodes are in
    MomentBias(const Point<dim> &lower, const Point<dim> &upper) : lower_(lower), upper_(upper) {}

    static constexpr std::size_t most_defects = dim == 2 ? 15 : 54; ///< of a tensor
    /// @param defects  at most so many
    void add(const Point<dim> &node, const std::vector<double> &defects, std::size_t n_bonds);

    struct Answer
    {
      double mean = 0, spread = 0; ///< over all families, of the component of largest mean
      double mean_of_part = 0;     ///< largest of the parts that has a bias; 0: none has
      bool is_biased = false;
    };
    /// The mean over all families is biased where it is larger than four standard errors, families
    /// being independent. Parts are the boxes of the domain, 4 along each axis, that hold more
    /// families than one of them has in common with others, (2 horizons)^dim: there so many count
    /// as one.
    /// @note Collective.
    Answer answer(const base::Communicator &communicator) const;

  private:
    struct Part
    {
      double n = 0;
      std::array<double, most_defects> sum{}, squares{};

      double mean(std::size_t i) const { return sum[i] / n; }
      double spread(std::size_t i) const;
      void operator+=(const Part &other);
    };
    static constexpr std::size_t n_side = 4;

    Point<dim> lower_, upper_;
    std::array<Part, dim == 2 ? n_side * n_side : n_side * n_side * n_side> parts_;
    double n_bonds_ = 0; ///< of the largest family
  };
} // namespace plumbline::meshfree
