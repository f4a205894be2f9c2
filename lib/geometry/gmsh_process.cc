#include "geometry/gmsh_process.h"

#include "base/error.h"
#include "base/exec_words.h"
#include "base/number_text.h"
#include "base/temporary_folder.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

namespace plumbline::geometry
{
  namespace
  {
    namespace fs = std::filesystem;

    constexpr double gibibyte = 1024. * 1024 * 1024;

    /// The clock runs on where other programs have the processors.
    constexpr double clock_over_cpu = 4;

    std::string read_all(const fs::path &file)
    {
      std::ifstream in(file, std::ios::binary);
      return {std::istreambuf_iterator<char>(in), {}};
    }

    std::string find_gmsh()
    {
      const char *path = std::getenv("PATH");
      std::istringstream folders(path == nullptr ? "/usr/bin" : path);
      for (std::string folder; std::getline(folders, folder, ':');)
        if (const std::string file = folder + "/gmsh"; access(file.c_str(), X_OK) == 0)
          return file;
      throw InputError("gmsh is not installed, which meshes .geo files; apt-get install gmsh");
    }

    void limit(int resource, double value)
    {
      const rlimit both{static_cast<rlim_t>(value), static_cast<rlim_t>(value)};
      setrlimit(static_cast<__rlimit_resource>(resource), &both);
    }

    /// Between fork and exec: nothing but system calls, since other threads may hold locks.
    [[noreturn]] void become_gmsh(const char *program, char **arguments, char **environment,
                                  const char *log, const GmshLimits &limits)
    {
      setpgid(0, 0);
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      limit(RLIMIT_CPU, std::ceil(limits.seconds));
      limit(RLIMIT_AS, limits.gibibytes * gibibyte);
      limit(RLIMIT_FSIZE, limits.file_size * gibibyte);
      limit(RLIMIT_CORE, 0);
      const int in = open("/dev/null", O_RDONLY),
                out = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0600);
      if (in >= 0 && out >= 0)
      {
        dup2(in, STDIN_FILENO);
        dup2(out, STDOUT_FILENO);
        dup2(out, STDERR_FILENO);
        execve(program, arguments, environment);
      }
      _exit(127);
    }

    /// @return  its status as of waitpid, or that of SIGXCPU where the clock is over
    int wait_for(pid_t child, double seconds)
    {
      using namespace std::chrono;
      const auto deadline = steady_clock::now() + duration<double>(seconds);
      for (auto pause = 2ms;; pause = std::min(2 * pause, 20ms))
      {
        int status = 0;
        const pid_t ended = waitpid(child, &status, WNOHANG);
        if (ended == child)
          return status;
        if (ended < 0 && errno != EINTR)
          return 127 << 8;
        if (steady_clock::now() > deadline)
        {
          kill(-child, SIGKILL); // and what it has started
          kill(child, SIGKILL);
          while (waitpid(child, &status, 0) < 0 && errno == EINTR)
            ;
          return SIGXCPU;
        }
        std::this_thread::sleep_for(pause);
      }
    }

    /// What is wrong and how it is mended, by gmsh's words for it: "syntax error (;)".
    std::string in_our_words(const std::string &error)
    {
      const auto has = [&](const char *part) { return error.find(part) != std::string::npos; };
      const std::string syntax = "syntax error (";
      if (error.compare(0, syntax.size(), syntax) == 0 && error.back() == ')')
        return "a syntax error at '" +
               error.substr(syntax.size(), error.size() - syntax.size() - 1) +
               "'; mend the line, or the end of the one before";
      if (has("nknown"))
        return "it names what is not there; mend the name or number, or define it before";
      if (has("already exists"))
        return "it gives a number that is in use; give another";
      if (has("closed loop"))
        return "a boundary is not closed; let each curve of a loop begin where another ends";
      if (has("recover the edge"))
        return "curves of a surface cross; let them meet at their ends alone";
      return "gmsh cannot do what it says; mend it";
    }

    /// More squares or cubes of h in the box about a geometry are refused before gmsh makes any
    /// cell.
    constexpr double most_squares = 5e7, most_cubes = 1e7;

