#include "report/json.h"

#include "base/error.h"
#include "base/json_text.h"
#include "base/text_file.h"
#include "report/formats.h"
#include "report/json_checks.h"
#include "report/json_keys.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

namespace plumbline::report
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    /// Maps and runs of a thousand methods are less.
    constexpr std::size_t most_bytes = 1'000'000'000;

    class Writer
    {
    public:
      template <typename T>
      void operator()(const char *key, T &value)
      {
        object_[key] = json(value);
      }
      Json take() { return std::move(object_); }

    private:
      template <typename T>
      static Json json(T &value)
      {
        if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>)
          return value; // the library writes NaN and infinity as null
        else if constexpr (std::is_enum_v<T>)
          return names(value).at(static_cast<std::size_t>(value));
        else
        {
          Writer writer;
          visit(writer, value);
          return writer.take();
        }
      }
      template <typename Sequence>
      static Json array(Sequence &values)
      {
        Json array = Json::array();
        for (auto &value : values)
          array.push_back(json(value));
        return array;
      }
      template <typename T>
      static Json json(std::vector<T> &values)
      {
        return array(values);
      }
      static Json json(std::array<double, 2> &values) { return array(values); }
      template <typename T>
      static Json json(std::map<std::string, T> &values)
      {
        Json object = Json::object();
        for (auto &[key, value] : values)
          object[key] = json(value);
        return object;
      }

      Json object_ = Json::object();
    };

    /// Says where in the file it is, so that a message can name the place.
    class Reader
    {
    public:
      Reader(const Json &object, std::string place, const std::string &file)
          : object_(object), place_(std::move(place)), file_(file)
      {
        expect(object.is_object(), place_.empty() ? "the whole" : place_, "an object");
      }

      template <typename T>
      void operator()(const char *key, T &value) const
      {
        const std::string place = place_.empty() ? key : place_ + "." + key;
        const auto found = object_.find(key);
        if (found == object_.end())
          throw InputError("results file '" + file_ + "': " + place +
                           " is missing; run the scene again, or rebuild the file by schema.md");
        read(*found, value, place);
      }

    private:
      void expect(bool holds, const std::string &place, const std::string &type) const
      {
        if (!holds)
          throw InputError("results file '" + file_ + "': " + place + " is not " + type +
                           "; run the scene again, or mend the file by schema.md");
      }

      void read(const Json &json, bool &value, const std::string &place) const
      {
        expect(json.is_boolean(), place, "true or false");
        value = json.get<bool>();
      }
      void read(const Json &json, double &value, const std::string &place) const
      {
        expect(json.is_number() || json.is_null(), place, "a number or null");
        value = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
      }
      void read(const Json &json, std::string &value, const std::string &place) const
      {
        expect(json.is_string(), place, "a text");
        value = json.get<std::string>();
      }
      template <typename T>
      void read(const Json &json, std::vector<T> &values, const std::string &place) const
      {
        expect(json.is_array(), place, "an array");
        values.resize(json.size());
        for (std::size_t i = 0; i < values.size(); ++i)
          read(json[i], values[i], place + "[" + std::to_string(i) + "]");
      }
      void read(const Json &json, std::array<double, 2> &values, const std::string &place) const
      {
        expect(json.is_array() && json.size() == values.size(), place, "an array of two numbers");
        for (std::size_t i = 0; i < values.size(); ++i)
          read(json[i], values[i], place + "[" + std::to_string(i) + "]");
      }
      template <typename T>
      void read(const Json &json, std::map<std::string, T> &values, const std::string &place) const
      {
        expect(json.is_object(), place, "an object");
        for (const auto &[key, value] : json.items())
          read(value, values[key], place + "[\"" + key + "\"]");
      }
      template <typename T>
      void read(const Json &json, T &value, const std::string &place) const
      {
        if constexpr (std::is_unsigned_v<T>)
        {
          expect(json.is_number_unsigned() &&
                     json.get<std::uint64_t>() <= std::numeric_limits<T>::max(),
                 place,
                 "a whole number in [0, " + std::to_string(std::numeric_limits<T>::max()) + "]");
          value = json.get<T>();
        }
        else if constexpr (std::is_enum_v<T>)
        {
          const auto known = names(value);
          const auto found = std::find(known.begin(), known.end(), json);
          std::string list;
          for (const char *name : known)
            list += (list.empty() ? "one of " : ", ") + std::string(name);
          expect(found != known.end(), place, list);
          value = static_cast<T>(found - known.begin());
        }
        else
        {
          const Reader reader(json, place, file_);
          visit(reader, value);
        }
      }

      const Json &object_;
      std::string place_;
      const std::string &file_;
    };
  } // namespace

  std::string to_json(const study::Results &results, int indent)
  {
    Json json = {{"schema", schema}};
    Writer writer;
    study::Results copy =
        results; // one list of keys serves the reader, too, which changes its values
    visit(writer, copy);
    json.update(writer.take());
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
  }

  study::Results from_json(const std::string &text, const std::string &file)
  {
    const std::string what = "results file '" + file + "'";
    const Json json = base::parse_json(text, what, "run the scene again");
    unsigned int found = 0;
    const Reader reader(json, "", file);
    reader("schema", found);
    if (found != schema)
      throw InputError(what + ": schema = " + std::to_string(found) +
                       ", but this version reads schema " + std::to_string(schema) +
                       "; run the scene again, or use the version named under provenance");
    study::Results results;
    visit(reader, results);
    check_results(results, what);
    return results;
  }

  void write_json(const study::Results &results, const std::filesystem::path &file)
  {
    write_file(file, to_json(results, 1) + "\n");
  }

  study::Results read_json(const std::filesystem::path &file)
  {
    const std::string name = file.string();
    return from_json(base::read_text_file(name, "results file '" + name + "'", most_bytes,
                                          "the folder that 'plumbline run' has written"),
                     name);
  }
} // namespace plumbline::report
