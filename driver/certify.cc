#include "driver/certify.h"

#include "base/error.h"
#include "base/first_rank.h"
#include "base/progress_line.h"
#include "base/sha256.h"
#include "base/text_file.h"
#include "driver/interrupts.h"
#include "driver/methods.h"
#include "io/certificate_json.h"
#include "io/certified_values.h"
#include "io/output_folder.h"
#include "io/point_values.h"
#include "report/certificate_text.h"
#include "scene/on_line.h"
#include "study/preflight.h"

#include <iostream>
#include <optional>

namespace plumbline::driver
{
  namespace fs = std::filesystem;
  using study::Certificate;

  namespace
  {
    void write(const Certificate &certificate, const fs::path &folder)
    {
      base::write_file(folder / "certificate.json", io::to_json(certificate));
      base::write_file(folder / "certificate.csv",
                       report::to_csv(report::certificate_table(certificate, false)));
      base::write_file(folder / "certificate.md", report::certificate_markdown(certificate));
    }
  } // namespace

  Certificate certificate_of(const scene::Scene &scene, unsigned int reference_level,
                             const std::function<void()> &begin)
  {
    study::check_certifiable(scene);
    const io::PointValues points(scene);
    points.require_distinct();
    const study::CertifiedWays ways = study::certified_ways(scene, all_methods(), reference_level);
    study::check_data(scene);
    begin();
    Certificate certificate =
        is_on_intervals(scene)
            ? study::certify(scene, *ways.galerkin, ways.rules, ways.level,
                             [&](const problem::Problem<1> &one) { return points.of(one); })
        : scene.domain.is_in_space()
            ? study::certify(scene, *ways.galerkin, ways.rules, ways.level,
                             [&](const problem::Problem<3> &one) { return points.of(one); })
            : study::certify(scene, *ways.galerkin, ways.rules, ways.level,
                             [&](const problem::Problem<2> &one) { return points.of(one); });
    certificate.hash = base::sha256(certificate.scene_text);
    certificate.version = PLUMBLINE_VERSION;
    return certificate;
  }

  void check_certified(const Certificate &certificate, bool shows_values)
  {
    const study::CertifiedPlaces places(certificate);
    for (std::size_t i = 0; i < certificate.points.size(); ++i)
      if (const auto &x = certificate.points[i].x; places.find(x) != i)
        throw InputError("Output/points: " + io::place_text(x) + " is listed twice; remove one");
    if (!(certificate.size > 0))
      throw NumericalError("nothing is certified: u is 0 at all points, and digits are relative "
                           "to its size; give a load, or other points");
    const std::string refusal = report::certificate_refusal(certificate);
    if (refusal.empty())
      return;
    if (shows_values)
      std::cerr << report::to_text(report::certificate_table(certificate, true));
    throw NumericalError("nothing is certified: " + refusal);
  }

  int certify(const CertifyOptions &options)
  {
    end_at_interrupts();
    // every rank solves, and they share the work on meshes; the first one talks and writes
    const base::Communicator ranks = base::Communicator::all();
    const bool is_first = ranks.rank() == 0, is_quiet = options.quiet || !is_first;
    const scene::Scene scene = read_scene(options);
    const fs::path folder = output_folder(options, scene);
    std::optional<io::OutputFolder> output;
    std::optional<base::ProgressLine> progress;
    const Certificate certificate = certificate_of(
        scene, options.reference_level,
        [&]
        {
          output.emplace(folder, io::OutputFolder::Owner{"certify", scene.name, scene.text, note},
                         ranks);
          progress.emplace(!is_quiet);
          progress->show("certify", 0);
        });
    progress.reset();
    check_certified(certificate, is_first);
    base::on_first_rank(ranks, [&] { write(certificate, folder); });
    if (is_first && options.json)
      std::cout << io::to_json(certificate);
    else if (!is_quiet)
      std::cout << report::certificate_summary(certificate, (folder / "certificate.json").string());
    return 0;
  }
} // namespace plumbline::driver
