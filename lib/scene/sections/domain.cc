#include "base/error.h"
#include "base/text_file.h"
#include "scene/keys.h"
#include "scene/mesh_files.h"
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
    const auto &words = base::words<Boundary>;
    mesh_files = std::make_shared<MeshFiles>();
    keys.add("dimension", dimension, count(1, 2),
             "2: the plane. 1: a line, the first axis of the boxes; expressions are of x and have "
             "one component (motions of Material/model = double well with Domain/boundary = "
             "periodic).");
    keys.add(
        "boxes", "0, 0 : 1, 1", scene::boxes(),
        [this](const std::string &text) { boxes.include = to_boxes(text); },
        "The domain Omega: boxes 'x0, y0 : x1, y1' separated by ';'. Every side must be a multiple "
        "of each mesh size from the others. [length]");
    keys.add(
        "holes", "", scene::boxes(),
        [this](const std::string &text) { boxes.exclude = to_boxes(text); },
        "Boxes to take out again, written like boxes. [length]");
    keys.add("mesh", mesh.name,
             "lattice: the boxes in uniform squares, one stencil for all. squares, triangles: the "
             "same as a mesh with entries of its own. A file .msh, or .geo with the constants h "
             "and delta, and physical surfaces omega... and collar...; or one of deal.II's "
             "generators by name, e.g. hyper_ball_balanced. gmsh meshes .geo files as a process of "
             "its own with limits (120 CPU seconds, 4 GiB; the environment's "
             "PLUMBLINE_GMSH_SECONDS and PLUMBLINE_GMSH_GIBIBYTES change them); commands that "
             "start programs or write files (SystemCall, Save, Print, Plugin, ...) are refused.");
    keys.add("arguments", mesh.arguments,
             "Of a generator, as deal.II takes them, e.g. '0, 0 : 1'. Its cells must reach over "
             "the collar.");
    keys.add("inside", mesh.inside,
             "Of a generator: an expression in x, y and delta that is positive in Omega, e.g. '(1 "
             "- delta)^2 - x^2 - y^2'.");
    keys.add("map", mesh.map,
             "Of squares and triangles: where their vertices go, 'x, y' as expressions; e.g. "
             "'sign(x)*abs(x)^1.5, y' grades the mesh. Empty: they stay.");
    keys.add("sides", mesh.is_curved, "straight", "curved",
             "Of the triangles of a .geo file, or of a .msh file of second to fourth order. "
             "straight: between their corners. curved: sides on curves follow them, by four "
             "straight parts that keep the area, so that Omega is the domain to h^4 and not to "
             "h^2; for Galerkin methods of degree 2 at most with exact entries, and for meshfree "
             "methods.");
    keys.add(
        "collar", automatic, any_text(),
        [this](const std::string &text)
        {
          collar.reset();
          if (text != automatic)
            collar = to_number(text);
        },
        "Width of the interaction collar where the volume constraint gives u: auto, or a width of "
        "at least the largest horizon. [length]");
    keys.add(
        "boundary", "constrained", one_of({words.begin(), words.end()}),
        [this](const std::string &text)
        {
          const auto boundary = base::from_word<Boundary>(text);
          is_free_body = boundary == Boundary::free;
          is_periodic = boundary == Boundary::periodic;
        },
        "constrained: u is given all around Omega, in its collar. free: no collar; families "
        "end at the boundary, and u is given in Domain/fixed (Material/model = variational). "
        "The body is one box (Domain/mesh = lattice), or whatever the cells of a mesh cover; "
        "they cut the squares about the nodes, which are hZ^2 where no boxes set them. periodic: "
        "one box "
        "as a torus (Material/model = double well).");
    keys.add(
        "fixed", "", any_text(),
        [this](const std::string &text)
        {
          is_floating = text == none;
          fixed = is_floating ? std::vector<geometry::Box>() : to_boxes(text);
        },
        "Boxes where u is given in a free body, written like boxes: of nodes whose cell shares "
        "area with them (by 'plumbline grow' too: its grips), of mesh cells whose centroid is in "
        "them. none: the body can move as a "
        "whole; 'plumbline stability' measures it, and run refuses it. [length]");
    keys.add(
        "cracks", "", lines(),
        [this](const std::string &text) { cracks = to_lines(text, lines()); },
        "Cracks as lines 'x0, y0 : x1, y1', with more points where they bend, separated by ';'. "
        "Bonds across them are broken: by rules, and of bond-based materials by Galerkin methods "
        "as well; Material/model = LPS makes their faces free of traction. [length]");
    keys.add("outside", outside,
             "An expression in x, y and delta that is positive beyond free surfaces: nodes of the "
             "collar there carry no data (Material/model = LPS).");
  }
} // namespace plumbline::scene
