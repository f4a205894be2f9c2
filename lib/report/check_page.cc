#include "report/check_page.h"

#include "base/error.h"
#include "report/page_parts.h"
#include "report/plot.h"
#include "report/small_multiples.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    /// Defects below this are rounding, and are drawn like it.
    constexpr double smallest_drawn = 1e-16;

    std::string html(const CheckPage &check, const std::filesystem::path &dir)
    {
      Data data = page::begin("check", check.scene_name, check.purpose, check.facts);
      data["complaints"] = check.complaints;
      data["has_complaints"] = !check.complaints.empty();
      data["verdicts"] = check.verdicts;
      data["map"] = check.defects.empty()
                        ? Data()
                        : Data{{"svg", page::inline_svg(dir / "maps" / "defects.svg", "m-",
                                                        "moment defects over the nodes")}};
      data["parts"] = page::parts(page::with_rows(check.parts));
      return fill("check", data);
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
      out << panels.begin("defects.svg", "Moment defects of the free nodes", "relative defect [1]")
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
