// Toughness over a fraction on one page, from the samples of benchmarks/toughness.
// Run: build/release/benchmarks/toughness_page FOLDER, which writes study.html, study.csv and
// charts there.

#include "templates.h"
#include "toughness_study.h"

#include "base/error.h"
#include "report/page_parts.h"

#include <nlohmann/json.hpp>

#include <iostream>

namespace plumbline::toughness
{
  using report::Data;
  namespace page = report::page;

  namespace
  {
    /// "f = 0.2: K = 1.05 by counts, 1.79 by energy"
    std::string title_of(const Crack &crack)
    {
      std::string title = "f = " + report::rounded(crack.fraction);
      if (crack.by_bonds)
        title += ": K = " + report::rounded(*crack.by_bonds) + " by counts";
      if (crack.by_energy)
        title += ", " + report::rounded(*crack.by_energy) + " by energy";
      return title;
    }

    /// A crack in a microstructure of each fraction that has one.
    Data cracks(const Study &study)
    {
      Data list = Data::array();
      for (const Crack &crack : study.cracks)
      {
        const fs::path sample = crack.picture.parent_path().parent_path().filename();
        list.push_back(
            {{"svg", page::inline_svg(crack.picture, sample.string() + "-", title_of(crack))},
             {"title", title_of(crack)},
             {"realisation", crack.realisation},
             {"report", (sample / "grow.html").string()}});
      }
      return list;
    }

    std::string page_of(const Study &study, const fs::path &folder)
    {
      Data data =
          page::begin("toughness", study.scene_name,
                      "How tough is a material of two phases, over the fraction of one?", {});
      data["charts"] = page::charts(study_charts(study), folder, "");
      data["has_cracks"] = !study.cracks.empty();
      data["cracks"] = cracks(study);
      data["table"] = page::table(study_table(study));
      data["kept"] = Data::array();
      for (const Entry &entry : study.entries)
        if (entry.variance_kept)
          data["kept"].push_back({{"fraction", report::rounded(entry.fraction)},
                                  {"rule", entry.rule},
                                  {"percent", report::rounded(100 * *entry.variance_kept)}});
      return report::fill_text(benchmarks::templates().at("toughness"), data);
    }

    void write_page(const fs::path &folder)
    {
      const Study study = read_study(folder);
      report::write_file(folder / "study.csv", to_csv(study_table(study)));
      report::write_with_pictures(
          folder / "study.html", [&] { report::write_charts(study_charts(study), folder); },
          [&] { return page_of(study, folder); });
    }
  } // namespace
} // namespace plumbline::toughness

int main(int argc, char **argv)
{
  if (argc != 2)
  {
    std::cerr << "usage: toughness_page FOLDER\n";
    return 2;
  }
  try
  {
    plumbline::toughness::write_page(argv[1]);
  }
  catch (const std::exception &error)
  {
    std::cerr << "toughness_page: " << error.what() << '\n';
    return 2;
  }
}
