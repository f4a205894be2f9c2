#include "scene/problem.h"

#include "base/cost.h"
#include "base/error.h"
#include "physics/double_well_load.h"
#include "physics/load.h"
#include "scene/mesh.h"
#include "scene/models/model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace plumbline::scene
{
  namespace
  {
    using dealii::Point;
    using physics::ChebyshevField;
    using physics::Expression;

    /// Where Ω is: its bounding box, whether it fills it, and some points of it.
    struct Extent
    {
      geometry::Box box;
      bool is_rectangle;
      std::vector<Point<2>> samples;
    };

    Extent extent(const geometry::Lattice &lattice)
    {
      constexpr int n_samples = 8;
      const auto &n = lattice.n_cells();
      Extent result{{lattice.origin(), lattice.point(n[0], n[1])}, lattice.is_rectangle(), {}};
      for (int j = 0; j <= n_samples; ++j)
        for (int i = 0; i <= n_samples; ++i)
        {
          const int k = i * (n[0] - 1) / n_samples, l = j * (n[1] - 1) / n_samples;
          if (lattice.is_inside(k, l))
            result.samples.push_back(lattice.point(k + .5, l + .5));
        }
      return result;
    }

    Extent extent(const geometry::Mesh &mesh)
    {
      constexpr std::size_t n_samples = 80;
      Extent result{geometry::bounding_box(mesh), false, {}};
      const std::size_t step = std::max<std::size_t>(1, mesh.cells.size() / n_samples);
      for (std::size_t i = 0; i < mesh.cells.size(); i += step)
        if (mesh.cells[i].is_inside)
          result.samples.push_back(geometry::centroid(geometry::view(mesh.polygon(i))));
      return result;
    }

    /// The series of a field that is smooth on a box.
    /// @param is_filled  by the domain: elsewhere, in a hole, the field may have no value
    std::optional<ChebyshevField> series_of(const ChebyshevField::Function &value,
                                            unsigned int n_components, const geometry::Box &box,
                                            double noise, bool is_filled)
    try
    {
      return ChebyshevField::resolve(value, n_components, box.lower, box.upper, noise);
    }
    catch (const std::runtime_error &)
    {
      if (is_filled)
        throw;
      return {};
    }

    /// A field, with its series on the bounding box of Ω.
    Field with_series(ChebyshevField::Function value, unsigned int n_components,
                      const Extent &extent, double noise)
    {
      Field field{std::move(value), std::nullopt};
      field.series = series_of(field.value, n_components, extent.box, noise, extent.is_rectangle);
      return field;
    }

    /// Whether a field has a series to 14 digits. Where it has none, its load, which is as rough,
    /// would be looked at in vain at 129² points, each of them a ball of quadrature points.
    bool is_resolved(const ChebyshevField::Function &value, unsigned int n_components,
                     const Extent &extent, double size)
    {
      constexpr double digits = 1e-14;
      return series_of(value, n_components, extent.box, digits * size, extent.is_rectangle)
          .has_value();
    }

    /// The largest value of a field over the samples: for noise levels.
    double magnitude(const Field &field, unsigned int n_components, const Extent &extent)
    {
      double largest = 0;
      for (const Point<2> &x : extent.samples)
        for (unsigned int c = 0; c < n_components; ++c)
          largest = std::max(largest, std::abs(field.value(x, c)));
      return largest;
    }

    /// Round-off of an operator of this kernel on a field.
    double noise_of(const physics::Kernel<2> &kernel, const Field &field, unsigned int n_components,
                    const Extent &extent)
    {
      return 2 * std::numeric_limits<double>::epsilon() * physics::operator_scale(kernel) *
             magnitude(field, n_components, extent);
    }

    /// θ of a field, as a series where it is smooth: a load asks for it all over the ball.
    std::function<double(const Point<2> &)> dilatation_of(const Expression &u,
                                                          const physics::Dilatation &dilatation,
                                                          double noise, const Extent &extent)
    {
      const physics::FieldDilatation theta(dilatation.influence, u);
      const double horizon = dilatation.influence.horizon();
      const Point<2> margin(horizon, horizon);
      const geometry::Box reached{Point<2>(extent.box.lower - margin), extent.box.upper + margin};
      const auto value = [&](const Point<2> &x, unsigned int) { return theta(x); };
      if (const auto series = series_of(value, 1, reached, noise, extent.is_rectangle))
        return [series = *series](const Point<2> &x) { return series(x, 0); };
      return theta;
    }

    /// -F(u) of double wells. All components come at once: they are kept for who asks for the
    /// others at the same points.
    template <int dim>
    struct WellLoad
    {
      physics::WellForce<dim> force;
      Expression u;
      mutable std::map<std::pair<double, double>, dealii::Tensor<1, dim>> known;

      double operator()(const Point<2> &x, unsigned int component) const
      {
        const auto [entry, is_new] = known.try_emplace({x[0], x[1]});
        if (is_new)
        {
          Point<dim> at;
          for (unsigned int axis = 0; axis < dim; ++axis)
            at[axis] = x[axis];
          entry->second = -force(
              [&](const Point<dim> &y)
              {
                const Point<2> place(y[0], dim == 1 ? x[1] : y[dim - 1]);
                dealii::Tensor<1, dim> value;
                for (unsigned int c = 0; c < dim; ++c)
                  value[c] = u(place, c);
                return value;
              },
              at);
        }
        return entry->second[component];
      }
    };

    /// The static load of a solution.
    ChebyshevField::Function manufactured_load(const Problem &problem, const Expression &u,
                                               const Extent &extent)
    {
      if (problem.double_well && problem.dimension == 1)
        return WellLoad<1>{physics::WellForce<1>(*problem.double_well), u, {}};
      if (problem.double_well)
        return WellLoad<2>{physics::WellForce<2>(*problem.double_well), u, {}};
      const physics::ManufacturedLoad bonds(problem.kernel, u, problem.coefficient);
      if (!problem.dilatation)
        return bonds;
      const physics::Kernel<2> &influence = problem.dilatation->influence;
      const double noise = influence.horizon() *
                           noise_of(influence, *problem.solution, problem.n_components, extent);
      return
          [bonds, force = physics::DilatationForce(
                      *problem.dilatation, dilatation_of(u, *problem.dilatation, noise, extent))](
              const Point<2> &x, unsigned int c) { return bonds(x, c) + force(x, c); };
    }

    MethodSettings method_settings(const Scene &scene)
    {
      return {scene.methods.nodes.are_vertices(),
              scene.methods.loads_are_averages,
              scene.study.regime == Regime::delta,
              scene.quadrature,
              scene.geometry,
              scene.solver};
    }

    /// What does not follow from cells or fields.
    Problem without_data(const Scene &scene, const Level &level, const physics::Kernel<2> &kernel)
    {
      const std::string &mesh = scene.domain.mesh.name;
      Problem problem{{}, {}, {}, {}, mesh, level.h, kernel, {}, {}, kernel.n_components(),
                      {}, {}, {}, {}};
      problem.dimension = scene.domain.dimension;
      problem.is_load_given = !scene.problem.loads.empty();
      problem.is_homogeneous = scene.is_homogeneous();
      problem.is_periodic = scene.domain.is_periodic;
      problem.is_floating = scene.domain.is_floating;
      problem.has_collar_dilatation = scene.material.has_collar_dilatation;
      problem.damage = {scene.domain.cracks, scene.domain.outside};
      scene.material.model->complete(scene, level, problem);
      problem.settings = method_settings(scene);
      return problem;
    }

    /// On its lattice, or on a mesh with the cells of its nodes.
    void put_in_place(const Scene &scene, const Level &level, Problem &problem)
    {
      base::CpuTimer timer;
      if (scene.domain.is_free_body)
      {
        const geometry::VertexCells body = make_body(scene, level);
        problem.body = body.lattice;
        problem.cells = body.cells;
        problem.mesh = body.mesh;
        problem.mesh_seconds = timer.seconds();
      }
      else if (scene.domain.mesh.is_lattice())
        problem.lattice = scene.domain.lattice(level.h);
      else
      {
        problem.mesh = std::make_shared<const geometry::Mesh>(make_mesh(scene, level));
        problem.mesh_seconds = timer.seconds();
        timer.restart();
        problem.cells = std::make_shared<const geometry::NodeCells>(
            make_node_cells(scene, level, *problem.mesh));
        problem.cells_seconds = timer.seconds();
      }
    }
  } // namespace

  Problem make_problem(const Scene &scene, unsigned int case_index, const Level &level, double t,
                       const Field *known_load, const Problem *same_place)
  {
    const physics::Kernel<2> kernel = make_kernel(scene, level.horizon);
    const unsigned int n_components = kernel.n_components();
    Problem problem = without_data(scene, level, kernel);
    if (same_place != nullptr)
    {
      problem.lattice = same_place->lattice;
      problem.mesh = same_place->mesh;
      problem.cells = same_place->cells;
      problem.body = same_place->body;
      problem.mesh_seconds = same_place->mesh_seconds;
      problem.cells_seconds = same_place->cells_seconds;
    }
    else
      put_in_place(scene, level, problem);
    if (problem.mesh)
      problem.coefficient = make_coefficient(scene, *problem.mesh);
    const Extent omega = problem.lattice ? extent(*problem.lattice) : extent(*problem.mesh);
    const auto expression = [&](const std::string &key, const std::string &text)
    { return Expression(key, text, scene.names(level.horizon, t)); };
    const auto field = [&](const std::string &key, const std::string &text)
    { return with_series(expression(key, text), n_components, omega, 0); };

    if (!scene.problem.solutions.empty())
      problem.solution = field("Problem/solution", scene.problem.solutions[case_index].expression);
    const Field nothing{[](const Point<2> &, unsigned int) { return 0.; },
                        series_of([](const Point<2> &, unsigned int) { return 0.; }, n_components,
                                  omega.box, 0, true)};
    if (scene.problem.constraint)
      problem.constraint = field("Problem/constraint", *scene.problem.constraint);
    else
      problem.constraint = problem.solution ? *problem.solution : nothing;
    if (scene.problem.local_solution == LocalSolution::expression)
      problem.local_solution = field("Problem/local solution", scene.problem.local_expression);

    if (known_load != nullptr)
      problem.load = *known_load;
    else if (problem.is_load_given)
      problem.load = field("Problem/load", scene.problem.loads[case_index].expression);
    else if (!problem.solution)
      problem.load = nothing;
    else
    {
      const Expression u =
          expression("Problem/solution", scene.problem.solutions[case_index].expression);
      const double noise = noise_of(kernel, *problem.solution, n_components, omega);
      problem.load = {manufactured_load(problem, u, omega), std::nullopt};
      if (is_resolved(problem.solution->value, n_components, omega,
                      magnitude(*problem.solution, n_components, omega)))
        problem.load = with_series(std::move(problem.load.value), n_components, omega, noise);
    }
    return problem;
  }

  Case make_case(const Scene &scene, unsigned int case_index, const Level &level)
  {
    return {scene, case_index, make_problem(scene, case_index, level)};
  }

  std::function<double(const Point<2> &, unsigned int)> operator_on_solution(const Case &one)
  {
    const Problem &problem = one.problem;
    const Expression u("Problem/solution", one.scene.problem.solutions[one.index].expression,
                       one.scene.names(problem.horizon(), 0));
    return manufactured_load(problem, u,
                             problem.lattice ? extent(*problem.lattice) : extent(*problem.mesh));
  }
} // namespace plumbline::scene
