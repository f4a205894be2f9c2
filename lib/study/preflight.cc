#include "study/preflight.h"

#include "base/error.h"
#include "base/similar_words.h"
#include "geometry/tetrahedral_domain.h"
#include "method/another_operator.h"
#include "scene/capabilities.h"
#include "scene/damage.h"
#include "scene/mesh.h"
#include "scene/mesh_in_space.h"
#include "scene/models/model.h"
#include "scene/on_line.h"
#include "scene/origin.h"
#include "scene/values.h"
#include "study/method_names.h"
#include "study/refusal.h"
#include "study/statics_on_line.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

namespace plumbline::study
{
  std::shared_ptr<const Method> find_method(const Methods &available, const std::string &name,
                                            const std::string &key)
  {
    if (const auto found = method_called(available, name))
      return found;
    std::vector<std::string> names;
    for (const auto &method : available)
      names.push_back(method->name());
    throw InputError(key + ": method '" + name + "' is not known; choose one of " +
                     scene::join(names, ", ") + base::did_you_mean(name, names));
  }

  namespace
  {
    /// On lattices in space `all` leaves out methods on tetrahedra, which take far more memory than
    /// others.
    bool has_its_nodes(const scene::Scene &scene, const Method &method)
    {
      return !scene.domain.is_in_space() || scene.domain.mesh.is_file() ||
             method.can().count(method::Capability::lattice) > 0;
    }
  } // namespace

  Methods named_methods(const scene::Scene &scene, const Methods &available,
                        const std::function<bool(const Method &)> &is_meant)
  {
    Methods named;
    const auto add = [&](const std::shared_ptr<const Method> &method)
    {
      if (std::find(named.begin(), named.end(), method) == named.end())
        named.push_back(method);
    };
    for (const std::string &name : scene.methods.names)
      if (name != scene::all)
        add(find_method(available, name, "Methods/names"));
      else
        for (const auto &method : available)
          if (method->is_in_all() && has_its_nodes(scene, *method) && is_meant(*method))
            add(method);
    return named;
  }

  Methods choose_methods(const scene::Scene &scene, const Methods &available)
  {
    if (scene.strip.is_there())
      throw InputError("scene '" + scene.name +
                       "': Strip/length is for 'plumbline strip', whose crack stands; write that, "
                       "or 0");
    const problem::Level &level = scene.study.series.front().levels.front();
    const scene::Scene here = at_level(scene, level);
    std::optional<problem::Problem<2>> first;
    const bool is_on_line = is_on_intervals(here);
    if (is_on_line)
      (void)make_problem_on_line(here, 0, level);
    else if (!here.domain.is_in_space())
      first = make_problem(here, 0, level);
    const auto reason_against = [&](const Method &method)
    {
      return is_on_line ? refusal_on_line(method, here, available)
             : first    ? refusal(method, here, *first, available)
                        : refusal_in_space(method, here, available);
    };
    Methods chosen = named_methods(
        scene, available, [&](const Method &method) { return reason_against(method).empty(); });
    for (const auto &method : chosen)
      if (const std::string reason = reason_against(*method); !reason.empty())
        throw InputError("Methods/names: '" + method->name() + "' cannot do this scene: " + reason);
    if (scene.reference.method && !scene.time.is_dynamic()) // a motion's is no method
    {
      const auto reference = find_method(available, *scene.reference.method, "Reference/method");
      if (reference->family() != method::MethodFamily::reference)
        throw InputError("Reference/method: '" + *scene.reference.method +
                         "' is no Galerkin method, so nothing is known of its error; choose Q2, P2 "
                         "or another ('plumbline list methods')");
      if (const auto *other = method::of_another_operator(*reference))
        throw InputError("Reference/method: '" + *scene.reference.method + "' " +
                         other->what_it_does() +
                         "; choose Q2 or another Galerkin method ('plumbline list methods')");
      if (const std::string reason = reason_against(*reference); !reason.empty())
        throw InputError("Reference/method: '" + *scene.reference.method +
                         "' cannot do this scene: " + reason);
    }
    for (const scene::Expected &expected : scene.expected.all)
      (void)find_method(available, expected.method, "Expected");
    return chosen;
  }

  namespace
  {
    /// The constraint is finite around Ω and the load in it, on a grid of samples.
    void check_lattice_data(const problem::Problem<2> &problem)
    {
      constexpr int n_samples = 24;
      const geometry::Lattice &lattice = *problem.lattice();
      const auto &n = lattice.n_cells();
      const double margin = problem.horizon() / problem.h + 1;
      for (int j = 0; j <= n_samples; ++j)
        for (int i = 0; i <= n_samples; ++i)
        {
          const double s = -margin + i * (n[0] + 2 * margin) / n_samples;
          const double t = -margin + j * (n[1] + 2 * margin) / n_samples;
          const bool is_inside =
              lattice.is_inside(static_cast<int>(std::floor(s)), static_cast<int>(std::floor(t)));
          for (unsigned int component = 0; component < problem.n_components; ++component)
          {
            (void)problem.constraint.value(lattice.point(s, t), component);
            if (is_inside)
              (void)problem.load.value(lattice.point(s, t), component);
          }
        }
    }

