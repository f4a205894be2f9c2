// Domains to mesh, what meshes cover, and what errors say.
#pragma once

#include "base/error.h"
#include "geometry/mesh_input.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace plumbline::geometry
{
  inline const Domain unit{{{{0, 0}, {1, 1}}}, {}};
  inline const Domain l_shape{{{{0, 0}, {1, 1}}}, {{{.5, .5}, {1, 1}}}};
  inline const Domain with_hole{{{{0, 0}, {1, 1}}}, {{{.25, .25}, {.75, .75}}}};

  /// Makes no cell like another.
  inline Point<2> bend(const Point<2> &x)
  {
    return Point<2>(x[0] + .1 * std::sin(3 * x[1]), x[1] + .1 * std::cos(2 * x[0] + 1));
  }

  /// Of Ω or of its collar.
  inline double area(const Mesh &mesh, bool is_inside)
  {
    double sum = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      if (mesh.cells[c].is_inside == is_inside)
        sum += area(view(mesh.polygon(c)));
    return sum;
  }

  inline std::size_t n_inside(const Mesh &mesh)
  {
    return std::count_if(mesh.cells.begin(), mesh.cells.end(),
                         [](const MeshCell &cell) { return cell.is_inside; });
  }

  template <class F>
  std::string error_of(const F &f)
  {
    try
    {
      f();
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "no error";
  }

  inline testing::AssertionResult says(const std::string &message, const std::string &part)
  {
    return (message.find(part) == std::string::npos ? testing::AssertionFailure()
                                                    : testing::AssertionSuccess())
           << message;
  }
} // namespace plumbline::geometry
