// Ellipses placed at random: what they cover, that no place differs from another, what is refused.
#include "uq/ellipses.h"
#include "base/error.h"
#include "refusal.h"
#include "uq/torus_packing.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::uq;

namespace
{
  using Ellipse = Ellipses::Ellipse;

  /// Of glass-ceramics: Fan et al. 2022, doi:10.1016/j.cma.2022.115340, sec. 5 [µm].
  const std::array<double, 2> grain{12, 7.5};
  const Box plate{{0, 0}, {800, 400}};

  EllipseModel model(double fraction, bool overlap = true)
  {
    return {grain, fraction, overlap};
  }

  Ellipse turned(double x, double y, double angle)
  {
    return {{x, y}, std::cos(angle), std::sin(angle)};
  }

  bool is_in(const std::array<double, 2> &semi_axes, const Ellipse &e, const Point<2> &x)
  {
    const double dx = x[0] - e.centre[0], dy = x[1] - e.centre[1];
    return std::hypot((e.cosine * dx + e.sine * dy) / semi_axes[0],
                      (e.cosine * dy - e.sine * dx) / semi_axes[1]) <= 1;
  }

  /// Whether the boundary of one has a point in the other, by many points.
  bool meet_by_points(const Ellipse &first, const Ellipse &second)
  {
    constexpr int n_points = 2000;
    for (int k = 0; k < n_points; ++k)
    {
      const double s = grain[0] * std::cos(2 * M_PI * k / n_points),
                   t = grain[1] * std::sin(2 * M_PI * k / n_points);
      if (is_in(grain, second,
                {first.centre[0] + first.cosine * s - first.sine * t,
                 first.centre[1] + first.sine * s + first.cosine * t}))
        return true;
    }
    return false;
  }

  bool meet(const Ellipse &first, const Ellipse &second)
  {
    return uq::meet(grain, first, second, second.centre[0] - first.centre[0],
                    second.centre[1] - first.centre[1]);
  }

  std::string refusal_of(const EllipseModel &model)
  {
    return refusal([&] { Ellipses::draw(model, {{0, 0}, {200, 100}}, 1); });
  }

  /// How often points of a box are covered that lie in corners, at edges and inside, over samples,
  /// each by how many standard errors it is off the fraction.
  void expect_one_probability(const EllipseModel &model, int n_samples)
  {
    const Box box{{-30, 10}, {70, 60}};
    const std::vector<Point<2>> places{{-30, 10}, {70, 10}, {70, 60}, {-30, 60}, {20, 10},
                                       {-30, 35}, {20, 60}, {70, 35}, {20, 35},  {0, 30}};
    std::vector<int> covered(places.size());
    for (int sample = 0; sample < n_samples; ++sample)
    {
      const Ellipses ellipses = Ellipses::draw(model, box, 7, sample);
      for (std::size_t i = 0; i < places.size(); ++i)
        covered[i] += ellipses.covers(places[i]);
    }
    const double error = std::sqrt(model.fraction * (1 - model.fraction) / n_samples);
    constexpr double most_standard_errors = 4; // one of 10 places for one seed in 1,500
    for (std::size_t i = 0; i < places.size(); ++i)
      EXPECT_LT(std::abs(double(covered[i]) / n_samples - model.fraction),
                most_standard_errors * error)
          << "at (" << places[i] << ")";
  }
} // namespace

TEST(Ellipses, cover_what_one_of_them_covers)
{
  const Ellipses ellipses = Ellipses::draw(model(.5), plate, 3);
  const Grid grid = make_grid(plate, 7);
  const std::vector<double> at_nodes = ellipses.at_nodes(grid);
  double sum = 0;
  for (int j = 0; j < grid.n[1]; ++j)
    for (int i = 0; i < grid.n[0]; ++i)
    {
      const Point<2> x = grid.node(i, j);
      bool covered = false;
      for (const Ellipse &ellipse : ellipses.ellipses())
        covered = covered || is_in(grain, ellipse, x);
      EXPECT_EQ(ellipses.covers(x), covered) << x;
      EXPECT_EQ(at_nodes[std::size_t(j) * grid.n[0] + i], covered ? 1 : 0);
      sum += covered;
    }
  EXPECT_DOUBLE_EQ(ellipses.fraction_covered(grid), sum / double(grid.size()));
}

TEST(Ellipses, of_given_place_and_angle_reach_as_far_as_their_axes_and_beyond_the_box)
{
  const Ellipses ellipses({2, 1}, {{0, 0}, {10, 10}},
                          {turned(5, 5, 0), turned(-1, 2, 0), turned(8, 8, M_PI / 4)});
  EXPECT_TRUE(ellipses.covers({6.999, 5}));
  EXPECT_FALSE(ellipses.covers({7.001, 5}));
  EXPECT_TRUE(ellipses.covers({5, 5.999}));
  EXPECT_FALSE(ellipses.covers({5, 6.001}));
  EXPECT_TRUE(ellipses.covers({.999, 2})); // its centre is outside
  const double along = 1.999 / std::sqrt(2), across = 1.001 / std::sqrt(2);
  EXPECT_TRUE(ellipses.covers({8 + along, 8 + along}));
  EXPECT_FALSE(ellipses.covers({8 + across, 8 - across}));
}

