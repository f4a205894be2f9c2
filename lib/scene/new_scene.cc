#include "scene/new_scene.h"

#include "base/error.h"
#include "base/similar_words.h"
#include "base/text_file.h"
#include "physics/kernel.h"
#include "scene/new_mesh.h"
#include "scene/scene.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>

namespace plumbline::scene
{
  namespace
  {
    namespace fs = std::filesystem;

    constexpr auto square = "square", cube = "cube", elastic = "elastic", scalar = "scalar",
                   crack = "crack", bar = "variational";

    /// The profile that a kernel type leaves to the scene: for a start one that falls to 0 at the
    /// horizon, or does nearly.
    /// @param table  beside the scene
    std::vector<Override> profile_of(const std::string &kernel, const fs::path &table)
    {
      const auto &types = physics::kernel_types();
      const auto type = std::find_if(types.begin(), types.end(),
                                     [name = base::to_lower(kernel)](const auto &one)
                                     { return one.name == name; });
      if (type == types.end() || type->key.empty())
        return {};
      const std::map<std::string, std::string> values = {
          {"coefficients", "1, -1"}, {"width", "0.5"}, {"table file", table.filename().string()}};
      return {{"Kernel/" + std::string(type->key), values.at(type->key)}};
    }

    /// Units of a scene that is written in SI units, and what its keys mean.
    std::string with_units(const std::string &text)
    {
      const std::map<std::string, std::string> units = {
          {"Domain/boxes", "m"},
          {"Material/E", "Pa; bonds have nu = 1/4 in plane strain"},
          {"Material/toughness", "G_c, J/m^2"},
          {"Time/density", "kg/m^3"},
          {"Time/final time", "s"},
          {"Crack/notch", "m, from the left end along the midline"},
          {"Crack/load", "strain energy of the strip relative to the threshold of growth"},
          {"Study/m", "horizon / h"},
          {"Study/h", "m; several values show how the result depends on h"}};
      constexpr std::size_t column = 46; // of the comments
      std::string result;
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);)
      {
        const std::size_t from = std::string("set ").size(),
                          to = std::min(line.find(" = "), line.size());
        const auto unit = units.find(line.substr(from, to - from));
        if (unit != units.end())
        {
          line.resize(std::max(line.size() + 1, column), ' ');
          line += "# " + unit->second;
        }
        result += line + '\n';
      }
      return result;
    }

    std::vector<Override> changes_of_cube(bool is_scalar)
    {
      return {{"Domain/dimension", "3"},
              {"Domain/boxes", "0, 0, 0 : 1, 1, 1"},
              {"Problem/solution", is_scalar ? "x^3 + 2*y^2*z^2" : "x^3*y^2, y^2*z^3, x^2*z + y^3"},
              {"Methods/names", "FA, IPA-AC, IPA-AC-R2, Q1"},
              {"Study/h", "0.25, 0.125, 0.0625, 0.03125"},
              {"Study/norms", "nodal Linf, averages L2"}};
    }

    /// Straight sides replace curved outlines, so that methods are compared by averages over cells.
    std::vector<Override> changes_of_mesh(const NewMesh &mesh, const std::string &name,
                                          bool is_scalar)
    {
      std::vector<Override> changes = {{"Domain/mesh", name}};
      if (mesh.dimension == 3)
      {
        changes.push_back({"Domain/dimension", "3"});
        changes.push_back(
            {"Problem/solution", is_scalar ? "x^3 + 2*y^2*z^2" : "x^3*y^2, y^2*z^3, x^2*z + y^3"});
      }
      // on hexahedra Q1 has entries of scalar kernels only
      const std::string space = !mesh.is_quadrilaterals             ? ", P1"
                                : mesh.dimension == 3 && !is_scalar ? ""
                                                                    : ", Q1";
      if (mesh.dimension == 3)
        changes.push_back({"Methods/nodes", "mesh"});
      const std::vector<Override> rest = {{"Methods/names", "FA, IPA-AC, IPA-AC-R2" + space},
                                          {"Study/m", mesh.m},
                                          {"Study/h", mesh.h},
                                          {"Study/norms", "averages L2"},
                                          {"Study/decisive error", "averages L2 | exact"}};
      changes.insert(changes.end(), rest.begin(), rest.end());
      return changes;
    }

    /// @param note  set where a mesh file is read
    std::vector<Override> changes_of(const NewSceneOptions &options, const fs::path &folder,
                                     const fs::path &table, std::string &note)
    {
      std::vector<Override> changes;
      const bool is_scalar = options.kind == scalar, is_bar = options.kind == bar;
      if (options.kind == crack && options.domain != square)
        throw InputError("--domain = '" + options.domain +
                         "', but a crack runs in a strip; leave it out, and change Domain/boxes in "
                         "the scene");
      if (is_bar && options.domain != square)
        throw InputError("--domain = '" + options.domain +
                         "', but --kind variational allows square only: its scene is a bar that is "
                         "pulled, made of boxes in two dimensions; leave --domain out, and change "
                         "Domain/boxes and Domain/fixed in the scene");
      if (options.domain == cube)
        changes = changes_of_cube(is_scalar);
      else if (options.domain != square)
      {
        const NewMesh mesh = look_at_mesh(options.domain);
        note = mesh.found;
        changes = changes_of_mesh(mesh, fs::proximate(options.domain, folder).string(), is_scalar);
      }
      if (!options.kernel.empty())
      {
        changes.push_back({"Kernel/type", options.kernel});
        for (const Override &one : profile_of(options.kernel, table))
          changes.push_back(one);
        // of a profile of one's own a polynomial of the third degree shows round-off, and no rate
        if (options.kernel.find("table") != std::string::npos && options.domain == square &&
            is_scalar)
          changes.push_back({"Problem/solution", "sin(2*x)*cos(y)"});
      }
      if (!options.methods.empty())
        changes.push_back({"Methods/names", options.methods});
      return changes;
    }

    /// Fails where the file exists, even if it is made meanwhile.
    void write_new_file(const fs::path &file, const std::string &text)
    {
      std::FILE *const stream = std::fopen(file.c_str(), "wx");
      if (stream == nullptr && errno == EEXIST)
        throw InputError("'" + file.string() +
                         "' is there already and is not overwritten; give another name");
      const bool is_written = stream != nullptr && std::fputs(text.c_str(), stream) >= 0;
      const int reason = errno;
      if ((stream != nullptr && std::fclose(stream) != 0) || !is_written)
        throw InputError("'" + file.string() + "' cannot be written (" + std::strerror(reason) +
                         "); give a name in a folder that exists and can be written");
    }
  } // namespace

  NewScene write_new_scene(const NewSceneOptions &options)
  {
    NewScene written;
    fs::path file = options.name;
    if (!base::has_ending(file.string(), ".prm"))
      file += ".prm";
    fs::path table = file;
    table.replace_extension(".csv");
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const auto changes = changes_of(options, folder, table, written.note);
    const std::string text =
        short_template(options.kind == elastic ? "tensor" : options.kind, changes);
    const bool has_table =
        std::any_of(changes.begin(), changes.end(),
                    [](const Override &one) { return one.key == "Kernel/table file"; });
    write_new_file(file, options.kind == crack ? with_units(text) : text);
    try
    {
      if (has_table)
      {
        write_new_file(table, "t,rho\n0,1\n0.5,0.5\n1,0\n");
        written.table = table.string();
      }
      (void)read_scene(file.string());
    }
    catch (const InputError &)
    {
      fs::remove(file);
      if (!written.table.empty())
        fs::remove(table);
      throw;
    }
    written.file = file.string();
    written.command = options.kind == crack ? crack : "run";
    return written;
  }
} // namespace plumbline::scene
