#pragma once

#include "report/data_charts.h"
#include "report/page_parts.h"
#include "study/study_results.h"

#include <functional>
#include <string>
#include <vector>

// What is shown of a study: tables, charts and pages are data over its records. One renderer each
// makes text, Markdown, CSV, HTML and pictures of them.
namespace plumbline::report
{
  using analysis::Record;
  using study::StudyResults;

  /// A column of a table that has a row for each record, or for each of other things.
  template <class Row>
  struct ColumnOf
  {
    Column head;
    std::function<Cell(const Row &)> cell;
  };
  using RecordColumn = ColumnOf<Record>;

  template <class Row, class Rows>
  Table table_of(const Rows &rows, const std::vector<ColumnOf<Row>> &columns)
  {
    Table table;
    for (const auto &column : columns)
      table.columns.push_back(column.head);
    for (const Row &row : rows)
    {
      table.rows.emplace_back();
      for (const auto &column : columns)
        table.rows.back().push_back(column.cell(row));
    }
    return table;
  }

  /// Columns by the name of a scalar or a text; the cell is empty where it is absent.
  RecordColumn number_column(const std::string &head, const std::string &scalar);
  RecordColumn error_column(const std::string &head, const std::string &scalar);
  RecordColumn count_column(const std::string &head, const std::string &scalar);
  RecordColumn text_column(const std::string &head, const std::string &text);

  /// Method, m, h, and the value of the study's variable, where one varies; then others.
  std::vector<RecordColumn> with_place(const StudyResults &results,
                                       std::vector<RecordColumn> others);

  using IsShown = std::function<bool(const Record &)>;

  /// The records that failed, and why.
  /// @param is_shown  empty: all
  Part failures(const StudyResults &results, const std::string &title, const std::string &head,
                const IsShown &is_shown = {});

  /// A row for each record that is shown; columns that are empty throughout are left out.
  Table table_of(const StudyResults &results, const std::vector<RecordColumn> &columns,
                 const IsShown &is_shown);

  /// Scalars or texts of one record and what they mean, by their names; those that are absent are
  /// left out.
  Table quantity_table(const Record &record,
                       const std::vector<std::pair<std::string, std::string>> &meanings);

  Table verdict_table(const StudyResults &results);
  Table power_table(const StudyResults &results);

  /// A scalar of all methods over the levels of each series, drawn where it is positive.
  struct ChartView
  {
    std::string name, title, y_label;
    std::function<double(const Record &)> y;
    std::function<double(const Record &)> bound = {}; ///< drawn in grey; empty: none
    std::string bound_label = {};
    bool has_slopes = false;
  };

  /// One for each series that has at least two levels and something to draw.
  std::vector<DataChart> charts_of(const ChartView &view, const StudyResults &results,
                                   const IsShown &is_shown);

  /// A picture that is no chart: commands of gnuplot that write NAME.svg.
  struct Picture
  {
    std::string name, title, script;
    std::string caption = {};
    Table data = {}; ///< NAME.csv, where it has rows
  };

  /// A table that is a file NAME.csv.
  struct DataTable
  {
    std::string name;
    Table table;
  };
  Table table_of(const analysis::Curve &curve);

  /// @pre the curve has a column of this name
  const std::vector<double> &column(const analysis::Curve &curve, const std::string &name);

  /// Charts or pictures under a heading.
  struct Gallery
  {
    std::string id, title, words;
    std::vector<DataChart> charts;
    std::vector<Picture> pictures = {};
    std::string note = {};   ///< below them
    std::size_t n_large = 0; ///< so many charts, the first ones, are large
    std::string rest = {};   ///< heading that the others are folded under; empty: they are not
  };

  /// A sentence of the answer to the question which method to take.
  struct Statement
  {
    std::string words;
    bool is_bad = false;
  };

  /// The cheapest runs of a case: a table without heads.
  struct Card
  {
    std::string title;
    Table table;
    std::string words = {};
    std::vector<std::string> warnings = {};
  };

