#include "io/results_json.h"

#include "base/error.h"
#include "base/json_text.h"
#include "io/record_keys.h"
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
  void visit(Archive &a, StudyResults &results)
  {
    a("analysis", results.analysis);
    a("scene", results.scene_name);
    a("purpose", results.purpose);
    a("scene_text", results.scene_text);
    a("variable", results.variable);
    a("provenance", results.provenance);
    a("facts", results.facts);
    a("is_complete", results.is_complete);
    a("records", results.records);
    a("trends", results.trends);
    a("powers", results.powers);
    a("limits", results.limits);
    a("verdicts", results.verdicts);
    a("expectations", results.expectations);
    a("left_out", results.left_out);
    a("warnings", results.warnings);
  }
} // namespace plumbline::study

namespace plumbline::io
{
  std::string to_json(const study::StudyResults &results)
  {
    JsonWriter writer;
    study::StudyResults copy = results; // one list of keys serves the reader, too
    visit(writer, copy);
    Json json{{"schema", schema}};
    json.update(writer.take());
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
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
    return results;
  }
} // namespace plumbline::io
