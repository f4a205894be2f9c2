#include "report/pdf.h"

#include "base/error.h"
#include "base/text_file.h"
#include "report/plot.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <vector>

namespace plumbline::report
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr double points_per_inch = 72;

    bool begins(const std::string &line, const std::string &with)
    {
      return line.compare(0, with.size(), with) == 0;
    }

    std::string in_inches(const std::string &pixels)
    {
      return std::to_string(std::strtod(pixels.c_str(), nullptr) / points_per_inch) + "in";
    }

    std::string text_of(const fs::path &file)
    {
      std::ifstream in(file, std::ios::binary);
      return {std::istreambuf_iterator<char>(in), {}};
    }

    std::vector<fs::path> scripts_in(const fs::path &folder)
    {
      std::vector<fs::path> scripts;
      for (const auto &one :
           fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied))
        if (const std::string name = one.path().string();
            one.is_regular_file() && base::has_ending(name, ".gp") &&
            !base::has_ending(name, ".pdf.gp")) // left by a killed process
          scripts.push_back(one.path());
      std::sort(scripts.begin(), scripts.end());
      return scripts;
    }

    /// The names in "set output 'NAME.pdf'".
    std::vector<std::string> pictures_of(const std::string &script)
    {
      static const std::regex output("set output '(.*\\.pdf)'");
      std::vector<std::string> pictures;
      std::istringstream in(script);
      std::smatch found;
      for (std::string line; std::getline(in, line);)
        if (begins(line, "set output") && std::regex_search(line, found, output))
          pictures.push_back(found[1]);
      return pictures;
    }
  } // namespace

  std::string pdf_script(const std::string &svg_script)
  {
    // text, lines and dashes as large as in SVG
    static const std::regex terminal(
        "^set terminal svg size ([0-9.e+]+),([0-9.e+]+) dynamic (.*)$"),
        output("^(set output '.*)\\.svg'$");
    std::string script;
    bool is_ours = false;
    std::istringstream in(svg_script);
    std::smatch found;
    for (std::string line; std::getline(in, line); script += line + "\n")
      if (begins(line, "set terminal") && std::regex_match(line, found, terminal))
      {
        is_ours = true;
        line = "set terminal pdfcairo size " + in_inches(found[1]) + "," + in_inches(found[2]) +
               " " + found[3].str() + " fontscale .75 linewidth 2 dashlength 2";
      }
      else if (begins(line, "set output"))
        line = std::regex_replace(line, output, "$1.pdf'");
    return is_ours ? script : "";
  }

  void require_pdf()
  {
    // gnuplot exits with an error if it lacks the terminal
    if (std::system("gnuplot -e 'set terminal pdfcairo' >/dev/null 2>&1") != 0)
      throw InputError("--pdf needs gnuplot with the terminal pdfcairo, which is missing; apt-get "
                       "install gnuplot-nox, or leave out --pdf");
  }

  void draw_pdf(const fs::path &folder)
  {
    for (const fs::path &script : scripts_in(folder))
    {
      const std::string text = pdf_script(text_of(script)),
                        name = script.stem().string() + ".pdf.gp";
      const std::vector<std::string> pictures = pictures_of(text);
      if (pictures.empty())
        continue;
      base::write_file(script.parent_path() / name, text);
      run_gnuplot(script.parent_path(), name, pictures);
      fs::remove(script.parent_path() / name);
    }
  }
} // namespace plumbline::report
