#include "check_findings.h"

#include "base/error.h"
#include "meshfree/check/bond_nodes.h"
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
    /// The level whose h is nearest to the size of the nodes.
    ChosenLevel choose_level(const scene::Scene &scene, const GivenNodes &nodes)
    {
      const auto inside =
          nodes_inside(nodes, scene::make_mesh(scene, scene.study.series.front().levels.front()));
      double volume = 0;
      for (const std::size_t i : inside)
        volume += nodes.volume[i];
      const double size = std::sqrt(volume / static_cast<double>(inside.size()));
      ChosenLevel chosen{scene.study.series.front().levels.front(), scene.study.series.front().name,
                         size};
      for (const scene::Series &series : scene.study.series)
        for (const scene::Level &level : series.levels)
          if (std::abs(level.h - size) < std::abs(chosen.level.h - size))
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
    analysis::Solution reference_solution(const scene::Problem &problem,
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
      method::Side side() const override { return method::Side::meshfree; }
      std::string help() const override { return "weights of a file"; }
      std::unique_ptr<method::Discretisation>
      discretise(const scene::Problem &problem,
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
      const scene::Problem &problem = one.problem;
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

    /// A volume that is out of line, by what is expected of it: were it left as it is, the weights
    /// to that node would seem out of line as well, though they may be right.
    std::vector<double> mended(std::vector<double> volumes, const std::vector<Outlier> &outliers)
    {
      for (const Outlier &one : outliers)
        volumes[one.node] = one.expected;
      return volumes;
    }

    /// Weights as they stand, for what names their defects.
    void find_defects(Findings &found, const scene::Case &one,
                      const std::vector<double> &uncut_areas)
    {
      const scene::Problem &problem = one.problem;
      const std::vector<Family> &families = found.given.families;
      found.outliers = find_volume_outliers(
          {families, problem.kernel, *problem.cells, found.volumes}, uncut_areas);
      const std::vector<double> volumes = mended(found.volumes, found.outliers);
      const GivenBonds given{families, problem.kernel, *problem.cells, volumes};
      const auto rule = recognise(given);
      if (rule)
      {
        found.rule = rule->rule;
        found.rule_factor = rule->factor;
      }
      found.causes = find_causes(given, rule, one.scene.methods.names);
      if (rule && rule->is_full_area() && found.causes.empty())
        found.rule_remark = ramp_text(ramp_effects(given, families));
      const double point_scale = found.causes.empty() ? 1 : found.causes.front().point_scale;
      const std::size_t n_volumes = found.outliers.size();
      for (const Outlier &one : find_outliers(given, rule, point_scale))
        // weights that were made with a volume that is wrong are all off by its factor
        if (std::none_of(found.outliers.begin(),
                         found.outliers.begin() + static_cast<std::ptrdiff_t>(n_volumes),
                         [&](const Outlier &volume)
                         {
                           return (one.defect == Defect::neighbour && one.node == volume.node) ||
                                  (one.defect == Defect::weight && one.neighbour == volume.node);
                         }))
          found.outliers.push_back(one);
    }
  } // namespace

  Findings find(scene::Scene scene, const CheckOptions &options)
  {
    check_analysis(scene, scene::Analysis::check);
    Findings found;
    found.scene_name = scene.name;
    found.purpose = scene.purpose;
    found.nodes = read_given_nodes(options.nodes_file);
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
    const scene::Problem &problem = first.problem;

    found.given = read_given_families(options.bonds_file, found.nodes, *found.cells);
    for (const std::size_t i : found.cells->source)
    {
      found.ids.push_back(found.nodes.id[i]);
      found.volumes.push_back(found.nodes.volume[i]);
    }
    double volume = 0, area = 0;
    for (std::size_t i = 0; i < found.cells->n_free; ++i)
    {
      volume += found.volumes[i];
      area += found.cells->area[i];
    }
    found.volume_defect = volume / area - 1;

    const std::vector<Family> &families = found.given.families;
    found.moments = check_moments(families, problem.kernel);
    found.weights = check_weights(families, problem.kernel, found.volumes);
    found.symmetry = check_symmetry(families, problem.kernel);
    find_defects(found, first, cells.uncut_areas);
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
