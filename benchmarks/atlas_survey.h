#pragma once

#include "report/selection.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// What the results of many scenes say together.
namespace plumbline::atlas
{
  namespace fs = std::filesystem;

  /// Relative errors that the cheapest method is asked for.
  constexpr double targets[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6};

  /// One run of a scene, with its results, or why there are none.
  struct Entry
  {
    std::string group, name; ///< folder and file of the scene
    fs::path folder;         ///< of the results, relative to the atlas
    study::StudyResults results;
    std::string refusal; ///< empty, or what the command said
  };

  /// All below a folder, sorted by name.
  std::vector<Entry> read_entries(const fs::path &atlas, const std::string &below);

  /// The decisive error over the largest |u|; NaN if there is none.
  double relative_error(const study::StudyResults &results, const study::Record &run);

  /// One problem of a scene, its series pooled, or one of them.
  struct Question
  {
    const study::StudyResults *results;
    std::string problem;
    std::string series; ///< empty: all
    std::string title() const { return series.empty() ? problem : problem + ", " + series; }
  };

  /// Of nonlocal methods: the local limit's finite elements answer another question.
  std::vector<const study::Record *> runs_of(const Question &question);

  /// The worst of a method's verdicts over the question's series.
  study::Outcome outcome_of(const Question &question, const std::string &method);

  /// Methods of the question's runs with that outcome, in the order of the runs.
  std::vector<std::string> with_outcome(const Question &question, study::Outcome outcome);

  /// The cheapest run that is accurate enough, of methods that converge, or else of those of which
  /// it is not known; nullptr: none.
  const study::Record *cheapest(const Question &question, double target);

  /// The Pareto front of relative error against CPU time, cheap to dear: runs that no other run
  /// equals in accuracy for nine tenths of the time or less, from a tenth down to round-off.
  /// Stalling methods are on it too: at low accuracy they may be the cheapest.
  std::vector<const study::Record *> front(const Question &question);

  /// Each method of the front once, cheap to dear.
  std::vector<std::string> methods_on_front(const Question &question);

  /// Or failing.
  bool is_stalling(const Question &question, const std::string &method);

  /// How a method does over many questions.
  struct Tally
  {
    std::size_t n = 0, n_front = 0, n_front_stalling = 0;
    std::map<study::Outcome, std::size_t> n_outcome;
    std::map<double, std::size_t> n_cheapest;
  };

  std::map<std::string, Tally> tally(const std::vector<Question> &questions);
} // namespace plumbline::atlas
