#pragma once

#include "check/requirements.h"

namespace plumbline::check
{
  /// A summary of 25 lines of 120 columns at most.
  /// @param body       lines
  /// @param sentences  after them, at most 15 lines
  /// @param answer     the last line
  /// @param elsewhere  where what is cut off is found
  std::string check_summary(const std::string &body, const std::vector<std::string> &sentences,
                            const std::string &answer,
                            const std::string &elsewhere = "in the report");

  /// What is found, for people; the answer last.
  /// @param page  of the report
  template <int dim>
  std::string check_text(const Findings<dim> &found, const Requirements &required,
                         const Input &input, const std::string &page);

  extern const char *const not_checked_in_space; ///< a sentence for the end of texts

  /// The number under "schema" of check.json; as io::schema.
  constexpr unsigned int check_schema = 1;

  /// The same for programs, as lib/report/check.schema.json describes it.
  template <int dim>
  std::string check_json(const Findings<dim> &found, const Requirements &required,
                         const Input &input, int exit_code);
} // namespace plumbline::check
