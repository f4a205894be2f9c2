#pragma once

#include "problem/settings.h"
#include "scene/choices.h"
#include "scene/crack_section.h"
#include "scene/fracture_section.h"
#include "scene/vocabulary.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::scene
{
  class Keys;

  // What the sections of a scene file say about how its problem is solved, see problem_sections.h.

  /// Where meshfree nodes are.
  struct NodeSource
  {
    std::string name = "centres"; ///< centres, vertices, mesh, or a .csv file
    double perturbation = 0;      ///< of centres, by up to so many h along each axis

    NodeKind kind() const { return base::from_word<NodeKind>(name).value_or(NodeKind::file); }
    bool are_vertices() const { return kind() == NodeKind::vertices; }
    bool are_lattice_centres() const { return kind() == NodeKind::centres && perturbation == 0; }

    static constexpr auto level_mark = "{h}"; ///< in a file's name: the mesh size of the level
    bool is_for_each_level() const { return name.find(level_mark) != std::string::npos; }
    std::string file_at(double h) const; ///< e.g. nodes_0.05.csv for nodes_{h}.csv
  };

  struct MethodsSection
  {
    std::vector<std::string> names;
    NodeSource nodes;
    bool loads_are_averages = false; ///< meshfree: over the cells, not at the nodes

    void declare(Keys &keys);
    void complete() const;
  };

  /// The error that verdicts rest on.
  struct DecisiveError
  {
    Norm norm = Norm::nodal_linf;
    Target target = Target::exact;

    std::string text() const { return base::word(norm) + " | " + base::word(target); }
  };

  struct StudySection
  {
    Regime regime = Regime::delta;
    std::vector<double> h = {.1, .05, .025, .0125}, m = {3}, horizon = {.4};
    std::string variable;       ///< that varies in its regime, one of RandomSection::variables
    std::vector<double> values; ///< of it
    std::vector<Series> series; ///< of these
    std::vector<Norm> norms;
    DecisiveError decisive_error;

    void declare(Keys &keys);
    void complete();
  };

  struct ReferenceSection
  {
    std::optional<std::string> method; ///< its name
    double h = 0;                      ///< mesh size for all levels; 0: that of each level [length]
    Estimate estimate = Estimate::automatic;
    double tolerance = 0; ///< relative; 0: only reported

    bool is_torus() const { return method == "torus"; } ///< no method: of motions, without a mesh

    void declare(Keys &keys);
  };

  struct QuadratureSection : problem::QuadratureSettings
  {
    void declare(Keys &keys);
  };

  struct GeometrySection : problem::GeometrySettings
  {
    void declare(Keys &keys);
  };

  struct SolverSection : problem::SolverSettings
  {
    void declare(Keys &keys);
  };

  struct OutputSection
  {
    bool fields = false;
    std::string points; ///< name of a CSV file with columns x, y (and z); empty: none

    void declare(Keys &keys);
  };

  /// One expectation: which method (and case, and series, if given), and what is expected of it.
  struct Expected
  {
    ExpectedKind kind = ExpectedKind::verdicts;
    std::string method, problem, series; ///< empty: all
    std::string text;                    ///< as in the scene, for reports
    std::vector<double> values;          ///< of jitter: least, most
    std::string verdict;                 ///< of verdicts and stability; of monotone: yes or no
  };

  struct ExpectedSection
  {
    std::vector<Expected> all; ///< kind by kind
    double error_tolerance = 5e-4, rate_tolerance = .1;
    CrackOutcome crack = CrackOutcome::unknown; ///< of 'plumbline crack'
    std::map<std::string, double> growth;       ///< of 'plumbline grow', by the name of a quantity
    GrowthEnd growth_end = GrowthEnd::unknown;

    void declare(Keys &keys);
    /// @param cases  that there are
    void complete(const std::vector<std::string> &cases) const;
  };
} // namespace plumbline::scene
