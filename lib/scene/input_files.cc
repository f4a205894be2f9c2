#include "scene/input_files.h"

#include "base/content_hash.h"
#include "base/error.h"
#include "base/text_file.h"
#include "geometry/gmsh_script.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <set>

namespace plumbline::scene
{
  namespace fs = std::filesystem;

  namespace
  {
    std::string hash_of(const std::string &file)
    {
      base::ContentHash hash;
      std::ifstream in(file, std::ios::binary);
      std::array<char, 1 << 16> block{};
      do
      {
        in.read(block.data(), block.size());
        hash.add(block.data(), static_cast<std::size_t>(in.gcount()));
      } while (in);
      return hash.text();
    }

    std::vector<std::string> files_of_mesh(const std::string &file)
    {
      if (!base::has_ending(file, ".geo"))
        return {file};
      try
      {
        return geometry::files_of_script(file);
      }
      catch (const InputError &)
      {
        return {file}; // it is refused when it is meshed, if it is
      }
    }
  } // namespace

  std::vector<std::string> named_files(const Scene &scene)
  {
    std::vector<std::string> files;
    std::set<std::string> known;
    const auto add = [&](const std::string &file)
    {
      std::error_code not_there;
      if (fs::is_regular_file(file, not_there) && known.insert(file).second)
        files.push_back(file);
    };
    const auto path = [&](const std::string &name)
    { return (fs::path(scene.folder) / name).string(); };
    if (scene.domain.mesh.is_file())
      for (const std::string &file : files_of_mesh(path(scene.domain.mesh.name)))
        add(file);
    if (!scene.kernel.table_file.empty())
      add(path(scene.kernel.table_file));
    if (scene.methods.nodes.kind() == NodeKind::file)
      for (const Series &series : scene.study.series)
        for (const Level &level : series.levels)
          add(path(scene.methods.nodes.file_at(level.h)));
    if (!scene.output.points.empty())
      add(path(scene.output.points));
    for (const std::string &picture : scene.random.files)
      add(path(picture));
    return files;
  }

  std::string describe_files(const Scene &scene)
  {
    std::string text;
    for (const std::string &file : named_files(scene))
      text += "# file " + hash_of(file) + "  " +
              base::shown(fs::path(file).lexically_proximate(scene.folder).string(), 200) + "\n";
    return text;
  }
} // namespace plumbline::scene
