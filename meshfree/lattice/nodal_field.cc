#include "meshfree/lattice/nodal_field.h"

#include "meshfree/vtu.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  double NodalField::at(unsigned int component, int i, int j) const
  {
    const std::size_t width = nodes.n[0] + 2, height = nodes.n[1] + 2;
    return values[(component * height + j + 1) * width + i + 1];
  }

  double NodalField::value(const geometry::Point<2> &x, unsigned int component) const
  {
    std::array<int, 2> i{};
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double s = (x[d] - lattice.origin()[d]) / lattice.h() - nodes.axis[0].offset;
      i[d] = std::clamp(static_cast<int>(std::floor(s + .5)), -1, nodes.n[d]);
    }
    return at(component, i[0], i[1]);
  }

  void NodalField::write_vtu(const std::string &file) const
  {
    std::vector<dealii::DataOutBase::Patch<0, 2>> points;
    for (int j = 0; j < nodes.n[1]; ++j)
      for (int i = 0; i < nodes.n[0]; ++i)
        if (nodes.free(0, i, j))
        {
          const auto place = nodes.place(0, i, j);
          dealii::DataOutBase::Patch<0, 2> point;
          point.vertices[0] = lattice.point(place[0], place[1]);
          point.patch_index = static_cast<unsigned int>(points.size());
          point.data.reinit(nodes.n_components, 1);
          for (unsigned int c = 0; c < nodes.n_components; ++c)
            point.data(c, 0) = static_cast<float>(at(c, i, j));
          points.push_back(point);
        }
    meshfree::write_vtu(points, nodes.n_components, file);
  }
} // namespace plumbline::meshfree
