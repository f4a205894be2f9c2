#pragma once

#include "base/communicator.h"

#include <functional>
#include <vector>

namespace plumbline::base
{
  /// A flag that any rank can set at any time, e.g. when it is interrupted, and that the others can
  /// test without waiting: for ranks that work on tasks of their own, without collective calls
  /// between these.
  class SharedFlag
  {
  public:
    explicit SharedFlag(const Communicator &ranks) : ranks_(ranks) {}

    /// Whether this rank sets the flag now or has set it, or the message of another rank that set
    /// it has arrived. Does not wait.
    bool is_set(bool is_set_here);

    /// Wait until all ranks have called this, and receive the remaining messages. This rank may set
    /// the flag in the meantime.
    /// @note Collective, the last call.
    void finish(const std::function<bool()> &is_set_here);

  private:
    Communicator ranks_;
    bool is_set_ = false, has_told_ = false;
    std::vector<MPI_Request> sent_;
  };
} // namespace plumbline::base
