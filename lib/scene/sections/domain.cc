#include "base/error.h"
#include "base/text_file.h"
#include "scene/keys.h"
#include "scene/mesh_files.h"
#include "scene/on_line.h"
#include "scene/problem_sections.h"
#include "scene/values.h"

namespace plumbline::scene
{
  MeshKind MeshSource::kind() const
  {
    return base::from_word<MeshKind>(name).value_or(
        is_msh() || base::has_ending(name, ".geo") ? MeshKind::file : MeshKind::generator);
  }

  bool MeshSource::is_msh() const
  {
    return base::has_ending(name, ".msh");
  }

  geometry::Lattice DomainSection::lattice(double h) const
  {
    geometry::Domain cells = boxes;
    if (dimension == 1)
      for (geometry::Box &box : cells.include)
        box.upper[1] = box.lower[1] + h;
    return {cells, h};
  }

  void DomainSection::declare(Keys &keys)
  {
    mesh_files = std::make_shared<MeshFiles>();
    keys.add(
        "dimension", dimension, count(1, 3),
        "2: the plane. 1: a line; expressions depend on x and have one component (static analyses "
        "of scalar kernels on intervals, Domain/boxes = x0 : x1, with kernel constants for "
        "one "
        "dimension; transient analyses of Material/model = double well with Domain/boundary = "
        "periodic on the first axis of the box). 3: space; expressions depend on x, y and z "
        "(static, transient and dispersion analyses and quasi-static fracture of linear models "
        "with Domain/mesh = lattice; static analyses on tetrahedra or hexahedra of a gmsh file).");
    keys.add(
        "boxes", "0, 0 : 1, 1", any_boxes(),
        [this](const std::string &text)
        {
          solid.include = to_cuboids(text);
          if (solid.include.empty())
            boxes.include = are_on_line(text) ? to_intervals(text) : to_boxes(text);
        },
        "The domain Omega: boxes 'x0, y0 : x1, y1' separated by ';'; in three dimensions 'x0, y0, "
        "z0 : x1, y1, z1', in one dimension intervals 'x0 : x1'. Distances between parallel sides "
        "must be multiples of every mesh size. "
        "[length]");
    keys.add(
        "holes", "", any_boxes(),
        [this](const std::string &text)
        {
          solid.exclude = to_cuboids(text);
          boxes.exclude = !solid.exclude.empty() ? std::vector<geometry::Box>()
                          : are_on_line(text)    ? to_intervals(text)
                                                 : to_boxes(text);
        },
        "Boxes removed from the domain, written like boxes. [length]");
    keys.add("mesh", mesh.name,
             "lattice: the boxes divided into uniform squares that share one stencil. squares, "
             "triangles: the same boxes as a mesh with its own matrix entries. A file .msh, or "
             ".geo, whose physical surfaces are named omega... (the "
             "domain) and collar... (the interaction domain); with Domain/dimension = 3 physical "
             "volumes, meshed with tetrahedra or hexahedra. In a .geo the line 'DefineConstant[ h "
             "= 0.1, delta "
             "= 0.3 ];' "
             "lets each level set its own h and horizon. Or the name of a deal.II generator, "
             "e.g. hyper_ball_balanced. gmsh meshes .geo files in a separate process with limits "
             "(120 CPU seconds, 4 GiB; the environment variables PLUMBLINE_GMSH_SECONDS and "
             "PLUMBLINE_GMSH_GIBIBYTES change them); commands that start programs or write files "
             "(SystemCall, Save, Print, Plugin, ...) are refused.");
    keys.add("arguments", mesh.arguments,
             "Arguments of the deal.II generator, e.g. '0, 0 : 1'. Its cells must cover the "
             "interaction domain too.");
    keys.add("inside", mesh.inside,
             "For a generator: an expression in x, y and delta that is positive in Omega, e.g. '(1 "
             "- delta)^2 - x^2 - y^2'.");
    keys.add("map", mesh.map,
             "For squares and triangles: mapping of the vertices, two expressions in x and y; e.g. "
             "'sign(x)*abs(x)^1.5, y' grades the mesh. Empty: identity.");
    keys.add(
        "sides", mesh.is_curved, "straight", "curved",
        "Sides of the triangles of a .geo file, or of a .msh file of second to fourth order. "
        "straight: between the corners. curved: sides on curves are approximated by four straight "
        "segments that preserve the area, which reduces the geometry error from h^2 to h^4; for "
        "Galerkin methods of degree 2 at most with exact entries, and for meshfree methods.");
    keys.add(
        "interaction domain", automatic, any_text(),
        [this](const std::string &text)
        {
          collar.reset();
          if (text != automatic)
            collar = to_number(text);
        },
        "Width of the interaction domain around Omega, where the volume constraint prescribes u: "
        "auto, or a width of at least the largest horizon. [length]");
    declare_boundary(keys);
  }

  void DomainSection::declare_boundary(Keys &keys)
  {
    const auto &words = base::words<Boundary>;
    keys.add(
        "boundary", "constrained", one_of({words.begin(), words.end()}),
        [this](const std::string &text)
        {
          const auto boundary = base::from_word<Boundary>(text);
          is_free_body = boundary == Boundary::free;
          is_periodic = boundary == Boundary::periodic;
        },
        "constrained: u is prescribed in the interaction domain all around Omega. free: no "
        "interaction domain; families are truncated at the boundary, and u is prescribed in "
        "Domain/fixed (Material/model = variational). The body is one box (Domain/mesh = lattice), "
        "or the union of the cells of a mesh, clipped to which the squares around the nodes are "
        "node cells; without boxes the nodes are on h Z^2. periodic: one box as a torus "
        "(Material/model = double well). In three dimensions free needs a mesh file; u is "
        "prescribed in its physical volumes whose names begin with 'collar'.");
    keys.add(
        "fixed", "", any_text(),
        [this](const std::string &text)
        {
          is_floating = text == none;
          fixed = is_floating ? std::vector<geometry::Box>() : to_boxes(text);
        },
        "Boxes where u is prescribed in a free body, written like boxes: at nodes whose cell "
        "overlaps a box (the grips of 'plumbline grow' too, on meshes at nodes in a box), and in "
        "mesh cells whose centroid is in a box. none: the body is unconstrained and has rigid-body "
        "modes; 'plumbline stability' "
        "analyses it, 'plumbline run' refuses it. In three dimensions ('plumbline grow') each box "
        "given in x and y extends through the whole thickness along z. [length]");
    keys.add(
        "cracks", "", lines(),
        [this](const std::string &text) { cracks = to_lines(text, lines()); },
        "Cracks as polylines 'x0, y0 : x1, y1', with more points for bends, separated by ';'. "
        "Bonds across them are broken in meshfree methods, and for bond-based materials in "
        "Galerkin methods as well; Material/model = LPS makes the crack faces traction-free. In "
        "three dimensions ('plumbline grow') a polyline in x and y extends along z through the "
        "whole body. [length]");
    keys.add("outside", outside,
             "An expression in x, y and delta that is positive beyond free surfaces: nodes of the "
             "interaction domain with a positive value are removed (Material/model = LPS).");
  }
} // namespace plumbline::scene
