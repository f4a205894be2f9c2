#include "report/energy_table.h"

#include "report/formats.h"
#include "study/solution_record.h"

namespace plumbline::report
{
  Table energy_table(const study::StudyResults &results)
  {
    Table table;
    table.columns = {"method",
                     "case",
                     "series",
                     "h [length]",
                     "horizon [length]",
                     "target",
                     "energy",
                     "energy of the target",
                     "energy / energy of the target - 1",
                     "error in the energy norm",
                     "relative"};
    for (const study::Record &run : results.records)
    {
      if (!run.has("energy"))
        continue;
      const auto names = [&](const std::string &target) -> std::vector<Cell>
      {
        return {text_cell(run.key.method), text_cell(run.key.problem),   text_cell(run.key.series),
                number_cell(run.key.h),    number_cell(run.key.horizon), text_cell(target),
                number_cell(run["energy"])};
      };
      bool has_target = false;
      for (const std::string target : {"exact", "local"})
      {
        const std::string of_target = "energy of " + target, error = "energy | " + target;
        if (!run.has(of_target))
          continue;
        has_target = true;
        const double size = study::size_of(run, error);
        std::vector<Cell> row = names(target);
        row.push_back(number_cell(run[of_target]));
        row.push_back(run[of_target] != 0 ? error_cell(run["energy"] / run[of_target] - 1)
                                          : empty_cell());
        row.push_back(run.has(error) ? error_cell(run[error])
                                     : text_cell("none: not positive definite"));
        row.push_back(run.has(error) && size > 0 ? error_cell(run[error] / size) : empty_cell());
        table.rows.push_back(std::move(row));
      }
      if (!has_target)
      {
        std::vector<Cell> row = names("");
        row.resize(table.columns.size(), empty_cell());
        table.rows.push_back(std::move(row));
      }
    }
    return table;
  }
} // namespace plumbline::report
