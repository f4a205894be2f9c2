// Where pairs of cells, of their sides, and sides in circles stand to the horizon: exact predicates
// against integers, and what assembly decides against exact predicates.
#include "reference/mesh/inclusion_check.h"
#include "geometry/mesh_input.h"
#include "reference/mesh/edge_pairs.h"

#include <gtest/gtest.h>

#include <random>

namespace
{
  using namespace plumbline;
  using geometry::Mesh;
  using geometry::PairPosition;
  using geometry::Point;
  using geometry::Verdict;
  using reference::Decider;
  using reference::MeshCells;
  using reference::MeshSpace;

  const geometry::Domain unit_square{{{Point<2>(0, 0), Point<2>(1, 1)}}, {}};

  /// Triangles on a lattice, all vertices moved by up to a part of h.
  Mesh triangles(double h, double horizon, double part)
  {
    Mesh mesh = geometry::lattice_mesh(unit_square, h, horizon, true);
    std::mt19937 random(3);
    for (auto &vertex : mesh.vertices)
      for (unsigned int d = 0; d < 2; ++d)
        vertex[d] += part * h * (2. * random() / random.max() - 1);
    return mesh;
  }

  /// In steps of a lattice.
  struct Integers
  {
    long x = 0, y = 0;

    Integers operator-(const Integers &other) const { return {x - other.x, y - other.y}; }
    long dot(const Integers &other) const { return x * other.x + y * other.y; }
    long cross(const Integers &other) const { return x * other.y - y * other.x; }
  };

  std::vector<Integers> corners(const Mesh &mesh, std::size_t cell, double h)
  {
    std::vector<Integers> result;
    for (const Point<2> &v : mesh.polygon(cell))
      result.push_back({std::lround(v[0] / h), std::lround(v[1] / h)});
    return result;
  }

  bool is_nearer(const Integers &p, const Integers &a, const Integers &b, long square)
  {
    const Integers side = b - a, to = p - a;
    const long along = to.dot(side), length = side.dot(side);
    if (along <= 0)
      return to.dot(to) < square;
    if (along >= length)
      return (p - b).dot(p - b) < square;
    return to.cross(side) * to.cross(side) < square * length;
  }

  /// @param square  of the horizon; ties: farthest or nearest points exactly at it
  PairPosition brute_force(const std::vector<Integers> &a, const std::vector<Integers> &b,
                           long square)
  {
    long farthest = 0;
    bool is_near = false;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
      {
        farthest = std::max(farthest, (a[i] - b[j]).dot(a[i] - b[j]));
        is_near = is_near || is_nearer(a[i], b[j], b[(j + 1) % 3], square) ||
                  is_nearer(b[j], a[i], a[(i + 1) % 3], square);
      }
    return farthest <= square ? PairPosition::inside
           : is_near          ? PairPosition::cut
                              : PairPosition::apart;
  }

  std::vector<physics::Kernel<2>> kernels(double horizon)
  {
    using physics::RadialProfile;
    return {physics::Kernel<2>::with_diffusion(RadialProfile::Powers{{1, 0}}, horizon, 1),
            physics::Kernel<2>::with_diffusion(RadialProfile::Powers{{1, -1}}, horizon, 1),
            physics::Kernel<2>::with_diffusion(RadialProfile::table({{0, 2}, {.7, 1}, {1, .2}}),
                                               horizon, 1),
            physics::Kernel<2>::with_bulk_modulus(RadialProfile::Powers{{1, -1}}, horizon, 1)};
  }

  constexpr double a_millionth = 1e-6;
} // namespace

TEST(PairPosition, OfTrianglesOfALatticeIsThatOfIntegers)
{
  const double h = .125;
  for (const unsigned int m : {2u, 3u, 5u}) // 5 is the length of (3, 4), too
  {
    const Mesh mesh = triangles(h, m * h, 0);
    const MeshCells cells(mesh);
    const long square = static_cast<long>(m) * m;
    unsigned int n_inside = 0, n_cut = 0, n_apart = 0, n_ties = 0;
    for (std::size_t a = mesh.cells.size() / 2; a < mesh.cells.size() / 2 + 2; ++a)
      for (std::size_t b = 0; b < mesh.cells.size(); ++b)
      {
        const auto p = corners(mesh, a, h), q = corners(mesh, b, h);
        const PairPosition expected = brute_force(p, q, square);
        n_inside += expected == PairPosition::inside;
        n_cut += expected == PairPosition::cut;
        n_apart += expected == PairPosition::apart;
        // farthest or nearest points at the horizon: a little shorter or longer, and they are cut
        n_ties += (expected == PairPosition::inside) &&
                  brute_force(p, q, square - 1) != PairPosition::inside;
        const auto of_a = mesh.polygon(a), of_b = mesh.polygon(b);
        EXPECT_EQ(geometry::exact_position(geometry::view(of_a), geometry::view(of_b), m * h),
                  expected);
        EXPECT_EQ(cells.position(a, b, m * h), expected);
      }
    EXPECT_GT(n_inside, 0u);
    EXPECT_GT(n_cut, n_inside / 2);
    EXPECT_GT(n_apart, n_cut);
    EXPECT_GT(n_ties, 0u);
  }
}

