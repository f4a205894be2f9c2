#pragma once

#include "base/communicator.h"

#include <functional>
#include <vector>

namespace plumbline::base
{
  /// A flag that any rank sets when it likes, e.g. because it is interrupted, and that the others
  /// find set without waiting for it: while ranks work on tasks of their own, there is nothing
  /// collective that they could agree by.
  class SharedFlag
  {
  public:
    explicit SharedFlag(const Communicator &ranks) : ranks_(ranks) {}

    /// Whether it is set by this rank, now or before, or has been set by another one: a message to
    /// each rank that MPI delivers as soon as it can.
    bool is_set(bool is_set_here);

    /// Wait until all ranks have come here, and read what is left of messages. This rank may set
    /// the flag in the meantime.
    /// @note Collective, the last call.
    void finish(const std::function<bool()> &is_set_here);

  private:
    Communicator ranks_;
    bool is_set_ = false, has_told_ = false;
    std::vector<MPI_Request> sent_;
  };
} // namespace plumbline::base
