// Toughness over a fraction on one page, from the samples of benchmarks/toughness.
// Run: build/release/benchmarks/toughness_page FOLDER, which writes study.html, study.csv and
// charts there.

#include "toughness_study.h"

#include "base/error.h"
#include "report/page_parts.h"

#include <iostream>

namespace plumbline::toughness
{
  namespace page = report::page;

  namespace
  {
    std::string words(const Study &study)
    {
      std::string text =
          "K by counts takes each broken bond for its part of a straight crack's length (Fan et "
          "al. 2022, doi:10.1016/j.cma.2022.115340, eqs. (5.2), (5.3)) and uses no load: it is "
          "that "
          "of the phase at fractions 0 and 1 whatever happens. K by energy is what bonds held and "
          "what was released: lattices trap cracks, and pieces of unstable growth release more "
          "than bonds take. ";
      for (const Entry &entry : study.entries)
        if (entry.variance_kept)
          text += "At " + report::rounded(entry.fraction) + " " + entry.rule + " keep " +
                  report::rounded(100 * *entry.variance_kept) + " % of the variance. ";
      return text + "Samples of few modes are nearly the mean material, and follow the mean field, "
                    "a curve close to the line between the phases, for that reason.";
    }

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
    std::string crack_section(const Study &study)
    {
      if (study.cracks.empty())
        return "";
      std::string pictures;
      for (const Crack &crack : study.cracks)
        pictures += page::figure(
            crack.picture, crack.picture.parent_path().parent_path().filename().string() + "-",
            title_of(crack),
            "<b>" + report::escape_html(title_of(crack)) + "</b>, realisation " +
                std::to_string(crack.realisation) +
                " of the Monte Carlo samples. Report: <a href=\"" +
                report::escape_html(
                    fs::path(crack.picture.parent_path().parent_path().filename() / "grow.html")
                        .string()) +
                "\">grow.html</a>",
            false);
      return page::section(
          "cracks", "Cracks in their microstructures",
          page::paragraph(
              "Of one sample at each fraction. Grey: G of the nodes, crystals dark. Sides "
              "between next neighbours that have parted: of the crack orange, apart from "
              "it blue; of the notch black.") +
              "<div class=\"grid\">\n" + pictures + "</div>\n");
    }

    std::string page_of(const Study &study, const fs::path &folder)
    {
      std::string pictures;
      for (const report::DataChart &chart : study_charts(study))
        pictures +=
            page::figure(folder / chart.plot.file, chart.name + "-", chart.plot.title,
                         chart.caption + " Data: <code>" + chart.name + ".csv</code>", false);
      return page::document(
          study.scene_name, "toughness",
          page::plain_header(study.scene_name, "toughness",
                             "How tough is a material of two phases, over the fraction of one?",
                             {}),
          page::section("picture", "K over the fraction",
                        "<div class=\"grid\">\n" + pictures + "</div>\n") +
              crack_section(study) +
              page::section("numbers", "Numbers",
                            "<div class=\"wide\">" + to_html(study_table(study)) + "</div>\n") +
              page::section("meaning", "What they mean", page::paragraph(words(study))));
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
