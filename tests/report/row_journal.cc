// Journals give back rows of operators and waves to the last bit; of strips see strip.cc.
#include "report/row_journal.h"

#include "report/json_archive.h"
#include "report/row_keys.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::report
{
  namespace
  {
    template <class Row>
    std::string text_of(Row row)
    {
      JsonWriter writer;
      visit(writer, row);
      return writer.take().dump();
    }

    /// Two rows that stand together.
    template <class Row>
    std::vector<Row> written_and_read(const std::vector<Row> &rows)
    {
      const fixture::Folder folder;
      const auto file = folder.path() / "rows.jsonl";
      RowJournal<Row>(file, "scene").append(rows);
      EXPECT_TRUE(RowJournal<Row>(file, "another scene").earlier().empty());
      return RowJournal<Row>(file, "scene").earlier();
    }

    study::StabilityRow operator_row()
    {
      study::StabilityRow row{"Q1",      study::Side::reference, "m = 3", .1 / 3, .1, {}, {},
                              "it ended"};
      study::Stability &s = row.stability;
      s.n_unknowns = 8;
      s.smallest = 1. / 7;
      s.largest = 1e300;
      s.n_zero = 2;
      s.modes.n_components = 2;
      s.modes.nodes = {{1. / 3, -.5}, {2, 3}};
      s.modes.values = {{1. / 9, 2, 3, 4}, {5, 6, 7, 8}};
      s.eigenvalues = {1, 2, 3, 4, 5};
      s.has_signs = true;
      s.signs = {1, 2, 3, 4, 1e-17};
      s.inverse_norm = .3;
      s.is_norm_exact = true;
      s.diagnostics.n_neighbours = 28;
      s.diagnostics.limit.answer = study::LimitProof::Answer::incompatible;
      s.diagnostics.notes = {"a \"note\""};
      row.consistency = {4, 2, 5e-324};
      row.steps = {1.7, 2.7, 3.7, false};
      row.seconds = 2.5;
      row.value = -.25;
      return row;
    }
  } // namespace

  TEST(RowJournal, GivesBackOperators)
  {
    const study::StabilityRow row = operator_row();
    const auto read = written_and_read<study::StabilityRow>({row, {}});
    ASSERT_EQ(read.size(), 2u);
    const study::StabilityRow &found = read.front();
    EXPECT_EQ(text_of(found), text_of(row));
    // that all is in the text
    EXPECT_EQ(std::tuple(found.method, found.side, found.series, found.failure),
              std::tuple(row.method, row.side, row.series, row.failure));
    EXPECT_EQ(std::tuple(found.h, found.horizon, found.value, found.seconds),
              std::tuple(row.h, row.horizon, row.value, row.seconds));
    EXPECT_EQ(found.stability.modes.nodes, row.stability.modes.nodes);
    EXPECT_EQ(found.stability.modes.values, row.stability.modes.values);
    EXPECT_EQ(found.stability.modes.n_components, 2u);
    EXPECT_EQ(found.stability.n_zero, 2u);
    EXPECT_EQ(found.stability.largest, 1e300);
    EXPECT_EQ(found.stability.eigenvalues.largest_imaginary, 4);
    EXPECT_EQ(found.stability.signs.asymmetry, 1e-17);
    EXPECT_TRUE(found.stability.is_norm_exact);
    EXPECT_EQ(found.stability.diagnostics.notes, row.stability.diagnostics.notes);
    EXPECT_EQ(found.stability.diagnostics.limit.answer, study::LimitProof::Answer::incompatible);
    EXPECT_EQ(found.consistency.barrier, 5e-324);
    EXPECT_EQ(found.steps.lumped(), row.steps.lumped());
    EXPECT_FALSE(found.steps.is_oscillating);
  }

  TEST(RowJournal, GivesBackWaves)
  {
    study::DispersionRow row;
    row.method = "Q1 lumped";
    row.side = study::Side::reference;
    row.series = "m = 3";
    row.h = .1;
    row.horizon = .3;
    row.curves.resize(2);
    row.curves[1] = {physics::Polarisation::transverse, 22.5, 1. / 3, std::nan(""), {1, 2, 3, 4, 5},
                     {{6, std::nan(""), 8, 9, 10}}};
    row.anisotropy = {.1, -.2};
    row.range = {-1e-17, 400};
    row.round_off = 1e-13;
    row.limit.defect = .05;
    row.seconds = 1.5;
    row.value = .4;
    const auto read = written_and_read<study::DispersionRow>({row, row});
    ASSERT_EQ(read.size(), 2u);
    const study::DispersionRow &found = read.back();
    EXPECT_EQ(text_of(found), text_of(row));
    EXPECT_EQ(found.curves[1].polarisation, physics::Polarisation::transverse);
    EXPECT_TRUE(std::isnan(found.curves[1].long_wave_error));
    EXPECT_TRUE(std::isnan(found.curves[1].samples.at(0).phase));
    EXPECT_EQ(found.curves[1].samples[0].exact_group, 10);
    EXPECT_EQ(found.curves[1].longest.k, 1);
    EXPECT_EQ(found.anisotropy, row.anisotropy);
    EXPECT_EQ(std::pair(found.range.least, found.range.largest), std::pair(-1e-17, 400.));
    EXPECT_EQ(std::tuple(found.round_off, found.limit.defect, found.value, found.seconds),
              std::tuple(1e-13, .05, .4, 1.5));
  }
} // namespace plumbline::report
