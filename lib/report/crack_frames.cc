#include "report/crack_frames.h"

#include "report/formats.h"

#include <deal.II/base/data_out_base.h>

#include <cstdio>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    std::string file_name(unsigned int index)
    {
      char name[32];
      std::snprintf(name, sizeof(name), "frame_%05u.vtu", index);
      return name;
    }
  } // namespace

  void write_frame(const std::filesystem::path &dir, unsigned int index,
                   const std::vector<double> &times, const LatticeFrame &frame)
  {
    using dealii::DataOutBase::Patch;
    const std::size_t n_nodes = frame.u->size() / 2;
    const auto n_fields = static_cast<unsigned int>(frame.fields.size());
    std::vector<Patch<0, 2>> points(n_nodes);
    for (unsigned int node = 0; node < n_nodes; ++node)
    {
      Patch<0, 2> &point = points[node];
      point.vertices[0] = frame.lower + dealii::Point<2>(frame.h * (node % frame.n[0]),
                                                         frame.h * (node / frame.n[0]));
      point.patch_index = node;
      point.data.reinit(2 + n_fields, 1);
      point.data(0, 0) = static_cast<float>((*frame.u)[node]);
      point.data(1, 0) = static_cast<float>((*frame.u)[n_nodes + node]);
      for (unsigned int f = 0; f < n_fields; ++f)
        point.data(2 + f, 0) = static_cast<float>((*frame.fields[f].second)[node]);
    }
    std::vector<std::string> names = {"u", "u"};
    for (const auto &field : frame.fields)
      names.push_back(field.first);
    using dealii::DataComponentInterpretation::component_is_part_of_vector;
    const std::vector<std::tuple<unsigned int, unsigned int, std::string,
                                 dealii::DataComponentInterpretation::DataComponentInterpretation>>
        vectors = {{0, 1, "u", component_is_part_of_vector}};
    dealii::DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false; // the same bytes whenever it is written
    flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
    std::ostringstream vtu, pvd;
    dealii::DataOutBase::write_vtu(points, names, vectors, flags, vtu);
    write_file(dir / file_name(index), vtu.str());
    std::vector<std::pair<double, std::string>> files;
    for (unsigned int i = 0; i <= index; ++i)
      files.emplace_back(times[i], file_name(i));
    dealii::DataOutBase::write_pvd_record(pvd, files);
    write_file(dir / "frames.pvd", pvd.str());
  }
} // namespace plumbline::report
