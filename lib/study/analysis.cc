#include "study/analysis.h"

#include "base/cost.h"
#include "base/error.h"
#include "base/number_text.h"
#include "study/expectations.h"

#include <algorithm>

namespace plumbline::study
{
  Place::Place(const scene::Scene &scene, const problem::Series &series, unsigned int level,
               bool is_finest, Common &common)
      : scene_(at_level(scene, series.levels[level])), series_(series), level_(level),
        is_finest_(is_finest), common_(common)
  {
  }

  const problem::Problem<2> &Place::problem(unsigned int index) const
  {
    return shared<problem::Problem<2>>("case " + std::to_string(index),
                                       [&] { return make_problem(scene_, index, level()); });
  }

  Record Place::record(const std::string &analysis, const Method &method) const
  {
    Record record;
    record.key = {analysis, method.name(), method.family(), "",           series_.name, "",
                  level_,   level().h,     level().horizon, level().value};
    return record;
  }

  analysis::Curve curve_of(const std::vector<std::string> &names)
  {
    analysis::Curve curve;
    for (const std::string &name : names)
      curve.push_back({name, "", {}});
    return curve;
  }

  void add_row(analysis::Curve &curve, const std::vector<double> &row)
  {
    for (std::size_t i = 0; i < curve.size(); ++i)
      curve[i].values.push_back(row[i]);
  }

  std::vector<const Record *> finest_records(const StudyResults &results)
  {
    std::vector<const Record *> finest;
    for (const Record &record : results.records)
    {
      if (!record.failure.empty())
        continue;
      const auto same =
          std::find_if(finest.begin(), finest.end(),
                       [&](const Record *other) { return other->key.is_same_series(record.key); });
      if (same == finest.end())
        finest.push_back(&record);
      else
        *same = &record; // coarse to fine
    }
    return finest;
  }

  namespace
  {
    bool is_of(const Record &record, const Place &place, const Method &method)
    {
      return record.key.method == method.name() && record.key.series == place.series().name &&
             record.key.h == place.level().h && record.key.horizon == place.level().horizon &&
             record.key.value == place.level().value;
    }

    /// What a method is expected to cost at a level, from the two levels before it [CPU s].
    /// Infinite where the level before was left out.
    double expected_seconds(const Records &records, const Place &place, unsigned int level)
    {
      constexpr double usual_growth = 4; // of unknowns, as h halves
      if (level == 0)
        return 0;
      std::vector<double> seconds(level, 0);
      for (const Record &record : records)
        if (record.key.series == place.series().name && record.key.level < level)
          seconds[record.key.level] += record.cost.seconds();
      const double last = seconds[level - 1], before = level < 2 ? 0 : seconds[level - 2];
      if (last == 0)
        return std::numeric_limits<double>::infinity();
      return last * (before > 0 ? last / before : usual_growth);
    }

    class Study
    {
    public:
      Study(const Analysis &analysis, const scene::Scene &scene, const Methods &methods,
            const RunControl &control)
          : analysis_(analysis), scene_(scene), methods_(methods), control_(control),
            records_(methods.size())
      {
        results_.analysis = analysis.name;
        results_.scene_name = scene.name;
        results_.purpose = scene.purpose;
        results_.scene_text = scene.text;
        results_.regime = scene.study.regime;
        results_.variable = scene.study.variable;
        common_.make_part = [this](const Record &begun, const Common::Fill &fill)
        { make_part(begun, fill); };
      }

      StudyResults run()
      {
        for (const problem::Series &series : scene_.study.series)
          n_all_ += n_levels(series) * methods_.size();
        for (const problem::Series &series : scene_.study.series)
          for (unsigned int level = 0; level < n_levels(series) && results_.is_complete; ++level)
            run_level({scene_, series, level, level + 1 == n_levels(series), common_}, level);
        for (Records &own : records_)
          std::move(own.begin(), own.end(), std::back_inserter(results_.records));
        if (analysis_.conclude)
          analysis_.conclude(scene_, results_);
        check_values(scene_, results_);
        return std::move(results_);
      }

    private:
      unsigned int n_levels(const problem::Series &series) const
      {
        const auto n = static_cast<unsigned int>(series.levels.size());
        return control_.n_levels == 0 ? n : std::min(n, control_.n_levels);
      }

