#include "geometry/mesh_input.h"

#include "base/error.h"
#include "base/number_text.h"
#include "geometry/curved_mesh.h"
#include "geometry/gmsh_process.h"
#include "geometry/gmsh_script.h"
#include "geometry/hexahedron.h"
#include "geometry/msh_file.h"
#include "geometry/tetrahedral_check.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace plumbline::geometry
{
  namespace
  {
    /// The collar is as wide as asked for up to this fraction: h times a count is rounded.
    constexpr double rounding = 1e-10;

    /// A layer of squares that widens the collar by less than this fraction of delta leads nowhere.
    constexpr double least_gain = 1e-3;

    /// Cells of some 100 bytes, with as much again for their sides.
    constexpr double most_cells = 1e7;

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
      for (WholeCell &whole : mesh.wholes)
      {
        for (unsigned int i = 0; i < whole.corners.n_vertices; ++i)
          whole.corners.vertex[i] = number[whole.corners.vertex[i]];
        for (unsigned int &vertex : whole.outline)
          vertex = number[vertex];
      }
      mesh.vertices = std::move(used);
    }

    void drop_unused_vertices(TetrahedralMesh &mesh)
    {
      constexpr auto unused = static_cast<unsigned int>(-1);
      std::vector<unsigned int> number(mesh.vertices.size(), unused);
      std::vector<dealii::Point<3>> used;
      const auto keep = [&](unsigned int &vertex)
      {
        unsigned int &place = number[vertex];
        if (place == unused)
        {
          place = static_cast<unsigned int>(used.size());
          used.push_back(mesh.vertices[vertex]);
        }
        vertex = place;
      };
      for (auto &cell : mesh.cells)
        std::for_each(cell.begin(), cell.end(), keep);
      for (auto &cell : mesh.hexahedra)
        std::for_each(cell.begin(), cell.end(), keep);
      mesh.vertices = std::move(used);
    }

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

    /// The mesh without vertices that no cell uses, checked; `source` opens the message.
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

    // ---- deal.II's generators -------------------------------------------------------------------

    /// Numbers of cells are whole numbers; deal.II makes what it is told, some square them, and
    /// negative ones hang or crash it. Which arguments they are is for deal.II to know: lengths
    /// that look like them are refused, too, where they do not stand in a point.
    void check_counts(const std::string &generator, const std::string &arguments,
                      const std::string &source)
    {
      static const std::array<std::string, 2> counts_first = {"hyper_cross", "cheese"};
      const double most = std::floor(std::sqrt(most_cells));
      const bool begins_with_counts =
          generator.compare(0, 10, "subdivided") == 0 ||
          std::find(counts_first.begin(), counts_first.end(), generator) != counts_first.end();
      std::istringstream all(arguments);
      bool is_first = true;
      for (std::string argument; std::getline(all, argument, ':'); is_first = false)
      {
        const bool is_list = argument.find(',') != std::string::npos;
        std::replace(argument.begin(), argument.end(), ',', ' ');
        std::replace(argument.begin(), argument.end(), ';', ' ');
        std::istringstream words(argument);
        for (std::string word; words >> word;)
        {
          if (word.find_first_not_of("+-0123456789") != std::string::npos)
            continue;
          const double number = std::strtod(word.c_str(), nullptr);
          const bool may_be_negative = is_first ? !begins_with_counts : is_list;
          if (std::abs(number) > most || (number < 0 && !may_be_negative))
            throw InputError(source + ": " + word + " may be a number of cells, of which 0 to " +
                             base::to_text(most, 6) +
                             " along a side are allowed; give another, which h "
                             "refines, or write a length with its decimal point, '" +
                             word + ".'");
        }
      }
    }

    /// deal.II's words in ours.
    std::string generator_fault(const std::string &words)
    {
      const auto has = [&](const char *part) { return words.find(part) != std::string::npos; };
      const std::string remedy =
          "; see deal.II's namespace GridGenerator, and give the name by "
          "Domain/mesh and all arguments by Domain/arguments, separated by ':'";
      if (has("not implemented") || has("unknown"))
        return "is not known: deal.II has no such generator of meshes in the plane" + remedy;
      if (has("pattern") || has("number of"))
        return "does not fit: too few or too many arguments, or one of another kind" + remedy;
      return "cannot be made: its arguments are out of range" + remedy;
    }

    /// Until no side is longer than h.
    void refine_to(dealii::Triangulation<2> &triangulation, double h, const std::string &source)
    {
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
          throw InputError(source + ": h = " + base::to_text(h, 6) + " makes more than " +
                           base::to_text(most_cells, 6) + " cells; choose a larger h");
        triangulation.refine_global();
      }
    }

    // ---- gmsh -----------------------------------------------------------------------------------

    bool ends_with(const std::string &word, const std::string &end)
    {
      return word.size() >= end.size() &&
             word.compare(word.size() - end.size(), end.size(), end) == 0;
    }

    /// A .msh file, or what gmsh makes of a .geo file, as a text that read_msh reads.
    std::string text_of_mesh(const std::string &file, double h, double delta,
                             const std::string &source, unsigned int order, unsigned int dimension)
    {
      const bool is_script = ends_with(file, ".geo");
      if (!is_script && !ends_with(file, ".msh"))
        throw InputError(source + " is of unknown kind; its name must end in .msh or .geo");
      if (!(h > 0) || !std::isfinite(h) || !std::isfinite(delta))
        throw InputError(source + ": h = " + base::to_text(h, 6) +
                         " and delta = " + base::to_text(delta, 6) + " must be lengths");
      if (is_script)
      {
        check_script(file);
        return mesh_by_gmsh(file, h, delta, GmshLimits::from_environment(), source, order,
                            dimension);
      }
      std::ifstream in(file, std::ios::binary);
      if (!in || std::filesystem::is_directory(file))
        throw InputError(source + " cannot be read; check its name and folder");
      std::string msh;
      msh.assign(std::istreambuf_iterator<char>(in), {});
      return is_other_msh(msh) ? convert_by_gmsh(file, GmshLimits::from_environment(), source)
                               : msh;
    }

    /// Of triangles whose points between corners tell the curves: more than four would add nothing
    /// to four straight parts of a side.
    constexpr unsigned int order_of_curves = 4;

    Mesh bend(const Mesh &mesh, const SideCurves &curves, const std::string &source)
    {
      try
      {
        Mesh bent = follow_curves(mesh, curves);
        if (bent.cells.size() > mesh.cells.size())
          return bent;
      }
      catch (const InputError &error)
      {
        throw InputError(source + ": " + error.what());
      }
      throw InputError(source +
                       " has no curved side, but Domain/sides = curved asks for such; export a "
                       ".msh file with Mesh.ElementOrder = 2, 3 or 4, take a .geo file with "
                       "curves, or write Domain/sides = straight");
    }

    /// A file's cells may run either way, each its own.
    void turn_clockwise_cells(Mesh &mesh)
    {
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        if (MeshCell &cell = mesh.cells[c]; area(mesh.polygon(c)) < 0)
          std::reverse(cell.vertex.begin(), cell.vertex.begin() + cell.n_vertices);
    }

    /// Hexahedra that are turned inside out run from their upper face to the lower one instead.
    TetrahedralMesh cut_hexahedra(TetrahedralMesh mesh)
    {
      const dealii::Point<3> middle(.5, .5, .5);
      for (std::size_t k = 0; k < mesh.hexahedra.size(); ++k)
        if (auto &cell = mesh.hexahedra[k];
            dealii::determinant(Hexahedron(mesh, k).jacobian(middle)) < 0)
          std::rotate(cell.begin(), cell.begin() + 4, cell.end());
      TetrahedralMesh cut = six_per_hexahedron(std::move(mesh.vertices), std::move(mesh.hexahedra),
                                               mesh.is_inside, mesh.group);
      cut.groups = std::move(mesh.groups);
      return cut;
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

  Mesh read_mesh(const std::string &file, double h, double delta, bool has_collar, bool is_curved)
  {
    const std::string source = "mesh file '" + file + "'",
                      msh =
                          text_of_mesh(file, h, delta, source, is_curved ? order_of_curves : 0, 2);
    SideCurves curves;
    Mesh mesh = read_msh(msh, source, has_collar, is_curved ? &curves : nullptr);
    turn_clockwise_cells(mesh);
    if (is_curved)
      mesh = bend(mesh, curves, source);
    return finish(std::move(mesh), source);
  }

  TetrahedralMesh read_tetrahedra(const std::string &file, double h, double delta)
  {
    const std::string source = "mesh file '" + file + "'";
    TetrahedralMesh mesh = read_msh_tetrahedra(text_of_mesh(file, h, delta, source, 0, 3), source);
    drop_unused_vertices(mesh);
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      if (determinant(mesh, cell) < 0)
        std::swap(mesh.cells[cell][2], mesh.cells[cell][3]);
    if (!mesh.hexahedra.empty())
      mesh = cut_hexahedra(std::move(mesh));
    try
    {
      check_hexahedra(mesh);
      check(mesh);
    }
    catch (const InputError &error)
    {
      throw InputError(source + ": " + error.what());
    }
    return mesh;
  }

  Mesh generate_mesh(const std::string &generator, const std::string &arguments, double h,
                     const std::function<bool(const Point<2> &)> &is_inside)
  {
    if (!(h > 0))
      throw InputError("mesh size h = " + base::to_text(h, 6) + " must be a positive length");
    const std::string source = "mesh generator " + generator + " (" + arguments + ")";
    check_counts(generator, arguments, source);
    dealii::Triangulation<2> triangulation;
    try
    {
      dealii::GridGenerator::generate_from_name_and_arguments(triangulation, generator, arguments);
      refine_to(triangulation, h, source);
    }
    catch (const dealii::ExceptionBase &error)
    {
      std::ostringstream words;
      error.print_info(words);
      throw InputError(source + " " + generator_fault(words.str()));
    }
    catch (const std::invalid_argument &) // of the standard library, where it converts arguments
    {
      throw InputError(source + " " + generator_fault(""));
    }
    catch (const std::out_of_range &)
    {
      throw InputError(source + " " + generator_fault(""));
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
        throw InputError(
            "the map keeps the collar from becoming delta = " + base::to_text(delta, 6) +
            " wide: after " + std::to_string(n_added) + " more layers it is " +
            base::to_text(width, 6) + "; choose a Domain/map that widens it or a smaller delta");
      last_width = width;
    }
  }
} // namespace plumbline::geometry
