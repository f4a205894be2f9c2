#include "scene/on_line.h"

#include "base/control_points.h"
#include "base/error.h"
#include "physics/expression.h"
#include "scene/models/model.h"
#include "scene/values.h"

#include <algorithm>
#include <array>
#include <utility>

namespace plumbline::scene
{
  bool is_on_intervals(const Scene &scene)
  {
    return scene.domain.dimension == 1 && scene.material.model->is_linear();
  }

  physics::Kernel<1> make_kernel_on_line(const Scene &scene, double horizon)
  {
    const KernelSection &kernel = scene.kernel;
    if (kernel.limit == Limit::none)
      return {kernel.structure, kernel.profile, horizon, kernel.constant};
    return physics::Kernel<1>::with_diffusion(kernel.profile, horizon,
                                              kernel.limit == Limit::half_laplace ? .5 : 1);
  }

  namespace
  {
    /// What is in the way, and what to write instead.
    void needs(bool is_right, const std::string &given, const std::string &remedy)
    {
      require(is_right, "Domain/dimension = 1 does not support " + given + "; " + remedy);
    }

    void check_domain(const Scene &scene)
    {
      const DomainSection &domain = scene.domain;
      const auto is_flat = [](const geometry::Box &box) { return box.lower[1] == box.upper[1]; };
      require(domain.solid.include.empty() &&
                  std::all_of(domain.boxes.include.begin(), domain.boxes.include.end(), is_flat),
              "Domain/dimension = 1 needs one coordinate for each end in Domain/boxes; write 'x0 : "
              "x1', such as '0 : 1'");
      needs(domain.boxes.exclude.empty() && domain.solid.exclude.empty(), "Domain/holes",
            "write the intervals around them, as 'x0 : x1; x2 : x3'");
      needs(domain.mesh.is_lattice(), "Domain/mesh = " + domain.mesh.name, "write lattice");
      needs(!domain.is_periodic && !domain.is_free_body && domain.fixed.empty() &&
                !domain.is_floating,
            "Domain/boundary other than constrained for Material/model = " +
                scene.material.model->name(),
            "write constrained (periodic is for transient analyses of double-well bonds)");
      needs(domain.cracks.empty() && domain.outside.empty(), "Domain/cracks and Domain/outside",
            "clear both");
      needs(!domain.collar, "Domain/interaction domain with a width", "write auto");
      const NodeSource &nodes = scene.methods.nodes;
      needs(nodes.are_lattice_centres(),
            "Methods/nodes other than centres, or Methods/perturbation > 0",
            "write Methods/nodes = centres and Methods/perturbation = 0");
    }

    void check_analysis_of_line(const Scene &scene)
    {
      const std::string model = "Material/model = " + scene.material.model->name();
      needs(!scene.time.is_dynamic(), "transient analyses (Time/final time > 0) with " + model,
            "write 0, or Material/model = double well");
      needs(!scene.crack.is_there() && !scene.strip.is_there() && !scene.fracture.is_there(),
            "fracture (sections Crack, Strip and Fracture)", "clear them");
      needs(!scene.sampling.is_there() && scene.random.field == FieldKind::none,
            "samples and random fields",
            "clear Sampling/rule and Random/field; Study/regime = variable varies a parameter");
      needs(!scene.solver.is_full_model, "Solver/model = full", "write smallest");
      needs(scene.problem.local_solution != LocalSolution::computed,
            "Problem/local solution = computed", "write none, or an expression");
      needs(scene.study.decisive_error.target != Target::finest,
            "Study/decisive error against own finest level", "write exact, local or reference");
      const auto is_of_equations = [](Norm norm)
      {
        return quantity(norm) == Quantity::truncation || quantity(norm) == Quantity::bound ||
               quantity(norm) == Quantity::energy;
      };
      for (const Norm norm : scene.study.norms)
        needs(!is_of_equations(norm), "Study/norms = " + base::word(norm),
              "write nodal or averages norms");
      needs(quantity(scene.study.decisive_error.norm) != Quantity::field,
            "Study/decisive error = " + scene.study.decisive_error.text(),
            "write a nodal or averages norm");
    }
  } // namespace

  void check_intervals(const Scene &scene)
  {
    const KernelSection &kernel = scene.kernel;
    needs(!scene.material.model->takes_influence(),
          "Material/model = " + scene.material.model->name(),
          "write bond-based with a scalar Kernel/type");
    needs(kernel.structure == physics::Structure::scalar, "Kernel/type = " + kernel.type,
          "write a scalar kernel: in one dimension u is a scalar, and a bond tensor is the scalar "
          "kernel of the same profile");
    needs(kernel.coefficient.empty() && kernel.materials.empty(),
          "Kernel/coefficient and Kernel/materials", "clear both");
    check_analysis_of_line(scene);
    check_domain(scene);
  }

  void check_without_y(const Scene &scene)
  {
    constexpr std::array parts_of_time = {.07, .3, .9};
    constexpr unsigned int n_samples = 200;
    const TimeSection &time = scene.time;
    const ProblemSection &problem = scene.problem;
    std::vector<std::pair<std::string, std::string>> given = {
        {"Time/initial displacement", time.initial_displacement},
        {"Time/initial velocity", time.initial_velocity}};
    for (const NamedExpression &one : problem.solutions)
      given.emplace_back("Problem/solution", one.expression);
    for (const NamedExpression &one : problem.loads)
      given.emplace_back("Problem/load", one.expression);
    if (problem.constraint)
      given.emplace_back("Problem/constraint", *problem.constraint);
    if (problem.local_solution == LocalSolution::expression)
      given.emplace_back("Problem/local solution", problem.local_expression);
    for (const auto &[key, text] : given)
      for (const double part : parts_of_time)
      {
        if (text.empty())
          continue;
        auto names = scene.names(1, part * time.final_time);
        names.constants["h"] = 1; // of the level
        const physics::Expression u(key, text, names);
        for (const geometry::Box &box : scene.domain.boxes.include)
          for (const double s : base::control_points(n_samples))
          {
            const double x = box.lower[0] + s * (box.upper[0] - box.lower[0]);
            require(u(dealii::Point<2>(x, .271), 0) == u(dealii::Point<2>(x, .619), 0),
                    key + " = '" + text +
                        "' depends on y, which a line (Domain/dimension = 1) does "
                        "not have; write it in x alone");
          }
      }
  }
} // namespace plumbline::scene