  /// What write_study writes, and where; what is empty has the name of the analysis.
  struct FileNames
  {
    std::string page = {}, numbers = {};  ///< without ending
    std::string tables = {}, charts = {}; ///< folders
  };

  /// How the results of an analysis are shown.
  struct View
  {
    std::string title; ///< of the page, e.g. "Stability"
    FileNames files = {};
    std::string redraw = "run again";       ///< to be done where pictures are missing
    std::string setting = {};               ///< how the study is made, below the page's title
    std::string answer = {};                ///< what the results say, in a sentence or two
    std::vector<Statement> statements = {}; ///< instead, where methods are compared
    std::vector<std::string> remarks = {};  ///< on them, a paragraph each
    std::vector<Card> cards = {};           ///< on the page
    std::vector<std::string> advice = {};   ///< the same in short: a line of the terminal each
    std::vector<std::string> findings = {}; ///< besides the answer, a sentence each
    std::string question = {};              ///< what the verdicts answer
    std::string words = {};                 ///< what the verdicts mean
    Table verdicts = {};
    std::vector<std::string> facts = {}; ///< below the page's title
    std::vector<Part> parts = {};
    std::vector<Gallery> galleries = {};
    std::vector<DataTable> tables = {};      ///< as CSV alone
    std::vector<std::string> constants = {}; ///< lines that the terminal begins with
    std::vector<Part> brief = {};            ///< shown there instead of verdicts and parts
  };

  /// The class of a cell on pages.
  std::string look_of(study::Rating rating);

  /// Without anything special: a table and charts of all scalars.
  View default_view(const StudyResults &results);

  View statics_view(const StudyResults &results);
  View stability_view(const StudyResults &results);
  View dispersion_view(const StudyResults &results);
  View strip_view(const StudyResults &results);
  View crack_view(const StudyResults &results);
  View growth_view(const StudyResults &results);
  View dynamics_view(const StudyResults &results);

  /// The labels of methods in the order of the records.
  std::vector<MethodName> methods_of(const StudyResults &results, const IsShown &is_shown);

  /// Those of a series, in the order of the records.
  std::vector<std::string> series_of(const StudyResults &results);

  /// The answer of the view; if it has none, the methods of each verdict, of `verdicts` or else of
  /// the first part with verdicts: "stable: FA, Q1; unstable: OPT".
  std::string answer_of(const View &view);

  /// Words on what was solved, and phrases on what was not.
  Part model_part(const std::string &words);
  Part omitted_part(const std::vector<std::string> &phrases);

  /// All tables but for details, with their words.
  std::string study_text(const View &view, const StudyResults &results);

  /// Words in lines of 120 columns, no more than so many of them.
  std::vector<std::string> short_lines(const std::string &words, std::size_t most,
                                       std::size_t indent = 0);

  /// First lines, as much of the tables of the finest levels as there is room for in 25 lines of
  /// 120 columns, and last lines, which are no longer than that.
  std::string summary(const std::vector<std::string> &begin, const std::vector<Part> &parts,
                      const std::vector<std::string> &end);

  /// What the terminal shows: 25 lines of 120 columns at most. Tables, of the finest levels alone
  /// and cut short where they are long, verdicts, expectations, and the answer last.
  /// @param files  where the report is
  std::string study_summary(const View &view, const StudyResults &results,
                            const std::string &files);

  /// Write ANALYSIS.json, .md and .html, and ANALYSIS/ with tables (CSV, Markdown and LaTeX),
  /// charts and pictures, or files of the view's own names.
  /// @throws InputError  the folder cannot be written
  /// @throws NumericalError  pictures cannot be drawn; all else is written before that
  void write_study(const View &view, const StudyResults &results,
                   const std::filesystem::path &folder);

  /// The same without numbers, ANALYSIS.json.
  void write_view(const View &view, const StudyResults &results,
                  const std::filesystem::path &folder);
} // namespace plumbline::report
