#include "report/journal.h"

#include "base/text_file.h"
#include "report/json.h"

#include <string>
#include <vector>

namespace plumbline::report
{
  namespace fs = std::filesystem;

  namespace
  {
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
  } // namespace

  void Journal::append(const study::Results &results)
  {
    if (is_begun_)
    {
      study::Results more;
      more.runs = beyond(written_.runs, results.runs);
      more.left_out = beyond(written_.left_out, results.left_out);
      more.references = beyond(written_.references, results.references);
      more.estimates = beyond(written_.estimates, results.estimates);
      more.savings = beyond(written_.savings, results.savings);
      more.maps = beyond(written_.maps, results.maps);
      lines_.append(to_json(more) + "\n");
    }
    else
      lines_.append(to_json(results) + "\n");
    is_begun_ = true;
    written_ = {results.runs.size(),      results.left_out.size(), results.references.size(),
                results.estimates.size(), results.savings.size(),  results.maps.size()};
  }

  fs::path results_file(const fs::path &folder)
  {
    const fs::path journal = folder / "results.jsonl";
    return fs::exists(journal) ? journal : folder / "results.json";
  }

  study::Results read_results(const fs::path &folder)
  {
    const fs::path file = results_file(folder);
    if (base::has_ending(file.string(), ".json"))
      return read_json(file);
    const std::vector<std::string> lines = io::read_lines(file);
    study::Results results = from_json(lines.empty() ? "" : lines.front(), file.string());
    for (std::size_t i = 1; i < lines.size(); ++i)
    {
      const study::Results more = from_json(lines[i], file.string());
      add(results.runs, more.runs);
      add(results.left_out, more.left_out);
      add(results.references, more.references);
      add(results.estimates, more.estimates);
      add(results.savings, more.savings);
      add(results.maps, more.maps);
    }
    return results;
  }
} // namespace plumbline::report
