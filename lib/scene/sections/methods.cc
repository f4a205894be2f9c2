#include "base/error.h"
#include "scene/keys.h"
#include "scene/study_sections.h"
#include "scene/values.h"

namespace plumbline::scene
{
  std::string NodeSource::file_at(double h) const
  {
    const std::string mark = level_mark;
    std::string file = name;
    for (auto at = file.find(mark); at != std::string::npos; at = file.find(mark))
      file.replace(at, mark.size(), short_number(h));
    return file;
  }

  void MethodsSection::declare(Keys &keys)
  {
    keys.add(
        "names", "", any_text(), [this](const std::string &text) { names = to_methods(text); },
        "Methods to compare, separated by ','; 'all' selects every method that supports the scene, "
        "except GFD, PDDO, GMLS, MC and IPA-AC-R2c. "
        "See 'plumbline list methods', which also gives published names (HHB, PA-HHB, PDLAMMPS, "
        "...) that are accepted. PDDO and GMLS need scalar kernels. IPA-AC evaluates these "
        "quantities at the centroid of the "
        "intersection of ball and cell, and all others at the node: for scalar kernels and bond "
        "tensors, the kernel with its direction; for double-well bonds in the plane, J, r and e, "
        "on a line J alone; for LPS (run, grow), the influence function and the direction of bond "
        "forces, but not the dilatation or the stretch that breaks bonds; for the variational "
        "model, the influence function alone. IPA-AC-R2 and IPA-AC-R4 do so for scalar kernels; "
        "they evaluate tensors, double wells and LPS at the node.");
    keys.add(
        "nodes", nodes.name,
        "Meshfree nodes: centres of lattice cells, vertices (of a lattice, with constrained "
        "nodes on the boundary), mesh (centroids of mesh cells), or a .csv file with columns "
        "x and y, in three dimensions x, y and z; {h} in its name selects one file for each "
        "level (pd_{h}.csv: pd_0.05.csv at h = 0.05). On meshes, and on scattered nodes in "
        "three dimensions, the node cells are Voronoi cells; with mesh in three dimensions they "
        "are the tetrahedra or hexahedra.");
    keys.add(
        "perturbation", nodes.perturbation, between(0, .49),
        "Random displacement of centres by up to this multiple of h along each axis "
        "(Geometry/seed). Needs a mesh, or Domain/dimension = 3, where vertices of tetrahedra (P1, "
        "DGP0, DGP1) inside the domain move, too.");
    keys.add("load", loads_are_averages, "nodes", "cells",
             "Right-hand sides of meshfree methods: the load at the nodes, or its averages over "
             "the node cells.");
  }

  void MethodsSection::complete() const
  {
    if (names.empty())
      throw InputError(
          "Methods/names is empty; give names of methods ('plumbline list methods') or all; to run "
          "the reference only, give its method");
  }
} // namespace plumbline::scene
