#include "study/grade.h"

#include "base/choice.h"
#include "base/error.h"
#include "base/number_list.h"
#include "base/number_text.h"
#include "study/grid_convergence.h"
#include "study/reference_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace plumbline::study
{
  namespace
  {
    enum class Requirement
    {
      digits,
      order,
      limit
    };

    /// What can be required of a limit.
    enum class RequiredLimit
    {
      certified
    };
  } // namespace
} // namespace plumbline::study

namespace plumbline::base
{
  template <>
  inline constexpr auto words<study::Requirement> = std::array{"digits", "order", "limit"};
  template <>
  inline constexpr auto words<study::RequiredLimit> = std::array{"certified"};
} // namespace plumbline::base

namespace plumbline::study
{
  namespace
  {
    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
    constexpr std::size_t grids_of_index = 3;

    /// Roache's factor for an order that is observed on three grids.
    constexpr double safety = 1.25;

    /// A limit that is known no better than this, relative to the solution, decides nothing.
    constexpr double most_uncertain = .1;

    /// Certified values in the order of GivenValues.
    std::vector<double> certified_values(const Certificate &certificate)
    {
      std::vector<double> values;
      for (const CertifiedValue &one : certificate.points)
        values.insert(values.end(), one.value.begin(), one.value.end());
      return values;
    }

    std::vector<double> bounds_of(const Certificate &certificate)
    {
      std::vector<double> bounds;
      for (const CertifiedValue &one : certificate.points)
        bounds.push_back(one.bound);
      return bounds;
    }

    /// Length of the difference at each point.
    std::vector<double> distances(const std::vector<double> &a, const std::vector<double> &b,
                                  unsigned int n_components)
    {
      std::vector<double> result(a.size() / n_components);
      for (std::size_t i = 0; i < result.size(); ++i)
      {
        for (unsigned int c = 0; c < n_components; ++c)
          result[i] += std::pow(a[i * n_components + c] - b[i * n_components + c], 2);
        result[i] = std::sqrt(result[i]);
      }
      return result;
    }

    /// The bound is that of each component.
    double length_of_bounds(const Certificate &certificate)
    {
      return std::sqrt(static_cast<double>(certificate.n_components));
    }

    Grade grade_one(const Certificate &certificate, const GivenValues &given)
    {
      const std::vector<double> errors =
          distances(given.values, certified_values(certificate), certificate.n_components);
      Grade grade;
      grade.name = given.name;
      grade.is_at_least = true;
      double worst = 0;
      for (std::size_t i = 0; i < errors.size(); ++i)
      {
        const double bound = length_of_bounds(certificate) * certificate.points[i].bound;
        grade.largest = std::max(grade.largest, errors[i] / certificate.size);
        grade.is_at_least = grade.is_at_least && errors[i] <= bound;
        worst = std::max(worst, errors[i] + bound);
      }
      grade.root_mean_square = root_mean_square(errors) / certificate.size;
      grade.digits = certified_digits(worst, certificate.size);
      return grade;
    }

    std::string text(double value)
    {
      constexpr int n_digits = 3;
      return base::to_text(value, n_digits);
    }

    /// Orders of the errors that are above the bounds.
    void find_orders(SeriesGrade &series)
    {
      std::vector<double> h, errors;
      std::vector<Grade> &grades = series.grades;
      for (std::size_t i = 0; i < grades.size(); ++i)
      {
        if (!(grades[i].root_mean_square > series.bound))
          continue;
        if (!h.empty() && i > 0 && h.back() == grades[i - 1].h)
          grades[i].order = std::log(errors.back() / grades[i].root_mean_square) /
                            std::log(h.back() / grades[i].h);
        h.push_back(grades[i].h);
        errors.push_back(grades[i].root_mean_square);
      }
      if (h.size() >= 2)
        series.order = fit_slope(h, errors);
    }

    /// Verdict and reason, from index and distance of the limit.
    void judge_limit(SeriesGrade &series)
    {
      const double uncertain = series.index + series.bound;
      const std::string numbers =
          "the extrapolated limit differs by " + text(series.limit_distance) +
          " from the certified values; its uncertainty is " + text(series.index) + " (GCI) and " +
          text(series.bound) + " (bound of the certificate)";
      // where errors still fall the coarsest grid may be too coarse for the order of the changes
      if (series.limit_distance > uncertain &&
          std::pow(.5, series.finest().order) <= slowest_contraction)
        series.reason = numbers + ", but the errors still fall at order " +
                        text(series.finest().order) + ": give a finer grid";
      else if (series.limit_distance > uncertain)
      {
        series.limit = GradedLimit::another;
        series.reason = numbers;
      }
      else if (uncertain > most_uncertain)
        series.reason = numbers + ", which is too much to decide: give a finer grid";
      else
      {
        series.limit = GradedLimit::certified;
        series.reason = numbers;
      }
    }