TEST(PairPosition, WrongByAMillionthOfTheHorizonIsFound)
{
  for (const double part : {0., .2})
  {
    const double h = .125, horizon = 3 * h;
    const Mesh mesh = triangles(h, horizon, part);
    const MeshCells cells(mesh);
    const std::size_t a = mesh.cells.size() / 2;
    const auto of_a = mesh.polygon(a);
    for (std::size_t b = 0; b < mesh.cells.size(); ++b)
    {
      if (a == b)
        continue;
      const auto of_b = mesh.polygon(b);
      const auto verdict = [&](double taken_for, double length)
      {
        return judge(cells.position(a, b, taken_for), geometry::view(of_a), geometry::view(of_b),
                     length);
      };
      const double farthest = cells.farthest(a, b);
      EXPECT_NE(verdict(farthest, farthest), Verdict::wrong);
      EXPECT_EQ(verdict(farthest * (1 + a_millionth / 2), farthest * (1 - a_millionth / 2)),
                Verdict::wrong);
      EXPECT_EQ(verdict(farthest * (1 + 1e-14), farthest * (1 - 1e-14)), Verdict::tie);
      double nearest = farthest;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          nearest = std::min(nearest, reference::distance({of_a[i], of_a[(i + 1) % 3]},
                                                          {of_b[j], of_b[(j + 1) % 3]}));
      if (nearest > 0)
      {
        EXPECT_EQ(verdict(nearest * (1 - a_millionth / 2), nearest * (1 + a_millionth / 2)),
                  Verdict::wrong);
      }
      // what may be anything costs time alone
      EXPECT_EQ(judge(PairPosition::cut, geometry::view(of_a), geometry::view(of_b), 2 * farthest),
                Verdict::open);
    }
  }
}

TEST(PairPosition, OfPartsOfSidesInCirclesWrongByAMillionthIsFound)
{
  std::mt19937 random(1);
  const auto draw = [&] { return 2. * random() / std::mt19937::max() - 1; };
  unsigned int n_crossings = 0, n_none = 0;
  for (unsigned int trial = 0; trial < 2000; ++trial)
  {
    const reference::Segment side(Point<2>(2 * draw(), 2 * draw()),
                                  Point<2>(2 * draw(), 2 * draw()));
    const Point<2> x(draw(), draw());
    const double radius = .9;
    const auto judged = [&](double taken_for)
    {
      const reference::SquaredDistance square(side.start - x, side.along);
      return geometry::judge_part(square.below(taken_for * taken_for, 0, 1), x, radius, side.start,
                                  side.end);
    };
    EXPECT_EQ(judged(radius), Verdict::right);
    const auto part =
        reference::SquaredDistance(side.start - x, side.along).below(radius * radius, 0, 1);
    const bool is_none = !(part[1] > part[0]),
               has_crossing = !is_none && (part[0] > 0 || part[1] < 1);
    n_none += is_none;
    n_crossings += has_crossing;
    for (const double factor : {1 - a_millionth, 1 + a_millionth})
      if (has_crossing)
      {
        EXPECT_EQ(judged(factor * radius), Verdict::wrong);
      }
    // as if it were outside, or all of it inside
    if (!is_none)
    {
      EXPECT_EQ(geometry::judge_part({0, 0}, x, radius, side.start, side.end), Verdict::wrong);
    }
    if (is_none || has_crossing)
    {
      EXPECT_EQ(geometry::judge_part({0, 1}, x, radius, side.start, side.end), Verdict::wrong);
    }
  }
  EXPECT_GT(n_crossings, 500u);
  EXPECT_GT(n_none, 100u);
  // from the circle inwards, and touching it
  const Point<2> centre(0, 0);
  EXPECT_EQ(geometry::judge_part({0, 1}, centre, 1, {1, 0}, {0, 0}), Verdict::right);
  EXPECT_EQ(geometry::judge_part({0, 0}, centre, 1, {1, -1}, {1, 1}), Verdict::right);
  EXPECT_EQ(geometry::judge_part({0, 1}, centre, 1, {1 + 1e-15, 0}, {0, 0}), Verdict::tie);
  EXPECT_EQ(geometry::judge_part({0, 0}, centre, 1, {1 - 1e-15, -1}, {1 - 1e-15, 1}), Verdict::tie);
}

