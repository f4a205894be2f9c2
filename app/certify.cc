#include "certify.h"

#include "base/communicator.h"
#include "base/error.h"
#include "base/number_text.h"
#include "certified_set.h"
#include "io/certificate_json.h"
#include "io/point_values.h"
#include "methods.h"
#include "output_folder.h"
#include "report/text_table.h"
#include "rules_table.h"
#include "run_parts.h"
#include "sha256.h"
#include "study/certificate.h"
#include "study/grade.h"
#include "study/method_names.h"
#include "study/preflight.h"
#include "study/refusal.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

namespace plumbline::app
{
  namespace fs = std::filesystem;
  using study::Certificate;
  using study::CertifiedValue;

  namespace
  {
    std::string text(double value)
    {
      constexpr int n_digits = 4;
      return base::to_text(value, n_digits);
    }

    /// The meshfree rules that the scene names, of which the first one confirms.
    method::Methods rules_of(const scene::Scene &scene, const method::Methods &methods)
    {
      method::Methods rules;
      for (const auto &method : study::choose_methods(scene, methods))
        if (method->family() == method::MethodFamily::meshfree)
          rules.push_back(method);
      if (!rules.empty())
        return rules;
      throw InputError("scene '" + scene.name +
                       "': Methods/names has no meshfree rule, by which values are confirmed; add "
                       "one, e.g. IPA-AC-R2");
    }

    /// For people rounded to a tenth of the bound's decade, which makes zeros of what is none.
    report::Cell value_cell(double value, double bound)
    {
      constexpr int most = 17, fallback = 4;
      report::Cell cell = report::number_cell(value);
      if (!(bound > 0) || !std::isfinite(value))
        return cell;
      const double unit = std::pow(10., std::floor(std::log10(bound)) - 1),
                   shown = std::round(value / unit) * unit + 0.; // no -0
      const double digits =
          shown == 0 ? fallback : std::floor(std::log10(std::abs(shown) / unit)) + 1;
      cell.text = base::to_text(shown, static_cast<int>(std::clamp<double>(digits, 1, most)));
      return cell;
    }

