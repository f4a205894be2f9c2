#include "io/certified_set.h"

#include "base/error.h"
#include "base/sha256.h"
#include "base/similar_words.h"
#include "base/text_file.h"
#include "io/certificate_json.h"

#include <algorithm>

namespace plumbline::io
{
  namespace fs = std::filesystem;
  using study::Certificate;

  namespace
  {
    constexpr auto ending = ".certificate.json";

    fs::path folder_of_set(const fs::path &prefix)
    {
      return scenes_folder(prefix) / "certified";
    }

    /// As people write it; files have '_'.
    std::string to_name(std::string stem)
    {
      std::replace(stem.begin(), stem.end(), '_', '-');
      return stem;
    }

    bool is_file_name(const std::string &problem)
    {
      return fs::is_regular_file(problem) || problem.find('/') != std::string::npos ||
             base::has_ending(problem, ".json");
    }

    /// @throws InputError  no problem of the set
    fs::path file_of(const std::string &problem, const fs::path &prefix)
    {
      if (is_file_name(problem))
        return problem;
      const std::vector<std::string> names = certified_names(prefix);
      const std::string wanted = base::to_lower(to_name(problem));
      std::string list;
      for (const std::string &name : names)
      {
        if (base::to_lower(name) == wanted)
        {
          std::string stem = name;
          std::replace(stem.begin(), stem.end(), '-', '_');
          return folder_of_set(prefix) / (stem + ending);
        }
        list += (list.empty() ? "" : ", ") + name;
      }
      throw InputError("problem '" + problem + "' is not in the certified set; choose one of " +
                       list +
                       ", or the file certificate.json that 'plumbline certify' has written" +
                       base::did_you_mean(problem, names));
    }

  } // namespace

  fs::path prefix_of_command()
  {
    return fs::read_symlink("/proc/self/exe").parent_path().parent_path();
  }

  fs::path scenes_folder(const fs::path &prefix)
  {
    const fs::path installed = prefix / "share/plumbline/scenes";
    return fs::is_directory(installed) ? installed : fs::path(PLUMBLINE_SCENES);
  }

  std::vector<std::string> certified_names(const fs::path &prefix)
  {
    const fs::path folder = folder_of_set(prefix);
    std::vector<std::string> names;
    if (fs::is_directory(folder))
      for (const auto &entry : fs::directory_iterator(folder))
      {
        const std::string name = entry.path().filename().string();
        const std::size_t stem = name.find(ending);
        if (stem != std::string::npos && stem > 0)
          names.push_back(to_name(name.substr(0, stem)));
      }
    if (names.empty())
      throw InputError("the folder '" + folder.string() +
                       "' of the certified set does not exist; install Plumbline with its scenes "
                       "('cmake --install'), or give the file of a certificate");
    std::sort(names.begin(), names.end());
    return names;
  }

  Certificate certificate_of(const std::string &problem, const fs::path &prefix)
  {
    const fs::path file = file_of(problem, prefix);
    Certificate certificate = io::read_certificate(file);
    if (base::sha256(certificate.scene_text) != certificate.hash)
      throw InputError("certificate '" + file.string() +
                       "': sha256 is not that of its scene_text, so one of them was changed; make "
                       "it again by 'plumbline certify'");
    return certificate;
  }

} // namespace plumbline::io
