#include "report/json.h"

#include "base/error.h"
#include "base/json_text.h"
#include "base/text_file.h"
#include "io/json_archive.h"
#include "report/formats.h"
#include "report/json_checks.h"
#include "report/json_keys.h"

#include <utility>

namespace plumbline::report
{
  using io::Json;
  using io::JsonReader;
  using io::JsonWriter;

  namespace
  {
    /// Maps and runs of a thousand methods are less.
    constexpr std::size_t most_bytes = 1'000'000'000;
  } // namespace

  std::string to_json(const study::Results &results, int indent)
  {
    Json json = {{"schema", schema}};
    JsonWriter writer;
    study::Results copy =
        results; // one list of keys serves the reader, too, which changes its values
    visit(writer, copy);
    json.update(writer.take());
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
  }

  study::Results from_json(const std::string &text, const std::string &file)
  {
    const std::string what = "results file '" + file + "'";
    const Json json = base::parse_json(text, what, "run the scene again");
    unsigned int found = 0;
    const JsonReader reader(json, "", file);
    reader("schema", found);
    if (found != schema)
      throw InputError(what + ": schema = " + std::to_string(found) +
                       ", but this version reads schema " + std::to_string(schema) +
                       "; run the scene again, or use the version named under provenance");
    study::Results results;
    visit(reader, results);
    check_results(results, what);
    return results;
  }

  void write_json(const study::Results &results, const std::filesystem::path &file)
  {
    write_file(file, to_json(results, 1) + "\n");
  }

  study::Results read_json(const std::filesystem::path &file)
  {
    const std::string name = file.string();
    return from_json(base::read_text_file(name, "results file '" + name + "'", most_bytes,
                                          "the folder that 'plumbline run' has written"),
                     name);
  }
} // namespace plumbline::report
