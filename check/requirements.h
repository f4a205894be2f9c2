#pragma once

#include "check/scene_findings.h"

#include <optional>

namespace plumbline::check
{
  /// What a caller of `plumbline check` demands of weights.
  struct Requirements
  {
    bool ac = false;               ///< moments of degree 1 and 2 exact, to rounding of files
    bool consistent = false;       ///< at most nodes off by no more than h / horizon
    std::optional<double> moments; ///< off by no more than this
    bool symmetric = false, m_matrix = false;
  };

  /// Of words as on the command line, each a list separated by commas; none: ac.
  /// @throws InputError  a word that is not known, a tolerance that is no positive number
  Requirements parse_requirements(const std::vector<std::string> &words);

  /// The text for --help.
  extern const char *const requirements_help;

  /// In complaints, for scenes.
  extern const char *const where_lengths_are_given;

  /// What makes the exit code 1: requirements that do not hold; a matrix that is not positive
  /// definite, a cause of all weights, outliers, whatever is required.
  template <int dim>
  std::vector<std::string> complaints(const Findings<dim> &found, const Requirements &required);

  /// Whether a complaint doubts that the scene belongs to the bonds: all others rest on that.
  bool is_question(const std::string &complaint);

  /// What else there is to say.
  template <int dim>
  std::vector<std::string> verdicts(const Findings<dim> &found);

  /// One outlier in words: which, where in the files, what is expected.
  template <int dim>
  std::string text(const meshfree::Outlier<dim> &outlier, const Findings<dim> &found);
} // namespace plumbline::check
