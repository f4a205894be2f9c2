#pragma once

#include "check/force_program.h"

#include <string>

// What is said of the force constants that were derived from another program's forces.
namespace plumbline::check
{
  /// @throws InputError  forces that are not along the bonds, or not linear
  template <int dim>
  void refuse_other_forces(const meshfree::ProbeFindings &found, const ProgramNodes<dim> &nodes);

  /// Bonds for `plumbline check`, with the digits that are known, by which it tells how exact they
  /// are.
  template <int dim>
  std::string bonds_csv(const meshfree::ProbeFindings &found, const ProgramNodes<dim> &nodes);

  /// For people, with the command to go on with.
  /// @param bonds_file  where the bonds were written
  template <int dim>
  std::string probe_text(const meshfree::ProbePlan<dim> &plan, const meshfree::ProbeFindings &found,
                         const ProgramNodes<dim> &nodes, const std::string &nodes_file,
                         const std::string &bonds_file);

  /// For programs, as lib/io/results.schema.json describes it: one record, its notes are the
  /// warnings.
  template <int dim>
  std::string probe_json(const meshfree::ProbePlan<dim> &plan, const meshfree::ProbeFindings &found,
                         const ProgramNodes<dim> &nodes, const std::string &bonds_file);
} // namespace plumbline::check
