#include "scene/problem.h"

#include "base/cost.h"
#include "base/error.h"
#include "geometry/tetrahedral_domain.h"
#include "problem/builder.h"
#include "scene/damage.h"
#include "scene/mesh.h"
#include "scene/mesh_in_space.h"
#include "scene/models/model.h"
#include "scene/nodes_in_space.h"
#include "scene/on_line.h"

#include <utility>

namespace plumbline::scene
{
  namespace
  {
    using physics::Expression;

    problem::MethodSettings method_settings(const Scene &scene)
    {
      // the local limit has the second moments alone; the nonlocal operator has all
      constexpr unsigned int of_local_limit = 2, of_nonlocal = 6;
      const Regime regime = scene.study.regime;
      const unsigned int ball_order = regime == Regime::m         ? of_nonlocal
                                      : regime == Regime::delta_m ? of_local_limit
                                                                  : 0;
      return {scene.methods.nodes.are_vertices(),
              scene.methods.loads_are_averages,
              regime == Regime::delta,
              ball_order,
              scene.quadrature,
              scene.geometry,
              scene.solver};
    }

    /// How fast cells tend to the domain that they stand for, see problem::MeshDomain.
    unsigned int boundary_order(const MeshSource &mesh)
    {
      if (mesh.is_of_boxes())
        return mesh.map.empty() ? 0 : 2;
      if (mesh.is_curved)
        return 4;
      return mesh.inside.empty() ? 2 : 1;
    }

    problem::Domain make_domain(const Scene &scene, const Level &level)
    {
      const DomainSection &domain = scene.domain;
      if (domain.mesh.is_lattice() && !domain.is_free_body)
        return problem::LatticeDomain{domain.lattice(level.h), domain.is_periodic,
                                      domain.dimension};
      base::CpuTimer timer;
      problem::BodyDomain result;
      result.name = domain.mesh.name;
      result.boundary_order = boundary_order(domain.mesh);
      if (domain.is_free_body)
      {
        const geometry::VertexCells body = make_body(scene, level);
        result.lattice = body.lattice;
        result.cells = body.cells;
        result.mesh = body.mesh;
        result.is_floating = domain.is_floating;
        result.mesh_seconds = timer.seconds();
        return result;
      }
      result.reach = scene.reach(level.horizon);
      result.mesh = std::make_shared<const geometry::Mesh>(make_mesh(scene, level));
      result.mesh_seconds = timer.seconds();
      timer.restart();
      result.cells = std::make_shared<const geometry::NodeCells<2>>(
          make_node_cells(scene, level, *result.mesh));
      result.cells_seconds = timer.seconds();
      return static_cast<const problem::MeshDomain &>(result);
    }

    std::vector<problem::SpatialValue<2>> spatial_values(const Scene &scene, const Problem &problem)
    {
      std::vector<problem::SpatialValue<2>> values = material_values(scene);
      const bool is_by_surfaces = !scene.kernel.materials.empty();
      if (problem.coefficient && (is_by_surfaces || !scene.kernel.coefficient.empty()))
        values.push_back({is_by_surfaces ? "Kernel/materials" : "Kernel/coefficient",
                          [a = *problem.coefficient](const dealii::Point<2> &x)
                          { return a.at(x); }});
      return values;
    }

    /// The scene with the simplest nodes.
    Scene centred(Scene scene)
    {
      scene.methods.nodes.name = "centres";
      scene.methods.nodes.perturbation = 0;
      scene.geometry.n_checks = 0;
      return scene;
    }

    /// Whether Solver/model = full would build anything besides what this scene's solves build, and
    /// can: not with a given collar or operator, which a full model has no use for.
    bool has_fuller_model(const Scene &scene)
    {
      const bool drops_dilatation =
          scene.material.model->is_state_based() && !scene.has_dilatation();
      return !scene.solver.is_full_model && !scene.domain.collar &&
             scene.solver.operator_backend == base::OperatorBackend::automatic &&
             (scene.domain.is_free_body ? drops_dilatation : scene.domain.mesh.is_lattice());
    }
  } // namespace

  Problem make_problem(const Scene &scene, unsigned int case_index, const Level &level, double t,
                       const Field *known_load, const Problem *same_place)
  {
    if (is_on_intervals(scene))
      throw InputError(
          "Domain/dimension = 1 with Material/model = " + scene.material.model->name() +
          " is supported by 'plumbline run' and 'certify' only; write Domain/dimension = 2");
    const auto field = [&](const std::string &key, const std::string &text)
    {
      const Expression expression(key, text, scene.names(level.horizon, t));
      Field result;
      result.value = expression;
      result.is_piecewise = expression.is_piecewise();
      return result;
    };
    problem::ProblemBuilder given(same_place != nullptr ? same_place->domain
                                                        : make_domain(scene, level),
                                  make_kernel(scene, level.horizon), level.h);
    given.is_homogeneous = scene.is_homogeneous();
    given.has_collar_dilatation = scene.material.has_collar_dilatation;
    given.damage = make_damage(scene, level.horizon);
    scene.material.model->complete(scene, level, given);
    given.settings = method_settings(scene);
    given.origin = scene.domain.origin;
    if (given.mesh())
      given.coefficient = make_coefficient(scene, *given.mesh());
    given.spatial_values = spatial_values(scene, given);

    const ProblemSection &section = scene.problem;
    if (!section.solutions.empty())
      given.solution = field("Problem/solution", section.solutions[case_index].expression);
    if (section.constraint)
      given.constraint = field("Problem/constraint", *section.constraint);
    if (section.local_solution == LocalSolution::expression)
      given.local_solution = field("Problem/local solution", section.local_expression);
    given.is_load_given = !section.loads.empty();
    if (known_load != nullptr)
      given.load = *known_load;
    else if (given.is_load_given)
      given.load = field("Problem/load", section.loads[case_index].expression);
    return given.build();
  }

