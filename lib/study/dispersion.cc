#include "study/dispersion.h"

#include "base/error.h"
#include "base/number_text.h"
#include "method/discretisation.h"
#include "study/trend.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::study
{
  namespace
  {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();

    double radians(double degrees)
    {
      return degrees * M_PI / 180;
    }

    /// NaN for a wave that grows.
    double root(double squared)
    {
      return squared > 0 ? std::sqrt(squared) : nan;
    }

    double largest_size(const std::vector<WaveCurve> &curves, double (WaveCurve::*error)() const)
    {
      double worst = 0;
      for (const WaveCurve &curve : curves)
      {
        const double size = std::abs((curve.*error)());
        worst = std::isnan(size) ? size : std::max(worst, size); // NaN stays: max(NaN, x) is NaN
      }
      return worst;
    }

    /// The waves of one symbol at one level.
    class Measurement
    {
    public:
      Measurement(const scene::Problem &problem, const WaveStudy &study)
          : problem_(problem), study_(study),
            polarisations_(physics::polarisations(problem.n_components == 1
                                                      ? physics::Structure::scalar
                                                      : physics::Structure::tensor))
      {
      }

      /// Fill in curves, anisotropy, range and round-off.
      void measure(const algebra::Symbol &symbol, bool is_finest, DispersionRow &row) const
      {
        for (const double angle : study_.angles)
          for (std::size_t i = 0; i < polarisations_.size(); ++i)
            row.curves.push_back(curve(symbol, i, angle));
        const double k = 2 * M_PI / study_.wavelength;
        sample(symbol, k, row,
               [](WaveCurve &curve, const WaveSample &one) { curve.longest = one; });
        if (is_finest)
          for (const double cells : lengths())
            sample(symbol, 2 * M_PI / (cells * row.h), row,
                   [](WaveCurve &curve, const WaveSample &one) { curve.samples.push_back(one); });
        const auto axis = symbol.long_waves(0), diagonal = symbol.long_waves(radians(45));
        for (std::size_t i = 0; i < polarisations_.size(); ++i)
          row.anisotropy.push_back((speed(axis[i]) - speed(diagonal[i])) / local_speed(i));
        row.range = symbol.range();
        for (double *const squared : {&row.range.least, &row.range.largest})
          *squared /= study_.density;
        // sums of entries of the size of the largest ω² cancel down to that of the longest wave
        for (std::size_t i = 0; i < polarisations_.size(); ++i)
          row.round_off =
              std::max(row.round_off, 8 * std::numeric_limits<double>::epsilon() *
                                          row.range.largest / std::pow(k * local_speed(i), 2));
      }

    private:
      /// Wavelengths [h], with equal ratios.
      static std::vector<double> lengths()
      {
        constexpr int n = 60;
        constexpr double shortest = 2, longest = 200;
        std::vector<double> lengths;
        for (int i = 0; i < n; ++i)
          lengths.push_back(shortest * std::pow(longest / shortest, i / (n - 1.)));
        return lengths;
      }

      /// @param squared  of unit density, as symbols and kernels have it
      double speed(double squared) const { return root(squared / study_.density); }

      double local_speed(std::size_t i) const
      {
        return speed(
            physics::squared_local_speed(problem_.kernel, problem_.dilatation, polarisations_[i]));
      }

      WaveCurve curve(const algebra::Symbol &symbol, std::size_t i, double angle) const
      {
        WaveCurve result;
        result.polarisation = polarisations_[i];
        result.angle = angle;
        result.local_speed = local_speed(i);
        result.long_wave_error =
            speed(symbol.long_waves(radians(angle))[i]) / result.local_speed - 1;
        return result;
      }

      /// One wave number in all directions, given to each curve of the row.
      template <typename Take>
      void sample(const algebra::Symbol &symbol, double k, DispersionRow &row,
                  const Take &take) const
      {
        std::vector<physics::Frequency> exact; // the same in all directions
        for (const auto polarisation : polarisations_)
          exact.push_back(
              physics::exact_wave(problem_.kernel, problem_.dilatation, polarisation, k));
        auto curve = row.curves.begin();
        for (const double angle : study_.angles)
        {
          const auto waves = symbol.waves(k, radians(angle));
          for (std::size_t i = 0; i < waves.size(); ++i, ++curve)
          {
            const double omega = speed(waves[i].squared), exact_omega = speed(exact[i].squared),
                         per_omega = 1 / (2 * study_.density);
            take(*curve, {k, omega / k, per_omega * waves[i].slope / omega, exact_omega / k,
                          per_omega * exact[i].slope / exact_omega});
          }
        }
      }

      const scene::Problem &problem_;
      const WaveStudy &study_;
      std::vector<physics::Polarisation> polarisations_;
    };

    double longer_side(const geometry::Domain &domain)
    {
      double side = 0;
      for (unsigned int d = 0; d < 2; ++d)
      {
        double lower = std::numeric_limits<double>::infinity(), upper = -lower;
        for (const geometry::Box &box : domain.include)
        {
          lower = std::min(lower, box.lower[d]);
          upper = std::max(upper, box.upper[d]);
        }
        side = std::max(side, upper - lower);
      }
      return side;
    }

    /// @param row  with method, family, series and level
    DispersionRow measured(DispersionRow row, const Measurement &measurement,
                           const algebra::WaveOperator &waves, bool is_finest)
    {
      const DispersionRow empty = row;
      try
      {
        measurement.measure(algebra::Symbol(waves), is_finest, row);
      }
      catch (const NumericalError &error)
      {
        row = empty;
        row.failure = error.what();
      }
      return row;
    }
  } // namespace

  bool DispersionRow::grows() const
  {
    constexpr double rounding = 1e-12; // of sums that are 0 for k = 0
    return range.least < -rounding * range.largest;
  }

  double DispersionRow::critical_step() const
  {
    return 2 / root(range.largest);
  }

  double DispersionRow::worst_local_error() const
  {
    return largest_size(curves, &WaveCurve::local_error);
  }

  double DispersionRow::worst_nonlocal_error() const
  {
    return largest_size(curves, &WaveCurve::nonlocal_error);
  }

  WaveStudy plan_waves(const scene::Scene &scene, const std::vector<double> &angles)
  {
    const auto needs = [&](bool is_good, const std::string &what)
    {
      if (!is_good)
        throw InputError("scene '" + scene.name + "': " + what);
    };
    needs(!scene.solver.is_full_model,
          "Solver/model = full puts the nodes on a mesh, but waves are those of nodes that are all "
          "alike; write smallest");
    check_analysis(scene, scene::Analysis::dispersion);
    const physics::LocalLimit limit = make_kernel(scene, 1).limit();
    needs(limit.diffusion > 0 || limit.mu > 0,
          "Kernel/coefficients and Kernel/constant make a local limit of " +
              base::to_text(scene.is_vector() ? limit.mu : limit.diffusion, 4) +
              " (diffusion, or mu), which has no waves; it must be positive: change their signs");
    WaveStudy study{angles, longer_side(scene.domain.boxes), scene.time.density};
    for (const scene::Series &series : scene.study.series)
      for (const scene::Level &level : series.levels)
        needs(2 * level.h <= study.wavelength,
              "Study/h = " + base::to_text(level.h, 4) +
                  " carries no wave as long as the domain, " + base::to_text(study.wavelength, 4) +
                  "; give h <= " + base::to_text(study.wavelength / 2, 4));
    return study;
  }

  std::vector<DispersionRow> measure_waves(const Method &method, const scene::Problem &problem,
                                           const WaveStudy &study, const std::string &series,
                                           bool is_finest)
  {
    const Measurement measurement(problem, study);
    DispersionRow row;
    row.method = method.name();
    row.side = method.side();
    row.series = series;
    row.h = problem.h;
    row.horizon = problem.horizon();
    std::optional<algebra::WaveOperator> waves;
    try
    {
      const auto discretisation = method.discretise(problem, base::Communicator::alone());
      waves = discretisation->waves();
      row.limit = discretisation->diagnostics().limit;
    }
    catch (const NumericalError &error)
    {
      row.failure = error.what();
      return {row};
    }
    if (!waves)
      throw InputError("Methods/names: '" + method.name() +
                       "' shows no stencil, so it has no waves; leave it out (--methods)");
    std::vector<DispersionRow> rows{measured(row, measurement, *waves, is_finest)};
    if (algebra::couples_cells(waves->mass))
    {
      row.method = lumped(row.method);
      waves->mass = algebra::lump(waves->mass, waves->n_families());
      rows.push_back(measured(row, measurement, *waves, is_finest));
    }
    return rows;
  }

  std::vector<Trend> wave_trends(const scene::Scene &scene, const std::vector<DispersionRow> &rows)
  {
    std::vector<Trend> trends;
    for (const DispersionRow &row : rows)
    {
      auto trend = std::find_if(trends.begin(), trends.end(),
                                [&](const Trend &t)
                                { return t.method == row.method && t.series == row.series; });
      if (trend == trends.end())
      {
        Trend first;
        first.method = row.method;
        first.side = row.side;
        first.series = row.series;
        first.error = "phase speed | nonlocal";
        first.axis = level_axis(scene.study.regime);
        first.size = 1; // errors are relative
        trend = trends.insert(trends.end(), first);
      }
      const double error = row.worst_nonlocal_error();
      if (!row.failure.empty() || !std::isfinite(error) || row.grows())
      {
        trend->outcome = Outcome::failed;
        trend->reason =
            !row.failure.empty()
                ? row.failure
                : "waves grow at h = " + base::to_text(row.h, 4) +
                      (row.grows() ? ", the least ω² is " + base::to_text(row.range.least, 4)
                                   : ", also those of the nonlocal operator itself");
        continue;
      }
      trend->x.push_back(coordinate(trend->axis, row));
      trend->values.push_back(error);
      trend->round_off = std::max(trend->round_off, row.round_off);
      trend->proof = row.limit.defect >= trend->proof.defect ? row.limit : trend->proof;
    }
    for (Trend &trend : trends)
    {
      if (trend.outcome != Outcome::failed)
        judge(trend, scene.study.variable);
      trend.verdict = verdict_of(scene.study.regime, trend);
    }
    return trends;
  }
} // namespace plumbline::study