TEST(InclusionCheck, FindsDecisionsRightOnLatticesAndMovedMeshes)
{
  for (const double h : {.125, .1}) // .1: vertices are rounded
    for (const double part : {0., .2})
      for (const auto &kernel : kernels(4 * h))
        for (const Decider decider : {Decider::edges, Decider::sides_of_pairs})
        {
          const Mesh mesh = triangles(h, 4 * h, part);
          const MeshSpace space(std::make_shared<const Mesh>(mesh), decider == Decider::edges, 1);
          const auto check =
              reference::check_inclusions(space, MeshCells(mesh), kernel, decider, 100, 1);
          EXPECT_EQ(check.n_pairs(), 100u);
          EXPECT_GT(check.n_inside, 5u);
          EXPECT_GT(check.n_cut, 20u);
          EXPECT_GT(check.n_apart, 5u);
          EXPECT_GT(check.n_decisions, 100u * 10);
          EXPECT_EQ(check.n_wrong, 0u);
          if (part > 0)
          {
            EXPECT_EQ(check.n_ties, 0u);
          }
          if (decider == Decider::sides_of_pairs) // not by circles about them, but by vertices
          {
            EXPECT_EQ(check.n_open, 0u);
          }
          EXPECT_NE(check.text().find("apart as CGAL's exact predicates say in all"),
                    std::string::npos);
        }
}

TEST(InclusionCheck, SeesHorizonsThatEndHalfAMillionthBesideALattice)
{
  const double h = .125;
  for (const double factor : {1 - a_millionth / 2, 1 + a_millionth / 2})
    for (const double m : {3., 4.})
      for (const Decider decider : {Decider::edges, Decider::sides_of_pairs})
      {
        const double horizon = factor * m * h;
        const Mesh mesh = triangles(h, (m + 1) * h, 0);
        const MeshSpace space(std::make_shared<const Mesh>(mesh), decider == Decider::edges, 1);
        const auto check = reference::check_inclusions(space, MeshCells(mesh), kernels(horizon)[0],
                                                       decider, 300, 1);
        EXPECT_EQ(check.n_wrong, 0u);
        EXPECT_EQ(check.n_ties, 0u);
      }
}

TEST(InclusionCheck, FindsDecisionsThatTakeTheMeshToBeSmallerByAMillionth)
{
  const double h = .125, horizon = 3 * std::sqrt(2.) * h * (1 - a_millionth / 2);
  const Mesh mesh = triangles(h, 5 * h, 0);
  Mesh smaller = mesh;
  for (Point<2> &vertex : smaller.vertices)
    vertex *= 1 - a_millionth;
  const auto check = [&](const Mesh &taken)
  {
    const MeshSpace space(std::make_shared<const Mesh>(taken), true, 1);
    return reference::check_inclusions(space, MeshCells(mesh), kernels(horizon)[0], Decider::edges,
                                       300, 1);
  };
  EXPECT_EQ(check(mesh).n_wrong, 0u);
  EXPECT_GT(check(smaller).n_wrong, 0u);
}

TEST(InclusionCheck, TellsWhatIsWrong)
{
  reference::InclusionCheck check;
  check.n_inside = 1;
  check.n_cut = 2;
  check.n_apart = 3;
  check.n_decisions = 99;
  const std::string right =
      "6 pairs of cells, their sides, and parts of sides in circles: inside the horizon, cut by it "
      "or apart as CGAL's exact predicates say in all of them";
  EXPECT_EQ(check.text(), right);
  check.n_ties = 1;
  EXPECT_EQ(check.text(), right + ", but for ties within 1e-13 of the horizon");
  check.n_wrong = 2;
  EXPECT_NE(check.text().find("apart NOT as CGAL's exact predicates say in 2 of 99 decisions"),
            std::string::npos);
}