  problem::Problem<3> make_problem_in_space(const Scene &scene, unsigned int case_index,
                                            const Level &level, double t,
                                            const problem::Field<3> *known_load,
                                            const CellsInSpace &same_cells)
  {
    const auto field = [&](const std::string &key, const std::string &text)
    {
      const Expression expression(key, text, scene.names(level.horizon, t));
      problem::Field<3> result{[expression](const dealii::Point<3> &x, unsigned int component)
                               { return expression.at(x, component); }};
      result.is_piecewise = expression.is_piecewise();
      return result;
    };
    const auto mesh = scene.domain.mesh.is_file() ? make_mesh_in_space(scene, level) : nullptr;
    problem::Problem<3> given{mesh ? geometry::cubes_within(*mesh, level.h)
                                   : scene.domain.cubes(level.h),
                              make_kernel_in_space(scene, level.horizon)};
    given.mesh = mesh;
    if (mesh)
      given.factors = make_factors(scene, *mesh);
    given.is_free = mesh && scene.domain.is_free_body;
    given.dilatation = scene.material.model->dilatation_in_space(scene, level.horizon);
    given.settings = method_settings(scene);
    given.cells = same_cells;
    if (!given.cells && !scene.methods.nodes.are_lattice_centres())
      given.cells = std::make_shared<const geometry::NodeCells<3>>(
          mesh ? geometry::centroid_nodes(*mesh)
               : make_cells_in_space(scene, level, given.lattice));
    if (const double perturbation = scene.methods.nodes.perturbation; perturbation > 0)
      given.make_tetrahedra = [lattice = given.lattice, level, reach = given.reach(), perturbation,
                               seed = scene.geometry.seed]
      {
        const int n_layers = geometry::layers_within(reach, level.h);
        return geometry::with_moved_vertices(geometry::six_per_cube(lattice, n_layers),
                                             perturbation * level.h, seed);
      };
    const ProblemSection &section = scene.problem;
    if (!section.solutions.empty())
      given.solution = field("Problem/solution", section.solutions[case_index].expression);
    if (known_load != nullptr)
      given.load = *known_load;
    else if (!section.loads.empty())
      given.load = field("Problem/load", section.loads[case_index].expression);
    if (section.constraint)
      given.constraint = field("Problem/constraint", *section.constraint);
    if (section.local_solution == LocalSolution::expression)
      given.local_solution = field("Problem/local solution", section.local_expression);
    problem::Problem<3> result = problem::complete(std::move(given));
    result.is_load_given = !section.loads.empty();
    return result;
  }

  problem::Problem<1> make_problem_on_line(const Scene &scene, unsigned int case_index,
                                           const Level &level)
  {
    const auto field = [&](const std::string &key, const std::string &text)
    {
      const Expression expression(key, text, scene.names(level.horizon));
      return problem::Field<1>{[expression](const dealii::Point<1> &x, unsigned int component)
                               { return expression(dealii::Point<2>(x[0], 0), component); }};
    };
    std::vector<geometry::Interval> pieces;
    for (const geometry::Box &box : scene.domain.boxes.include)
      pieces.push_back({box.lower[0], box.upper[0]});
    problem::Problem<1> given{geometry::IntervalLattice(std::move(pieces), level.h),
                              make_kernel_on_line(scene, level.horizon)};
    given.settings = method_settings(scene);
    const ProblemSection &section = scene.problem;
    if (!section.solutions.empty())
      given.solution = field("Problem/solution", section.solutions[case_index].expression);
    if (!section.loads.empty())
      given.load = field("Problem/load", section.loads[case_index].expression);
    if (section.constraint)
      given.constraint = field("Problem/constraint", *section.constraint);
    if (section.local_solution == LocalSolution::expression)
      given.local_solution = field("Problem/local solution", section.local_expression);
    return problem::complete(std::move(given));
  }

  Case make_case(const Scene &scene, unsigned int case_index, const Level &level)
  {
    return make_case(scene, case_index, make_problem(scene, case_index, level));
  }

  Case make_case(const Scene &scene, unsigned int case_index, Problem problem)
  {
    const auto poser = std::make_shared<const Scene>(scene);
    const Level level = problem.level();
    Case one{scene.problem.case_names()[case_index], std::move(problem)};
    one.at_h = [=](double h) {
      return make_problem(centred(*poser), case_index, {h, level.horizon});
    };
    if (has_fuller_model(scene))
      one.full_model = [=] { return make_problem(full_model(*poser), case_index, level); };
    return one;
  }

  std::vector<problem::SpatialValue<2>> material_values(const Scene &scene)
  {
    std::vector<problem::SpatialValue<2>> values;
    const MaterialSection &material = scene.material;
    if (!material.model->is_state_based())
      return values;
    for (unsigned int i = 0; i < 2; ++i)
    {
      const std::string key = "Material/" + material.keys[i];
      const Expression expression(key, material.expressions[i], material.names);
      if (!expression.is_constant())
        values.push_back({key, [expression](const dealii::Point<2> &x) { return expression(x); }});
    }
    return values;
  }
} // namespace plumbline::scene
