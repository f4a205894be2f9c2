#pragma once

#include "geometry/lattice.h"
#include "method/rice_strip.h"
#include "reference/shapes.h"

#include <deal.II/lac/vector.h>

#include <Eigen/Core>

#include <vector>

namespace plumbline::reference
{
  /// The cells of the strip and of what is constrained around it, and the functions on them: of two
  /// components each, continuous ones shared.
  class StripSpace
  {
  public:
    /// A cell, from the strip's lower left one; or how far another one is from it.
    struct Place
    {
      int column = 0, row = 0;
    };

    StripSpace(const method::RiceStrip &strip, int reach, const AxisShapes &shapes);

    int reach() const { return reach_; }
    bool is_inside(const Place &cell) const
    {
      return cell.column >= 0 && cell.column < strip_.n_length && cell.row >= 0 &&
             cell.row < strip_.n_height;
    }
    const unsigned int *functions(const Place &cell) const { return &functions_[index(cell) * n_]; }
    std::size_t n_functions() const { return support_.size(); }
    /// [h]
    const geometry::Point<2> &support(unsigned int function) const { return support_[function]; }
    bool is_upper(unsigned int function) const { return is_upper_[function] != 0; }
    bool is_free(unsigned int function) const { return is_free_[function] != 0; }

    /// Calls visit(cell) for all cells.
    template <class Visit>
    void visit_all(const Visit &visit) const
    {
      for (int row = -reach_; row < strip_.n_height + reach_; ++row)
        for (int column = -reach_; column < strip_.n_length + reach_; ++column)
          visit(Place{column, row});
    }
    bool has(const Place &cell) const
    {
      return cell.column >= -reach_ && cell.column < strip_.n_length + reach_ &&
             cell.row >= -reach_ && cell.row < strip_.n_height + reach_;
    }

    Eigen::VectorXd gather(const dealii::Vector<double> &u, const Place &cell) const
    {
      Eigen::VectorXd values(2 * n_);
      const unsigned int *const function = functions(cell);
      for (unsigned int k = 0; k < n_; ++k)
        for (unsigned int d = 0; d < 2; ++d)
          values[2 * k + d] = u[2 * function[k] + d];
      return values;
    }
    void scatter(const Eigen::VectorXd &values, const Place &cell,
                 dealii::Vector<double> &sum) const
    {
      const unsigned int *const function = functions(cell);
      for (unsigned int k = 0; k < n_; ++k)
        for (unsigned int d = 0; d < 2; ++d)
          sum[2 * function[k] + d] += values[2 * k + d];
    }

  private:
    std::size_t index(const Place &cell) const
    {
      return static_cast<std::size_t>(cell.row + reach_) * (strip_.n_length + 2 * reach_) +
             cell.column + reach_;
    }

    method::RiceStrip strip_;
    int reach_;
    unsigned int n_; ///< functions of a cell
    std::vector<unsigned int> functions_;
    std::vector<geometry::Point<2>> support_;
    std::vector<char> is_upper_, is_free_;
  };
} // namespace plumbline::reference
