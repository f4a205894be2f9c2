#include "geometry/search.h"

#include "geometry/cell_locator.h"
#include "meshes.h"

#include <limits>
#include <random>
#include <thread>

namespace plumbline::geometry
{
  namespace
  {
    using Found = std::vector<unsigned int>;

    class Random
    {
    public:
      explicit Random(unsigned int seed) : engine_(seed) {}

      double uniform(double a, double b)
      {
        return std::uniform_real_distribution<double>(a, b)(engine_);
      }
      Point<2> point() { return Point<2>(uniform(-1, 2), uniform(3, 5)); }

      /// Anywhere, sides up to the given one.
      Box box(double side)
      {
        const Point<2> lower = point();
        return {lower, lower + Point<2>(uniform(0, side), uniform(0, side))};
      }

    private:
      std::mt19937_64 engine_;
    };

    Found brute_force(const std::vector<Box> &boxes, const Box &box)
    {
      Found found;
      for (unsigned int i = 0; i < boxes.size(); ++i)
      {
        bool touches = true;
        for (int k = 0; k < 2; ++k)
          touches =
              touches && boxes[i].lower[k] <= box.upper[k] && box.lower[k] <= boxes[i].upper[k];
        if (touches)
          found.push_back(i);
      }
      return found;
    }

    Found found(const BoxSearch<2> &search, const Box &box)
    {
      Found result;
      search.find(box, result);
      return result;
    }

    /// Queries of all sizes, in and around the boxes, and those that just touch some of them.
    std::vector<Box> queries(const std::vector<Box> &boxes, Random &random)
    {
      std::vector<Box> result;
      for (double side : {0., 1e-3, .03, .2, 5.})
        for (int i = 0; i < 40; ++i)
          result.push_back(random.box(side));
      for (const Point<2> &far : {Point<2>(-50, 0), Point<2>(50, 4), Point<2>(0, 1e9)})
        result.push_back({far, far + Point<2>(1, 1)});
      result.push_back({Point<2>(-1e9, -1e9), Point<2>(1e9, 1e9)});
      for (std::size_t i = 0; i < boxes.size(); ++i)
      {
        const Point<2> &a = boxes[i].lower, &b = boxes[i].upper, reach(.01, .02);
        result.push_back(boxes[i]);
        result.push_back({b, b + reach});
        result.push_back({Point<2>(a - reach), a});
        const double beyond = std::nextafter(b[0], 9.);
        result.push_back({Point<2>(beyond, a[1]), Point<2>(beyond + .01, b[1])});
      }
      return result;
    }

    /// @return how many were found on the whole
    std::size_t expect_none_missed(const std::vector<Box> &boxes, unsigned int seed)
    {
      Random random(seed);
      const BoxSearch<2> search(boxes);
      std::size_t n_found = 0;
      for (const Box &box : queries(boxes, random))
      {
        const Found expected = brute_force(boxes, box);
        EXPECT_EQ(found(search, box), expected) << box.lower << " to " << box.upper;
        n_found += expected.size();
      }
      return n_found;
    }
  } // namespace

  TEST(BoxSearch, FindsAllBoxesOfLikeSize)
  {
    Random random(1);
    std::vector<Box> boxes;
    for (int i = 0; i < 2000; ++i)
      boxes.push_back(random.box(.05));
    EXPECT_GT(expect_none_missed(boxes, 2), 10000u);
  }

  TEST(BoxSearch, FindsTheCellsOfALattice)
  {
    std::vector<Box> boxes; // corners meet, up to rounding
    for (int j = 0; j < 30; ++j)
      for (int i = 0; i < 120; ++i)
        boxes.push_back(
            {Point<2>(-1 + i * .05, 3 + j * .05), Point<2>(-1 + (i + 1) * .05, 3 + (j + 1) * .05)});
    EXPECT_GT(expect_none_missed(boxes, 3), 10000u);
    const BoxSearch<2> search(boxes);
    EXPECT_EQ(found(search, {Point<2>(-.99, 3.01), Point<2>(-.94, 3.02)}), (Found{0, 1}));
    EXPECT_EQ(search.box(121).lower, Point<2>(-1 + .05, 3 + .05));
  }

  TEST(BoxSearch, FindsBoxesOfGradedSizes)
  {
    Random random(4);
    std::vector<Box> boxes;
    for (int i = 0; i < 2000; ++i)
      boxes.push_back(random.box(std::pow(10, random.uniform(-7, 0))));
    EXPECT_GT(expect_none_missed(boxes, 5), 10000u);
  }

