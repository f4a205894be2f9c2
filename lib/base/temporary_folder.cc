#include "base/temporary_folder.h"

#include "base/error.h"

#include <cstdlib>

namespace plumbline::base
{
  TemporaryFolder::TemporaryFolder(const std::string &user)
  {
    const std::filesystem::path parent = std::filesystem::temp_directory_path();
    std::string name = (parent / ("plumbline-" + user + "-XXXXXX")).string();
    if (mkdtemp(name.data()) == nullptr)
      throw InputError(user + " needs a folder for its files, and '" + parent.string() +
                       "' is not writable; set TMPDIR to a writable folder");
    path_ = name;
  }

  TemporaryFolder::~TemporaryFolder()
  {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
} // namespace plumbline::base