    /// The same at nodes of a mesh problem.
    void check_node_data(const problem::Problem<2> &problem)
    {
      constexpr std::size_t n_samples = 600;
      const auto &cells = *problem.cells();
      const std::size_t step = std::max<std::size_t>(1, cells.size() / n_samples);
      for (std::size_t i = 0; i < cells.size(); i += step)
        for (unsigned int component = 0; component < problem.n_components; ++component)
        {
          const auto &field = i < cells.n_free ? problem.load : problem.constraint;
          (void)field.value(cells.nodes[i], component);
          if (problem.coefficient)
            (void)problem.coefficient->at(cells.nodes[i]);
        }
    }

    void check_data(const problem::Problem<2> &problem)
    {
      if (problem.lattice())
        check_lattice_data(problem);
      else
        check_node_data(problem);
    }

    [[noreturn]] void refuse_same_cells(const scene::Scene &scene, std::size_t n_cells)
    {
      throw InputError(
          "Domain/mesh = " + scene.domain.mesh.name + " has the " + std::to_string(n_cells) +
          " cells of the level before, so convergence rates would be meaningless; give "
          "a mesh that follows h (in a .geo by the line 'DefineConstant[ h = 0.1, delta = "
          "0.3 ];'), or a single value of Study/h");
    }

    /// Meshes and nodes of all levels can be used, and differ where h does.
    void check_meshes(const scene::Scene &whole)
    {
      for (const auto &series : whole.study.series)
      {
        std::size_t before = 0;
        for (std::size_t i = 0; i < series.levels.size(); ++i)
        {
          const problem::Level &level = series.levels[i];
          std::ostringstream where;
          where << "level h = " << level.h << ", horizon = " << level.horizon << ": ";
          try
          {
            const scene::Scene scene = at_level(whole, level);
            if (scene.domain.is_free_body)
            {
              (void)make_body(scene, level);
              continue;
            }
            const geometry::Mesh mesh = make_mesh(scene, level);
            check_damage(scene, level.horizon, make_node_cells(scene, level, mesh));
            const std::size_t n_cells = static_cast<std::size_t>(
                std::count_if(mesh.cells.begin(), mesh.cells.end(),
                              [](const geometry::MeshCell &cell) { return cell.is_inside; }));
            if (n_cells == before && level.h != series.levels[i - 1].h)
              refuse_same_cells(scene, n_cells);
            before = n_cells;
          }
          catch (const InputError &error)
          {
            throw InputError(scene::with_origin(where.str() + error.what(), whole.domain.origin));
          }
        }
      }
    }

    void check_meshes_in_space(const scene::Scene &scene)
    {
      for (const auto &series : scene.study.series)
      {
        std::ptrdiff_t before = 0;
        for (std::size_t i = 0; i < series.levels.size(); ++i)
        {
          const problem::Level &level = series.levels[i];
          try
          {
            const auto mesh = make_mesh_in_space(scene, level);
            (void)geometry::cubes_within(*mesh, level.h);
            const auto n_cells = std::count(mesh->is_inside.begin(), mesh->is_inside.end(), 1);
            if (n_cells == before && level.h != series.levels[i - 1].h)
              refuse_same_cells(scene, static_cast<std::size_t>(n_cells));
            before = n_cells;
          }
          catch (const InputError &error)
          {
            std::ostringstream where;
            where << "level h = " << level.h << ", horizon = " << level.horizon << ": "
                  << error.what();
            throw InputError(where.str());
          }
        }
      }
    }
  } // namespace

  void check_data(const scene::Scene &scene)
  {
    if (const scene::Model &model = *scene.material.model; !model.is_linear())
      throw InputError(
          "Time/final time = 0: Material/model = " + model.name() +
          " has no static analysis, because its force is nonlinear; give a time > 0, or write "
          "Material/model = bond-based");
    check_analysis(scene, scene::Analysis::statics);
    if (!scene.domain.mesh.is_lattice() || scene.domain.is_free_body)
      scene.domain.is_in_space() ? check_meshes_in_space(scene) : check_meshes(scene);
    std::map<std::pair<double, double>, scene::CellsInSpace> cells; // by h and horizon
    const auto check = [&](unsigned int c, const problem::Level &level)
    {
      if (scene.domain.is_in_space())
      {
        scene::CellsInSpace &known = cells[{level.h, level.horizon}];
        known = make_problem_in_space(scene, c, level, 0, nullptr, known).cells;
      }
      else if (is_on_intervals(scene))
        (void)make_problem_on_line(at_level(scene, level), c, level);
      else
        check_data(make_problem(at_level(scene, level), c, level));
    };
    const auto names = scene.problem.case_names();
    for (unsigned int c = 0; c < names.size(); ++c)
      for (const auto &series : scene.study.series)
      {
        const problem::Level &widest =
            *std::max_element(series.levels.begin(), series.levels.end(),
                              [](const problem::Level &a, const problem::Level &b)
                              { return a.horizon + a.h < b.horizon + b.h; });
        for (const problem::Level &level : series.levels)
          if (&level == &widest || scene.study.regime == scene::Regime::variable)
            check(c, level);
      }
  }
} // namespace plumbline::study
