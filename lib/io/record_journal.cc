#include "io/record_journal.h"

#include "base/error.h"
#include "base/json_text.h"
#include "io/results_json.h"
#include "study/statement_lists.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace plumbline::io
{
  namespace fs = std::filesystem;

  namespace
  {
    using Json = nlohmann::ordered_json;

    constexpr unsigned int version = 7; ///< of what lines mean

    void add(study::StudyResults &results, const study::StudyResults &more)
    {
      const auto append = [&](auto list)
      { (results.*list).insert((results.*list).end(), (more.*list).begin(), (more.*list).end()); };
      append(&study::StudyResults::records);
      study::for_each_statement_list(append);
    }

    /// @param lines  the head and those after it, the first of which says whose study it is
    study::StudyResults results_of(const std::vector<std::string> &lines, const std::string &file)
    {
      study::StudyResults results;
      for (std::size_t i = 1; i < lines.size(); ++i)
        if (i == 1)
          results = from_json(lines[i], file);
        else
          add(results, from_json(lines[i], file));
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
      earlier_ = results_of(lines, file.string());
    }
    catch (const InputError &)
    {
      // not ours: it is replaced
    }
  }

  void RecordJournal::append(const study::StudyResults &made)
  {
    constexpr int in_one_line = -1;
    std::string text = head_;
    study::StudyResults line;
    if (!head_.empty())
    {
      line = made;
      line.records.clear();
      study::for_each_statement_list([&](auto list) { (line.*list).clear(); });
    }
    if (!head_.empty() && !earlier_.records.empty()) // in a line of their own
    {
      earlier_.left_out.clear(); // what can be afforded is asked again
      add(line, earlier_);
      text += to_json(line, in_one_line);
      line = {};
    }
    add(line, made);
    lines_.append(text + to_json(line, in_one_line));
    head_.clear();
  }

  void RecordJournal::join()
  {
    lines_.join();
    head_.clear();
  }

  study::StudyResults read_journal(const fs::path &file)
  {
    const std::string name = file.string(), what = "results file '" + name + "'";
    const std::vector<std::string> lines = read_lines(file);
    const Json head =
        base::parse_json(lines.empty() ? "" : lines.front(), what, "run the scene again");
    if (!head.is_object() || !head.contains("version") || head.at("version") != version)
      throw InputError(what + " is of another version; run the scene again");
    return results_of(lines, name);
  }

  fs::path results_file(const fs::path &folder)
  {
    const fs::path journal = folder / "results.jsonl";
    return fs::exists(journal) ? journal : folder / "results.json";
  }

  study::StudyResults results_in(const fs::path &folder)
  {
    const fs::path file = results_file(folder), whole = folder / "results.json";
    if (file == whole)
      return read_results(whole);
    study::StudyResults journal = read_journal(file);
    if (!fs::exists(whole))
      return journal;
    try
    {
      study::StudyResults results = read_results(whole);
      if (results.scene_text == journal.scene_text &&
          results.records.size() == journal.records.size())
        return results;
    }
    catch (const InputError &)
    {
      // of another version
    }
    return journal;
  }
} // namespace plumbline::io
