#include "grade.h"

#include "arguments.h"
#include "base/choice.h"
#include "base/csv.h"
#include "base/error.h"
#include "base/number_text.h"
#include "io/certificate_json.h"
#include "report/text_table.h"
#include "sha256.h"
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

    std::string place_text(const std::vector<double> &x)
    {
      constexpr int n_digits = 12;
      return "(" + base::to_text(x[0], n_digits) + ", " + base::to_text(x[1], n_digits) + ")";
    }

    /// The columns of u in a file.
    std::vector<std::string> columns_of(const std::string &file, unsigned int n_components)
    {
      if (n_components == 1)
        return {"u"};
      const base::Csv csv(file, {"x", "y"});
      return csv.has("u1") ? std::vector<std::string>{"u1", "u2"}
                           : std::vector<std::string>{"u", "v"};
    }

    study::GivenValues read_values(const std::string &file, const Certificate &certificate)
    {
      const unsigned int n = certificate.n_components;
      const std::vector<std::string> columns = columns_of(file, n);
      std::vector<std::string> all = {"x", "y"};
      all.insert(all.end(), columns.begin(), columns.end());
      base::Csv csv(file, all);
      const study::CertifiedPlaces places(certificate);
      study::GivenValues given{file, std::vector<double>(certificate.points.size() * n)};
      std::vector<std::size_t> line(certificate.points.size());
      while (csv.next())
      {
        const double x = csv.number("x"), y = csv.number("y");
        const std::size_t i = places.find(x, y);
        if (i == certificate.points.size())
          csv.fail(place_text({x, y}) + " is no point of the certificate, within " +
                   text(places.tolerance()) + "; take it out");
        if (line[i] > 0)
          csv.fail(place_text({x, y}) + " is in line " + std::to_string(line[i]) +
                   ", too; take one out");
        line[i] = csv.line();
        for (unsigned int c = 0; c < n; ++c)
          given.values[i * n + c] = csv.number(columns[c]);
      }
      std::string missing;
      const auto n_missing = std::count(line.begin(), line.end(), std::size_t(0));
      const auto first = std::find(line.begin(), line.end(), std::size_t(0));
      if (n_missing > 0)
        throw InputError("'" + file + "' lacks " + std::to_string(n_missing) + " of the " +
                         std::to_string(line.size()) + " points of the certificate, e.g. " +
                         place_text(certificate.points[first - line.begin()].x) +
                         "; give a value at each of them");
      return given;
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
  } // namespace

  int grade(const GradeOptions &options)
  {
    const Required required = parse_required(options.required);
    const Certificate certificate = io::read_certificate(options.certificate);
    if (sha256(certificate.scene_text) != certificate.hash)
      throw InputError("certificate '" + options.certificate +
                       "': sha256 is not that of its scene_text, so one of them was changed; make "
                       "it again by 'plumbline certify'");
    std::vector<double> h = sizes_of(options);
    std::vector<study::GivenValues> given;
    for (const std::string &file : options.files)
      given.push_back(read_values(file, certificate));
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
                << report::wrapped(answer_of(found, !h.empty()), report::summary_columns, 2)
                << '\n';
    const std::vector<std::string> missed = complaints(required, found);
    for (const std::string &one : missed)
      std::cerr << one << '\n';
    return missed.empty() ? 0 : 1;
  }
} // namespace plumbline::app