  TEST(BoxSearch, FindsPointsAndSegments)
  {
    Random random(6);
    std::vector<Box> boxes;
    for (int i = 0; i < 600; ++i)
    {
      const Point<2> p = random.point();
      boxes.push_back({p, p});
      boxes.push_back({p, p + Point<2>(random.uniform(0, .1), 0)});
      boxes.push_back({p, p + Point<2>(0, random.uniform(0, 2))});
      boxes.push_back({Point<2>(p[0], 4), Point<2>(p[0], 4)}); // on a line
    }
    EXPECT_GT(expect_none_missed(boxes, 7), 10000u);
  }

  TEST(BoxSearch, FindsBoxesThatAreAllTheSame)
  {
    for (double side : {0., 1e-9, 2.})
    {
      const Point<2> p(.3, 4.1);
      EXPECT_GT(expect_none_missed(std::vector<Box>(100, {p, p + Point<2>(side, side)}), 8), 1000u);
    }
  }

  TEST(BoxSearch, FindsSmallBoxesAndTheOneThatHoldsThemAll)
  {
    Random random(9);
    std::vector<Box> boxes;
    for (int i = 0; i < 2000; ++i)
      boxes.push_back(random.box(.01));
    boxes.insert(boxes.begin() + 700, {Point<2>(-1e6, -1e6), Point<2>(1e6, 1e6)});
    boxes.push_back({Point<2>(1e12, 0), Point<2>(1e12 + 1, 1)}); // and one far away
    EXPECT_GT(expect_none_missed(boxes, 10), 5000u);
  }

  TEST(BoxSearch, FindsNothingAmongNone)
  {
    EXPECT_TRUE(found(BoxSearch<2>({}), {Point<2>(-1, -1), Point<2>(1, 1)}).empty());
  }

  TEST(BoxSearch, OverwritesWhatWasFoundBefore)
  {
    const BoxSearch<2> search({{Point<2>(0, 0), Point<2>(1, 1)}});
    Found result{7, 8, 9};
    search.find({Point<2>(.5, .5), Point<2>(2, 2)}, result);
    EXPECT_EQ(result, Found{0});
    search.find({Point<2>(1.5, .5), Point<2>(2, 2)}, result);
    EXPECT_TRUE(result.empty());
  }

  TEST(BoxSearch, MayBeCalledFromManyThreads)
  {
    Random random(11);
    std::vector<Box> boxes;
    for (int i = 0; i < 2000; ++i)
      boxes.push_back(random.box(.05));
    const BoxSearch<2> search(boxes);
    std::vector<std::size_t> n_found(4, 0);
    std::vector<std::thread> threads;
    for (std::size_t &n : n_found)
      threads.emplace_back(
          [&]
          {
            for (const Box &box : boxes)
              n += found(search, box).size();
          });
    for (auto &thread : threads)
      thread.join();
    EXPECT_GT(n_found[0], boxes.size());
    EXPECT_EQ(n_found, std::vector<std::size_t>(4, n_found[0]));
  }

