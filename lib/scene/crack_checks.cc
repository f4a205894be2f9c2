#include "base/error.h"
#include "scene/capabilities.h"
#include "scene/checks.h"
#include "scene/models/model.h"
#include "scene/values.h"

#include <cmath>

namespace plumbline::scene
{
  namespace
  {
    constexpr double tolerance = 1e-9; // of h: rounding of lengths that are written in decimals

    bool is_multiple(double length, double h)
    {
      return std::abs(length / h - std::round(length / h)) <= tolerance;
    }

    void check_level(const Scene &scene, const Level &level)
    {
      const geometry::Box &strip = scene.domain.boxes.include.front();
      const double notch = scene.crack.notch, length = strip.upper[0] - strip.lower[0],
                   height = strip.upper[1] - strip.lower[1];
      const std::string at = " (Study/h = " + short_number(level.h) + ")",
                        given = "Crack/notch = " + short_number(notch);
      if (!is_multiple(notch, level.h))
        throw InputError(given + " is " + short_number(notch / level.h) + " mesh sizes" + at +
                         "; give a multiple of h");
      if (!(notch < length * (1 - tolerance)))
        throw InputError(given + " cuts through the strip, which is " + short_number(length) +
                         " long (Domain/boxes); give less");
      if (!is_multiple(height, 2 * level.h))
        throw InputError("Domain/boxes: the strip's height " + short_number(height) +
                         " must be an even number of mesh sizes" + at +
                         ", so that the crack passes between two rows");
      if (height < 4 * level.horizon)
        throw InputError("Domain/boxes: the strip's height " + short_number(height) +
                         " is less than four horizons, " + short_number(4 * level.horizon) + at +
                         "; increase it, or decrease Study/h or Study/m");
    }
  } // namespace

  void check_model_of_crack(const Scene &scene)
  {
    const MaterialSection &material = scene.material;
    if (!scene.crack.is_there() || !material.model->is_state_based())
      return;
    const bool is_stress = material.plane == physics::PlaneState::stress;
    throw InputError(
        "Material/model = " + material.model->name() +
        " with Crack/notch > 0: 'plumbline crack' simulates bonds of Material/model = double well, "
        "for which nu = " +
        (is_stress ? "1/3 in plane stress" : "1/4 in plane strain") +
        "; write double well, with Material/nu = " + (is_stress ? "0.3333" : "0.25") +
        " or empty. For another nu, Material/model = LPS is supported by 'plumbline run' and, for "
        "quasi-static fracture, by 'plumbline grow' (Fracture/toughness), both with Crack/notch = "
        "0");
  }

  void check_crack(const Scene &scene)
  {
    const std::string given = "Crack/notch = " + short_number(scene.crack.notch) + " needs ";
    const auto needs = [&](bool is_good, const std::string &what)
    {
      if (!is_good)
        throw InputError(given + what);
    };
    check_analysis(scene, Analysis::crack);
    const DomainSection &domain = scene.domain;
    const ProblemSection &problem = scene.problem;
    const TimeSection &time = scene.time;
    needs(scene.material.boundary_function == BoundaryFunction::one,
          "Material/boundary function = one: the strip's ends are free, its edges constrained");
    needs(time.is_dynamic(), "Time/final time > 0");
    needs(domain.boxes.include.size() == 1 && domain.boxes.exclude.empty(),
          "one box (Domain/boxes) without holes, the strip");
    needs(!domain.collar,
          "Domain/interaction domain = auto: grips constrain the nodes above and below the strip");
    needs(problem.solutions.empty() && problem.loads.empty() && !problem.constraint &&
              time.initial_displacement.empty() && time.initial_velocity.empty(),
          "Problem/solution, load and constraint, Time/initial displacement and initial velocity "
          "to be empty: Crack/load and Crack/start say how the strip is pulled");
    needs(scene.methods.names.size() == 1 && scene.methods.nodes.kind() == NodeKind::centres &&
              scene.methods.nodes.perturbation == 0,
          "one meshfree method (Methods/names, which has " +
              std::to_string(scene.methods.names.size()) +
              ") on centres that are not moved (Methods/nodes)");
    needs(time.schemes.size() == 1, "one of Time/schemes");
    for (const Series &series : scene.study.series)
      for (const Level &level : series.levels)
        check_level(scene, level);
  }
} // namespace plumbline::scene
