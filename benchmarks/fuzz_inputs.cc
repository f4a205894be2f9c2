#include "fuzz_inputs.h"

#include "geometry/gmsh_process.h"
#include "io/results_json.h"
#include "scene/scene_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace plumbline::benchmarks
{
  namespace
  {
    namespace fs = std::filesystem;
    using Random = std::mt19937_64;

    std::size_t below(Random &random, std::size_t n)
    {
      return n == 0 ? 0 : random() % n;
    }

    template <typename T>
    const T &one_of(Random &random, const std::vector<T> &values)
    {
      return values[below(random, values.size())];
    }

    std::string read(const fs::path &file)
    {
      std::ifstream in(file, std::ios::binary);
      return {std::istreambuf_iterator<char>(in), {}};
    }

    std::string to_json(const std::string &name, const std::string &text)
    {
      nlohmann::ordered_json json = nlohmann::ordered_json::object();
      for (const scene::Setting &setting : scene::read_settings(name, text, name))
      {
        const std::size_t slash = setting.key.find('/');
        if (slash == std::string::npos)
          json[setting.key] = setting.value;
        else
          json[setting.key.substr(0, slash)][setting.key.substr(slash + 1)] = setting.value;
      }
      return json.dump(1);
    }

    const std::string old_mesh =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"omega\"\n2 2 \"collar\"\n"
        "$EndPhysicalNames\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n"
        "$EndNodes\n$Elements\n4\n1 1 2 0 1 1 2\n2 2 2 1 1 1 2 5\n3 2 2 1 1 1 5 4\n"
        "4 3 2 2 2 2 3 6 5\n$EndElements\n";
    const std::string new_mesh =
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"omega\"\n2 2 \"collar\"\n"
        "$EndPhysicalNames\n$Entities\n1 1 2 0\n1 0 0 0 0\n1 0 0 0 1 0 0 0 2 1 -1\n"
        "1 0 0 0 1 1 0 1 1 1 1\n2 1 0 0 2 1 0 1 2 0\n$EndEntities\n"
        "$Nodes\n2 6 1 6\n1 1 1 2\n1\n2\n0 0 0 0\n1 0 0 1\n2 1 0 4\n3\n4\n5\n6\n"
        "2 0 0\n0 1 0\n1 1 0\n2 1 0\n$EndNodes\n"
        "$Elements\n3 4 1 4\n1 1 1 1\n1 1 2\n2 1 2 2\n2 1 2 5\n3 1 5 4\n2 2 3 1\n4 2 3 6 5\n"
        "$EndElements\n$Comments\nseen by none\n$EndComments\n";

    study::StudyResults small_results()
    {
      study::StudyResults results;
      results.scene_name = "small";
      results.regime = scene::Regime::delta;
      results.decisive_error = "nodal Linf | exact";
      results.is_complete = true;
      results.provenance = {{"plumbline", "0"}};
      for (const std::string method : {"FA", "Q1"})
      {
        study::Trend trend;
        trend.method = method;
        trend.error = results.decisive_error;
        trend.axis = study::Axis::mesh_size;
        for (unsigned int level = 0; level < 3; ++level)
        {
          study::Record run;
          run.key.method = method;
          run.key.family =
              method == "FA" ? study::MethodFamily::meshfree : study::MethodFamily::reference;
          run.key.level = level;
          run.key.h = .1 / (1U << level);
          run.key.horizon = 3 * run.key.h;
          run.set(results.decisive_error, run.key.h * run.key.h);
          results.records.push_back(run);
          trend.x.push_back(run.key.h);
          trend.values.push_back(run.key.h * run.key.h);
          if (level > 0)
            trend.rates.push_back(2);
        }
        results.trends.push_back(trend);
        study::ErrorMap map;
        map.method = method;
        map.h = .025;
        map.horizon = .075;
        map.upper = {1, 1};
        map.n_x = 2;
        map.n_y = 1;
        map.values = {1e-3, 2e-3};
        results.maps.push_back(map);
      }
      study::ErrorEstimate estimate;
      estimate.h = .1;
      estimate.horizon = .3;
      results.references = {estimate};
      results.advice = {{"u", "m = 3", {{1e-2, "Q1", .1, 1e-2, .5}}, {"FA"}}};
      results.omissions = {{"the matrix", "one stencil", "memory"}};
      results.expectations = {{"FA", "not AC", "not AC", true}};
      return results;
    }

    /// Where words and numbers of a text begin and end.
    struct Token
    {
      std::size_t begin, end;
      bool is_number;
    };

    std::vector<Token> tokens(const std::string &text)
    {
      const auto is = [&](std::size_t i, const char *more)
      {
        const auto c = static_cast<unsigned char>(text[i]);
        return std::isalnum(c) != 0 || std::string(more).find(text[i]) != std::string::npos;
      };
      std::vector<Token> result;
      for (std::size_t i = 0; i < text.size(); ++i)
        if (is(i, "."))
        {
          const std::size_t begin = i;
          const bool is_number = std::isalpha(static_cast<unsigned char>(text[i])) == 0;
          while (i < text.size() && is(i, is_number ? ".+" : "_"))
            ++i;
          result.push_back({begin, i, is_number});
        }
      return result;
    }

    const std::vector<std::string> strange_numbers = {"0",
                                                      "-0",
                                                      "-1",
                                                      "1e400",
                                                      "-1e400",
                                                      "1e-400",
                                                      "nan",
                                                      "inf",
                                                      "-inf",
                                                      "1e308",
                                                      "1e-300",
                                                      "2147483648",
                                                      "4294967296",
                                                      "9223372036854775808",
                                                      "18446744073709551616",
                                                      "1e9",
                                                      "100000000",
                                                      "0x10",
                                                      "1.5.2",
                                                      "--1",
                                                      "+",
                                                      "",
                                                      "null",
                                                      "1,2",
                                                      "true",
                                                      "3",
                                                      "2",
                                                      "1",
                                                      "0.5",
                                                      "1e-9",
                                                      "7",
                                                      "-3",
                                                      "99999999999999999999999999"};

    const std::vector<std::string> strange_words = {"set",
                                                    "end",
                                                    "subsection",
                                                    "include",
                                                    "include fuzz.prm\n",
                                                    "omega",
                                                    "collar",
                                                    "$End",
                                                    "$Nodes",
                                                    "$Elements",
                                                    "\"",
                                                    "'",
                                                    "{",
                                                    "}",
                                                    "[",
                                                    "]",
                                                    "(",
                                                    ")",
                                                    ":",
                                                    ";",
                                                    ",",
                                                    "=",
                                                    "\\",
                                                    "#",
                                                    "//",
                                                    "/*",
                                                    "*/",
                                                    "SystemCall \"true\";",
                                                    "Save \"x\";",
                                                    "Merge \"fuzz.geo\";",
                                                    "Include",
                                                    "\xff\xfe",
                                                    "\xc3\xa9",
                                                    "\xEF\xBB\xBF",
                                                    "\r\n",
                                                    "\n",
                                                    "\t",
                                                    "delta",
                                                    "x",
                                                    "y ? 1 : 0",
                                                    "x^",
                                                    "sqrt(",
                                                    "sin()",
                                                    "none",
                                                    "all",
                                                    "free",
                                                    "lattice",
                                                    "squares",
                                                    "triangles",
                                                    "LPS",
                                                    "variational",
                                                    "Q1",
                                                    "P1",
                                                    "schema",
                                                    "maps",
                                                    "records",
                                                    "h"};

    void replace_token(std::string &text, Random &random, bool is_number, const std::string &by)
    {
      std::vector<Token> found = tokens(text);
      found.erase(std::remove_if(found.begin(), found.end(),
                                 [=](const Token &t) { return t.is_number != is_number; }),
                  found.end());
      if (found.empty())
        return;
      const Token token = one_of(random, found);
      text.replace(token.begin, token.end - token.begin, by);
    }

    std::string some_token(const std::string &text, Random &random)
    {
      const std::vector<Token> found = tokens(text);
      if (found.empty())
        return "";
      const Token token = one_of(random, found);
      return text.substr(token.begin, token.end - token.begin);
    }

    std::vector<std::string> lines(const std::string &text)
    {
      std::vector<std::string> result;
      std::istringstream in(text);
      for (std::string line; std::getline(in, line);)
        result.push_back(line + "\n");
      return result;
    }

    std::string joined(const std::vector<std::string> &lines)
    {
      std::string result;
      for (const std::string &line : lines)
        result += line;
      return result;
    }

    void change_lines(std::string &text, const std::string &other, Random &random)
    {
      std::vector<std::string> all = lines(text);
      if (all.empty())
        return;
      const std::size_t i = below(random, all.size()), j = below(random, all.size());
      const auto at = [&](std::size_t k) { return all.begin() + static_cast<std::ptrdiff_t>(k); };
      switch (below(random, 4))
      {
      case 0:
        all.erase(at(i));
        break;
      case 1:
        all.insert(at(i), std::string(all[j]));
        break;
      case 2:
        std::swap(all[i], all[j]);
        break;
      default:
        if (const auto theirs = lines(other); !theirs.empty())
          all.insert(at(i), one_of(random, theirs));
      }
      text = joined(all);
    }

    void change_bytes(std::string &text, Random &random)
    {
      const std::size_t i = below(random, text.size()), n = 1 + below(random, 30);
      switch (below(random, 6))
      {
      case 0:
        if (!text.empty())
          text[i] = static_cast<char>(text[i] ^ (1 << below(random, 8)));
        break;
      case 1:
        text.insert(i, 1, static_cast<char>(random()));
        break;
      case 2:
        text.erase(i, n);
        break;
      case 3:
        text.insert(i, text.substr(below(random, text.size()), n));
        break;
      case 4:
        text.resize(i);
        break;
      default: // to depth, or to length
        text.insert(i, std::string(1 + below(random, below(random, 8) == 0 ? 100000 : 100),
                                   "([{-\"aA0 .,;\n"[below(random, 13)]));
      }
    }

    void change(std::string &text, const std::string &other, Random &random)
    {
      switch (below(random, 8))
      {
      case 0:
      case 1:
        return replace_token(text, random, true, one_of(random, strange_numbers));
      case 2:
        return replace_token(text, random, true, some_token(other, random));
      case 3:
        return replace_token(text, random, false, one_of(random, strange_words));
      case 4:
        return replace_token(text, random, false, some_token(other, random));
      case 5:
      case 6:
        return change_lines(text, other, random);
      default:
        return change_bytes(text, random);
      }
    }
  } // namespace

  Corpus make_corpus(const std::string &scenes)
  {
    Corpus corpus(n_readers);
    const auto add = [&](Reader reader, const std::string &text)
    { corpus[static_cast<unsigned int>(reader)].push_back(text); };
    std::vector<fs::path> files;
    for (const auto &entry : fs::recursive_directory_iterator(scenes))
      if (entry.is_regular_file())
        files.push_back(entry.path());
    std::sort(files.begin(), files.end()); // the same everywhere
    for (const fs::path &file : files)
    {
      const std::string ending = file.extension().string(), text = read(file);
      if (ending == ".prm")
      {
        add(Reader::scene, text);
        add(Reader::json_scene, to_json(file.string(), text));
      }
      else if (ending == ".geo" && text.find("Volume") != std::string::npos)
        add(Reader::tetrahedra,
            geometry::mesh_by_gmsh(file.string(), 1, .5, {}, file.string(), 0, 3));
      else if (ending == ".geo")
      {
        add(Reader::script, text);
        add(Reader::meshed, text);
        add(Reader::mesh, geometry::mesh_by_gmsh(file.string(), .5, .5, {}, file.string()));
      }
      else if (ending == ".csv")
      {
        const std::string name = file.stem().string();
        add(name.find("bonds") == 0     ? Reader::bonds
            : name.find("picture") == 0 ? Reader::pictures
                                        : Reader::nodes,
            text);
      }
    }
    for (unsigned int i = 0; i < 4; ++i) // short ones are changed where it matters
    {
      add(Reader::mesh, old_mesh);
      add(Reader::mesh, new_mesh);
    }
    add(Reader::results, io::to_json(small_results()));
    add(Reader::results, io::to_json(study::StudyResults()));
    for (unsigned int r = 0; r < n_readers; ++r)
      if (corpus[r].empty())
        throw std::runtime_error("no sound input for the reader of a " +
                                 std::string(shares[r].name) + " in '" + scenes + "'");
    return corpus;
  }

  Input make_input(const Corpus &corpus, std::uint64_t seed)
  {
    Random random(seed);
    std::size_t lot = below(random, 1000);
    unsigned int reader = 0;
    while (lot >= shares[reader].per_mille)
      lot -= shares[reader++].per_mille;
    std::string text = one_of(random, corpus[reader]);
    const std::string &other = one_of(random, corpus[reader]);
    const std::size_t n = below(random, 7);
    for (std::size_t i = 0; i < n; ++i)
      change(text, other, random);
    return {static_cast<Reader>(reader), text};
  }
} // namespace plumbline::benchmarks