TEST(Ellipses, that_overlap_are_as_many_as_the_Boolean_model_says)
{
  // with centres in the box of sec. 5: -A ln(1 - f) / (πab)
  const double expected[4] = {252.5, 578.1, 1037, 1821.5};
  for (int k = 0; k < 4; ++k)
  {
    constexpr int n_samples = 100;
    double n = 0;
    for (int sample = 0; sample < n_samples; ++sample)
      for (const Ellipse &e : Ellipses::draw(model(.2 * (k + 1)), plate, 11, sample).ellipses())
        n += e.centre[0] >= 0 && e.centre[0] <= 800 && e.centre[1] >= 0 && e.centre[1] <= 400;
    EXPECT_LT(std::abs(n / n_samples - expected[k]), 4 * std::sqrt(expected[k] / n_samples));
  }
}

TEST(Ellipses, that_overlap_cover_corners_and_edges_as_often_as_the_middle)
{
  expect_one_probability(model(.2), 4000);
  expect_one_probability(model(.8), 4000);
}

TEST(Ellipses, that_do_not_overlap_cover_corners_and_edges_as_often_as_the_middle)
{
  expect_one_probability(model(.2, false), 4000);
  expect_one_probability(model(.45, false), 2000);
}

TEST(Ellipses, that_do_not_overlap_do_not)
{
  const auto ellipses = Ellipses::draw(model(.5, false), plate, 5).ellipses();
  EXPECT_GT(ellipses.size(), 500u);
  for (std::size_t i = 0; i < ellipses.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(ellipses[i].centre.distance(ellipses[j].centre) <= 24.1 &&
                   meet_by_points(ellipses[i], ellipses[j]))
          << i << ' ' << j;
}

TEST(Ellipses, meet_where_their_points_say_so)
{
  int n_meeting = 0;
  for (int k = 0; k < 2000; ++k) // angles and distances of all kinds
  {
    const Ellipse first = turned(0, 0, 2.1 * k), second = turned(12 + 12 * std::sin(1.3 * k), 4, k);
    const bool expected = meet_by_points(first, second) || meet_by_points(second, first);
    EXPECT_EQ(meet(first, second), expected) << k;
    EXPECT_EQ(meet(second, first), expected) << k;
    n_meeting += expected;
  }
  EXPECT_GT(n_meeting, 700);
  EXPECT_LT(n_meeting, 1700);
}

TEST(Ellipses, meet_up_to_where_they_touch)
{
  for (const double shift : {-1e-11, 1e-11}) // relative
  {
    const double scale = 1 + shift;
    const bool expected = shift < 0;
    EXPECT_EQ(meet(turned(0, 0, 0), turned(24 * scale, 0, 0)), expected); // end to end
    EXPECT_EQ(
        meet(turned(0, 0, .3), turned(-15 * std::sin(.3) * scale, 15 * std::cos(.3) * scale, .3)),
        expected);                                                                 // side by side
    EXPECT_EQ(meet(turned(0, 0, 0), turned(19.5 * scale, 0, M_PI / 2)), expected); // end to side
  }
}

TEST(Ellipses, that_do_not_overlap_refuse_a_fraction_beyond_jamming_with_the_one_they_reached)
{
  // disks jam at .547 (Hinrichsen, Feder & Jossang 1986, doi:10.1007/BF01011908); a finite number
  // of places tried stops before, here by some .01, and a torus of this size spreads by .005
  const std::string text = refusal_of({{3, 3}, .6, false});
  EXPECT_EQ(text.substr(0, 74),
            "area fraction = 0.6 of ellipses that do not overlap is not reached by addi");
  const std::size_t at = text.find("at 0.");
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_GT(std::stod(text.substr(at + 3)), .52);
  EXPECT_LT(std::stod(text.substr(at + 3)), .555);
  EXPECT_NE(text.find("choose a fraction below that, or let them overlap"), std::string::npos);
}

TEST(Ellipses, are_those_of_their_seed_and_sample)
{
  const Ellipses a = Ellipses::draw(model(.3), plate, 5, 2),
                 b = Ellipses::draw(model(.3), plate, 5, 2),
                 c = Ellipses::draw(model(.3), plate, 5, 3);
  ASSERT_EQ(a.ellipses().size(), b.ellipses().size());
  EXPECT_EQ(a.ellipses()[7].centre, b.ellipses()[7].centre);
  EXPECT_NE(a.ellipses()[7].centre, c.ellipses()[7].centre);
  EXPECT_TRUE(Ellipses::draw(model(0), plate, 1).ellipses().empty());
}

TEST(Ellipses, refuse_what_is_none_with_the_number_and_the_remedy)
{
  EXPECT_EQ(refusal_of(model(1)), "ellipses: area fraction = 1 cannot be used; give one in [0, 1)");
  EXPECT_NE(refusal_of({{12, 0}, .2, true}).find("semi-axis = 0 cannot be used; give lengths > 0"),
            std::string::npos);
  EXPECT_NE(refusal_of({{std::nan(""), 1}, .2, true}).find("semi-axis = nan"), std::string::npos);
  EXPECT_THROW(Ellipses::draw(model(.2), {{0, 0}, {0, 1}}, 1), InputError);
  for (const bool overlap : {true, false})
    EXPECT_NE(refusal_of({{1e-5, 1e-5}, .2, overlap}).find("choose larger ones, 1e7 are the most"),
              std::string::npos);
}
