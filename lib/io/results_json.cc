#include "io/results_json.h"

#include "base/error.h"
#include "base/json_text.h"
#include "base/text_file.h"
#include "io/record_keys.h"
#include "io/results_checks.h"
#include "io/study_keys.h"

namespace plumbline::study
{
  template <typename Archive>
  void visit(Archive &a, Power &power)
  {
    a("method", power.method);
    a("series", power.series);
    a("parameter", power.axis);
    a("powers", power.of);
  }

  template <typename Archive>
  void visit(Archive &a, Limit &limit)
  {
    a("method", limit.method);
    a("series", limit.series);
    a("quantity", limit.quantity);
    a("limit", limit.value);
    a("rate", limit.rate);
    a("change", limit.change);
  }

  template <typename Archive>
  void visit(Archive &a, Verdict &verdict)
  {
    a("method", verdict.method);
    a("series", verdict.series);
    a("verdict", verdict.verdict);
    a("rating", verdict.rating);
    a("condition", verdict.condition);
    a("explanation", verdict.explanation);
  }

  template <typename Archive>
  void visit(Archive &a, ErrorEstimate &estimate)
  {
    a("problem", estimate.problem);
    a("series", estimate.series);
    a("method", estimate.method);
    a("level", estimate.level);
    a("h", estimate.h);
    a("horizon", estimate.horizon);
    a("h_change", estimate.h_change);
    a("p_change", estimate.p_change);
    a("outer_change", estimate.outer_change);
    a("estimate", estimate.estimate);
    a("certified_digits", estimate.certified_digits);
    a("n_geometry_checks", estimate.n_geometry_checks);
    a("geometry_difference", estimate.geometry_difference);
    a("coarse_change", estimate.coarse_change);
    a("rate", estimate.rate);
    a("field_h_change", estimate.field_h_change);
    a("field_coarse_change", estimate.field_coarse_change);
    a("field_p_change", estimate.field_p_change);
    a("field_rate", estimate.field_rate);
    a("field_estimate", estimate.field_estimate);
    a("is_of_polygon", estimate.is_of_polygon);
  }

  template <typename Archive>
  void visit(Archive &a, Omission &omission)
  {
    a("what", omission.what);
    a("why", omission.why);
    a("saving", omission.saving);
  }

  template <typename Archive>
  void visit(Archive &a, Saving &saving)
  {
    a("method", saving.method);
    a("h", saving.h);
    a("horizon", saving.horizon);
    a("smallest", saving.smallest);
    a("full", saving.full);
    a("difference", saving.difference);
  }

  template <typename Archive>
  void visit(Archive &a, Choice &choice)
  {
    a("target", choice.target);
    a("method", choice.method);
    a("h", choice.h);
    a("error", choice.error);
    a("seconds", choice.seconds);
    a("tied", choice.tied);
  }

  template <typename Archive>
  void visit(Archive &a, Advice &advice)
  {
    a("problem", advice.problem);
    a("series", advice.series);
    a("choices", advice.choices);
    a("stalling", advice.stalling);
    a("field_only", advice.field_only);
  }

  template <typename Archive>
  void visit(Archive &a, ErrorMap &map)
  {
    a("method", map.method);
    a("problem", map.problem);
    a("series", map.series);
    a("quantity", map.quantity);
    a("axes", map.axes);
    a("h", map.h);
    a("horizon", map.horizon);
    a("lower", map.lower);
    a("upper", map.upper);
    a("n_x", map.n_x);
    a("n_y", map.n_y);
    a("size", map.size);
    a("values", map.values);
    a("n_components", map.n_components);
    a("solution", map.solution);
  }

  template <typename Archive>
  void visit(Archive &a, SolutionGrid &grid)
  {
    a("method", grid.method);
    a("problem", grid.problem);
    a("series", grid.series);
    a("h", grid.h);
    a("horizon", grid.horizon);
    a("lower", grid.lower);
    a("upper", grid.upper);
    a("first", grid.first);
    a("spacing", grid.spacing);
    a("n_x", grid.n[0]);
    a("n_y", grid.n[1]);
    a("n_z", grid.n[2]);
    a("n_components", grid.n_components);
    a("values", grid.values);
  }

  template <typename Archive>
  void visit(Archive &a, StudyResults &results)
  {
    a("analysis", results.analysis);
    a("scene", results.scene_name);
    a("purpose", results.purpose);
    a("regime", results.regime);
    a("variable", results.variable);
    a("decisive_error", results.decisive_error);
    a("is_complete", results.is_complete);
    a("provenance", results.provenance);
    a("facts", results.facts);
    a("trends", results.trends);
    a("powers", results.powers);
    a("limits", results.limits);
    a("verdicts", results.verdicts);
    a("advice", results.advice);
    a("references", results.references);
    a("estimates", results.estimates);
    a("expectations", results.expectations);
    a("omissions", results.omissions);
    a("maps", results.maps);
    a("solution_grids", results.solution_grids);
    a("records", results.records);
    a("savings", results.savings);
    a("left_out", results.left_out);
    a("warnings", results.warnings);
    a("scene_text", results.scene_text);
  }
} // namespace plumbline::study

namespace plumbline::io
{
  std::string to_json(const study::StudyResults &results, int indent)
  {
    JsonWriter writer;
    study::StudyResults copy = results; // one list of keys serves the reader, too
    visit(writer, copy);
    Json json{{"schema", schema}};
    json.update(writer.take());
    return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
  }

  study::StudyResults from_json(const std::string &text, const std::string &file)
  {
    const std::string what = "results file '" + file + "'";
    const Json json = base::parse_json(text, what, "run the scene again");
    unsigned int found = 0;
    const JsonReader reader(json, "", file);
    reader("schema", found);
    if (found != schema)
      throw InputError(what + ": schema = " + std::to_string(found) +
                       ", but this version reads schema " + std::to_string(schema) +
                       "; run the scene again");
    study::StudyResults results;
    visit(reader, results);
    check_results(results, what);
    return results;
  }

  study::StudyResults read_results(const std::filesystem::path &file)
  {
    constexpr std::size_t most_bytes = 1'000'000'000; // maps and records of 1000 methods are less
    const std::string name = file.string();
    return from_json(base::read_text_file(name, "results file '" + name + "'", most_bytes,
                                          "the folder that 'plumbline run' has written"),
                     name);
  }
} // namespace plumbline::io
