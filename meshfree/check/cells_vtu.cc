#include "meshfree/check/cells_vtu.h"

#include "base/error.h"

#include <deal.II/base/data_out_base.h>

#include <fstream>

namespace plumbline::meshfree
{
  void write_cells_vtu(const geometry::NodeCells<2> &cells, const std::vector<std::string> &names,
                       const std::vector<double> &values, const std::string &file)
  {
    using Patch = dealii::DataOutBase::Patch<2, 2>;
    const auto n_columns = static_cast<unsigned int>(names.size());
    std::vector<Patch> triangles;
    for (std::size_t i = 0; i * n_columns < values.size(); ++i)
      for (std::size_t p = cells.first_piece[i]; p < cells.first_piece[i + 1]; ++p)
      {
        const geometry::Polygon &piece = cells.pieces[p];
        for (std::size_t v = 2; v < piece.size(); ++v)
        {
          Patch triangle;
          triangle.reference_cell = dealii::ReferenceCells::Triangle;
          triangle.vertices[0] = piece[0];
          triangle.vertices[1] = piece[v - 1];
          triangle.vertices[2] = piece[v];
          triangle.patch_index = static_cast<unsigned int>(triangles.size());
          triangle.data.reinit(n_columns, 3);
          for (unsigned int c = 0; c < n_columns; ++c)
            for (unsigned int k = 0; k < 3; ++k)
              triangle.data(c, k) = static_cast<float>(values[i * n_columns + c]);
          triangles.push_back(triangle);
        }
      }
    std::ofstream out(file);
    if (!out)
      throw InputError("cannot write '" + file + "'; give a writable output folder (-o)");
    dealii::DataOutBase::write_vtu(triangles, names, {}, dealii::DataOutBase::VtkFlags(), out);
  }
} // namespace plumbline::meshfree
