#include "study/local_waves.h"

#include "base/control_points.h"
#include "base/error.h"
#include "base/number_text.h"
#include "scene/models/model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::study
{
  namespace
  {
    /// The amplitudes of cos and sin of 2π (p i/n_x + q j/n_y) in a table of values.
    std::array<double, 2> amplitudes_of(const std::vector<double> &values, std::size_t n_x,
                                        std::size_t n_y, long p, long q)
    {
      double cosine = 0, sine = 0;
      for (std::size_t j = 0; j < n_y; ++j)
        for (std::size_t i = 0; i < n_x; ++i)
        {
          const double phase =
              2 * M_PI *
              (static_cast<double>(p) * static_cast<double>(i) / static_cast<double>(n_x) +
               static_cast<double>(q) * static_cast<double>(j) / static_cast<double>(n_y));
          cosine += values[j * n_x + i] * std::cos(phase);
          sine += values[j * n_x + i] * std::sin(phase);
        }
      const double scale = (p == 0 && q == 0 ? 1. : 2.) / static_cast<double>(n_x * n_y);
      return {scale * cosine, scale * sine};
    }
  } // namespace

  LocalWaves::LocalWaves(const scene::Scene &scene, const Field &displacement,
                         const Field &velocity)
      : n_components_(scene.domain.dimension)
  {
    // moduli do not depend on the horizon
    const auto speeds = make_double_well(scene, 1).wave_speeds(scene.time.density);
    longitudinal_ = speeds.longitudinal;
    transverse_ = speeds.transverse;
    const geometry::Box &box = scene.domain.boxes.include.front();
    lower_ = box.lower;
    const dealii::Tensor<1, 2> side = box.upper - box.lower;
    transform({&displacement, &velocity}, side);
    check({&displacement, &velocity}, side);
  }

  void LocalWaves::transform(const std::array<const Field *, 2> &fields,
                             const dealii::Tensor<1, 2> &side)
  {
    constexpr double rounding = 1e-12; // of the largest amplitude
    const long last = is_line() ? 0 : most();
    const std::size_t n_x = static_cast<std::size_t>(2 * most() + 8), n_y = is_line() ? 1 : n_x;
    for (long q = -last; q <= last; ++q)
      for (long p = 0; p <= most(); ++p)
        if (p > 0 || q >= 0) // one of each pair ±k
          modes_.push_back({{2 * M_PI * static_cast<double>(p) / side[0],
                             is_line() ? 0 : 2 * M_PI * static_cast<double>(q) / side[1]},
                            {},
                            {}});
    double largest = 0;
    const auto size = [](const Mode &mode)
    {
      double result = 0;
      for (const auto &amplitudes : {mode.u, mode.v})
        for (const auto &component : amplitudes)
          result = std::max({result, std::abs(component[0]), std::abs(component[1])});
      return result;
    };
    for (std::size_t f = 0; f < 2; ++f)
      for (unsigned int c = 0; c < n_components_ && *fields[f]; ++c)
      {
        std::vector<double> values(n_x * n_y);
        for (std::size_t j = 0; j < n_y; ++j)
          for (std::size_t i = 0; i < n_x; ++i)
          {
            dealii::Point<2> x = lower_;
            x[0] += side[0] * static_cast<double>(i) / static_cast<double>(n_x);
            x[1] += side[1] * static_cast<double>(j) / static_cast<double>(n_y);
            values[j * n_x + i] = (*fields[f])(x, c);
          }
        for (Mode &mode : modes_)
        {
          (f == 0 ? mode.u : mode.v)[c] =
              amplitudes_of(values, n_x, n_y, std::lround(mode.k[0] * side[0] / (2 * M_PI)),
                            std::lround(mode.k[1] * side[1] / (2 * M_PI)));
          largest = std::max(largest, size(mode));
        }
      }
    modes_.erase(std::remove_if(modes_.begin(), modes_.end(),
                                [&](const Mode &mode) { return size(mode) <= rounding * largest; }),
                 modes_.end());
  }

  void LocalWaves::check(const std::array<const Field *, 2> &fields,
                         const dealii::Tensor<1, 2> &side) const
  {
    constexpr double tolerance = 1e-9; // of the largest value
    constexpr std::size_t n_points = 37, stride = 14;
    const std::vector<double> places = base::control_points(n_points);
    for (std::size_t f = 0; f < 2; ++f)
    {
      double missed = 0, largest = 0;
      for (std::size_t i = 0; i < n_points && *fields[f]; ++i)
      {
        dealii::Point<2> x = lower_;
        x[0] += side[0] * places[i];
        x[1] += is_line() ? 0 : side[1] * places[i * stride % n_points];
        const State found = at(0, {x});
        for (unsigned int c = 0; c < n_components_; ++c)
        {
          const double value = (*fields[f])(x, c);
          missed = std::max(missed, std::abs(value - (f == 0 ? found.u : found.v)[c]));
          largest = std::max(largest, std::abs(value));
        }
      }
      if (missed > tolerance * largest)
        throw InputError(
            std::string("Time/initial ") + (f == 0 ? "displacement" : "velocity") +
            ": waves of up to " + std::to_string(most()) +
            " periods per side do not resolve it for the local limit (relative error " +
            base::to_text(missed / largest, 2) +
            "); give a smoother field, or Problem/local solution = none and another "
            "target");
    }
  }

  LocalWaves::Mode LocalWaves::moved(const Mode &mode, double t) const
  {
    const double length = std::hypot(mode.k[0], mode.k[1]);
    const std::array<double, 2> n = {length > 0 ? mode.k[0] / length : 1,
                                     length > 0 ? mode.k[1] / length : 0};
    Mode result = mode;
    for (unsigned int s = 0; s < 2; ++s)
      for (unsigned int c = 0; c < 2; ++c)
      {
        // the part along k has the components n (n·u), the rest moves across
        const auto move = [&](double omega, double u, double v)
        {
          const double slow = omega > 0 ? std::sin(omega * t) / omega : t;
          return std::pair(std::cos(omega * t) * u + slow * v,
                           -omega * std::sin(omega * t) * u + std::cos(omega * t) * v);
        };
        const double along_u = n[c] * (n[0] * mode.u[0][s] + n[1] * mode.u[1][s]),
                     along_v = n[c] * (n[0] * mode.v[0][s] + n[1] * mode.v[1][s]);
        const auto [u1, v1] = move(longitudinal_ * length, along_u, along_v);
        const auto [u2, v2] =
            move(transverse_ * length, mode.u[c][s] - along_u, mode.v[c][s] - along_v);
        result.u[c][s] = u1 + u2;
        result.v[c][s] = v1 + v2;
      }
    return result;
  }

  LocalWaves::State LocalWaves::at(double t, const std::vector<dealii::Point<2>> &nodes) const
  {
    State state{std::vector<double>(nodes.size() * n_components_),
                std::vector<double>(nodes.size() * n_components_)};
    for (const Mode &mode : modes_)
    {
      const Mode now = moved(mode, t);
      for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        const dealii::Tensor<1, 2> x = nodes[i] - lower_;
        const double phase = now.k[0] * x[0] + now.k[1] * x[1], cosine = std::cos(phase),
                     sine = std::sin(phase);
        for (unsigned int c = 0; c < n_components_; ++c)
        {
          state.u[n_components_ * i + c] += now.u[c][0] * cosine + now.u[c][1] * sine;
          state.v[n_components_ * i + c] += now.v[c][0] * cosine + now.v[c][1] * sine;
        }
      }
    }
    return state;
  }
} // namespace plumbline::study
