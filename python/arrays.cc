#include "arrays.h"

#include <cmath>

namespace plumbline::python
{
  std::string shape_text(const py::array &array)
  {
    std::string text = "(";
    for (py::ssize_t d = 0; d < array.ndim(); ++d)
      text += (d == 0 ? "" : ", ") + std::to_string(array.shape(d));
    return text + ")";
  }

  template <int dim>
  std::vector<Point<dim>> to_points(const Doubles &array, const std::string &name)
  {
    if (array.ndim() != 2 || array.shape(1) != dim)
      throw InputError(name + " has the shape " + shape_text(array) + "; give one row " +
                       (dim == 2 ? "(x, y)" : "(x, y, z)") + " for each point, shape (n, " +
                       std::to_string(dim) + ")");
    const auto view = array.unchecked<2>();
    std::vector<Point<dim>> points(static_cast<std::size_t>(view.shape(0)));
    for (py::ssize_t k = 0; k < view.shape(0); ++k)
      for (unsigned int d = 0; d < dim; ++d)
      {
        points[static_cast<std::size_t>(k)][d] = view(k, d);
        if (!std::isfinite(view(k, d)))
        {
          std::string text;
          for (unsigned int c = 0; c < dim; ++c)
            text += (c == 0 ? "" : ", ") + std::to_string(view(k, c));
          throw InputError(name + "[" + std::to_string(k) + "] = (" + text +
                           ") is not a point; give finite numbers");
        }
      }
    return points;
  }

  template std::vector<Point<2>> to_points(const Doubles &, const std::string &);
  template std::vector<Point<3>> to_points(const Doubles &, const std::string &);

  namespace
  {
    std::vector<geometry::Box> to_boxes(const py::object &given, const std::string &name)
    {
      if (given.is_none())
        return {};
      const Doubles array = Doubles::ensure(given);
      if (!array)
        PyErr_Clear();
      const py::ssize_t n = array ? array.ndim() : 0;
      if (n < 2 || n > 3 || array.shape(n - 1) != 2 || array.shape(n - 2) != 2)
        throw InputError(name + (array ? " has the shape " + shape_text(array) : " is no array") +
                         "; give corners ((x0, y0), (x1, y1)) of one box or of a list of them");
      std::vector<geometry::Box> boxes;
      for (py::ssize_t k = 0; k < array.size(); k += 4)
      {
        const double *const x = array.data() + k;
        boxes.push_back({{x[0], x[1]}, {x[2], x[3]}});
      }
      return boxes;
    }
  } // namespace

  geometry::Domain to_domain(const py::object &boxes, const py::object &exclude)
  {
    return {to_boxes(boxes, "boxes"), to_boxes(exclude, "exclude")};
  }

  void require_length(const py::array &array, std::size_t n, const std::string &name,
                      const std::string &of)
  {
    if (array.ndim() != 1 || static_cast<std::size_t>(array.shape(0)) != n)
      throw InputError(name + " has the shape " + shape_text(array) +
                       "; give one number for each " + of + ", shape (" + std::to_string(n) + ",)");
  }

  template <int dim>
  py::array to_array(const std::vector<Point<dim>> &points)
  {
    std::vector<double> values;
    values.reserve(dim * points.size());
    for (const Point<dim> &x : points)
      for (unsigned int d = 0; d < dim; ++d)
        values.push_back(x[d]);
    return to_array(std::move(values), {static_cast<py::ssize_t>(points.size()), dim});
  }

  template py::array to_array(const std::vector<Point<2>> &);
  template py::array to_array(const std::vector<Point<3>> &);

  template <int dim>
  py::array
  gradients(const std::function<dealii::Tensor<1, dim>(const Point<dim> &, unsigned int)> &gradient,
            const std::vector<Point<dim>> &points, unsigned int n_components,
            const std::string &method)
  {
    if (!gradient)
      throw InputError("method '" + method +
                       "' has no gradient: its solutions are discontinuous; use a continuous "
                       "Galerkin method, such as Q2 or P2");
    std::vector<double> values;
    {
      const py::gil_scoped_release others;
      values.reserve(points.size() * n_components * dim);
      for (const Point<dim> &x : points)
        for (unsigned int c = 0; c < n_components; ++c)
        {
          const dealii::Tensor<1, dim> one = gradient(x, c);
          values.insert(values.end(), one.begin_raw(), one.end_raw());
        }
    }
    const auto n = static_cast<py::ssize_t>(points.size());
    if (n_components == 1)
      return to_array(std::move(values), {n, dim});
    return to_array(std::move(values), {n, static_cast<py::ssize_t>(n_components), dim});
  }

  template py::array
  gradients(const std::function<dealii::Tensor<1, 2>(const Point<2> &, unsigned int)> &,
            const std::vector<Point<2>> &, unsigned int, const std::string &);
  template py::array
  gradients(const std::function<dealii::Tensor<1, 3>(const Point<3> &, unsigned int)> &,
            const std::vector<Point<3>> &, unsigned int, const std::string &);

  py::array to_components(std::vector<double> values, unsigned int n_components)
  {
    const auto n = static_cast<py::ssize_t>(values.size());
    if (n_components == 1)
      return to_array(std::move(values));
    return to_array(std::move(values), {n / n_components, n_components});
  }
} // namespace plumbline::python
