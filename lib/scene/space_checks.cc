#include "base/error.h"
#include "scene/checks.h"
#include "scene/models/model.h"
#include "scene/on_line.h"
#include "scene/values.h"

#include <algorithm>
#include <string>

namespace plumbline::scene
{
  namespace
  {
    /// What is in the way, and what to write instead.
    void needs(bool is_right, const std::string &given, const std::string &remedy)
    {
      require(is_right, "Domain/dimension = 3 does not support " + given + " yet; " + remedy);
    }

    void check_domain_in_space(const Scene &scene)
    {
      const DomainSection &domain = scene.domain;
      needs(domain.mesh.is_lattice() || domain.mesh.is_file(), "Domain/mesh = " + domain.mesh.name,
            "write lattice, or a file .msh or .geo whose physical volumes are meshed with "
            "tetrahedra or hexahedra");
      require(domain.mesh.is_file() ||
                  (!domain.solid.include.empty() && domain.boxes.exclude.empty()),
              "Domain/dimension = 3 needs three coordinates per corner in Domain/boxes and "
              "Domain/holes; write '0, 0, 0 : 1, 1, 1'");
      needs(!domain.mesh.is_curved, "Domain/sides = curved", "write straight");
      const bool is_fracture = scene.fracture.is_there(); // see check_fracture
      needs(!domain.is_periodic, "Domain/boundary = periodic", "write constrained");
      needs(
          !domain.is_free_body || is_fracture || domain.mesh.is_file(),
          "Domain/boundary = free with Domain/mesh = " + domain.mesh.name,
          "write constrained, or as Domain/mesh a file .msh or .geo, where u is prescribed in the "
          "physical volumes collar... (boxes with free surfaces are for fracture, section "
          "Fracture)");
      require(!domain.is_free_body || is_fracture || (domain.fixed.empty() && !domain.is_floating),
              "Domain/fixed is for lattices; in a body from Domain/mesh = " + domain.mesh.name +
                  " u is prescribed in its physical volumes collar...: clear it");
      needs(domain.outside.empty() && (domain.cracks.empty() || is_fracture),
            "Domain/cracks and Domain/outside",
            "clear both (cracks are for quasi-static fracture, section Fracture)");
      needs(!domain.collar, "Domain/interaction domain with a width", "write auto");
    }

    void check_nodes_in_space(const Scene &scene)
    {
      const NodeSource &nodes = scene.methods.nodes;
      const bool is_on_mesh = scene.domain.mesh.is_file();
      const std::string on_mesh = " with Domain/mesh = " + scene.domain.mesh.name;
      needs(nodes.kind() == NodeKind::centres ||
                nodes.kind() == (is_on_mesh ? NodeKind::mesh : NodeKind::file),
            "Methods/nodes = " + nodes.name + (is_on_mesh ? on_mesh : ""),
            is_on_mesh ? "write mesh: the centroids of the cells"
                       : "write centres, or a file .csv");
      needs(!is_on_mesh || nodes.perturbation == 0, "Methods/perturbation" + on_mesh, "write 0");
      if (nodes.are_lattice_centres())
        return;
      require(scene.solver.iteration != base::Iteration::cg,
              "Solver/iteration = cg needs a symmetric operator, but on scattered nodes a bond has "
              "two weights, one for each end; write automatic, gmres or bicgstab");
      require(scene.solver.operator_backend == base::OperatorBackend::automatic,
              "Solver/operator = " + base::word(scene.solver.operator_backend) +
                  " is for lattices; scattered nodes have a sparse matrix: write automatic");
    }

    void check_fracture_in_space(const Scene &scene)
    {
      const FractureSection &fracture = scene.fracture;
      needs(!fracture.is_there() || !fracture.is_corrected(),
            "Fracture/surface terms = " + base::word(fracture.surface_terms), "write uncorrected");
      needs(!fracture.is_there() || fracture.criterion == Criterion::toughness,
            "Fracture/criterion = " + base::word(fracture.criterion), "write toughness");
    }

    /// Materials that differ and free surfaces, of meshes.
    void check_bodies_in_space(const Scene &scene)
    {
      const bool is_free = scene.domain.is_free_body && !scene.fracture.is_there();
      if (!is_free && scene.kernel.materials.empty())
        return;
      const std::string given = is_free ? "Domain/boundary = free" : "Kernel/materials";
      needs(!scene.problem.loads.empty(), given + " with a manufactured load",
            "give Problem/load and Problem/constraint");
    }

    void check_study_in_space(const Scene &scene)
    {
      const MaterialSection &material = scene.material;
      needs(material.model->is_linear(), "Material/model = " + material.model->name(),
            "write bond-based, LPS or variational");
      needs(material.is_homogeneous, "constants that vary in space (section Material)",
            "write numbers");
      if (material.model->is_state_based() && material.is_homogeneous)
      {
        const physics::Lame lame = material.lame()({});
        require(3 * lame.lambda + 2 * lame.mu > 0,
                "Material/lambda = " + short_number(lame.lambda) +
                    " must be larger than -2 mu / 3 in three dimensions; give such a lambda");
      }
      require(material.given[2][0].empty() && material.given[2][1].empty(),
              "Material/k and Material/l are constants of the plane; write Material/E and "
              "Material/nu, or Domain/dimension = 2");
      needs(!scene.crack.is_there() && !scene.strip.is_there(), "dynamic cracks and strips",
            "clear Crack and Strip");
      check_fracture_in_space(scene);
      check_nodes_in_space(scene);
      needs(scene.kernel.coefficient.empty(), "Kernel/coefficient",
            "clear it (Kernel/materials: a coefficient for each physical volume of a mesh file)");
      check_bodies_in_space(scene);
      needs(!scene.solver.is_full_model, "Solver/model = full", "write smallest");
      needs(scene.problem.local_solution != LocalSolution::computed,
            "Problem/local solution = computed", "write none, or an expression");
      needs(scene.study.decisive_error.target != Target::finest,
            "Study/decisive error against the own finest level", "write exact or reference");
      needs(!scene.sampling.is_there() && scene.random.field == FieldKind::none,
            "samples and random fields",
            "clear Sampling/rule and Random/field; Study/regime = variable varies a parameter");
      needs(quantity(scene.study.decisive_error.norm) != Quantity::field,
            "Study/decisive error = " + scene.study.decisive_error.text(),
            "write a nodal or averages norm");
    }
  } // namespace

  void check_space(const Scene &scene)
  {
    if (is_on_intervals(scene))
      return check_intervals(scene);
    for (const std::vector<geometry::Box> *boxes :
         {&scene.domain.boxes.include, &scene.domain.boxes.exclude})
      for (const geometry::Box &box : *boxes)
        require(box.lower[1] < box.upper[1] || scene.domain.dimension == 1,
                "Domain/boxes or Domain/holes has one coordinate per end, but Domain/dimension = " +
                    std::to_string(scene.domain.dimension) +
                    "; write Domain/dimension = 1, or all coordinates");
    if (scene.domain.is_in_space())
    {
      check_domain_in_space(scene);
      check_study_in_space(scene);
    }
    else
      require(scene.domain.solid.include.empty() && scene.domain.solid.exclude.empty(),
              "Domain/boxes or Domain/holes has three coordinates per corner, but Domain/dimension "
              "= " +
                  std::to_string(scene.domain.dimension) +
                  "; write Domain/dimension = 3, or two coordinates");
  }
} // namespace plumbline::scene
