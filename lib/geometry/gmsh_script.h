#pragma once

#include <string>
#include <vector>

namespace plumbline::geometry
{
  /// Whether a gmsh script, with the files that it includes and merges, draws and does no more.
  /// @throws InputError  naming file, line and remedy: a file that cannot be read or that includes
  /// itself; a command that would start a program or write a file (SystemCall, OnelabRun,
  /// ExternalProcess, Save, Print, Plugin, ...); a file to include or merge whose name is not
  /// written out; text that gmsh and we could read differently: other control characters than
  /// blanks, quotes that do not end on their line, command words or marks of comments within
  /// quotes, which gmsh finds there where it skips a branch.
  /// Limits: files that fields and lists read (FileName, ListFromFile) are not looked at.
  void check_script(const std::string &file);

  /// The script and all files that it reads, as far as their names are written out: included,
  /// merged, and texts in quotes that name a file (FileName, ListFromFile).
  /// @throws InputError  as check_script
  std::vector<std::string> files_of_script(const std::string &file);
} // namespace plumbline::geometry