      void run_level(const Place &place, unsigned int level)
      {
        for (std::size_t i = 0; i < methods_.size() && results_.is_complete; ++i, ++n_done_)
        {
          if (control_.should_stop && control_.should_stop())
          {
            results_.is_complete = false;
            return;
          }
          const Method &method = *methods_[i];
          Records own;
          std::copy_if(control_.earlier.begin(), control_.earlier.end(), std::back_inserter(own),
                       [&](const Record &record) { return is_of(record, place, method); });
          if (own.empty() ? is_affordable(records_[i], place, level, method) : analysis_.has_parts)
            own = analyse(place, method);
          std::move(own.begin(), own.end(), std::back_inserter(records_[i]));
        }
      }

      bool is_affordable(const Records &before, const Place &place, unsigned int level,
                         const Method &method)
      {
        const double seconds = control_.budget > 0 ? expected_seconds(before, place, level) : 0;
        if (seconds <= control_.budget)
          return true;
        results_.left_out.push_back(
            method.name() + ", " + place.series().name +
            ", h = " + base::to_text(place.level().h, 6) +
            (std::isfinite(seconds) ? ": some " + base::to_text(seconds, 6) + " CPU s" : ""));
        return false;
      }

      void show_progress(const Key &key) const
      {
        if (control_.on_progress)
          control_.on_progress(analysis_.name + ", " + key.series +
                                   ", h = " + base::to_text(key.h, 4) + ": " + key.label(),
                               static_cast<double>(n_done_) / static_cast<double>(n_all_));
      }

      void make_part(const Record &begun, const Common::Fill &fill)
      {
        const auto known = std::find_if(control_.earlier.begin(), control_.earlier.end(),
                                        [&](const Record &one) { return one.key == begun.key; });
        if (known != control_.earlier.end())
        {
          parts_.push_back(*known);
          return;
        }
        if (control_.should_stop && control_.should_stop())
          throw Interrupted();
        show_progress(begun.key);
        Record record = begun;
        try
        {
          fill(record);
        }
        catch (const NumericalError &error)
        {
          record.failure = error.what();
        }
        parts_.push_back(record);
        if (control_.on_records)
          control_.on_records({record});
      }

      Records analyse(const Place &place, const Method &method)
      {
        const base::CpuTimer timer;
        Records records;
        parts_.clear();
        if (!analysis_.has_parts)
          show_progress(place.record(analysis_.name, method).key);
        try
        {
          records = analysis_.analyse(place, method);
        }
        catch (const NumericalError &error)
        {
          records = {place.record(analysis_.name, method)};
          records.front().failure = error.what();
        }
        catch (const Interrupted &)
        {
          results_.is_complete = false;
        }
        double known = 0;
        for (const Record &record : records)
          known += record.cost.seconds();
        if (known == 0 && !records.empty()) // else the analysis has timed its parts
          records.front().cost.solve_seconds = timer.seconds();
        if (control_.on_records && !records.empty())
          control_.on_records(records);
        records.insert(records.begin(), std::make_move_iterator(parts_.begin()),
                       std::make_move_iterator(parts_.end()));
        return records;
      }

      const Analysis &analysis_;
      const scene::Scene &scene_;
      const Methods &methods_;
      const RunControl &control_;
      std::vector<Records> records_; ///< of each method
      StudyResults results_;
      Common common_;
      Records parts_; ///< of the present method and place
      std::size_t n_done_ = 0, n_all_ = 0;
    };
  } // namespace

  bool Analysis::is_sampled(const std::string &scalar) const
  {
    return sampled.empty() ||
           std::any_of(sampled.begin(), sampled.end(),
                       [&](const std::string &end)
                       {
                         return scalar.size() >= end.size() &&
                                scalar.compare(scalar.size() - end.size(), end.size(), end) == 0;
                       });
  }

  StudyResults run_study(const Analysis &analysis, scene::Scene scene, const Methods &methods,
                         const RunControl &control)
  {
    if (analysis.prepare)
      analysis.prepare(scene);
    return Study(analysis, scene, methods, control).run();
  }
} // namespace plumbline::study