    void find_limit(const Certificate &certificate, const std::vector<GivenValues> &given,
                    const std::vector<double> &h, SeriesGrade &series)
    {
      std::vector<std::vector<double>> values;
      for (const GivenValues &one : given)
        values.push_back(one.values);
      const GridConvergence found = grid_convergence(h, values);
      const bool is_exact =
          std::all_of(series.grades.rbegin(), series.grades.rbegin() + grids_of_index,
                      [](const Grade &one) { return one.is_at_least; });
      if (is_exact)
      {
        series.limit = GradedLimit::certified;
        series.reason = "the three finest grids differ from the certified values by no more than "
                        "their bound";
        return;
      }
      if (!found.is_known())
      {
        series.reason = "the changes between the three finest grids do not fall, or too slowly, so "
                        "nothing can be extrapolated: give finer grids";
        return;
      }
      series.own_order = found.order;
      const unsigned int n = certificate.n_components;
      const std::vector<double> zero(found.correction.size());
      series.index =
          safety * root_mean_square(distances(found.correction, zero, n)) / certificate.size;
      std::vector<double> limit = values.back();
      for (std::size_t i = 0; i < limit.size(); ++i)
        limit[i] += found.correction[i];
      series.limit_distance =
          root_mean_square(distances(limit, certified_values(certificate), n)) / certificate.size;
      judge_limit(series);
    }
  } // namespace

  CertifiedPlaces::CertifiedPlaces(const Certificate &certificate) : points_(certificate.points)
  {
    double largest = 0;
    for (std::size_t d = 0; d < points_.front().x.size(); ++d)
    {
      const auto [least, most] =
          std::minmax_element(points_.begin(), points_.end(),
                              [d](const auto &a, const auto &b) { return a.x[d] < b.x[d]; });
      extent_ = std::max(extent_, most->x[d] - least->x[d]);
      largest = std::max({largest, std::abs(most->x[d]), std::abs(least->x[d])});
    }
    if (extent_ == 0) // of one point
      extent_ = std::max(largest, certificate.horizon);
  }

  double CertifiedPlaces::tolerance() const
  {
    constexpr double relative = 1e-9;
    return relative * extent_;
  }

  std::size_t CertifiedPlaces::find(const std::vector<double> &x) const
  {
    const auto found = std::find_if(points_.begin(), points_.end(),
                                    [&](const CertifiedValue &one)
                                    {
                                      double squares = 0;
                                      for (std::size_t d = 0; d < x.size(); ++d)
                                        squares += std::pow(one.x[d] - x[d], 2);
                                      return std::sqrt(squares) <= tolerance();
                                    });
    return static_cast<std::size_t>(found - points_.begin());
  }

  SeriesGrade grade(const Certificate &certificate, const std::vector<GivenValues> &given,
                    const std::vector<double> &h)
  {
    SeriesGrade series;
    series.order = {not_known, not_known};
    series.bound =
        length_of_bounds(certificate) * root_mean_square(bounds_of(certificate)) / certificate.size;
    const std::size_t n_values = certificate.points.size() * certificate.n_components;
    for (const GivenValues &one : given)
    {
      if (one.values.size() != n_values)
        throw InputError(one.name + " has " + std::to_string(one.values.size()) +
                         " values, but the certificate has " + std::to_string(n_values) + ": " +
                         std::to_string(certificate.n_components) + " at each of " +
                         std::to_string(certificate.points.size()) + " points");
      series.grades.push_back(grade_one(certificate, one));
    }
    if (h.empty())
    {
      series.reason = "the mesh sizes are not given (--h)";
      return series;
    }
    for (std::size_t i = 0; i < h.size(); ++i)
      series.grades[i].h = h[i];
    find_orders(series);
    if (h.size() < grids_of_index)
      series.reason = std::to_string(h.size()) + " of the 3 grids that a limit needs";
    else
      find_limit(certificate, given, h, series);
    return series;
  }

  namespace
  {
    /// One requirement, as on the command line.
    void add_required(const std::string &part, GradeRequirements &required)
    {
      const auto equals = part.find('=');
      const auto kind = base::from_word<Requirement>(part.substr(0, equals));
      const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
      const auto refuse = [&]
      {
        throw InputError("--require '" + part +
                         "' is not known; write digits=N (0 to 15), order=P or limit=certified, "
                         "separated by commas");
      };
      if (!kind || value.empty())
        refuse();
      if (*kind == Requirement::limit)
      {
        if (!base::from_word<RequiredLimit>(value))
          refuse();
        required.is_limit_certified = true;
        return;
      }
      const std::vector<double> numbers =
          base::to_numbers("--require " + base::word(*kind), {value});
      if (numbers.size() != 1)
        refuse();
      if (*kind == Requirement::order)
      {
        required.order = numbers[0];
        return;
      }
      constexpr double most_digits = 15;
      if (numbers[0] != std::floor(numbers[0]) || !(numbers[0] >= 0 && numbers[0] <= most_digits))
        refuse();
      required.digits = static_cast<unsigned int>(numbers[0]);
    }
  } // namespace

  GradeRequirements parse_grade_requirements(const std::vector<std::string> &words)
  {
    GradeRequirements required;
    for (const std::string &list : words)
    {
      std::istringstream parts(list);
      for (std::string part; std::getline(parts, part, ',');)
        add_required(part, required);
    }
    return required;
  }

  std::vector<std::string> complaints(const GradeRequirements &required, const SeriesGrade &found)
  {
    std::vector<std::string> result;
    if (found.finest().digits < required.digits)
      result.push_back("required digits = " + std::to_string(required.digits) + ": " +
                       found.finest().name + " has " + std::to_string(found.finest().digits));
    if (std::isfinite(required.order) && !(found.order.value >= required.order))
      result.push_back("required order = " + text(required.order) + ": it is " +
                       (std::isfinite(found.order.value)
                            ? text(found.order.value)
                            : "not known; give two files and --h, with errors above the bounds "
                              "of the certificate"));
    if (required.is_limit_certified && found.limit != GradedLimit::certified)
      result.push_back("required limit = certified: " + base::word(found.limit) + ": " +
                       found.reason);
    return result;
  }
} // namespace plumbline::study
