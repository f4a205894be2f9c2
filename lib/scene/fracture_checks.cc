#include "base/error.h"
#include "physics/expression.h"
#include "scene/capabilities.h"
#include "scene/checks.h"
#include "scene/models/model.h"
#include "scene/values.h"

namespace plumbline::scene
{
  namespace
  {
    /// What drives a body in motion, and how.
    void check_breaking_motion(const Scene &scene)
    {
      const FractureSection &fracture = scene.fracture;
      const DomainSection &domain = scene.domain;
      const ProblemSection &problem = scene.problem;
      const TimeSection &time = scene.time;
      const std::string given = "Time/final time = " + short_number(time.final_time) +
                                " with Fracture/toughness (dynamic fracture) needs ";
      const auto needs = [&](bool is_good, const std::string &what)
      {
        if (!is_good)
          throw InputError(given + what);
      };
      needs(!domain.is_in_space(), "Domain/dimension = 2");
      needs(fracture.stretch == Stretch::linear && !fracture.is_corrected(),
            "Fracture/stretch = linear and Fracture/surface terms = uncorrected: other forces do "
            "not derive from an energy");
      needs(domain.is_floating || !domain.fixed.empty(),
            "Domain/fixed, the grips; write none if the body has no grips and is driven only by "
            "Problem/load and Time/initial velocity");
      needs(domain.is_floating != problem.constraint.has_value(),
            domain.is_floating ? "Problem/constraint empty, because Domain/fixed = none: there are "
                                 "no grips to which it applies"
                               : "Problem/constraint, the displacement of the grips in x, y and t");
      needs(problem.solutions.empty() && problem.loads.size() <= 1,
            "Problem/solution empty and no more than one Problem/load, the force per volume");
      needs(!problem.loads.empty() || problem.constraint.has_value() ||
                !time.initial_velocity.empty(),
            "a cause of motion: Problem/constraint, Problem/load or Time/initial "
            "velocity");
      needs(!scene.sampling.is_there(), "Sampling/rule = none: samples are quasi-static");
      needs(time.initial_displacement.empty(),
            "Time/initial displacement empty: the body is initially unstrained");
      needs(time.schemes.size() == 1, "one of Time/schemes");
      needs(time.steps.size() <= 1, "one of Time/steps: it is run once");
      needs(!time.steps.empty() || time.fractions.size() == 1,
            "one of Time/critical fractions: it is run once");
    }
  } // namespace

  namespace
  {
    /// That a critical stretch exists.
    /// @param given  the key that needs it
    void check_bonds(const Scene &scene, const std::string &given)
    {
      const KernelSection &kernel = scene.kernel;
      const bool is_lps = scene.material.model == &lps();
      if (!is_lps &&
          (scene.material.model != &bond_based() ||
           kernel.structure != physics::Structure::tensor || kernel.limit != Limit::navier ||
           !kernel.coefficient.empty() || !kernel.materials.empty()))
        throw InputError(given +
                         " needs Material/model = LPS (bond-based for nu = 1/4 in plane strain and "
                         "in three dimensions), or Kernel/type = bond-tensor ... with Kernel/limit "
                         "= Navier and no Kernel/coefficient");
      constexpr int n = 1000; // samples of the profile
      for (int k = 1; k <= n; ++k)
        if (const double t = k / static_cast<double>(n); kernel.profile(t) < 0)
          throw InputError(
              "Kernel/type = " + kernel.type + " is negative at r = " + short_number(t) +
              " horizons: such bonds push when they are stretched, so that no critical "
              "stretch follows from Fracture/toughness; give a profile that is not "
              "negative");
      if (!is_inverse_distance(kernel) && scene.fracture.surface_terms == SurfaceTerms::published)
        throw InputError(
            "Fracture/surface terms = published takes normals from bonds of Kernel/type "
            "= 1/r, which is " +
            kernel.type + "; write uncorrected, none or consistent");
    }

