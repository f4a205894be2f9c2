#include "base/fftw.h"

#include <deal.II/base/multithread_info.h>

namespace plumbline::base
{
  int fast_length(int n)
  {
    for (;; ++n)
    {
      int rest = n;
      if (rest % 7 == 0)
        rest /= 7;
      for (const int factor : {2, 3, 5})
        while (rest % factor == 0)
          rest /= factor;
      if (rest == 1)
        return n;
    }
  }

  void set_plan_threads(std::size_t n_points)
  {
    constexpr std::size_t worth_threads = 1u << 17;
    static const bool ready = fftw_init_threads() != 0;
    if (ready)
      fftw_plan_with_nthreads(
          n_points >= worth_threads ? static_cast<int>(dealii::MultithreadInfo::n_threads()) : 1);
  }
} // namespace plumbline::base