    std::vector<report::Column> columns_of(const Certificate &certificate)
    {
      const auto name = [&](const std::string &word, unsigned int c)
      { return word + (certificate.n_components == 1 ? "" : std::to_string(c + 1)); };
      std::vector<report::Column> columns = {"x", "y"};
      if (certificate.points.front().x.size() == 3)
        columns.emplace_back("z");
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

    std::vector<report::Cell> row_of(const CertifiedValue &one, std::size_t dimension)
    {
      std::vector<report::Cell> row;
      for (const double x : one.x)
        row.push_back(report::number_cell(x));
      if (one.x.empty())
      {
        row.push_back(report::text_cell("mean"));
        row.insert(row.end(), dimension - 1, report::empty_cell());
      }
      for (const double u : one.value)
        row.push_back(value_cell(u, one.bound));
      row.push_back(report::error_cell(one.bound));
      for (const double u : one.other)
        row.push_back(value_cell(u, one.other_bound));
      row.push_back(report::error_cell(one.other_bound));
      row.push_back(report::error_cell(one.difference()));
      row.push_back(report::count_cell(one.digits));
      return row;
    }

    report::Table table_of(const Certificate &certificate, bool has_mean)
    {
      report::Table table{"", columns_of(certificate), {}};
      const std::size_t dimension = certificate.points.front().x.size();
      for (const CertifiedValue &one : certificate.points)
        table.rows.push_back(row_of(one, dimension));
      if (has_mean && certificate.mean)
        table.rows.push_back(row_of(*certificate.mean, dimension));
      return table;
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

    std::string n_values(std::size_t n)
    {
      return std::to_string(n) + (n == 1 ? " value" : " values");
    }

    std::string answer_of(const Certificate &certificate)
    {
      return n_values(certificate.points.size()) + " certified to at least " +
             std::to_string(certificate.least_digits()) + " digits by " +
             certificate.galerkin.method + ", confirmed to " +
             std::to_string(certificate.confirmed_digits()) + " by " + certificate.meshfree.method +
             (certificate.mean
                  ? "; the mean to " + std::to_string(certificate.mean->digits) + " digits"
                  : "");
    }

    std::string markdown_of(const Certificate &certificate)
    {
      return "# Certificate: " + certificate.name + "\n\n" + certificate.purpose + "\n\n" +
             answer_of(certificate) + ". Bounds hold in practice and are not proven; digits are " +
             "relative to " + text(certificate.size) +
             ", the root mean square of the values.\n\n- " +
             way_text(certificate.galerkin, "certified") + "\n- " +
             way_text(certificate.meshfree, "confirms") + "\n- horizon " +
             text(certificate.horizon) + "\n- plumbline " + certificate.version +
             "\n- SHA-256 of the scene's text: `" + certificate.hash + "`\n\n" +
             report::to_markdown(table_of(certificate, true)) +
             "\n## Meshfree rules at these points\n\n" +
             report::to_markdown(table_of_rules(certificate)) + "\n## Scene\n\n```\n" +
             certificate.scene_text + "```\n";
    }

    /// For a terminal: as many values as there is room for.
    std::string shown(const Certificate &certificate)
    {
      constexpr std::size_t room = 16;
      std::string text;
      for (const std::string &line :
           report::first_lines(report::lines_of(report::to_text(table_of(certificate, true))), room,
                               "in certificate.md"))
        text += line + '\n';
      return text;
    }

    /// Why it is refused.
    [[noreturn]] void refuse(const Certificate &certificate)
    {
      std::size_t n_without = 0, n_wrong = 0;
      const auto refused = certificate.refused();
      for (const CertifiedValue *one : refused)
      {
        n_without += one->has_bounds() ? 0 : 1;
        n_wrong += one->error() > one->bound ? 1 : 0;
      }
      const std::string of =
          " of " + n_values(certificate.points.size() + (certificate.mean ? 1 : 0));
      std::string reason;
      if (n_without > 0)
        reason = "there is no bound for " + std::to_string(n_without) + of +
                 ": changes from level to level do not decrease, or the error of outer "
                 "quadrature is not estimated; give finer levels (Study/h), another rule, or "
                 "Quadrature/tolerance > 0";
      else if (n_wrong > 0)
        reason = "the known solution contradicts " + std::to_string(n_wrong) + of +
                 ": it is off by more than the bound; is Problem/solution that of the load?";
      else
        reason = certificate.galerkin.method + " and " + certificate.meshfree.method +
                 " disagree about " + std::to_string(refused.size()) + of +
                 ": they differ by more than both bounds; one of them is wrong, or its levels are "
                 "too coarse for its bound";
      throw NumericalError("nothing is certified: " + reason);
    }

    /// A certificate of no digits says nothing.
    void require_digits(const Certificate &certificate)
    {
      const auto require =
          [&](unsigned int digits, const std::string &method, const std::string &remedy)
      {
        if (digits == 0)
          throw NumericalError("nothing is certified: the bound of " + method +
                               " leaves not one digit certain at some points, relative to the "
                               "root mean square of u, " +
                               text(certificate.size) + "; " + remedy);
      };
      require(certificate.least_digits(), certificate.galerkin.method,
              "give a finer mesh (--reference-level, Study/h) or a higher degree");
      require(certificate.confirmed_digits(), certificate.meshfree.method,
              "give finer levels (Study/h) or another rule");
    }

    scene::Scene read_certifiable(const CertifyOptions &options)
    {
      scene::Scene scene = study::with_names_of(
          scene::read_scene(options.scene_file, options.overrides), all_methods());
      study::check_certifiable(scene);
      return scene;
    }

    /// The reference, which can do the scene.
    std::shared_ptr<const method::Method> reference_of(const scene::Scene &scene,
                                                       const method::Methods &methods)
    {
      const auto method = study::find_method(methods, *scene.reference.method, "Reference/method");
      if (method->family() != method::MethodFamily::reference)
        throw InputError("scene '" + scene.name + "': Reference/method = " + method->name() +
                         " is a meshfree rule; name a Galerkin method, e.g. Q2 or P2");
      return method;
    }

    /// From 0. @throws InputError  there is no such level, or no memory for the two ways
    std::size_t reference_level(const CertifyOptions &options, const scene::Scene &scene,
                                const method::Methods &methods,
                                const std::shared_ptr<const method::Method> &reference,
                                const method::Methods &rules)
    {
      const auto n_levels = static_cast<unsigned int>(scene.study.series.front().levels.size());
      const unsigned int level = options.reference_level == 0 ? n_levels : options.reference_level;
      if (level > n_levels)
        throw InputError("--reference-level = " + std::to_string(level) + ", but Study/h has " +
                         std::to_string(n_levels) + " mesh sizes");
      study::check_memory(scene, {reference}, methods, level);
      scene::Scene of_rule = scene; // that has no reference at its finer levels
      of_rule.reference.method.reset();
      of_rule.reference.estimate = scene::Estimate::none;
      study::check_memory(of_rule, rules, methods, 0);
      return level - 1;
    }

    /// @throws InputError      a point is listed twice
    /// @throws NumericalError  nothing is certified
    void check_result(const Certificate &certificate, bool is_first)
    {
      const study::CertifiedPlaces places(certificate);
      for (std::size_t i = 0; i < certificate.points.size(); ++i)
        if (const auto &x = certificate.points[i].x; places.find(x) != i)
          throw InputError("Output/points: " + place_text(x) + " is listed twice; leave one out");
      if (!(certificate.size > 0))
        throw NumericalError("nothing is certified: u is 0 at all points, and digits are relative "
                             "to its size; give a load, or other points");
      const bool is_refused = !certificate.refused().empty();
      if (is_first &&
          (is_refused || certificate.least_digits() == 0 || certificate.confirmed_digits() == 0))
        std::cerr << report::to_text(table_of(certificate, true));
      if (is_refused)
        refuse(certificate);
      require_digits(certificate);
    }

    void write(const Certificate &certificate, const fs::path &folder)
    {
      base::write_file(folder / "certificate.json", io::to_json(certificate));
      base::write_file(folder / "certificate.csv", report::to_csv(table_of(certificate, false)));
      base::write_file(folder / "certificate.md", markdown_of(certificate));
    }

    std::string summary(const Certificate &certificate, const fs::path &folder)
    {
      return report::heading(certificate.name, certificate.purpose) + '\n' +
             way_text(certificate.galerkin, "certified") + '\n' +
             way_text(certificate.meshfree, "confirms") + "\n\n" + shown(certificate) +
             "\ncertificate: " + (folder / "certificate.json").string() + "\n\n" +
             report::wrapped(answer_of(certificate), report::summary_columns, 2) + '\n';
    }
  } // namespace

  int certify(const CertifyOptions &options)
  {
    end_at_interrupts();
    // every rank solves, and they share the work on meshes; the first one talks and writes
    const base::Communicator ranks = base::Communicator::all();
    const bool is_first = ranks.rank() == 0, is_quiet = options.quiet || !is_first;
    const scene::Scene scene = read_certifiable(options);
    const io::PointValues points(scene);
    const method::Methods methods = all_methods();
    const auto reference = reference_of(scene, methods);
    const method::Methods rules = rules_of(scene, methods);
    const std::size_t level = reference_level(options, scene, methods, reference, rules);
    study::check_data(scene);
    const fs::path folder =
        options.output.empty() ? fs::path("results") / scene.name : fs::path(options.output);
    const OutputFolder output(folder, {"certify", scene.name, scene.text}, ranks);
    std::optional<ProgressLine> progress(!is_quiet);
    progress->show("certify", 0);
    Certificate certificate =
        scene.domain.is_in_space()
            ? study::certify(scene, *reference, rules, level,
                             [&](const problem::Problem<3> &one) { return points.of(one); })
            : study::certify(scene, *reference, rules, level,
                             [&](const problem::Problem<2> &one) { return points.of(one); });
    progress.reset();
    certificate.hash = sha256(certificate.scene_text);
    certificate.version = PLUMBLINE_VERSION;
    check_result(certificate, is_first);
    ranks.together(
        [&]
        {
          if (is_first)
            write(certificate, folder);
        });
    if (is_first && options.json)
      std::cout << io::to_json(certificate);
    else if (!is_quiet)
      std::cout << summary(certificate, folder);
    return 0;
  }
} // namespace plumbline::app
