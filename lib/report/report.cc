#include "report/report.h"

#include "base/error.h"
#include "io/results_json.h"
#include "report/charts.h"
#include "report/page.h"
#include "report/tables.h"

namespace plumbline::report
{
  void write_report(const study::StudyResults &results, const std::filesystem::path &dir)
  {
    write_file(dir / "results.json", io::to_json(results));
    write_tables(results, dir);
    try
    {
      write_charts(results, dir);
    }
    catch (const std::exception &)
    {
      write_page(results, dir); // it says what is missing
      throw;
    }
    write_page(results, dir);
  }
} // namespace plumbline::report
