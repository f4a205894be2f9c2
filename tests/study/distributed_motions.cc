// Motions in space on many ranks: errors, energies, critical steps, curves and frames are those of
// one rank.
#include "method/mass_root.h"
#include "study/transient.h"
#include "tests/study/space_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using namespace plumbline::study::in_space;
  using base::Communicator;

  constexpr double rounding = 1e-12;

  struct Found
  {
    StudyResults results;
    std::vector<double> frames; ///< all numbers of frames, on the first rank
  };

  Found find(const Settings &settings, const Communicator &ranks)
  {
    Found found;
    const scene::Scene scene = make_scene(with({{"Time/final time", "0.3"},
                                                {"Time/schemes", "velocity Verlet"},
                                                {"Study/norms", "nodal Linf, nodal L2"},
                                                {"Study/h", "1/4"}},
                                               settings));
    TransientOptions options;
    options.ranks = ranks;
    options.on_frame = [&](const Record &, const Frame &frame)
    {
      found.frames.push_back(frame.t);
      for (const auto &node : frame.nodes)
        for (unsigned int d = 0; d < 3; ++d)
          found.frames.push_back(node[d]);
      for (const auto *list : {&frame.u, &frame.v})
        found.frames.insert(found.frames.end(), list->begin(), list->end());
    };
    const Methods all = available(), methods = choose_methods(scene, all);
    const Analysis analysis = transient_analysis(all, options);
    analysis.check(scene, methods, 0);
    RunControl control;
    control.ranks = ranks;
    found.results = run_study(analysis, scene, methods, control);
    return found;
  }

  void expect_equal(const std::vector<double> &found, const std::vector<double> &expected,
                    const std::string &what, double tolerance)
  {
    ASSERT_EQ(found.size(), expected.size()) << what;
    double largest = 1;
    for (const double value : expected)
      largest = std::max(largest, std::abs(value));
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], expected[i], tolerance * largest) << what << ", " << i;
  }

  void expect_same_on_all_ranks(const Settings &settings, double tolerance = rounding)
  {
    const Found together = find(settings, Communicator::all());
    if (Communicator::all().rank() != 0)
    {
      EXPECT_TRUE(together.frames.empty());
      return; // numbers are reduced, and frames come to the first rank
    }
    const Found alone = find(settings, Communicator::alone());
    ASSERT_FALSE(alone.results.records.empty());
    ASSERT_EQ(together.results.records.size(), alone.results.records.size());
    for (std::size_t i = 0; i < alone.results.records.size(); ++i)
    {
      const Record &found = together.results.records[i], &expected = alone.results.records[i];
      const std::string label = expected.key.label();
      ASSERT_EQ(found.failure, "");
      ASSERT_EQ(expected.failure, "");
      EXPECT_EQ(found.texts, expected.texts);
      ASSERT_EQ(found.scalars.size(), expected.scalars.size());
      // Lanczos' method finds it to 1e-4 and is sensitive to rounding; steps are T / n
      for (const auto &[name, scalar] : expected.scalars)
        EXPECT_NEAR(found[name], scalar.value,
                    (name == "critical step" ? 1e-4 : tolerance) *
                        std::max(1., std::abs(scalar.value)))
            << label << ", " << name;
      ASSERT_EQ(found.curves.size(), expected.curves.size());
      for (const auto &[name, curve] : expected.curves)
        for (std::size_t k = 0; k < curve.size(); ++k)
          expect_equal(found.curves.at(name)[k].values, curve[k].values,
                       label + ", " + name + ", " + curve[k].name, tolerance);
    }
    expect_equal(together.frames, alone.frames, "frames", tolerance);
  }

  const std::string moving = "(x^2*y + z^2 + x*y*z)*(1 + t^2)";
} // namespace

TEST(DistributedMotions, have_the_numbers_of_one_rank)
{
  expect_same_on_all_ranks({{"Methods/names", "FA, IPA-AC-R2, Q1, DGQ0"},
                            {"Problem/solution", moving},
                            {"Time/mass", "lumped"},
                            {"Time/damping", "0.3"},
                            {"Time/frames", "3"}});
}

TEST(DistributedMotions, have_the_consistent_masses_of_one_rank)
{
  const Settings consistent = {{"Methods/names", "Q1"}, {"Time/mass", "consistent"}};
  expect_same_on_all_ranks(with(consistent, {{"Time/initial velocity", "x*y + z^3"}}));
  // u_tt of the solution: rounding of values at 17 points in time, differentiated twice
  expect_same_on_all_ranks(with(consistent, {{"Problem/solution", moving}, {"Study/h", "1/4"}}),
                           1e-10);
}

