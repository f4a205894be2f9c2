#include "study/grade.h"
#include "arrays.h"
#include "base/choice.h"
#include "bindings.h"
#include "io/certificate_json.h"

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
    std::vector<std::size_t> numbers_of(const std::vector<Point<2>> &points,
                                        const Certificate &certificate)
    {
      const study::CertifiedPlaces places(certificate);
      const std::size_t n = certificate.points.size();
      std::vector<std::size_t> numbers;
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        numbers.push_back(places.find(points[k][0], points[k][1]));
        const auto same = std::find(numbers.begin(), numbers.end() - 1, numbers.back());
        if (numbers.back() == n || same != numbers.end() - 1)
          throw InputError("points: row " + std::to_string(k) + " is " +
                           (numbers.back() == n ? "no point of the certificate; leave it out"
                                                : "the point of another row, too; leave one out"));
      }
      if (points.size() < n)
        throw InputError("points has " + std::to_string(points.size()) + " of the " +
                         std::to_string(n) + " points of the certificate; give all of them");
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

    py::dict grade(const std::string &file, const Doubles &points,
                   const std::vector<Doubles> &values, const std::vector<double> &h)
    {
      const Certificate certificate = io::read_certificate(file);
      const auto numbers = numbers_of(to_points(points, "points"), certificate);
      if (!h.empty() && h.size() != values.size())
        throw InputError("h has " + std::to_string(h.size()) + " mesh sizes for " +
                         std::to_string(values.size()) + " arrays of values; give one for each");
      for (std::size_t i = 0; i < h.size(); ++i)
        if (!(h[i] > 0 && std::isfinite(h[i])) || (i > 0 && !(h[i] < h[i - 1])))
          throw InputError("h must be above 0 and decrease, from coarse to fine");
      std::vector<study::GivenValues> given;
      for (const Doubles &one : values)
        given.push_back({"values", in_order(one, numbers, certificate.n_components)});
      if (given.empty())
        throw InputError("values is empty; give an array, or a list of arrays with h");
      const study::SeriesGrade found = study::grade(certificate, given, h);
      py::list grades;
      for (const study::Grade &one : found.grades)
        grades.append(py::dict("h"_a = one.h, "largest"_a = one.largest,
                               "rms"_a = one.root_mean_square, "digits"_a = one.digits,
                               "is_at_least"_a = one.is_at_least, "order"_a = one.order));
      return py::dict("grades"_a = grades, "order"_a = found.order.value,
                      "own_order"_a = found.own_order, "gci"_a = found.index,
                      "limit_distance"_a = found.limit_distance, "bound"_a = found.bound,
                      "limit"_a = base::word(found.limit), "reason"_a = found.reason);
    }
  } // namespace

  void add_grade(py::module_ &module)
  {
    module.def("grade_arrays", grade, "file"_a, "points"_a, "values"_a, "h"_a);
  }
} // namespace plumbline::python
