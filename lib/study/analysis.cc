#include "study/analysis.h"

#include "base/cost.h"
#include "base/error.h"
#include "base/number_text.h"
#include "study/expectations.h"
#include "study/statement_lists.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

    /// What a method is expected to cost at a place, from the two levels before it [CPU s].
    /// Infinite where the level before was left out.
    double expected_seconds(const Records &records, const Place &place, const Method &method)
    {
      constexpr double usual_growth = 4; // of unknowns, as h halves
      const unsigned int level = place.number();
      if (level == 0)
        return 0;
      std::vector<double> seconds(level, 0);
      for (const Record &record : records)
        if (record.key.method == method.name() && record.key.series == place.series().name &&
            record.key.level < level)
          seconds[record.key.level] += record.cost.seconds();
      const double last = seconds[level - 1], before = level < 2 ? 0 : seconds[level - 2];
      if (last == 0)
        return std::numeric_limits<double>::infinity();
      return last * (before > 0 ? last / before : usual_growth);
    }

    /// Append those of others that are meant.
    template <class T, class IsMeant>
    void take(std::vector<T> &list, const std::vector<T> &others, const IsMeant &is_meant)
    {
      std::copy_if(others.begin(), others.end(), std::back_inserter(list), is_meant);
    }

    class Study
    {
    public:
      Study(const Analysis &analysis, const scene::Scene &scene, const Methods &methods,
            const RunControl &control)
          : analysis_(analysis), scene_(scene), methods_(methods), control_(control)
      {
        results_.analysis = analysis.name;
        results_.scene_name = scene.name;
        results_.purpose = scene.purpose;
        results_.scene_text = scene.text;
        results_.regime = scene.study.regime;
        results_.variable = scene.study.variable;
        if (analysis.has_decisive_error)
          results_.decisive_error = scene.study.decisive_error.text();
        results_.provenance = control.earlier.provenance;
        results_.is_complete = false;
        head_ = results_;
        if (!control.earlier.records.empty())
        {
          results_.savings = control.earlier.savings;
          results_.warnings = control.earlier.warnings;
        }
        note_told();
        common_.methods = methods;
        common_.make_part = [this](const Record &begun, const Common::Fill &fill)
        { make_part(begun, fill); };
        common_.fill = [this](Record &record, const Common::Fill &fill)
        { fill_record(record, fill); };
      }

      StudyResults run()
      {
        for (const problem::Series &series : scene_.study.series)
          for (unsigned int level = 0; level < n_levels(series); ++level)
            work_of_all_ += work_of(series.levels[level]) * static_cast<double>(methods_.size());
        for (const problem::Series &series : scene_.study.series)
          for (unsigned int level = 0; level < n_levels(series) && !is_stopped_; ++level)
            run_level({scene_, series, level, level + 1 == n_levels(series), common_});
        results_.is_complete = !is_stopped_;
        if (analysis_.complete && !is_stopped_)
          analysis_.complete(scene_, common_);
        const auto index = [&](const Record &record)
        {
          return std::find_if(methods_.begin(), methods_.end(),
                              [&](const auto &method)
                              { return method->name() == record.key.method; });
        };
        std::stable_sort(results_.records.begin(), results_.records.end(),
                         [&](const Record &a, const Record &b) { return index(a) < index(b); });
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

      void run_level(const Place &place)
      {
        bool is_begun = false;
        const auto is_here = [&](const ErrorEstimate &one)
        { return one.series == place.series().name && one.level == place.number(); };
        for (std::size_t i = 0; i < methods_.size(); ++i, work_done_ += work_of(place.level()))
        {
          if (control_.should_stop && control_.should_stop())
          {
            is_stopped_ = true;
            return;
          }
          const Method &method = *methods_[i];
          Records own = take_earlier(place, method);
          const bool is_due = own.empty() ? is_affordable(place, method) : analysis_.has_parts;
          if (is_due && analysis_.begin && !std::exchange(is_begun, true))
          {
            show_progress(place.record(analysis_.name, method).key, words_of_begin());
            analysis_.begin(place);
            if (std::any_of(control_.earlier.references.begin(), control_.earlier.references.end(),
                            is_here))
              note_told(); // of this level by the earlier study, which had begun it
          }
          if (is_due)
            own = analyse(place, method);
          std::move(own.begin(), own.end(), std::back_inserter(results_.records));
          if (is_stopped_)
            return;
        }
        if (!is_begun)
          take(results_.references, control_.earlier.references, is_here);
        note_told();
      }

      /// All that the lists of statements have now is told.
      void note_told()
      {
        n_told_.clear();
        for_each_statement_list([this](auto list) { n_told_.push_back((results_.*list).size()); });
      }

      /// Of records, and of statements that were made since the last time.
      void tell(const Records &records)
      {
        StudyResults made = head_;
        made.records = records;
        auto n = n_told_.begin();
        bool is_more = !records.empty();
        for_each_statement_list(
            [&](auto list)
            {
              const auto &all = results_.*list;
              (made.*list).assign(all.begin() + *n++, all.end());
              is_more = is_more || !(made.*list).empty();
            });
        note_told();
        if (is_more && control_.on_made)
          control_.on_made(made);
      }

      /// Records of an earlier study; what came with them goes to the results.
      Records take_earlier(const Place &place, const Method &method)
      {
        Records own;
        take(own, control_.earlier.records,
             [&](const Record &record) { return is_of(record, place, method); });
        if (own.empty())
          return own;
        take(results_.estimates, control_.earlier.estimates,
             [&](const ErrorEstimate &one)
             {
               return one.method == method.name() && one.series == place.series().name &&
                      one.level == place.number();
             });
        const auto is_drawn_here = [&](const auto &one) {
          return place.is_finest() && one.method == method.name() &&
                 one.series == place.series().name;
        };
        take(results_.maps, control_.earlier.maps, is_drawn_here);
        take(results_.solution_blocks, control_.earlier.solution_blocks, is_drawn_here);
        note_told();
        return own;
      }

      bool is_affordable(const Place &place, const Method &method)
      {
        if (control_.budget == 0)
          return true;
        const double seconds = expected_seconds(results_.records, place, method);
        // each rank has its own clock, and all must agree
        if (!control_.ranks.any(seconds > control_.budget))
          return true;
        results_.left_out.push_back(
            method.name() + ", " + place.series().name +
            ", h = " + base::to_text(place.level().h, 6) +
            (std::isfinite(seconds) ? ": some " + base::to_text(seconds, 6) + " CPU s" : ""));
        tell({});
        return false;
      }

      /// Of one method at a level, for progress: cells in a unit of Ω, on meshes times those of a
      /// ball, whose entries are all integrated.
      double work_of(const problem::Level &level) const
      {
        const double dimension = scene_.domain.dimension;
        const double n_cells = std::pow(level.h, -dimension);
        return scene_.domain.mesh.is_file() ? n_cells * std::pow(level.horizon / level.h, dimension)
                                            : n_cells;
      }

      std::string words_of_begin() const
      {
        const scene::ReferenceSection &reference = scene_.reference;
        if (!reference.method)
          return "problem";
        return "reference by " + *reference.method +
               (reference.estimate == scene::Estimate::none ? "" : " and its error estimate");
      }

      void show_progress(const Key &key, const std::string &what) const
      {
        if (control_.on_progress)
          control_.on_progress(analysis_.name + ", " + key.series +
                                   ", h = " + base::to_text(key.h, 4) + ": " + what,
                               work_done_ / work_of_all_);
      }

      void fill_record(Record &record, const Common::Fill &fill) const
      {
        constexpr double patience = 30; // with ranks that wait for the failed one in a solve [s]
        try
        {
          ranks_.communicator().together([&] { fill(record); }, patience);
        }
        catch (const NumericalError &error)
        {
          record.failure = error.what();
        }
      }

      void make_part(const Record &begun, const Common::Fill &fill)
      {
        const Records &earlier = control_.earlier.records;
        const auto known = std::find_if(earlier.begin(), earlier.end(),
                                        [&](const Record &one) { return one.key == begun.key; });
        if (known != earlier.end())
        {
          parts_.push_back(*known);
          return;
        }
        if (control_.should_stop && control_.should_stop())
          throw Interrupted();
        show_progress(begun.key, begun.key.label());
        parts_.push_back(begun);
        fill_record(parts_.back(), fill);
        tell({parts_.back()});
      }

      Records analyse(const Place &place, const Method &method)
      {
        const base::CpuTimer timer;
        Records records;
        parts_.clear();
        if (!analysis_.has_parts)
          show_progress(place.record(analysis_.name, method).key, method.name());
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
          is_stopped_ = true;
        }
        double known = 0;
        for (const Record &record : records)
          known += record.cost.seconds();
        if (known == 0 && !records.empty()) // else the analysis has timed its parts
          records.front().cost.solve_seconds = timer.seconds();
        tell(records);
        records.insert(records.begin(), std::make_move_iterator(parts_.begin()),
                       std::make_move_iterator(parts_.end()));
        return records;
      }

      const Analysis &analysis_;
      const scene::Scene &scene_;
      const Methods &methods_;
      const RunControl &control_;
      const base::SeparateCommunicator ranks_{control_.ranks};
      Common common_;
      StudyResults &results_ = common_.results;
      StudyResults head_;                      ///< of what is told: without records and lists
      std::vector<std::ptrdiff_t> n_told_;     ///< of the lists of statements
      Records parts_;                          ///< of the present method and place
      double work_done_ = 0, work_of_all_ = 0; ///< see work_of
      bool is_stopped_ = false;
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
