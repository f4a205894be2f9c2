#include "report/plot.h"

#include "base/error.h"
#include "base/text_file.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

extern char **environ;

namespace plumbline::report
{
  namespace
  {
    /// A full disk does not stop gnuplot.
    void check_picture(const std::filesystem::path &file)
    {
      std::ifstream in(file, std::ios::binary);
      const std::string text((std::istreambuf_iterator<char>(in)), {});
      if (text.rfind(base::has_ending(file, ".pdf") ? "%%EOF" : "</svg>") != std::string::npos)
        return;
      std::error_code ignored;
      std::filesystem::remove(file, ignored);
      throw NumericalError(
          "charts cannot be drawn, '" + file.string() +
          "' is not whole; free some space, then 'plumbline report' on the folder");
    }
  } // namespace

  void run_gnuplot(const std::filesystem::path &folder, const std::string &script,
                   const std::vector<std::string> &pictures)
  {
    for (const std::string &picture : pictures) // else older than the others
    {
      std::error_code error;
      std::filesystem::remove((folder / picture).replace_extension(".pdf"), error);
    }
    const std::filesystem::path log = folder / "gnuplot.log";
    const std::string program = "gnuplot", log_name = log.string(), place = folder.string();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 2, log_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0644);
    posix_spawn_file_actions_addchdir_np(&actions, place.c_str());
    std::array<char *, 3> arguments = {const_cast<char *>(program.c_str()),
                                       const_cast<char *>(script.c_str()), nullptr};
    pid_t child = 0;
    const int error =
        posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
      throw NumericalError("charts cannot be drawn, gnuplot does not start (" +
                           std::string(std::strerror(error)) +
                           "); apt-get install gnuplot-nox, then run the same command again");
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
      ;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
      throw NumericalError("charts cannot be drawn, gnuplot stopped on '" +
                           (folder / script).string() + "' and says why in '" + log_name +
                           "'; correct that, then run the same command again");
    for (const std::string &picture : pictures)
      check_picture(folder / picture);
    std::filesystem::remove(log);
  }
} // namespace plumbline::report
