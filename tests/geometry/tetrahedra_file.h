// Tetrahedra and hexahedra as texts of gmsh files.
#pragma once

#include "geometry/tetrahedral_mesh.h"

#include <algorithm>
#include <sstream>
#include <string>

namespace plumbline::tests
{
  inline const std::string volume_names = "2\n3 1 \"omega\"\n3 2 \"collar\"\n";

  inline std::string msh_section(const std::string &name, const std::string &content)
  {
    return "$" + name + "\n" + content + "$End" + name + "\n";
  }

  inline std::string counted(const std::string &lines)
  {
    return std::to_string(std::count(lines.begin(), lines.end(), '\n')) + "\n" + lines;
  }

  /// In format 2.2; nodes are numbered from 1.
  inline std::string msh_22(const std::string &names, const std::string &nodes,
                            const std::string &elements)
  {
    return msh_section("MeshFormat", "2.2 0 8\n") + msh_section("PhysicalNames", names) +
           msh_section("Nodes", counted(nodes)) + msh_section("Elements", counted(elements));
  }

  /// Around the lower face, then the upper one.
  inline std::array<unsigned int, 8> in_order_of_gmsh(const std::array<unsigned int, 8> &v)
  {
    return {v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]};
  }

  /// With the mesh's groups, if it has any.
  inline std::string msh_22(const geometry::TetrahedralMesh &mesh)
  {
    std::ostringstream nodes, elements, names;
    names << mesh.groups.size() << '\n';
    for (std::size_t k = 0; k < mesh.groups.size(); ++k)
      names << "3 " << k + 1 << " \"" << mesh.groups[k] << "\"\n";
    nodes.precision(17);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      nodes << v + 1 << ' ' << mesh.vertices[v] << '\n';
    const std::size_t n_parts = mesh.hexahedra.empty() ? 1 : geometry::n_in_hexahedron;
    const auto add = [&](std::size_t number, int type, const auto &vertices)
    {
      const std::size_t cell = n_parts * number;
      const unsigned int group = !mesh.group.empty()         ? mesh.group[cell] + 1
                                 : mesh.is_inside[cell] != 0 ? 1
                                                             : 2;
      elements << number + 1 << ' ' << type << " 2 " << group << ' ' << group;
      for (const unsigned int vertex : vertices)
        elements << ' ' << vertex + 1;
      elements << '\n';
    };
    for (std::size_t c = 0; c < mesh.cells.size() && mesh.hexahedra.empty(); ++c)
      add(c, 4, mesh.cells[c]);
    for (std::size_t c = 0; c < mesh.hexahedra.size(); ++c)
      add(c, 5, in_order_of_gmsh(mesh.hexahedra[c]));
    return msh_22(mesh.groups.empty() ? volume_names : names.str(), nodes.str(), elements.str());
  }

  /// In format 4.1: volumes 1 and 2 are Ω and the layer around it.
  inline std::string msh_41(const geometry::TetrahedralMesh &mesh)
  {
    std::ostringstream nodes, elements;
    nodes.precision(17);
    const std::size_t n = mesh.vertices.size(), n_cells = mesh.cells.size();
    nodes << "1 " << n << " 1 " << n << "\n3 1 0 " << n << '\n';
    for (std::size_t v = 0; v < n; ++v)
      nodes << v + 1 << '\n';
    for (const auto &x : mesh.vertices)
      nodes << x << '\n';
    elements << "2 " << n_cells << " 1 " << n_cells << '\n';
    for (const int group : {1, 2})
    {
      std::ostringstream lines;
      int count = 0;
      for (std::size_t c = 0; c < n_cells; ++c)
        if ((mesh.is_inside[c] != 0) == (group == 1))
        {
          lines << c + 1;
          for (const unsigned int vertex : mesh.cells[c])
            lines << ' ' << vertex + 1;
          lines << '\n';
          ++count;
        }
      elements << "3 " << group << " 4 " << count << '\n' << lines.str();
    }
    return msh_section("MeshFormat", "4.1 0 8\n") + msh_section("PhysicalNames", volume_names) +
           msh_section("Entities", "0 0 0 2\n1 0 0 0 1 1 1 1 1 0\n2 0 0 0 1 1 1 1 2 0\n") +
           msh_section("Nodes", nodes.str()) + msh_section("Elements", elements.str());
  }
} // namespace plumbline::tests
