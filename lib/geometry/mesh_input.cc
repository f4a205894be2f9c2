#include "geometry/mesh_input.h"

#include "base/error.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <gmsh.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace plumbline::geometry
{
  namespace
  {
    /// Out of the plane z = 0 by more than this fraction of the largest coordinate.
    constexpr double off_plane = 1e-10;

    /// The collar is as wide as asked for up to this fraction: h times a count is rounded.
    constexpr double rounding = 1e-10;

    /// A layer of squares that widens the collar by less than this fraction of delta leads nowhere.
    constexpr double least_gain = 1e-3;

    /// Cells of some 100 bytes, with as much again for their sides.
    constexpr double most_cells = 1e7;

    std::string text(double value, int n_digits = 6)
    {
      std::ostringstream out;
      out.precision(n_digits);
      out << value;
      return out.str();
    }

    void drop_unused_vertices(Mesh &mesh)
    {
      constexpr auto unused = static_cast<unsigned int>(-1);
      std::vector<unsigned int> number(mesh.vertices.size(), unused);
      std::vector<Point<2>> used;
      for (MeshCell &cell : mesh.cells)
        for (unsigned int i = 0; i < cell.n_vertices; ++i)
        {
          unsigned int &place = number[cell.vertex[i]];
          if (place == unused)
          {
            place = static_cast<unsigned int>(used.size());
            used.push_back(mesh.vertices[cell.vertex[i]]);
          }
          cell.vertex[i] = place;
        }
      mesh.vertices = std::move(used);
    }

    /// The mesh without vertices that no cell uses, checked; `source` opens the message.
    /// Axis-aligned rectangles begin at their lower left corner, as those of a lattice do.
    void turn_rectangles(Mesh &mesh)
    {
      for (MeshCell &cell : mesh.cells)
        for (unsigned int turn = 0; turn < 3 && cell.n_vertices == 4; ++turn)
        {
          const Point<2> &a = mesh.vertices[cell.vertex[0]], &b = mesh.vertices[cell.vertex[1]];
          if (b[1] == a[1] && b[0] > a[0])
            break;
          std::rotate(cell.vertex.begin(), cell.vertex.begin() + 1, cell.vertex.end());
        }
    }

    Mesh finish(Mesh mesh, const std::string &source)
    {
      drop_unused_vertices(mesh);
      try
      {
        check(mesh);
      }
      catch (const InputError &error)
      {
        throw InputError(source + ": " + error.what());
      }
      turn_rectangles(mesh);
      return mesh;
    }

    // ---- gmsh -----------------------------------------------------------------------------------

    /// Gmsh between initialize and finalize, with the constants h and delta set.
    class Gmsh
    {
    public:
      Gmsh(double h, double delta)
      {
        std::vector<std::string> words{"plumbline", "-setnumber",   "h", text(h, 17), "-setnumber",
                                       "delta",     text(delta, 17)};
        std::vector<char *> arguments;
        for (std::string &word : words)
          arguments.push_back(word.data());
        gmsh::initialize(static_cast<int>(arguments.size()), arguments.data(), false);
        gmsh::option::setNumber("General.Terminal", 0);
      }
      ~Gmsh() { gmsh::finalize(); }
      Gmsh(const Gmsh &) = delete;
      Gmsh &operator=(const Gmsh &) = delete;
    };

    /// Meshes the model. Errors are read from gmsh's log: gmsh's exceptions would have to leave an
    /// OpenMP region, which ends the program.
    void generate()
    {
      gmsh::option::setNumber("General.AbortOnError", 0);
      gmsh::logger::start();
      gmsh::model::mesh::generate(2);
      std::vector<std::string> log;
      gmsh::logger::get(log);
      gmsh::logger::stop();
      const std::string mark = "Error: ";
      for (const std::string &line : log)
        if (line.compare(0, mark.size(), mark) == 0)
          throw line.substr(mark.size());
    }

    bool ends_with(const std::string &word, const std::string &end)
    {
      return word.size() >= end.size() &&
             word.compare(word.size() - end.size(), end.size(), end) == 0;
    }

    bool begins_with(std::string word, const std::string &begin)
    {
      std::transform(word.begin(), word.end(), word.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      return word.compare(0, begin.size(), begin) == 0;
    }

    struct Surface
    {
      int entity;
      bool is_inside;
      std::string name;
    };

    std::vector<Surface> physical_surfaces(bool wants_collar)
    {
      gmsh::vectorpair groups;
      gmsh::model::getPhysicalGroups(groups, 2);
      std::vector<Surface> surfaces;
      std::string names;
      bool has_omega = false, has_collar = false, has_other = false;
      for (const auto &[dimension, group] : groups)
      {
        std::string name;
        gmsh::model::getPhysicalName(dimension, group, name);
        const bool is_omega = begins_with(name, "omega"), is_collar = begins_with(name, "collar");
        has_omega = has_omega || is_omega;
        has_collar = has_collar || is_collar;
        has_other = has_other || !(is_omega || (is_collar && wants_collar));
        names += (names.empty() ? "" : ", ") +
                 (name.empty() ? "number " + std::to_string(group) : "'" + name + "'");
        std::vector<int> entities;
        gmsh::model::getEntitiesForPhysicalGroup(dimension, group, entities);
        for (const int entity : entities)
          surfaces.push_back({entity, is_omega, name});
      }
      if (!has_omega || has_collar != wants_collar || has_other)
        throw InputError("has the physical surfaces " + (names.empty() ? "(none)" : names) +
                         (wants_collar
                              ? "; give names that begin with 'omega' and 'collar', at least one "
                                "of each and no others"
                              : "; a body with a free boundary has no collar: give names that "
                                "begin with 'omega', at least one and no others"));
      return surfaces;
    }

    /// Vertices of the whole model, and cells of the physical surfaces.
    Mesh model(bool has_collar)
    {
      Mesh mesh;
      std::vector<std::size_t> tags;
      std::vector<double> coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters);
      std::map<std::size_t, unsigned int> number;
      double largest = 0, height = 0;
      for (std::size_t i = 0; i < tags.size(); ++i)
      {
        const double *const at = &coordinates[3 * i];
        number[tags[i]] = static_cast<unsigned int>(i);
        mesh.vertices.emplace_back(at[0], at[1]);
        largest = std::max({largest, std::abs(at[0]), std::abs(at[1])});
        height = std::max(height, std::abs(at[2]));
      }
      if (height > off_plane * largest)
        throw InputError("reaches z = " + text(height) +
                         "; only triangles and quadrilaterals in the plane z = 0 are allowed");

      for (const Surface &surface : physical_surfaces(has_collar))
      {
        if (mesh.groups.empty() || mesh.groups.back() != surface.name)
          mesh.groups.push_back(surface.name);
        const auto group = static_cast<unsigned int>(mesh.groups.size() - 1);
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, 2, surface.entity);
        for (std::size_t t = 0; t < types.size(); ++t)
        {
          if (types[t] != 2 && types[t] != 3)
            throw InputError("has cells of gmsh's type " + std::to_string(types[t]) +
                             "; only triangles and quadrilaterals of first order are allowed "
                             "(Mesh.ElementOrder = 1)");
          const unsigned int n = types[t] == 2 ? 3 : 4;
          for (std::size_t first = 0; first < nodes[t].size(); first += n)
          {
            MeshCell cell{{}, n, surface.is_inside, group};
            for (unsigned int i = 0; i < n; ++i)
              cell.vertex[i] = number.at(nodes[t][first + i]);
            mesh.cells.push_back(cell);
          }
        }
      }
      return mesh;
    }

    void turn_if_clockwise(Mesh &mesh)
    {
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        if (area(mesh.polygon(c)) >= 0)
          return;
      for (MeshCell &cell : mesh.cells)
        std::reverse(cell.vertex.begin(), cell.vertex.begin() + cell.n_vertices);
    }

    // ---- lattices -------------------------------------------------------------------------------

    /// The squares of Ω and those less than `reach` from it.
    Mesh squares(const Lattice &lattice, double reach)
    {
      const auto &n = lattice.n_cells();
      const double cells = reach / lattice.h() * (1 - rounding);
      const int margin = static_cast<int>(std::ceil(cells));
      const int width = n[0] + 2 * margin, height = n[1] + 2 * margin;
      const auto index = [=](int i, int j)
      { return static_cast<std::size_t>(j + margin) * width + i + margin; };
      std::vector<char> is_taken(static_cast<std::size_t>(width) * height);
      const auto gap = [](int offset) { return std::max(std::abs(offset) - 1, 0); };
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
        {
          const bool is_within = lattice.is_inside(i - 1, j) && lattice.is_inside(i + 1, j) &&
                                 lattice.is_inside(i, j - 1) && lattice.is_inside(i, j + 1);
          const int around = is_within ? 0 : margin;
          for (int dj = -around; lattice.is_inside(i, j) && dj <= around; ++dj)
            for (int di = -around; di <= around; ++di)
              if (std::hypot(gap(di), gap(dj)) < cells || (di == 0 && dj == 0))
                is_taken[index(i + di, j + dj)] = true;
        }

      Mesh mesh;
      const auto vertex = [=](int i, int j)
      { return static_cast<unsigned int>((j + margin) * (width + 1) + i + margin); };
      for (int j = -margin; j <= n[1] + margin; ++j)
        for (int i = -margin; i <= n[0] + margin; ++i)
          mesh.vertices.push_back(lattice.point(i, j));
      for (int j = -margin; j < n[1] + margin; ++j)
        for (int i = -margin; i < n[0] + margin; ++i)
          if (is_taken[index(i, j)])
            mesh.cells.push_back(
                {{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)},
                 4,
                 lattice.is_inside(i, j)});
      return mesh;
    }

    void halve_quads(Mesh &mesh)
    {
      std::vector<MeshCell> halves;
      for (const MeshCell &cell : mesh.cells)
      {
        const auto &v = cell.vertex;
        halves.push_back({{v[0], v[1], v[2]}, 3, cell.is_inside});
        halves.push_back({{v[0], v[2], v[3]}, 3, cell.is_inside});
      }
      mesh.cells = std::move(halves);
    }
  } // namespace

  Mesh read_mesh(const std::string &file, double h, double delta, bool has_collar)
  {
    const std::string source = "mesh file '" + file + "'";
    const bool is_script = ends_with(file, ".geo");
    if (!is_script && !ends_with(file, ".msh"))
      throw InputError(source + " is of unknown kind; its name must end in .msh or .geo");
    if (!std::ifstream(file))
      throw InputError(source + " cannot be read; check its name and folder");

    const Gmsh session(h, delta);
    Mesh mesh;
    try
    {
      gmsh::open(file);
      if (is_script)
        generate();
      mesh = model(has_collar);
    }
    catch (const std::string &error) // gmsh's own
    {
      throw InputError(source + " is refused by gmsh: " + error + "; mend the file");
    }
    catch (const InputError &error)
    {
      throw InputError(source + " " + error.what());
    }
    turn_if_clockwise(mesh);
    return finish(std::move(mesh), source);
  }

  Mesh generate_mesh(const std::string &generator, const std::string &arguments, double h,
                     const std::function<bool(const Point<2> &)> &is_inside)
  {
    if (!(h > 0))
      throw InputError("mesh size h = " + text(h) + " must be a positive length");
    const std::string source = "mesh generator " + generator + " (" + arguments + ")";
    dealii::Triangulation<2> triangulation;
    try
    {
      dealii::GridGenerator::generate_from_name_and_arguments(triangulation, generator, arguments);
    }
    catch (const dealii::ExceptionBase &error)
    {
      std::stringstream words;
      error.print_info(words);
      std::string sentence;
      for (std::string word; words >> word;)
        sentence += " " + word;
      throw InputError(
          source + " is refused by deal.II:" + sentence +
          "; give one of its GridGenerator functions (Domain/mesh) with all its arguments "
          "(Domain/arguments)");
    }
    const auto longest_side = [&]
    {
      double longest = 0;
      for (const auto &face : triangulation.active_face_iterators())
        longest = std::max(longest, face->vertex(0).distance(face->vertex(1)));
      return longest;
    };
    for (double longest = longest_side(); longest > h; longest = longest_side())
    {
      if (std::pow(longest / h, 2) * triangulation.n_active_cells() > most_cells)
        throw InputError(source + ": h = " + text(h) + " makes more than " + text(most_cells) +
                         " cells; choose a larger h");
      triangulation.refine_global();
    }

    Mesh mesh;
    mesh.vertices = triangulation.get_vertices();
    for (const auto &cell : triangulation.active_cell_iterators())
      mesh.cells.push_back({{cell->vertex_index(0), cell->vertex_index(1), cell->vertex_index(3),
                             cell->vertex_index(2)},
                            4,
                            is_inside(cell->center())});
    return finish(std::move(mesh), source);
  }

  Mesh lattice_mesh(const Domain &domain, double h, double delta, bool is_triangles,
                    const std::function<Point<2>(const Point<2> &)> &map)
  {
    const std::string after_map = "choose another Domain/map: the map must leave the squares of "
                                  "the boxes convex and not turn them over, but after it";
    const Lattice lattice(domain, h);
    double last_width = 0;
    for (unsigned int n_added = 0;; ++n_added)
    {
      Mesh mesh = squares(lattice, delta + n_added * h);
      if (is_triangles)
        halve_quads(mesh);
      drop_unused_vertices(mesh); // before the map, which need not be defined there
      if (map)
        std::transform(mesh.vertices.begin(), mesh.vertices.end(), mesh.vertices.begin(), map);
      mesh = finish(std::move(mesh), map ? after_map : "mesh of boxes");
      const double width = collar_width(mesh);
      if (!map || width >= delta * (1 - rounding))
        return mesh;
      if (width < last_width + least_gain * delta)
        throw InputError("the map keeps the collar from becoming delta = " + text(delta) +
                         " wide: after " + std::to_string(n_added) + " more layers it is " +
                         text(width) + "; choose a Domain/map that widens it or a smaller delta");
      last_width = width;
    }
  }
} // namespace plumbline::geometry
