#include "study/reference_estimate.h"

#include "base/error.h"
#include "study/comparison.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace plumbline::study
{
  namespace
  {
    /// A problem on the same comparison cells with the mesh of another level.
    scene::Problem with_mesh(const scene::Problem &problem,
                             std::shared_ptr<const geometry::Mesh> mesh)
    {
      scene::Problem result = problem;
      result.mesh = std::move(mesh);
      return result;
    }

    /// The same lattice scene at another h, with nodes in the centres.
    scene::Scene centred(const scene::Scene &scene)
    {
      scene::Scene result = scene;
      result.nodes.kind = "centres";
      result.n_geometry_checks = 0;
      return result;
    }

    /// Averages of the same method at h/2 over the cells of h.
    std::vector<double> halved(const scene::Scene &scene, const scene::Problem &problem,
                               unsigned int case_index, const Method &method)
    {
      if (problem.mesh)
        return method
            .solve(scene, with_mesh(problem, std::make_shared<const geometry::Mesh>(
                                                 geometry::refine(*problem.mesh))))
            .averages;
      const scene::Scene fine_scene = centred(scene);
      const scene::Problem fine =
          make_problem(fine_scene, case_index, {problem.h / 2, problem.horizon()});
      return coarsen_averages(method.solve(fine_scene, fine).averages,
                              comparison_nodes(fine_scene, *fine.lattice, fine.n_components),
                              comparison_nodes(scene, *problem.lattice, problem.n_components));
    }

    /// The problem on a mesh of 2 h, if the scene has one.
    std::optional<scene::Problem> doubled(const scene::Scene &scene, const scene::Problem &problem,
                                          unsigned int case_index)
    {
      if (problem.lattice)
        return {};
      try
      {
        const scene::Problem coarse =
            make_problem(scene, case_index, {2 * problem.h, problem.horizon()});
        if (coarse.mesh->cells.size() < problem.mesh->cells.size())
          return with_mesh(problem, coarse.mesh);
      }
      catch (const InputError &)
      {
        // 2 h does not divide the boxes
      }
      return {};
    }
  } // namespace

  unsigned int certified_digits(double estimate, double size)
  {
    constexpr int most = 15;
    if (!(estimate > 0) || !(size > 0))
      return 0;
    return static_cast<unsigned int>(
        std::clamp(static_cast<int>(std::floor(-std::log10(estimate / size))), 0, most));
  }

  namespace
  {
    double averages_size(const scene::Problem &problem, const Solution &solution)
    {
      return averages_l2(problem, solution.averages, std::vector<double>(solution.averages.size()));
    }

    /// What the solution itself says, without solving again.
    ErrorEstimate outer_estimate(const scene::Problem &problem, const Method &method,
                                 const Solution &solution)
    {
      ErrorEstimate estimate;
      estimate.method = method.name();
      estimate.h = problem.h;
      estimate.horizon = problem.horizon();
      estimate.outer_change = solution.diagnostics.outer_change * averages_size(problem, solution);
      return estimate;
    }
  } // namespace

  ErrorEstimate estimate_error(const scene::Scene &scene, const scene::Problem &problem,
                               unsigned int case_index, const Method &method,
                               const Solution &solution, bool is_cheap)
  {
    ErrorEstimate estimate = outer_estimate(problem, method, solution);
    const auto change = [&](const std::vector<double> &other)
    { return averages_l2(problem, solution.averages, other); };
    const auto coarse = is_cheap ? doubled(scene, problem, case_index) : std::nullopt;
    estimate.h_change = change(coarse ? method.solve(scene, *coarse).averages
                                      : halved(scene, problem, case_index, method));
    if (const auto higher = method.higher_degree())
      estimate.p_change = change(higher->solve(scene, coarse ? *coarse : problem).averages);
    estimate.estimate = std::max({estimate.h_change, estimate.p_change, estimate.outer_change});
    if (solution.diagnostics.is_outer_error_known)
      estimate.certified_digits =
          certified_digits(estimate.estimate, averages_size(problem, solution));
    return estimate;
  }

  ReferenceAverages solve_reference(const scene::Scene &scene, const scene::Problem &problem,
                                    unsigned int case_index, const Method &method)
  {
    const Solution solution = method.solve(scene, problem);
    ReferenceAverages result{solution.averages, {}};
    result.estimate = scene.estimate == "none"
                          ? outer_estimate(problem, method, solution)
                          : estimate_error(scene, problem, case_index, method, solution, false);
    result.estimate.n_geometry_checks = solution.diagnostics.n_geometry_checks;
    result.estimate.geometry_difference = solution.diagnostics.geometry_difference;
    const double size = averages_size(problem, solution), estimate = result.estimate.estimate;
    if (scene.reference_tolerance > 0 && !(estimate <= scene.reference_tolerance * size))
    {
      std::ostringstream message;
      message << "the reference " << method.name() << " at h = " << problem.h
              << " has an estimated error of " << estimate / size
              << " relative to the solution, more than Reference/tolerance = "
              << scene.reference_tolerance
              << "; take a higher degree (Reference/method), a smaller h, or a larger tolerance";
      throw NumericalError(message.str());
    }
    return result;
  }
} // namespace plumbline::study
