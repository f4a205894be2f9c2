// A fault of one rank alone is one of all: they throw the same, and none waits for another.
#include "base/communicator.h"
#include "base/error.h"
#include "base/shared_flag.h"
#include "study/statics.h"

#include <deal.II/base/exceptions.h>

#include "tests/study/given_solutions.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <new>
#include <thread>

using namespace plumbline;
using base::Communicator;

namespace
{
  bool is_last()
  {
    return Communicator::all().rank() + 1 == Communicator::all().n_ranks();
  }

  /// What all ranks hear of what the last one throws.
  template <class Error, class Thrown>
  std::string heard(const Thrown &thrown)
  {
    try
    {
      Communicator::all().together(
          [&]
          {
            if (is_last())
              throw thrown;
          });
    }
    catch (const Error &error)
    {
      EXPECT_EQ(typeid(error), typeid(Error));
      return error.what();
    }
    ADD_FAILURE() << "nothing is thrown on rank " << Communicator::all().rank();
    return {};
  }

  /// Solves nothing, and fails as it is told on the last rank.
  class FaultyMethod : public study::GivenSolutions
  {
  public:
    explicit FaultyMethod(std::function<void()> fail)
        : GivenSolutions("FAULTY"), fail_(std::move(fail))
    {
    }

  private:
    method::Field field(const problem::Problem<2> &problem) const override
    {
      if (is_last())
        fail_();
      method::Field solution;
      const auto n_side = static_cast<std::size_t>(std::lround(1 / problem.h)), n = n_side * n_side;
      solution.averages.assign(n, 0);
      solution.nodal.assign(n, 0);
      for (std::size_t i = 0; i < n; ++i)
        solution.nodes.emplace_back(.5, .5);
      return solution;
    }

    std::function<void()> fail_;
  };

  study::StudyResults sweep(const std::function<void()> &fail)
  {
    const scene::Scene scene = scene::parse_scene(
        "fault.prm", "subsection Problem\n set solution = x^2\nend\n"
                     "subsection Methods\n set names = FAULTY\nend\n"
                     "subsection Study\n set h = 0.1, 0.05\n set norms = averages L2\n"
                     " set decisive error = averages L2 | exact\nend\n");
    const method::Methods methods = {std::make_shared<FaultyMethod>(fail)};
    return study::run_sweep(scene, methods, methods, {}, {});
  }
} // namespace

TEST(Together, every_kind_of_fault_reaches_all_ranks)
{
  EXPECT_EQ(heard<InputError>(InputError("bad key")), "bad key");
  EXPECT_EQ(heard<NumericalError>(NumericalError("no solution")), "no solution");
  EXPECT_EQ(heard<MemoryError>(MemoryError("no memory")), "no memory");
  EXPECT_EQ(heard<MemoryError>(std::bad_alloc()).find("memory ran out: this process holds "), 0u);
  // ranks share words; what is alone keeps the kind
  const bool is_alone = Communicator::all().n_ranks() == 1;
  const std::out_of_range range("a library's");
  EXPECT_EQ(is_alone ? heard<std::out_of_range>(range) : heard<std::runtime_error>(range),
            "a library's");
  const dealii::ExcMessage message("deal's own");
  EXPECT_NE((is_alone ? heard<dealii::ExcMessage>(message) : heard<std::runtime_error>(message))
                .find("deal's own"),
            std::string::npos);
  EXPECT_EQ(heard<std::runtime_error>(-3), "a library fails without saying why");
  EXPECT_EQ(heard<NumericalError>(NumericalError("")), ""); // nothing is said, and still it ends
}

TEST(Together, good_ranks_go_on)
{
  int n = 0;
  Communicator::all().together([&] { ++n; });
  EXPECT_EQ(n, 1);
}

TEST(SeparateCommunicator, has_the_same_ranks_and_its_own_messages)
{
  const base::SeparateCommunicator ranks(Communicator::all());
  EXPECT_EQ(ranks.communicator().n_ranks(), Communicator::all().n_ranks());
  EXPECT_EQ(ranks.communicator().rank(), Communicator::all().rank());
  EXPECT_THROW(ranks.communicator().together(
                   []
                   {
                     if (is_last())
                       throw NumericalError("alone");
                   },
                   20),
               NumericalError);
}

TEST(SharedFlag, is_found_set_by_ranks_that_do_not_wait)
{
  const auto is_never = [] { return false; };
  for (int time = 0; time < 2; ++time) // no message of the first is left for the second
  {
    base::SharedFlag unset(Communicator::all());
    EXPECT_FALSE(unset.is_set(false));
    unset.finish(is_never);

    base::SharedFlag set(Communicator::all());
    for (int i = 0; i < 5000 && !set.is_set(is_last()); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_TRUE(set.is_set(false));
    set.finish(is_never);
  }
}

TEST(SharedFlag, is_set_by_a_rank_that_has_finished)
{
  base::SharedFlag flag(Communicator::all());
  if (is_last() && Communicator::all().n_ranks() > 1)
    flag.finish([] { return true; });
  else
  {
    const bool is_alone = Communicator::all().n_ranks() == 1;
    for (int i = 0; i < 5000 && !flag.is_set(is_alone); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_TRUE(flag.is_set(false));
    flag.finish([] { return false; });
  }
}

TEST(Sweep, what_fails_on_one_rank_has_failed_on_all)
{
  const auto results = sweep([] { throw NumericalError("rank loss"); });
  ASSERT_EQ(results.records.size(), 2u);
  for (const study::Record &run : results.records)
    EXPECT_EQ(run.failure, "rank loss");
  EXPECT_EQ(sweep([] { throw std::bad_alloc(); }).records[1].failure.find("memory ran out"), 0u);
  EXPECT_THROW(sweep([] { throw InputError("bad data"); }), InputError);
  const auto fail = [] { sweep([] { throw std::logic_error("a library's"); }); };
  if (Communicator::all().n_ranks() == 1)
    EXPECT_THROW(fail(), std::logic_error);
  else
    EXPECT_THROW(fail(), std::runtime_error);
}
