#include "study/strain_growth.h"

#include "analysis/amplification.h"
#include "analysis/wave_growth.h"
#include "base/error.h"
#include "base/number_text.h"
#include "method/discretisation.h"
#include "study/motion_steps.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace plumbline::study
{
  using analysis::Curve;

  namespace
  {
    constexpr const char *of_tangent = "linear"; ///< the column of rates by a method's own tangent

    using physics::SymmetricMatrix;
    using Wave = std::array<double, 2>;

    struct Direction
    {
      const char *name;
      SymmetricMatrix strain;
    };
    const Direction directions[] = {
        {"uniaxial", {1, 0, 0}}, {"biaxial", {1, 0, 1}}, {"shear", {0, 1, 0}}};

    SymmetricMatrix times(double g, const SymmetricMatrix &strain)
    {
      return {g * strain.xx, g * strain.xy, g * strain.yy};
    }

    /// Those of a torus, one of each pair ±k, no shorter than four cells, since lattices
    /// carry shorter ones badly, nor than half a bond, beyond which symbols are near their limit.
    std::vector<Wave> waves_of(const geometry::Box &box, const problem::Level &level)
    {
      const double largest = std::min(4 * M_PI / level.horizon, M_PI / (2 * level.h)) * (1 + 1e-9);
      std::array<double, 2> first{};
      std::array<int, 2> n{};
      for (unsigned int a = 0; a < 2; ++a)
      {
        first[a] = 2 * M_PI / (box.upper[a] - box.lower[a]);
        n[a] = static_cast<int>(largest / first[a]);
      }
      std::vector<Wave> waves;
      for (int j = 0; j <= n[1]; ++j)
        for (int i = j == 0 ? 1 : -n[0]; i <= n[0]; ++i)
          if (std::hypot(i * first[0], j * first[1]) <= largest)
            waves.push_back({i * first[0], j * first[1]});
      return waves;
    }

    /// The least eigenvalue over waves, and whose it is.
    std::pair<double, Wave> least(const physics::DoubleWell &law, const SymmetricMatrix &strain,
                                  const std::vector<Wave> &waves)
    {
      std::pair<double, Wave> result{};
      bool is_first = true;
      for (const Wave &wave : waves)
      {
        const double value = wave_symbol(law, strain, wave).eigenvalues()[0];
        if (is_first || value < result.first)
          result = {value, wave};
        is_first = false;
      }
      return result;
    }

    /// The X at which one of the waves begins to grow, to 1e-6.
    double first_wave(const physics::DoubleWell &law, const SymmetricMatrix &direction,
                      const std::vector<Wave> &waves, double lower, double upper)
    {
      const auto grows = [&](double x)
      {
        const double g = std::sqrt(x / (law.beta() * law.horizon()));
        return least(law, times(g, direction), waves).first < 0;
      };
      if (!grows(upper))
        return 0;
      while (upper - lower > 1e-6)
      {
        const double middle = .5 * (lower + upper);
        (grows(middle) ? upper : lower) = middle;
      }
      return upper;
    }

    double rate(double eigenvalue, double density)
    {
      return eigenvalue < 0 ? std::sqrt(-eigenvalue / density) : 0;
    }

    double largest_difference(const StrainGrowth &growth, const std::vector<double> &a,
                              const std::function<double(std::size_t)> &b)
    {
      double largest = 0, size = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
      {
        largest = std::max(largest, std::abs(a[i] - b(i)));
        size = std::max(size, growth.samples[i].symbol);
      }
      return size > 0 ? largest / size : largest;
    }
  } // namespace

  double StrainGrowth::difference(const MethodGrowth &of) const
  {
    return largest_difference(*this, of.observed, [&](std::size_t i) { return samples[i].symbol; });
  }

  double StrainGrowth::own_difference(const MethodGrowth &of) const
  {
    return largest_difference(*this, of.observed, [&](std::size_t i) { return of.linear[i]; });
  }

  std::vector<StrainGrowth> strain_growths(const scene::Scene &scene, const std::string &series,
                                           const problem::Level &level)
  {
    constexpr int n_samples = 12;
    constexpr double beyond = 1.25; // of where (64) fails
    const physics::DoubleWell law = make_double_well(scene, level.horizon);
    const double density = scene.time.density, horizon = level.horizon;
    const auto waves = waves_of(scene.domain.boxes.include.front(), level);
    std::vector<StrainGrowth> growths;
    for (const Direction &direction : directions)
    {
      StrainGrowth growth{series, direction.name, level.h, horizon, {}, 0, {}, {}};
      growth.thresholds = stability_thresholds(law, direction.strain);
      const double end = beyond * growth.thresholds.local;
      for (int i = 1; i <= n_samples; ++i)
      {
        StrainSample sample;
        sample.amplitude = end * i / n_samples;
        sample.strain = std::sqrt(sample.amplitude / (law.beta() * horizon));
        const SymmetricMatrix strain = times(sample.strain, direction.strain);
        const auto [value, wave] = least(law, strain, waves);
        sample.wave = wave;
        sample.symbol = rate(value, density);
        sample.local =
            rate(4 / (horizon * horizon) * local_stability(law, strain).eigenvalues()[0], density);
        growth.samples.push_back(sample);
      }
      growth.first_wave =
          first_wave(law, direction.strain, waves, growth.thresholds.ellipticity, end);
      growths.push_back(growth);
    }
    return growths;
  }

  void add_growth(const method::Method &method, const problem::Problem<2> &problem, double density,
                  std::vector<StrainGrowth> &growths)
  {
    constexpr double longest_time = 400; // in horizons over the speed of a bond, √(p/ρ)
    MethodGrowth result{method.name(), method.family(), {}, {}, {}};
    std::unique_ptr<method::Discretisation> discretisation;
    try
    {
      discretisation = method.discretise(problem, base::Communicator::alone());
    }
    catch (const NumericalError &error)
    {
      result.failure = error.what();
      for (StrainGrowth &growth : growths)
        growth.methods.push_back(result);
      return;
    }
    for (std::size_t d = 0; d < growths.size(); ++d)
    {
      StrainGrowth &growth = growths[d];
      MethodGrowth one = result;
      for (const StrainSample &sample : growth.samples)
      {
        const SymmetricMatrix strain = times(sample.strain, directions[d].strain);
        const dealii::Tensor<2, 2> gradient({{strain.xx, strain.xy}, {strain.xy, strain.yy}});
        const auto equation = discretisation->motion_about(gradient);
        if (!equation)
          return;
        const analysis::Vector drive(equation->drive(problem).size());
        const analysis::Transient transient(*equation, analysis::TimeSeries(drive), density, 0);
        const problem::Field<2> stretched{[&](const dealii::Point<2> &x, unsigned int c)
                                          { return gradient[c][0] * x[0] + gradient[c][1] * x[1]; },
                                          {}};
        try
        {
          const auto found = analysis::observe_growth(
              *equation, transient, equation->state(stretched), sample.wave, growth.horizon,
              longest_time * growth.horizon *
                  std::sqrt(density / problem.double_well->stiffness()));
          one.linear.push_back(found.linear);
          one.observed.push_back(found.observed);
        }
        catch (const NumericalError &error)
        {
          one.failure = error.what();
          break;
        }
      }
      growth.methods.push_back(one);
    }
  }

  Record strain_record(Record record, const StrainGrowth &growth, const MethodGrowth &one)
  {
    record.key.variant = growth.name + " strain";
    record.failure = one.failure;
    record.set("ellipticity lost", growth.thresholds.ellipticity);
    record.set("criterion (64)", growth.thresholds.local);
    if (growth.first_wave > 0)
      record.set("first wave of the torus", growth.first_wave);
    Curve curve = {{"X", "", {}},
                   {"strain", "", {}},
                   {"k1", "1/length", {}},
                   {"k2", "1/length", {}},
                   {"symbol", "1/time", {}},
                   {"local", "1/time", {}},
                   {of_tangent, "1/time", {}},
                   {"observed", "1/time", {}}};
    for (std::size_t i = 0; i < one.observed.size(); ++i)
    {
      const StrainSample &sample = growth.samples[i];
      const double row[] = {sample.amplitude, sample.strain, sample.wave[0], sample.wave[1],
                            sample.symbol,    sample.local,  one.linear[i],  one.observed[i]};
      for (std::size_t k = 0; k < curve.size(); ++k)
        curve[k].values.push_back(row[k]);
      if (one.observed[i] > 0 && !record.has("first seen"))
        record.set("first seen", sample.amplitude);
    }
    record.curves["growth"] = std::move(curve);
    if (one.failure.empty())
    {
      record.set("difference from the symbol", growth.difference(one));
      record.set("difference from the tangent", growth.own_difference(one));
    }
    return record;
  }

  void enter_spectral_radii(const scene::TimeSection &time, double critical, Record &record)
  {
    const Curve &growth = record.curves.at("growth");
    const auto linear =
        std::find_if(growth.begin(), growth.end(),
                     [](const analysis::Column &column) { return column.name == of_tangent; });
    double step = 0;
    for (const StepRule &rule : step_rules(time))
      step = std::max(step, rule.is_fraction ? rule.value * critical : rule.value);
    if (linear == growth.end() || linear->values.empty() || !(step > 0))
      return;
    const double rate = linear->values.back();
    record.set("growth rate", rate, "1/time");
    record.set("growth step", step, "time");
    record.set("growth factor", std::exp(rate * step));
    for (const std::string &name : time.schemes)
      if (const analysis::Scheme &scheme = analysis::scheme(name); !scheme.is_runge_kutta)
        record.set(spectral_radius_of + name, analysis::spectral_radius(scheme, rate * rate, step));
  }

  Records strain_records(const Place &place, const Method &method, double critical)
  {
    const double density = place.scene().time.density;
    using Growths = std::vector<StrainGrowth>;
    Growths growths = place.shared<Growths>(
        "strains",
        [&] { return strain_growths(place.scene(), place.series().name, place.level()); });
    add_growth(method, place.problem(), density, growths);
    Records records;
    for (const StrainGrowth &growth : growths)
      for (const MethodGrowth &one : growth.methods) // none: no motion about strains
      {
        records.push_back(strain_record(place.record("stability", method), growth, one));
        enter_spectral_radii(place.scene().time, critical, records.back());
      }
    return records;
  }

  std::vector<Expectation> check_growth(const scene::Scene &scene, const Records &records)
  {
    std::vector<Expectation> results;
    for (const scene::Expected &expected : scene.expected.all)
    {
      if (expected.kind != scene::ExpectedKind::growth)
        continue;
      double worst = 0;
      bool is_found = false;
      std::string failure;
      for (const Record &record : records)
        if (record.key.method == expected.method && record.curves.count("growth") > 0)
        {
          is_found = true;
          failure += record.failure;
          if (record.failure.empty())
            worst = std::max(worst, record["difference from the symbol"]);
        }
      results.push_back({"Expected/wave growth rates: " + expected.text,
                         "<= " + base::to_text(expected.values.front(), 4),
                         !is_found          ? "no such method on a torus of double wells"
                         : !failure.empty() ? failure
                                            : base::to_text(worst, 4),
                         is_found && failure.empty() && worst <= expected.values.front()});
    }
    return results;
  }
} // namespace plumbline::study
