#include "reference/tetrahedra/face_sides.h"

#include <deal.II/base/quadrature_lib.h>

namespace plumbline::reference
{
  using dealii::Tensor;

  FaceSides::FaceSides(const PairFace &face) : x(face.vertices())
  {
    const Tensor<1, 3> area = cross_product_3d(x[1] - x[0], x[2] - x[0]);
    normal = area / area.norm();
    for (unsigned int k = 0; k < 3; ++k)
    {
      const Tensor<1, 3> edge = x[(k + 1) % 3] - x[k];
      length[k] = edge.norm();
      along[k] = edge / length[k];
      outward[k] = cross_product_3d(along[k], normal);
    }
    for (unsigned int k = 0; k < 3; ++k)
      slope[k] = -outward[(k + 1) % 3] * (length[(k + 1) % 3] / area.norm());
  }

  const LineRule &line_rule(unsigned int n_points)
  {
    static const std::vector<LineRule> rules = []
    {
      std::vector<LineRule> result(LineRule::most_points);
      for (unsigned int k = 1; k <= LineRule::most_points; ++k)
      {
        const dealii::QGauss<1> rule(k);
        for (unsigned int q = 0; q < k; ++q)
          result[k - 1].points.push_back(rule.point(q)[0]);
        result[k - 1].weights = rule.get_weights();
      }
      return result;
    }();
    return rules[n_points - 1];
  }
} // namespace plumbline::reference