  TEST(BoxSearch, NamesTheBoxThatIsNone)
  {
    const Box good{Point<2>(0, 0), Point<2>(1, 1)};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double huge = std::numeric_limits<double>::infinity();
    for (const Box &bad :
         {Box{Point<2>(0, 0), Point<2>(1, -1)}, Box{Point<2>(0, nan), Point<2>(1, 1)},
          Box{Point<2>(0, 0), Point<2>(huge, 1)}})
      try
      {
        BoxSearch<2>({good, bad});
        ADD_FAILURE() << "no error for " << bad.lower << " to " << bad.upper;
      }
      catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find("box 1"), std::string::npos) << error.what();
      }
  }

  namespace
  {
    /// Meshes of like and of graded cells, at the origin and far away from it.
    std::vector<Mesh> meshes()
    {
      const auto grade = [](const Point<2> &x)
      { return Point<2>(std::exp(5 * x[0]) - 1, std::exp(3 * x[1])); };
      const auto shift = [](const Point<2> &x) { return bend(x) + Point<2>(1000, -500); };
      return {lattice_mesh(unit, .125, .25, false), lattice_mesh(l_shape, .125, .25, true, bend),
              lattice_mesh(with_hole, .125, .1, true, grade),
              lattice_mesh(l_shape, .125, .25, false, shift)};
    }

    /// Among all cells.
    std::optional<std::size_t> brute_force(const Mesh &mesh, const Point<2> &x)
    {
      for (const bool is_inside : {true, false})
        for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
          if (mesh.cells[cell].is_inside == is_inside && contains(view(mesh.polygon(cell)), x))
            return cell;
      return {};
    }
  } // namespace

  TEST(CellLocator, FindsWhatASearchOfAllCellsFinds)
  {
    Random random(12);
    for (const Mesh &mesh : meshes())
    {
      const CellLocator locator(mesh);
      ASSERT_EQ(locator.size(), mesh.cells.size());
      const Box box = bounding_box(view(mesh.vertices));
      int n_found = 0;
      for (int i = 0; i < 2000; ++i)
      {
        Point<2> x;
        for (unsigned int d = 0; d < 2; ++d)
          x[d] = box.lower[d] + random.uniform(-.1, 1.1) * (box.upper[d] - box.lower[d]);
        const auto cell = locator.find(x);
        ASSERT_EQ(cell, brute_force(mesh, x)) << x;
        n_found += cell.has_value();
      }
      EXPECT_GT(n_found, 500);
      EXPECT_LT(n_found, 2000);
    }
  }

  TEST(CellLocator, FindsVerticesAndPointsOfSides)
  {
    Random random(13);
    for (const Mesh &mesh : meshes())
    {
      const CellLocator locator(mesh);
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      {
        const Polygon &polygon = locator.polygon(cell);
        EXPECT_EQ(polygon, mesh.polygon(cell));
        EXPECT_EQ(locator.at(centroid(view(polygon))), cell);
        for (std::size_t v = 0; v < polygon.size(); ++v)
          for (const double share : {0., .5, random.uniform(0, 1)})
          {
            const Point<2> &a = polygon[v], &b = polygon[(v + 1) % polygon.size()];
            const Point<2> x = a + share * (b - a);
            const auto found = locator.find(x);
            ASSERT_TRUE(found) << x;
            EXPECT_EQ(found, brute_force(mesh, x));
            // the boundary of Ω lies in Ω
            EXPECT_TRUE(locator.is_inside(*found) || !mesh.cells[cell].is_inside) << x;
          }
      }
    }
  }

  TEST(CellLocator, FindsPointsThatRoundingPutsBesideTheBoundary)
  {
    const CellLocator alone(lattice_mesh(unit, .25, 0, false)); // [0, 1]²
    for (const Point<2> &x : {Point<2>(-5e-17, .6), Point<2>(.6, 1 + 2e-16), Point<2>(.3, -1e-17)})
      EXPECT_TRUE(alone.find(x)) << x;
    for (const Point<2> &x : {Point<2>(-1e-14, .6), Point<2>(.6, 1 + 1e-14), Point<2>(2, 3)})
      EXPECT_FALSE(alone.find(x)) << x;
    // of Ω, although cells of the collar hold it too
    const CellLocator both(lattice_mesh(unit, .25, .25, false));
    EXPECT_TRUE(both.is_inside(both.at(Point<2>(-5e-17, .6))));
    EXPECT_FALSE(both.is_inside(both.at(Point<2>(-1e-14, .6))));
  }

  TEST(CellLocator, FindsTheCellsAroundABox)
  {
    const Mesh mesh = lattice_mesh(unit, .25, .25, false); // 6 x 6 squares from (-.25, -.25)
    const CellLocator locator(mesh);
    Found cells;
    locator.find({Point<2>(.1, .1), Point<2>(.3, .2)}, cells);
    EXPECT_EQ(cells, (Found{7, 8}));
    locator.find({Point<2>(-.1, -.1), Point<2>(.1, -.1)}, cells);
    EXPECT_EQ(cells, (Found{0, 1}));
    EXPECT_TRUE(locator.is_inside(7));
    EXPECT_FALSE(locator.is_inside(1));
  }

  TEST(CellLocator, NamesThePointOutside)
  {
    const CellLocator locator(lattice_mesh(with_hole, .125, .125, false));
    EXPECT_TRUE(says(error_of([&] { (void)locator.at(Point<2>(.5, .5)); }), // in the hole
                     "the point (0.5, 0.5) lies outside of the domain and its collar"));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(locator.find(Point<2>(nan, .1)));
    EXPECT_TRUE(says(error_of([&] { (void)locator.at(Point<2>(0, 1e300)); }), "(0, 1e+300)"));
  }

  TEST(BoundingBox, HoldsAllVertices)
  {
    const std::vector<Point<2>> vertices{Point<2>(1, 5), Point<2>(-2, 3), Point<2>(0, 7)};
    const Box box = bounding_box(vertices);
    EXPECT_EQ(box.lower, Point<2>(-2, 3));
    EXPECT_EQ(box.upper, Point<2>(1, 7));
  }
} // namespace plumbline::geometry
