#include "check_findings.h"

#include "base/error.h"
#include "geometry/local_coordinates.h"
#include "meshfree/check/bond_ramp.h"
#include "meshfree/discretisations.h"
#include "reference/method.h"
#include "scene/mesh.h"
#include "study/comparison.h"
#include "study/refusal.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace plumbline::app
{
  using namespace meshfree;

  std::string ChosenLevel::text() const
  {
    std::ostringstream text;
    text << series << ": h = " << level.h << ", horizon = " << level.horizon;
    return text.str();
  }

  namespace
  {
    /// The level whose h is nearest to the spacing of the nodes, by their ratio.
    ChosenLevel choose_level(const scene::Scene &scene, const GivenNodes &nodes)
    {
      const problem::Series &first = scene.study.series.front();
      const double size = node_spacing(nodes, scene::make_mesh(scene, first.levels.front()));
      ChosenLevel chosen{first.levels.front(), first.name, size};
      const auto distance = [&](const problem::Level &level)
      { return std::abs(std::log(level.h / size)); };
      for (const problem::Series &series : scene.study.series)
        for (const problem::Level &level : series.levels)
          if (distance(level) < distance(chosen.level))
            chosen = {level, series.name, size};
      return chosen;
    }

    /// That of the scene, or Q1 or P1.
    std::shared_ptr<const method::Method> reference_method(const scene::Case &one)
    {
      const auto &wanted = one.scene.reference.method;
      const std::string name = wanted ? *wanted : one.problem.mesh->is_triangles() ? "P1" : "Q1";
      for (const auto &method : reference::methods())
        if (method->name() == name)
        {
          if (const std::string reason = study::refusal(*method, one, reference::methods());
              !reason.empty())
            throw InputError("Reference/method: '" + name + "' cannot do this scene: " + reason);
          return method;
        }
      throw InputError("Reference/method = '" + name +
                       "' is no Galerkin method, which weights are checked against; choose one "
                       "('plumbline list methods')");
    }

    /// @throws NumericalError  there is none, naming method, case and level
    analysis::Solution reference_solution(const problem::Problem<2> &problem,
                                          const method::Method &method, const std::string &place)
    {
      try
      {
        return analysis::solve(method, problem);
      }
      catch (const MemoryError &)
      {
        throw;
      }
      catch (const NumericalError &error)
      {
        throw NumericalError("no solution by the reference " + method.name() + " of " + place +
                             ": " + error.what());
      }
    }

    /// A user's own families in place of a rule's.
    class GivenWeights : public method::Method
    {
    public:
      explicit GivenWeights(const FamilySource &families) : families_(families) {}
      std::string name() const override { return "given"; }
      method::MethodFamily family() const override { return method::MethodFamily::meshfree; }
      std::string help() const override { return "weights of a file"; }
      std::unique_ptr<method::Discretisation>
      discretise(const problem::Problem<2> &problem,
                 const base::Communicator &communicator) const override
      {
        return discretise_on_scattered_nodes(
            [&](auto share) { return scattered_operator(families_, problem, share); }, problem,
            communicator);
      }

    private:
      const FamilySource &families_;
    };

    /// @param place  the case and the level, for messages
    CaseCheck check_case(const scene::Case &one, const std::string &place,
                         const FamilySource &families)
    {
      const problem::Problem<2> &problem = one.problem;
      const auto &norms = one.scene.study.norms;
      const auto method = reference_method(one);
      const analysis::Solution reference = reference_solution(problem, *method, place);
      CaseCheck result{
          one.name(), method->name(), {}, {}, study::errors(norms, problem, reference, {})};
      try
      {
        const analysis::Solution solution = analysis::solve(GivenWeights(families), problem);
        result.errors = study::errors(norms, problem, solution, {reference.averages, {}});
      }
      catch (const NumericalError &error)
      {
        result.failure = error.what();
      }
      return result;
    }

    /// The families with the volumes of their neighbours.
    std::vector<Family> with_volumes(std::vector<Family> families,
                                     const std::vector<double> &volumes)
    {
      for (Family &family : families)
        for (std::size_t k = 0; k < family.bonds.size(); ++k)
          family.bonds[k].area = volumes[family.neighbours[k]];
      return families;
    }

    /// Volumes and weights that belong together, and the rule of ours that the weights are.
    struct Recognition
    {
      std::vector<double> volumes; ///< that the weights were made with, as far as it is known
      std::vector<Family> families;
      std::optional<Recognised> rule;
    };

    /// Volumes that are wrong are mended first: were they left as they are, the weights to those
    /// nodes would seem wrong as well, though they may be right. If no rule of ours is recognised
    /// then, the weights may be made with the wrong volumes.
    Recognition recognise_weights(const Findings &found, const problem::Problem<2> &problem)
    {
      Recognition result;
      std::vector<double> as_given = found.volumes;
      for (double &volume : as_given)
        volume /= found.volume_factor;
      using Volumes = const std::vector<double> *;
      for (const Volumes volumes : {&found.mended_volumes, static_cast<Volumes>(&as_given)})
      {
        std::vector<Family> families = with_volumes(found.given.families, *volumes);
        auto rule =
            recognise({families, problem.kernel, *problem.cells, *volumes, found.precision});
        if (!rule && !result.volumes.empty())
          break;
        result = {*volumes, std::move(families), std::move(rule)};
        if (result.rule || found.outliers.empty())
          break;
      }
      return result;
    }

    /// Adds outliers among bonds and nodes, except those that volumes explain: weights
    /// that were made with a volume that is wrong are all off by its factor.
    void add_outliers(Findings &found, const std::vector<Outlier> &outliers)
    {
      const std::vector<Outlier> volumes = found.outliers;
      for (const Outlier &one : outliers)
        if (std::none_of(volumes.begin(), volumes.end(),
                         [&](const Outlier &volume)
                         {
                           return (one.defect == Defect::neighbour && one.node == volume.node) ||
                                  (one.defect == Defect::weight && one.neighbour == volume.node);
                         }))
          found.outliers.push_back(one);
    }

    /// Weights as they stand, for what names their defects.
    void find_defects(Findings &found, const scene::Case &one)
    {
      const problem::Problem<2> &problem = one.problem;
      const Recognition recognition = recognise_weights(found, problem);
      const GivenBonds given{recognition.families, problem.kernel,  *problem.cells,
                             recognition.volumes,  found.precision, found.nodes.origin};
      const Explanation explanation =
          explain(given, recognition.rule,
                  {one.scene.methods.names, found.volume_factor, found.given.of_collar});
      found.causes = explanation.causes;
      found.is_mended = std::any_of(found.causes.begin(), found.causes.end(),
                                    [](const Cause &cause) { return cause.is_structural; });
      if (const auto &rule = found.is_mended ? explanation.rule : recognition.rule)
      {
        found.rule = rule->rule;
        found.rule_factor = rule->factor;
        if (rule->is_full_area() && found.causes.empty() &&
            found.moments.typical() > found.precision.moments)
          found.rule_remark = ramp_text(ramp_effects(given, given.families));
      }
      if (found.is_mended)
        return; // single bonds cannot be judged yet
      double point_scale = 1;
      for (const Cause &cause : found.causes)
        point_scale *= cause.point_scale;
      add_outliers(found, find_outliers(given, recognition.rule, point_scale));
    }

    /// Volumes against the areas of cells, which come before all that is relative to volumes.
    void find_volumes(Findings &found, const problem::Problem<2> &problem,
                      const std::vector<double> &uncut_areas)
    {
      found.precision = Precision::of_files(found.nodes.rounding, found.given.weight_rounding,
                                            found.nodes.volume_rounding, found.level.node_size,
                                            problem.horizon());
      const VolumeCheck volumes = check_volumes(
          {found.given.families, problem.kernel, *problem.cells, found.volumes, found.precision},
          uncut_areas);
      found.volume_factor = volumes.factor;
      found.outliers = volumes.outliers;
      found.mended_volumes = volumes.mended;
      found.given.families = with_volumes(std::move(found.given.families), found.mended_volumes);
      for (CollarBond &one : found.given.of_collar)
        one.bond.area = found.mended_volumes[one.neighbour];
      double volume = 0, area = 0;
      for (std::size_t i = 0; i < found.cells->n_free; ++i)
      {
        volume += found.volumes[i];
        area += found.cells->area[i];
      }
      found.volume_defect = volume / area - 1;
    }

    /// How the files were read.
    std::vector<std::string> all_notes(const Findings &found, const CheckOptions &options)
    {
      std::vector<std::string> result;
      for (const auto &[file, notes] : {std::pair{options.nodes_file, found.nodes.notes},
                                        std::pair{options.bonds_file, found.given.notes}})
        for (const std::string &note : notes)
          result.push_back("'" + file + "': " + note);
      return result;
    }
  } // namespace

  Findings find(scene::Scene scene, const CheckOptions &options)
  {
    check_analysis(scene, scene::Analysis::check);
    Findings found;
    found.scene_name = scene.name;
    found.purpose = scene.purpose;
    found.nodes = read_given_nodes(options.nodes_file);
    found.nodes.origin = scene.domain.origin;
    geometry::move_to(found.nodes.origin, found.nodes.places);
    const bool boundary_is_data = scene.methods.nodes.are_vertices();
    if (scene.domain.mesh.is_lattice())
      scene.domain.mesh.name = "squares";
    scene.methods.nodes = {std::filesystem::absolute(options.nodes_file).string()};
    scene.study.norms = {scene::Norm::nodal_linf, scene::Norm::averages_l2};
    found.level = choose_level(scene, found.nodes);
    const geometry::Mesh mesh = scene::make_mesh(scene, found.level.level);
    check_places(found.nodes, mesh, found.level.text());
    GivenCells cells = given_cells(found.nodes, mesh, boundary_is_data);
    found.cells = std::make_shared<const geometry::NodeCells>(std::move(cells.cells));
    found.n_on_boundary = boundary_is_data ? 0 : cells.n_on_boundary;
    const auto case_of = [&](unsigned int c)
    {
      scene::Case one = scene::make_case(scene, c, found.level.level);
      one.problem.cells = found.cells;
      return one;
    };
    const scene::Case first = case_of(0);
    const problem::Problem<2> &problem = first.problem;

    found.given = read_given_families(options.bonds_file, found.nodes, *found.cells);
    for (const std::size_t i : found.cells->source)
    {
      found.ids.push_back(found.nodes.id[i]);
      found.volumes.push_back(found.nodes.volume[i]);
    }
    found.notes = all_notes(found, options);
    find_volumes(found, problem, cells.uncut_areas);

    const std::vector<Family> &families = found.given.families;
    found.moments = check_moments(families, problem.kernel);
    found.weights = check_weights(families, problem.kernel, found.mended_volumes);
    found.symmetry = check_symmetry(families, problem.kernel, found.mended_volumes);
    find_defects(found, first);
    const FamilySource source = [&](std::size_t i, Family &family) { family = families[i]; };
    try
    {
      found.matrix = algebra::check_matrix(
          scattered_operator(source, problem, {0, found.cells->n_free}).rows.free);
    }
    catch (const NumericalError &error)
    {
      found.matrix_failure = error.what(); // weights may be wrong enough for rows to be empty
    }
    const auto names = scene.problem.case_names();
    for (unsigned int c = 0; c < names.size(); ++c)
      found.cases.push_back(check_case(case_of(c), names[c] + ", " + found.level.text(), source));
    return found;
  }
} // namespace plumbline::app
