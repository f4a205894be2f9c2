#include "check/scene_findings.h"

#include "base/error.h"
#include "base/number_text.h"
#include "check/body.h"
#include "geometry/local_coordinates.h"
#include "meshfree/check/bond_values.h"
#include "meshfree/discretisations.h"
#include "problem/builder.h"
#include "scene/keys.h"
#include "scene/mesh.h"
#include "scene/scene_keys.h"
#include "study/comparison.h"
#include "study/motion_norms.h"
#include "study/refusal.h"
#include "study/round_off.h"
#include "study/solution_record.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace plumbline::check
{
  using namespace meshfree;

  std::string ChosenLevel::text() const
  {
    std::ostringstream text;
    text << series << ": h = " << level.h << ", horizon = " << level.horizon;
    return text.str();
  }

  bool ChosenLevel::is_near() const
  {
    constexpr double alike = .05;
    return std::abs(std::log(node_size / level.h)) <= alike;
  }

  ChosenLevel choose_level(const scene::Scene &scene, double spacing)
  {
    const problem::Series &first = scene.study.series.front();
    ChosenLevel chosen{first.levels.front(), first.name, spacing};
    const auto distance = [&](const problem::Level &level)
    { return std::abs(std::log(level.h / spacing)); };
    for (const problem::Series &series : scene.study.series)
      for (const problem::Level &level : series.levels)
        if (distance(level) < distance(chosen.level))
          chosen = {level, series.name, spacing};
    return chosen;
  }

  namespace
  {
    /// That of the scene, or Q1 or P1.
    std::shared_ptr<const method::Method> reference_method(const scene::Scene &scene,
                                                           const problem::Problem<2> &problem,
                                                           const method::Methods &references)
    {
      const auto &wanted = scene.reference.method;
      const std::string name = wanted ? *wanted : problem.mesh()->is_triangles() ? "P1" : "Q1";
      for (const auto &method : references)
        if (method->name() == name)
        {
          if (const std::string reason = study::refusal(*method, scene, problem, references);
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
    class WeightsOfAFile : public method::Method
    {
    public:
      explicit WeightsOfAFile(const FamilySource<2> &families) : families_(families) {}
      std::string name() const override { return "given weights"; }
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
      const FamilySource<2> &families_;
    };

    study::Record record_of(const method::Method &method, const std::string &problem,
                            const ChosenLevel &chosen)
    {
      study::Record record;
      record.key.analysis = "check";
      record.key.method = method.name();
      record.key.family = method.family();
      record.key.problem = problem;
      record.key.series = chosen.series;
      record.key.h = chosen.level.h;
      record.key.horizon = chosen.level.horizon;
      return record;
    }

    void enter(const scene::Scene &scene, const problem::Problem<2> &problem,
               const analysis::Solution &solution, const study::Targets &targets,
               study::Record &record)
    {
      record.cost = solution.cost;
      record.set("variation", study::variation(problem.n_components, solution.averages));
      record.set("round-off", study::round_off_error(problem, solution));
      record.set("area", study::area_of(problem), "length^2");
      study::set_diagnostics(record, solution.diagnostics);
      for (const auto &[error, value] :
           study::errors(scene.study.norms, problem, solution, targets))
        record.set(error, value);
    }

    /// Whether a record of the same is among those that are known; then it is taken.
    bool take_known(const study::Records &known, study::Record &record)
    {
      const auto found = std::find_if(known.begin(), known.end(),
                                      [&](const study::Record &one)
                                      {
                                        return one.key.method == record.key.method &&
                                               one.key.problem == record.key.problem &&
                                               one.key.h == record.key.h &&
                                               one.key.horizon == record.key.horizon;
                                      });
      if (found != known.end())
        record = *found;
      return found != known.end();
    }

    CaseCheck check_case(const scene::Scene &scene, const scene::Case &one, const std::string &name,
                         const ChosenLevel &chosen, const FamilySource<2> &families,
                         const method::Methods &references, const study::Records &known)
    {
      const problem::Problem<2> &problem = one.problem;
      const WeightsOfAFile given(families);
      const auto method = reference_method(scene, problem, references);
      CaseCheck result{record_of(given, name, chosen), record_of(*method, name, chosen)};
      if (take_known(known, result.weights) && take_known(known, result.reference))
        return result;
      const analysis::Solution reference =
          reference_solution(problem, *method, name + ", " + chosen.text());
      enter(scene, problem, reference, {}, result.reference);
      try
      {
        enter(scene, problem, analysis::solve(given, problem), {reference.averages, {}},
              result.weights);
      }
      catch (const NumericalError &error)
      {
        result.weights.failure = error.what();
      }
      return result;
    }

    GivenBody body_of(const scene::Scene &scene, const Input &input)
    {
      GivenBody body;
      body.boundary = to_boundary(input.boundary, "--boundary");
      for (const std::string &text : input.cracks)
        try
        {
          auto cracks = scene::to_lines(text, scene::lines());
          if (cracks.empty())
            throw InputError("'" + text +
                             "' has no points; give 'x0, y0 : x1, y1', or leave it "
                             "out");
          for (geometry::Polyline &crack : cracks)
          {
            geometry::move_to(scene.domain.origin, crack);
            body.cracks.push_back(std::move(crack));
          }
        }
        catch (const InputError &error)
        {
          throw InputError("--crack: " + std::string(error.what()));
        }
      return body;
    }

    /// Of a body with a free boundary: its boxes, as large as they are, or the cells of its mesh.
    std::vector<geometry::Polygon> parts_of(const scene::Scene &scene, const geometry::Mesh &mesh)
    {
      if (scene.domain.mesh.is_of_boxes() && scene.domain.mesh.map.empty())
        return geometry::convex_parts(scene.domain.boxes);
      std::vector<geometry::Polygon> parts;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        parts.push_back(mesh.polygon(c));
      return parts;
    }
  } // namespace

  template <int dim>
  std::vector<std::string> notes_of(const Findings<dim> &found, const std::string &assumed,
                                    const Input &input)
  {
    std::vector<std::string> result;
    if (!assumed.empty())
      result.push_back(assumed);
    for (const auto &[file, notes] : {std::pair{input.nodes_file, found.nodes.notes},
                                      std::pair{input.bonds_file, found.given.notes}})
      for (const std::string &note : notes)
        result.push_back("'" + file + "': " + note);
    return result;
  }

  template std::vector<std::string> notes_of(const Findings<2> &, const std::string &,
                                             const Input &);
  template std::vector<std::string> notes_of(const Findings<3> &, const std::string &,
                                             const Input &);

  std::string assumptions(const scene::Scene &scene, const Input &input,
                          const problem::Level &level)
  {
    const scene::Regime regime = scene.study.regime;
    const bool is_fixed = regime == scene::Regime::m || regime == scene::Regime::horizon;
    const std::string key = is_fixed ? "Study/horizon" : "Study/m";
    std::error_code error; // a pipe cannot be read again
    if (!std::filesystem::is_regular_file(input.scene_file, error) ||
        !scene::value_of_key(input.scene_file, input.overrides, key).empty())
      return input.assumption;
    return (input.assumption.empty() ? "" : input.assumption + "; ") + key + " is not given: " +
           (is_fixed ? "the horizon " + base::to_text(level.horizon, 6)
                     : "m = horizon / h = " + base::to_text(level.horizon / level.h, 6)) +
           " is assumed";
  }

  Findings<2> find(scene::Scene scene, const Input &input, const method::Methods &references,
                   const study::Records &known)
  {
    check_analysis(scene, scene::Analysis::check);
    GivenBody body = body_of(scene, input);
    scene.domain.is_free_body = body.is_free();
    Findings<2> found;
    found.scene_name = scene.name;
    found.purpose = scene.purpose;
    GivenWeights<2> weights;
    weights.nodes = read_given_nodes<2>(input.nodes_file);
    weights.nodes.origin = scene.domain.origin;
    geometry::move_to(weights.nodes.origin, weights.nodes.places);
    const bool boundary_is_data =
        scene.methods.nodes.are_vertices() && body.boundary == scene::Boundary::constrained;
    if (body.is_periodic() && !(scene.domain.mesh.is_of_boxes() && scene.domain.mesh.map.empty()))
      throw InputError("Domain/mesh = " + scene.domain.mesh.name +
                       ": --boundary periodic needs one box; write lattice, and give "
                       "Domain/boxes");
    take_into_box(body, scene.domain.boxes, weights.nodes);
    if (scene.domain.mesh.is_lattice())
      scene.domain.mesh.name = "squares";
    scene.methods.nodes = {std::filesystem::absolute(input.nodes_file).string()};
    scene.study.norms = {scene::Norm::nodal_linf, scene::Norm::averages_l2};
    found.level = choose_level(
        scene, node_spacing(weights.nodes,
                            scene::make_mesh(scene, scene.study.series.front().levels.front())));
    const problem::Level &level = found.level.level;
    const geometry::Mesh mesh =
        scene::make_mesh(scene, {level.h, body.is_periodic() ? body.collar(level) : level.horizon});
    if (body.is_free())
      body.parts = parts_of(scene, mesh);
    add_images(mesh, level, weights.nodes);
    check_places(weights.nodes, mesh,
                 found.level.text() + (found.level.is_near()
                                           ? ""
                                           : ", while the nodes' spacing is " +
                                                 base::to_text(found.level.node_size, 6)));
    GivenCells<2> cells = given_cells(weights.nodes, mesh, boundary_is_data);
    weights.cells = std::make_shared<const geometry::NodeCells<2>>(std::move(cells.cells));
    found.n_on_boundary = boundary_is_data || body.is_free() ? 0 : cells.n_on_boundary;
    const auto case_of = [&, of_nodes = weights.cells](unsigned int c)
    {
      scene::Case one = scene::make_case(scene, c, found.level.level);
      one.problem.on_mesh()->cells = of_nodes;
      return one;
    };
    // without a constraint all around, or with cracks, solutions are other ones
    const bool has_no_solutions = body.is_cut() || body.is_periodic();
    problem::Problem<2> problem =
        has_no_solutions
            ? problem_on(mesh, weights.cells, scene::make_kernel(scene, found.level.level.horizon),
                         found.level.level.h)
            : case_of(0).problem;
    weights.given = read_given_families(input.bonds_file, weights.nodes, *weights.cells);
    find_defects(body, "--crack", to_bond_values(input.bonds_are, "--bonds-are"),
                 std::move(weights), cells.uncut_areas, std::move(problem), scene.methods.names,
                 found);
    found.notes = notes_of(found, assumptions(scene, input, found.level.level), input);
    if (has_no_solutions)
      return found;
    const FamilySource<2> source = [&](std::size_t i, Family<2> &family)
    { family = found.given.families[i]; };
    const auto names = scene.problem.case_names();
    for (unsigned int c = 0; c < names.size(); ++c)
      found.cases.push_back(
          check_case(scene, case_of(c), names[c], found.level, source, references, known));
    return found;
  }
} // namespace plumbline::check
