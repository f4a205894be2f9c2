#pragma once

#include "base/choice.h"
#include "base/temporary_folder.h"
#include "meshfree/check/probe.h"

#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace plumbline::check
{
  enum class ForceKind
  {
    forces,   ///< on nodes
    densities ///< per volume
  };

  /// Nodes of another program, in the order of their file.
  template <int dim>
  struct ProgramNodes
  {
    std::vector<std::int64_t> id;
    std::vector<dealii::Point<dim>> places; ///< [length]
    std::vector<double> volumes;            ///< [length^dim]
  };

  /// Whether a file of nodes has a column z that is not constant.
  bool is_in_space(const std::string &file);

  template <int dim>
  ProgramNodes<dim> read_program_nodes(const std::string &file);

  /// What should_stop() of a program asked for.
  struct Interrupted : std::exception
  {
  };

  /// Another program that computes forces: a command for the shell, run once for each call, in the
  /// current folder. `{nodes}` in it stands for a file that it reads, `{forces}` for one that it
  /// writes, both in a temporary folder:
  /// - nodes: CSV with id, x, y[, z] as given and the displacements ux, uy[, uz];
  /// - forces: CSV with fx, fy[, fz] of each node and, if rows are not in the order of the nodes,
  ///   id. Forms as base::Csv reads them.
  template <int dim>
  class ForceProgram
  {
  public:
    /// @param nodes        must outlive the program
    /// @param should_stop  asked while it runs: it is terminated then
    /// @throws InputError  a command that lacks one of the two files
    ForceProgram(const std::string &command, const ProgramNodes<dim> &nodes, ForceKind kind,
                 std::function<bool()> should_stop);

    /// @return  forces on nodes, whatever kind the program gives
    /// @throws InputError   the command fails, or its forces are not those of all nodes
    /// @throws Interrupted  it was terminated
    meshfree::NodeVectors<dim> run(const meshfree::NodeVectors<dim> &displacements) const;

  private:
    void write_nodes(const meshfree::NodeVectors<dim> &displacements) const;
    meshfree::NodeVectors<dim> read_forces() const;
    std::string log_end() const; ///< what it printed last

    const ProgramNodes<dim> &nodes_;
    ForceKind kind_;
    std::function<bool()> should_stop_;
    base::TemporaryFolder folder_;
    std::filesystem::path nodes_file_, forces_file_, log_file_;
    std::string command_;
  };
} // namespace plumbline::check

namespace plumbline::base
{
  template <>
  inline constexpr auto words<check::ForceKind> = std::array{"forces", "densities"};
} // namespace plumbline::base
