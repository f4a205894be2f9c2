#include "io/point_vtu.h"

#include "base/error.h"

#include <deal.II/base/data_out_base.h>

#include <fstream>

namespace plumbline::io
{
  void write_vtu(const analysis::PointField &field, const std::filesystem::path &file)
  {
    const unsigned int n_components = field.n_components;
    std::vector<dealii::DataOutBase::Patch<0, 2>> points(field.points.size());
    for (unsigned int i = 0; i < points.size(); ++i)
    {
      points[i].vertices[0] = field.points[i];
      points[i].patch_index = i;
      points[i].data.reinit(n_components, 1);
      for (unsigned int c = 0; c < n_components; ++c)
        points[i].data(c, 0) = static_cast<float>(field.values[i * n_components + c]);
    }
    using dealii::DataComponentInterpretation::component_is_part_of_vector;
    std::vector<std::tuple<unsigned int, unsigned int, std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
        vectors;
    if (n_components == 2)
      vectors.emplace_back(0, 1, "u", component_is_part_of_vector);
    std::vector<std::string> names(n_components, "u");
    for (unsigned int c = 0; c < n_components && n_components > 2; ++c)
      names[c] += std::to_string(c + 1);
    std::filesystem::create_directories(file.parent_path());
    std::ofstream out(file);
    dealii::DataOutBase::write_vtu(points, names, vectors, dealii::DataOutBase::VtkFlags(), out);
    if (!out.flush())
      throw InputError("cannot write all of '" + file.string() +
                       "'; free some space, or give another output folder (-o)");
  }
} // namespace plumbline::io
