// What an operator, its preconditioner and an iteration of conjugate gradients on slabs take beside
// the model of algebra/slab_model.h, whose constants are measured in the same run: rates of work by
// all ranks at once (where ranks share cores they are slower for it), latency and bandwidth by
// ping-pong. And what it gains that messages are on
// their way while interior planes are computed.
// Run: mpirun -np P build/release/benchmarks/ranks [--csv | --small]
//   --csv    rows of benchmarks/ranks.csv, after their head where P = 1, which
//   docs/_ext/plumbline_scaling.py draws
//   --small  to see that it runs

#include "algebra/direct.h"
#include "algebra/slab_model.h"
#include "algebra/slab_operator.h"
#include "algebra/slab_sine.h"
#include "algebra/slab_system.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace plumbline;
using namespace plumbline::algebra;

namespace
{
  using Extents = std::array<int, 3>;
  const base::Communicator all = base::Communicator::all();

  /// Seconds of an action that all ranks do at once, until the last one is done.
  template <class Action>
  double seconds_of_one(const Action &action)
  {
    all.wait();
    const auto begin = std::chrono::steady_clock::now();
    action();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    return all.largest(time.count());
  }

  double median(std::vector<double> values)
  {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  /// Seconds of actions: medians over rounds, each action once in a round, so that all of them meet
  /// the same machine, which others may use as well.
  std::map<std::string, double>
  seconds_of(const std::map<std::string, std::function<void()>> &actions, int n_rounds)
  {
    std::map<std::string, std::vector<double>> tries;
    for (const auto &[name, action] : actions)
      action();
    for (int i = 0; i < n_rounds; ++i)
      for (const auto &[name, action] : actions)
        tries[name].push_back(seconds_of_one(action));
    std::map<std::string, double> found;
    for (const auto &[name, values] : tries)
      found[name] = median(values);
    return found;
  }

  /// A ball of radius 3, as of rules on nodes at m = 3.
  Stencil ball()
  {
    Stencil stencil(1, Extents{3, 3, 3});
    double total = 0;
    stencil.for_each_offset(
        [&](int k1, int k2, int k3)
        {
          const int squared = k1 * k1 + k2 * k2 + k3 * k3;
          if (squared > 0 && squared <= 9)
            total += (stencil(0, 0, k1, k2, k3) = -1. / squared);
        });
    stencil(0, 0, 0, 0, 0) = -total;
    return stencil;
  }

  constexpr int n_turns = 20;

  /// A message of so many bytes from the first rank to the second and back, so many times.
  void ping_pong(std::vector<char> &data)
  {
    const int rank = static_cast<int>(all.rank()), n_bytes = static_cast<int>(data.size());
    for (int i = 0; i < 2 * n_turns; ++i)
    {
      const int from = i % 2, to = 1 - from;
      if (rank == from)
        MPI_Send(data.data(), n_bytes, MPI_CHAR, to, 0, all.mpi);
      if (rank == to)
        MPI_Recv(data.data(), n_bytes, MPI_CHAR, from, 0, all.mpi, MPI_STATUS_IGNORE);
    }
  }

  struct Measured
  {
    std::string operation;
    double seconds;
    ModelTime model;
  };

  /// Operations on all ranks, and the rates of the model: work on a slab by each rank alone, all at
  /// once.
  std::pair<Rates, std::vector<Measured>> compare(const Stencil &stencil, const Extents &n,
                                                  int n_rounds)
  {
    const int n_ranks = static_cast<int>(all.n_ranks());
    const Extents slab = {n[0], n[1], std::max(1, (n[2] + 1) / n_ranks - 1)};
    const double n_alone = static_cast<double>(slab[0]) * slab[1] * slab[2];
    const base::Slabs alone(base::Communicator::alone(), slab[2]), slabs(all, n[2]);
    const std::size_t n_own = static_cast<std::size_t>(n[0]) * n[1] * slabs.n_owned();
    Vector x(std::max(n_own, static_cast<std::size_t>(n_alone))), y(x.size()), u(n_own), v(n_own);
    for (std::size_t i = 0; i < n_own; ++i)
      u[i] = x[i] = std::sin(static_cast<double>(i));
    const SlabOperator matrix(stencil, n, slabs, OperatorBackend::direct),
        matrix_alone(stencil, slab, alone, OperatorBackend::direct);
    const SlabSine sine_alone(stencil, slab, alone);
    const SlabSystem system(stencil, geometry::BoxNodes{n}, slabs, OperatorBackend::direct);
    unsigned int n_iterations = 1;
    constexpr int much = 1 << 20;
    std::vector<char> number(sizeof(double)), megabyte(much);
    std::map<std::string, std::function<void()>> actions = {
        {"bond", [&] { matrix_alone.apply(x.begin(), y.begin()); }},
        {"level", [&] { sine_alone.apply(x.begin(), y.begin()); }},
        {"value",
         [&]
         {
           for (std::size_t i = 0; i < static_cast<std::size_t>(n_alone); ++i)
             y[i] += .5 * x[i];
         }},
        {"operator", [&] { matrix.apply(u.begin(), v.begin()); }},
        {"preconditioner", [&] { system.precondition(v, u); }},
        {"solve", [&]
         {
           v = 0.;
           n_iterations = system.solve(v, u, {1e-10, 100}).n_iterations;
         }}};
    if (n_ranks > 1)
    {
      actions["latency"] = [&] { ping_pong(number); };
      actions["byte"] = [&] { ping_pong(megabyte); };
    }
    std::map<std::string, double> found = seconds_of(actions, n_rounds);
    Rates rates;
    rates.latency = found["latency"] / (2 * n_turns);
    rates.byte = (found["byte"] / (2 * n_turns) - rates.latency) / much;
    rates.bond = found["bond"] / (n_alone * static_cast<double>(stencil.n_entries()));
    rates.level = found["level"] / (2 * n_alone * std::log2(n_alone));
    rates.value = found["value"] / (3 * n_alone);
    auto layout = SlabLayout::of(stencil, n, all.n_ranks(), n[2]);
    layout.backend = OperatorBackend::direct;
    return {
        rates,
        {{"operator", found["operator"], operator_time(layout, stencil, rates)},
         {"preconditioner", found["preconditioner"], preconditioner_time(layout, rates)},
         {"CG iteration", found["solve"] / n_iterations, iteration_time(layout, stencil, rates)}}};
  }

  void print(const std::string &study, const Extents &n, const Rates &rates, const Measured &one,
             bool is_csv)
  {
    if (all.rank() != 0)
      return;
    const base::Traffic &sent = one.model.sent;
    if (is_csv)
      std::printf("%s,%u,%d,%d,%d,%s,%.4g,%.4g,%llu,%llu,%.3g,%.3g,%.3g,%.3g,%.3g\n", study.c_str(),
                  all.n_ranks(), n[0], n[1], n[2], one.operation.c_str(), one.seconds,
                  one.model.seconds(), static_cast<unsigned long long>(sent.n_messages),
                  static_cast<unsigned long long>(sent.n_bytes), rates.latency, rates.byte,
                  rates.bond, rates.level, rates.value);
    else
      std::printf("%s, %u ranks, %d x %d x %d nodes, %s: %.3g ms, model %.3g ms, ratio %.2f; %llu "
                  "messages, %.3g MB\n",
                  study.c_str(), all.n_ranks(), n[0], n[1], n[2], one.operation.c_str(),
                  1e3 * one.seconds, 1e3 * one.model.seconds(), one.seconds / one.model.seconds(),
                  static_cast<unsigned long long>(sent.n_messages),
                  1e-6 * static_cast<double>(sent.n_bytes));
  }

  /// Ranks that come late in turn, by a part of the time of an operator: what the overlap gains, as
  /// the median ratio of pairs of tries.
  void print_overlap(const Stencil &stencil, const Extents &n)
  {
    const base::Slabs slabs(all, n[2]);
    const int reach = stencil.reaches()[2];
    const std::size_t plane = static_cast<std::size_t>(n[0]) * n[1];
    std::vector<double> x(plane * slabs.n_owned(), 1.), y(x),
        with_halo(plane * (slabs.n_owned() + 2 * reach));
    const SlabOperator overlapped(stencil, n, slabs, OperatorBackend::direct);
    const DirectStencil direct(stencil, {n[0], n[1], slabs.n_owned()}, true);
    const auto wanted = [&](unsigned int rank) -> base::Slabs::Range {
      return {slabs.owned(rank).first - reach, slabs.owned(rank).second + reach};
    };
    const auto in_sequence = [&]
    {
      slabs.fetch(x.data(), plane, wanted, with_halo.data());
      direct.apply(with_halo.data(), y.data());
    };
    const auto at_once = [&] { overlapped.apply(x.data(), y.data()); };
    const double usual = seconds_of({{"usual", in_sequence}}, 9)["usual"];
    for (const double part : {0., .5, 1.})
    {
      constexpr unsigned int n_turns = 6, n_pairs = 15;
      const auto seconds = [&](const auto &apply)
      {
        return seconds_of_one(
                   [&]
                   {
                     for (unsigned int turn = 0; turn < n_turns; ++turn)
                     {
                       if (part > 0 && (turn + all.rank()) % 2 == 0)
                         std::this_thread::sleep_for(std::chrono::duration<double>(part * usual));
                       apply();
                     }
                   }) /
               n_turns;
      };
      std::vector<double> before, now, ratios;
      for (unsigned int i = 0; i < n_pairs; ++i)
      {
        before.push_back(seconds(in_sequence));
        now.push_back(seconds(at_once));
        ratios.push_back(now.back() / before.back());
      }
      if (all.rank() == 0)
        std::printf("ranks late in turn by %.1f of an operator: %.3g ms in sequence, %.3g ms "
                    "overlapped, median ratio %.2f\n",
                    part, 1e3 * median(before), 1e3 * median(now), median(ratios));
    }
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string option = argc > 1 ? argv[1] : "";
  const bool is_csv = option == "--csv";
  const int side = option == "--small" ? 15 : 47, n_ranks = static_cast<int>(all.n_ranks());
  const Stencil stencil = ball();
  if (is_csv && n_ranks == 1)
    std::printf("study,ranks,nx,ny,nz,operation,seconds,model,messages,bytes,alpha,beta,bond,level,"
                "value\n");
  // 2 (n + 1), the length that FFTW transforms, is a product of small primes, also of the slabs
  // that rates are measured with
  for (const auto &[study, n] :
       {std::pair<std::string, Extents>{"strong", {side, side, 2 * side + 1}},
        {"weak", {side, side, (side + 1) / 2 * n_ranks - 1}}})
  {
    const auto [rates, found] = compare(stencil, n, side > 20 ? 31 : 3);
    if (all.rank() == 0 && !is_csv)
      std::printf("alpha %.3g us, beta 1/(%.3g GB/s), %.3g ns a bond, %.3g ns a level, %.3g ns a "
                  "value\n",
                  1e6 * rates.latency, rates.byte > 0 ? 1e-9 / rates.byte : 0., 1e9 * rates.bond,
                  1e9 * rates.level, 1e9 * rates.value);
    for (const Measured &one : found)
      print(study, n, rates, one, is_csv);
  }
  if (!is_csv && n_ranks > 1)
    print_overlap(stencil, {side, side, 2 * side + 1});
  return 0;
}
