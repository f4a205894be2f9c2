#include "report/frames.h"

#include "report/formats.h"

#include <cstdio>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    /// Three numbers to a node, in nine digits: pictures, no results.
    template <typename Value>
    void write_array(std::ostream &out, const std::string &name, std::size_t n, const Value &value)
    {
      out << "<DataArray type=\"Float64\" Name=\"" << name
          << "\" NumberOfComponents=\"3\" format=\"ascii\">\n";
      for (std::size_t i = 0; i < n; ++i)
        out << value(i, 0) << ' ' << value(i, 1) << " 0\n";
      out << "</DataArray>\n";
    }

    std::string vtu(const study::Frame &frame)
    {
      const auto &nodes = frame.equation.nodes();
      const unsigned int n_components = frame.equation.n_components();
      const auto u = frame.equation.nodal(frame.state.u), v = frame.equation.nodal(frame.state.v);
      const auto of = [&](const std::vector<double> &values)
      {
        return [&values, n_components](std::size_t i, unsigned int c)
        { return c < n_components ? values[i * n_components + c] : 0; };
      };
      std::ostringstream out;
      out.precision(9);
      out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n"
             "<UnstructuredGrid>\n<Piece NumberOfPoints=\""
          << nodes.size() << "\" NumberOfCells=\"" << nodes.size() << "\">\n<PointData>\n";
      write_array(out, "displacement", nodes.size(), of(u));
      write_array(out, "velocity", nodes.size(), of(v));
      out << "</PointData>\n<Points>\n";
      write_array(out, "points", nodes.size(),
                  [&](std::size_t i, unsigned int c) { return nodes[i][c]; });
      out << "</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" "
             "format=\"ascii\">\n";
      for (std::size_t i = 0; i < nodes.size(); ++i)
        out << i << '\n';
      out << "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
      for (std::size_t i = 0; i < nodes.size(); ++i)
        out << i + 1 << '\n';
      out << "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
      for (std::size_t i = 0; i < nodes.size(); ++i)
        out << "1\n"; // a vertex
      out << "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
      return out.str();
    }
  } // namespace

  void Frames::write(const study::MotionRun &run, const study::Frame &frame)
  {
    const std::string name = slug(run.method + "_" + run.problem + "_" + run.series);
    char number[16];
    std::snprintf(number, sizeof number, "%05u", frame.number);
    const std::string file = name + "_" + number + ".vtu";
    write_file(folder_ / file, vtu(frame));
    std::string &listed = listed_[name];
    listed += "<DataSet timestep=\"" + exact(frame.t) + "\" file=\"" + file + "\"/>\n";
    write_file(folder_ / (name + ".pvd"),
               "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
               "<Collection>\n" +
                   listed + "</Collection>\n</VTKFile>\n");
  }

  double Frames::expected_bytes(double n_nodes)
  {
    return n_nodes * 100;
  }
} // namespace plumbline::report
