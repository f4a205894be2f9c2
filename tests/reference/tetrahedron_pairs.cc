// DGP0's integrals over random pairs of tetrahedra by their faces, against those by edges and
// vertices.
#include "tests/reference/tetrahedron_pairs.h"

#include "reference/tetrahedra/exact_pairs.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>

namespace
{
  using namespace plumbline;
  using namespace plumbline::reference;
  using dealii::Point;
  using Corners = std::array<Point<3>, 4>;
  using Quad = boost::multiprecision::number<
      boost::multiprecision::cpp_bin_float<113, boost::multiprecision::digit_base_2>,
      boost::multiprecision::et_off>;

  enum class Place
  {
    cut,
    inside,
    vertex,
    edge,
    face,
    same
  };
  constexpr std::array places = {Place::cut,  Place::inside, Place::vertex,
                                 Place::edge, Place::face,   Place::same};

  struct Cells
  {
    Corners first, second;
    unsigned int n_shared = 0; ///< of the first corners
  };

  double volume(const Corners &x)
  {
    return std::abs((x[1] - x[0]) * cross_product_3d(x[2] - x[0], x[3] - x[0])) / 6;
  }

  /// Whether a plane that holds the shared corners, if there are any, separates the others.
  bool are_apart(const Cells &cells)
  {
    dealii::Tensor<1, 3> axis; // from the first's to the second's
    for (unsigned int k = cells.n_shared; k < 4; ++k)
      axis += cells.second[k] - cells.first[k];
    const Point<3> &origin = cells.first[0];
    const auto edge = [&](unsigned int k) { return cells.first[k] - origin; };
    if (cells.n_shared == 2)
      axis -= (axis * edge(1)) / edge(1).norm_square() * edge(1);
    if (cells.n_shared == 3)
      axis = (axis * cross_product_3d(edge(1), edge(2))) * cross_product_3d(edge(1), edge(2));
    double last = cells.n_shared > 0 ? 0 : -1e300, first = cells.n_shared > 0 ? 0 : 1e300;
    for (unsigned int k = cells.n_shared; k < 4; ++k)
    {
      last = std::max(last, axis * edge(k));
      first = std::min(first, axis * (cells.second[k] - origin));
    }
    return last <= first;
  }

  /// Of size 1/3, with a volume of at least 1/20 of that of a cube; the horizon is 1.
  Cells random_cells(Place place, std::mt19937 &random)
  {
    const auto number = [&random] { return 2 * (random() / 4294967296.) - 1; };
    constexpr double size = 1. / 3, thin = size * size * size / 20;
    const auto vector = [&](double length)
    { return Point<3>(length * number(), length * number(), length * number()); };
    Cells cells;
    cells.n_shared = place == Place::cut ? 0 : static_cast<unsigned int>(place) - 1;
    do
    {
      for (Point<3> &x : cells.first)
        x = vector(size);
      Point<3> apart = vector(1);
      apart *= (place == Place::cut ? 1 + .3 * number() : .6) / apart.norm();
      dealii::Tensor<1, 3> shared, others; // centroids
      for (unsigned int k = 0; k < 4; ++k)
        if (k < cells.n_shared)
          shared += cells.first[k] / cells.n_shared;
        else
          others += cells.first[k] / (4 - cells.n_shared);
      for (unsigned int k = 0; k < 4; ++k)
        if (k < cells.n_shared)
          cells.second[k] = cells.first[k];
        else if (cells.n_shared > 0) // on the other side
          cells.second[k] = Point<3>(1.9 * shared - .9 * others + vector(.6 * size));
        else
          cells.second[k] = apart + vector(place == Place::cut ? size : .4 * size);
    } while (volume(cells.first) < thin ||
             volume(cells.second) < (place == Place::inside ? thin / 10 : thin) ||
             (place != Place::same && !are_apart(cells)));
    return cells;
  }

