#include "report/strip_journal.h"

#include <nlohmann/json.hpp>

#include <utility>

namespace plumbline::report
{
  namespace
  {
    using study::StripRow;
    using Json = nlohmann::ordered_json;

    constexpr unsigned int version = 1; ///< of what lines mean

    Json to_json(const StripRow &row)
    {
      const auto &strip = row.strip;
      return {{"method", row.method},
              {"side", base::word(row.side)},
              {"series", row.series},
              {"h", row.h},
              {"horizon", row.horizon},
              {"cells", {strip.n_height, strip.n_length, strip.n_crack}},
              {"K_tip", strip.K_tip ? Json(*strip.K_tip) : Json()},
              {"energy", row.state.energy},
              {"intact", row.state.intact},
              {"at_end", row.state.at_end},
              {"opening", row.state.opening},
              {"n_unknowns", row.state.n_unknowns},
              {"release", row.release},
              {"growth", row.growth ? Json{row.growth->peak, row.growth->mean, row.growth->released,
                                           row.growth->bonds}
                                    : Json()},
              {"seconds", row.seconds},
              {"failure", row.failure}};
    }

    StripRow row_from(const Json &json)
    {
      StripRow row;
      row.method = json.at("method");
      row.side = base::from_word<method::Side>(json.at("side").get<std::string>()).value();
      row.series = json.at("series");
      row.h = json.at("h");
      row.horizon = json.at("horizon");
      const Json &cells = json.at("cells");
      row.strip = {cells.at(0), cells.at(1), cells.at(2), row.h, {}};
      if (!json.at("K_tip").is_null())
        row.strip.K_tip = json.at("K_tip").get<double>();
      row.state.energy = json.at("energy");
      row.state.intact = json.at("intact");
      row.state.at_end = json.at("at_end");
      row.state.opening = json.at("opening").get<std::vector<double>>();
      row.state.n_unknowns = json.at("n_unknowns");
      row.release = json.at("release");
      if (const Json &growth = json.at("growth"); !growth.is_null())
        row.growth = {growth.at(0), growth.at(1), growth.at(2), growth.at(3)};
      row.seconds = json.at("seconds");
      row.failure = json.at("failure");
      return row;
    }
  } // namespace

  StripJournal::StripJournal(const std::filesystem::path &folder, const std::string &scene_text)
      : lines_(folder / "strip.jsonl"),
        head_(Json{{"version", version}, {"scene_text", scene_text}}.dump() + "\n")
  {
    const std::vector<std::string> lines = read_lines(lines_.file());
    if (lines.empty() || lines.front() + "\n" != head_)
      return;
    try
    {
      for (std::size_t i = 1; i < lines.size(); ++i)
        earlier_.push_back(row_from(Json::parse(lines[i])));
    }
    catch (const std::exception &)
    {
      earlier_.clear(); // not ours: it is replaced
    }
  }

  void StripJournal::append(const StripRow &row)
  {
    std::string text = std::exchange(head_, "");
    if (!text.empty())
      for (const StripRow &one : earlier_)
        text += to_json(one).dump() + "\n";
    lines_.append(text + to_json(row).dump() + "\n");
  }
} // namespace plumbline::report
