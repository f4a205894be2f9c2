// All commands under a shift of the origin and in other units of length and of the solution: the
// same verdicts, findings, events and words, and the same numbers but for their units.

#include "command.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <regex>
#include <set>

namespace
{
  using namespace plumbline::app;
  using Json = nlohmann::json;

  /// How a scene is written otherwise.
  struct Change
  {
    const char *name;
    double shift_x = 0, shift_y = 0; ///< of the origin, in the new unit
    double length = 1, solution = 1; ///< what was 1 is so many of the new units
  };

  // Coordinates around 5e6 have nine decimals, and h = 0.1 has eight digits of its own then.
  const Change origin{"as it is"};
  const std::vector<Change> changes = {
      {"shifted", -1234567.375, 5411930.0625},
      {"lengths of 1e-9, solutions of 1e9", 0, 0, 1e-9, 1e9},
      {"shifted, lengths of 1e6, solutions of 1e-9", 5e12, -3e12, 1e6, 1e-9},
  };

  std::string number(double value)
  {
    std::ostringstream text;
    text.precision(15);
    text << value;
    return text.str();
  }

  /// X(a), Y(a): a coordinate; L(a), I(a): a length and one over a length; U(a): a value of the
  /// solution, LU(a): times a length; ξ, η: coordinates as they were, in expressions.
  std::string scene_of(const std::string &text, const Change &change)
  {
    static const std::regex token("\\b(X|Y|L|I|U|LU)\\(([-.e0-9]+)\\)|ξ|η");
    std::string result;
    auto last = text.begin();
    for (std::sregex_iterator at(text.begin(), text.end(), token), end; at != end; ++at)
    {
      const std::smatch &found = *at;
      result.append(last, found[0].first);
      last = found[0].second;
      const std::string kind = found[1];
      const double value = kind.empty() ? 0 : std::stod(found[2]);
      const double L = change.length, U = change.solution;
      if (kind.empty())
        result += found[0] == "ξ" ? "((x - (" + number(change.shift_x) + "))/" + number(L) + ")"
                                  : "((y - (" + number(change.shift_y) + "))/" + number(L) + ")";
      else
        result += number(kind == "X"   ? change.shift_x + L * value
                         : kind == "Y" ? change.shift_y + L * value
                         : kind == "L" ? L * value
                         : kind == "I" ? value / L
                         : kind == "U" ? U * value
                                       : L * U * value);
    }
    result.append(last, text.end());
    return result;
  }

  /// What a command leaves: by a path in its JSON file, or a name.
  struct Answer
  {
    std::map<std::string, double> numbers;
    std::map<std::string, std::string> words;
  };

  /// Words with their numbers left out: those have units, or are times.
  std::string without_numbers(const std::string &text)
  {
    static const std::regex one(
        "[-+]?[0-9]+([.][0-9]*)?([eE][-+]?[0-9]+)?|[.][0-9]+|\\b(inf|nan)\\b");
    return std::regex_replace(text, one, "#");
  }

  /// Times, memory, files, counts of iterations, what is only rounding, and the scene itself.
  bool is_left_out(const std::string &key)
  {
    static const std::regex noise(
        "seconds|_bytes|scene_text|/scene$|folder|file|purpose|n_iterations|most_iterations|"
        "residual|round_off|imbalance|/tied|/cost/|asymmetry|drift|round-off|version|machine|"
        "omissions|savings|(trends|maps|fields)/.*(values|solution)/|date|/estimates?/|singular[ "
        "_]value|/"
        "expectations|n_updates|"
        "factorisations|largest.rank|/updates|/iterations|most "
        "iterations|noise|/rates/|worst/node|advice/[0-9]+/choices/[0-9]+/"
        "(h|method|error)|cheapest/[0-9]+/(h|method|error|count|n_modes)"); // chosen by CPU times
    return std::regex_search(key, noise);
  }

  void collect(const Json &json, Answer &answer)
  {
    const Json flat = json.flatten();
    for (const auto &[key, value] : flat.items())
      if (is_left_out(key))
        continue;
      else if (value.is_number())
        answer.numbers[key] = value.get<double>();
      else
        answer.words[key] = without_numbers(value.dump());
  }

