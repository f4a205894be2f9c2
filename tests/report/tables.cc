#include "report/tables.h"

#include "base/error.h"
#include "report/view.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumbline::report
{
  namespace
  {
    bool holds(const std::string &text, const std::string &part)
    {
      return text.find(part) != std::string::npos;
    }
  } // namespace

  TEST(ReportTables, HoldEveryDigitInTheCsv)
  {
    const fixture::Folder folder;
    const study::StudyResults results = fixture::results();
    write_study(statics_view(results), results, folder.path());
    const std::string csv = fixture::read(folder.path() / "tables/errors_case1_m-3.csv");
    EXPECT_EQ(fixture::count(csv, "\n"), 6u); // a head and five levels
    EXPECT_TRUE(holds(csv, "level,h [length],horizon [length],m,FA error,FA rate,"));

    // Each number reads back to the same double.
    const std::string line = csv.substr(csv.find("\n1,") + 1);
    std::vector<double> numbers;
    for (std::size_t at = 0; at < line.find('\n'); at = line.find_first_of(",\n", at) + 1)
      numbers.push_back(std::strtod(line.c_str() + at, nullptr));
    ASSERT_EQ(numbers.size(), 14u);
    const study::Record &run = results.records.at(1);
    EXPECT_EQ(numbers[1], run.key.h);
    EXPECT_EQ(numbers[2], run.key.horizon);
    EXPECT_EQ(numbers[4], run[results.decisive_error]);
    EXPECT_EQ(numbers[5], results.trends.at(0).rates.at(0));
  }

  TEST(ReportTables, LeaveAnEmptyFieldWhereThereIsNoValue)
  {
    const study::StudyResults results = fixture::results();
    const Table table = error_table(results, cases(results).at(0));
    // FA has no solution at level 4, P0 has a NaN at level 2, Q1 an exact zero at level 0.
    EXPECT_EQ(table.rows.at(4).at(4).csv.at(0), "");
    EXPECT_EQ(table.rows.at(4).at(4).text, "–");
    EXPECT_EQ(table.rows.at(2).at(10).csv.at(0), "");
    EXPECT_EQ(table.rows.at(0).at(12).csv.at(0), "0");
  }

  TEST(ReportTables, RoundForPeople)
  {
    EXPECT_EQ(rounded(.05), "0.05");
    EXPECT_EQ(rounded(123456.), "1.235e5");
    EXPECT_EQ(rounded(21120.), "21120"); // a count
    EXPECT_EQ(rounded(21120.5), "2.112e4");
    EXPECT_EQ(rounded(-1.23456e-7), "-1.235e-7");
    EXPECT_EQ(rounded(std::nan("")), "–");
    EXPECT_EQ(rounded_error(.0123456), "1.235e-2");
    EXPECT_EQ(rounded_error(0), "0");
    EXPECT_EQ(short_power(1e-2), "1e-2");
    EXPECT_EQ(short_power(2.5e-10), "2.5e-10");
    EXPECT_EQ(short_power(100), "1e2");
    EXPECT_EQ(short_power(std::nan("")), "–");
    EXPECT_EQ(rounded_seconds(8.54e-5), "85 µs");
    EXPECT_EQ(rounded_seconds(5.1e-4), "0.51 ms");
    EXPECT_EQ(rounded_seconds(.0996), "100 ms");
    EXPECT_EQ(rounded_seconds(.123), "0.12 s");
    EXPECT_EQ(rounded_seconds(3.21), "3.2 s");
    EXPECT_EQ(rounded_seconds(412), "410 s");
    EXPECT_EQ(rounded_seconds(9940), "9940 s");
    EXPECT_EQ(rounded_seconds(80300), "22 h");
    EXPECT_EQ(rounded_seconds(std::nan("")), "–");
    EXPECT_EQ(exact(.1), "0.10000000000000001");
    EXPECT_EQ(exact(std::numeric_limits<double>::infinity()), "");
    EXPECT_EQ(rounded_with_uncertainty(2.0134, .0312), "2.013 ± 0.031");
  }

  TEST(ReportTables, GiveEachVerdictWithItsReason)
  {
    const fixture::Folder folder;
    const study::StudyResults results = fixture::results();
    write_study(statics_view(results), results, folder.path());
    const std::string csv = fixture::read(folder.path() / "tables/verdicts.csv");
    EXPECT_EQ(fixture::count(csv, "\n"), 1 + results.trends.size());
    EXPECT_TRUE(holds(csv, "method,problem,series,rate,rate uncertainty,plateau,plateau "
                           "uncertainty,verdict,reason\n"));
    EXPECT_TRUE(holds(csv, "FA,case1,m = 3,1,0.029999999999999999,"));
    EXPECT_TRUE(holds(csv, "not AC,the error tends to a plateau of"));
    const std::string md = fixture::read(folder.path() / "tables/verdicts.md");
    EXPECT_TRUE(holds(md, "| FA | case1 | m = 3 | 1 ± 0.03 |"));
  }

  TEST(ReportTables, GiveTheCostOfEachRunThatCameThrough)
  {
    const fixture::Folder folder;
    const study::StudyResults results = fixture::results();
    write_study(statics_view(results), results, folder.path());
    const std::string csv = fixture::read(folder.path() / "tables/cost.csv");
    EXPECT_EQ(fixture::count(csv, "\n"), results.records.size()); // a head, less one failure
    EXPECT_TRUE(holds(csv, "FA,case1,m = 3,0.10000000000000001,81,2268,"));
  }

  TEST(ReportTables, EscapeLatex)
  {
    EXPECT_EQ(escape_latex("a_b & 50% {x} #1 $ ^ ~ \\"),
              "a\\_b \\& 50\\% \\{x\\} \\#1 \\$ \\textasciicircum{} \\textasciitilde{} "
              "\\textbackslash{}");
    EXPECT_EQ(escape_latex("δ = 0.4 ± 1"), "$\\delta$ = 0.4 $\\pm$ 1");

    const fixture::Folder folder;
    write_study(statics_view(fixture::results()), fixture::results(), folder.path());
    const std::string tex = fixture::read(folder.path() / "tables/errors_case1_m-3.tex");
    EXPECT_TRUE(holds(tex, "$9.300\\times10^{-3}$"));
    EXPECT_TRUE(holds(tex, "\\begin{tabular}{rrrrrrrrrrrrrr}"));
    const std::string verdicts = fixture::read(folder.path() / "tables/verdicts.tex");
    EXPECT_TRUE(holds(verdicts, "case\\_2 $\\delta$"));
    EXPECT_FALSE(holds(verdicts, "δ &"));
  }

  TEST(ReportTables, QuoteCsvFields)
  {
    EXPECT_EQ(quote_csv("plain"), "plain");
    EXPECT_EQ(quote_csv("a,b"), "\"a,b\"");
    EXPECT_EQ(quote_csv("say \"x\""), "\"say \"\"x\"\"\"");
    EXPECT_EQ(quote_csv(" x"), "\" x\"");
  }

  TEST(ReportTables, NameFilesSoThatNoTwoCasesShareOne)
  {
    EXPECT_EQ(slug("δ = 0.4"), "delta-0.4");
    EXPECT_EQ(slug("../Case 1/"), "case-1");
    EXPECT_EQ(slug(""), "all");
    study::StudyResults results;
    for (const char *series : {"m = 3", "m=3", "M 3"})
    {
      study::Record run;
      run.key.problem = "p";
      run.key.series = series;
      results.records.push_back(run);
    }
    const std::vector<Case> all = cases(results);
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].slug, "p_m-3");
    EXPECT_EQ(all[1].slug, "p_m-3_2");
    EXPECT_EQ(all[2].slug, "p_m-3_3");
  }

  TEST(ReportTables, FindDifferencesThatAreTooSmallForTheReference)
  {
    study::StudyResults results = fixture::results();
    results.references = {{"case1", "m = 3", "Q2", 3, .0125, .0375, 3e-5, 1e-5, 2e-6, 3e-5, 4}};
    const Table table = doubtful_differences(results);
    // Of level 3: recalibrated .6 × 1.453e-4 and Q1 .6 × 9.375e-5 are below 3e-4, the others above;
    // errors against the exact solution do not count.
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(table.rows[0][0].text, "IPA-AC recalibrated");
    EXPECT_EQ(table.rows[1][0].text, "Q1");
    EXPECT_EQ(table.rows[0][4].text, "averages L2 against reference");
  }

  TEST(ReportTables, SetBoundsBesideTheErrorsThatTheyBound)
  {
    study::StudyResults results = fixture::results();
    EXPECT_TRUE(bound_table(results).rows.empty());
    study::Record &run = results.records.front();
    run.set("inverse norm", .15);
    run.set("bound Linf | exact", 4e-3);
    run.set("nodal Linf | exact", 1e-3);
    run.set("smallest eigenvalue", 8);
    run.set("bound L2 | local", 4e-3); // without its error
    run.set("truncation round-off", 1e-3);
    const Table table = bound_table(results);
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(table.rows[0][5].text, "nodal L2 against local");
    EXPECT_EQ(table.rows[0][9].text, "–");
    EXPECT_EQ(table.rows[1][5].text, "nodal L∞ against exact");
    EXPECT_EQ(table.rows[1][6].text, "0.15");
    EXPECT_EQ(table.rows[1][9].text, "0.25");
    EXPECT_EQ(table.rows[0][6].text, "0.125"); // in L2 the inverse of the eigenvalue
    run.set("truncation round-off", 1);        // of the bound: .15
    EXPECT_EQ(bound_table(results).rows[1][9].text, "–");
  }

  TEST(ReportTables, LeaveAFitThatWasNotMadeEmpty)
  {
    study::StudyResults results = fixture::results();
    study::Trend &trend = results.trends.at(0);
    trend.rate = trend.rate_uncertainty = trend.plateau = trend.plateau_uncertainty =
        study::not_fitted;
    const Table table = trend_table(results);
    EXPECT_EQ(table.rows.at(0).at(3).text, "–");
    EXPECT_EQ(table.rows.at(0).at(4).csv, std::vector<std::string>({"", ""}));
    EXPECT_EQ(table.rows.at(1).at(4).text, "1.850e-3 ± 2.0e-5");
  }

  TEST(ReportTables, RefuseAFolderThatCannotBeWritten)
  {
    const fixture::Folder folder;
    std::ofstream(folder.path() / "file") << "x";
    try
    {
      write_study(statics_view(fixture::results()), fixture::results(), folder.path() / "file");
      FAIL() << "no error";
    }
    catch (const InputError &error)
    {
      EXPECT_TRUE(holds(error.what(), (folder.path() / "file").string()));
      EXPECT_TRUE(holds(error.what(), "-o"));
    }
  }
} // namespace plumbline::report
