#include "scene/unused_keys.h"

#include "base/error.h"
#include "base/similar_words.h"
#include "scene/keys.h"
#include "scene/models/model.h"
#include "scene/on_line.h"
#include "scene/values.h"

#include <algorithm>
#include <set>

namespace plumbline::scene
{
  namespace
  {
    const std::string of_polynomials = "coefficients", on_hexahedra = "q1";

    struct Use
    {
      std::string key;
      bool is_there = false; ///< else the key has no effect
      std::string needs;     ///< what it is for
    };

    /// In space, only Q1 on the hexahedra of a file has outer quadrature.
    bool takes_outer_rule_in_space(const Scene &scene)
    {
      const auto is_meant = [](const std::string &method)
      { return method == all || base::to_lower(method) == on_hexahedra; };
      const auto &names = scene.methods.names;
      return scene.domain.is_in_space() && scene.domain.mesh.is_file() &&
             (std::any_of(names.begin(), names.end(), is_meant) ||
              is_meant(scene.reference.method.value_or("")));
    }

    std::vector<Use> uses_of_study(const Scene &scene)
    {
      const Regime regime = scene.study.regime;
      const bool takes_horizon = regime == Regime::m || regime == Regime::horizon,
                 is_static = !scene.time.is_dynamic(), is_in_space = scene.domain.is_in_space(),
                 is_on_cubes = is_in_space && scene.domain.mesh.is_lattice() &&
                               scene.methods.nodes.are_lattice_centres();
      const bool is_on_line = is_on_intervals(scene), is_in_plane = !is_in_space && !is_on_line;
      const bool has_outer_rule = is_in_plane || takes_outer_rule_in_space(scene);
      const std::string exact =
          std::string("two dimensions; ") +
          (is_on_line ? "entries on intervals are exact"
                      : "in three dimensions only Q1 on hexahedra has outer quadrature");
      return {
          {"Study/m", !takes_horizon,
           "Study/regime = delta, delta-m or variable; with " + base::word(regime) +
               " the horizon is Study/horizon"},
          {"Study/horizon", takes_horizon,
           "Study/regime = m or horizon; with " + base::word(regime) +
               " the horizon is Study/m times Study/h"},
          {"Domain/boxes", scene.domain.mesh.is_of_boxes(),
           "Domain/mesh = lattice, squares or triangles: other meshes define the domain"},
          {"Output/points", is_static, "a static problem"},
          {"Output/fields",
           is_static || (scene.random.source != nullptr && scene.random.n_modes > 0),
           "a static problem, or a random field with modes (sample/modes.csv); Time/frames writes "
           "states"},
          {"Reference/tolerance", is_static, "a static problem"},
          {"Reference/mesh size", is_static, "a static problem"},
          {"Problem/local solution",
           is_static || scene.problem.local_solution == LocalSolution::none ||
               scene.problem.local_solution == LocalSolution::computed ||
               !scene.problem.local_expression.empty(),
           "a static problem, or 'computed' or an expression in transient analyses"},
          {"Quadrature/entries", is_in_plane, exact},
          {"Quadrature/tolerance", has_outer_rule, exact},
          {"Quadrature/max refinements", has_outer_rule, exact},
          {"Geometry/backend", is_in_plane, "two dimensions"},
          {"Geometry/checks", is_in_plane, "two dimensions"},
          {"Geometry/seed", is_in_plane || scene.methods.nodes.perturbation > 0,
           "two dimensions, or Methods/perturbation > 0"},
          {"Solver/linear solver", !is_on_cubes && !is_on_line,
           "two dimensions, meshes or scattered nodes; lattices in three dimensions are solved by "
           "conjugate gradients with sine transforms"},
          {"Solver/tolerance", is_static || !is_in_space, "a static problem"},
          {"Solver/max iterations", is_static || !is_in_space, "a static problem"},
          {"Time/Hoelder exponent", scene.time.has_bounds, "Time/a priori bounds = true"},
          {"Time/critical fractions", scene.time.steps.empty(),
           "Time/steps to be empty, which gives the steps themselves"},
          {"Fracture/load step", scene.fracture.breaking == BreakMode::steps,
           "Fracture/breaking = steps"}};
    }

    /// Bonds break in equilibrium, or in motion.
    std::vector<Use> uses_of_fracture(const Scene &scene)
    {
      const bool is_moving = scene.fracture.is_there() && scene.time.is_dynamic(),
                 is_still = !is_moving;
      const std::string still = "quasi-static fracture (Time/final time = 0)",
                        run = "'plumbline run', without Fracture/toughness";
      return {{"Fracture/breaking", is_still, still},
              {"Fracture/ties", is_still, still},
              {"Fracture/solver", is_still, still},
              {"Fracture/max load", is_still, still},
              {"Fracture/min reaction", is_still, still},
              {"Fracture/checkpoint interval", is_still, still},
              {"Time/a priori bounds", is_still, run},
              {"Time/mass", is_still, run + ", and a Galerkin method"},
              {"Reference/method", is_still, run},
              {"Expected/growth", is_still, still + "; for dynamic fracture use Expected/values"},
              {"Expected/growth ends", is_still, still},
              {"Expected/crack", is_moving || scene.crack.is_there(),
               "Crack/notch, or Fracture/toughness with Time/final time"}};
    }

