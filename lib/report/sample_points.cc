#include "report/sample_points.h"

#include "report/counted.h"
#include "report/formats.h"

#include <cmath>

namespace plumbline::report
{
  namespace
  {
    std::string name_of(const study::SampleSet &set, bool has_several_rules)
    {
      return "weight of " + counted(set.samples.size(), "sample") +
             (has_several_rules ? " by " + base::word(set.rule) : "") +
             (set.n_modes > 0 ? " with " + counted(set.n_modes, "mode") : "");
    }
  } // namespace

  void write_sample_points(const study::SamplingPlan &plan,
                           const std::vector<std::string> &variables,
                           const std::filesystem::path &file)
  {
    Table table;
    table.columns = {"sample"};
    table.columns.insert(table.columns.end(), variables.begin(), variables.end());
    for (std::size_t i = 0; i < plan.values.size(); ++i)
    {
      table.rows.push_back({count_cell(i)});
      for (const double value : plan.values[i])
        table.rows.back().push_back(number_cell(value));
      table.rows.back().resize(1 + variables.size() + plan.sets.size(), empty_cell());
    }
    const bool has_several_rules = plan.last_like(0) + 1 < plan.sets.size();
    for (std::size_t s = 0; s < plan.sets.size(); ++s)
    {
      const study::SampleSet &set = plan.sets[s];
      table.columns.push_back(name_of(set, has_several_rules));
      for (std::size_t k = 0; k < set.samples.size(); ++k)
        table.rows[set.samples[k]][1 + variables.size() + s] = number_cell(set.weights[k]);
    }
    write_file(file, to_csv(table));
  }

  void write_modes(const uq::Expansion &expansion, const dealii::Point<2> &origin,
                   const std::filesystem::path &file)
  {
    Table table;
    table.columns = {"x", "y", "mean", "standard deviation"};
    for (unsigned int k = 1; k <= expansion.n_modes(); ++k)
      table.columns.push_back("mode " + std::to_string(k));
    const uq::Grid &grid = expansion.grid;
    for (int j = 0; j < grid.n[1]; ++j)
      for (int i = 0; i < grid.n[0]; ++i)
      {
        const auto node = static_cast<std::size_t>(j) * grid.n[0] + i;
        const dealii::Point<2> x = grid.node(i, j);
        table.rows.push_back({number_cell(origin[0] + x[0]), number_cell(origin[1] + x[1]),
                              number_cell(expansion.mean[node]),
                              number_cell(std::sqrt(expansion.variance[node]))});
        for (unsigned int k = 0; k < expansion.n_modes(); ++k)
          table.rows.back().push_back(
              number_cell(std::sqrt(expansion.eigenvalue[k]) * expansion.mode[k][node]));
      }
    write_file(file, to_csv(table));
  }
} // namespace plumbline::report
