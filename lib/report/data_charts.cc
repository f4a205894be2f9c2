#include "report/data_charts.h"

#include "report/page_script.h"

#include <algorithm>

namespace plumbline::report
{
  Style style_of(const std::vector<MethodName> &methods, const std::string &name)
  {
    unsigned int n_of_family[2] = {0, 0};
    for (const MethodName &method : methods)
    {
      unsigned int &n = n_of_family[method.is_reference() ? 1 : 0];
      if (method.name == name)
        return style_of(n, method.is_reference());
      ++n;
    }
    return style_of(0, false);
  }

  DataChart named(const std::string &name, const std::string &title, const std::string &caption)
  {
    DataChart chart;
    chart.name = name;
    chart.caption = caption;
    chart.plot.file = name + ".svg";
    chart.plot.title = title;
    return chart;
  }

  DataChart linear_chart(const std::string &name, const std::string &title,
                         const std::string &x_label, const std::string &y_label,
                         const std::string &caption)
  {
    DataChart chart = named(name, title, caption);
    chart.plot.x_label = x_label;
    chart.plot.y_label = y_label;
    chart.plot.is_x_log = chart.plot.is_y_log = false;
    return chart;
  }

  Line long_line(const std::string &label, unsigned int style, std::vector<Vertex> points)
  {
    const auto interval = static_cast<unsigned int>(points.size() / 12 + 1);
    return {label, style_of(style, false), 1.8, std::move(points), interval};
  }

  Line dashed_line(const std::string &label, unsigned int style, std::vector<Vertex> points)
  {
    Line line = long_line(label, style, std::move(points));
    line.style = style_of(style, true);
    line.width = 1.4;
    return line;
  }

  void fit_y(Plot &plot)
  {
    constexpr double margin = .06;
    Range range;
    for (const Line &line : plot.lines)
      for (const Vertex &v : line.points)
        range = {std::min(range.low, v.y), std::max(range.high, v.y)};
    const double rim = margin * (range.high - range.low);
    plot.y_range = Range{range.low < 0 ? range.low - rim : 0, range.high + rim};
  }

  void write_charts(const std::vector<DataChart> &charts, const std::filesystem::path &folder)
  {
    if (charts.empty())
      return;
    std::vector<Plot> plots;
    std::vector<std::string> pictures;
    for (const DataChart &chart : charts)
    {
      std::filesystem::remove(folder / chart.plot.file); // no old picture beside new data
      write_file(folder / (chart.name + ".csv"), to_csv(chart.data));
      plots.push_back(chart.plot);
      pictures.push_back(chart.plot.file);
    }
    write_chart_data(plots, folder);
    write_file(folder / "charts.gp", gnuplot_script(plots));
    run_gnuplot(folder, "charts.gp", pictures);
  }

  void write_with_pictures(const std::filesystem::path &file, const std::function<void()> &draw,
                           const std::function<std::string()> &page)
  {
    try
    {
      draw();
    }
    catch (const std::exception &)
    {
      write_file(file, page());
      throw;
    }
    write_file(file, page());
  }
} // namespace plumbline::report
