#pragma once

#include <string>
#include <vector>

namespace plumbline::geometry
{
  /// What a run of gmsh may take.
  struct GmshLimits
  {
    double seconds = 120; ///< CPU seconds of it and of each of its children; four times as many by
                          ///< the clock
    double gibibytes = 4; ///< of address space
    double file_size = 2; ///< of each file that it writes [GiB]

    /// These, or what the environment says: PLUMBLINE_GMSH_SECONDS, PLUMBLINE_GMSH_GIBIBYTES.
    /// @throws InputError  no positive number there
    static GmshLimits from_environment();
  };

  /// A .geo script meshed with the constants h and delta set, or a .msh file in another format, as
  /// a text in gmsh's format 2.2, cells of physical surfaces (in space volumes) only.
  /// It is a process of its own that does the work: a script may loop for ever, take all memory or
  /// crash gmsh, and gmsh as a library is global, ends the program where its exceptions leave an
  /// OpenMP region, and cannot be limited. `gmsh` itself is called, not a copy of this process:
  /// only that is safe beside threads and MPI. It starts in .05 s, reads no settings of the user,
  /// and Ctrl-C is not for it.
  /// @param source  opens messages, e.g. "mesh file 'disk.geo'"
  /// @param order   of the cells, whose points between corners lie on the script's curves; 0: as
  /// the script has it
  /// @param dimension  2 or 3
  /// @throws InputError  gmsh not there, its own errors by file and line, no time or memory left
  std::string mesh_by_gmsh(const std::string &file, double h, double delta,
                           const GmshLimits &limits, const std::string &source,
                           unsigned int order = 0, unsigned int dimension = 2);
  std::string convert_by_gmsh(const std::string &file, const GmshLimits &limits,
                              const std::string &source);
} // namespace plumbline::geometry