    /// What gmsh says of such a geometry, before its extents.
    const std::string too_large = "plumbline: too large for h, ";

    /// In gmsh's language; read after the script.
    std::string size_check(double h, unsigned int dimension)
    {
      std::string product, places, sides;
      for (unsigned int d = 0; d < dimension; ++d)
      {
        const char axis = "XYZ"[d];
        const std::string side = std::string("(General.Max") + axis + " - General.Min" + axis + ")";
        product += (d == 0 ? "" : " * ") + side;
        places += d == 0 ? "%g" : " by %g";
        sides += ", " + side;
      }
      const double most = dimension == 2 ? most_squares : most_cubes;
      return "BoundingBox;\nIf (" + product + " > " +
             base::to_text(most * std::pow(h, dimension), 17) + ")\n  Error(\"" + too_large +
             places + ", more than " + base::to_text(most, 3) +
             (dimension == 2 ? " squares" : " cubes") + "\"" + sides + ");\n  Exit;\nEndIf\n";
    }

    /// gmsh's first error, "Error   : 'a.geo', line 3: syntax error (;)": where it is, in our
    /// words, and its own.
    std::string reason(const std::string &log, const std::string &source)
    {
      const std::string mark = "Error   : ";
      const std::size_t at = log.find(mark);
      if (at == std::string::npos)
        return "";
      std::string error = log.substr(at + mark.size(), log.find('\n', at) - at - mark.size());
      if (const std::size_t size = error.find(too_large); size != std::string::npos)
        return source + ": its geometry is " + error.substr(size + too_large.size()) +
               " of the mesh size h; are both in the same unit of length? Scale the "
               "geometry, or choose a larger Study/h";
      const std::size_t number = error.find("', line ");
      const std::size_t colon = number == std::string::npos ? number : error.find(": ", number);
      if (colon == std::string::npos)
        return source + " is refused by gmsh: " + in_our_words(error) + " (gmsh says: " + error +
               ")";
      std::string place = source;
      const std::string file = fs::path(error.substr(1, number - 1)).filename().string();
      place += source.find(file) == std::string::npos ? ", in '" + file + "'" : "";
      // gmsh counts the lines that have ended
      const int line = std::max(1, std::atoi(error.substr(number + 8, colon - number - 8).c_str()));
      error = error.substr(colon + 2);
      return place + ", line " + std::to_string(line) +
             " is refused by gmsh: " + in_our_words(error) + " (gmsh says: " + error + ")";
    }

    /// Runs gmsh on the words, which leave a file. @return its text
    std::string run(std::vector<std::string> words, const base::TemporaryFolder &folder,
                    const GmshLimits &limits, const std::string &source)
    {
      const std::string program = find_gmsh(), log = (folder.path() / "log").string(),
                        mesh = (folder.path() / "mesh.msh").string();
      const std::string home = folder.path().string();
      const std::vector<std::string> output = {"-o", mesh, "-format", "msh22", "-v", "1"};
      words.insert(words.begin(), program);
      words.insert(words.end(), output.begin(), output.end());
      // no .gmshrc of the user's, and no MPI of this process
      std::vector<std::string> settings = {"HOME=" + home, "GMSH_HOME=" + home, "TMPDIR=" + home,
                                           "LC_ALL=C", "OMP_NUM_THREADS=1"};
      for (const char *name : {"PATH", "LD_LIBRARY_PATH"})
        if (const char *value = std::getenv(name))
          settings.push_back(std::string(name) + "=" + value);
      const std::vector<char *> arguments = base::exec_words(words),
                                environment = base::exec_words(settings);

      const pid_t child = fork();
      if (child < 0)
        throw InputError(source + " cannot be meshed, no process can be started for gmsh; end "
                                  "other programs");
      if (child == 0)
        become_gmsh(program.c_str(), const_cast<char **>(arguments.data()),
                    const_cast<char **>(environment.data()), log.c_str(), limits);
      const int status = wait_for(child, clock_over_cpu * limits.seconds);

      const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
      if (signal == SIGXCPU || signal == SIGKILL)
        throw InputError(source + ": gmsh was ended after " + base::to_text(limits.seconds, 6) +
                         " CPU seconds; mend a loop that does not end, choose a larger h, or set "
                         "the environment's PLUMBLINE_GMSH_SECONDS");
      const std::string error = reason(read_all(log), source);
      const std::string ended = signal != 0
                                    ? "by signal " + std::to_string(signal)
                                    : "with exit code " + std::to_string(WEXITSTATUS(status));
      const bool is_crash = signal == SIGABRT || signal == SIGSEGV;
      if (is_crash && (error.empty() || error.find("Out of memory") != std::string::npos))
        throw InputError(source + ": gmsh ended " + ended +
                         ", as it does on a broken file or past " +
                         base::to_text(limits.gibibytes, 6) +
                         " GiB of memory; mend the file, choose a larger h, or set the "
                         "environment's PLUMBLINE_GMSH_GIBIBYTES");
      if (!error.empty())
        throw InputError(error);
      if (signal != 0 || WEXITSTATUS(status) != 0)
        throw InputError(source + ": gmsh ended " + ended +
                         " and did not say why; try 'gmsh -2' (in space -3) on the file");
      if (!fs::exists(mesh))
        throw InputError(source + ": gmsh ended without a mesh; take Exit out of the file");
      return read_all(mesh);
    }

