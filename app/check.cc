#include "check.h"

#include "algebra/spectrum.h"
#include "base/error.h"
#include "base/team.h"
#include "meshfree/bond_check.h"
#include "meshfree/bond_file.h"
#include "meshfree/scattered_operator.h"
#include "reference/method.h"
#include "scene/mesh.h"
#include "study/comparison.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace plumbline::app
{
  namespace
  {
    using namespace meshfree;
    using Json = nlohmann::ordered_json;

    /// Second moments wrong by more than this are no matter of accuracy.
    constexpr double worst_allowed = .3;

    /// A level of a scene, and what led to it.
    struct ChosenLevel
    {
      scene::Level level;
      std::string series;
      double node_size; ///< √ of the mean volume of the free nodes [length]

      std::string text() const
      {
        std::ostringstream text;
        text << series << ": h = " << level.h << ", horizon = " << level.horizon;
        return text.str();
      }
    };

    /// The level whose h is nearest to the size of the nodes.
    ChosenLevel choose_level(const scene::Scene &scene, const GivenNodes &nodes)
    {
      const auto inside =
          nodes_inside(nodes, scene::make_mesh(scene, scene.series.front().levels.front()));
      double volume = 0;
      for (const std::size_t i : inside)
        volume += nodes.volume[i];
      const double size = std::sqrt(volume / static_cast<double>(inside.size()));
      ChosenLevel chosen{scene.series.front().levels.front(), scene.series.front().name, size};
      for (const scene::Series &series : scene.series)
        for (const scene::Level &level : series.levels)
          if (std::abs(level.h - size) < std::abs(chosen.level.h - size))
            chosen = {level, series.name, size};
      return chosen;
    }

    /// That of the scene, or Q1 or P1.
    std::shared_ptr<const study::Method> reference_method(const scene::Scene &scene,
                                                          const scene::Problem &problem)
    {
      const std::string name = scene.reference != "none"      ? scene.reference
                               : problem.mesh->is_triangles() ? "P1"
                                                              : "Q1";
      for (const auto &method : reference::methods())
        if (method->name() == name)
        {
          if (const std::string reason = method->why_not(scene, problem); !reason.empty())
            throw InputError("Reference/method: '" + name + "' cannot do this scene: " + reason);
          return method;
        }
      throw InputError("Reference/method = '" + name +
                       "' is no Galerkin method, which weights are checked against; choose one "
                       "('plumbline list methods')");
    }

    /// What one case of the scene shows.
    struct CaseCheck
    {
      std::string name, reference;
      std::string failure;                  ///< empty: there is a solution
      std::map<std::string, double> errors; ///< by "norm | target"
      std::map<std::string, double> reference_errors;
    };

    CaseCheck check_case(const scene::Scene &scene, const scene::Problem &problem,
                         const std::string &name, const FamilySource &families)
    {
      const auto method = reference_method(scene, problem);
      const study::Solution reference = method->solve(scene, problem);
      CaseCheck result{name, method->name(), {}, {}, study::errors(scene, problem, reference, {})};
      try
      {
        const study::Solution solution = scattered_solution(
            [&](auto share) { return scattered_operator(families, problem, share); }, scene,
            problem);
        result.errors = study::errors(scene, problem, solution, {reference.averages, {}});
      }
      catch (const NumericalError &error)
      {
        result.failure = error.what();
      }
      return result;
    }

    /// All that is found.
    struct Findings
    {
      GivenNodes nodes;
      std::vector<std::int64_t> ids; ///< of the nodes as they are numbered below
      std::size_t n_free, n_ignored;
      ChosenLevel level;
      double volume_defect; ///< of the free nodes' volumes against Ω's area, relative
      MomentCheck moments;
      WeightCheck weights;
      SymmetryCheck symmetry;
      algebra::MatrixCheck matrix;
      std::vector<CaseCheck> cases;
    };

    Findings find(scene::Scene scene, const CheckOptions &options)
    {
      Findings found;
      found.nodes = read_given_nodes(options.nodes_file);
      if (scene.mesh.is_lattice())
        scene.mesh.kind = "squares";
      scene.nodes = {std::filesystem::absolute(options.nodes_file).string()};
      scene.norms = {"nodal Linf", "averages L2"};
      found.level = choose_level(scene, found.nodes);
      check_places(found.nodes, scene::make_mesh(scene, found.level.level), found.level.text());

      scene::Problem problem = scene::make_problem(scene, 0, found.level.level);
      const geometry::NodeCells &cells = *problem.cells;
      const GivenFamilies given = read_given_families(options.bonds_file, found.nodes, cells);
      found.n_free = cells.n_free;
      found.n_ignored = given.n_ignored;
      for (const std::size_t i : cells.source)
        found.ids.push_back(found.nodes.id[i]);
      std::vector<double> volumes;
      double volume = 0, area = 0;
      for (std::size_t i = 0; i < cells.n_free; ++i)
      {
        volumes.push_back(found.nodes.volume[cells.source[i]]);
        volume += volumes.back();
        area += cells.area[i];
      }
      found.volume_defect = volume / area - 1;

      found.moments = check_moments(given.families, problem.kernel);
      found.weights = check_weights(given.families, problem.kernel, volumes);
      found.symmetry = check_symmetry(given.families, problem.kernel);
      const FamilySource families = [&](std::size_t i, Family &family)
      { family = given.families[i]; };
      found.matrix =
          algebra::check_matrix(scattered_operator(families, problem, {0, cells.n_free}).rows);
      const auto names = scene.case_names();
      for (unsigned int c = 0; c < names.size(); ++c)
        found.cases.push_back(check_case(scene, scene::make_problem(scene, c, found.level.level),
                                         names[c], families));
      return found;
    }

    std::string percent(double fraction)
    {
      std::ostringstream text;
      text << std::setprecision(3) << 100 * fraction << " %";
      return text.str();
    }

    /// What makes the weights wrong; empty: nothing.
    std::vector<std::string> complaints(const Findings &found)
    {
      std::vector<std::string> result;
      const auto id = [&](std::size_t node) { return std::to_string(found.ids[node]); };
      const Worst &second = found.moments.second;
      if (second.value > worst_allowed)
        result.push_back("second moments are off by " + percent(second.value) + " at node " +
                         id(second.node) + ", more than " + percent(worst_allowed));
      constexpr std::size_t most_named = 5;
      const auto &isolated = found.moments.out_of_line;
      for (std::size_t i = 0; i < std::min(most_named, isolated.size()); ++i)
        result.push_back("the weights of node " + id(isolated[i].node) +
                         " are out of line with the others: second moments off by " +
                         percent(isolated[i].value));
      if (isolated.size() > most_named)
        result.push_back("so are those of " + std::to_string(isolated.size() - most_named) +
                         " more nodes");
      return result;
    }

    std::vector<std::string> verdicts(const Findings &found)
    {
      const MomentCheck &moments = found.moments;
      std::vector<std::string> result;
      const MomentDefect &first = moments.defects[0];
      if (!moments.is_first_exact())
        result.push_back("first moments off by up to " + percent(first.worst.value) + " at node " +
                         std::to_string(found.ids[first.worst.node]) +
                         ": the operator has a drift there that grows as 1 / horizon");
      if (moments.is_second_exact())
        result.push_back(
            std::string("second moments exact") +
            (moments.is_first_exact() ? ": asymptotically compatible as far as moments tell" : ""));
      else
        result.push_back(
            "second moments off by " + percent(moments.mean_ratio - 1) + " on average (worst " +
            percent(moments.second.value) + " at node " +
            std::to_string(found.ids[moments.second.node]) +
            "): as horizon and h go to 0 together the solution tends to a wrong limit, off by "
            "about " +
            percent(std::abs(1 / moments.mean_ratio - 1)));
      result.push_back(found.matrix.is_positive_definite() ? "positive definite"
                                                           : "NOT positive definite");
      for (const std::string &complaint : complaints(found))
        result.push_back(complaint);
      return result;
    }

    void print_text(const Findings &found, const CheckOptions &options)
    {
      const auto id = [&](std::size_t node) { return found.ids[node]; };
      std::ostream &out = std::cout;
      out << std::setprecision(4);
      out << "nodes     " << options.nodes_file << ": " << found.n_free << " free, "
          << found.ids.size() - found.n_free << " in the collar; volumes of the free ones off the "
          << "domain's area by " << percent(found.volume_defect) << '\n'
          << "bonds     " << options.bonds_file << ": " << found.weights.n_bonds << ", at most "
          << found.weights.largest_family << " of a node";
      if (found.n_ignored > 0)
        out << "; " << found.n_ignored << " of collar nodes ignored";
      out << "\nlevel     " << found.level.text() << ", nearest to the nodes' mean size "
          << found.level.node_size << "\n\nmoments   degree  worst       median      worst at\n";
      for (const MomentDefect &defect : found.moments.defects)
        out << "          " << std::left << std::setw(8) << defect.degree << std::setw(12)
            << defect.worst.value << std::setw(12) << defect.median << "node "
            << id(defect.worst.node) << '\n';
      out << "          reproduces polynomials up to degree " << found.moments.exact_degree
          << " (to " << MomentCheck::tolerance << ")\n"
          << "weights   " << found.weights.n_negative << " negative, "
          << found.weights.smallest_ratio << " to " << found.weights.largest_ratio
          << " of the neighbour's volume; their sum is off the ball without the node's own cell by "
          << percent(found.weights.area.value) << " at worst, at node "
          << id(found.weights.area.node) << '\n'
          << "symmetry  w C of a pair differs from end to end by "
          << percent(found.symmetry.asymmetry) << " of the largest";
      if (found.symmetry.asymmetry > 0)
        out << ", between nodes " << id(found.symmetry.nodes[0]) << " and "
            << id(found.symmetry.nodes[1]);
      out << "; " << found.symmetry.n_unpaired << " bonds without a partner\n"
          << "matrix    " << found.matrix.n_positive
          << " rows with positive off-diagonal entries (no M-matrix if any), "
          << found.matrix.n_weak
          << " not diagonally dominant; symmetric part: " << found.matrix.n_negative_eigenvalues
          << " negative eigenvalues, the smallest is " << found.matrix.smallest_eigenvalue << '\n';
      for (const CaseCheck &one : found.cases)
      {
        out << "solution  " << one.name << '\n';
        if (!one.failure.empty())
          out << "          none: " << one.failure << '\n';
        for (const auto &[name, value] : one.errors)
          out << "          " << std::setw(26) << name << value << '\n';
        for (const auto &[name, value] : one.reference_errors)
          out << "          " << std::setw(26) << name << value << "  by the reference, "
              << one.reference << '\n';
      }
      out << '\n';
      for (const std::string &verdict : verdicts(found))
        out << verdict << '\n';
    }

    void print_json(const Findings &found, const CheckOptions &options, int exit_code)
    {
      const auto worst = [&](const Worst &value) {
        return Json{{"value", value.value}, {"node", found.ids[value.node]}};
      };
      Json json = {{"nodes", options.nodes_file},
                   {"bonds", options.bonds_file},
                   {"scene", options.scene_file},
                   {"n_free", found.n_free},
                   {"n_collar", found.ids.size() - found.n_free},
                   {"n_bonds", found.weights.n_bonds},
                   {"n_ignored_bonds", found.n_ignored},
                   {"largest_family", found.weights.largest_family},
                   {"series", found.level.series},
                   {"h", found.level.level.h},
                   {"horizon", found.level.level.horizon},
                   {"node_size", found.level.node_size},
                   {"volume_defect", found.volume_defect}};
      for (const MomentDefect &defect : found.moments.defects)
        json["moments"].push_back(
            {{"degree", defect.degree}, {"worst", worst(defect.worst)}, {"median", defect.median}});
      json["exact_degree"] = found.moments.exact_degree;
      json["second_moment"] = {{"mean_ratio", found.moments.mean_ratio},
                               {"worst", worst(found.moments.second)},
                               {"out_of_line", Json::array()}};
      for (const Worst &node : found.moments.out_of_line)
        json["second_moment"]["out_of_line"].push_back(worst(node));
      json["weights"] = {{"n_negative", found.weights.n_negative},
                         {"smallest_ratio", found.weights.smallest_ratio},
                         {"largest_ratio", found.weights.largest_ratio},
                         {"area_defect", worst(found.weights.area)}};
      json["symmetry"] = {
          {"asymmetry", found.symmetry.asymmetry},
          {"nodes", {found.ids[found.symmetry.nodes[0]], found.ids[found.symmetry.nodes[1]]}},
          {"n_unpaired", found.symmetry.n_unpaired}};
      json["matrix"] = {{"n_rows_with_positive_entries", found.matrix.n_positive},
                        {"n_rows_not_dominant", found.matrix.n_weak},
                        {"n_negative_eigenvalues", found.matrix.n_negative_eigenvalues},
                        {"smallest_eigenvalue", found.matrix.smallest_eigenvalue}};
      for (const CaseCheck &one : found.cases)
        json["solutions"].push_back({{"case", one.name},
                                     {"failure", one.failure},
                                     {"errors", one.errors},
                                     {"reference", one.reference},
                                     {"reference_errors", one.reference_errors}});
      json["verdicts"] = verdicts(found);
      json["exit_code"] = exit_code;
      std::cout << json.dump(2) << '\n';
    }
  } // namespace

  int check(const CheckOptions &options)
  {
    const Findings found = find(scene::read_scene(options.scene_file, options.overrides), options);
    const bool is_wrong = !complaints(found).empty() || !found.matrix.is_positive_definite();
    if (!is_wrong)
      for (const CaseCheck &one : found.cases)
        if (!one.failure.empty())
          throw NumericalError("no solution of " + one.name + ": " + one.failure);
    const int exit_code = is_wrong ? 1 : 0;
    if (base::Team::all().rank() != 0 || options.quiet)
      return exit_code;
    if (options.json)
      print_json(found, options, exit_code);
    else
      print_text(found, options);
    return exit_code;
  }
} // namespace plumbline::app
