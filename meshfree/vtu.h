#pragma once

#include "base/error.h"

#include <deal.II/base/data_out_base.h>

#include <fstream>

namespace plumbline::meshfree
{
  /// Write u, one or two components, as data of points or cells.
  /// @throws InputError  the file cannot be written
  template <int dim>
  void write_vtu(const std::vector<dealii::DataOutBase::Patch<dim, 2>> &patches,
                 unsigned int n_components, const std::string &file)
  {
    std::ofstream out(file);
    if (!out)
      throw InputError("cannot write '" + file + "'; give a writable output folder (-o)");
    using dealii::DataComponentInterpretation::component_is_part_of_vector;
    std::vector<std::tuple<unsigned int, unsigned int, std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
        vectors;
    if (n_components == 2)
      vectors.emplace_back(0, 1, "u", component_is_part_of_vector);
    dealii::DataOutBase::write_vtu(patches, std::vector<std::string>(n_components, "u"), vectors,
                                   dealii::DataOutBase::VtkFlags(), out);
    if (!out.flush())
      throw InputError("cannot write all of '" + file +
                       "'; free some space, or give another output folder (-o)");
  }
} // namespace plumbline::meshfree
