#include "study/resized.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace plumbline::study
{
  namespace
  {
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
        Resized result{one.at_h(h)};
        if (result.problem.mesh())
        {
          const double ratio = mean_size(*result.problem.mesh()) / mean_size(*problem.mesh());
          if (std::abs(std::log(ratio * problem.h / h)) > std::log(like))
            return {};
          result.problem.on_mesh()->cells = problem.cells();
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
        result.problem.on_mesh()->mesh =
            std::make_shared<const geometry::Mesh>(geometry::refine(*result.problem.mesh()));
        result.problem.h /= 2;
      }
      return result;
    }

    /// Averages over the cells of a finer lattice, halving by halving over those of the problem.
    std::vector<double> coarsened(std::vector<double> averages, const problem::Problem<2> &problem,
                                  double h)
    {
      const unsigned int n = problem.n_components;
      const auto centres = [&](double size)
      {
        return free_nodes(
            problem.lattice()->refined(static_cast<int>(std::lround(problem.h / size))),
            {{.5, false, 0}}, n);
      };
      const auto is_last = [&] { return 2 * h > .75 * problem.h; };
      for (; !is_last(); h *= 2)
        averages = coarsen_averages(averages, centres(h), centres(2 * h));
      return coarsen_averages(averages, centres(h), method::comparison_nodes(problem, n));
    }
  } // namespace

  unsigned int geometry_order(const problem::Problem<2> &problem)
  {
    return problem.on_mesh() != nullptr ? problem.on_mesh()->boundary_order : 0;
  }

  Resized finer(const scene::Case &one, unsigned int n)
  {
    const problem::Problem<2> &problem = one.problem;
    if (problem.lattice())
      return {one.at_h(problem.h / n)};
    // beyond the free boundary of a body no field has values: its polygon stays as it is
    if (geometry_order(problem) > 0 && !problem.body())
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
    if (result && problem.body() &&
        std::abs(area(*result->problem.mesh()) / area(*problem.mesh()) - 1) > same)
      return {};
    return result;
  }

  ResizedSolution solve_resized(const Resized &resized, const problem::Problem<2> &problem,
                                const Method &method)
  {
    Solution solution = analysis::solve(method, resized.problem);
    if (problem.lattice())
      solution.averages =
          resized.problem.h < problem.h
              ? coarsened(std::move(solution.averages), problem, resized.problem.h)
              : cell_averages(problem::Field<2>{solution.value, std::nullopt}, problem);
    return {std::move(solution.averages), std::move(solution.value)};
  }
} // namespace plumbline::study
