#include "report/text_table.h"
#include "report/view.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
  using namespace plumbline;
  using namespace plumbline::report;

  /// Methods at three levels each, with tables wider and longer than a terminal.
  report::View long_view(unsigned int n_methods)
  {
    report::View view{"Stability"};
    Part part;
    part.id = "measures";
    part.head = "Measures";
    part.words = "words of the table";
    part.table.columns = {{"method"}, {"h"}};
    for (unsigned int k = 0; k < 30; ++k)
      part.table.columns.push_back({"column " + std::to_string(k)});
    view.verdicts.columns = {{"method"}, {"series"}, {"verdict"}, {"explanation"}};
    for (unsigned int i = 0; i < n_methods; ++i)
    {
      const std::string name = "method" + std::to_string(i);
      for (const std::string h : {"0.1", "0.05", "0.025"})
      {
        part.table.rows.push_back({text_cell(name), text_cell(h)});
        for (unsigned int k = 0; k < 30; ++k)
          part.table.rows.back().push_back(text_cell("δ" + std::to_string(k)));
      }
      view.verdicts.rows.push_back({text_cell(name), text_cell("m = 3"),
                                    text_cell(i % 2 == 0 ? "stable" : "unstable"),
                                    text_cell(std::string(300, 'w'))});
    }
    view.parts = {part, part, part};
    return view;
  }

  StudyResults many_expectations()
  {
    StudyResults results;
    results.scene_name = "scene";
    results.purpose = std::string(200, 'p');
    results.left_out = {"Q1 at h = 0.01", "Q1 at h = 0.005"};
    results.expectations.resize(9);
    for (auto &one : results.expectations)
      one.subject = std::string(200, 's');
    return results;
  }

  std::size_t width(const std::string &line)
  {
    return std::count_if(line.begin(), line.end(),
                         [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
  }
} // namespace

TEST(StudySummary, has_at_most_25_lines_of_120_columns)
{
  for (const unsigned int n : {1, 2, 4, 30})
  {
    const auto lines =
        lines_of(study_summary(long_view(n), many_expectations(), "results/stability.html"));
    EXPECT_LE(lines.size(), 25u) << n;
    for (const std::string &line : lines)
      EXPECT_LE(width(line), 120u) << line;
  }
}

TEST(StudySummary, shows_the_finest_levels_and_ends_in_the_answer)
{
  const std::string text = study_summary(long_view(4), {}, "results/stability.html");
  EXPECT_EQ(text.find("0.05"), std::string::npos) << text;
  EXPECT_NE(text.find("method3  0.025"), std::string::npos);
  const auto lines = lines_of(text);
  ASSERT_GE(lines.size(), 3u);
  EXPECT_EQ(lines.back(), "Stable: method0, method2; unstable: method1, method3");
  EXPECT_EQ(lines[lines.size() - 3], "report: results/stability.html");
  report::View answered = long_view(4);
  answered.answer = "The crack runs.";
  EXPECT_EQ(lines_of(study_summary(answered, {}, "")).back(), "The crack runs.");
}

// which method to take at which cost is what a reader looks for
TEST(StudySummary, gives_advice_in_full)
{
  report::View view = long_view(30);
  const std::string advice =
      "parabola, m = 3: cheapest to a relative error of 0.01: Q1 at h = 0.1, 0.000646 CPU s; of "
      "0.0001: IPA-AC-R2 at h = 0.0125, 0.000677 CPU s, a tie with IPA-AC, Q1";
  view.advice = {advice, advice};
  const auto lines = lines_of(study_summary(view, many_expectations(), ""));
  EXPECT_LE(lines.size(), 25u);
  EXPECT_EQ(lines[lines.size() - 2] + " " + lines.back(), advice);
}

TEST(StudySummary, tells_what_it_leaves_out)
{
  const std::string text = study_summary(long_view(30), many_expectations(), "");
  EXPECT_NE(text.find("more rows in the report"), std::string::npos);
  EXPECT_NE(text.find("not as expected: 7 more in the report"), std::string::npos) << text;
  EXPECT_NE(text.find("expectations: 0 of 9 hold"), std::string::npos);
  EXPECT_NE(text.find("left out by the budget: Q1 at h = 0.01 and 1 more"), std::string::npos);
}

TEST(StudyPage, begins_with_the_answer_that_the_terminal_ends_in)
{
  const fixture::Folder folder;
  StudyResults results;
  results.analysis = "stability";
  report::View view = long_view(4);
  write_study(view, results, folder.path());
  const std::string answer = "Stable: method0, method2; unstable: method1, method3";
  const std::string html = fixture::read(folder.path() / "stability.html");
  EXPECT_NE(html.find("<p class=\"answer\">" + answer + "</p>"), std::string::npos);
  EXPECT_NE(fixture::read(folder.path() / "stability.md").find("\n\n" + answer + "\n\n"),
            std::string::npos);

  // transient analyses have their verdicts in a part
  view.parts.front().table = view.verdicts;
  view.verdicts = {};
  EXPECT_EQ(answer_of(view), answer);
  view.answer = "The crack runs.";
  EXPECT_EQ(answer_of(view), "The crack runs.");
  EXPECT_EQ(answer_of({"Stability"}), "");
}

TEST(StudyPage, folds_parts_into_the_section_before_them_and_links_sections)
{
  const fixture::Folder folder;
  StudyResults results;
  results.analysis = "stability";
  report::View view = long_view(1);
  Part words{"words", "Words", "a sentence <", {}}, nothing{"nothing", "Nothing", "of a table", {}},
      fold;
  nothing.table.columns = {{"a"}};
  nothing.table = without_empty_columns(nothing.table);
  fold.id = fold.file = "details";
  fold.head = "More of it";
  fold.table = view.verdicts;
  fold.fold = Fold::closed;
  view.parts = {view.parts[0], fold, nothing, words};
  write_study(view, results, folder.path());
  const std::string html = fixture::read(folder.path() / "stability.html");
  const std::size_t section = html.find("<section id=\"measures\">"),
                    details = html.find("<details><summary>More of it</summary>");
  ASSERT_NE(details, std::string::npos);
  EXPECT_LT(section, details);
  EXPECT_EQ(html.substr(section, details - section).find("</section>"), std::string::npos);
  EXPECT_NE(html.find("<a href=\"#measures\">Measures</a>"), std::string::npos);
  EXPECT_NE(html.find("<a href=\"#words\">Words</a>"), std::string::npos);
  EXPECT_NE(html.find("a sentence &lt;"), std::string::npos);
  EXPECT_EQ(html.find("Nothing"), std::string::npos); // a table without rows
  for (const char *const name : {"measures_table.csv", "measures_table.tex", "details.md"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "stability" / name)) << name;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "stability" / "words_table.csv"));
}

