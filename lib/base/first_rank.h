#pragma once

#include "base/communicator.h"

#include <functional>

namespace plumbline::base
{
  /// Do something on the first of these ranks. If it fails, all of them stop. @note Collective.
  inline void on_first_rank(const Communicator &ranks, const std::function<void()> &action)
  {
    ranks.together(
        [&]
        {
          if (ranks.rank() == 0)
            action();
        });
  }
} // namespace plumbline::base
