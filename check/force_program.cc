#include "check/force_program.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/exec_words.h"
#include "base/number_text.h"
#include "base/text_file.h"
#include "meshfree/check/bond_file.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>
#include <unordered_map>

namespace plumbline::check
{
  using meshfree::NodeVectors;

  namespace
  {
    constexpr std::array axes{"x", "y", "z"};

    /// "ux,uy,uz"
    std::string columns(const std::string &prefix, int dim)
    {
      std::string result;
      for (int d = 0; d < dim; ++d)
        result += (d == 0 ? "" : ",") + prefix + axes[static_cast<std::size_t>(d)];
      return result;
    }

    std::string replace(std::string text, const std::string &mark, const std::string &by,
                        const std::string &meaning)
    {
      std::size_t at = text.find(mark);
      if (at == std::string::npos)
        throw InputError("--command '" + text + "' has no " + mark + ", which stands for " +
                         meaning + "; write it where the command takes the name of this file");
      for (; at != std::string::npos; at = text.find(mark, at + by.size()))
        text.replace(at, mark.size(), by);
      return text;
    }

    std::string read_all(const std::filesystem::path &file)
    {
      std::ifstream in(file, std::ios::binary);
      return {std::istreambuf_iterator<char>(in), {}};
    }

    /// As this process was begun: MPI has added what would make the command a rank of it.
    std::vector<std::string> first_environment()
    {
      const std::string all = read_all("/proc/self/environ");
      std::vector<std::string> result;
      for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end + 1)
      {
        end = std::min(all.find('\0', begin), all.size());
        result.push_back(all.substr(begin, end - begin));
      }
      return result;
    }

    /// Waits for the leader of a process group; it is terminated where it should stop.
    /// @return  its status as returned by waitpid
    int wait_for(pid_t process, const std::function<bool()> &should_stop)
    {
      using std::chrono::milliseconds;
      constexpr milliseconds longest(20);
      milliseconds pause(1);
      bool is_told = false;
      int status = 0;
      while (waitpid(process, &status, WNOHANG) == 0)
      {
        if (should_stop() && !is_told)
        {
          kill(-process, SIGTERM);
          is_told = true;
        }
        std::this_thread::sleep_for(pause);
        pause = std::min(longest, 2 * pause);
      }
      return status;
    }

