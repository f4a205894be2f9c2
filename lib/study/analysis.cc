#include "study/analysis.h"

#include "base/cost.h"
#include "base/error.h"
#include "base/number_text.h"
#include "study/expectations.h"
#include "study/statement_lists.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
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

    bool is_of(const ErrorEstimate &one, const Place &place)
    {
      return one.series == place.series().name && one.level == place.number();
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
        take_over(control.earlier);
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
          {
            levels_.push_back({&series, level});
            work_of_all_ += work_of(series.levels[level]) * static_cast<double>(methods_.size());
          }
        if (control_.next_task)
        {
          run_tasks();
          return std::move(results_);
        }
        if (control_.share && !is_shared_by_level())
          share(0, levels_.size());
        for (std::size_t i = 0; i < levels_.size(); ++i)
          run_level(i);
        results_.is_complete = !is_stopped_;
        if (analysis_.complete && !is_stopped_)
          analysis_.complete(scene_, common_);
        const auto index = [&](const std::string &name)
        {
          return std::find_if(methods_.begin(), methods_.end(),
                              [&](const auto &method) { return method->name() == name; });
        };
        std::stable_sort(results_.records.begin(), results_.records.end(),
                         [&](const Record &a, const Record &b)
                         { return index(a.key.method) < index(b.key.method); });
        std::stable_sort(results_.savings.begin(), results_.savings.end(),
                         [&](const Saving &a, const Saving &b)
                         { return index(a.method) < index(b.method); });
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

      Place place_at(std::size_t i)
      {
        const auto &[series, level] = levels_[i];
        return {scene_, *series, level, level + 1 == n_levels(*series), common_};
      }

      /// What an earlier study, or another process, has found besides records of tasks.
      void take_over(StudyResults earlier)
      {
        earlier_ = std::move(earlier);
        if (!earlier_.records.empty())
        {
          results_.savings = earlier_.savings;
          std::vector<std::string> &warnings = results_.warnings = {};
          take(warnings, earlier_.warnings, // several processes find the same
               [&](const std::string &one)
               { return std::find(warnings.begin(), warnings.end(), one) == warnings.end(); });
        }
        note_told();
      }

      /// Has what is not there yet of levels made by other processes, as far as it is affordable;
      /// fine levels, which take longest, first.
      /// @param end  behind the last one
      void share(std::size_t first, std::size_t end)
      {
        std::vector<std::uint64_t> tasks;
        for (std::size_t i = end; i-- > first;)
        {
          const Place place = place_at(i);
          const std::size_t n_before = tasks.size();
          for (std::size_t k = 0; k < methods_.size(); ++k)
            if ((analysis_.has_parts || !is_known(place, *methods_[k])) &&
                (control_.budget == 0 ||
                 expected_seconds(results_.records, place, *methods_[k]) <= control_.budget))
              tasks.push_back(i * n_of_level() + k);
          // one process makes a reference for all methods
          if (scene_.reference.method && tasks.size() == n_before + methods_.size())
          {
            tasks.resize(n_before);
            tasks.push_back(i * n_of_level() + methods_.size());
          }
        }
        if (!tasks.empty())
          take_over(control_.share(head_, tasks));
      }

      /// Numbers of tasks of a level: one for each method, the last for all of them.
      std::size_t n_of_level() const { return methods_.size() + 1; }

      /// Those that another process gives; methods of the same level share its place.
      void run_tasks()
      {
        std::optional<Place> place;
        std::size_t present = 0;
        bool is_begun = false;
        for (std::uint64_t task = 0; control_.next_task(task);)
        {
          const std::size_t level = task / n_of_level(), k = task % n_of_level();
          if (level >= levels_.size())
            continue;
          if (!place || level != present)
          {
            place.emplace(place_at(level));
            present = level;
            is_begun = false;
          }
          const bool is_all = k == methods_.size();
          for (std::size_t i = is_all ? 0 : k; i < (is_all ? k : k + 1); ++i)
            run_method(*place, *methods_[i], is_begun);
        }
      }

      void run_level(std::size_t i)
      {
        if (control_.share && is_shared_by_level() && !is_stopped_)
          share(i, i + 1);
        const Place place = place_at(i);
        bool is_begun = false;
        for (std::size_t k = 0; k < methods_.size(); ++k, work_done_ += work_of(place.level()))
          run_method(place, *methods_[k], is_begun);
        const auto is_new = [&](const ErrorEstimate &one)
        {
          const auto is_same = [&](const ErrorEstimate &other) {
            return other.series == one.series && other.level == one.level &&
                   other.problem == one.problem;
          };
          const auto &all = results_.references; // each process that has a task here makes it
          return is_of(one, place) && std::none_of(all.begin(), all.end(), is_same);
        };
        if (!is_begun)
          take(results_.references, earlier_.references, is_new);
        note_told();
      }

      /// The costs of a level decide what is affordable at the next one.
      bool is_shared_by_level() const { return control_.is_shared_by_level || control_.budget > 0; }

      bool is_to_stop() const
      {
        return is_stopped_ || (control_.should_stop && control_.should_stop());
      }

      /// @param is_begun  whether Analysis::begin was called at this place
      void run_method(const Place &place, const Method &method, bool &is_begun)
      {
        Records own = take_earlier(place, method);
        if ((own.empty() || analysis_.has_parts) && is_to_stop())
        {
          is_stopped_ = true;
          std::move(own.begin(), own.end(), std::back_inserter(results_.records));
          return;
        }
        const bool is_due = own.empty() ? is_affordable(place, method) : analysis_.has_parts;
        if (is_due && own.empty() && control_.share) // another process has not finished it
        {
          is_stopped_ = true;
          return;
        }
        if (is_due && analysis_.begin && !std::exchange(is_begun, true))
        {
          show_progress(place.record(analysis_.name, method).key, words_of_begin());
          analysis_.begin(place);
          const auto is_here = [&](const ErrorEstimate &one) { return is_of(one, place); };
          if (std::any_of(earlier_.references.begin(), earlier_.references.end(), is_here))
            note_told(); // of this level by the earlier study, which had begun it
        }
        if (is_due)
          own = analyse(place, method);
        std::move(own.begin(), own.end(), std::back_inserter(results_.records));
      }

      bool is_known(const Place &place, const Method &method) const
      {
        return std::any_of(earlier_.records.begin(), earlier_.records.end(),
                           [&](const Record &record) { return is_of(record, place, method); });
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
        take(own, earlier_.records,
             [&](const Record &record) { return is_of(record, place, method); });
        if (own.empty())
          return own;
        take(results_.estimates, earlier_.estimates,
             [&](const ErrorEstimate &one)
             { return one.method == method.name() && is_of(one, place); });
        const auto is_drawn_here = [&](const auto &one) {
          return place.is_finest() && one.method == method.name() &&
                 one.series == place.series().name;
        };
        take(results_.maps, earlier_.maps, is_drawn_here);
        take(results_.solution_grids, earlier_.solution_grids, is_drawn_here);
        note_told();
        return own;
      }

      bool is_affordable(const Place &place, const Method &method)
      {
        if (control_.budget == 0 || control_.next_task)
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
        const Records &earlier = earlier_.records;
        const auto known = std::find_if(earlier.begin(), earlier.end(),
                                        [&](const Record &one) { return one.key == begun.key; });
        if (known != earlier.end())
        {
          parts_.push_back(*known);
          return;
        }
        if (is_to_stop() || control_.share)
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
      StudyResults head_;    ///< of what is told: without records and lists
      StudyResults earlier_; ///< as RunControl::earlier, or by other processes
      std::vector<std::pair<const problem::Series *, unsigned int>> levels_; ///< in their order
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
