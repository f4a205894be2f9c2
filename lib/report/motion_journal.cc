#include "report/motion_journal.h"

#include "report/motion_json.h"

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
    lines_.append(is_begun_ ? text : head(results).dump() + "\n" + text);
    is_begun_ = true;
  }

  study::DynamicResults read_motions(const fs::path &folder, const study::DynamicResults &begun)
  {
    study::DynamicResults results = begun;
    const std::vector<std::string> lines = io::read_lines(folder / "dynamics.jsonl");
    try
    {
      if (lines.empty() || Json::parse(lines.front()) != head(begun))
        return begun;
      for (std::size_t i = 1; i < lines.size(); ++i)
      {
        const Json json = Json::parse(lines[i]);
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
