#include "base/error.h"
#include "scene/keys.h"
#include "scene/study_sections.h"
#include "scene/values.h"

namespace plumbline::scene
{
  void MethodsSection::declare(Keys &keys)
  {
    keys.add(
        "names", "", any_text(), [this](const std::string &text) { names = to_methods(text); },
        "Methods to compare, separated by ','; 'all' takes those that can do the scene. See "
        "'plumbline list methods'.");
    keys.add("nodes", nodes.name,
             "Meshfree nodes: centres of lattice cells, vertices (of a lattice, the boundary among "
             "the data), mesh (centroids of its cells), or a file .csv with columns x and y. On "
             "meshes their cells are Voronoi cells.");
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
