#include "report/page.h"

#include "report/counted.h"
#include "report/energy_table.h"
#include "report/equation.h"
#include "report/page_parts.h"
#include "report/report_parts.h"
#include "report/tables.h"
#include "scene/choices.h"
#include "study/target_words.h"
#include "study/trend.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

namespace plumbline::report
{
  namespace page
  {
    namespace
    {
      std::string regime_words(const study::StudyResults &results)
      {
        const scene::Regime regime = results.regime;
        if (study::is_against(results.decisive_error, scene::Target::finest))
          return std::string(regime == scene::Regime::m ? "m-convergence: δ is fixed and h → 0"
                             : regime == scene::Regime::delta ? "m = δ/h is fixed and δ → 0"
                                                              : "δ → 0 and m = δ/h → ∞ together") +
                 "; each method is compared with its own finest level, which tells whether it has "
                 "a limit, not which";
        if (regime == scene::Regime::variable)
          return "h and δ are fixed and " + results.variable + " varies: how errors depend on it";
        static const std::array<const char *, 4> texts = {
            "m-convergence: the horizon δ is fixed and h → 0, towards the nonlocal solution",
            "δ-convergence: m = δ/h is fixed and δ → 0, towards the local limit; this decides "
            "asymptotic compatibility (AC)",
            "δm-convergence: δ → 0 and m = δ/h → ∞ together",
            "h is fixed and the horizon δ varies: how errors depend on the horizon"};
        return texts[static_cast<std::size_t>(regime)];
      }

      std::string outcome_class(study::Outcome outcome)
      {
        static const std::array<const char *, 5> names = {"converges", "stalls", "undecided",
                                                          "failed", "stalls"};
        return names[static_cast<std::size_t>(outcome)];
      }

      /// Both of the last two errors.
      bool is_round_off(const study::Trend &trend)
      {
        const std::size_t n = trend.values.size();
        return n > 0 &&
               std::max(trend.values[n - 1], trend.values[n < 2 ? 0 : n - 2]) < trend.round_off;
      }

      /// What is known apart from the field, where it says the same as the verdict.
      bool is_proven(const study::Trend &trend)
      {
        using Answer = study::LimitProof::Answer;
        const Answer answer = trend.proof.answer;
        if (trend.proof.area_defect > 0) // seen from level to level
          return false;
        return (trend.outcome == study::Outcome::converges && answer == Answer::compatible) ||
               (trend.outcome == study::Outcome::stalls && answer == Answer::incompatible);
      }

      Data verdict(const study::Trend *trend)
      {
        if (trend == nullptr)
          return {{"is_absent", true}};
        const double last_rate = study::last_rate(*trend);
        std::ostringstream rate;
        rate.precision(2);
        if (std::isfinite(last_rate))
          rate << std::fixed << last_rate;
        const bool has_defect = !is_proven(*trend) && trend->proof.has_wrong_moments();
        return {{"is_absent", false},
                {"look", outcome_class(trend->outcome)},
                {"reason", trend->reason},
                {"sign", outcome_symbol(trend->outcome)},
                {"verdict", verdict_words(*trend)},
                {"error", trend->values.empty() ? "" : rounded_error(trend->values.back())},
                {"is_round_off", is_round_off(*trend)},
                {"rate", rate.str()},
                {"is_proven", is_proven(*trend)},
                {"defect", has_defect ? rounded(100 * trend->proof.defect) : ""}};
      }

      /// Cases with those of one problem side by side.
      std::vector<Case> by_problem(const std::vector<Case> &all)
      {
        std::vector<Case> columns;
        for (const Case &one : all)
          if (std::none_of(columns.begin(), columns.end(),
                           [&](const Case &c) { return c.problem == one.problem; }))
            std::copy_if(all.begin(), all.end(), std::back_inserter(columns),
                         [&](const Case &other) { return other.problem == one.problem; });
        return columns;
      }

