#include "study/dispersion.h"

#include "base/error.h"
#include "base/number_text.h"
#include "method/discretisation.h"
#include "scene/capabilities.h"
#include "scene/problem.h"
#include "study/preflight.h"
#include "study/trend.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::study
{
  using analysis::Curve;

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
      Measurement(const problem::Problem<2> &problem, const WaveStudy &study)
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

      const problem::Problem<2> &problem_;
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
    for (const problem::Series &series : scene.study.series)
      for (const problem::Level &level : series.levels)
        needs(2 * level.h <= study.wavelength,
              "Study/h = " + base::to_text(level.h, 4) +
                  " carries no wave as long as the domain, " + base::to_text(study.wavelength, 4) +
                  "; give h <= " + base::to_text(study.wavelength / 2, 4));
    return study;
  }

  std::vector<DispersionRow> measure_waves(const Method &method, const problem::Problem<2> &problem,
                                           const WaveStudy &study, const std::string &series,
                                           bool is_finest)
  {
    const Measurement measurement(problem, study);
    DispersionRow row;
    row.method = method.name();
    row.family = method.family();
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

  namespace
  {
    std::string name_of(const WaveCurve &curve)
    {
      const std::string way = name(curve.polarisation);
      return (way.empty() ? "" : way + " ") + "waves at " + base::to_text(curve.angle, 4) + "°";
    }
  } // namespace

  Record wave_record(Record record, const DispersionRow &row)
  {
    record.failure = row.failure;
    record.texts["proof"] = base::word(row.limit.answer);
    record.texts["proof, reason"] = row.limit.reason;
    record.set("moment defect", row.limit.defect);
    if (!row.failure.empty())
      return record;
    double fastest = 0;
    for (const WaveCurve &curve : row.curves)
    {
      const std::string waves = name_of(curve);
      record.set(waves + ": error of long waves", curve.long_wave_error);
      record.set(waves + ": phase speed", curve.longest.phase, "length/time");
      record.set(waves + ": group speed", curve.longest.group, "length/time");
      record.set(waves + ": nonlocal phase speed", curve.longest.exact_phase, "length/time");
      record.set(waves + ": nonlocal group speed", curve.longest.exact_group, "length/time");
      record.set(waves + ": local speed", curve.local_speed, "length/time");
      fastest = std::max(fastest, curve.local_speed);
      if (curve.samples.empty())
        continue;
      Curve samples = {{"k", "1/length", {}},
                       {"phase speed", "length/time", {}},
                       {"group speed", "length/time", {}},
                       {"nonlocal phase speed", "length/time", {}},
                       {"nonlocal group speed", "length/time", {}}};
      for (const WaveSample &one : curve.samples)
      {
        const double values[] = {one.k, one.phase, one.group, one.exact_phase, one.exact_group};
        for (std::size_t i = 0; i < samples.size(); ++i)
          samples[i].values.push_back(values[i]);
      }
      record.curves[waves] = std::move(samples);
    }
    const auto names = physics::polarisations(
        row.anisotropy.size() == 1 ? physics::Structure::scalar : physics::Structure::tensor);
    for (std::size_t i = 0; i < names.size(); ++i)
      record.set("anisotropy" + (names.size() == 1 ? "" : " " + name(names[i])), row.anisotropy[i]);
    record.set("error against the local limit", row.worst_local_error());
    record.set("error against the nonlocal operator", row.worst_nonlocal_error());
    record.set("round-off", row.round_off);
    record.set("least squared frequency", row.range.least, "1/time^2");
    record.set("largest squared frequency", row.range.largest, "1/time^2");
    record.set("grows", row.grows() ? 1 : 0);
    record.set("critical step", row.critical_step(), "time");
    record.set("critical step, of the time in which a wave crosses h",
               row.critical_step() * fastest / row.h);
    return record;
  }

  std::vector<Trend> wave_trends(const scene::Scene &scene, const Records &records)
  {
    const char *const measure = "error against the nonlocal operator";
    std::vector<Trend> trends;
    for (const Record &record : records)
    {
      const Key &key = record.key;
      auto trend = std::find_if(trends.begin(), trends.end(),
                                [&](const Trend &t)
                                { return t.method == key.label() && t.series == key.series; });
      if (trend == trends.end())
      {
        Trend first;
        first.method = key.label();
        first.family = key.family;
        first.series = key.series;
        first.error = "phase speed | nonlocal";
        first.axis = level_axis(scene.study.regime);
        first.size = 1; // errors are relative
        trend = trends.insert(trends.end(), first);
      }
      const bool grows = record.count("grows") > 0;
      if (!record.failure.empty() || !record.has(measure) || grows)
      {
        trend->outcome = Outcome::failed;
        trend->reason = !record.failure.empty()
                            ? record.failure
                            : "waves grow at h = " + base::to_text(key.h, 4) +
                                  (grows ? ", the least ω² is " +
                                               base::to_text(record["least squared frequency"], 4)
                                         : ", also those of the nonlocal operator itself");
        continue;
      }
      trend->x.push_back(coordinate(trend->axis, key));
      trend->values.push_back(record[measure]);
      trend->round_off = std::max(trend->round_off, record["round-off"]);
      if (record["moment defect"] >= trend->proof.defect)
      {
        trend->proof.defect = record["moment defect"];
        trend->proof.answer = base::from_word<LimitProof::Answer>(record.text("proof"))
                                  .value_or(LimitProof::Answer());
        trend->proof.reason = record.text("proof, reason");
      }
    }
    for (Trend &trend : trends)
    {
      if (trend.outcome != Outcome::failed)
        judge(trend, scene.study.variable);
      trend.verdict = verdict_of(scene.study.regime, trend);
    }
    return trends;
  }

  const std::vector<double> usual_angles = {0, 22.5, 45};

  namespace
  {
    void check_angles(const std::vector<double> &angles)
    {
      constexpr std::size_t most = 16;
      if (angles.empty() || angles.size() > most)
        throw InputError("--angles has " + std::to_string(angles.size()) +
                         " directions; give 1 to " + std::to_string(most));
      for (const double angle : angles)
        if (!std::isfinite(angle) || std::abs(angle) > 360)
          throw InputError("--angles: " + base::to_text(angle, 4) +
                           " is no direction; give degrees from -360 to 360");
    }
  } // namespace

  Analysis dispersion_analysis(const std::vector<double> &angles)
  {
    check_angles(angles);
    Analysis analysis{"dispersion", "Dispersion"};
    for (const double angle : angles)
      analysis.options += (analysis.options.empty() ? "" : " ") + base::to_text(angle, 17);
    analysis.choose_methods =
        [angles](const scene::Scene &scene, const Methods &available, unsigned int, unsigned int)
    {
      (void)plan_waves(scene, angles);
      return study::choose_methods(scene, available);
    };
    analysis.analyse = [angles](const Place &place, const Method &method)
    {
      WaveStudy waves = plan_waves(place.scene(), angles);
      Records records;
      for (const DispersionRow &row :
           measure_waves(method, place.problem(), waves, place.series().name, place.is_finest()))
      {
        Record record = place.record("dispersion", method);
        record.key.variant = row.method == method.name() ? "" : "lumped";
        records.push_back(wave_record(std::move(record), row));
      }
      return records;
    };
    analysis.conclude = [angles](const scene::Scene &scene, StudyResults &results)
    {
      std::string directions;
      for (const double angle : angles)
        directions += (directions.empty() ? "" : ", ") + base::to_text(angle, 4) + "°";
      results.facts = {{"longest wave", base::to_text(plan_waves(scene, angles).wavelength, 4)},
                       {"directions", directions}};
      results.trends = wave_trends(scene, results.records);
    };
    analysis.sampled = {"critical step", ": phase speed"};
    return analysis;
  }
} // namespace plumbline::study
