// Whether two sets of results say the same: every error, rate and verdict, as after a change that
// is to change no number. Reads results.json of any schema that has these keys. Run:
// build/release/benchmarks/compare OLD NEW [TOLERANCE]
//   OLD, NEW   folders; every results.json below OLD is held against the one at the same place in
//   NEW TOLERANCE  relative (default 1e-12); differences of what is round-off by the run's own
//   account
//              do not count
// Exit code 1: something differs or is missing, 2: nothing to compare.

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace
{
  /// Of a run up to schema 6, or of a record since.
  std::map<std::string, Json> errors_of(const Json &entry)
  {
    std::map<std::string, Json> errors;
    if (entry.contains("errors"))
      for (const auto &[name, value] : entry.at("errors").items())
        errors[name] = value;
    if (entry.contains("scalars"))
      for (const auto &[name, scalar] : entry.at("scalars").items())
        if (name.find(" | ") != std::string::npos)
          errors[name] = scalar.at("value");
    return errors;
  }

  double round_off_of(const Json &entry)
  {
    if (!entry.contains("scalars"))
      return entry.value("round_off", 0.);
    const Json &scalars = entry.at("scalars");
    return scalars.contains("round-off") ? scalars.at("round-off").at("value").get<double>() : 0;
  }

  const Json &records_of(const Json &results)
  {
    return results.at(results.contains("records") ? "records" : "runs");
  }

  std::string text(const Json &entry, const char *key)
  {
    return entry.contains(key) ? entry.at(key).dump() : "";
  }

  /// Entries by what tells them apart.
  std::map<std::string, Json> by_name(const Json &list)
  {
    std::map<std::string, Json> result;
    for (const Json &entry : list)
    {
      const Json &key = entry.contains("key") ? entry.at("key") : entry;
      result[text(key, "method") + " " + text(key, "problem") + " " + text(key, "series") + " " +
             text(key, "level") + " " + text(entry, "error")] = entry;
    }
    return result;
  }

  class Comparison
  {
  public:
    explicit Comparison(double tolerance) : tolerance_(tolerance) {}

    void compare(const Json &old, const Json &now, const std::string &scene)
    {
      const std::string before = text(old, "decisive_error"), after = text(now, "decisive_error");
      if (before == after)
        std::printf("%s: verdicts rest on %s\n", scene.c_str(), before.c_str());
      else
        say(scene, "verdicts rested on " + before + " and rest on " + after + " now");
      compare_lists(records_of(old), records_of(now), scene);
      compare_lists(old.at("trends"), now.at("trends"), scene);
    }

    bool conclude() const
    {
      std::printf("%zu numbers and verdicts, %zu differ by more than %g; largest difference %.3g\n",
                  n_, n_different_, tolerance_, largest_);
      return n_different_ == 0;
    }
    std::size_t n() const { return n_; }

    void say(const std::string &place, const std::string &what)
    {
      ++n_different_;
      std::printf("%s: %s\n", place.c_str(), what.c_str());
    }

  private:
    void compare_lists(const Json &old, const Json &now, const std::string &scene)
    {
      const auto after = by_name(now);
      for (const auto &[name, before] : by_name(old))
      {
        const std::string place = scene + ": " + name;
        const auto found = after.find(name);
        if (found == after.end())
          say(place, "is missing");
        else
          compare_entry(before, found->second, place);
      }
    }

    void compare_entry(const Json &before, const Json &after, const std::string &place)
    {
      const double noise = round_off_of(before);
      auto errors = errors_of(after);
      for (const auto &[norm, value] : errors_of(before))
        compare_numbers(value, errors[norm], noise, place + " " + norm);
      if (before.contains("rates"))
      {
        const Json &rates = before.at("rates"), &values = before.at("values");
        for (std::size_t i = 0; i < rates.size(); ++i)
          if (values.at(i + 1).is_number() && values.at(i + 1).get<double>() > 1e3 * noise)
            compare_numbers(rates.at(i),
                            i < after.at("rates").size() ? after.at("rates").at(i) : Json(), 0,
                            place + " rate " + std::to_string(i + 1));
        ++n_;
        if (before.at("verdict") != after.at("verdict"))
          say(place, "verdict " + text(before, "verdict") + " is now " + text(after, "verdict"));
      }
    }

    void compare_numbers(const Json &before, const Json &after, double noise,
                         const std::string &place)
    {
      ++n_;
      if (before.is_null() && after.is_null())
        return;
      if (!before.is_number() || !after.is_number())
        return say(place, before.dump() + " is now " + after.dump());
      const double a = before.get<double>(), b = after.get<double>();
      const double difference = std::abs(a - b) / std::max(std::abs(a), 1e-300);
      if (std::abs(a - b) <= noise)
        return;
      largest_ = std::max(largest_, difference);
      if (!(difference <= tolerance_))
        say(place, before.dump() + " is now " + after.dump());
    }

    double tolerance_, largest_ = 0;
    std::size_t n_ = 0, n_different_ = 0;
  };
} // namespace

int main(int argc, char **argv)
{
  if (argc < 3)
  {
    std::fprintf(stderr, "usage: compare OLD NEW [TOLERANCE]\n");
    return 2;
  }
  const fs::path old = argv[1], now = argv[2];
  Comparison comparison(argc > 3 ? std::atof(argv[3]) : 1e-12);
  for (const auto &entry : fs::recursive_directory_iterator(old))
    if (entry.path().filename() == "results.json")
    {
      const fs::path place = fs::relative(entry.path(), old);
      std::ifstream before(entry.path()), after(now / place);
      if (after)
        comparison.compare(Json::parse(before), Json::parse(after), place.parent_path().string());
      else
        comparison.say(place.parent_path().string(), "has no results.json there");
    }
  if (comparison.n() == 0)
    return 2;
  return comparison.conclude() ? 0 : 1;
}