TEST(DistributedMotions, are_of_solids_on_any_box)
{
  expect_same_on_all_ranks({{"Methods/names", "FA, Q1"},
                            {"Domain/boxes", "0,0,0 : 1,3/4,5/4"},
                            {"Study/h", "1/4"},
                            {"Kernel/type", "bond-tensor"},
                            {"Kernel/limit", "Navier"},
                            {"Problem/solution", "x^2 + y*z, z^2, x*y"},
                            {"Time/initial velocity", "x*z, y, x - z^2"},
                            {"Time/schemes", "symplectic Euler, Blanes-Moan, trapezoidal"},
                            {"Time/mass", "lumped"},
                            {"Time/final time", "0.1"},
                            {"Time/steps", "0.02"}});
}

TEST(DistributedMotions, begin_with_what_is_given_and_tell_the_error_in_time)
{
  // Runge-Kutta chooses its steps by estimates at 1e-12, which round
  expect_same_on_all_ranks({{"Methods/names", "FA, Q1"},
                            {"Problem/solution", "0*x"},
                            {"Time/initial displacement", "sin(pi*x)*sin(pi*y)*sin(pi*z)"},
                            {"Time/initial velocity", "x*(1 - x)*z*(1 - z)"},
                            {"Time/critical fractions", "0.5, 0.25"},
                            {"Study/h", "1/6"}},
                           1e-11);
}

TEST(DistributedMotions, are_beside_methods_whose_work_is_repeated)
{
  // an error is estimated of Q1 alone
  expect_same_on_all_ranks({{"Methods/names", "FA, Q1"},
                            {"Reference/estimate", "every"},
                            {"Time/final time", "0.02"},
                            {"Time/frames", "2"}},
                           1e-11);
}

TEST(DistributedMotions, are_of_a_single_row_of_nodes_across)
{
  expect_same_on_all_ranks({{"Methods/names", "FA, Q1"},
                            {"Domain/boxes", "0,0,0 : 1,1/2,5/4"}, // one row of vertices
                            {"Time/mass", "consistent"},
                            {"Time/initial velocity", "x*y + z^3"}});
}

TEST(DistributedMotions, are_repeated_on_unions_of_boxes)
{
  expect_same_on_all_ranks({{"Methods/names", "FA, Q1"},
                            {"Domain/boxes", "0,0,0 : 1,1,1/2; 0,0,0 : 1/2,1,1"},
                            {"Problem/solution", moving},
                            {"Time/mass", "lumped"},
                            {"Time/final time", "0.1"},
                            {"Time/frames", "2"}});
}

TEST(DistributedMotions, fail_on_all_ranks_where_a_field_is_not_finite_in_one_slab)
{
  const std::string singular = "0*sqrt(0.7 - z)";
  try
  {
    find({{"Problem/solution", "0*x"}, {"Time/initial velocity", singular}}, Communicator::all());
    ADD_FAILURE() << "it moves";
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("finite"), std::string::npos) << error.what();
  }
}

TEST(MassRoot, of_a_product_on_slabs_is_that_of_one_rank)
{
  for (const std::array<int, 3> &n : {std::array<int, 3>{3, 4, 2}, {2, 3, 61}, {4, 1, 7}})
    for (const double off : {.25, .49})
    {
      const base::Slabs slabs(Communicator::all(), n[2]);
      const method::ProductMass mass{n, 2, 1.7, off};
      const method::MassRoot whole(mass), shared(mass, slabs);
      const std::size_t of_plane = static_cast<std::size_t>(n[0]) * n[1];
      std::mt19937 random(5);
      std::uniform_real_distribution<double> uniform(-1, 1);
      std::vector<double> x(2 * of_plane * n[2]);
      for (double &value : x)
        value = uniform(random);
      const auto own = [&](const std::vector<double> &all)
      {
        std::vector<double> part;
        for (unsigned int c = 0; c < 2; ++c)
          for (std::size_t i = of_plane * slabs.owned().first; i < of_plane * slabs.owned().second;
               ++i)
            part.push_back(all[c * of_plane * n[2] + i]);
        return part;
      };
      const auto expect_same =
          [&](const std::vector<double> &found, const std::vector<double> &expected)
      {
        ASSERT_EQ(found.size(), own(expected).size());
        for (std::size_t i = 0; i < found.size(); ++i)
          EXPECT_NEAR(found[i], own(expected)[i], 1e-12 * 10);
      };
      expect_same(shared.to_state(own(x)), whole.to_state(x));
      expect_same(shared.to_unknowns(own(x)), whole.to_unknowns(x));
      expect_same(shared.of_force(own(x)), whole.of_force(x));
    }
}
