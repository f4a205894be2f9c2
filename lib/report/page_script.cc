#include "report/page_script.h"

#include "report/formats.h"
#include "report/template.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace plumbline::report
{
  namespace
  {
    const std::string opening = "<script type=\"application/json\" class=\"chart-data\">";

    Data line_data(const std::string &name, const std::string &colour, bool is_dashed,
                   const std::vector<Vertex> &points)
    {
      Data values = Data::array();
      for (const Vertex &v : points)
        if (std::isfinite(v.x) && std::isfinite(v.y))
          values.push_back({v.x, v.y});
      return {{"name", name}, {"colour", colour}, {"dashed", is_dashed}, {"points", values}};
    }
  } // namespace

  void write_chart_data(const std::vector<Plot> &plots, const std::filesystem::path &folder)
  {
    for (const Plot &plot : plots)
    {
      Data lines = Data::array();
      for (const Line &line : plot.lines)
        lines.push_back(
            line_data(line.label, line.style.colour, line.style.is_dashed, line.points));
      const Data data = {{"title", plot.title},
                         {"x", plot.x_label},
                         {"y", plot.y_label},
                         {"xLog", plot.is_x_log},
                         {"yLog", plot.is_y_log},
                         {"lines", lines},
                         {"coincide", coinciding_lines(plot)}};
      write_file((folder / plot.file).replace_extension(".json"), data.dump() + "\n");
    }
  }

  std::string coinciding_lines(const std::filesystem::path &picture)
  {
    std::filesystem::path file = picture;
    std::ifstream in(file.replace_extension(".json"), std::ios::binary);
    const Data data = Data::parse(in, nullptr, false); // no chart: discarded
    return data.is_object() ? data.value("coincide", "") : "";
  }

  std::string chart_data(const std::filesystem::path &picture)
  {
    std::filesystem::path file = picture;
    std::ifstream in(file.replace_extension(".json"), std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(in), {});
    if (text.empty())
      return {};
    // a title must not end the element
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
      text.replace(at, 1, "\\u003c");
    return opening + text + "</script>";
  }

  std::string with_script(std::string page)
  {
    const std::size_t end = page.rfind("</body>");
    if (end == std::string::npos || page.find(opening) == std::string::npos)
      return page;
    return page.insert(end, "<style>\n" + template_text("dygraph_css") + "</style>\n<script>\n" +
                                template_text("dygraph_js") + "</script>\n<script>\n" +
                                template_text("charts_js") + "</script>\n");
  }
} // namespace plumbline::report
