#include "report/certificate_text.h"

#include "base/choice.h"
#include "base/number_text.h"
#include "report/counted.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace plumbline::report
{
  using study::Certificate;
  using study::CertifiedValue;

  namespace
  {
    std::string text(double value)
    {
      constexpr int n_digits = 4;
      return base::to_text(value, n_digits);
    }

    /// For people rounded to a tenth of the bound's decade, which makes zeros of what is none.
    Cell value_cell(double value, double bound)
    {
      constexpr int most = 17, fallback = 4;
      Cell cell = number_cell(value);
      if (!(bound > 0) || !std::isfinite(value))
        return cell;
      const double unit = std::pow(10., std::floor(std::log10(bound)) - 1),
                   shown = std::round(value / unit) * unit + 0.; // no -0
      const double digits =
          shown == 0 ? fallback : std::floor(std::log10(std::abs(shown) / unit)) + 1;
      cell.text = base::to_text(shown, static_cast<int>(std::clamp<double>(digits, 1, most)));
      return cell;
    }

    std::vector<Column> columns_of(const Certificate &certificate)
    {
      const auto name = [&](const std::string &word, unsigned int c)
      { return word + (certificate.n_components == 1 ? "" : std::to_string(c + 1)); };
      std::vector<Column> columns;
      for (std::size_t d = 0; d < certificate.points.front().x.size(); ++d)
        columns.emplace_back(std::string(1, "xyz"[d]));
      for (unsigned int c = 0; c < certificate.n_components; ++c)
        columns.emplace_back(name("u", c));
      columns.emplace_back("bound");
      for (unsigned int c = 0; c < certificate.n_components; ++c)
        columns.push_back(
            {name("u", c) + " by " + certificate.meshfree.method, {name("other", c)}});
      columns.push_back({"its bound", {"other_bound"}});
      columns.emplace_back("difference");
      columns.emplace_back("digits");
      return columns;
    }

    /// The fewest digits with which no two different coordinates look alike.
    int digits_of_places(const Certificate &certificate)
    {
      constexpr int fewest = 4, most = 17;
      std::set<double> places;
      for (const CertifiedValue &one : certificate.points)
        places.insert(one.x.begin(), one.x.end());
      for (int n_digits = fewest; n_digits < most; ++n_digits)
      {
        std::set<std::string> texts;
        for (const double x : places)
          texts.insert(base::to_text(x, n_digits));
        if (texts.size() == places.size())
          return n_digits;
      }
      return most;
    }

    std::vector<Cell> row_of(const CertifiedValue &one, std::size_t dimension, int n_digits)
    {
      std::vector<Cell> row;
      for (const double x : one.x)
      {
        row.push_back(number_cell(x));
        row.back().text = base::to_text(x, n_digits);
      }
      if (one.x.empty())
      {
        row.push_back(text_cell("mean"));
        row.insert(row.end(), dimension - 1, empty_cell());
      }
      for (const double u : one.value)
        row.push_back(value_cell(u, one.bound));
      row.push_back(error_cell(one.bound));
      for (const double u : one.other)
        row.push_back(value_cell(u, one.other_bound));
      row.push_back(error_cell(one.other_bound));
      row.push_back(error_cell(one.difference()));
      row.push_back(count_cell(one.digits));
      return row;
    }

    std::string way_text(const study::CertifiedWay &way, const std::string &what)
    {
      std::string sizes;
      for (const double h : way.h)
        sizes += (sizes.empty() ? "" : ", ") + text(h);
      return way.method + " (" + what + "): h = " + sizes +
             (std::isfinite(way.order) ? "; order " + text(way.order) : "") +
             (std::isfinite(way.error) ? "; largest true error " + text(way.error) : "");
    }
  } // namespace

  Table certificate_table(const Certificate &certificate, bool has_mean)
  {
    Table table{"", columns_of(certificate), {}};
    const std::size_t dimension = certificate.points.front().x.size();
    const int n_digits = digits_of_places(certificate);
    for (const CertifiedValue &one : certificate.points)
      table.rows.push_back(row_of(one, dimension, n_digits));
    if (has_mean && certificate.mean)
      table.rows.push_back(row_of(*certificate.mean, dimension, n_digits));
    return table;
  }

  Table rules_table(const study::Certificate &certificate)
  {
    constexpr int n_digits = 4;
    Table table{"", {"rule"}, {}};
    if (certificate.rules.empty())
      return table;
    for (const double h : certificate.rules.front().h)
      table.columns.emplace_back("rms error, h = " + base::to_text(h, n_digits));
    table.columns.emplace_back("order");
    table.columns.emplace_back("digits");
    for (const study::CertifiedRule &rule : certificate.rules)
    {
      std::vector<Cell> row = {text_cell(rule.method)};
      for (const double error : rule.root_mean_square)
        row.push_back(error_cell(error));
      row.push_back(std::isfinite(rule.order) ? rate_cell(rule.order) : empty_cell());
      row.push_back(count_cell(rule.digits.back()));
      table.rows.push_back(std::move(row));
    }
    return table;
  }

  namespace
  {
    std::string answer_of(const Certificate &certificate)
    {
      return counted(certificate.points.size(), "value") + " certified to at least " +
             std::to_string(certificate.least_digits()) + " digits by " +
             certificate.galerkin.method + ", confirmed to " +
             std::to_string(certificate.confirmed_digits()) + " by " + certificate.meshfree.method +
             (certificate.mean
                  ? "; the mean to " + std::to_string(certificate.mean->digits) + " digits"
                  : "");
    }

    /// For a terminal: as many values as there is room for.
    std::string shown(const Certificate &certificate)
    {
      constexpr std::size_t room = 16;
      std::string text;
      for (const std::string &line : first_lines(
               lines_of(to_text(certificate_table(certificate, true))), room, "in certificate.md"))
        text += line + '\n';
      return text;
    }
  } // namespace

  std::string certificate_markdown(const Certificate &certificate)
  {
    return "# Certificate: " + certificate.name + "\n\n" + certificate.purpose + "\n\n" +
           answer_of(certificate) + ". Bounds hold in practice and are not proven; digits are " +
           "relative to " + text(certificate.size) + ", the root mean square of the values.\n\n- " +
           way_text(certificate.galerkin, "certified") + "\n- " +
           way_text(certificate.meshfree, "confirms") + "\n- horizon " + text(certificate.horizon) +
           "\n- plumbline " + certificate.version + "\n- SHA-256 of the scene's text: `" +
           certificate.hash + "`\n\n" + to_markdown(certificate_table(certificate, true)) +
           "\n## Meshfree rules at these points\n\n" + to_markdown(rules_table(certificate)) +
           "\n## Scene\n\n```\n" + certificate.scene_text + "```\n";
  }

  std::string certificate_summary(const Certificate &certificate, const std::string &file)
  {
    return heading(certificate.name, certificate.purpose) + '\n' +
           way_text(certificate.galerkin, "certified") + '\n' +
           way_text(certificate.meshfree, "confirms") + "\n\n" + shown(certificate) +
           "\ncertificate: " + file + "\n\n" + wrapped(answer_of(certificate), summary_columns, 2) +
           '\n';
  }

  namespace
  {
    /// Where u jumps, a continuous space has no accuracy.
    std::string or_discontinuous(const Certificate &certificate)
    {
      const std::string &method = certificate.galerkin.method;
      return method.rfind("DG", 0) == 0 || method.empty()
                 ? ""
                 : "; where u may jump, as at the domain boundary or where the load jumps, use "
                   "the "
                   "discontinuous space, Reference/method = DG" +
                       method;
    }

    /// Why values are refused.
    std::string reason_of(const Certificate &certificate,
                          const std::vector<const CertifiedValue *> &refused)
    {
      std::size_t n_without = 0, n_wrong = 0;
      for (const CertifiedValue *one : refused)
      {
        n_without += one->has_bounds() ? 0 : 1;
        n_wrong += one->error() > one->bound ? 1 : 0;
      }
      const std::string of =
          " of " + counted(certificate.points.size() + (certificate.mean ? 1 : 0), "value");
      if (n_without > 0)
        return "there is no bound for " + std::to_string(n_without) + of +
               ": changes from level to level do not decrease, or the error of outer "
               "quadrature is not estimated; give finer levels (Study/h), another rule, or "
               "Quadrature/tolerance > 0" +
               or_discontinuous(certificate);
      if (n_wrong > 0)
        return "the known solution contradicts " + std::to_string(n_wrong) + of +
               ": they differ by more than the bound; is Problem/solution correct for this load?";
      return certificate.galerkin.method + " and " + certificate.meshfree.method +
             " disagree about " + std::to_string(refused.size()) + of +
             ": they differ by more than both bounds; one of them is wrong, or its levels are "
             "too coarse for its bound" +
             or_discontinuous(certificate);
    }

    /// A certificate of no digits says nothing.
    std::string without_digits(const Certificate &certificate)
    {
      const bool is_galerkin = certificate.least_digits() == 0;
      if (!is_galerkin && certificate.confirmed_digits() > 0)
        return "";
      return "the bound of " + (is_galerkin ? certificate.galerkin : certificate.meshfree).method +
             " does not confirm a single digit at some points, relative to the root mean square of "
             "u, " +
             text(certificate.size) + "; " +
             (is_galerkin ? "give a finer mesh (--reference-level, Study/h) or a higher degree"
                          : "give finer levels (Study/h) or another rule") +
             or_discontinuous(certificate);
    }
  } // namespace

  std::string certificate_refusal(const Certificate &certificate)
  {
    const auto refused = certificate.refused();
    return refused.empty() ? without_digits(certificate) : reason_of(certificate, refused);
  }

  namespace
  {
    std::string of_grade(double value)
    {
      constexpr int n_digits = 3;
      return std::isfinite(value) ? base::to_text(value, n_digits) : "–";
    }

    Table table_of(const study::SeriesGrade &found, bool has_sizes)
    {
      Table table{"", {"file"}, {}};
      if (has_sizes)
        table.columns.emplace_back("h");
      for (const char *const head : {"largest error", "rms error", "digits"})
        table.columns.emplace_back(head);
      if (has_sizes)
        table.columns.emplace_back("order");
      for (const study::Grade &one : found.grades)
      {
        std::vector<Cell> row = {text_cell(one.name)};
        if (has_sizes)
          row.push_back(number_cell(one.h));
        row.push_back(error_cell(one.largest));
        row.push_back(error_cell(one.root_mean_square));
        row.push_back(text_cell((one.is_at_least ? "at least " : "") + std::to_string(one.digits)));
        if (has_sizes)
          row.push_back(std::isfinite(one.order) ? rate_cell(one.order) : empty_cell());
        table.rows.push_back(std::move(row));
      }
      return table;
    }

    std::string answer_of(const study::SeriesGrade &found, bool has_sizes)
    {
      const study::Grade &finest = found.finest();
      std::string answer = std::string(finest.is_at_least ? "at least " : "") +
                           std::to_string(finest.digits) + " digits" +
                           (found.grades.size() > 1 ? " in " + finest.name : "");
      if (has_sizes && found.grades.size() > 1)
        answer += "; order " + of_grade(found.order.value) + "; " + base::word(found.limit) + ": " +
                  found.reason;
      return answer;
    }
  } // namespace

  std::string grade_text(const study::Certificate &certificate, const study::SeriesGrade &found)
  {
    const bool has_sizes = found.finest().h > 0;
    return heading(certificate.name, certificate.purpose) + '\n' +
           std::to_string(certificate.points.size()) + " points, certified to at least " +
           std::to_string(certificate.least_digits()) + " digits; errors are relative to " +
           of_grade(certificate.size) + "\n\n" + to_text(table_of(found, has_sizes)) +
           "\nMeshfree rules of Plumbline at the same points:\n" +
           to_text(rules_table(certificate)) + '\n' +
           wrapped(answer_of(found, has_sizes), summary_columns, 2) + '\n';
  }
} // namespace plumbline::report
