#include "scene/new_mesh.h"

#include "base/error.h"
#include "base/number_text.h"
#include "base/text_file.h"
#include "geometry/mesh_input.h"
#include "geometry/tetrahedral_check.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <regex>

namespace plumbline::scene
{
  namespace
  {
    constexpr std::size_t most_bytes = 1'000'000'000;

    constexpr auto quadrilaterals = "quadrilaterals";

    struct Sizes
    {
      double h = 0, delta = 0;
    };

    /// What DefineConstant gives h and delta.
    std::optional<Sizes> sizes_of_script(const std::string &text)
    {
      static const std::regex constants("DefineConstant\\s*\\[([^\\]]*)\\]");
      std::smatch found;
      if (!std::regex_search(text, found, constants))
        return {};
      const std::string inside = found[1].str();
      const auto value_of = [&](const std::string &name)
      {
        const std::regex given("(^|[^A-Za-z0-9_])" + name + "\\s*=\\s*\\{?\\s*([0-9.eE+-]+)");
        std::smatch value;
        return std::regex_search(inside, value, given) ? std::atof(value[2].str().c_str()) : 0;
      };
      const Sizes sizes{value_of("h"), value_of("delta")};
      return sizes.h > 0 && sizes.delta > 0 ? std::optional<Sizes>(sizes) : std::nullopt;
    }

    bool is_in_space(const std::string &text, bool is_script)
    {
      static const std::regex volume("Physical\\s+Volume"), name("\n3\\s+[0-9]+\\s+\"");
      return std::regex_search(text, is_script ? volume : name);
    }

    /// Two digits, so that the file is easy to read.
    std::string short_text(double value)
    {
      return base::to_text(value, 2);
    }

    struct Found
    {
      std::size_t n_cells = 0;
      std::string cells;
      double side = 0, width = 0; ///< longest side of Ω's cells, width of the collar
      std::vector<std::string> groups;
    };

    Found in_plane(const std::string &file, const Sizes &sizes)
    {
      const geometry::Mesh mesh = geometry::read_mesh(file, sizes.h, sizes.delta);
      return {mesh.cells.size(),
              mesh.is_triangles() ? "triangles"
              : mesh.is_quads()   ? quadrilaterals
                                  : "triangles and quadrilaterals",
              mesh.longest_side(), geometry::collar_width(mesh), mesh.groups};
    }

    Found in_space(const std::string &file, const Sizes &sizes)
    {
      const geometry::TetrahedralMesh mesh = geometry::read_tetrahedra(file, sizes.h, sizes.delta);
      Found found{mesh.cells.size(), "tetrahedra", 0, 0, {}};
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (unsigned int i = 0; i < 4 && mesh.is_inside[c] != 0; ++i)
          for (unsigned int j = 0; j < i; ++j)
            found.side =
                std::max(found.side,
                         mesh.vertices[mesh.cells[c][i]].distance(mesh.vertices[mesh.cells[c][j]]));
      constexpr double far = 4; // horizons in space are shorter
      found.width = geometry::collar_width(mesh, far * found.side);
      return found;
    }
  } // namespace

  NewMesh look_at_mesh(const std::string &file)
  {
    const bool is_script = base::has_ending(file, ".geo");
    std::error_code error;
    if (!is_script && !base::has_ending(file, ".msh"))
      throw InputError("--domain = '" + file +
                       "' is not known; give square, cube, or a mesh file .geo or .msh");
    if (!std::filesystem::exists(file, error))
      throw InputError("--domain: mesh file '" + file +
                       "' is not there; give a .geo or .msh file, square or cube");
    const std::string text = base::read_text_file(file, "--domain: mesh file '" + file + "'",
                                                  most_bytes, "a .geo or .msh file");
    NewMesh mesh;
    mesh.dimension = is_in_space(text, is_script) ? 3 : 2;
    const auto given = is_script ? sizes_of_script(text) : std::nullopt;
    // the script's own ratio, but families of four neighbours are too few for rules
    const double least_m = mesh.dimension == 3 ? 2 : 3;
    const Sizes sizes =
        given ? Sizes{given->h, std::max(given->delta, least_m * given->h)} : Sizes{1, 1};
    const Found found = mesh.dimension == 3 ? in_space(file, sizes) : in_plane(file, sizes);
    const double h = given ? sizes.h : found.side, width = given ? sizes.delta : found.width;
    constexpr double tenths = 10;
    const double m = std::floor(tenths * width / h * (1 + 1e-9)) / tenths;
    mesh.is_quadrilaterals = found.cells == quadrilaterals;
    mesh.m = base::to_text(m, 4);
    if (!(m >= 1))
      throw InputError("--domain: the interaction domain of '" + file + "' is " +
                       base::to_text(width, 3) + " wide, less than a mesh size, " +
                       base::to_text(h, 3) +
                       "; widen the physical surfaces collar... to two mesh "
                       "sizes or more, or refine the mesh");
    constexpr int all_digits = 15; // m of them rounded up would be wider than the collar
    mesh.h = base::to_text(h, all_digits);
    const std::vector<double> factors =
        mesh.dimension == 3 ? std::vector<double>{.7} : std::vector<double>{.7, .5, .35};
    for (const double factor : factors)
      if (given)
        mesh.h += ", " + short_text(factor * h);
    std::string groups;
    for (const std::string &group : found.groups)
      groups += (groups.empty() ? ", physical surfaces " : ", ") + group;
    mesh.found = "the mesh has " + std::to_string(found.n_cells) + " " + found.cells + groups +
                 (given ? ", and h and delta of the script change with the level"
                        : ", and is the same at all levels: the scene has one level, and a rate "
                          "needs a .geo file with DefineConstant[ h = " +
                              base::to_text(found.side, 3) +
                              ", delta = " + base::to_text(m * found.side, 3) + " ]");
    return mesh;
  }
} // namespace plumbline::scene
