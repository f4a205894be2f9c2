// Each number stands under its own head: all differ, so that no two can be confused.
#include "report/tables.h"
#include "report/view.h"
#include "study/solution_record.h"
#include "study/stability.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

namespace plumbline::report
{
  namespace
  {
    /// The column with this head; of several, the one with that index among them.
    std::size_t column(const Table &table, const std::string &head, std::size_t index = 0)
    {
      for (std::size_t j = 0; j < table.columns.size(); ++j)
        if (table.columns[j].head == head && index-- == 0)
          return j;
      ADD_FAILURE() << "no column is called " << head;
      return 0;
    }

    /// The number in the first field of a cell as it stands in the CSV.
    double value(const Table &table, std::size_t row, const std::string &head,
                 std::size_t index = 0)
    {
      return std::strtod(table.rows.at(row).at(column(table, head, index)).csv.at(0).c_str(),
                         nullptr);
    }

    std::string text(const Table &table, std::size_t row, const std::string &head,
                     std::size_t index = 0)
    {
      return table.rows.at(row).at(column(table, head, index)).text;
    }

    study::Record make_run(const std::string &method, unsigned int level, double h, double horizon)
    {
      study::Record run;
      run.key.method = method;
      run.key.family = study::MethodFamily::meshfree;
      run.key.problem = "case";
      run.key.series = "series";
      run.key.level = level;
      run.key.h = h;
      run.key.horizon = horizon;
      return run;
    }
  } // namespace

  TEST(ReportColumns, OfCostsAreInTheirUnits)
  {
    study::StudyResults results;
    study::Record run = make_run("FA", 0, .5, 1.5);
    run.cost.n_unknowns = 11;
    run.cost.n_bonds = 12;
    run.set("geometry seconds", 17, "time");
    run.cost.setup_seconds = 13;
    run.cost.solve_seconds = 14;
    run.cost.peak_bytes = 15000000;
    run.cost.n_iterations = 16;
    results.records = {run};
    const Table table = cost_table(results);
    EXPECT_EQ(value(table, 0, "h"), .5);
    EXPECT_EQ(value(table, 0, "unknowns"), 11);
    EXPECT_EQ(value(table, 0, "bonds"), 12);
    EXPECT_EQ(value(table, 0, "geometry CPU s"), 17);
    EXPECT_EQ(value(table, 0, "setup CPU s"), 13);
    EXPECT_EQ(value(table, 0, "solve CPU s"), 14);
    EXPECT_DOUBLE_EQ(value(table, 0, "peak MB"), 15);
    EXPECT_EQ(value(table, 0, "iterations"), 16);
    // a run that was not timed has no times, instead of 0
    results.records[0].cost.setup_seconds = results.records[0].cost.solve_seconds = 0;
    const Table untimed = cost_table(results);
    EXPECT_FALSE(table.caption.empty());
    EXPECT_EQ(untimed.caption, table.caption);
    EXPECT_EQ(untimed.columns.size() + 4, table.columns.size());
    EXPECT_EQ(value(untimed, 0, "iterations"), 16);
  }

  TEST(ReportColumns, OfEstimatesTellWhichChangeIsWhich)
  {
    study::ErrorEstimate estimate;
    estimate.method = "Q2";
    estimate.level = 3;
    estimate.h = .5;
    estimate.horizon = 1.5;
    estimate.h_change = 1e-3;
    estimate.p_change = 2e-4;
    estimate.outer_change = 3e-5;
    estimate.coarse_change = 7e-3;
    estimate.rate = 1.5;
    estimate.estimate = 4e-3;
    estimate.field_estimate = 6e-3;
    estimate.certified_digits = 2;
    const Table table = estimate_table({estimate});
    EXPECT_EQ(value(table, 0, "level"), 3);
    EXPECT_EQ(value(table, 0, "h"), .5);
    EXPECT_EQ(value(table, 0, "δ"), 1.5);
    EXPECT_EQ(value(table, 0, "change with h"), 1e-3);
    EXPECT_EQ(value(table, 0, "before"), 7e-3);
    EXPECT_EQ(value(table, 0, "rate"), 1.5);
    EXPECT_EQ(value(table, 0, "change to p + 1"), 2e-4);
    EXPECT_EQ(value(table, 0, "outer quadrature"), 3e-5);
    EXPECT_EQ(value(table, 0, "estimate, averages"), 4e-3);
    EXPECT_EQ(value(table, 0, "estimate, field"), 6e-3);
    EXPECT_EQ(value(table, 0, "certified digits"), 2);
  }

  TEST(ReportColumns, OfRatesAreThoseOfTheirLevelWhicheverLengthVaries)
  {
    for (const bool is_horizon : {false, true})
    {
      study::StudyResults results;
      results.decisive_error = "nodal Linf | exact";
      study::Trend trend;
      trend.method = "FA";
      trend.family = study::MethodFamily::meshfree;
      trend.problem = "case";
      trend.series = "series";
      trend.error = results.decisive_error;
      trend.axis = is_horizon ? study::Axis::horizon : study::Axis::mesh_size;
      trend.values = {1e-1, 5e-2, 1e-2};
      trend.rates = {1, 2.5};
      for (unsigned int level = 0; level < 3; ++level)
      {
        const double length = std::pow(.5, level);
        study::Record run =
            make_run("FA", level, is_horizon ? .01 : length, is_horizon ? length : 3);
        run.set(results.decisive_error, trend.values[level]);
        results.records.push_back(run);
        trend.x.push_back(length);
      }
      results.trends = {trend};
      const Table table = error_table(results, cases(results).at(0));
      ASSERT_EQ(table.rows.size(), 3u);
      EXPECT_EQ(text(table, 0, "rate"), "–");
      EXPECT_EQ(value(table, 1, "rate"), 1);
      EXPECT_EQ(value(table, 2, "rate"), 2.5);
      EXPECT_EQ(value(table, 2, "FA"), 1e-2);
      results.trends[0].round_off = 5e-3; // half the last error is too much for a rate
      const Table rounded = error_table(results, cases(results).at(0));
      EXPECT_EQ(value(rounded, 1, "rate"), 1);
      EXPECT_EQ(text(rounded, 2, "rate"), "–");
    }
  }

