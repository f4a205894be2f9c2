#include "study/reference_estimate.h"

#include "base/error.h"
#include "method/another_operator.h"
#include "study/resized.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace plumbline::study
{
  namespace
  {
    /// What changes of a solution are multiplied by besides what Richardson's extrapolation says,
    /// which holds to first order only. With it no error of the audit (benchmarks/estimates) is
    /// above its estimate.
    constexpr double safety = 1.5;

    /// The same where the change is that from 2 h: more is extrapolated.
    constexpr double safety_of_coarse = 2;

    /// Errors that seem to fall by less than this when h is halved are still taken to fall so.
    constexpr double slowest = .75;

    /// The same where only one change is known: the rate 1/2 of a jump that the cells' continuous
    /// fields cannot follow.
    constexpr double unknown = .7071;

    /// What a linear solver leaves: an error of so many times its tolerance, relative to the
    /// solution. Solutions that a space holds are off by no more.
    constexpr double solver_share = 10;

    /// Two norms of one thing.
    struct Norms
    {
      double averages = 0, field = 0;
    };
  } // namespace

  unsigned int certified_digits(double estimate, double size)
  {
    constexpr int most = 15;
    if (!(estimate > 0) || !(size > 0))
      return 0;
    return static_cast<unsigned int>(
        std::clamp(static_cast<int>(std::floor(-std::log10(estimate / size))), 0, most));
  }

  double contraction(double before, double now, double expected)
  {
    return std::clamp(before > 0 ? now / before : unknown, expected, slowest);
  }

  double error_of_change(double change, double contraction)
  {
    return safety * change / (1 - contraction);
  }

  void conclude_from_changes(ErrorEstimate &estimate, double contraction, double size,
                             double tolerance)
  {
    estimate.rate = -std::log2(contraction);
    estimate.estimate = error_of_change(estimate.h_change, contraction) + estimate.outer_change +
                        solver_error(tolerance, size);
    estimate.p_change = estimate.field_p_change = not_fitted;
    estimate.field_h_change = estimate.field_coarse_change = not_fitted;
    estimate.field_rate = estimate.field_estimate = not_fitted;
    estimate.certified_digits = certified_digits(estimate.estimate, size);
  }

  void check_tolerance(const scene::ReferenceSection &wanted, const ErrorEstimate &estimate,
                       double size, const std::string &remedy)
  {
    if (wanted.tolerance <= 0 || estimate.estimate <= wanted.tolerance * size)
      return;
    std::ostringstream message;
    message << "the reference " << *wanted.method << " at h = " << estimate.h
            << " has an estimated error of " << estimate.estimate / size
            << " relative to the solution, more than Reference/tolerance = " << wanted.tolerance
            << "; take " << remedy;
    throw NumericalError(message.str());
  }

  scene::Scene without_reference(scene::Scene scene)
  {
    scene.reference.method.reset();
    scene.reference.estimate = scene::Estimate::none;
    return scene;
  }

  bool is_estimated(const scene::Scene &scene, const Method &method)
  {
    return method::is_reference(method) && method.name() != scene.reference.method &&
           (scene.reference.estimate == scene::Estimate::every ||
            (scene.reference.estimate == scene::Estimate::automatic && !scene.reference.method &&
             scene.problem.solutions.empty()));
  }

  ErrorEstimate placed(ErrorEstimate estimate, const Place &place, const std::string &problem)
  {
    estimate.problem = problem;
    estimate.series = place.series().name;
    estimate.level = place.number();
    return estimate;
  }

  void raise_to_mean(std::vector<double> &estimates, double more)
  {
    constexpr double least = 2;
    double squares = 0;
    for (const double e : estimates)
      squares += e * e / static_cast<double>(estimates.size());
    for (double &e : estimates)
      e = std::max(e, least * std::sqrt(squares)) + more;
  }

  double solver_error(double tolerance, double size)
  {
    return solver_share * tolerance * size;
  }

  namespace
  {
    /// Estimates the error of one solution.
    class Estimator
    {
    public:
      Estimator(const scene::Case &one, const Method &method, const Solution &solution,
                std::vector<dealii::Point<2>> points)
          : case_(one), problem_(one.problem),
            method_(method), solution_{solution.averages, solution.value},
            points_(std::move(points))
      {
        estimate_.at_points.assign(points_.size(), 0);
        estimate_.method = method.name();
        estimate_.h = problem_.h;
        estimate_.horizon = problem_.horizon();
        estimate_.outer_change = solution.diagnostics.outer_change *
                                 averages_l2(problem_, solution.averages, zero().averages);
      }

      /// What the solution itself says, without solving again.
      const ErrorEstimate &outer() const { return estimate_; }

      ErrorEstimate by_changes(bool is_cheap, const Diagnostics &diagnostics)
      {
        auto coarse = coarser(case_, 2);
        std::optional<ResizedSolution> on_coarse;
        if (coarse)
          on_coarse = solved(*coarse);
        std::optional<ResizedSolution> on_coarsest;
        const bool is_by_coarse = is_cheap && on_coarse && !has_few_cells();
        if (is_by_coarse)
          if (const auto coarsest = coarser(case_, 4))
            on_coarsest = solved(*coarsest);
        if (is_by_coarse)
          from_coarse(*coarse, *on_coarse, on_coarsest);
        else
          from_fine(on_coarse);
        const Norms size = distance(problem_, solution_, zero());
        const double tolerance = problem_.settings.solver.tolerance;
        estimate_.estimate = std::max(by_h_.averages, safety * estimate_.p_change) +
                             estimate_.outer_change + solver_error(tolerance, size.averages);
        estimate_.field_estimate = std::max(by_h_.field, safety * estimate_.field_p_change) +
                                   diagnostics.outer_change * size.field +
                                   solver_error(tolerance, size.field);
        finish_points(diagnostics.outer_change);
        if (diagnostics.is_outer_error_known)
          estimate_.certified_digits = certified_digits(estimate_.estimate, size.averages);
        return estimate_;
      }

    private:
      /// Nothing where cells are too large for a solution.
      std::optional<ResizedSolution> solved(const Resized &resized) const
      {
        try
        {
          return solve_resized(resized, problem_, method_);
        }
        catch (const NumericalError &)
        {
          return {};
        }
      }

      ResizedSolution zero() const
      {
        return {std::vector<double>(solution_.averages.size()),
                [](const dealii::Point<2> &, unsigned int) { return 0.; }};
      }

      /// So few that h/2 is cheap, too, and 2 h and 4 h may be too coarse to tell a rate.
      bool has_few_cells() const
      {
        constexpr std::size_t few = 500;
        return problem_.lattice() || problem_.mesh()->n_wholes() < few;
      }

      Norms distance(const problem::Problem<2> &cells, const ResizedSolution &a,
                     const ResizedSolution &b) const
      {
        constexpr unsigned int most = 9;
        return {averages_l2(problem_, a.averages, b.averages),
                field_l2(cells, a.value, b.value, std::min(most, 2 * method_.order()))};
      }

      /// By how much the error of a smooth solution falls as h halves, at least.
      double expected_contraction() const
      {
        const unsigned int geometry = geometry_order(problem_);
        const unsigned int order =
            geometry == 0 ? method_.order() : std::min(geometry, method_.order());
        return std::pow(.5, order);
      }

      /// By how much errors fall as h halves: the larger of what is expected and what two changes
      /// show. Averages that fall faster than the field will not go on to: the change from 2 h
      /// holds what varies inside its larger cells.
      Norms contraction(const Norms &before, const Norms &now) const
      {
        const double expected = expected_contraction();
        const double field = study::contraction(before.field, now.field, expected);
        return {std::max(field, study::contraction(before.averages, now.averages, expected)),
                field};
      }

      void enter_rates(const Norms &q)
      {
        estimate_.rate = -std::log2(q.averages);
        estimate_.field_rate = -std::log2(q.field);
      }

      void enter_changes(const Norms &now, const Norms &before)
      {
        estimate_.h_change = now.averages;
        estimate_.field_h_change = now.field;
        estimate_.coarse_change = before.averages;
        estimate_.field_coarse_change = before.field;
      }

      /// At points: the change from another solution, times a factor.
      void enter_points(const ResizedSolution &other, double factor)
      {
        for (std::size_t i = 0; i < points_.size(); ++i)
          for (unsigned int c = 0; c < problem_.n_components; ++c)
            estimate_.at_points[i] =
                std::max(estimate_.at_points[i], factor * std::abs(solution_.value(points_[i], c) -
                                                                   other.value(points_[i], c)));
      }

      void finish_points(double outer_change)
      {
        double size = 0;
        for (const dealii::Point<2> &x : points_)
          for (unsigned int c = 0; c < problem_.n_components; ++c)
            size = std::max(size, std::abs(solution_.value(x, c)));
        raise_to_mean(estimate_.at_points,
                      outer_change * size + solver_error(problem_.settings.solver.tolerance, size));
      }

      /// By h/2: the error is the change over 1 - q.
      void from_fine(const std::optional<ResizedSolution> &on_coarse)
      {
        const Resized fine = finer(case_, 2);
        // parts of the coarse cells, on which both fields are smooth; of a mesh made anew, ours
        problem::Problem<2> cells = problem_;
        if (fine.problem.lattice())
          cells = fine.problem;
        else
          cells.on_mesh()->mesh =
              std::make_shared<const geometry::Mesh>(geometry::refine(*problem_.mesh()));
        const ResizedSolution on_fine = solve_resized(fine, problem_, method_);
        const Norms change = distance(cells, solution_, on_fine);
        const Norms before = on_coarse ? distance(problem_, solution_, *on_coarse) : Norms{};
        const Norms q = contraction(before, change);
        enter_changes(change, before);
        enter_rates(q);
        by_h_ = {error_of_change(change.averages, q.averages),
                 error_of_change(change.field, q.field)};
        enter_points(on_fine, error_of_change(1, q.field));
        estimate_.is_of_polygon = fine.is_cut && geometry_order(problem_) > 0;
        if (const auto higher = higher_degree())
        {
          const Solution other = analysis::solve(*higher, problem_);
          enter_p_change({other.averages, other.value});
        }
      }

      /// By 2 h: the error is the change times q / (1 - q).
      void from_coarse(const Resized &coarse, const ResizedSolution &on_coarse,
                       const std::optional<ResizedSolution> &on_coarsest)
      {
        const Norms change = distance(problem_, solution_, on_coarse);
        const Norms before = on_coarsest ? distance(problem_, on_coarse, *on_coarsest) : Norms{};
        const Norms q = contraction(before, change);
        enter_changes(change, before);
        enter_rates(q);
        by_h_ = {safety_of_coarse * change.averages * q.averages / (1 - q.averages),
                 safety_of_coarse * change.field * q.field / (1 - q.field)};
        enter_points(on_coarse, safety_of_coarse * q.field / (1 - q.field));
        estimate_.is_of_polygon = false; // the mesh of 2 h was made anew
        if (const auto higher = higher_degree())
          enter_p_change(solve_resized(coarse, problem_, *higher));
      }

      /// Nothing where cells do not take it.
      std::shared_ptr<const Method> higher_degree() const
      {
        const auto higher = method_.higher_degree();
        return higher && higher->why_not(problem_).empty() ? higher : nullptr;
      }

      void enter_p_change(const ResizedSolution &higher)
      {
        enter_points(higher, safety);
        const Norms change = distance(problem_, solution_, higher);
        estimate_.p_change = change.averages;
        estimate_.field_p_change = change.field;
      }

      const scene::Case &case_;
      const problem::Problem<2> &problem_;
      const Method &method_;
      ResizedSolution solution_;
      std::vector<dealii::Point<2>> points_;
      Norms by_h_;
      ErrorEstimate estimate_;
    };
  } // namespace

  ErrorEstimate estimate_error(const scene::Case &one, const Method &method,
                               const Solution &solution, bool is_cheap,
                               const std::vector<dealii::Point<2>> &points)
  {
    return Estimator(one, method, solution, points).by_changes(is_cheap, solution.diagnostics);
  }

  ReferenceAverages solve_reference(const scene::Case &one, const Method &method,
                                    const scene::ReferenceSection &wanted,
                                    const std::vector<dealii::Point<2>> &points)
  {
    const problem::Problem<2> &problem = one.problem;
    const Solution solution = analysis::solve(method, problem);
    ReferenceAverages result{solution.averages, {}, {}};
    result.estimate = wanted.estimate == scene::Estimate::none
                          ? Estimator(one, method, solution, {}).outer()
                          : estimate_error(one, method, solution, false, points);
    result.at_points = values_at(points, problem, solution, result.estimate.at_points);
    result.estimate.n_geometry_checks = solution.diagnostics.n_geometry_checks;
    result.estimate.geometry_difference = solution.diagnostics.geometry_difference;
    const double size =
        averages_l2(problem, solution.averages, std::vector<double>(solution.averages.size()));
    check_tolerance(wanted, result.estimate, size,
                    "a higher degree (Reference/method), a smaller h, or a larger tolerance");
    return result;
  }
} // namespace plumbline::study
