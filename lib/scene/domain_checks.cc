#include "base/error.h"
#include "base/text_file.h"
#include "geometry/lattice.h"
#include "scene/checks.h"
#include "scene/values.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>

namespace plumbline::scene
{
  namespace
  {
    void check_free_body(const Scene &scene)
    {
      const auto needs = [](bool is_good, const std::string &what)
      { require(is_good, "Domain/boundary = free needs " + what); };
      if (scene.domain.is_in_space())
        return; // see check_space
      needs(!scene.domain.mesh.is_lattice() ||
                (scene.domain.boxes.include.size() == 1 && scene.domain.boxes.exclude.empty()),
            "one box (Domain/boxes) without holes where Domain/mesh = lattice; write squares or "
            "triangles for several boxes, a .geo or .msh file for any other shape");
      needs(
          !scene.domain.fixed.empty() || scene.domain.is_floating,
          "a part where u is given, or the body can move as a whole (3 rigid modes in the plane); "
          "give Domain/fixed");
      needs(scene.methods.nodes.are_vertices(), "Methods/nodes = vertices");
      needs(scene.problem.solutions.empty() && !scene.problem.loads.empty(),
            "Problem/load and Problem/constraint as expressions, Problem/solution empty");
      needs(!scene.domain.collar, "Domain/interaction domain = auto: there is none");
      if (!scene.domain.mesh.is_of_boxes() || !scene.domain.mesh.map.empty())
        return; // fixed boxes may cut the cells
      for (const Series &series : scene.study.series)
        for (const Level &level : series.levels)
        {
          geometry::Domain both = scene.domain.boxes;
          both.include.insert(both.include.end(), scene.domain.fixed.begin(),
                              scene.domain.fixed.end());
          (void)geometry::Lattice(both, level.h);
        }
    }

    const std::string mesh_remedy = "a lattice is uniform; write Domain/mesh = squares, triangles, "
                                    "a .msh or .geo file, or a generator";

    /// What other programs call their meshes, by the end of the name.
    const std::map<std::string, std::string> other_formats = {
        {".e", "an Exodus file"},     {".exo", "an Exodus file"},  {".ex2", "an Exodus file"},
        {".g", "an Exodus file"},     {".gen", "an Exodus file"},  {".exii", "an Exodus file"},
        {".vtu", "a VTK file"},       {".vtk", "a VTK file"},      {".pvtu", "a VTK file"},
        {".vtp", "a VTK file"},       {".inp", "an Abaqus file"},  {".cae", "an Abaqus file"},
        {".odb", "an Abaqus file"},   {".xdmf", "an XDMF file"},   {".med", "a MED file"},
        {".unv", "an I-DEAS file"},   {".bdf", "a Nastran file"},  {".nas", "a Nastran file"},
        {".mphtxt", "a COMSOL file"}, {".cdb", "an Ansys file"},   {".k", "an LS-DYNA file"},
        {".mesh", "a Medit file"},    {".su2", "an SU2 file"},     {".off", "an OFF file"},
        {".stl", "an STL file"},      {".obj", "a Wavefront file"}};