  /// ∬ profile [r < 1]; see FacePotential.
  double by_faces(const Cells &cells, const std::string &type)
  {
    const physics::Kernel<3> kernel(physics::Structure::scalar, physics::kernel_type(type).profile,
                                    1, 1);
    constexpr double tolerance = 1e-13;
    const ExactPairs exact(kernel, FacePotential::Kind::harmonic,
                           tolerance * volume(cells.first) * volume(cells.second));
    struct Side
    {
      PairFace face;
      dealii::Tensor<1, 3> outward;
    };
    const auto side_of = [&](const Corners &x, unsigned int opposite, unsigned int shift)
    {
      PairFace::Vertices vertices;
      std::array<unsigned int, 3> names{};
      for (unsigned int k = 0, place = 0; k < 4; ++k)
        if (k != opposite)
        {
          vertices[place] = x[k];
          names[place++] = k < cells.n_shared ? k : k + shift;
        }
      dealii::Tensor<1, 3> normal =
          cross_product_3d(vertices[1] - vertices[0], vertices[2] - vertices[0]);
      normal /= normal.norm() * (normal * (x[opposite] - vertices[0]) > 0 ? -1 : 1);
      return Side{PairFace(vertices, names), normal};
    };
    double sum = 0;
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < 4; ++j)
      {
        const Side f = side_of(cells.first, i, 0), g = side_of(cells.second, j, 4);
        sum -= f.outward * g.outward * exact(f.face, g.face).value;
      }
    return sum +
           (cells.n_shared == 4 ? 4 * M_PI * kernel.profile().moment(2) * volume(cells.first) : 0);
  }

  template <class Real>
  double by_edges(const Cells &cells, const std::string &type)
  {
    typename TetrahedronPair<Real>::Tetrahedron x, y;
    for (unsigned int k = 0; k < 4; ++k)
      for (unsigned int d = 0; d < 3; ++d)
      {
        x[k][d] = cells.first[k][d];
        y[k][d] = cells.second[k][d];
      }
    const TetrahedronPair<Real> pair(x, y);
    return static_cast<double>(type == "1/r"        ? pair.within(-1)
                               : type == "constant" ? pair.within(0)
                                                    : Real(pair.within(0) - pair.within(1)));
  }

  /// The largest difference, relative to |T| |T'| / 16.
  double largest_difference(Place place, const std::string &type, unsigned int n)
  {
    std::mt19937 random(11 + static_cast<unsigned int>(place));
    double worst = 0;
    for (unsigned int k = 0; k < n; ++k)
    {
      const Cells cells = random_cells(place, random);
      const double unit = volume(cells.first) * volume(cells.second) / 16,
                   value = by_faces(cells, type);
      double difference = std::abs(value - by_edges<long double>(cells, type)) / unit;
      constexpr double suspect = 1e-11;
      if (!(difference < suspect)) // digits of long double may not do for nearly parallel edges
        difference = std::abs(value - by_edges<Quad>(cells, type)) / unit;
      worst = std::max(worst, difference);
    }
    return worst;
  }

  void expect_equal(unsigned int n_of_each)
  {
    for (const Place place : places)
      for (const std::string type : {"constant", "1/r", "linear-decay"})
      {
        const double worst = largest_difference(place, type, n_of_each);
        EXPECT_LT(worst, 1e-10) << static_cast<int>(place) << " " << type;
        testing::Test::RecordProperty("place_" + std::to_string(static_cast<int>(place)) + "_" +
                                          type,
                                      std::to_string(worst * 1e12) + "e-12");
      }
  }
} // namespace

TEST(TetrahedronPairs, by_faces_are_those_by_edges_and_vertices)
{
  expect_equal(11); // 198 in all
}

// 10,080 pairs; a minute or two of one core, in benchmarks/audit.
TEST(TetrahedronPairs, DISABLED_by_faces_are_those_by_edges_and_vertices_many)
{
  expect_equal(560);
}
