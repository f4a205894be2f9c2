#include "report/page_parts.h"
#include "report/report_parts.h"
#include "report/tables.h"
#include "study/model_facts.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

// What a reader can rely on: the reference's own error, what was left out of the model, what the
// scene expects.
namespace plumbline::report::page
{
  namespace
  {
    /// Tables of at most so many rows are open.
    constexpr std::size_t most_open_rows = 12;

    Data with_fold(const Table &of)
    {
      Data data = table(of);
      if (!data.is_null())
        data["is_open"] = of.rows.size() <= most_open_rows;
      return data;
    }
  } // namespace

  Data reference(const study::StudyResults &results)
  {
    const bool has_reference = !results.references.empty();
    const auto &explained = has_reference ? results.references : results.estimates;
    const Table doubtful = has_reference ? doubtful_differences(results) : Table();
    const bool is_estimated =
        std::any_of(results.references.begin(), results.references.end(),
                    [](const study::ErrorEstimate &e) { return e.estimate > 0; });
    const bool has_doubt = !doubtful.rows.empty();
    return {{"is_nothing", explained.empty()},
            {"is_of_polygon",
             std::any_of(explained.begin(), explained.end(),
                         [](const study::ErrorEstimate &e) { return e.is_of_polygon; })},
            {"is_of_averages", std::any_of(explained.begin(), explained.end(),
                                           [](const study::ErrorEstimate &e)
                                           { return std::isnan(e.field_estimate); })},
            {"of_reference", with_fold(estimate_table(results.references))},
            {"of_others", with_fold(estimate_table(results.estimates))},
            {"is_trusted", has_reference && !has_doubt && is_estimated},
            {"is_unknown", has_reference && !has_doubt && !is_estimated},
            {"doubtful", with_fold(doubtful)}};
  }

  Data model(const study::StudyResults &results)
  {
    std::uint64_t n_checks = 0;
    std::size_t n_runs = 0;
    double worst = 0;
    const auto count = [&](std::size_t n, double difference)
    {
      n_checks += n;
      n_runs += n > 0 ? 1 : 0;
      worst = std::max(worst, difference);
    };
    for (const study::Record &run : results.records)
      count(run.count("geometry checks"), run["geometry difference"]);
    for (const study::ErrorEstimate &reference : results.references)
      count(reference.n_geometry_checks, reference.geometry_difference);
    Table omissions;
    omissions.columns = {"left out", "because", "saves"};
    for (const study::Omission &omission : results.omissions)
      omissions.rows.push_back(
          {text_cell(omission.what), text_cell(omission.why), text_cell(omission.saving)});
    Table constants;
    constants.columns = {"constant", "value"};
    for (const auto &[what, value] : results.facts)
      if (!study::is_of_equation(what)) // which is above
        constants.rows.push_back({text_cell(what), text_cell(value)});
    return {{"constants", table(constants)},
            {"omissions", table(omissions)},
            {"savings", table(saving_table(results))},
            {"n_checks", n_checks == 0 ? Data() : Data(n_checks)},
            {"n_runs", n_runs},
            {"worst", rounded(worst)}};
  }

  Data expectations(const study::StudyResults &results)
  {
    if (results.expectations.empty())
      return {};
    Data met = Data::array(), missed = Data::array();
    for (const study::Expectation &one : results.expectations)
      (one.holds ? met : missed)
          .push_back({{"holds", one.holds},
                      {"subject", one.subject},
                      {"expected", one.expected},
                      {"found", one.found}});
    const auto rows = [](const Data &list) { return list.empty() ? Data() : Data{{"rows", list}}; };
    return {{"n_hold", met.size()},
            {"n", results.expectations.size()},
            {"met", rows(met)},
            {"missed", rows(missed)}};
  }
} // namespace plumbline::report::page