    /// @return  its status as of waitpid
    int run_by_shell(const std::string &command, const std::string &log,
                     const std::function<bool()> &should_stop)
    {
      std::vector<std::string> words = {"sh", "-c", command}, settings = first_environment();
      const std::vector<char *> arguments = base::exec_words(words),
                                environment = base::exec_words(settings);
      posix_spawn_file_actions_t actions;
      posix_spawn_file_actions_init(&actions);
      posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
      posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                       O_WRONLY | O_CREAT | O_TRUNC, 0600);
      posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
      posix_spawnattr_t attributes;
      posix_spawnattr_init(&attributes);
      posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP); // a group of its own
      pid_t process = 0;
      const int error = posix_spawn(&process, "/bin/sh", &actions, &attributes, arguments.data(),
                                    environment.data());
      posix_spawnattr_destroy(&attributes);
      posix_spawn_file_actions_destroy(&actions);
      if (error != 0)
        throw InputError("the shell cannot be started: " + std::string(std::strerror(error)) +
                         "; end other programs");
      const int status = wait_for(process, should_stop);
      kill(-process, SIGTERM); // what it left in the background
      return status;
    }

    /// A name as one word of the shell.
    std::string shell_word(const std::string &text)
    {
      std::string word;
      for (const char c : text)
      {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && std::strchr("/._-+", c) == nullptr)
          word += '\\';
        word += c;
      }
      return word;
    }
  } // namespace

  template <int dim>
  ForceProgram<dim>::ForceProgram(const std::string &command, const ProgramNodes<dim> &nodes,
                                  ForceKind kind, std::function<bool()> should_stop)
      : nodes_(nodes), kind_(kind), should_stop_(std::move(should_stop)), folder_("probe"),
        nodes_file_(folder_.path() / "nodes.csv"), forces_file_(folder_.path() / "forces.csv"),
        log_file_(folder_.path() / "log"),
        command_(replace(
            replace(command, "{nodes}", shell_word(nodes_file_.string()), "the displaced nodes"),
            "{forces}", shell_word(forces_file_.string()), "the forces that it writes"))
  {
  }

  template <int dim>
  void ForceProgram<dim>::write_nodes(const NodeVectors<dim> &displacements) const
  {
    constexpr int digits = 17;
    std::string text = "id," + columns("", dim) + ',' + columns("u", dim) + '\n';
    for (std::size_t i = 0; i < displacements.size(); ++i)
    {
      text += std::to_string(nodes_.id[i]);
      for (unsigned int d = 0; d < dim; ++d)
        text += ',' + base::to_text(nodes_.places[i][d], digits);
      for (unsigned int d = 0; d < dim; ++d)
        text += ',' + base::to_text(displacements[i][d], digits);
      text += '\n';
    }
    base::write_file(nodes_file_, text);
  }

  template <int dim>
  std::string ForceProgram<dim>::log_end() const
  {
    constexpr std::size_t most = 600;
    std::string text = read_all(log_file_);
    text.erase(text.find_last_not_of(" \n\t\r") + 1);
    if (text.size() > most)
      text = "..." + text.substr(text.size() - most);
    return text.empty() ? "; it printed nothing" : "; it printed:\n" + text;
  }

  template <int dim>
  NodeVectors<dim> ForceProgram<dim>::read_forces() const
  {
    std::vector<std::string> names;
    for (unsigned int d = 0; d < dim; ++d)
      names.push_back("f" + std::string(axes[d]));
    base::Csv csv(forces_file_.string(), names);
    std::unordered_map<std::int64_t, std::size_t> node_of_id;
    for (std::size_t i = 0; i < nodes_.id.size(); ++i)
      node_of_id[nodes_.id[i]] = i;
    const std::size_t n_nodes = nodes_.id.size();
    const auto node_of_row = [&](std::size_t row)
    {
      if (!csv.has("id"))
      {
        if (row >= n_nodes)
          csv.fail("has forces of more than the " + std::to_string(n_nodes) +
                   " nodes; write one row for each node");
        return row;
      }
      const auto found = node_of_id.find(csv.integer("id"));
      if (found == node_of_id.end())
        csv.fail("id = " + std::to_string(csv.integer("id")) +
                 " is the id of no node; give the ids of {nodes}");
      return found->second;
    };
    NodeVectors<dim> forces(n_nodes);
    std::vector<bool> is_given(n_nodes);
    for (std::size_t row = 0; csv.next(); ++row)
    {
      const std::size_t node = node_of_row(row);
      if (is_given[node])
        csv.fail("the force on node " + std::to_string(nodes_.id[node]) +
                 " is given already; write one row for each node");
      is_given[node] = true;
      const double volume = kind_ == ForceKind::densities ? nodes_.volumes[node] : 1;
      for (unsigned int d = 0; d < dim; ++d)
        forces[node][d] = volume * csv.number(names[d]);
    }
    const auto missing = std::find(is_given.begin(), is_given.end(), false);
    if (missing != is_given.end())
      throw InputError(
          "'" + forces_file_.string() + "' has forces of " +
          std::to_string(std::count(is_given.begin(), is_given.end(), true)) + " of the " +
          std::to_string(n_nodes) + " nodes, and none on node " +
          std::to_string(nodes_.id[static_cast<std::size_t>(missing - is_given.begin())]) +
          "; write one row for each node, zero where there is no force");
    return forces;
  }

  template <int dim>
  NodeVectors<dim> ForceProgram<dim>::run(const NodeVectors<dim> &displacements) const
  {
    std::error_code error;
    std::filesystem::remove(forces_file_, error);
    write_nodes(displacements);
    const int status = run_by_shell(command_, log_file_.string(), should_stop_);
    if (should_stop_())
      throw Interrupted();
    if (WIFSIGNALED(status))
      throw InputError("the command '" + command_ + "' was ended by a signal (" +
                       strsignal(WTERMSIG(status)) + ")" + log_end());
    if (WEXITSTATUS(status) != 0)
      throw InputError("the command '" + command_ + "' failed with exit code " +
                       std::to_string(WEXITSTATUS(status)) +
                       "; run it by hand on a node file with these columns to find the cause" +
                       log_end());
    if (!std::filesystem::exists(forces_file_, error))
      throw InputError("the command '" + command_ +
                       "' wrote no forces; write CSV with the columns " + columns("f", dim) +
                       " to the file that {forces} stands for" + log_end());
    try
    {
      return read_forces();
    }
    catch (const InputError &fault)
    {
      throw InputError("the forces of the command '" + command_ +
                       "' cannot be used: " + fault.what());
    }
  }

  template class ForceProgram<2>;
  template class ForceProgram<3>;

  bool is_in_space(const std::string &file)
  {
    base::Csv csv(file, {"id", "x", "y", "volume"}, {"id"});
    std::optional<double> first;
    while (csv.has("z") && csv.next())
    {
      const double z = csv.number("z");
      if (z != first.value_or(z))
        return true;
      first = z;
    }
    return false;
  }

  template <int dim>
  ProgramNodes<dim> read_program_nodes(const std::string &file)
  {
    if constexpr (dim == 2)
    {
      const meshfree::GivenNodes<2> nodes = meshfree::read_given_nodes<2>(file);
      return {nodes.id, nodes.places, nodes.volume};
    }
    else
    {
      const meshfree::GivenNodes<3> nodes = meshfree::read_given_nodes<3>(file);
      return {nodes.id, nodes.places, nodes.volume};
    }
  }

  template ProgramNodes<2> read_program_nodes<2>(const std::string &file);
  template ProgramNodes<3> read_program_nodes<3>(const std::string &file);
} // namespace plumbline::check