  /// One command on a scene.
  struct Row
  {
    const char *command, *options;
    const char *result; ///< its JSON file
    std::string scene;
    /// Other arguments, of files that it writes first; or nothing.
    std::function<std::string(const Change &)> arguments = {};
    /// Another command on the folder afterwards, or nothing.
    const char *afterwards = nullptr;
    int exit_code = 0;
  };

  Answer answer_of(const Row &row, const Change &change)
  {
    const fs::path folder = temporary("invariance");
    const std::string scene = write("scene.prm", scene_of(row.scene, change));
    const std::string of_scene = std::string(row.command) == "check" ? "--scene " + scene : scene;
    const Outcome outcome =
        run(std::string(row.command) + " " + (row.arguments ? row.arguments(change) + " " : "") +
            of_scene + " " + row.options + " -o " + folder.string());
    EXPECT_EQ(outcome.exit_code, row.exit_code) << outcome.err;
    Answer answer;
    answer.words["stderr"] = without_numbers(without_progress(outcome.err));
    if (row.afterwards != nullptr)
    {
      const Outcome again = run(std::string(row.afterwards) + " " + folder.string());
      EXPECT_EQ(again.exit_code, 0) << again.err;
    }
    if (fs::exists(folder / row.result))
      collect(Json::parse(read(folder / row.result)), answer);
    else
      ADD_FAILURE() << row.result << " is not there\n" << outcome.err;
    fs::remove_all(folder);
    fs::remove(scene);
    return answer;
  }

  /// Whether a value is another one times powers of the units, or a coordinate that was shifted.
  /// Relative: that of the largest eigenvalues, which `stability` finds by iterations to 1e-4; of
  /// other numbers, some of which follow from eigenvalues, less.
  double tolerance_of(const std::string &command)
  {
    return command == "stability" ? 1e-4 : 1e-5;
  }

  bool is_same(double was, double is, const Change &change, double tolerance)
  {
    constexpr double rounding = 1e-8; // of numbers of size one, roots of rounding among them
    if (!std::isfinite(was) || std::abs(was) < rounding)
      return true;
    if (was * is < 0 || is == 0)
      return std::abs(is - change.shift_x - change.length * was) <= 1e-9 * std::abs(is) ||
             std::abs(is - change.shift_y - change.length * was) <= 1e-9 * std::abs(is);
    for (int twice_a = -8; twice_a <= 8; ++twice_a)
      for (int b = -2; b <= 2; ++b)
      {
        if ((change.length == 1 && twice_a != 0) || (change.solution == 1 && b != 0))
          continue;
        const double unit = std::pow(change.length, .5 * twice_a) * std::pow(change.solution, b);
        if (std::abs(is / unit - was) <= tolerance * std::abs(was))
          return true;
      }
    for (const double shift : {change.shift_x, change.shift_y})
      if (shift != 0 && std::abs(is - shift - change.length * was) <=
                            tolerance * std::abs(change.length * was) + 1e-15 * std::abs(is))
        return true;
    return false;
  }

  void compare(const Answer &was, const Answer &is, const Change &change, const std::string &where)
  {
    constexpr int most = 6; // messages
    int n = 0;
    for (const auto &[key, words] : was.words)
    {
      const auto found = is.words.find(key);
      const std::string now = found == is.words.end() ? "(nothing)" : found->second;
      if (now != words && ++n <= most)
        ADD_FAILURE() << where << ", " << key << ":\n  " << words << "\nand now\n  " << now;
    }
    for (const auto &[key, value] : was.numbers)
    {
      const auto found = is.numbers.find(key);
      if ((found == is.numbers.end() || !is_same(value, found->second, change,
                                                 tolerance_of(where.substr(0, where.find(','))))) &&
          ++n <= most)
        ADD_FAILURE() << where << ", " << key << ": " << value << " and now "
                      << (found == is.numbers.end() ? "nothing" : number(found->second));
    }
    for (const auto &[key, value] : is.numbers)
      if (was.numbers.count(key) == 0 && ++n <= most)
        ADD_FAILURE() << where << ", " << key << ": new, " << value;
    if (n > most)
      ADD_FAILURE() << where << ": and " << n - most << " more";
  }

