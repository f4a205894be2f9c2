#include "study/dispersion.h"

#include "base/error.h"
#include "base/number_text.h"
#include "method/box_discretisation.h"
#include "method/discretisation.h"
#include "physics/waves.h"
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

    /// The square of the speed of long waves.
    template <int dim>
    double squared_local_speed(const problem::Problem<dim> &problem, physics::Polarisation p)
    {
      std::optional<physics::Lame> solid;
      if (problem.dilatation)
        solid = problem.dilatation->material({});
      return physics::squared_local_speed(problem.kernel.limit(), solid, p);
    }

    std::vector<algebra::Vector3> diagonals(unsigned int dimension)
    {
      if (dimension == 2)
        return {algebra::in_plane(M_PI / 4)};
      const double face = std::sqrt(1. / 2), cube = std::sqrt(1. / 3);
      return {{face, face, 0}, {cube, cube, cube}};
    }

    /// The waves of one symbol at one level.
    template <int dim>
    class Measurement
    {
    public:
      Measurement(const problem::Problem<dim> &problem, const WaveStudy &study)
          : problem_(problem), study_(study),
            branches_(physics::branches(problem.n_components == 1 ? physics::Structure::scalar
                                                                  : physics::Structure::tensor,
                                        dim))
      {
      }

      /// Fill in curves, anisotropy, range and round-off.
      void measure(const algebra::Symbol &symbol, bool is_finest, DispersionRow &row) const
      {
        for (const WaveDirection &direction : study_.directions)
          for (std::size_t i = 0; i < branches_.size(); ++i)
            row.curves.push_back(curve(symbol, i, direction));
        const double k = 2 * M_PI / study_.wavelength;
        sample(symbol, k, row,
               [](WaveCurve &curve, const WaveSample &one) { curve.longest = one; });
        if (is_finest)
          for (const double cells : lengths())
            sample(symbol, 2 * M_PI / (cells * row.h), row,
                   [](WaveCurve &curve, const WaveSample &one) { curve.samples.push_back(one); });
        for (std::size_t i = 0; i < branches_.size(); ++i)
          row.anisotropy.emplace_back(branches_[i].name, anisotropy(symbol, i));
        row.range = symbol.range();
        for (double *const squared : {&row.range.least, &row.range.largest})
          *squared /= study_.density;
        // sums of entries of the size of the largest ω² cancel down to that of the longest wave
        for (std::size_t i = 0; i < branches_.size(); ++i)
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
        return speed(squared_local_speed(problem_, branches_[i].polarisation));
      }

      double anisotropy(const algebra::Symbol &symbol, std::size_t i) const
      {
        const double along_axis = speed(symbol.long_waves({1, 0, 0})[i]);
        double result = 0;
        for (const algebra::Vector3 &diagonal : diagonals(dim))
        {
          const double difference =
              (along_axis - speed(symbol.long_waves(diagonal)[i])) / local_speed(i);
          if (std::isnan(difference) || std::abs(difference) > std::abs(result)) // NaN stays
            result = difference;
        }
        return result;
      }

      WaveCurve curve(const algebra::Symbol &symbol, std::size_t i,
                      const WaveDirection &direction) const
      {
        WaveCurve result;
        result.name =
            (branches_[i].name.empty() ? "" : branches_[i].name + " ") + "waves " + direction.name;
        result.local_speed = local_speed(i);
        result.long_wave_error = speed(symbol.long_waves(direction.n)[i]) / result.local_speed - 1;
        return result;
      }

      /// One wave number in all directions, given to each curve of the row.
      template <typename Take>
      void sample(const algebra::Symbol &symbol, double k, DispersionRow &row,
                  const Take &take) const
      {
        std::vector<physics::Frequency> exact; // the same in all directions
        for (const physics::Branch &branch : branches_)
          exact.push_back(
              physics::exact_wave(problem_.kernel, problem_.dilatation, branch.polarisation, k));
        auto curve = row.curves.begin();
        for (const WaveDirection &direction : study_.directions)
        {
          const auto waves = symbol.waves(k, direction.n);
          for (std::size_t i = 0; i < waves.size(); ++i, ++curve)
          {
            const double omega = speed(waves[i].squared), exact_omega = speed(exact[i].squared),
                         per_omega = 1 / (2 * study_.density);
            take(*curve, {k, omega / k, per_omega * waves[i].slope / omega, exact_omega / k,
                          per_omega * exact[i].slope / exact_omega});
          }
        }
      }

      const problem::Problem<dim> &problem_;
      const WaveStudy &study_;
      std::vector<physics::Branch> branches_;
    };

    /// Of the bounding box of a scene's domain.
    double longest_side(const scene::DomainSection &domain)
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      double side = 0;
      const auto add_axis = [&](const auto &boxes, unsigned int axis)
      {
        double lower = infinity, upper = -infinity;
        for (const auto &box : boxes)
        {
          lower = std::min(lower, box.lower[axis]);
          upper = std::max(upper, box.upper[axis]);
        }
        side = std::max(side, upper - lower);
      };
      for (unsigned int d = 0; d < domain.dimension; ++d)
        domain.is_in_space() ? add_axis(domain.solid.include, d)
                             : add_axis(domain.boxes.include, d);
      return side;
    }

    /// @param row  with method, family, series and level
    template <int dim>
    DispersionRow measured(DispersionRow row, const Measurement<dim> &measurement,
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

  namespace
  {
    void check_number_of_directions(const std::string &option, std::size_t n)
    {
      constexpr std::size_t most = 16;
      if (n > most)
        throw InputError(option + " has " + std::to_string(n) + " directions; give 1 to " +
                         std::to_string(most));
    }

    WaveDirection at_angle(double angle)
    {
      if (!std::isfinite(angle) || std::abs(angle) > 360)
        throw InputError("--angles: " + base::to_text(angle, 4) +
                         " is not a direction; give degrees from -360 to 360");
      return {"at " + base::to_text(angle, 4) + "°", algebra::in_plane(angle * M_PI / 180)};
    }

    WaveDirection along(const algebra::Vector3 &vector)
    {
      const double size = std::hypot(vector[0], vector[1], vector[2]);
      WaveDirection result{"along (", vector};
      for (unsigned int d = 0; d < 3; ++d)
      {
        result.name += base::to_text(vector[d], 4) + (d < 2 ? ", " : ")");
        result.n[d] /= size;
      }
      if (!(size > 0 && std::isfinite(size)))
        throw InputError(
            "--directions: " + result.name.substr(6) +
            " is not a direction; give three finite numbers that are not all 0, e.g. 1,1,0");
      return result;
    }
  } // namespace

  std::vector<WaveDirection> wave_directions(const AskedDirections &asked, unsigned int dimension)
  {
    std::vector<WaveDirection> result;
    if (dimension == 3)
    {
      if (!asked.angles.empty())
        throw InputError("--angles is for two dimensions, but Domain/dimension = 3; give "
                         "--directions, three numbers each, e.g. 1,0,0 1,1,0");
      check_number_of_directions("--directions", asked.vectors.size());
      for (const auto &vector : asked.vectors.empty()
                                    ? std::vector<algebra::Vector3>{{1}, {1, 1}, {1, 1, 1}}
                                    : asked.vectors)
        result.push_back(along(vector));
      return result;
    }
    if (!asked.vectors.empty())
      throw InputError("--directions is for three dimensions, but Domain/dimension = " +
                       std::to_string(dimension) + "; write --angles in degrees, e.g. 0,45");
    check_number_of_directions("--angles", asked.angles.size());
    for (const double angle :
         asked.angles.empty() ? std::vector<double>{0, 22.5, 45} : asked.angles)
      result.push_back(at_angle(angle));
    return result;
  }

  WaveStudy plan_waves(const scene::Scene &scene, const AskedDirections &directions)
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
    const physics::LocalLimit limit = scene.domain.is_in_space()
                                          ? make_kernel_in_space(scene, 1).limit()
                                          : make_kernel(scene, 1).limit();
    needs(limit.diffusion > 0 || limit.mu > 0,
          "Kernel/coefficients and Kernel/constant make a local limit of " +
              base::to_text(scene.is_vector() ? limit.mu : limit.diffusion, 4) +
              " (diffusion, or mu), which has no waves; it must be positive: change their signs");
    WaveStudy study{wave_directions(directions, scene.domain.dimension), longest_side(scene.domain),
                    scene.time.density};
    for (const problem::Series &series : scene.study.series)
      for (const problem::Level &level : series.levels)
        needs(2 * level.h <= study.wavelength,
              "Study/h = " + base::to_text(level.h, 4) +
                  " carries no wave as long as the domain, " + base::to_text(study.wavelength, 4) +
                  "; give h <= " + base::to_text(study.wavelength / 2, 4));
    return study;
  }

  namespace
  {
    /// @param row  given the proof of the method's limit
    std::optional<algebra::WaveOperator>
    waves_of(const Method &method, const problem::Problem<2> &problem, DispersionRow &row)
    {
      const auto discretisation = method.discretise(problem, base::Communicator::alone());
      row.limit = discretisation->diagnostics().limit;
      return discretisation->waves();
    }

    std::optional<algebra::WaveOperator>
    waves_of(const Method &method, const problem::Problem<3> &problem, DispersionRow &row)
    {
      const auto discretisation = method.discretise_in_space(problem);
      row.limit = discretisation->diagnostics().limit;
      return discretisation->waves();
    }
  } // namespace

  template <int dim>
  std::vector<DispersionRow>
  measure_waves(const Method &method, const problem::Problem<dim> &problem, const WaveStudy &study,
                const std::string &series, bool is_finest)
  {
    const Measurement<dim> measurement(problem, study);
    DispersionRow row;
    row.method = method.name();
    row.family = method.family();
    row.series = series;
    row.h = problem.level().h;
    row.horizon = problem.horizon();
    std::optional<algebra::WaveOperator> waves;
    try
    {
      waves = waves_of(method, problem, row);
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

  template std::vector<DispersionRow> measure_waves(const Method &, const problem::Problem<2> &,
                                                    const WaveStudy &, const std::string &, bool);
  template std::vector<DispersionRow> measure_waves(const Method &, const problem::Problem<3> &,
                                                    const WaveStudy &, const std::string &, bool);

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
      const std::string &waves = curve.name;
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
    for (const auto &[branch, anisotropy] : row.anisotropy)
      record.set("anisotropy" + (branch.empty() ? "" : " " + branch), anisotropy);
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
                                  (grows ? ", the smallest ω² is " +
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

  namespace
  {
    /// Of a record of several that one method makes: its waves by the place's problem.
    std::vector<DispersionRow> measure_at(const Place &place, const Method &method,
                                          const WaveStudy &waves)
    {
      const std::string &series = place.series().name;
      if (!place.scene().domain.is_in_space())
        return measure_waves(method, place.problem(), waves, series, place.is_finest());
      const auto &problem = place.shared<problem::Problem<3>>(
          "problem in space",
          [&] { return make_problem_in_space(place.scene(), 0, place.level()); });
      return measure_waves(method, problem, waves, series, place.is_finest());
    }

    /// The numbers that were asked for, to tell studies apart.
    std::string text_of(const AskedDirections &asked)
    {
      std::vector<double> numbers = asked.angles;
      for (const algebra::Vector3 &vector : asked.vectors)
        numbers.insert(numbers.end(), vector.begin(), vector.end());
      std::string text;
      for (const double number : numbers)
        text += (text.empty() ? "" : " ") + base::to_text(number, 17);
      return text;
    }
  } // namespace

  Analysis dispersion_analysis(const AskedDirections &directions)
  {
    Analysis analysis{"dispersion", "Dispersion"};
    analysis.options = text_of(directions);
    analysis.choose_methods = [directions](const scene::Scene &scene, const Methods &available,
                                           unsigned int, unsigned int)
    {
      (void)plan_waves(scene, directions);
      return study::choose_methods(scene, available);
    };
    analysis.analyse = [directions](const Place &place, const Method &method)
    {
      Records records;
      for (const DispersionRow &row :
           measure_at(place, method, plan_waves(place.scene(), directions)))
      {
        Record record = place.record("dispersion", method);
        record.key.variant = row.method == method.name() ? "" : "lumped";
        records.push_back(wave_record(std::move(record), row));
      }
      return records;
    };
    analysis.conclude = [directions](const scene::Scene &scene, StudyResults &results)
    {
      const WaveStudy waves = plan_waves(scene, directions);
      std::string names;
      for (const WaveDirection &direction : waves.directions)
        names += (names.empty() ? "" : ", ") + direction.name.substr(direction.name.find(' ') + 1);
      results.facts = {{"longest wave", base::to_text(waves.wavelength, 4)},
                       {"directions", names},
                       {"first direction", waves.directions.front().name}};
      results.trends = wave_trends(scene, results.records);
    };
    analysis.sampled = {"critical step", ": phase speed"};
    return analysis;
  }
} // namespace plumbline::study
