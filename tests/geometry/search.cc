#include "geometry/search.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>
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

    Found found(const BoxSearch &search, const Box &box)
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
      const BoxSearch search(boxes);
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
    const BoxSearch search(boxes);
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
    EXPECT_TRUE(found(BoxSearch({}), {Point<2>(-1, -1), Point<2>(1, 1)}).empty());
  }

  TEST(BoxSearch, OverwritesWhatWasFoundBefore)
  {
    const BoxSearch search({{Point<2>(0, 0), Point<2>(1, 1)}});
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
    const BoxSearch search(boxes);
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
        BoxSearch({good, bad});
        ADD_FAILURE() << "no error for " << bad.lower << " to " << bad.upper;
      }
      catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find("box 1"), std::string::npos) << error.what();
      }
  }

  TEST(BoundingBox, HoldsAllVertices)
  {
    const std::vector<Point<2>> vertices{Point<2>(1, 5), Point<2>(-2, 3), Point<2>(0, 7)};
    const Box box = bounding_box(vertices);
    EXPECT_EQ(box.lower, Point<2>(-2, 3));
    EXPECT_EQ(box.upper, Point<2>(1, 7));
  }
} // namespace plumbline::geometry
