#include "io/certificate_json.h"

#include "base/json_text.h"
#include "base/text_file.h"
#include "io/json_archive.h"

#include <cmath>

namespace plumbline::study
{
  template <class Archive>
  void visit(Archive &a, CertifiedWay &way)
  {
    a("method", way.method);
    a("h", way.h);
    a("order", way.order);
    a("error", way.error);
  }

  template <class Archive>
  void visit(Archive &a, CertifiedValue &value)
  {
    a("x", value.x);
    a("value", value.value);
    a("bound", value.bound);
    a("other", value.other);
    a("other_bound", value.other_bound);
    a("digits", value.digits);
    a("exact", value.exact);
  }

  template <class Archive>
  void visit(Archive &a, CertifiedRule &rule)
  {
    a("method", rule.method);
    a("h", rule.h);
    a("largest", rule.largest);
    a("rms", rule.root_mean_square);
    a("digits", rule.digits);
    a("order", rule.order);
  }

  template <class Archive>
  void visit(Archive &a, Certificate &certificate)
  {
    a("name", certificate.name);
    a("purpose", certificate.purpose);
    a("sha256", certificate.hash);
    a("plumbline", certificate.version);
    a("horizon", certificate.horizon);
    a("n_components", certificate.n_components);
    a("size", certificate.size);
    a("galerkin", certificate.galerkin);
    a("meshfree", certificate.meshfree);
    a("points", certificate.points);
    a("mean", certificate.mean);
    a("rules", certificate.rules);
    a("scene_text", certificate.scene_text);
  }
} // namespace plumbline::study

namespace plumbline::io
{
  namespace
  {
    constexpr auto remedy = "make it again by 'plumbline certify'";

    /// What types do not say.
    void check(const study::Certificate &certificate, const std::string &what)
    {
      const auto require = [&](bool holds, const std::string &complaint)
      {
        if (!holds)
          throw InputError(what + ": " + complaint + "; " + remedy);
      };
      require(certificate.n_components >= 1 && certificate.n_components <= 3,
              "n_components is not 1, 2 or 3");
      require(certificate.size > 0 && std::isfinite(certificate.size),
              "size is not a number above 0");
      require(!certificate.points.empty(), "points is empty");
      for (std::size_t i = 0; i < certificate.points.size(); ++i)
      {
        const study::CertifiedValue &one = certificate.points[i];
        const std::string place = "points[" + std::to_string(i) + "]";
        require(!one.x.empty() && one.x.size() <= 3 &&
                    one.x.size() == certificate.points.front().x.size(),
                place + ".x is not one to three numbers, as many as at the other points");
        require(one.value.size() == certificate.n_components &&
                    one.other.size() == certificate.n_components,
                place + " has not n_components values");
        require(std::isfinite(one.bound) && one.bound >= 0, place + ".bound is not a number >= 0");
        for (const std::vector<double> *numbers : {&one.x, &one.value})
          for (const double number : *numbers)
            require(std::isfinite(number), place + " has null in place of a number");
      }
      for (const study::CertifiedRule &rule : certificate.rules)
        require(rule.h.size() == rule.largest.size() && rule.h.size() == rule.digits.size() &&
                    rule.h.size() == rule.root_mean_square.size(),
                "rules: " + rule.method + " has lists of different lengths");
    }
  } // namespace

  std::string to_json(const study::Certificate &certificate)
  {
    JsonWriter writer;
    study::Certificate copy = certificate; // one list of keys serves the reader, too
    visit(writer, copy);
    Json json{{"schema", certificate_schema}};
    json.update(writer.take());
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  }

  study::Certificate certificate_from_json(const std::string &text, const std::string &file)
  {
    const std::string what = "certificate '" + file + "'";
    const Json json = base::parse_json(text, what, remedy);
    unsigned int found = 0;
    const JsonReader reader(json, "", file);
    reader("schema", found);
    if (found != certificate_schema)
      throw InputError(what + ": schema = " + std::to_string(found) +
                       ", but this version reads schema " + std::to_string(certificate_schema) +
                       "; " + remedy);
    study::Certificate certificate;
    visit(reader, certificate);
    check(certificate, what);
    return certificate;
  }

  study::Certificate read_certificate(const std::filesystem::path &file)
  {
    constexpr std::size_t most_bytes = 100'000'000;
    const std::string name = file.string();
    return certificate_from_json(
        base::read_text_file(name, "certificate '" + name + "'", most_bytes,
                             "the file certificate.json that 'plumbline certify' has written"),
        name);
  }
} // namespace plumbline::io
