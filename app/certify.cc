#include "certify.h"

#include "base/communicator.h"
#include "base/error.h"
#include "base/number_text.h"
#include "io/certificate_json.h"
#include "io/certified_values.h"
#include "io/point_values.h"
#include "measures.h"
#include "methods.h"
#include "output_folder.h"
#include "report/certificate_text.h"
#include "report/counted.h"
#include "run_parts.h"
#include "sha256.h"
#include "study/certificate.h"
#include "study/grade.h"
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
          " of " + report::counted(certificate.points.size() + (certificate.mean ? 1 : 0), "value");
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
                               base::to_text(certificate.size, 4) + "; " + remedy);
      };
      require(certificate.least_digits(), certificate.galerkin.method,
              "give a finer mesh (--reference-level, Study/h) or a higher degree");
      require(certificate.confirmed_digits(), certificate.meshfree.method,
              "give finer levels (Study/h) or another rule");
    }

    scene::Scene read_certifiable(const CertifyOptions &options)
    {
      scene::Scene scene = scene_of_file(options.scene_file, options.overrides);
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
          throw InputError("Output/points: " + io::place_text(x) +
                           " is listed twice; leave one out");
      if (!(certificate.size > 0))
        throw NumericalError("nothing is certified: u is 0 at all points, and digits are relative "
                             "to its size; give a load, or other points");
      const bool is_refused = !certificate.refused().empty();
      if (is_first &&
          (is_refused || certificate.least_digits() == 0 || certificate.confirmed_digits() == 0))
        std::cerr << report::to_text(report::certificate_table(certificate, true));
      if (is_refused)
        refuse(certificate);
      require_digits(certificate);
    }

    void write(const Certificate &certificate, const fs::path &folder)
    {
      base::write_file(folder / "certificate.json", io::to_json(certificate));
      base::write_file(folder / "certificate.csv",
                       report::to_csv(report::certificate_table(certificate, false)));
      base::write_file(folder / "certificate.md", report::certificate_markdown(certificate));
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
    const fs::path folder = output_folder(options.output, scene);
    const OutputFolder output(folder, {"certify", scene.name, scene.text}, ranks);
    std::optional<base::ProgressLine> progress(!is_quiet);
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
    on_first_rank(ranks, [&] { write(certificate, folder); });
    if (is_first && options.json)
      std::cout << io::to_json(certificate);
    else if (!is_quiet)
      std::cout << report::certificate_summary(certificate, (folder / "certificate.json").string());
    return 0;
  }
} // namespace plumbline::app
