#pragma once

#include "report/charts.h"
#include "report/selection.h"

#include <filesystem>
#include <string>

/// The pieces of report.html, each a string of HTML with everything escaped.
namespace plumbline::report::page
{
  extern const char *const style_sheet;

  /// A small picture of a method's line and symbol, as in the charts.
  std::string marker(const Style &style);

  /// A picture to stand inside a page: without its prologue, its ids made unique by the prefix, and
  /// a label for those who cannot see it.
  std::string inline_svg(const std::string &svg, const std::string &prefix,
                         const std::string &label);

  /// A whole page.
  /// @param name     of the scene, @param what  the page is, e.g. "report"
  /// @param content  of its main part
  std::string document(const std::string &name, const std::string &what, const std::string &head,
                       const std::string &content);

  /// The fact that results are not all that was asked for.
  inline constexpr const char *interrupted = "interrupted: what was finished";

  /// Name, purpose if there is one, and a line of facts.
  std::string plain_header(const std::string &name, const std::string &what,
                           const std::string &purpose, const std::vector<std::string> &facts);

  /// A picture from its file, or a word in its place where there is none.
  /// @param prefix   as of inline_svg, @param caption  HTML
  std::string figure(const std::filesystem::path &picture, const std::string &prefix,
                     const std::string &title, const std::string &caption, bool is_large);

  /// Title, purpose, what kind of study, how many verdicts, whether the run was finished.
  std::string header(const study::Results &results);

  /// Which method to take: one sentence over all cases, then a card for each problem and series.
  std::string advice(const study::Results &results);

  /// CsrMatrix: methods; columns: problems and series; in each cell the verdict in a word and a
  /// sign, the finest error and the last rate.
  std::string verdicts(const study::Results &results);

  /// All charts, the overall and the first convergence chart large.
  std::string charts(const study::Results &results, const std::filesystem::path &dir);

  /// The reference's own estimates, and the differences that are too small for them.
  std::string reference(const study::Results &results);

  /// Tables of errors and cost.
  std::string numbers(const study::Results &results);

  /// What was modelled, and what was left out; the check of the geometry.
  std::string model(const study::Results &results);

  /// How many of the scene's expectations hold; those that do not are shown, the others folded.
  std::string expectations(const study::Results &results);

  std::string diagnostics(const study::Results &results);

  /// Where the numbers come from: versions, machine, the scene as read.
  std::string provenance(const study::Results &results);

  /// A section with a heading.
  std::string section(const std::string &id, const std::string &head, const std::string &content);

  std::string paragraph(const std::string &text);

  /// What opens by a click on its summary.
  std::string folded(const std::string &summary, const std::string &content, bool is_open = false);
} // namespace plumbline::report::page
