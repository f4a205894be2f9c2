#include "report/row_journal.h"

#include "base/error.h"
#include "report/json_archive.h"
#include "report/row_keys.h"

namespace plumbline::report
{
  namespace
  {
    constexpr unsigned int version = 2; ///< of what lines mean

    template <class Row>
    std::string lines_of(std::vector<Row> rows) // one list of keys serves the reader, too
    {
      std::string text;
      for (Row &row : rows)
      {
        JsonWriter writer;
        visit(writer, row);
        text += writer.take().dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
      }
      return text;
    }
  } // namespace

  template <class Row>
  RowJournal<Row>::RowJournal(const std::filesystem::path &file, const std::string &subject)
      : lines_(file), head_(Json{{"version", version}, {"subject", subject}}.dump() + "\n")
  {
    const std::string name = file.string();
    const std::vector<std::string> lines = io::read_lines(file);
    if (lines.empty() || lines.front() + "\n" != head_)
      return;
    try
    {
      for (std::size_t i = 1; i < lines.size(); ++i)
      {
        const Json json = Json::parse(lines[i]);
        const JsonReader reader(json, "", name);
        visit(reader, earlier_.emplace_back());
      }
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

  template <class Row>
  void RowJournal<Row>::append(const std::vector<Row> &rows)
  {
    const std::string first = head_.empty() ? "" : head_ + lines_of(earlier_);
    lines_.append(first + lines_of(rows));
    head_.clear();
  }

  template class RowJournal<study::StripRow>;
} // namespace plumbline::report
