#pragma once

#include "base/error.h"
#include "geometry/cube_lattice.h"
#include "geometry/lattice.h"

#include <deal.II/base/point.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

// Between numpy's arrays and vectors.
namespace plumbline::python
{
  namespace py = pybind11;
  using dealii::Point;

  /// What numpy can convert to doubles in C's order; without a copy where it is that already.
  using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
  using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

  /// "(10, 2)"
  std::string shape_text(const py::array &array);

  /// @throws InputError  another shape than (n, dim), a number that is not finite
  template <int dim = 2>
  std::vector<Point<dim>> to_points(const Doubles &array, const std::string &name);

  /// Boxes minus other boxes, each ((x0, y0), (x1, y1)): shapes (2, 2) or (n, 2, 2).
  /// @throws InputError  another shape
  geometry::Domain to_domain(const py::object &boxes, const py::object &exclude);

  /// One box, ((x0, y0, z0), (x1, y1, z1)): shape (2, 3) or (1, 2, 3).
  /// @throws InputError  another shape
  geometry::Cuboid to_cuboid(const py::object &given);

  /// @throws InputError  another shape than (n)
  void require_length(const py::array &array, std::size_t n, const std::string &name,
                      const std::string &of);

  /// The array takes the vector over: nothing is copied.
  template <class T>
  py::array to_array(std::vector<T> values, std::vector<py::ssize_t> shape)
  {
    auto *kept = new std::vector<T>(std::move(values));
    const py::capsule owner(kept, [](void *p) { delete static_cast<std::vector<T> *>(p); });
    return py::array_t<T>(std::move(shape), kept->data(), owner);
  }

  template <class T>
  py::array to_array(std::vector<T> values)
  {
    const auto n = static_cast<py::ssize_t>(values.size());
    return to_array(std::move(values), {n});
  }

  /// Shape (n, dim).
  template <int dim>
  py::array to_array(const std::vector<Point<dim>> &points);

  /// Gradients at points: shape (n, dim), of several components (n, n_components, dim).
  /// @throws InputError  there is no gradient
  template <int dim>
  py::array
  gradients(const std::function<dealii::Tensor<1, dim>(const Point<dim> &, unsigned int)> &gradient,
            const std::vector<Point<dim>> &points, unsigned int n_components,
            const std::string &method);

  /// Of one component shape (n), else (n, n_components).
  py::array to_components(std::vector<double> values, unsigned int n_components);
} // namespace plumbline::python
