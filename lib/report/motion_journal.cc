#include "report/motion_journal.h"

#include "base/error.h"
#include "report/formats.h"
#include "report/motion_json.h"

#include <fstream>
#include <string>

namespace plumbline::report
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr unsigned int version = 1; ///< of what lines mean

    /// What a run must share with another that goes on from it.
    Json head(const study::DynamicResults &results)
    {
      return {{"version", version},
              {"levels", results.n_levels},
              {"scene", results.scene_name},
              {"scene_text", results.scene_text}};
    }
  } // namespace

  void MotionJournal::append(const study::DynamicResults &results)
  {
    std::string text;
    for (; n_references_ < results.references.size(); ++n_references_)
      text += torus_json(results.references[n_references_]).dump() + "\n";
    for (; n_runs_ < results.runs.size(); ++n_runs_)
      text += motion_json(results.runs[n_runs_]).dump() + "\n";
    if (!is_begun_)
      write_file(file_, head(results).dump() + "\n" + text); // at once
    else
    {
      std::ofstream out(file_, std::ios::app);
      out << text;
      if (!out.flush())
        throw InputError("'" + file_.string() +
                         "' cannot be written; free some space, or give another folder with -o");
    }
    is_begun_ = true;
  }

  void MotionJournal::remove() const
  {
    std::error_code not_there;
    fs::remove(file_, not_there);
  }

  study::DynamicResults read_motions(const fs::path &folder, const study::DynamicResults &begun)
  {
    study::DynamicResults results = begun;
    std::ifstream in(folder / "dynamics.jsonl");
    std::string line;
    try
    {
      if (!std::getline(in, line) || Json::parse(line) != head(begun))
        return begun;
      while (std::getline(in, line) && !in.eof()) // what ends without a line break was cut off
      {
        const Json json = Json::parse(line);
        if (json.contains("method"))
          results.runs.push_back(motion_from(json));
        else
          results.references.push_back(torus_from(json));
      }
    }
    catch (const nlohmann::json::exception &)
    {
      return begun; // not ours: it is replaced
    }
    return results;
  }
} // namespace plumbline::report
