#include "study/grade.h"
#include "arrays.h"
#include "base/choice.h"
#include "bindings.h"
#include "io/certified_set.h"
#include "io/certified_values.h"

#include <algorithm>
#include <cmath>

// Grades of values by a certificate, as `plumbline grade` gives them.
namespace plumbline::python
{
  using namespace py::literals;
  using study::Certificate;

  namespace
  {
    /// The number of each point in the certificate.
    /// @param points  shape (n_points, dim), in one dimension (n_points) as well
    std::vector<std::size_t> numbers_of(const Doubles &points, const Certificate &certificate)
    {
      const study::CertifiedPlaces places(certificate);
      const std::size_t n = certificate.points.size(), dim = certificate.points.front().x.size();
      const std::size_t n_columns = points.ndim() == 1   ? 1
                                    : points.ndim() == 2 ? static_cast<std::size_t>(points.shape(1))
                                                         : 0;
      if (n_columns != dim)
        throw InputError("points has the shape " + shape_text(points) + "; give " +
                         std::to_string(dim) + (dim == 1 ? " coordinate" : " coordinates") +
                         " for each of " + std::to_string(n) + " points");
      const auto n_given = static_cast<std::size_t>(points.shape(0));
      std::vector<std::size_t> numbers;
      for (std::size_t k = 0; k < n_given; ++k)
      {
        const double *const x = points.data() + k * dim;
        numbers.push_back(places.find({x, x + dim}));
        const auto same = std::find(numbers.begin(), numbers.end() - 1, numbers.back());
        if (numbers.back() == n || same != numbers.end() - 1)
          throw InputError("points: row " + std::to_string(k) + " is " +
                           (numbers.back() == n ? "not a point of the certificate; leave it out"
                                                : "the point of another row, too; leave one out"));
      }
      if (n_given < n)
        throw InputError("points has " + std::to_string(n_given) + " of the " + std::to_string(n) +
                         " points of the certificate; give all of them");
      return numbers;
    }

    /// In the certificate's order.
    std::vector<double> in_order(const Doubles &values, const std::vector<std::size_t> &numbers,
                                 unsigned int n_components)
    {
      const std::size_t n = numbers.size() * n_components;
      const bool has_rows = values.ndim() >= 1 && values.ndim() <= 2 &&
                            static_cast<std::size_t>(values.shape(0)) == numbers.size();
      if (!has_rows || static_cast<std::size_t>(values.size()) != n)
        throw InputError("values has the shape " + shape_text(values) + "; give " +
                         std::to_string(n_components) + " for each of " +
                         std::to_string(numbers.size()) + " points");
      std::vector<double> result(n);
      for (std::size_t k = 0; k < numbers.size(); ++k)
        for (unsigned int c = 0; c < n_components; ++c)
          result[numbers[k] * n_components + c] = values.data()[k * n_components + c];
      if (!std::all_of(result.begin(), result.end(), [](double u) { return std::isfinite(u); }))
        throw InputError("values has a number that is not finite");
      return result;
    }

    /// The set of an installed package is that of the prefix with
    /// lib/python3/dist-packages/plumbline.
    std::filesystem::path prefix_of_package()
    {
      constexpr unsigned int depth = 5;
      std::filesystem::path prefix =
          py::module_::import("plumbline._core").attr("__file__").cast<std::string>();
      for (unsigned int i = 0; i < depth; ++i)
        prefix = prefix.parent_path();
      return prefix;
    }

    /// @throws InputError  not one mesh size for each grid, from coarse to fine
    void check_sizes(const std::vector<double> &h, std::size_t n_given)
    {
      if (!h.empty() && h.size() != n_given)
        throw InputError("h has " + std::to_string(h.size()) + " mesh sizes for " +
                         std::to_string(n_given) + " grids of values; give one for each");
      for (std::size_t i = 0; i < h.size(); ++i)
        if (!(h[i] > 0 && std::isfinite(h[i])) || (i > 0 && !(h[i] < h[i - 1])))
          throw InputError("h must be above 0 and decrease, from coarse to fine");
    }

    py::dict graded(const Certificate &certificate, const std::vector<study::GivenValues> &given,
                    const std::vector<double> &h)
    {
      if (given.empty())
        throw InputError("values is empty; give one grid of values, or several with h");
      check_sizes(h, given.size());
      const study::SeriesGrade found = study::grade(certificate, given, h);
      py::list grades;
      for (const study::Grade &one : found.grades)
        grades.append(py::dict("h"_a = one.h, "largest"_a = one.largest,
                               "rms"_a = one.root_mean_square, "digits"_a = one.digits,
                               "is_at_least"_a = one.is_at_least, "order"_a = one.order));
      py::list rules;
      for (const study::CertifiedRule &one : certificate.rules)
        rules.append(py::dict("method"_a = one.method, "h"_a = one.h, "largest"_a = one.largest,
                              "rms"_a = one.root_mean_square, "digits"_a = one.digits,
                              "order"_a = one.order));
      return py::dict("grades"_a = grades, "rules"_a = rules, "order"_a = found.order.value,
                      "own_order"_a = found.own_order, "gci"_a = found.index,
                      "limit_distance"_a = found.limit_distance, "bound"_a = found.bound,
                      "limit"_a = base::word(found.limit), "reason"_a = found.reason);
    }

    py::dict grade_arrays(const std::string &problem, const Doubles &points,
                          const std::vector<Doubles> &values, const std::vector<double> &h)
    {
      const Certificate certificate = io::certificate_of(problem, prefix_of_package());
      const auto numbers = numbers_of(points, certificate);
      std::vector<study::GivenValues> given;
      for (const Doubles &one : values)
        given.push_back({"values", in_order(one, numbers, certificate.n_components)});
      return graded(certificate, given, h);
    }

    py::dict grade_files(const std::string &problem, const std::vector<std::string> &files,
                         const std::vector<double> &h)
    {
      const Certificate certificate = io::certificate_of(problem, prefix_of_package());
      std::vector<study::GivenValues> given;
      for (const std::string &file : files)
        given.push_back(io::read_values(file, certificate));
      return graded(certificate, given, h);
    }

    /// Certified points and values of a problem.
    py::dict problem_of(const std::string &problem)
    {
      const Certificate certificate = io::certificate_of(problem, prefix_of_package());
      py::list points, values, bounds;
      for (const study::CertifiedValue &one : certificate.points)
      {
        points.append(one.x);
        values.append(one.value);
        bounds.append(one.bound);
      }
      return py::dict("name"_a = certificate.name, "purpose"_a = certificate.purpose,
                      "horizon"_a = certificate.horizon, "scene"_a = certificate.scene_text,
                      "points"_a = points, "values"_a = values, "bounds"_a = bounds,
                      "digits"_a = certificate.least_digits());
    }
  } // namespace

  void add_grade(py::module_ &module)
  {
    module.def("grade_arrays", grade_arrays, "problem"_a, "points"_a, "values"_a, "h"_a);
    module.def("grade_files", grade_files, "problem"_a, "files"_a, "h"_a);
    module.def("certified_problem", problem_of, "problem"_a);
    module.def("certified_names", [] { return io::certified_names(prefix_of_package()); });
  }
} // namespace plumbline::python
