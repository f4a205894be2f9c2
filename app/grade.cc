#include "grade.h"

#include "arguments.h"
#include "base/choice.h"
#include "base/error.h"
#include "base/number_text.h"
#include "certified_set.h"
#include "io/certified_values.h"
#include "report/certificate_text.h"
#include "study/grade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <numeric>
#include <sstream>

namespace plumbline::app
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
} // namespace plumbline::app

namespace plumbline::base
{
  template <>
  inline constexpr auto words<app::Requirement> = std::array{"digits", "order", "limit"};
  template <>
  inline constexpr auto words<app::RequiredLimit> = std::array{"certified"};
} // namespace plumbline::base

namespace plumbline::app
{
  using study::Certificate;
  using study::SeriesGrade;

  namespace
  {
    std::string text(double value)
    {
      constexpr int n_digits = 3;
      return std::isfinite(value) ? base::to_text(value, n_digits) : "–";
    }

    /// Mesh sizes of the files; none: not given.
    std::vector<double> sizes_of(const GradeOptions &options)
    {
      if (options.h.empty())
        return {};
      const std::vector<double> h = to_numbers(sizes_option, options.h);
      if (h.size() != options.files.size())
        throw InputError(std::string(sizes_option) + " has " + std::to_string(h.size()) +
                         " mesh sizes for " + std::to_string(options.files.size()) +
                         " files; give one for each, in their order");
      for (const double one : h)
        if (!(one > 0) || std::count(h.begin(), h.end(), one) > 1)
          throw InputError(std::string(sizes_option) + ": " + text(one) +
                           " is not above 0, or there twice; give a mesh size for each file");
      return h;
    }

    struct Required
    {
      unsigned int digits = 0;
      double order = -std::numeric_limits<double>::infinity();
      bool is_limit_certified = false;
    };

    /// One requirement, as on the command line.
    void add_required(const std::string &part, Required &required)
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
      const std::vector<double> numbers = to_numbers("--require " + base::word(*kind), {value});
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

    Required parse_required(const std::vector<std::string> &words)
    {
      Required required;
      for (const std::string &list : words)
      {
        std::istringstream parts(list);
        for (std::string part; std::getline(parts, part, ',');)
          add_required(part, required);
      }
      return required;
    }

    /// Requirements that do not hold.
    std::vector<std::string> complaints(const Required &required, const SeriesGrade &found)
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
      if (required.is_limit_certified && found.limit != study::GradedLimit::certified)
        result.push_back("required limit = certified: " + base::word(found.limit) + ": " +
                         found.reason);
      return result;
    }

    report::Table table_of(const SeriesGrade &found, bool has_sizes)
    {
      report::Table table{"", {"file"}, {}};
      if (has_sizes)
        table.columns.emplace_back("h");
      for (const char *const head : {"largest error", "rms error", "digits"})
        table.columns.emplace_back(head);
      if (has_sizes)
        table.columns.emplace_back("order");
      for (const study::Grade &one : found.grades)
      {
        std::vector<report::Cell> row = {report::text_cell(one.name)};
        if (has_sizes)
          row.push_back(report::number_cell(one.h));
        row.push_back(report::error_cell(one.largest));
        row.push_back(report::error_cell(one.root_mean_square));
        row.push_back(
            report::text_cell((one.is_at_least ? "at least " : "") + std::to_string(one.digits)));
        if (has_sizes)
          row.push_back(std::isfinite(one.order) ? report::rate_cell(one.order)
                                                 : report::empty_cell());
        table.rows.push_back(std::move(row));
      }
      return table;
    }

    std::string answer_of(const SeriesGrade &found, bool has_sizes)
    {
      const study::Grade &finest = found.finest();
      std::string answer = std::string(finest.is_at_least ? "at least " : "") +
                           std::to_string(finest.digits) + " digits" +
                           (found.grades.size() > 1 ? " in " + finest.name : "");
      if (has_sizes && found.grades.size() > 1)
        answer += "; order " + text(found.order.value) + "; " + base::word(found.limit) + ": " +
                  found.reason;
      return answer;
    }

    /// The problem itself, for another code.
    int show(const Certificate &certificate, const GradeOptions &options)
    {
      if (!options.files.empty() || options.is_points == options.is_scene)
        throw InputError("grade: --points and --scene print the problem and grade nothing; give "
                         "one of them, and no file");
      if (options.is_scene)
        std::cout << certificate.scene_text;
      else
        std::cout << io::points_csv(certificate);
      return 0;
    }
  } // namespace

  int grade(const GradeOptions &options)
  {
    const Required required = parse_required(options.required);
    const Certificate certificate = certificate_of(options.problem, prefix_of_command());
    if (options.is_points || options.is_scene)
      return show(certificate, options);
    if (options.files.empty())
      throw InputError("grade: no file of values is given; write plumbline grade FILE --problem " +
                       options.problem + ", or --points for the points at which u is needed");
    std::vector<double> h = sizes_of(options);
    std::vector<study::GivenValues> given;
    for (const std::string &file : options.files)
      given.push_back(io::read_values(file, certificate));
    if (!h.empty()) // from coarse to fine
    {
      std::vector<std::size_t> order(h.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(),
                [&](std::size_t a, std::size_t b) { return h[a] > h[b]; });
      std::vector<study::GivenValues> sorted;
      for (const std::size_t i : order)
        sorted.push_back(given[i]);
      given = sorted;
      std::sort(h.rbegin(), h.rend());
    }
    const SeriesGrade found = study::grade(certificate, given, h);
    if (!options.quiet)
      std::cout << report::heading(certificate.name, certificate.purpose) << '\n'
                << certificate.points.size() << " points, certified to at least "
                << certificate.least_digits() << " digits; errors are relative to "
                << text(certificate.size) << "\n\n"
                << report::to_text(table_of(found, !h.empty())) << '\n'
                << "Meshfree rules of Plumbline at the same points:\n"
                << report::to_text(report::rules_table(certificate)) << '\n'
                << report::wrapped(answer_of(found, !h.empty()), report::summary_columns, 2)
                << '\n';
    const std::vector<std::string> missed = complaints(required, found);
    for (const std::string &one : missed)
      std::cerr << one << '\n';
    return missed.empty() ? 0 : 1;
  }
} // namespace plumbline::app