  // ---- the commands -----------------------------------------------------------------------------

  const std::string square = "subsection Domain\n set boxes = X(0), Y(0) : X(1), Y(1)\n";
  const std::string scalar = "subsection Kernel\n set type = linear-decay\n"
                             " set limit = -1/2 Laplace\nend\n";
  const std::string levels = "subsection Study\n set regime = delta\n set m = 3\n"
                             " set h = L(0.125), L(0.0625), L(0.03125), L(0.015625)\nend\n";

  const std::string lattice = square + "end\n" + scalar +
                              "subsection Problem\n set solution = wave: U(1)*sin(3*ξ)*cos(2*η); "
                              "quadratic: U(1)*(ξ^2 - ξ*η)\nend\n"
                              "subsection Methods\n set names = FA, IPA-AC-R2, Q1\nend\n" +
                              levels;

  const std::string triangles =
      square + " set mesh = triangles\nend\n" + scalar +
      "subsection Problem\n set solution = U(1)*sin(3*ξ)*cos(2*η)\nend\n"
      "subsection Methods\n set names = FA, P1\nend\n"
      "subsection Study\n set regime = delta\n set m = 2\n set h = L(0.25), L(0.125)\nend\n";

  const std::string solid =
      square + "end\nsubsection Kernel\n set type = 1/r\n set limit = Navier\nend\n"
               "subsection Material\n set model = LPS\n set E = 1\n set nu = 0.3\nend\n"
               "subsection Problem\n set solution = U(1)*ξ^2*η, U(1)*(ξ*η - η^3)\n"
               "end\nsubsection Methods\n set names = IPA-AC, Q1\nend\n"
               "subsection Study\n set regime = delta\n set m = 2\n"
               " set h = L(0.05)\nend\n";

  const std::string plate =
      "subsection Domain\n set boxes = X(0), Y(-0.5) : X(1), Y(0.5)\n set boundary = free\n"
      " set fixed = X(0), Y(0.35) : X(1), Y(0.5); X(0), Y(-0.5) : X(1), Y(-0.35)\n"
      " set cracks = X(-0.1), Y(0) : X(0.5), Y(0)\nend\n"
      "subsection Kernel\n set type = 1/r\n set limit = Navier\nend\n"
      "subsection Material\n set model = LPS\n set E = 1\n set nu = 0.25\nend\n"
      "subsection Problem\n set constraint = 0, LU(0.5)*sign(η)\nend\n"
      "subsection Methods\n set names = OPT\nend\n"
      "subsection Study\n set regime = delta\n set m = 3\n set h = L(0.05)\nend\n"
      "subsection Fracture\n set toughness = L(1)\n set least reaction = 0.5\nend\n";

  const std::string strip_in_motion =
      "subsection Domain\n set boxes = X(0), Y(-0.5) : X(2), Y(0.5)\nend\n"
      "subsection Kernel\n set type = constant\n set limit = Navier\nend\n"
      "subsection Material\n set model = double well\n set c = L(1)\n set beta = I(1)\nend\n"
      "subsection Methods\n set names = FA\nend\n"
      "subsection Study\n set regime = delta\n set m = 2\n set h = L(0.05)\nend\n"
      "subsection Time\n set final time = L(10)\n set damping = I(2)\n"
      " set critical fractions = 0.8\nend\n"
      "subsection Crack\n set notch = L(1)\n set load = 1.2\nend\n";

  const std::string standing_strip =
      "subsection Strip\n set height = L(2.4)\n set length = L(4.8)\n set crack = L(2.4)\nend\n"
      "subsection Kernel\n set type = 1/r\n set limit = Navier\nend\n"
      "subsection Material\n set model = LPS\n set E = 2.5\n set nu = 0.25\nend\n"
      "subsection Methods\n set names = DGQ0, PA-AC\nend\n"
      "subsection Study\n set regime = m\n set horizon = L(0.3)\n"
      " set h = L(0.3), L(0.15), L(0.1)\nend\n";

