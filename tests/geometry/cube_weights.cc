// What partial volumes and centroids of cubes are for: weights of the meshfree rules in space,
// whose second moments tell whether they are asymptotically compatible.
#include "geometry/ball_polyhedron.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plumbline::geometry
{
  namespace
  {
    using dealii::Point;

    struct Weights
    {
      unsigned int n_neighbours = 0;
      double at_node = 0, at_centroid = 0; ///< Σ w ξ1² - 1 for kernels with ∫ γ ξ1² = 1
    };

    /// Linear decay, γ = 45 / (2 π δ^5) (1 - |ξ| / δ), on cubes of size 1, δ = m.
    Weights weigh(int m)
    {
      const double scale = 45 / (2 * M_PI * std::pow(m, 5));
      Weights result;
      for (int i = -m - 1; i <= m + 1; ++i)
        for (int j = -m - 1; j <= m + 1; ++j)
          for (int k = -m - 1; k <= m + 1; ++k)
          {
            if (i == 0 && j == 0 && k == 0)
              continue;
            const Point<3> node(i, j, k), half(.5, .5, .5);
            const SolidMoments part = intersect(
                Point<3>(), m, ConvexPolyhedron::box(Point<3>(node - half), node + half), 1);
            if (part.volume == 0)
              continue;
            ++result.n_neighbours;
            const auto kernel = [&](const Point<3> &x)
            { return scale * std::max(0., 1 - x.norm() / m); };
            result.at_node += part.volume * kernel(node) * i * i;
            result.at_centroid += part.volume * kernel(part.centroid) * i * i;
          }
      result.at_node -= 1;
      result.at_centroid -= 1;
      return result;
    }
  } // namespace

  // by an independent program in quadruple precision; as in the plane (Pasetto, Shen, D'Elia, Tian,
  // Trageser and Gunzburger 2022, doi:10.1007/s42102-022-00090-8) neither is 0 for any m, so that
  // neither rule is asymptotically compatible for this kernel
  TEST(CubeWeights, HaveTheMomentsOfPartialVolumes)
  {
    constexpr unsigned int n_neighbours[] = {80, 250, 460, 822};
    constexpr double at_node[] = {-.0792, -.0684, -.0235, -.0198},
                     at_centroid[] = {.298701, .137223, .077668, .049662};
    for (int m = 2; m <= 5; ++m)
    {
      const Weights found = weigh(m);
      EXPECT_EQ(found.n_neighbours, n_neighbours[m - 2]);
      EXPECT_NEAR(found.at_node, at_node[m - 2], 5e-5) << m;
      EXPECT_NEAR(found.at_centroid, at_centroid[m - 2], 5e-7) << m;
    }
  }
} // namespace plumbline::geometry
