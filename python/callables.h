#pragma once

#include "arrays.h"
#include "physics/coefficient.h"
#include "problem/in_space.h"
#include "problem/problem.h"

#include <memory>
#include <optional>

// Functions of Python as the library's own, which threads call and drop without Python's lock.
namespace plumbline::python
{
  using Callable = std::shared_ptr<const py::function>;

  Callable share(py::function function);

  /// A field of x and y that a user gives: nothing, a number for all places, an expression, or a
  /// function f(x, y) of arrays. Needs Python's lock only where it is made.
  class GivenField
  {
  public:
    /// @param name  of the argument, for messages
    /// @throws InputError  it is none of these
    GivenField(std::string name, const py::object &given);

    bool is_there() const { return text_ || function_; }

    /// @param nodes  where a function is called at once, with all of them; elsewhere point by point
    /// @throws InputError  an expression that does not parse or has another number of components, a
    /// function that returns an array of another shape
    problem::Field<2> field(unsigned int n_components, double horizon,
                            const std::vector<Point<2>> &nodes) const;

    /// In space: an expression in x, y and z, or f(x, y, z), which is called point by point.
    problem::Field<3> field_in_space(unsigned int n_components, double horizon) const;

    /// @pre is_there()
    physics::Coefficient coefficient(double horizon, const std::vector<Point<2>> &nodes,
                                     physics::Mean mean) const;

  private:
    /// @throws InputError  another number of components
    physics::Expression expression(unsigned int n_components, double horizon,
                                   bool is_in_space) const;

    std::string name_;
    std::optional<std::string> text_;
    Callable function_;
  };
} // namespace plumbline::python
