#include "io/record_json.h"

#include "io/record_keys.h"

namespace plumbline::io
{
  Json to_json(const analysis::Record &record)
  {
    JsonWriter writer;
    analysis::Record copy = record; // one list of keys serves the reader, too
    visit(writer, copy);
    return writer.take();
  }

  analysis::Record record_from_json(const Json &json, const std::string &place,
                                    const std::string &file)
  {
    analysis::Record record;
    const JsonReader reader(json, place, file);
    visit(reader, record);
    return record;
  }
} // namespace plumbline::io
