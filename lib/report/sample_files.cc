#include "report/sample_files.h"

#include "analysis/checkpoint.h"
#include "base/error.h"
#include "report/formats.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <regex>

namespace plumbline::report
{
  namespace fs = std::filesystem;
  using Json = nlohmann::ordered_json;
  using study::SampleCase;
  using study::SampleField;
  using study::SampleRecord;

  namespace
  {
    std::string text_of(const fs::path &file)
    {
      std::ifstream in(file, std::ios::binary);
      return {std::istreambuf_iterator<char>(in), {}};
    }

    Json to_json(const SampleCase &one)
    {
      return {{"method", one.method},
              {"problem", one.problem},
              {"series", one.series},
              {"level", one.level},
              {"h", one.h},
              {"horizon", one.horizon},
              {"seconds", one.seconds},
              {"quantities", one.quantities},
              {"n_places", one.field.x.size()},
              {"n_components", one.field.n_components}};
    }

    SampleCase case_from(const Json &json, const std::vector<double> &fields, std::size_t &at)
    {
      SampleCase one;
      json.at("method").get_to(one.method);
      json.at("problem").get_to(one.problem);
      json.at("series").get_to(one.series);
      json.at("level").get_to(one.level);
      json.at("h").get_to(one.h);
      json.at("horizon").get_to(one.horizon);
      json.at("seconds").get_to(one.seconds);
      json.at("quantities").get_to(one.quantities);
      json.at("n_components").get_to(one.field.n_components);
      const auto n = json.at("n_places").get<std::size_t>();
      const auto take = [&](std::vector<double> &values, std::size_t count)
      {
        if (count > fields.size() - at)
          throw InputError("a sample's fields are not whole");
        const auto first = fields.begin() + static_cast<std::ptrdiff_t>(at);
        values.assign(first, first + static_cast<std::ptrdiff_t>(count));
        at += count;
      };
      take(one.field.x, n);
      take(one.field.y, n);
      take(one.field.area, n);
      take(one.field.values, n * one.field.n_components);
      return one;
    }

    std::vector<double> fields_of(const SampleRecord &record)
    {
      std::vector<double> all;
      for (const SampleCase &one : record.cases)
        for (const auto *const values :
             {&one.field.x, &one.field.y, &one.field.area, &one.field.values})
          all.insert(all.end(), values->begin(), values->end());
      return all;
    }

    /// A file that samples write, by its name: 000000.json, 000000.h5, checkpoint_0.h5.
    bool is_record(const fs::path &file)
    {
      return std::regex_match(file.filename().string(),
                              std::regex("([0-9]+\\.(json|h5)|checkpoint_[0-9]+\\.h5)"));
    }
  } // namespace

  SampleFiles::SampleFiles(fs::path folder, std::string subject)
      : folder_(std::move(folder)), subject_(std::move(subject))
  {
  }

  fs::path SampleFiles::file(std::size_t sample, const std::string &ending) const
  {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "%06zu", sample);
    return folder_ / (name.data() + ending);
  }

  bool SampleFiles::are_there() const
  {
    return fs::exists(subject_file()) && text_of(subject_file()) == subject_;
  }

  void SampleFiles::begin() const
  {
    std::vector<fs::path> records;
    if (fs::is_directory(folder_))
      for (const auto &entry : fs::directory_iterator(folder_))
        if (entry.path() != subject_file())
          records.push_back(entry.path());
    if ((fs::exists(folder_) && !fs::is_directory(folder_)) ||
        (!records.empty() && !fs::exists(subject_file())))
      throw InputError("'" + folder_.string() +
                       "' holds what no samples wrote; name another folder with -o");
    for (const fs::path &record : records)
      if (is_record(record))
        fs::remove(record);
    write_file(subject_file(), subject_);
  }

  bool SampleFiles::has(std::size_t sample) const
  {
    return fs::exists(file(sample, ".json"));
  }

  void SampleFiles::remove(std::size_t sample) const
  {
    std::error_code not_there;
    fs::remove(file(sample, ".json"), not_there);
  }

  void SampleFiles::write(const SampleRecord &record) const
  {
    const std::vector<double> fields = fields_of(record);
    if (!fields.empty()) // before the record, which says that all is there
      analysis::write_checkpoint(file(record.sample, ".h5").string(), {subject_, {}, fields});
    Json json{{"sample", record.sample}, {"failure", record.failure}, {"cases", Json::array()}};
    for (const SampleCase &one : record.cases)
      json["cases"].push_back(to_json(one));
    write_file(file(record.sample, ".json"), json.dump(1) + "\n");
  }

  std::optional<SampleRecord> SampleFiles::read(std::size_t sample) const
  try
  {
    if (!has(sample))
      return {};
    const Json json = Json::parse(text_of(file(sample, ".json")));
    SampleRecord record;
    json.at("sample").get_to(record.sample);
    json.at("failure").get_to(record.failure);
    const auto fields = analysis::read_checkpoint(file(sample, ".h5").string());
    std::size_t at = 0;
    for (const Json &one : json.at("cases"))
      record.cases.push_back(case_from(one, fields ? fields->records : std::vector<double>(), at));
    return record;
  }
  catch (const nlohmann::json::exception &)
  {
    return {};
  }
  catch (const InputError &)
  {
    return {};
  }
} // namespace plumbline::report
