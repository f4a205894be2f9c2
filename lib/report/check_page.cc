#include "report/check_page.h"

#include "base/error.h"
#include "report/page_parts.h"
#include "report/plot.h"
#include "report/small_multiples.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    /// Defects below this are rounding, and are drawn like it.
    constexpr double smallest_drawn = 1e-16;

    std::string picture_of(const std::filesystem::path &dir)
    {
      std::ifstream in(dir / "maps" / "defects.svg", std::ios::binary);
      const std::string svg((std::istreambuf_iterator<char>(in)), {});
      return "<figure class=\"large\">\n" +
             (svg.empty()
                  ? std::string("<p class=\"warning\">Not drawn; install gnuplot-nox and check "
                                "again.</p>\n")
                  : page::inline_svg(svg, "m-", "moment defects over the nodes")) +
             "<figcaption>Picture: <code>maps/defects.svg</code>; the numbers: "
             "<code>nodes.csv</code>, and on the cells <code>cells.vtu</code></figcaption>\n"
             "</figure>\n";
    }

    std::string list_of(const std::vector<std::string> &items)
    {
      std::string text = "<ul>\n";
      for (const std::string &item : items)
        text += "<li>" + escape_html(item) + "</li>\n";
      return text + "</ul>\n";
    }

    std::string html(const CheckPage &page, const std::filesystem::path &dir)
    {
      const std::string answer =
          page.complaints.empty()
              ? "<p class=\"answer yes\">✓ The weights are as required.</p>\n"
              : "<div class=\"warning\"><b>✗ The weights are not as required.</b>\n" +
                    list_of(page.complaints) + "</div>\n";
      std::string text = page::section("verdicts", "Verdicts", answer + list_of(page.verdicts));
      if (!page.defects.empty())
        text += page::section(
            "maps", "Where the moments are off",
            page::paragraph("The defect of each free node. The same at all nodes: it is the "
                            "rule's own, or all weights share a cause. A few nodes: their bonds "
                            "are wrong. Random from node to node: the rule does not know where "
                            "the nodes are.") +
                picture_of(dir));
      for (const CheckPage::Part &part : page.parts)
        if (!part.table.rows.empty())
          text += page::section(
              part.id, part.head,
              to_html(part.table) +
                  (part.words.empty() ? ""
                                      : "<p class=\"soft\">" + escape_html(part.words) + "</p>\n"));
      return page::document(page.scene_name, "check",
                            page::plain_header(page.scene_name, "check", page.purpose, page.facts),
                            text);
    }

    /// Whole decades around all positive defects.
    Range colour_range(const std::vector<NodeField> &fields)
    {
      double low = std::numeric_limits<double>::max(), high = smallest_drawn;
      for (const NodeField &field : fields)
        for (const double value : field.values)
          if (value > smallest_drawn)
          {
            low = std::min(low, value);
            high = std::max(high, value);
          }
      low = std::pow(10., std::floor(std::log10(std::min(low, high))));
      return {low, std::max(10 * low, std::pow(10., std::ceil(std::log10(high) - 1e-9)))};
    }

    std::string script(const CheckPage &page)
    {
      std::array<double, 2> lower = page.nodes[0], upper = lower;
      for (const auto &node : page.nodes)
        for (unsigned int d = 0; d < 2; ++d)
        {
          lower[d] = std::min(lower[d], node[d]);
          upper[d] = std::max(upper[d], node[d]);
        }
      const double spacing =
          std::sqrt(std::max(1e-300, (upper[0] - lower[0]) * (upper[1] - lower[1])) /
                    static_cast<double>(page.nodes.size()));
      for (unsigned int d = 0; d < 2; ++d)
      {
        lower[d] -= spacing;
        upper[d] += spacing;
      }
      const std::size_t n = page.defects.size();
      const SmallMultiples panels(n, std::min<std::size_t>(n, 2), lower, upper);
      const double pixels = spacing / (upper[0] - lower[0]) * panels.panel_width();
      const Range range = colour_range(page.defects);
      const int decades = static_cast<int>(std::lround(std::log10(range.high / range.low)));
      std::ostringstream out;
      out << "reset\n";
      out.precision(6);
      for (std::size_t i = 0; i < n; ++i)
      {
        out << "$p" << i << " << EOD\n";
        for (std::size_t k = 0; k < page.nodes.size(); ++k)
          out << page.nodes[k][0] << " " << page.nodes[k][1] << " "
              << std::max(page.defects[i].values[k], range.low) << "\n";
        out << "EOD\n";
      }
      out << panels.begin("defects.svg", "defects of the moments over the free nodes",
                          "relative defect [1]")
          << "set palette defined (" << viridis << ")\nset logscale cb\nset cbrange ["
          << exact(range.low) << ":" << exact(range.high) << "]\nset cbtics 1e" << (decades + 7) / 8
          << "\nunset mcbtics\nset format cb '10^{%T}'\n";
      for (std::size_t i = 0; i < n; ++i)
        out << panels.panel(i, page.defects[i].title) << "plot $p" << i
            << " using 1:2:3 with points pt 5 ps " << .12 * pixels << " lc palette notitle\n"
            << SmallMultiples::next();
      out << SmallMultiples::end();
      return out.str();
    }
  } // namespace

  void write_check_page(const CheckPage &page, const std::filesystem::path &dir)
  {
    if (!page.defects.empty() && !page.nodes.empty())
    {
      write_file(dir / "maps" / "maps.gp", script(page));
      try
      {
        run_gnuplot(dir / "maps", "maps.gp", {"defects.svg"});
      }
      catch (const NumericalError &)
      {
        write_file(dir / "report.html", html(page, dir)); // it says what is missing
        throw;
      }
    }
    write_file(dir / "report.html", html(page, dir));
  }
} // namespace plumbline::report
