#include "report/json.h"

#include "base/error.h"
#include "base/json_text.h"
#include "base/text_file.h"
#include "report/formats.h"
#include "report/json_checks.h"

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

    using study::Outcome;
    using Answer = study::LimitProof::Answer;

    // How the values of enumerations are called, in their order.
    constexpr std::array<const char *, 5> names(Outcome)
    {
      return {"converges", "stalls", "undecided", "failed", "field only"};
    }
    constexpr std::array<const char *, 3> names(Answer)
    {
      return {"unknown", "compatible", "incompatible"};
    }
    /// Maps and runs of a thousand methods are less.
    constexpr std::size_t most_bytes = 1'000'000'000;

    // Each key stands here once; the same list writes and reads.
    template <typename Archive>
    void visit(Archive &a, base::Cost &cost)
    {
      a("setup_seconds", cost.setup_seconds);
      a("solve_seconds", cost.solve_seconds);
      a("peak_bytes", cost.peak_bytes);
      a("n_unknowns", cost.n_unknowns);
      a("n_bonds", cost.n_bonds);
      a("n_iterations", cost.n_iterations);
    }

    template <typename Archive>
    void visit(Archive &a, study::LimitProof &proof)
    {
      a("answer", proof.answer);
      a("defect", proof.defect);
      a("mean_defect", proof.mean_defect);
      a("spread", proof.spread);
      a("reason", proof.reason);
    }

    template <typename Archive>
    void visit(Archive &a, study::Diagnostics &diagnostics)
    {
      a("n_neighbours", diagnostics.n_neighbours);
      a("smallest_weight_ratio", diagnostics.smallest_weight_ratio);
      a("n_negative_weights", diagnostics.n_negative_weights);
      a("n_conditions", diagnostics.n_conditions);
      a("rank", diagnostics.rank);
      a("smallest_singular_value", diagnostics.smallest_singular_value);
      a("relative_residual", diagnostics.relative_residual);
      a("operator_backend", diagnostics.operator_backend);
      a("n_geometry_checks", diagnostics.n_geometry_checks);
      a("geometry_difference", diagnostics.geometry_difference);
      a("outer_change", diagnostics.outer_change);
      a("is_outer_error_known", diagnostics.is_outer_error_known);
      a("n_refinements", diagnostics.n_refinements);
      a("limit", diagnostics.limit);
      a("notes", diagnostics.notes);
    }

    template <typename Archive>
    void visit(Archive &a, study::Run &run)
    {
      a("method", run.method);
      a("family", run.family);
      a("problem", run.problem);
      a("series", run.series);
      a("level", run.level);
      a("h", run.h);
      a("horizon", run.horizon);
      a("cost", run.cost);
      a("diagnostics", run.diagnostics);
      a("size", run.size);
      a("round_off", run.round_off);
      a("errors", run.errors);
      a("failure", run.failure);
    }

    template <typename Archive>
    void visit(Archive &a, study::Trend &trend)
    {
      a("method", trend.method);
      a("family", trend.family);
      a("problem", trend.problem);
      a("series", trend.series);
      a("error", trend.error);
      a("parameter", trend.parameter);
      a("x", trend.x);
      a("values", trend.values);
      a("size", trend.size);
      a("round_off", trend.round_off);
      a("rates", trend.rates);
      a("rate", trend.rate);
      a("rate_uncertainty", trend.rate_uncertainty);
      a("plateau", trend.plateau);
      a("plateau_uncertainty", trend.plateau_uncertainty);
      a("outcome", trend.outcome);
      a("verdict", trend.verdict);
      a("reason", trend.reason);
      a("proof", trend.proof);
    }

    template <typename Archive>
    void visit(Archive &a, study::ErrorEstimate &estimate)
    {
      a("problem", estimate.problem);
      a("series", estimate.series);
      a("method", estimate.method);
      a("level", estimate.level);
      a("h", estimate.h);
      a("horizon", estimate.horizon);
      a("h_change", estimate.h_change);
      a("p_change", estimate.p_change);
      a("outer_change", estimate.outer_change);
      a("estimate", estimate.estimate);
      a("certified_digits", estimate.certified_digits);
      a("n_geometry_checks", estimate.n_geometry_checks);
      a("geometry_difference", estimate.geometry_difference);
      a("coarse_change", estimate.coarse_change);
      a("rate", estimate.rate);
      a("field_h_change", estimate.field_h_change);
      a("field_coarse_change", estimate.field_coarse_change);
      a("field_p_change", estimate.field_p_change);
      a("field_rate", estimate.field_rate);
      a("field_estimate", estimate.field_estimate);
      a("is_of_polygon", estimate.is_of_polygon);
    }

    template <typename Archive>
    void visit(Archive &a, study::Omission &omission)
    {
      a("what", omission.what);
      a("why", omission.why);
      a("saving", omission.saving);
    }

    template <typename Archive>
    void visit(Archive &a, study::Saving &saving)
    {
      a("method", saving.method);
      a("h", saving.h);
      a("horizon", saving.horizon);
      a("smallest", saving.smallest);
      a("full", saving.full);
      a("difference", saving.difference);
    }

    template <typename Archive>
    void visit(Archive &a, study::Expectation &expectation)
    {
      a("subject", expectation.subject);
      a("expected", expectation.expected);
      a("found", expectation.found);
      a("holds", expectation.holds);
    }

    template <typename Archive>
    void visit(Archive &a, study::Choice &choice)
    {
      a("target", choice.target);
      a("method", choice.method);
      a("h", choice.h);
      a("error", choice.error);
      a("seconds", choice.seconds);
    }

    template <typename Archive>
    void visit(Archive &a, study::Advice &advice)
    {
      a("problem", advice.problem);
      a("series", advice.series);
      a("choices", advice.choices);
      a("stalling", advice.stalling);
      a("field_only", advice.field_only);
    }

    template <typename Archive>
    void visit(Archive &a, study::ErrorMap &map)
    {
      a("method", map.method);
      a("problem", map.problem);
      a("series", map.series);
      a("quantity", map.quantity);
      a("h", map.h);
      a("horizon", map.horizon);
      a("lower", map.lower);
      a("upper", map.upper);
      a("n_x", map.n_x);
      a("n_y", map.n_y);
      a("values", map.values);
    }

    template <typename Archive>
    void visit(Archive &a, study::Results &results)
    {
      a("scene_name", results.scene_name);
      a("purpose", results.purpose);
      a("regime", results.regime);
      a("decisive_error", results.decisive_error);
      a("is_complete", results.is_complete);
      a("provenance", results.provenance);
      a("trends", results.trends);
      a("advice", results.advice);
      a("references", results.references);
      a("estimates", results.estimates);
      a("expectations", results.expectations);
      a("omissions", results.omissions);
      a("maps", results.maps);
      a("runs", results.runs);
      a("savings", results.savings);
      a("left_out", results.left_out);
      a("scene_text", results.scene_text);
    }

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
