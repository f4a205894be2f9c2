#pragma once

#include "base/slabs.h"
#include "base/traffic.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace plumbline::base
{
  /// Planes of a field that are on their way from the ranks that own them, so that a rank can work
  /// on its own planes in the meantime. The constructor copies this rank's own planes, sets planes
  /// outside 0 ... n - 1 to 0 and posts all messages; finish() waits for the planes of other ranks.
  class PlaneExchange
  {
  public:
    /// See Slabs::fetch(), which is this and finish(). Both arrays must stay until the end, and
    /// `own` must not change.
    /// @note Collective. Of several exchanges at once, all ranks post them in the same order.
    PlaneExchange(const Slabs &slabs, const double *own, std::size_t plane_size,
                  const std::function<Slabs::Range(unsigned int rank)> &wanted, double *result);
    PlaneExchange(PlaneExchange &&) noexcept = default;
    PlaneExchange(const PlaneExchange &) = delete;
    PlaneExchange &operator=(const PlaneExchange &) = delete;
    ~PlaneExchange() { finish(); }

    /// Let MPI progress the messages: without occasional calls most implementations send
    /// nothing large.
    void advance();

    /// Wait for the planes of other ranks.
    void finish();

    /// What this rank sends, counted as it is posted.
    const Traffic &sent() const { return sent_; }

  private:
    std::vector<MPI_Request> requests_;
    Traffic sent_;
  };
} // namespace plumbline::base
