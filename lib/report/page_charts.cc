#include "report/page_parts.h"

#include "report/formats.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

namespace plumbline::report::page
{
  namespace
  {
    /// With more charts than this the page shows the first of a kind large and the rest small.
    constexpr std::size_t n_large = 6;

    void replace_all(std::string &text, const std::string &from, const std::string &to)
    {
      for (std::size_t at = text.find(from); at != std::string::npos;
           at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    }

    /// Drop what stands between two marks, the first time.
    void erase(std::string &text, const std::string &from, const std::string &to)
    {
      const std::size_t begin = text.find(from);
      const std::size_t end = begin == std::string::npos ? begin : text.find(to, begin);
      if (end != std::string::npos)
        text.erase(begin, end + to.size() - begin);
    }

    std::string figure(const Chart &chart, const std::filesystem::path &dir, std::size_t number,
                       bool is_large)
    {
      std::ifstream in(dir / "charts" / (chart.name + ".svg"), std::ios::binary);
      const std::string svg((std::istreambuf_iterator<char>(in)), {});
      std::string text = is_large ? "<figure class=\"large\">\n" : "<figure>\n";
      text += svg.empty() ? "<p class=\"warning\">" + escape_html(chart.title) +
                                ": not drawn; install gnuplot-nox and call plumbline report on "
                                "this folder.</p>\n"
                          : inline_svg(svg, "c" + std::to_string(number) + "-", chart.title);
      return text + "<figcaption>Data: <code>charts/" + escape_html(chart.name) +
             ".csv</code></figcaption>\n</figure>\n";
    }

    struct Section
    {
      ChartKind kind;
      const char *id, *head, *text;
    };

    const Section sections[] = {
        {ChartKind::work_precision, "work", "Work and precision",
         "Work is setup (weights or entries, and geometry as far as they need it) and solve. Lower "
         "left is better: a smaller error for less work. Each point is a level of the sweep; "
         "where several series share a chart, a line ends where more work gains nothing; "
         "the grey band joins the points that no other beats. Solid lines with filled symbols are "
         "meshfree rules, dashed lines with open symbols are Galerkin methods. Errors of the size "
         "of rounding (below 1e-10), if there are any beside larger ones, stand in a grey strip: a "
         "row for each method, not to scale."},
        {ChartKind::convergence, "convergence", "Convergence",
         "A method that converges follows a slope triangle; one that stalls turns level; one that "
         "is exact to rounding runs in the grey strip."},
        {ChartKind::error_map, "maps", "Where the error sits",
         "The largest error in each block of cells at the finest level. One colour scale for all "
         "methods; dark is "
         "accurate, white lies outside the domain."},
        {ChartKind::memory, "memory", "Memory", "Error against the largest memory in use."},
        {ChartKind::pairs, "pairs", "Unknowns × bonds",
         "Error against the pairs of unknowns that one application of the operator sums over: a "
         "cost that no machine or program changes."},
        {ChartKind::iterations, "iterations", "Iterations",
         "Iterations of the linear solver as the mesh is refined."}};

    /// What is in no method's work: meshes, and cells of nodes, of the dearest level.
    std::string geometry_words(const study::Results &results)
    {
      double of_mesh = 0, of_nodes = 0;
      for (const study::Run &run : results.runs)
      {
        double &most = run.side == study::Side::meshfree ? of_nodes : of_mesh;
        most = std::max(most, run.geometry_seconds);
      }
      std::string text;
      if (of_mesh > 0)
        text = "the mesh of Galerkin methods, up to " + rounded_seconds(of_mesh) + " a level";
      if (of_nodes > 0)
        text += (text.empty() ? "" : "; ") +
                ("mesh and cells of meshfree nodes, up to " + rounded_seconds(of_nodes)) +
                " a level";
      return text.empty() ? text : " Not in it, since methods share it: " + text + " of CPU time.";
    }
  } // namespace

