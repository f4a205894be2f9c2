#include "check/in_space.h"

#include "base/error.h"
#include "base/number_text.h"
#include "check/body.h"
#include "check/text.h"
#include "io/results_json.h"
#include "meshfree/check/bond_values.h"
#include "report/text_table.h"

#include <algorithm>
#include <cmath>

namespace plumbline::check
{
  using meshfree::FindingsInSpace;
  using meshfree::WeightsInSpace;

  namespace
  {
    std::string number(double value)
    {
      constexpr int digits = 5;
      return base::to_text(value, digits);
    }

    /// That of the scene whose h is the spacing of the nodes.
    problem::Level level_of(const scene::Scene &scene, double spacing)
    {
      constexpr double alike = .02;
      problem::Level nearest;
      double least = HUGE_VAL;
      for (const auto &series : scene.study.series)
        for (const problem::Level &level : series.levels)
          if (const double off = std::abs(std::log(level.h / spacing)); off < least)
          {
            least = off;
            nearest = level;
          }
      if (least > alike)
        throw InputError("the spacing of the nodes is " + number(spacing) +
                         ", but the nearest level of the scene has h = " + number(nearest.h) +
                         "; give Study/h and Study/m, or Study/horizon, of your bonds");
      return nearest;
    }

    std::string off(const FindingsInSpace &found, const WeightsInSpace &given)
    {
      const auto at = [&](const meshfree::Worst &worst) {
        return base::to_percent(worst.value) + " at node " + std::to_string(given.id[worst.node]);
      };
      return "first moments are off by " + at(found.first) + ", second moments by " +
             at(found.second);
    }

    /// What makes the exit code 1.
    std::vector<std::string> complaints(const FindingsInSpace &found, const WeightsInSpace &given,
                                        const Requirements &required, const problem::Level &level)
    {
      constexpr double of_files = 1e-5;
      const double tolerance = std::max(of_files, 10 * given.rounding),
                   ratio = level.h / level.horizon;
      std::vector<std::string> result;
      for (const std::string &cause : found.causes)
        result.push_back("cause: " + cause);
      for (const std::string &outlier : found.outliers)
        result.push_back("outlier: " + outlier);
      if (required.ac && found.second.value > tolerance)
        result.push_back("required ac: " + off(found, given));
      if (required.consistent && found.typical > ratio)
        result.push_back("required consistent: moments of most nodes are off by " +
                         base::to_percent(found.typical) +
                         ", more than h/horizon = " + base::to_percent(ratio));
      if (required.moments && found.second.value > *required.moments)
        result.push_back("required moments=" + number(*required.moments) + ": " +
                         off(found, given));
      if (required.symmetric && (found.imbalance > tolerance || found.n_unpaired > 0))
        result.push_back("required symmetric: forces of a pair differ by up to " +
                         base::to_percent(found.imbalance) + " of the largest; " +
                         std::to_string(found.n_unpaired) + " bonds without a partner");
      if (required.m_matrix && found.n_negative > 0)
        result.push_back("required m-matrix: " + std::to_string(found.n_negative) +
                         " weights are negative");
      return result;
    }

    /// What else there is to say.
    std::vector<std::string> words_of(const FindingsInSpace &found, const WeightsInSpace &given)
    {
      std::vector<std::string> lines = {
          std::to_string(given.free.size()) +
          (given.box ? " nodes in the periodic box, " : " nodes in the domain, ") +
          std::to_string(found.n_bonds) + " bonds, spacing " + number(found.spacing)};
      if (!found.rule.empty())
        lines.push_back(
            "the weights are those of " + found.rule +
            (std::abs(found.rule_factor - 1) > 1e-4 ? " times " + number(found.rule_factor) : ""));
      lines.push_back(off(found, given) + " (median of all nodes " +
                      base::to_percent(found.typical) + ")");
      for (const meshfree::ElasticRange &one : found.elastic)
        lines.push_back(one.name + ": " + number(one.median) + " (" + number(one.least) + " ... " +
                        number(one.largest) + ")");
      if (found.n_negative > 0)
        lines.push_back(std::to_string(found.n_negative) + " weights are negative");
      return lines;
    }

  } // namespace

  study::Record record_of(const InSpace &found)
  {
    study::Record record;
    record.key.analysis = "check";
    record.key.method = found.rule.empty() ? "given weights" : found.rule;
    record.key.h = found.level.h;
    record.key.horizon = found.level.horizon;
    record.set("nodes", static_cast<double>(found.given.free.size()));
    record.set("bonds", static_cast<double>(found.n_bonds));
    record.set("negative weights", static_cast<double>(found.n_negative));
    record.set("bonds without partner", static_cast<double>(found.n_unpaired));
    record.set("first moment defect", found.first.value);
    record.set("second moment defect", found.second.value);
    record.set("median moment defect", found.typical);
    record.set("imbalance of pairs", found.imbalance);
    if (!found.rule.empty())
      record.set("factor of the rule", found.rule_factor);
    for (const meshfree::ElasticRange &one : found.elastic)
    {
      record.set("least " + one.name, one.least);
      record.set("median " + one.name, one.median);
      record.set("largest " + one.name, one.largest);
    }
    record.notes = found.complaints;
    return record;
  }

  InSpace find_in_space(const scene::Scene &scene, const Input &input, const Requirements &required)
  {
    if (!scene.domain.mesh.is_lattice())
      throw InputError("Domain/mesh = " + scene.domain.mesh.name +
                       ": in three dimensions weights are checked on one box; write lattice, and "
                       "give Domain/boxes");
    const geometry::Solid &solid = scene.domain.solid;
    if (solid.include.size() != 1 || !solid.exclude.empty())
      throw InputError("in three dimensions weights are checked on one box; give Domain/boxes with "
                       "one, and clear Domain/holes");
    const geometry::Cuboid &omega = solid.include.front();
    InSpace found;
    found.given = meshfree::read_weights_in_space(input.nodes_file, input.bonds_file, omega,
                                                  to_boundary(input.boundary, "--boundary") ==
                                                      scene::Boundary::periodic);
    found.level = level_of(scene, meshfree::node_spacing(found.given, omega));
    if (found.given.box)
      found.given.box->check_sides(found.level.horizon, found.level.h);
    const auto kernel = make_kernel_in_space(scene, found.level.horizon);
    to_weights(meshfree::to_bond_values(input.bonds_are, "--bonds-are"), kernel, found.given);
    static_cast<FindingsInSpace &>(found) =
        meshfree::find_defects(found.given, kernel, omega, scene.methods.names);
    found.complaints = complaints(found, found.given, required, found.level);
    found.assumed = assumptions(scene, input, found.level);
    return found;
  }

  const char *const not_checked_in_space =
      "not checked in three dimensions: Voronoi cells, matrix, solutions; no maps are drawn\n";

  std::string text(const InSpace &found)
  {
    std::string body;
    std::vector<std::string> lines = words_of(found, found.given);
    if (!found.assumed.empty())
      lines.push_back(found.assumed);
    for (const std::string &line : lines)
      body += report::wrapped(line, report::summary_columns, 2) + '\n';
    body += not_checked_in_space;
    return check_summary(body, found.complaints,
                         found.complaints.empty() ? "as required" : "NOT as required",
                         "in check.json (-o FOLDER)");
  }

  std::string to_json(const InSpace &found, const scene::Scene &scene)
  {
    study::StudyResults results;
    results.analysis = "check";
    results.scene_name = scene.name;
    results.purpose = scene.purpose;
    results.records = {record_of(found)};
    return io::to_json(results);
  }
} // namespace plumbline::check
