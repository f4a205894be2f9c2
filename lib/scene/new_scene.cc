#include "scene/new_scene.h"

#include "base/error.h"
#include "base/text_file.h"
#include "scene/scene.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace plumbline::scene
{
  namespace
  {
    namespace fs = std::filesystem;

    constexpr auto square = "square", cube = "cube", elastic = "elastic", scalar = "scalar";

    std::vector<Override> changes_of(const NewSceneOptions &options, const fs::path &folder)
    {
      std::vector<Override> changes;
      if (options.domain == cube)
        changes = {{"Domain/dimension", "3"},
                   {"Domain/boxes", "0, 0, 0 : 1, 1, 1"},
                   {"Problem/solution",
                    options.kind == scalar ? "x^3 + 2*y^2*z^2" : "x^3*y^2, y^2*z^3, x^2*z + y^3"},
                   {"Methods/names", "FA, IPA-AC, IPA-AC-R2, Q1"},
                   {"Study/h", "0.25, 0.125, 0.0625, 0.03125"},
                   {"Study/norms", "nodal Linf, averages L2"}};
      else if (options.domain != square)
      {
        // curved outlines are met by straight sides: averages over cells compare what both have
        changes = {
            {"Domain/mesh", fs::proximate(options.domain, folder).string()},
            {"Methods/names", "FA, IPA-AC, IPA-AC-R2, P1"},
            {"Study/norms", "averages L2"},
            {"Study/decisive error", "averages L2 | exact"},
        };
        if (!fs::exists(options.domain))
          throw InputError("--domain: mesh file '" + options.domain +
                           "' is not there; give a .geo or .msh file, square or cube");
      }
      if (!options.kernel.empty())
        changes.push_back({"Kernel/type", options.kernel});
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

  std::string write_new_scene(const NewSceneOptions &options)
  {
    fs::path file = options.name;
    if (!base::has_ending(file.string(), ".prm"))
      file += ".prm";
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    write_new_file(file, short_template(options.kind == elastic ? "tensor" : options.kind,
                                        changes_of(options, folder)));
    try
    {
      (void)read_scene(file.string());
    }
    catch (const InputError &)
    {
      fs::remove(file);
      throw;
    }
    return file.string();
  }
} // namespace plumbline::scene
