#include "io/point_vtu.h"

#include "base/error.h"

#include <fstream>
#include <limits>

namespace plumbline::io
{
  namespace
  {
    void begin_array(std::ostream &out, const std::string &type, const std::string &name,
                     unsigned int n_components)
    {
      out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
          << n_components << "\" format=\"ascii\">\n";
    }

    void write_array(std::ostream &out, const std::string &name, const analysis::PointField &field,
                     unsigned int first, unsigned int n)
    {
      const bool is_vector = n > 1;
      begin_array(out, "Float64", name, is_vector ? 3 : 1);
      for (std::size_t i = 0; i < field.points.size(); ++i)
      {
        for (unsigned int c = first; c < first + n; ++c)
          out << field.values[i * field.n_components + c] << (c + 1 < first + n ? " " : "");
        out << (n == 2 ? " 0\n" : "\n");
      }
      out << "</DataArray>\n";
    }

    void write_data(std::ostream &out, const analysis::PointField &field)
    {
      out << "<PointData>\n";
      if (field.n_components == (field.z.empty() ? 2 : 3) || field.n_components == 1)
        write_array(out, "u", field, 0, field.n_components);
      else
        for (unsigned int c = 0; c < field.n_components; ++c)
          write_array(out, "u" + std::to_string(c + 1), field, c, 1);
      out << "</PointData>\n";
    }

    /// Each point is a cell.
    void write_cells(std::ostream &out, std::size_t n)
    {
      out << "<Cells>\n";
      begin_array(out, "Int64", "connectivity", 1);
      for (std::size_t i = 0; i < n; ++i)
        out << i << '\n';
      out << "</DataArray>\n";
      begin_array(out, "Int64", "offsets", 1);
      for (std::size_t i = 0; i < n; ++i)
        out << i + 1 << '\n';
      out << "</DataArray>\n";
      begin_array(out, "UInt8", "types", 1);
      for (std::size_t i = 0; i < n; ++i)
        out << "1\n";
      out << "</DataArray>\n</Cells>\n";
    }
  } // namespace

  void write_vtu(const analysis::PointField &field, const std::filesystem::path &file)
  {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream out(file);
    out.precision(std::numeric_limits<double>::max_digits10);
    const std::size_t n = field.points.size();
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\">\n"
        << "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" << n << "\" NumberOfCells=\"" << n
        << "\">\n<Points>\n";
    begin_array(out, "Float64", "points", 3);
    for (std::size_t i = 0; i < n; ++i)
      out << field.points[i][0] << ' ' << field.points[i][1] << ' '
          << (field.z.empty() ? 0 : field.z[i]) << '\n';
    out << "</DataArray>\n</Points>\n";
    write_cells(out, n);
    write_data(out, field);
    out << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    if (!out.flush())
      throw InputError("cannot write all of '" + file.string() +
                       "'; free some space, or give another output folder (-o)");
  }
} // namespace plumbline::io
