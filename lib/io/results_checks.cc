#include "io/results_checks.h"

#include "base/error.h"

#include <cmath>

namespace plumbline::io
{
  namespace
  {
    /// Ours have 32 blocks along a side.
    constexpr unsigned int most_blocks = 1000;

    /// The map of a curve has no height.
    bool is_curve(const study::ErrorMap &map, unsigned int axis)
    {
      return axis == 1 && map.n_y == 1 && map.lower[1] == map.upper[1];
    }

    class Checks
    {
    public:
      explicit Checks(std::string what) : what_(std::move(what)) {}

      void expect(bool holds, const std::string &place, const std::string &reason) const
      {
        if (!holds)
          throw InputError(what_ + ": " + place + " " + reason +
                           "; run the scene again, or mend the file by schema.md");
      }

      void length(double value, const std::string &place) const
      {
        expect(value > 0 && std::isfinite(value), place, "is not a positive length");
      }

      /// Columns of a curve are as long as each other.
      void record(const study::Record &record, const std::string &place) const
      {
        level(record.key, place + ".key");
        for (const auto &[name, curve] : record.curves)
          for (const analysis::Column &column : curve)
            expect(column.values.size() == curve.front().values.size(),
                   place + ".curves[\"" + name + "\"]", "has columns of different length");
      }

      template <typename Entry>
      void level(const Entry &entry, const std::string &place) const
      {
        length(entry.h, place + ".h");
        length(entry.horizon, place + ".horizon");
      }

      void trend(const study::Trend &trend, const std::string &place) const
      {
        for (std::size_t i = 0; i < trend.x.size(); ++i)
        {
          const std::string at = place + ".x[" + std::to_string(i) + "]";
          if (trend.axis == study::Axis::variable)
            expect(std::isfinite(trend.x[i]), at, "is not a number");
          else
            length(trend.x[i], at);
        }
        const auto expect_size = [&](std::size_t found, std::size_t wanted, const std::string &key)
        {
          expect(found == wanted, place + "." + key,
                 "has " + std::to_string(found) + " numbers, not " + std::to_string(wanted) +
                     " as the " + std::to_string(trend.x.size()) + " of x ask for");
        };
        expect_size(trend.values.size(), trend.x.size(), "values");
        if (!trend.rates.empty()) // as where a level failed
          expect_size(trend.rates.size() + 1, trend.x.size(), "rates and one more");
      }

      void map(const study::ErrorMap &map, const std::string &place) const
      {
        level(map, place);
        expect(map.n_x > 0 && map.n_y > 0 && map.n_x <= most_blocks && map.n_y <= most_blocks,
               place, "has n_x or n_y outside of [1, " + std::to_string(most_blocks) + "]");
        const std::size_t n = std::size_t{map.n_x} * map.n_y;
        expect(map.values.size() == n, place + ".values",
               "has " + std::to_string(map.values.size()) +
                   " numbers, not n_x * n_y = " + std::to_string(n));
        expect(map.solution.empty() || map.solution.size() == n, place + ".solution",
               "has " + std::to_string(map.solution.size()) +
                   " numbers, neither none nor n_x * n_y = " + std::to_string(n));
        for (unsigned int d = 0; d < 2; ++d)
          expect(std::isfinite(map.upper[d] - map.lower[d]) &&
                     (map.lower[d] < map.upper[d] || is_curve(map, d)),
                 place, "has an upper corner that is not above and right of the lower one");
      }

      void grid(const study::SolutionGrid &grid, const std::string &place) const
      {
        level(grid, place);
        length(grid.spacing, place + ".spacing");
        std::size_t n = 1;
        for (const unsigned int of_axis : grid.n)
        {
          expect(of_axis > 0 && of_axis <= most_blocks, place,
                 "has n_x, n_y or n_z outside [1, " + std::to_string(most_blocks) + "]");
          n *= of_axis;
        }
        expect(grid.values.size() == n, place + ".values",
               "has " + std::to_string(grid.values.size()) +
                   " numbers, not n_x * n_y * n_z = " + std::to_string(n));
      }

      /// f(entry, place) for each.
      template <typename Entry, typename F>
      static void each(const std::vector<Entry> &entries, const std::string &name, const F &f)
      {
        for (std::size_t i = 0; i < entries.size(); ++i)
          f(entries[i], name + "[" + std::to_string(i) + "]");
      }

    private:
      std::string what_;
    };
  } // namespace

  void check_results(const study::StudyResults &results, const std::string &what)
  {
    const Checks checks(what);
    const auto level = [&](const auto &entry, const std::string &place)
    { checks.level(entry, place); };
    Checks::each(results.records, "records",
                 [&](const study::Record &record, const std::string &place)
                 { checks.record(record, place); });
    Checks::each(results.references, "references", level);
    Checks::each(results.estimates, "estimates", level);
    Checks::each(results.savings, "savings", level);
    Checks::each(results.trends, "trends",
                 [&](const study::Trend &trend, const std::string &place)
                 { checks.trend(trend, place); });
    Checks::each(results.maps, "maps",
                 [&](const study::ErrorMap &map, const std::string &place)
                 { checks.map(map, place); });
    Checks::each(results.solution_grids, "solution_grids",
                 [&](const study::SolutionGrid &grid, const std::string &place)
                 { checks.grid(grid, place); });
    Checks::each(results.advice, "advice",
                 [&](const study::Advice &advice, const std::string &place)
                 {
                   Checks::each(advice.choices, place + ".choices",
                                [&](const study::Choice &choice, const std::string &choice_place)
                                {
                                  checks.length(choice.h, choice_place + ".h");
                                  checks.expect(choice.target > 0, choice_place + ".target",
                                                "is not a positive number");
                                });
                 });
  }
} // namespace plumbline::io
