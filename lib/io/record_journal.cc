#include "io/record_journal.h"

#include "base/error.h"
#include "io/record_json.h"

#include <nlohmann/json.hpp>

namespace plumbline::io
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    constexpr unsigned int version = 3; ///< of what lines mean

    std::string lines_of(const analysis::Records &records)
    {
      std::string text;
      for (const analysis::Record &record : records)
        text += to_json(record).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
      return text;
    }
  } // namespace

  RecordJournal::RecordJournal(const std::filesystem::path &file, const std::string &subject)
      : lines_(file), head_(Json{{"version", version}, {"subject", subject}}.dump() + "\n")
  {
    const std::string name = file.string();
    const std::vector<std::string> lines = read_lines(file);
    if (lines.empty() || lines.front() + "\n" != head_)
      return;
    try
    {
      for (std::size_t i = 1; i < lines.size(); ++i)
        earlier_.push_back(record_from_json(Json::parse(lines[i]), "", name));
    }
    catch (const nlohmann::json::exception &)
    {
      earlier_.clear(); // not ours: it is replaced
    }
    catch (const InputError &)
    {
      earlier_.clear();
    }
  }

  void RecordJournal::append(const analysis::Records &records)
  {
    const std::string first = head_.empty() ? "" : head_ + lines_of(earlier_);
    lines_.append(first + lines_of(records));
    head_.clear();
  }
} // namespace plumbline::io
