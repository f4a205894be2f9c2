#include "study/reference.h"

#include "base/error.h"
#include "study/comparison.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::study
{
  namespace
  {
    /// Averages of the same method at h/2 over the cells of h.
    std::vector<double> halved(const scene::Scene &scene, const scene::Problem &problem,
                               unsigned int case_index, const Method &method)
    {
      if (problem.mesh)
      {
        scene::Problem fine = problem;
        fine.mesh = std::make_shared<const geometry::Mesh>(geometry::refine(*problem.mesh));
        return method.solve(scene, fine).averages;
      }
      scene::Scene fine_scene = scene;
      fine_scene.nodes.kind = "centres";
      fine_scene.n_geometry_checks = 0;
      const scene::Problem fine =
          make_problem(fine_scene, case_index, {problem.h / 2, problem.horizon()});
      return coarsen_averages(method.solve(fine_scene, fine).averages,
                              comparison_nodes(fine_scene, *fine.lattice, fine.n_components),
                              comparison_nodes(scene, *problem.lattice, problem.n_components));
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

  ReferenceAverages solve_reference(const scene::Scene &scene, const scene::Problem &problem,
                                    unsigned int case_index, const Method &method)
  {
    ReferenceAverages result;
    const Solution solution = method.solve(scene, problem);
    result.averages = solution.averages;
    ReferenceEstimate &estimate = result.estimate;
    estimate.method = method.name();
    estimate.h = problem.h;
    estimate.horizon = problem.horizon();
    estimate.n_geometry_checks = solution.diagnostics.n_geometry_checks;
    estimate.geometry_difference = solution.diagnostics.geometry_difference;
    const double size =
        averages_l2(problem, solution.averages, std::vector<double>(solution.averages.size()));
    estimate.outer_change = solution.diagnostics.outer_change * size;
    if (!scene.estimate_reference)
      return result;

    estimate.h_change =
        averages_l2(problem, result.averages, halved(scene, problem, case_index, method));
    if (const auto higher = method.higher_degree())
      estimate.p_change =
          averages_l2(problem, result.averages, higher->solve(scene, problem).averages);
    estimate.estimate = std::max({estimate.h_change, estimate.p_change, estimate.outer_change});
    if (solution.diagnostics.is_outer_error_known)
      estimate.certified_digits = certified_digits(estimate.estimate, size);
    if (scene.reference_tolerance > 0 && !(estimate.estimate <= scene.reference_tolerance * size))
    {
      std::ostringstream message;
      message << "the reference " << method.name() << " at h = " << problem.h
              << " has an estimated error of " << estimate.estimate / size
              << " relative to the solution, more than Reference/tolerance = "
              << scene.reference_tolerance
              << "; take a higher degree (Reference/method), a smaller h, or a larger tolerance";
      throw NumericalError(message.str());
    }
    return result;
  }
} // namespace plumbline::study