    /// Scattered nodes in the cells of a mesh.
    void check_fracture_on_mesh(const Scene &scene, const std::string &given)
    {
      const auto needs = [&](bool is_good, const std::string &what)
      {
        if (!is_good)
          throw InputError(given + " with Domain/mesh = " + scene.domain.mesh.name + " needs " +
                           what + ", or Domain/mesh = lattice");
      };
      needs(!scene.domain.is_in_space(), "Domain/dimension = 2");
      needs(!scene.time.is_dynamic(), "Time/final time = 0");
      needs(!scene.fracture.is_corrected(), "Fracture/surface terms = uncorrected");
      needs(scene.fracture.criterion == Criterion::toughness,
            "Fracture/criterion = toughness (calibrated measures a crack along a row of a "
            "lattice)");
      needs(!scene.methods.nodes.are_vertices(),
            "Methods/nodes = mesh (centroids of its cells), centres or a file .csv");
    }
  } // namespace

  void check_fracture(const Scene &scene)
  {
    const FractureSection &fracture = scene.fracture;
    const DomainSection &domain = scene.domain;
    const std::string given = "Fracture/toughness = " + fracture.toughness;
    const auto needs = [&](bool is_good, const std::string &what)
    {
      if (!is_good)
        throw InputError(given + " needs " + what);
    };
    physics::Names names = scene.random.names();
    names.is_in_space = domain.is_in_space();
    const physics::Expression toughness("Fracture/toughness", fracture.toughness, names);
    needs(toughness.n_components() == 1, "one component");
    if (toughness.is_constant() &&
        !((domain.is_in_space() ? toughness.at({}, 0) : toughness({})) > 0))
      throw InputError(given + " must be positive: it is the fracture energy per unit area");
    needs(!scene.crack.is_there(), "Crack/notch = 0: the notch is Domain/cracks");
    const bool is_moving = scene.time.is_dynamic();
    check_bonds(scene, given);
    if (!domain.mesh.is_lattice())
      check_fracture_on_mesh(scene, given);
    needs(domain.is_free_body && (is_moving || (!domain.is_floating && !domain.fixed.empty())),
          "Domain/boundary = free and Domain/fixed, the grips");
    needs(domain.outside.empty() && !domain.collar,
          "Domain/outside empty and Domain/interaction domain = auto");
    const bool is_loaded = !scene.problem.loads.empty();
    needs(is_moving || (scene.problem.solutions.empty() && scene.problem.loads.size() <= 1 &&
                        scene.problem.constraint.has_value()),
          "Problem/constraint, the displacement of the grips at load 1 (0, 0 for a body that "
          "Problem/load pulls), no Problem/solution, and no more than one load");
    needs(is_moving || !is_loaded ||
              (!fracture.is_corrected() && fracture.solver != GrowthSolver::multigrid),
          "Fracture/surface terms = uncorrected and Fracture/solver = automatic or factor, because "
          "Problem/load is given");
    if (is_loaded && !is_moving)
      needs(physics::Expression("Problem/load", scene.problem.loads.front().expression, names)
                    .n_components() == scene.n_components(),
            "Problem/load of " + std::to_string(scene.n_components()) + " components");
    needs(scene.methods.names.size() == 1 &&
              (!domain.mesh.is_lattice() || scene.methods.nodes.kind() == NodeKind::centres),
          "one meshfree method (Methods/names) on centres (Methods/nodes)");
    needs(
        !domain.cracks.empty() || !is_moving,
        "an initial notch in Domain/cracks, from its mouth to its tip (only quasi-static fracture "
        "begins without one)");
    needs(scene.study.series.size() == 1 && scene.study.series.front().levels.size() == 1,
          "one Study/h and one Study/m (or Study/horizon)");
    if (is_moving)
      check_breaking_motion(scene);
    check_analysis(scene, Analysis::growth);
  }
} // namespace plumbline::scene
