#include "io/record_journal.h"

#include "base/error.h"
#include "base/json_text.h"
#include "io/record_json.h"
#include "io/results_checks.h"
#include "io/results_json.h"

#include <nlohmann/json.hpp>

#include <tuple>
#include <utility>
#include <vector>

namespace plumbline::io
{
  namespace fs = std::filesystem;

  namespace
  {
    using Json = nlohmann::ordered_json;

    constexpr unsigned int version = 4; ///< of what lines mean

    std::string line_of(const Json &json)
    {
      return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    }

    /// All on one line, so that a kill leaves all of them or none.
    std::string group_of(const analysis::Records &records)
    {
      Json group = Json::array();
      for (const analysis::Record &record : records)
        group.push_back(to_json(record));
      return records.empty() ? "" : line_of(group);
    }

    /// What a list has beyond its first n.
    template <class T>
    std::vector<T> beyond(std::size_t n, const std::vector<T> &list)
    {
      return {list.begin() + static_cast<std::ptrdiff_t>(n), list.end()};
    }

    template <class T>
    void add(std::vector<T> &list, const std::vector<T> &more)
    {
      list.insert(list.end(), more.begin(), more.end());
    }

    void add_statements(study::StudyResults &results, const study::StudyResults &more)
    {
      add(results.left_out, more.left_out);
      add(results.references, more.references);
      add(results.estimates, more.estimates);
      add(results.savings, more.savings);
      add(results.maps, more.maps);
    }

    /// @param lines  the head and those after it
    study::StudyResults results_of(const std::vector<std::string> &lines, const std::string &file)
    {
      const std::string what = "results file '" + file + "'", remedy = "run the scene again";
      study::StudyResults results;
      analysis::Records records;
      bool has_scene = false; // the first statements have it
      for (std::size_t i = 1; i < lines.size(); ++i)
      {
        const Json json = base::parse_json(lines[i], what, remedy);
        if (json.is_array())
          for (const Json &one : json)
            records.push_back(record_from_json(one, "", file));
        else if (json.is_object() && json.contains("key"))
          records.push_back(record_from_json(json, "", file));
        else if (std::exchange(has_scene, true))
          add_statements(results, from_json(lines[i], file));
        else
          results = from_json(lines[i], file);
      }
      results.records = std::move(records);
      return results;
    }
  } // namespace

  RecordJournal::RecordJournal(const fs::path &file, const std::string &subject)
      : lines_(file), head_(Json{{"version", version}, {"subject", subject}}.dump() + "\n")
  {
    const std::vector<std::string> lines = read_lines(file);
    if (lines.empty() || lines.front() + "\n" != head_)
      return;
    try
    {
      earlier_ = results_of(lines, file.string()).records;
    }
    catch (const InputError &)
    {
      // not ours: it is replaced
    }
  }

  void RecordJournal::append(const analysis::Records &records)
  {
    const std::string first = head_.empty() ? "" : head_ + group_of(earlier_);
    lines_.append(first + group_of(records));
    head_.clear();
  }

  void RecordJournal::append(const study::StudyResults &results)
  {
    study::StudyResults more;
    if (head_.empty())
    {
      more.left_out = beyond(written_.left_out, results.left_out);
      more.references = beyond(written_.references, results.references);
      more.estimates = beyond(written_.estimates, results.estimates);
      more.savings = beyond(written_.savings, results.savings);
      more.maps = beyond(written_.maps, results.maps);
    }
    else
    {
      more = results;
      more.records.clear();
    }
    const Sizes now = sizes_of(results);
    const auto records = beyond(written_.records, results.records);
    Sizes with_records = written_;
    with_records.records = now.records;
    // statements first: a record is known with all that came with it, or not at all
    const bool is_more = !head_.empty() || !(now == with_records);
    lines_.append(head_ + (is_more ? to_json(more, -1) : "") + group_of(records));
    head_.clear();
    written_ = now;
  }

  RecordJournal::Sizes RecordJournal::sizes_of(const study::StudyResults &results)
  {
    return {results.records.size(),   results.left_out.size(), results.references.size(),
            results.estimates.size(), results.savings.size(),  results.maps.size()};
  }

  bool RecordJournal::Sizes::operator==(const Sizes &other) const
  {
    return std::tie(records, left_out, references, estimates, savings, maps) ==
           std::tie(other.records, other.left_out, other.references, other.estimates, other.savings,
                    other.maps);
  }

  study::StudyResults read_journal(const fs::path &file)
  {
    const std::string name = file.string(), what = "results file '" + name + "'";
    const std::vector<std::string> lines = read_lines(file);
    const Json head =
        base::parse_json(lines.empty() ? "" : lines.front(), what, "run the scene again");
    if (!head.is_object() || !head.contains("version") || head.at("version") != version)
      throw InputError(what + " is of another version; run the scene again");
    study::StudyResults results = results_of(lines, name);
    check_results(results, what);
    return results;
  }

  fs::path results_file(const fs::path &folder)
  {
    const fs::path journal = folder / "results.jsonl";
    return fs::exists(journal) ? journal : folder / "results.json";
  }

  study::StudyResults results_in(const fs::path &folder)
  {
    const fs::path file = results_file(folder);
    return file.extension() == ".jsonl" ? read_journal(file) : read_results(file);
  }
} // namespace plumbline::io