TEST(StudyPage, heads_columns_by_their_group)
{
  const fixture::Folder folder;
  report::View view{"Statics"};
  view.verdicts.columns = {{"method"}, {"m = 3"}, {"m = 4"}, {"m = 3"}};
  view.verdicts.columns[1].group = view.verdicts.columns[2].group = "u";
  view.verdicts.columns[3].group = "v";
  view.verdicts.rows = {{text_cell("FA"), text_cell("AC"), text_cell("AC"), text_cell("not AC")}};
  view.verdicts.rows[0][3].hint = "a \"plateau\"";
  view.verdicts.rows[0][3].look = "stalls";
  StudyResults results;
  results.analysis = "statics";
  write_study(view, results, folder.path());
  const std::string html = fixture::read(folder.path() / "statics.html");
  EXPECT_NE(html.find("colspan=\"2\">u</th><th class=\"problem\" colspan=\"1\">v</th>"),
            std::string::npos);
  EXPECT_NE(html.find("<td class=\"stalls\" title=\"a &quot;plateau&quot;\">not AC</td>"),
            std::string::npos);
  EXPECT_NE(fixture::read(folder.path() / "statics.md").find("| u, m = 3 | u, m = 4 | v, m = 3 |"),
            std::string::npos);
}

TEST(StudyText, names_series_and_quantities_of_a_method_where_its_verdicts_differ)
{
  report::View view{"Dispersion"};
  view.verdicts.columns = {{"method"}, {"series"}, {"verdict"}};
  const auto add = [&](const std::string &method, const std::string &series, const char *verdict) {
    view.verdicts.rows.push_back({text_cell(method), text_cell(series), text_cell(verdict)});
  };
  add("FA", "m = 3", "not AC");
  add("FA", "m = 4", "not AC");
  add("Q1", "m = 3", "AC");
  add("Q1", "m = 4", "undecided");
  EXPECT_EQ(answer_of(view), "Not AC: FA; AC: Q1 (m = 3); undecided: Q1 (m = 4)");
}

TEST(StudyText, names_cases_whose_verdicts_differ_and_drops_none)
{
  report::View view{"Transient analysis"};
  view.verdicts.columns = {{"method"}, {"case"}, {"of"}, {"verdict"}};
  for (const auto &[problem, verdict] :
       {std::pair("linear", "AC for this field only"), std::pair("wave", "not AC")})
    for (const std::string of : {"u", "v"})
      view.verdicts.rows.push_back(
          {text_cell("FA"), text_cell(problem), text_cell(of), text_cell(verdict)});
  EXPECT_EQ(answer_of(view), "AC for this field only: FA (linear, u), FA (linear, v); not AC: "
                             "FA (wave, u), FA (wave, v)");
}
