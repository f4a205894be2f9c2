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
        "Methods to compare, separated by ','; 'all' takes those that can do the scene. See "
        "'plumbline list methods'. What IPA-AC takes at the centroid of ball and cell, everything "
        "else being taken at the node: scalar kernels and bond tensors, the kernel with its "
        "direction; double wells in the plane, J, r and e; on a line, J alone; LPS (run, grow), "
        "the influence function and the direction of bond forces, not the dilatation or the "
        "stretch at which bonds break; variational, the influence function alone. IPA-AC-R2 and "
        "IPA-AC-R4 do so for scalar kernels; they take tensors, double wells and LPS at the "
        "node.");
    keys.add("nodes", nodes.name,
             "Meshfree nodes: centres of lattice cells, vertices (of a lattice, the boundary among "
             "the data), mesh (centroids of its cells), or a file .csv with columns x and y, one "
             "for each level if "
             "{h} is in its name (pd_{h}.csv: pd_0.05.csv at h = 0.05). On meshes their cells are "
             "Voronoi cells.");
    keys.add("perturbation", nodes.perturbation, between(0, .49),
             "Centres are moved at random by up to so many h in x and in y (Geometry/seed). Needs "
             "a mesh.");
    keys.add("load", loads_are_averages, "nodes", "cells",
             "Meshfree right-hand sides: the load at the nodes, or its averages over their cells.");
  }

  void MethodsSection::complete() const
  {
    if (names.empty())
      throw InputError("Methods/names is empty; name methods ('plumbline list methods'), or all");
  }
} // namespace plumbline::scene
