#include "report/surfaces.h"

#include "report/statics_view.h"
#include "tests/report/fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

namespace plumbline::report
{
  namespace
  {
    /// u = 2 x in an L of cells: 4 x 4 x 3 of side 1/2 from (1, 0, 0) without a quarter.
    study::SolutionGrid l_shape()
    {
      study::SolutionGrid grid;
      grid.method = "Q1";
      grid.problem = "u";
      grid.series = "m = 3";
      grid.h = .5;
      grid.horizon = 1.5;
      grid.lower = {1, 0, 0};
      grid.upper = {3, 2, 1.5};
      grid.first = {1.25, .25, .25};
      grid.spacing = .5;
      grid.n = {4, 4, 3};
      for (unsigned int z = 0; z < 3; ++z)
        for (unsigned int y = 0; y < 4; ++y)
          for (unsigned int x = 0; x < 4; ++x)
            grid.values.push_back(x >= 2 && y >= 2 ? std::numeric_limits<double>::quiet_NaN()
                                                   : 2 * (grid.first[0] + x * grid.spacing));
      return grid;
    }

    bool holds(const std::string &text, const std::string &part)
    {
      return text.find(part) != std::string::npos;
    }

    /// Of triangles with their first point repeated: the area of their shadows along x.
    struct Surface
    {
      double area = 0, lowest_x = 1e300, highest_x = -1e300;
    };
    Surface surface(const std::string &script, unsigned int i)
    {
      const std::string begin = "$s" + std::to_string(i) + " << EOD\n";
      const std::size_t at = script.find(begin) + begin.size();
      std::istringstream text(script.substr(at, script.find("EOD", at) - at));
      Surface result;
      std::vector<std::array<double, 3>> points;
      for (std::array<double, 3> p{}; text >> p[0] >> p[1] >> p[2];)
      {
        result.lowest_x = std::min(result.lowest_x, p[0]);
        result.highest_x = std::max(result.highest_x, p[0]);
        points.push_back(p);
      }
      EXPECT_EQ(points.size() % 4, 0u);
      for (std::size_t t = 0; t + 3 < points.size(); t += 4)
      {
        EXPECT_EQ(points[t], points[t + 3]);
        result.area +=
            std::abs((points[t + 1][1] - points[t][1]) * (points[t + 2][2] - points[t][2]) -
                     (points[t + 1][2] - points[t][2]) * (points[t + 2][1] - points[t][1])) /
            2;
      }
      return result;
    }
  } // namespace

  TEST(Surfaces, OfALinearFieldArePlanesBetweenTheCentresOfCells)
  {
    const std::string script = surfaces_script(l_shape(), "surfaces.svg");
    // centres from 1.25 to 2.75: u = 3.25, 4, 4.75 at x = 1.625, 2, 2.375
    const Surface first = surface(script, 0), last = surface(script, 2);
    EXPECT_NEAR(first.lowest_x, 1.625, 1e-3);
    EXPECT_NEAR(first.highest_x, 1.625, 1e-3);
    EXPECT_NEAR(last.lowest_x, 2.375, 1e-3);
    EXPECT_NEAR(last.highest_x, 2.375, 1e-3);
    EXPECT_NEAR(first.area, 1.5 * 1, 1e-3); // y from .25 to 1.75
    EXPECT_NEAR(last.area, .5 * 1, 1e-3);   // y up to .75: nothing where there is no body
    for (const std::string key : {"u = 3.25", "u = 4", "u = 4.75"})
      EXPECT_TRUE(holds(script, "title '" + key + "'")) << key;
    EXPECT_EQ(surfaces_title(l_shape()), "u, m = 3, h = 0.5: isosurfaces of u computed with Q1");
  }

  TEST(Surfaces, AreNotThereWhereNoneCanBeDrawn)
  {
    study::SolutionGrid grid = l_shape();
    std::fill(grid.values.begin(), grid.values.end(), 1.);
    EXPECT_EQ(surfaces_script(grid, "a.svg"), "");
    grid.values.front() += 1e-14; // round-off
    EXPECT_EQ(surfaces_script(grid, "a.svg"), "");
    grid = l_shape();
    grid.n = {4, 4, 1};
    grid.values.resize(16);
    EXPECT_EQ(surfaces_script(grid, "a.svg"), "");
  }

  TEST(Surfaces, AndMapsOfThreeLayersAreOnThePage)
  {
    const fixture::Folder folder;
    study::StudyResults results = fixture::results();
    const std::vector<study::ErrorMap> plane = results.maps;
    for (study::ErrorMap map : plane)
    {
      map.axes = "xz";
      map.solution.assign(map.values.size(), .5);
      results.maps.push_back(map);
    }
    results.solution_grids = {l_shape()};
    results.solution_grids.push_back(l_shape());
    results.solution_grids[0].method = "FA"; // the Galerkin method is drawn
    unsigned int n_found = 0;
    for (const Gallery &gallery : statics_galleries(results))
    {
      std::vector<std::string> names;
      for (const Picture &picture : gallery.pictures)
        names.push_back(picture.name);
      if (gallery.id == "solution")
      {
        ++n_found;
        EXPECT_EQ(names, (std::vector<std::string>{"solution-xz", "surfaces"}));
        EXPECT_EQ(gallery.pictures[1].title, surfaces_title(l_shape()));
        EXPECT_EQ(gallery.pictures[1].data.rows.size(), 36u);
        EXPECT_EQ(gallery.pictures[0].data.columns.at(5).head, "z [length]");
      }
      if (gallery.id == "maps")
      {
        ++n_found;
        EXPECT_EQ(names, (std::vector<std::string>{"error-maps", "error-maps-xz"}));
      }
    }
    EXPECT_EQ(n_found, 2u);
  }
} // namespace plumbline::report
