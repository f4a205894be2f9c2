// What a page of transient analyses advises, and what is kept of a run that was killed.
#include "io/record_journal.h"
#include "report/dynamics_view.h"
#include "study/transient.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::report
{
  namespace
  {
    using study::Records;

    Record run_of(unsigned int level, double step, double error, double seconds)
    {
      Record record;
      record.key.method = "FA";
      record.key.level = level;
      record.texts["scheme"] = "velocity Verlet";
      record.set("time step", step);
      record.set("nodal L2 | exact", error);
      record.cost.solve_seconds = seconds;
      return record;
    }

    StudyResults results_of(const Records &records)
    {
      StudyResults results;
      results.analysis = "dynamics";
      results.decisive_error = "nodal L2 | exact";
      results.records = records;
      return results;
    }

    const Table &table(const View &view, const std::string &id)
    {
      for (const Part &part : view.parts)
        if (part.id == id)
          return part.table;
      throw std::out_of_range("no part is called " + id);
    }
  } // namespace

  TEST(DynamicsReport, best_records_are_those_that_no_other_beats_in_error_and_time)
  {
    StudyResults results = results_of({run_of(0, .1, 1e-2, 1), run_of(0, .05, 5e-3, 2),
                                       run_of(1, .1, 6e-3, 3), run_of(1, .05, 1e-3, 4)});
    const auto best = best_records(results);
    ASSERT_EQ(best.size(), 3u); // the third is dearer and worse than the second
    EXPECT_EQ(best[0], &results.records[0]);
    EXPECT_EQ(best[1], &results.records[1]);
    EXPECT_EQ(best[2], &results.records[3]);
    results.variable = "a"; // of its values some are easier than others
    EXPECT_TRUE(best_records(results).empty());
  }

  TEST(DynamicsReport, best_records_are_none_whose_errors_cancel)
  {
    const StudyResults results =
        results_of({run_of(0, .1, 1e-5, 1), run_of(0, .05, 5e-3, 2), run_of(0, .025, 5.01e-3, 4)});
    const auto best = best_records(results);
    ASSERT_EQ(best.size(), 1u);
    EXPECT_EQ(best[0], &results.records[1]); // that the shortest step is a little worse is no luck
  }

  TEST(DynamicsReport, orders_are_proven_of_rules_alone)
  {
    StudyResults results = results_of({});
    results.facts["proven order of rules"] = "γ <= 1";
    for (const std::string method : {"FA", "Q1"})
    {
      study::Trend trend;
      trend.method = method;
      trend.family =
          method == "FA" ? study::MethodFamily::meshfree : study::MethodFamily::reference;
      trend.error = "nodal L2 | exact";
      trend.x = {.1, .05};
      trend.values = {1e-2, 2e-3};
      results.trends.push_back(trend);
    }
    const Table rates = table(dynamics_view(results), "rates");
    const auto proven = std::find_if(rates.columns.begin(), rates.columns.end(),
                                     [](const Column &one) { return one.head == "proven"; });
    ASSERT_NE(proven, rates.columns.end());
    const auto j = static_cast<std::size_t>(proven - rates.columns.begin());
    EXPECT_EQ(rates.rows.at(0).at(j).text, "γ <= 1");
    EXPECT_EQ(rates.rows.at(1).at(j).text, empty_cell().text);
  }

  TEST(DynamicsReport, has_no_rate_to_an_error_of_the_size_of_rounding)
  {
    StudyResults results = results_of({});
    for (const double round_off : {0., 1e-12})
    {
      study::Trend trend;
      trend.method = "Q1";
      trend.error = "nodal L2 | exact";
      trend.x = {.1, .05};
      trend.values = {1e-2, 1e-13};
      trend.rates = {36.5};
      trend.round_off = round_off;
      results.trends.push_back(trend);
    }
    const Table rates = table(dynamics_view(results), "rates");
    const auto column = std::find_if(rates.columns.begin(), rates.columns.end(),
                                     [](const Column &one) { return one.head == "rate"; });
    ASSERT_NE(column, rates.columns.end());
    const auto j = static_cast<std::size_t>(column - rates.columns.begin());
    EXPECT_EQ(rates.rows.at(0).at(j).text, "36.500");
    EXPECT_EQ(rates.rows.at(1).at(j).text, empty_cell().text);
  }

  TEST(DynamicsReport, charts_have_units_on_their_axes)
  {
    StudyResults results = results_of({run_of(0, .1, 1e-2, 1), run_of(1, .1, 6e-3, 3)});
    results.facts["blow-up"] = "is shown";
    for (Record &record : results.records)
    {
      record.curves["energy"] = {{"time", "time", {0, .5, 1}},
                                 {"kinetic", "force length", {0, .5, .5}},
                                 {"bonds", "force length", {1, .25, .125}},
                                 {"work", "force length", {0, 0, 0}},
                                 {"dissipated", "force length", {0, 0, 0}}};
      record.curves["error"] = {{"time", "time", {0, .5}}, {"error", "", {1e-3, 6e-3}}};
    }
    for (const auto &[error, axis] : {std::pair{results.decisive_error, study::Axis::mesh_size},
                                      std::pair{study::time_error, study::Axis::time_step}})
    {
      study::Trend trend;
      trend.method = "FA";
      trend.error = error;
      trend.axis = axis;
      trend.variant = "velocity Verlet";
      trend.x = {.1, .05};
      trend.values = {1e-2, 6e-3};
      results.trends.push_back(trend);
    }
    std::vector<std::string> names;
    for (const DataChart &chart : dynamics_charts(results))
    {
      names.push_back(chart.name);
      EXPECT_TRUE(fixture::has_units(chart.plot))
          << chart.name << ": " << chart.plot.x_label << ", " << chart.plot.y_label;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"errors", "cost", "orders", "energies", "stored",
                                               "balance", "history"}));
  }

  TEST(DynamicsReport, records_read_back_are_those_that_were_written)
  {
    const fixture::Folder folder;
    const auto file = folder.path() / "dynamics.jsonl";
    Record record = run_of(2, 1. / 3, 1e-17 / 7, .25);
    record.key.h = .1;
    record.key.horizon = .3;
    record.set("critical step", std::numeric_limits<double>::infinity()); // there is none
    record.texts["limit"] = "incompatible";
    record.texts["reason of the limit"] = "its \"moments\"";
    for (const char *const defect :
         {"moment defect", "mean moment defect", "spread of moments", "ball defect", "area defect"})
      record.set(defect, 1. / (3 + static_cast<double>(record.scalars.size())));
    record.curves["energy"] = {{"time", "time", {0, .5}},
                               {"kinetic", "", {1. / 3, std::nan("")}},
                               {"bonds", "", {2. / 3, 1e300}},
                               {"work", "", {0, -1. / 7}},
                               {"dissipated", "", {0, 5e-324}}};
    study::StudyResults made;
    made.records = {record};
    io::RecordJournal(file, "scene").append(made);
    const io::RecordJournal journal(file, "scene");
    ASSERT_EQ(journal.earlier().records.size(), 1u);
    const Record &back = journal.earlier().records[0];
    EXPECT_FALSE(back.has("critical step"));
    const study::LimitProof was = study::limit_of(record), is = study::limit_of(back);
    EXPECT_EQ(std::tie(is.answer, is.defect, is.mean_defect, is.spread, is.ball_defect,
                       is.area_defect, is.reason),
              std::tie(was.answer, was.defect, was.mean_defect, was.spread, was.ball_defect,
                       was.area_defect, was.reason));
    EXPECT_EQ(is.answer, study::LimitProof::Answer::incompatible);
    const auto energies = study::energies_of(back);
    ASSERT_EQ(energies.size(), 2u);
    EXPECT_EQ(energies[0].stored(), 1. / 3 + 2. / 3);
    EXPECT_TRUE(std::isnan(energies[1].kinetic));
    EXPECT_EQ(energies[1].work, -1. / 7);
    EXPECT_EQ(energies[1].dissipated, 5e-324);
    EXPECT_TRUE(study::energies_of({}).empty());
  }
} // namespace plumbline::report