  const std::string random =
      square +
      "end\nsubsection Random\n set variables = a: uniform 1 2\nend\n"
      "subsection Sampling\n set rule = tensor\n set counts = 1, 2\nend\n" +
      scalar +
      "subsection Problem\n set solution = U(1)*sin(a*ξ)*cos(2*η)\nend\n"
      "subsection Methods\n set names = Q1\nend\n"
      "subsection Study\n set regime = delta\n set m = 3\n set h = L(0.125)\nend\n";

  const std::string motion =
      "subsection Domain\n set boxes = X(0), Y(0) : X(1), Y(1)\n set dimension = 1\n"
      " set boundary = periodic\nend\n"
      "subsection Kernel\n set type = linear-decay\n set limit = Navier\nend\n"
      "subsection Material\n set model = double well\n set c = L(1)\n set beta = I(1)\nend\n"
      "subsection Problem\n set local solution = none\nend\n"
      "subsection Time\n set final time = L(0.2)\n set schemes = Blanes-Moan\n"
      " set steps = L(0.02)\n set initial displacement = L(0.1)*sin(2*pi*ξ)\nend\n"
      "subsection Methods\n set names = FA, Q1\nend\n"
      "subsection Study\n set regime = m\n set horizon = L(0.25)\n"
      " set h = L(0.125), L(0.0625)\n set norms = nodal L2\n"
      " set decisive error = nodal L2 | reference\nend\n"
      "subsection Reference\n set method = torus\nend\n";

  /// Nodes and full-area weights of the scene `lattice` at h = 1/8, one bond twice what it is.
  std::string write_bonds(const Change &change)
  {
    constexpr int n = 8, m = 3;
    constexpr double h = 1. / n;
    const fs::path nodes = temporary("nodes.csv"), bonds = temporary("bonds.csv");
    std::ofstream of_nodes(nodes), of_bonds(bonds);
    of_nodes << "id,x,y,volume\n";
    of_bonds << "i,j,weight\n";
    const double area = h * h * change.length * change.length;
    const auto id = [](int i, int j) { return (j + m) * (n + 2 * m) + i + m; };
    for (int j = -m; j < n + m; ++j)
      for (int i = -m; i < n + m; ++i)
      {
        of_nodes << id(i, j) << ',' << number(change.shift_x + change.length * h * (i + .5)) << ','
                 << number(change.shift_y + change.length * h * (j + .5)) << ',' << number(area)
                 << '\n';
        if (i < 0 || j < 0 || i >= n || j >= n)
          continue;
        for (int dj = -m; dj <= m; ++dj)
          for (int di = -m; di <= m; ++di)
            if ((di != 0 || dj != 0) && di * di + dj * dj <= m * m)
              of_bonds << id(i, j) << ',' << id(i + di, j + dj) << ','
                       << number(i == 3 && j == 4 && di == 1 && dj == 2 ? 2 * area : area) << '\n';
      }
    return nodes.string() + " " + bonds.string();
  }

  const std::vector<Row> rows = {
      {"run", "", "results.json", lattice, {}, "report"},
      {"run", "", "results.json", triangles},
      {"run", "", "results.json", solid},
      {"run", "", "dynamics.json", motion},
      {"check", "", "check.json", lattice, write_bonds, nullptr, 1},
      {"stability", "--levels 2", "stability.json", lattice},
      {"dispersion", "--levels 2", "dispersion.json", lattice},
      {"grow", "", "grow.json", plate},
      {"crack", "", "crack.json", strip_in_motion},
      {"strip", "", "strip.json", standing_strip},
      {"sample", "", "sample.json", random},
  };
} // namespace

class Invariance : public testing::TestWithParam<std::size_t>
{
};

TEST_P(Invariance, of_origin_and_units)
{
  const Row &row = rows[GetParam()];
  const Answer was = answer_of(row, origin);
  ASSERT_FALSE(was.numbers.empty());
  for (const Change &change : changes)
    compare(was, answer_of(row, change), change, std::string(row.command) + ", " + change.name);
}

INSTANTIATE_TEST_SUITE_P(OfCommands, Invariance, testing::Range(std::size_t{0}, rows.size()),
                         [](const auto &info)
                         { return rows[info.param].command + std::to_string(info.param); });
