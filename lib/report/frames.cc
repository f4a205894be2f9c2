#include "report/frames.h"

#include "report/formats.h"

#include <deal.II/base/data_out_base.h>

#include <cstdio>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    using dealii::DataOutBase::Patch;

    std::string file_name(const std::string &name, std::size_t index)
    {
      char number[16];
      std::snprintf(number, sizeof(number), "_%05zu.vtu", index);
      return name + number;
    }

    template <int dim>
    unsigned int n_components(const PointField &field)
    {
      return field.is_vector ? dim : 1;
    }

    template <int dim>
    std::vector<Patch<0, dim>> make_patches(const std::vector<dealii::Point<dim>> &points,
                                            const std::vector<PointField> &fields)
    {
      unsigned int n_values = 0;
      for (const PointField &field : fields)
        n_values += n_components<dim>(field);
      std::vector<Patch<0, dim>> patches(points.size());
      for (unsigned int i = 0; i < points.size(); ++i)
      {
        patches[i].vertices[0] = points[i];
        patches[i].patch_index = i;
        patches[i].data.reinit(n_values, 1);
        unsigned int row = 0;
        for (const PointField &field : fields)
          for (unsigned int c = 0; c < n_components<dim>(field); ++c)
            patches[i].data(row++, 0) = static_cast<float>(field.value(i, c));
      }
      return patches;
    }
  } // namespace

  template <int dim>
  void write_frame(const std::filesystem::path &dir, const std::string &name,
                   const std::vector<double> &times, const std::vector<dealii::Point<dim>> &points,
                   const std::vector<PointField> &fields)
  {
    using Interpretation = dealii::DataComponentInterpretation::DataComponentInterpretation;
    std::vector<std::string> names;
    std::vector<std::tuple<unsigned int, unsigned int, std::string, Interpretation>> vectors;
    for (const PointField &field : fields)
    {
      const auto first = static_cast<unsigned int>(names.size());
      names.insert(names.end(), n_components<dim>(field), field.name);
      if (field.is_vector)
        vectors.emplace_back(first, first + dim - 1, field.name,
                             dealii::DataComponentInterpretation::component_is_part_of_vector);
    }
    dealii::DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false; // the same bytes whenever it is written
    flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
    std::ostringstream vtu, pvd;
    dealii::DataOutBase::write_vtu(make_patches(points, fields), names, vectors, flags, vtu);
    write_file(dir / file_name(name, times.size() - 1), vtu.str());
    std::vector<std::pair<double, std::string>> files;
    for (std::size_t i = 0; i < times.size(); ++i)
      files.emplace_back(times[i], file_name(name, i));
    dealii::DataOutBase::write_pvd_record(pvd, files);
    write_file(dir / (name + ".pvd"), pvd.str());
  }

  template void write_frame(const std::filesystem::path &, const std::string &,
                            const std::vector<double> &, const std::vector<dealii::Point<2>> &,
                            const std::vector<PointField> &);
  template void write_frame(const std::filesystem::path &, const std::string &,
                            const std::vector<double> &, const std::vector<dealii::Point<3>> &,
                            const std::vector<PointField> &);
} // namespace plumbline::report