      /// A row for each method, rules first; columns: problems, and below each its series.
      Data verdict_matrix(const study::StudyResults &results)
      {
        const std::vector<Case> columns = by_problem(cases(results));
        if (columns.empty())
          return {};
        Data problems = Data::array(), series = Data::array(), rows = Data::array();
        for (auto one = columns.begin(); one != columns.end();)
        {
          const auto next = std::find_if(
              one, columns.end(), [&](const Case &other) { return other.problem != one->problem; });
          problems.push_back({{"name", one->problem}, {"n_series", next - one}});
          for (; one != next; ++one)
            series.push_back(one->series);
        }
        std::vector<MethodName> names = methods(results);
        const std::vector<MethodName> styles = names;
        std::stable_partition(names.begin(), names.end(),
                              [](const MethodName &m) { return !m.is_reference(); });
        for (const MethodName &method : names)
        {
          Data verdicts = Data::array();
          for (const Case &one : columns)
            verdicts.push_back(verdict(decisive_trend(results, method.name, one)));
          rows.push_back({{"name", method.name},
                          {"marker", marker(style_of(styles, method.name))},
                          {"verdicts", std::move(verdicts)}});
        }
        return {{"problems", problems}, {"series", series}, {"methods", rows}};
      }

      /// The header's numbers.
      void add_facts(const study::StudyResults &results, Data &data)
      {
        std::array<unsigned int, 5> n{};
        for (const study::Trend &trend : results.trends)
          if (trend.error == results.decisive_error)
            ++n[static_cast<std::size_t>(trend.outcome)];
        data["methods_count"] = counted(methods(results).size(), "method");
        data["runs_count"] = counted(results.records.size(), "run");
        data["n_converge"] = n[0];
        data["n_stall"] = n[1];
        data["n_undecided"] = n[2];
        data["n_failed"] = n[3];
        data["n_field_only"] = n[4] == 0 ? Data() : Data(n[4]);
      }

      Data error_tables(const study::StudyResults &results)
      {
        Data tables = Data::array();
        for (const Case &one : cases(results))
        {
          const Table errors = error_table(results, one);
          Data data = table(errors);
          data["caption"] = errors.caption;
          data["file"] = "tables/errors_" + one.slug + ".csv";
          data["is_open"] = tables.empty();
          tables.push_back(std::move(data));
        }
        return tables;
      }

      Data provenance(const study::StudyResults &results)
      {
        Table origin;
        origin.columns = {"what", "value"};
        for (const auto &[key, value] : results.provenance)
          origin.rows.push_back({text_cell(key), text_cell(value)});
        return table(origin);
      }

      Data data_of(const study::StudyResults &results, const std::filesystem::path &dir)
      {
        Data data = begin("report", results.scene_name, results.purpose, {});
        add_facts(results, data);
        data["is_complete"] = results.is_complete;
        data["warnings"] = results.warnings;
        data["regime"] = regime_words(results);
        data["equation"] = equation(results);
        data["variable"] = results.variable;
        data["error"] = error_words(results.decisive_error);
        data["target"] = study::target_words(results);
        data["advice"] = advice(results);
        data["matrix"] = verdict_matrix(results);
        data["fits"] = table(trend_table(results));
        data["other_errors"] = table(other_errors_table(results));
        data["left_out"] = results.left_out;
        data["n_left_out"] = results.left_out.empty() ? Data() : Data(results.left_out.size());
        data["failures"] = table(failure_table(results));
        data["expectations"] = expectations(results);
        data["charts"] = chart_groups(results, dir);
        data["error_tables"] = error_tables(results);
        data["cost"] = table(cost_table(results));
        data["reference"] = reference(results);
        data["model"] = model(results);
        data["diagnostics"] = table(diagnostics_table(results));
        data["tip_forces"] = table(tip_force_table(results));
        data["bounds"] = table(bound_table(results));
        data["energies"] = table(energy_table(results));
        data["provenance"] = provenance(results);
        data["scene_text"] = results.scene_text;
        return data;
      }
    } // namespace
  }   // namespace page

  void write_page(const study::StudyResults &results, const std::filesystem::path &dir)
  {
    write_file(dir / "report.html", fill("report", page::data_of(results, dir)));
  }
} // namespace plumbline::report
