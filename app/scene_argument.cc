#include "app/scene_argument.h"

#include "base/error.h"
#include "base/similar_words.h"
#include "base/text_file.h"
#include "io/certified_set.h"
#include "scene/scene_keys.h"

#include <filesystem>
#include <map>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  namespace
  {
    /// Scenes in a folder, by their names without the ending, in small letters.
    template <class Iterator>
    std::map<std::string, std::vector<std::string>> scenes_in(const fs::path &folder)
    {
      std::map<std::string, std::vector<std::string>> files;
      std::error_code error;
      for (Iterator one(folder, fs::directory_options::skip_permission_denied, error), end;
           !error && one != end; one.increment(error))
        if (const fs::path &path = one->path(); base::has_ending(path.string(), ".prm"))
          files[base::to_lower(path.stem().string())].push_back(path.lexically_normal().string());
      return files;
    }

    /// Scenes whose names are similar: beside the file that is not there, else those that come with
    /// Plumbline.
    std::vector<std::string> similar_scenes(const fs::path &file)
    {
      const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
      for (const auto &known : {scenes_in<fs::directory_iterator>(folder),
                                scenes_in<fs::recursive_directory_iterator>(
                                    io::scenes_folder(io::prefix_of_command()))})
      {
        std::vector<std::string> names, files;
        for (const auto &[name, ignored] : known)
          names.push_back(name);
        for (const std::string &name :
             base::similar_words(base::to_lower(file.stem().string()), names))
          files.insert(files.end(), known.at(name).begin(), known.at(name).end());
        if (!files.empty())
          return files;
      }
      return {};
    }
  } // namespace

  int with_scene(const std::string &file, const std::vector<scene::Override> &overrides,
                 const std::function<int()> &action)
  try
  {
    return action();
  }
  catch (const InputError &error)
  {
    std::error_code not_there;
    if (!fs::exists(file, not_there) && std::string(error.what()).find(file) != std::string::npos)
    {
      const std::string hint = base::did_you_mean(similar_scenes(file));
      throw InputError(error.what() + (hint.empty() ? ";" : hint) +
                       " 'plumbline list scenes' lists the scenes that come with Plumbline");
    }
    throw InputError(scene::with_place(error.what(), file, overrides));
  }
} // namespace plumbline::app
