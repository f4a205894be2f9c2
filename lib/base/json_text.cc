#include "base/json_text.h"

#include "base/error.h"
#include "base/text_file.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>
#include <vector>

namespace plumbline::base
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    constexpr int deepest = 64;

    /// Reads a text and tells how far it came.
    class Place
    {
    public:
      using difference_type = std::ptrdiff_t;
      using value_type = char;
      using pointer = const char *;
      using reference = const char &;
      using iterator_category = std::input_iterator_tag;

      Place(const char *at, const char **farthest) : at_(at), farthest_(farthest) {}
      reference operator*() const { return *at_; }
      Place &operator++()
      {
        *farthest_ = ++at_;
        return *this;
      }
      bool operator==(const Place &other) const { return at_ == other.at_; }
      bool operator!=(const Place &other) const { return at_ != other.at_; }

    private:
      const char *at_;
      const char **farthest_;
    };
  } // namespace

  Json parse_json(const std::string &text, const std::string &what, const std::string &remedy)
  {
    const char *const begin = text.data(), *const end = begin + text.size();
    const char *farthest = begin;
    const auto fail = [&](const std::string &reason)
    {
      const auto line = 1 + std::count(begin, farthest, '\n');
      throw InputError(what + ", line " + std::to_string(line) + ": " + reason + "; " + remedy);
    };
    std::vector<std::set<std::string>> keys; // of the objects that are open
    const auto follow = [&](int depth, Json::parse_event_t event, Json &parsed)
    {
      using Event = Json::parse_event_t;
      if (depth > deepest)
        fail("is nested deeper than " + std::to_string(deepest) + " levels");
      if (event == Event::object_start)
        keys.emplace_back();
      else if (event == Event::object_end)
        keys.pop_back();
      else if (event == Event::key && !keys.back().insert(parsed.get<std::string>()).second)
        fail("the key '" + shown(parsed.get<std::string>()) + "' comes twice in one object");
      return true;
    };
    try
    {
      return Json::parse(Place(begin, &farthest), Place(end, &farthest), follow);
    }
    catch (const Json::out_of_range &)
    {
      fail("a number is beyond the range of double precision");
    }
    catch (const Json::exception &)
    {
      if (farthest == end)
        fail("is not JSON: the text ends too early");
      // the last character that was read is the one that does not fit
      const char *from = farthest - (farthest == begin ? 0 : 1);
      while (from > begin && farthest - from < 20 && from[-1] != '\n')
        --from;
      while (from < farthest - 1 && (*from == ' ' || *from == '\t'))
        ++from;
      fail("is not JSON from '" + shown(std::string(from, farthest)) + "' on");
    }
    return {};
  }
} // namespace plumbline::base