  std::string marker(const Style &style)
  {
    static const char *const shapes[] = {"<circle cx='14' cy='8' r='4'/>",
                                         "<rect x='10.4' y='4.4' width='7.2' height='7.2'/>",
                                         "<path d='M14 3.2 L18.6 11 H9.4 Z'/>",
                                         "<path d='M14 3 L19 8 L14 13 L9 8 Z'/>",
                                         "<path d='M14 12.8 L18.6 5 H9.4 Z'/>",
                                         "<path d='M14 3.4 L18.5 6.7 L16.8 12 H11.2 L9.5 6.7 Z'/>"};
    const std::string fill = style.is_dashed ? "#fff" : style.colour;
    return "<svg class=\"marker\" width=\"28\" height=\"16\" aria-hidden=\"true\" stroke=\"" +
           style.colour + "\" stroke-width=\"1.6\" fill=\"" + fill + "\"><path d='M0 8 H28'" +
           (style.is_dashed ? " stroke-dasharray='5 3'" : "") + "/>" + shapes[style.symbol] +
           "</svg>";
  }

  std::string inline_svg(const std::string &svg, const std::string &prefix,
                         const std::string &label)
  {
    const std::size_t begin = svg.find("<svg"), end = svg.find('>', begin);
    if (begin == std::string::npos || end == std::string::npos)
      return "";
    const std::string tag = svg.substr(begin, end - begin);
    std::string box;
    if (const std::size_t at = tag.find("viewBox=\""); at != std::string::npos)
      box = tag.substr(at, tag.find('"', at + 9) + 1 - at);

    std::string body = svg.substr(end + 1);
    erase(body, "<title>", "</title>"); // the first is the program's
    erase(body, "<desc>", "</desc>");
    replace_all(body, "xlink:href=", "href=");
    for (const char *quote : {"'", "\""})
    {
      replace_all(body, std::string(" id=") + quote, std::string(" id=") + quote + prefix);
      replace_all(body, std::string("href=") + quote + "#",
                  std::string("href=") + quote + "#" + prefix);
    }
    replace_all(body, "url(#", "url(#" + prefix);
    return "<svg " + box + " role=\"img\" aria-label=\"" + escape_html(label) + "\">" + body;
  }

  std::string charts(const study::Results &results, const std::filesystem::path &dir)
  {
    const std::vector<Chart> all = list_charts(results);
    const std::string main_problem = telling_problem(results);
    std::vector<Case> of_overall;
    for (const Case &one : cases(results))
      if (one.problem == main_problem)
        of_overall.push_back(one);
    const bool are_many = all.size() > n_large;

    std::string text;
    std::size_t number = 0;
    for (const Section &section : sections)
    {
      std::string large, small;
      std::size_t n_small = 0;
      const bool is_minor = section.kind == ChartKind::memory || section.kind == ChartKind::pairs ||
                            section.kind == ChartKind::iterations;
      for (const Chart &chart : all)
      {
        if (chart.kind != section.kind)
          continue;
        // With one series the overall chart is this very picture.
        if (section.kind == ChartKind::work_precision && !is_overall(chart) &&
            of_overall.size() == 1 && chart.problem == of_overall.front().problem &&
            is_overall(all.front()))
          continue;
        const bool is_main = section.kind == ChartKind::error_map || chart.problem == main_problem;
        const bool is_large = !is_minor && (!are_many || (is_main && large.empty()));
        (is_large ? large : small) += figure(chart, dir, number++, is_large);
        n_small += is_large ? 0 : 1;
      }
      if (large.empty() && small.empty())
        continue;
      const std::string id = section.id, head = section.head;
      const std::string words =
          section.text +
          (section.kind == ChartKind::work_precision ? geometry_words(results) : std::string());
      const std::string grid = "<div class=\"grid\">\n" + small + "</div>\n";
      const std::string of_each = " by problem and series (" + std::to_string(n_small) + ")";
      if (is_minor)
        text += "<section id=\"" + id + "\">\n" +
                folded(head + of_each, "<p>" + words + "</p>\n" + grid) + "</section>\n";
      else
        text += "<section id=\"" + id + "\">\n<h2>" + head + "</h2>\n<p>" + words + "</p>\n" +
                large + (n_small > 0 ? folded(head + of_each, grid, n_small <= n_large) : "") +
                "</section>\n";
    }
    return text;
  }
} // namespace plumbline::report::page
