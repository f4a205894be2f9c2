#pragma once

#include "base/choice.h"
#include "base/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

// Structures to and from JSON by lists of their keys: visit(archive, structure), which names each
// once, for both ways. Enumerations by their words.
namespace plumbline::io
{
  using Json = nlohmann::ordered_json;

  /// Numbers are written as the shortest decimals that read back to the same bits, NaN and infinity
  /// as null, which reads back as NaN.
  class JsonWriter
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
        return base::words<T>.at(static_cast<std::size_t>(value));
      else
      {
        JsonWriter writer;
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
    template <std::size_t n>
    static Json json(std::array<double, n> &values)
    {
      return array(values);
    }
    template <typename T>
    static Json json(std::optional<T> &value)
    {
      return value ? json(*value) : Json();
    }
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
  /// @throws InputError  a key that is missing, or a value that is of another type
  class JsonReader
  {
  public:
    /// @param object, file  outlive it
    JsonReader(const Json &object, std::string place, const std::string &file)
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
    template <typename T>
    void read(const Json &json, std::optional<T> &value, const std::string &place) const
    {
      value.reset();
      if (!json.is_null())
        read(json, value.emplace(), place);
    }
    template <std::size_t n>
    void read(const Json &json, std::array<double, n> &values, const std::string &place) const
    {
      static_assert(n == 2 || n == 3);
      expect(json.is_array() && json.size() == n, place,
             n == 2 ? "an array of two numbers" : "an array of three numbers");
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
        expect(
            json.is_number_unsigned() && json.get<std::uint64_t>() <= std::numeric_limits<T>::max(),
            place, "a whole number in [0, " + std::to_string(std::numeric_limits<T>::max()) + "]");
        value = json.get<T>();
      }
      else if constexpr (std::is_integral_v<T>)
      {
        expect(json.is_number_integer(), place, "a whole number");
        value = json.get<T>();
      }
      else if constexpr (std::is_enum_v<T>)
      {
        const auto &known = base::words<T>;
        const auto found = std::find(known.begin(), known.end(), json);
        std::string list;
        for (const char *name : known)
          list += (list.empty() ? "one of " : ", ") + std::string(name);
        expect(found != known.end(), place, list);
        value = static_cast<T>(found - known.begin());
      }
      else
      {
        const JsonReader reader(json, place, file_);
        visit(reader, value);
      }
    }

    const Json &object_;
    std::string place_;
    const std::string &file_;
  };
} // namespace plumbline::io
