#include "study/resized.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace plumbline::study
{
  namespace
  {
    /// The scene with the simplest nodes: those of the first problem are what counts.
    scene::Scene centred(const scene::Scene &scene)
    {
      scene::Scene result = scene;
      result.methods.nodes.name = "centres";
      result.methods.nodes.perturbation = 0;
      result.geometry.n_checks = 0;
      return result;
    }

    double area(const geometry::Mesh &mesh)
    {
      double sum = 0;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        if (mesh.cells[c].is_inside)
          sum += geometry::area(geometry::view(mesh.polygon(c)));
      return sum;
    }

    /// √ of the mean area of the cells of Ω.
    double mean_size(const geometry::Mesh &mesh)
    {
      if (!mesh.wholes.empty())
        return mean_size(geometry::straightened(mesh));
      const auto n = std::count_if(mesh.cells.begin(), mesh.cells.end(),
                                   [](const geometry::MeshCell &cell) { return cell.is_inside; });
      return std::sqrt(area(mesh) / static_cast<double>(std::max<std::ptrdiff_t>(1, n)));
    }

    /// The scene's own problem at another h, compared on the cells of the first one; nothing where
    /// it has none, or its mesh takes no notice of h.
    std::optional<Resized> made_anew(const scene::Case &one, double h)
    {
      const problem::Problem<2> &problem = one.problem;
      // meshes of one description at two sizes are alike to that
      constexpr double like = 1.5;
      try
      {
        Resized result{scene::make_problem(centred(one.scene), one.index, {h, problem.horizon()})};
        if (result.problem.mesh)
        {
          const double ratio = mean_size(*result.problem.mesh) / mean_size(*problem.mesh);
          if (std::abs(std::log(ratio * problem.h / h)) > std::log(like))
            return {};
          result.problem.cells = problem.cells;
        }
        return result;
      }
      catch (const InputError &)
      {
        return {}; // h does not divide the boxes, or no nodes can be put there
      }
    }

    Resized cut(const problem::Problem<2> &problem, unsigned int n)
    {
      Resized result{problem, true};
      result.problem.settings.geometry.n_checks = 0;
      for (; n > 1; n /= 2)
      {
        result.problem.mesh =
            std::make_shared<const geometry::Mesh>(geometry::refine(*result.problem.mesh));
        result.problem.h /= 2;
      }
      return result;
    }

    geometry::NodeSet centres(const scene::Scene &scene, double h, unsigned int n_components)
    {
      return free_nodes(geometry::Lattice(scene.domain.boxes, h), {{.5, false, 0}}, n_components);
    }

    /// Averages over the cells of a finer lattice, halving by halving over those of the problem.
    std::vector<double> coarsened(std::vector<double> averages, const scene::Case &one, double h)
    {
      const scene::Scene &scene = one.scene;
      const problem::Problem<2> &problem = one.problem;
      const unsigned int n = problem.n_components;
      const auto is_last = [&] { return 2 * h > .75 * problem.h; };
      for (; !is_last(); h *= 2)
        averages = coarsen_averages(averages, centres(scene, h, n), centres(scene, 2 * h, n));
      return coarsen_averages(averages, centres(scene, h, n), method::comparison_nodes(problem, n));
    }
  } // namespace

  unsigned int geometry_order(const scene::Scene &scene)
  {
    if (scene.domain.mesh.is_of_boxes())
      return scene.domain.mesh.map.empty() ? 0 : 2;
    if (scene.domain.mesh.is_curved)
      return 4;
    return scene.domain.mesh.inside.empty() ? 2 : 1;
  }

  Resized finer(const scene::Case &one, unsigned int n)
  {
    const problem::Problem<2> &problem = one.problem;
    if (problem.lattice)
      return {
          scene::make_problem(centred(one.scene), one.index, {problem.h / n, problem.horizon()})};
    // beyond the free boundary of a body no field has values: its polygon stays as it is
    if (geometry_order(one.scene) > 0 && !problem.body)
      if (auto result = made_anew(one, problem.h / n))
        return std::move(*result);
    return cut(problem, n);
  }

  std::optional<Resized> coarser(const scene::Case &one, unsigned int n)
  {
    // parts of a body are fixed by the centroids of cells: larger cells may fix another part
    constexpr double same = 1e-9;
    const problem::Problem<2> &problem = one.problem;
    auto result = made_anew(one, problem.h * n);
    if (result && problem.body &&
        std::abs(area(*result->problem.mesh) / area(*problem.mesh) - 1) > same)
      return {};
    return result;
  }

  ResizedSolution solve_resized(const Resized &resized, const scene::Case &one,
                                const Method &method)
  {
    const problem::Problem<2> &problem = one.problem;
    Solution solution = analysis::solve(method, resized.problem);
    if (problem.lattice)
      solution.averages = resized.problem.h < problem.h
                              ? coarsened(std::move(solution.averages), one, resized.problem.h)
                              : cell_averages(problem::Field<2>{solution.value, std::nullopt}, problem);
    return {std::move(solution.averages), std::move(solution.value)};
  }
} // namespace plumbline::study
