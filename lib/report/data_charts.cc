#include "report/data_charts.h"

namespace plumbline::report
{
  DataChart named(const std::string &name, const std::string &title, const std::string &caption)
  {
    DataChart chart;
    chart.name = name;
    chart.caption = caption;
    chart.plot.file = name + ".svg";
    chart.plot.title = title;
    return chart;
  }

  void write_charts(const std::vector<DataChart> &charts, const std::filesystem::path &folder)
  {
    if (charts.empty())
      return;
    std::vector<Plot> plots;
    std::vector<std::string> pictures;
    for (const DataChart &chart : charts)
    {
      write_file(folder / (chart.name + ".csv"), to_csv(chart.data));
      plots.push_back(chart.plot);
      pictures.push_back(chart.plot.file);
    }
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
