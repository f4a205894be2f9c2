#pragma once

#include <deal.II/base/point.h>

#include <functional>
#include <string>
#include <vector>

namespace plumbline::method
{
  /// A solution, the same view for both sides, so that they can be compared.
  struct Field
  {
    std::vector<dealii::Point<2>> nodes; ///< the method's own free nodes in Ω
    std::vector<double> nodal;           ///< values there, shape (n_nodes, n_components)
    std::vector<double> averages; ///< over the comparison cells, shape (n_cells, n_components)
    std::function<double(const dealii::Point<2> &, unsigned int component)> value; ///< in Ω
    /// Of functions in continuous spaces, in Ω: exact in the cell whose values `value` takes; empty
    /// for other methods.
    std::function<dealii::Tensor<1, 2>(const dealii::Point<2> &, unsigned int component)> gradient =
        {};
    std::function<void(const std::string &file)> write_vtu;
  };
} // namespace plumbline::method