    /// deal.II's generators have names without points.
    void check_format(const MeshSource &mesh)
    {
      std::string ending = std::filesystem::path(mesh.name).extension().string();
      if (mesh.kind() != MeshKind::generator || ending.empty())
        return;
      std::transform(ending.begin(), ending.end(), ending.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      const std::string given = "Domain/mesh = " + mesh.name;
      const std::string small = "mesh" + ending;
      require(!base::has_ending(small, ".msh") && !base::has_ending(small, ".geo"),
              given + ": names of gmsh files end in .msh or .geo, in small letters; rename it");
      const auto known = other_formats.find(ending);
      require(false, given + " is " +
                         (known != other_formats.end() ? known->second
                                                       : "a file of the unknown kind " + ending) +
                         ", which is not read; convert it to gmsh's .msh format 2.2 or 4.1, e.g. "
                         "with gmsh or meshio, with physical surfaces omega... and collar...");
    }

    void check_mesh(const Scene &scene)
    {
      const MeshSource &mesh = scene.domain.mesh;
      check_format(mesh);
      const MeshKind kind = mesh.kind();
      const bool is_generator = kind == MeshKind::generator, is_free = scene.domain.is_free_body;
      const auto needs = [&](bool is_good, const std::string &what, const std::string &remedy)
      { require(is_good, what + " with Domain/mesh = " + mesh.name + ": " + remedy); };
      needs(mesh.map.empty() || kind == MeshKind::squares || kind == MeshKind::triangles,
            "Domain/map is given",
            "maps move squares and triangles; clear it or choose one of them");
      needs(is_generator || (mesh.arguments.empty() && mesh.inside.empty()),
            "Domain/arguments or Domain/inside is given",
            "they belong to deal.II's generators; clear them");
      needs(!is_generator || !mesh.inside.empty() || is_free, "Domain/inside is empty",
            "any name other than lattice, squares, triangles and files .msh or .geo is a generator "
            "of deal.II; give an expression that is positive in Omega, the other cells being the "
            "interaction domain");
      needs(!mesh.is_curved || kind == MeshKind::file, "Domain/sides = curved",
            "only a .geo file, or a .msh file of second to fourth order, has curves to follow; "
            "take one, or write straight");
      needs(!mesh.is_curved || !is_free, "Domain/sides = curved and Domain/boundary = free",
            "a free body has straight sides; write straight");
      needs(!mesh.is_curved || scene.quadrature.exact_entries,
            "Domain/sides = curved and Quadrature/entries = quadrature",
            "entries of cells with curved sides are available by pairs of sides only; write exact, "
            "or "
            "Domain/sides = straight");
      needs(!mesh.is_curved || !scene.has_dilatation(),
            "Domain/sides = curved and a material with dilatations",
            "these are integrated over cells with straight sides; write straight");
      needs(mesh.is_of_boxes() || scene.domain.boxes.exclude.empty(), "Domain/holes is given",
            "holes are for boxes; cut them out of the mesh itself");
      if (mesh.is_lattice())
      {
        needs(scene.kernel.coefficient.empty(),
              "Kernel/coefficient = '" + scene.kernel.coefficient + "'", mesh_remedy);
        needs(is_free || scene.material.is_homogeneous,
              "Material/" + scene.material.keys[0] + " or " + scene.material.keys[1] +
                  " varies in space",
              mesh_remedy);
        needs(!scene.has_dilatation() || is_free || scene.kernel.profile.breaks().empty(),
              "Kernel/type = " + scene.kernel.type,
              "dilatations on a lattice need an influence function without breaks; write "
              "Domain/mesh = squares, or another Kernel/type");
        needs(scene.domain.is_in_space() || scene.methods.nodes.perturbation == 0,
              "Methods/perturbation > 0", mesh_remedy);
        needs(scene.problem.local_solution != LocalSolution::computed || scene.time.is_dynamic(),
              "Problem/local solution = computed", mesh_remedy);
        return;
      }
      needs(!scene.domain.collar, "Domain/interaction domain is given",
            "the mesh defines its interaction domain, which is checked; write Domain/interaction "
            "domain = auto");
      needs(is_free || scene.solver.operator_backend == base::OperatorBackend::automatic,
            "Solver/operator = " + base::word(scene.solver.operator_backend),
            "operators on meshes are sparse matrices; write automatic");
    }

    /// Checks constrained and free boundaries.
    void check_boundary(const Scene &scene)
    {
      if (scene.fracture.is_there())
        return check_fracture(scene);
      const DomainSection &domain = scene.domain;
      if (domain.is_free_body)
        check_free_body(scene);
      require(
          domain.is_free_body || (domain.fixed.empty() && !domain.is_floating),
          "Domain/fixed is given, but u is prescribed in the interaction domain all around; write "
          "Domain/boundary = free, or clear it");
      require(scene.problem.local_solution != LocalSolution::computed ||
                  !(domain.is_free_body || domain.is_damaged()),
              "Problem/local solution = computed needs u all around a domain without cracks and "
              "free surfaces; write none, or an expression");
      require(scene.material.has_collar_dilatation ||
                  (scene.has_dilatation() && !domain.mesh.is_lattice() && !domain.is_free_body),
              "Material/dilatation in interaction domain = zero needs a state-based solid with "
              "lambda != mu on "
              "scattered nodes with an interaction domain; write from data, or Material/model = "
              "LPS with "
              "Domain/mesh = squares");
      require(
          scene.material.surface_terms == SurfaceTerms::automatic ||
              (domain.is_damaged() && scene.has_dilatation()),
          "Material/surface terms = " + base::word(scene.material.surface_terms) +
              " has no effect: there is no free surface or crack, or the model has no surface "
              "terms; clear it, or give Domain/cracks or Domain/outside with Material/model = LPS");
      require(!domain.is_damaged() || !domain.mesh.is_lattice(),
              "Domain/cracks or Domain/outside is given with Domain/mesh = lattice: " +
                  mesh_remedy);
      require(!scene.methods.loads_are_averages || domain.is_free_body,
              "Methods/load = cells is for free bodies; write nodes, or Domain/boundary = free");
    }

    /// Missing files of fine levels are reported before coarse levels are solved.
    void check_node_files(const Scene &scene)
    {
      const NodeSource &nodes = scene.methods.nodes;
      if (!nodes.is_for_each_level())
      {
        std::set<double> sizes;
        for (const Series &series : scene.study.series)
          for (const Level &level : series.levels)
            sizes.insert(level.h);
        require(!scene.domain.is_in_space() || nodes.kind() != NodeKind::file || sizes.size() == 1,
                "Methods/nodes = " + nodes.name +
                    " would be the nodes for every h of Study/h; write one file for each, as "
                    "nodes_{h}.csv, or give one h");
        return;
      }
      for (const Series &series : scene.study.series)
        for (const Level &level : series.levels)
        {
          const std::string file =
              (std::filesystem::path(scene.folder) / nodes.file_at(level.h)).string();
          require(std::filesystem::exists(file),
                  "Methods/nodes = " + nodes.name + ": there is no file '" + file +
                      "' for h = " + short_number(level.h) +
                      "; give one for each h of Study/h, or leave that h out");
        }
    }

    void check_nodes(const Scene &scene)
    {
      const MeshSource &mesh = scene.domain.mesh;
      const std::string &nodes = scene.methods.nodes.name;
      const NodeKind kind = scene.methods.nodes.kind();
      const bool is_csv = base::has_ending(nodes, ".csv");
      const std::string on_mesh =
          "Methods/nodes = " + nodes + " with Domain/mesh = " + mesh.name + ": ";
      require(kind != NodeKind::file || is_csv,
              "Methods/nodes = '" + nodes +
                  "' is not known; write centres, vertices, mesh, or a file .csv");
      check_node_files(scene);
      require(scene.domain.is_in_space() || !mesh.is_lattice() || kind == NodeKind::centres ||
                  kind == NodeKind::vertices,
              on_mesh + mesh_remedy);
      require((mesh.is_of_boxes() && mesh.map.empty()) || scene.domain.is_free_body ||
                  kind != NodeKind::vertices,
              on_mesh + "vertices are those of the boxes; write centres, mesh, or a file .csv");
      require(scene.methods.nodes.perturbation == 0 || kind == NodeKind::centres,
              "Methods/perturbation moves centres, but Methods/nodes = " + nodes +
                  "; write Methods/nodes = centres, or set the perturbation to 0");
    }
  } // namespace

  void check_mesh_and_nodes(const Scene &scene)
  {
    check_mesh(scene);
    check_boundary(scene);
    check_nodes(scene);
  }
} // namespace plumbline::scene
