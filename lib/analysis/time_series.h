#pragma once

#include "base/communicator.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plumbline::analysis
{
  using Vector = std::vector<double>;

  /// A vector that is smooth in time, on [0, T]: a polynomial through its values at Chebyshev's
  /// points t_k = T/2 (1 - cos kπ/N), k = 0 ... N.
  class TimeSeries
  {
  public:
    /// One that does not change.
    explicit TimeSeries(Vector value);

    /// Interpolate at 9, 17, 33 and 65 points, each holding those before, until the new values, and
    /// those at three more times between, differ from the polynomial before by no more than the
    /// tolerance, relative to the largest norm of all; noise of the values beyond that never
    /// settles.
    /// @param what   for the message
    /// @param least  points at least, see `points`
    /// @param ranks  that have a part of the vector each; collective over them
    /// @throws InputError  not at 65 points
    static TimeSeries resolve(const std::function<Vector(double t)> &at, double end,
                              double tolerance, const std::string &what, std::size_t least = 0,
                              const base::Communicator &ranks = base::Communicator::alone());

    /// How many points, 17, 33 or 65, a vector takes that costs so little that it can be looked at
    /// many times: at 300 base::control_points in time, so that what lasts longer than .6 % of the
    /// time is seen. To 1e-9 of its largest norm; nothing: more than 65.
    static std::optional<std::size_t> points(const std::function<Vector(double t)> &at, double end);

    std::size_t n_points() const { return values_.size(); }
    double error() const { return error_; } ///< the difference at the last new points, relative

    /// Overwrites `value`, of any size.
    void at(double t, Vector &value) const;
    Vector at(double t) const;

    TimeSeries derivative() const;

    /// this += factor other, of the same times; one that does not change fits any.
    void add(double factor, const TimeSeries &other);

  private:
    /// The largest difference to values at times.
    double difference(const std::vector<std::pair<double, Vector>> &values,
                      const base::Communicator &ranks) const;

    TimeSeries(double end, std::vector<Vector> values) : end_(end), values_(std::move(values)) {}

    double end_ = 0, error_ = 0;
    std::vector<Vector> values_; ///< at t_0 ... t_N
  };
} // namespace plumbline::analysis
