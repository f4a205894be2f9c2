#include "machine.h"

#include "algebra/simd.h"
#include "base/cost.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>

namespace plumbline::benchmarks
{
  namespace
  {
    using algebra::Simd, algebra::simd_width, algebra::load;
    /// Numbers a step of the loops below; arrays are multiples of it.
    constexpr std::size_t step = 8 * simd_width;

    PLUMBLINE_VECTOR_CLONES void triad(double *a, const double *b, const double *c, double s,
                                       std::size_t n)
    {
      for (std::size_t i = 0; i < n; i += step)
        for (std::size_t l = 0; l < step; l += simd_width)
        {
          const Simd sum = load(b + i + l) + s * load(c + i + l);
          std::memcpy(a + i + l, &sum, sizeof(sum));
        }
    }

    PLUMBLINE_VECTOR_CLONES double sum(const double *a, std::size_t n)
    {
      Simd part[8] = {};
      for (std::size_t i = 0; i < n; i += step)
        for (std::size_t l = 0; l < 8; ++l)
          part[l] += load(a + i + l * simd_width);
      Simd all = part[0];
      for (std::size_t l = 1; l < 8; ++l)
        all += part[l];
      return all[0] + all[1] + all[2] + all[3];
    }

    /// n_chains independent chains of x = a x + b, as many as hide the latency and fit in
    /// registers.
    template <int n_chains>
    PLUMBLINE_VECTOR_CLONES double multiply_add(std::size_t n, double a, double b)
    {
      Simd x[n_chains];
      for (int k = 0; k < n_chains; ++k)
        x[k] = Simd{1., 2., 3., 4.} * static_cast<double>(k);
      for (std::size_t i = 0; i < n; ++i)
#pragma GCC unroll 16
        for (int k = 0; k < n_chains; ++k)
          x[k] = a * x[k] + b;
      double result = 0;
      for (const Simd &lane : x)
        result += lane[0] + lane[1] + lane[2] + lane[3];
      return result;
    }

    /// How often a second the best of several tries does something.
    template <class Action>
    double rate(const Action &action)
    {
      constexpr double try_seconds = .02;
      constexpr int n_tries = 5;
      action(); // touches memory for the first time
      double best = 0;
      for (int i = 0; i < n_tries; ++i)
      {
        const base::CpuTimer timer;
        double n = 0, seconds = 0;
        for (; seconds < try_seconds; seconds = timer.seconds(), ++n)
          action();
        best = std::max(best, n / seconds);
      }
      return best;
    }

    /// Of numbers that stand anywhere, as neighbours of a node do.
    double measure_loads()
    {
      constexpr std::size_t n = 1024, n_passes = 1000;
      std::vector<double> a(n + 1);
      double total = 0;
      return n * n_passes * sizeof(double) *
             rate(
                 [&]
                 {
                   for (std::size_t i = 0; i < n_passes; ++i)
                     benchmark::DoNotOptimize(total += sum(a.data() + i % 2, n));
                 });
    }

    Machine::Level measure(const std::string &name, double capacity, double working_set)
    {
      const auto steps = static_cast<std::size_t>(working_set / (3 * sizeof(double) * step));
      const std::size_t n = steps * step;
      std::vector<double> a(n), b(n, 1.), c(n, 2.);
      const auto bytes = static_cast<double>(n * sizeof(double));
      // a try is many passes where arrays are small: the clock does not count
      const int n_passes = static_cast<int>(std::max(1., 1e7 / bytes));
      const double triads = rate(
          [&]
          {
            for (int i = 0; i < n_passes; ++i)
            {
              triad(a.data(), b.data(), c.data(), 3, n);
              benchmark::ClobberMemory();
            }
          });
      double total = 0;
      const double sums = rate(
          [&]
          {
            for (int i = 0; i < n_passes; ++i)
              for (const auto *array : {&a, &b, &c})
                benchmark::DoNotOptimize(total += sum(array->data(), n));
          });
      return {name, capacity, 3 * bytes * n_passes * triads, 3 * bytes * n_passes * sums};
    }
  } // namespace

  const Machine::Level &Machine::serving(double working_set) const
  {
    const auto level = std::find_if(levels.begin(), levels.end(),
                                    [&](const Level &one) { return working_set <= one.capacity; });
    return level == levels.end() ? levels.back() : *level;
  }

  Machine measure_machine()
  {
    Machine machine;
    double largest_cache = 8e6; // where the system does not tell
    for (const auto &cache : benchmark::CPUInfo::Get().caches)
      if (cache.type == "Unified" || cache.type == "Data")
      {
        largest_cache = std::max(largest_cache, static_cast<double>(cache.size));
        if (cache.level >= 2)
          machine.levels.push_back(measure("L" + std::to_string(cache.level) + " cache", cache.size,
                                           .6 * static_cast<double>(cache.size)));
      }
    machine.levels.push_back(measure("memory", 1e300, std::min(12 * largest_cache, 1.5e9)));

    machine.loads = measure_loads();
    constexpr std::size_t n = 100000;
    const auto flops = [](int n_chains) { return 2. * simd_width * n_chains * n; };
    double value = 0;
    machine.flop = std::max(
        flops(5) * rate([&] { benchmark::DoNotOptimize(value += multiply_add<5>(n, .999, .001)); }),
        flops(10) *
            rate([&] { benchmark::DoNotOptimize(value += multiply_add<10>(n, .999, .001)); }));
    return machine;
  }

  Machine best_of(const Machine &a, const Machine &b)
  {
    Machine best = a;
    for (std::size_t i = 0; i < best.levels.size(); ++i)
    {
      best.levels[i].triad = std::max(a.levels[i].triad, b.levels[i].triad);
      best.levels[i].sum = std::max(a.levels[i].sum, b.levels[i].sum);
    }
    best.loads = std::max(a.loads, b.loads);
    best.flop = std::max(a.flop, b.flop);
    return best;
  }
} // namespace plumbline::benchmarks