    std::vector<Use> uses_of_material(const Scene &scene)
    {
      const KernelSection &kernel = scene.kernel;
      const MaterialSection &material = scene.material;
      const bool is_double_well = material.model == &double_well(),
                 is_bonds = !material.model->takes_influence();
      const std::string of_wells = "Material/model = " + double_well().name();
      return {
          {"Kernel/bulk modulus", kernel.limit == Limit::navier && is_bonds,
           "a bond tensor (Kernel/type) with Kernel/limit = Navier; other models take their "
           "constants from Material"},
          {"Kernel/constant", kernel.limit == Limit::none, "Kernel/limit = none"},
          {"Kernel/singularity", physics::kernel_type(kernel.type).key == of_polynomials,
           "a polynomial Kernel/type"},
          {"Kernel/symmetrisation", !kernel.coefficient.empty() || !kernel.materials.empty(),
           "Kernel/coefficient or Kernel/materials"},
          {"Material/plane", !material.given[0][0].empty() && scene.domain.dimension == 2,
           "Material/E in a scene of two dimensions; lambda, mu, k and l are those of the plane"},
          {"Material/c", is_double_well, of_wells},
          {"Material/beta", is_double_well, of_wells},
          {"Material/potential", is_double_well, of_wells},
          {"Material/toughness", is_double_well,
           of_wells + "; 'plumbline grow' has Fracture/toughness"},
          {"Material/boundary function", is_double_well, of_wells}};
    }

    std::vector<Use> uses_of_field(const Scene &scene)
    {
      const RandomSection &random = scene.random;
      const bool is_there = random.field != FieldKind::none,
                 is_ellipses = random.field == FieldKind::ellipses,
                 is_covariance = is_there && !is_ellipses && random.field != FieldKind::files,
                 has_modes = random.n_modes > 0;
      const std::string covariance = "Random/field with a covariance (exponential, Gaussian, ...)",
                        ellipses = "Random/field = ellipses";
      return {{"Random/mean", is_covariance, covariance},
              {"Random/deviation", is_covariance, covariance},
              {"Random/length", is_covariance, covariance},
              {"Random/smoothness", random.field == FieldKind::matern, "Random/field = Matern"},
              {"Random/cell", is_covariance || (is_ellipses && has_modes),
               "Random/field with modes that are computed on a lattice"},
              {"Random/fraction", is_ellipses, ellipses},
              {"Random/semi-axes", is_ellipses, ellipses},
              {"Random/overlap", is_ellipses, ellipses},
              {"Random/realisations", is_ellipses && has_modes, ellipses + " and Random/modes"},
              {"Random/realisation", random.is_drawn_whole(),
               "Random/field = ellipses or files, and no Random/modes"},
              {"Random/box", is_there, "Random/field"}};
    }

    /// A section and the key that enables it.
    struct Switch
    {
      std::string section, key;
      std::string needed_alone = ""; ///< a key that has an effect without it
    };

    const std::vector<Switch> switches = {{"Crack", "Crack/notch"},
                                          {"Fracture", "Fracture/toughness"},
                                          {"Strip", "Strip/length"},
                                          {"Sampling", "Sampling/rule"},
                                          {"Time", "Time/final time", "Time/density"}};

    /// 'plumbline stability' takes steps of waves on strained double wells, whatever the final
    /// time.
    bool is_of_steps(const Scene &scene, const std::string &key)
    {
      static const std::set<std::string> keys = {"Time/schemes", "Time/steps",
                                                 "Time/critical fractions"};
      return scene.material.model == &double_well() && scene.domain.is_periodic &&
             keys.count(key) > 0;
    }

    /// A key that has an effect only if another key is given.
    struct Companion
    {
      std::string key, other;
    };

    const std::vector<Companion> companions = {{"Expected/growth", "Fracture/toughness"},
                                               {"Expected/growth ends", "Fracture/toughness"},
                                               {"Expected/strip", "Strip/length"},
                                               {"Expected/sampling", "Sampling/rule"}};

    UnusedKey unused(const Keys &keys, const std::string &key, const std::string &needs)
    {
      return {key, key + " = " + keys.value(key) + " has no effect here: it needs " + needs +
                       "; remove it, or give what it needs"};
    }
  } // namespace

  std::optional<UnusedKey> find_unused_key(const Keys &keys, const Scene &scene)
  {
    for (const auto &uses : {uses_of_study(scene), uses_of_material(scene), uses_of_fracture(scene),
                             uses_of_field(scene)})
      for (const Use &use : uses)
        if (!use.is_there && keys.is_changed(use.key))
          return unused(keys, use.key, use.needs);
    // a section that is disabled by its key, e.g. on the command line, may keep its other keys
    for (const Switch &one : switches)
      if (!keys.is_given(one.key))
        for (const std::string &key : keys.changed_keys(one.section))
          if (key != one.needed_alone && !is_of_steps(scene, key))
            return unused(keys, key, one.key);
    for (const Companion &one : companions)
      if (!keys.is_given(one.other) && keys.is_changed(one.key))
        return unused(keys, one.key, one.other);
    return {};
  }
} // namespace plumbline::scene