    double positive_setting(const char *name, double value)
    {
      const char *const given = std::getenv(name);
      if (given == nullptr)
        return value;
      char *end = nullptr;
      const double number = std::strtod(given, &end);
      if (end == given || *end != '\0' || !(number > 0) || !(number < 1e6))
        throw InputError("the environment's " + std::string(name) + " = '" + given +
                         "' is not a positive number below 1e6; mend or unset it");
      return number;
    }
  } // namespace

  GmshLimits GmshLimits::from_environment()
  {
    GmshLimits limits;
    limits.seconds = positive_setting("PLUMBLINE_GMSH_SECONDS", limits.seconds);
    limits.gibibytes = positive_setting("PLUMBLINE_GMSH_GIBIBYTES", limits.gibibytes);
    return limits;
  }

  std::string mesh_by_gmsh(const std::string &file, double h, double delta,
                           const GmshLimits &limits, const std::string &source, unsigned int order,
                           unsigned int dimension)
  {
    const base::TemporaryFolder folder("gmsh");
    // read after the script, whose own settings would make another format
    const std::string last = (folder.path() / "last.geo").string();
    std::ofstream(last) << size_check(h, dimension)
                        << "Mesh.Format = 1; Mesh.MshFileVersion = 2.2; Mesh.Binary = 0; "
                           "Mesh.SaveAll = 0; Mesh.SaveParametric = 0;\n"
                        << (order == 0 ? ""
                                       : "Mesh.SecondOrderLinear = 0; Mesh.SecondOrderIncomplete "
                                         "= 0; Mesh.HighOrderOptimize = 0; Mesh.ElementOrder = " +
                                             std::to_string(order) + ";\n");
    const std::string mesh =
        run({fs::absolute(file).string(), last, "-" + std::to_string(dimension), "-setnumber", "h",
             base::to_text(h, 17), "-setnumber", "delta", base::to_text(delta, 17)},
            folder, limits, source);
    // a branch or loop that is not ended is no error to gmsh, it skips the rest
    if (mesh.find("$Elements\n0\n") != std::string::npos)
      throw InputError(source +
                       ": gmsh makes no cells of it; end every If by EndIf and every For by "
                       "EndFor, and define physical " +
                       (dimension == 2 ? "surfaces" : "volumes"));
    return mesh;
  }

  std::string convert_by_gmsh(const std::string &file, const GmshLimits &limits,
                              const std::string &source)
  {
    const base::TemporaryFolder folder("gmsh");
    return run({fs::absolute(file).string(), "-save"}, folder, limits, source);
  }
} // namespace plumbline::geometry