  TEST(ReportColumns, OfVerdictsHaveEachItsOwnUncertainty)
  {
    study::StudyResults results;
    results.decisive_error = "nodal Linf | exact";
    study::Trend trend;
    trend.method = "FA";
    trend.problem = "case";
    trend.series = "series";
    trend.error = results.decisive_error;
    trend.rate = 2;
    trend.rate_uncertainty = .25;
    trend.plateau = 1e-3;
    trend.plateau_uncertainty = 1e-5;
    results.trends = {trend};
    const Table table = trend_table(results);
    const auto fields = [&](const std::string &head)
    {
      std::vector<double> numbers;
      for (const std::string &field : table.rows.at(0).at(column(table, head)).csv)
        numbers.push_back(std::strtod(field.c_str(), nullptr));
      return numbers;
    };
    EXPECT_EQ(fields("rate"), (std::vector<double>{2, .25}));
    EXPECT_EQ(fields("plateau"), (std::vector<double>{1e-3, 1e-5}));
  }

  TEST(ReportColumns, OfDiagnosticsAreTheWorstOfAllRuns)
  {
    study::StudyResults results;
    for (unsigned int level = 0; level < 3; ++level)
    {
      study::Record run = make_run("FA", level, std::pow(.5, level), 3);
      const std::array<double, 3> ratio = {.5, -.25, .75}, residual = {1e-13, 4e-13, 2e-13};
      const std::array<unsigned int, 3> n_neighbours = {28, 20, 24}, n_negative = {0, 7, 3};
      method::Diagnostics diagnostics;
      diagnostics.smallest_weight_ratio = ratio[level];
      diagnostics.relative_residual = residual[level];
      diagnostics.n_neighbours = n_neighbours[level];
      diagnostics.n_negative_weights = n_negative[level];
      study::set_diagnostics(run, diagnostics);
      results.records.push_back(run);
    }
    const Table table = diagnostics_table(results);
    EXPECT_EQ(text(table, 0, "neighbours"), "20 to 28");
    EXPECT_EQ(value(table, 0, "smallest weight ratio"), -.25);
    EXPECT_EQ(value(table, 0, "negative weights"), 7);
    EXPECT_EQ(value(table, 0, "worst residual"), 4e-13);
  }

  TEST(ReportColumns, OfSavingsTellHowManyTimesDearerTheFullModelIs)
  {
    study::StudyResults results;
    study::Saving saving;
    saving.method = "FA";
    saving.h = .5;
    saving.smallest.solve_seconds = .25;
    saving.smallest.n_bonds = 11;
    saving.full.solve_seconds = 2;
    saving.full.n_bonds = 12;
    saving.difference = 3e-14;
    results.savings = {saving};
    const Table table = saving_table(results);
    EXPECT_EQ(text(table, 0, "CPU time"), rounded_seconds(.25));
    EXPECT_EQ(text(table, 0, "full"), rounded_seconds(2));
    EXPECT_EQ(text(table, 0, "times"), "8");
    EXPECT_EQ(value(table, 0, "pairs summed"), 11);
    EXPECT_EQ(value(table, 0, "full", 1), 12);
    EXPECT_EQ(value(table, 0, "largest difference"), 3e-14);
  }

  TEST(ReportColumns, OfStabilityMeasuresAreNotMistakenForEachOther)
  {
    study::Record place;
    place.key.method = "FA";
    place.key.series = "m = 3";
    place.key.h = .1;
    place.key.horizon = .3;
    study::Stability s;
    s.n_unknowns = 11;
    s.smallest = 12;
    s.largest = 13;
    s.has_signs = true;
    s.signs.n_parts = 14;
    s.signs.asymmetry = .25;
    s.inverse_norm = .125;
    s.diagnostics.n_neighbours = 28;
    s.diagnostics.smallest_weight_ratio = .5;
    s.diagnostics.n_conditions = 6;
    s.diagnostics.rank = 5;
    s.diagnostics.smallest_singular_value = .0625;
    for (const bool is_exact : {true, false})
    {
      s.is_norm_exact = is_exact;
      study::StudyResults results;
      results.records = {study::stability_record(place, s, {}, {})};
      const Part measures = stability_view(results).parts.at(0);
      ASSERT_EQ(measures.id, "measures");
      const Table &table = measures.table;
      EXPECT_DOUBLE_EQ(value(table, 0, "m"), 3);
      EXPECT_EQ(value(table, 0, "h"), .1);
      EXPECT_EQ(value(table, 0, "unknowns"), 11);
      EXPECT_EQ(value(table, 0, "smallest"), 12);
      EXPECT_EQ(value(table, 0, "largest"), 13);
      EXPECT_EQ(value(table, 0, "asymmetry"), .25);
      EXPECT_EQ(value(table, 0, "parts"), 14);
      EXPECT_EQ(text(table, 0, "|A^-1|"), is_exact ? "0.125" : ">= 0.125");
      EXPECT_EQ(value(table, 0, "min weight"), .5);
      EXPECT_EQ(text(table, 0, "rank"), "5/6");
      EXPECT_EQ(value(table, 0, "singular"), .0625);
    }
  }
} // namespace plumbline::report
