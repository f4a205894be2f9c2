#pragma once

#include "meshfree/check/given_rows.h"

#include <string>
#include <vector>

namespace plumbline::meshfree
{
  /// Where bonds were given, for messages.
  struct RowSource
  {
    std::string file; ///< or the name of the arrays
    std::string unit; ///< what GivenRow::line and GivenNodes::line count: "line", or "index"

    /// "'FILE', line 3: "
    std::string place(std::size_t line) const
    {
      return "'" + file + "', " + unit + " " + std::to_string(line) + ": ";
    }
  };

  /// Families from bonds, in files or in arrays; their rounding is left to the caller.
  /// @param cells  of the nodes, where source is the index into them
  /// @throws InputError  unknown ids, a bond of a node with itself or given twice, a free node
  /// without bonds (but in half lists); ids that are off those of the nodes by one are told as such
  template <int dim>
  GivenFamilies<dim>
  families_of_rows(const std::vector<GivenRow<dim>> &given, const GivenNodes<dim> &nodes,
                   const geometry::NodeCells<dim> &cells, const RowSource &source);
} // namespace plumbline::meshfree
