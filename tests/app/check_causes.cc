// What `plumbline check` says of files that were written in other units, orders, counts or formats.

#include "given_files.h"

#include <algorithm>
#include <cmath>
#include <thread>

namespace
{
  using namespace plumbline::app;

  /// Columns of a CSV file, row by row.
  using Rows = std::vector<std::vector<std::string>>;

  Rows rows_of(const std::string &file)
  {
    std::istringstream in(read(file));
    Rows rows;
    for (std::string line; std::getline(in, line);)
    {
      rows.emplace_back();
      std::istringstream values(line);
      for (std::string value; std::getline(values, value, ',');)
        rows.back().push_back(value);
    }
    return rows;
  }

  std::string write_rows(const std::string &name, const Rows &rows,
                         const std::string &separator = ",")
  {
    std::string text;
    for (const auto &row : rows)
    {
      for (std::size_t c = 0; c < row.size(); ++c)
        text += (c == 0 ? "" : separator) + row[c];
      text += '\n';
    }
    return write(name, text);
  }

  /// Each number of a column through a function.
  Rows mapped(Rows rows, std::size_t column, const std::function<double(double)> &f,
              int n_digits = 17)
  {
    for (std::size_t r = 1; r < rows.size(); ++r)
    {
      std::ostringstream text;
      text.precision(n_digits);
      text << f(std::stod(rows[r][column]));
      rows[r][column] = text.str();
    }
    return rows;
  }

  std::string volumes_times(double factor)
  {
    return write_rows("times_nodes.csv",
                      mapped(rows_of(nodes_file), 3, [&](double v) { return factor * v; }));
  }

  std::string weights_times(double factor)
  {
    return write_rows("times_bonds.csv",
                      mapped(rows_of(bonds_file), 2, [&](double w) { return factor * w; }));
  }

  void expect_not_found(const std::string &text, const std::string &part)
  {
    EXPECT_EQ(text.find(part), std::string::npos) << text;
  }
} // namespace

TEST(CheckCauses, volumes_in_other_units_are_told_before_all_else)
{
  for (const double factor : {.002, 1e6})
  {
    const Outcome both = check(volumes_times(factor), weights_times(factor), "--json");
    EXPECT_EQ(both.exit_code, 1) << both.err;
    expect_found(both.out, "\"h\": 0.125"); // the level by the spacing of nodes
    expect_found(both.out, "cause: the volumes are");
    expect_found(both.out, "all weights carry the same factor; without that the moments are off by "
                           "nothing");
    expect_not_found(both.out, "outlier: ");
    const Outcome volumes = check(volumes_times(factor), bonds_file, "--json");
    EXPECT_EQ(volumes.exit_code, 1) << volumes.err;
    expect_found(volumes.out, "the weights do not carry that factor");
    expect_not_found(volumes.out, "common factor");
    const Outcome weights = check(nodes_file, weights_times(factor), "--json");
    EXPECT_EQ(weights.exit_code, 1);
    expect_found(weights.out, "cause: all weights carry a common factor of");
    expect_not_found(weights.out, "the volumes are");
  }
}

TEST(CheckCauses, ids_that_count_from_elsewhere_are_told)
{
  const auto shift = [](std::size_t column, double by)
  { return [=](Rows rows) { return mapped(rows, column, [=](double id) { return id + by; }); }; };
  for (const double by : {1., -1.})
  {
    const std::string word = by < 0 ? "less" : "more";
    const Rows rows = rows_of(bonds_file);
    Outcome outcome = check(nodes_file, write_rows("both.csv", shift(0, by)(shift(1, by)(rows))));
    EXPECT_EQ(outcome.exit_code, 2);
    expect_found(outcome.err,
                 "the ids in i and j are both one " + word + " than those of the nodes");
    outcome = check(nodes_file, write_rows("one.csv", shift(1, by)(rows)));
    EXPECT_EQ(outcome.exit_code, 2);
    expect_found(outcome.err, "the ids in j are one " + word + " than those of the nodes");
  }
}

TEST(CheckCauses, half_lists_are_told_even_if_some_nodes_have_no_bonds)
{
  Rows half{rows_of(bonds_file)[0]};
  for (const auto &row : rows_of(bonds_file))
    if (row[0] != "i" && std::stoi(row[0]) < std::stoi(row[1]))
      half.push_back(row);
  Outcome outcome = check(nodes_file, write_rows("half.csv", half), "--json");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out, "cause: each pair of nodes is listed only once (a half list)");
  expect_not_found(outcome.out, "outlier: ");
  // the same of free nodes alone, numbered first: the last has no bond of its own
  Rows inner{half[0]};
  std::map<std::string, bool> is_free;
  for (const auto &row : rows_of(bonds_file))
    is_free[row[0]] = true;
  for (const auto &row : half)
    if (row[0] != "i" && is_free[row[1]])
      inner.push_back(row);
  outcome = check(nodes_file, write_rows("inner.csv", inner), "--json");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out, "a half list");
}

TEST(CheckCauses, bands_of_volumes_are_one_line)
{
  Rows rows = rows_of(nodes_file);
  std::size_t n = 0;
  for (std::size_t r = 1; r < rows.size(); ++r)
    if (std::abs(std::stod(rows[r][1]) - .3125) < .01 && std::abs(std::stod(rows[r][2]) - .5) < .5)
    {
      rows[r][3] = "0.01875"; // 1.2 h²
      ++n;
    }
  ASSERT_EQ(n, 8u);
  const Outcome outcome = check(write_rows("bands.csv", rows), bonds_file, "--json");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out, "outlier: the volumes of 8 nodes (");
  expect_found(outcome.out, "are 1.2 times the areas of their cells");
}

TEST(CheckCauses, zeros_are_told)
{
  const Outcome outcome = check(nodes_file, weights_times(0), "--json");
  EXPECT_EQ(outcome.exit_code, 1);
  expect_found(outcome.out, "cause: all weights are zero");
  expect_found(outcome.out, "there is no operator");
  expect_not_found(outcome.out, "wrong sign");
}

TEST(CheckCauses, other_formats_of_text_are_read_and_named)
{
  const Rows rows = rows_of(nodes_file);
  const auto read_as =
      [&](const std::string &name, const std::string &text, const std::string &note)
  {
    const Outcome outcome = check(write(name, text), bonds_file, "--json");
    EXPECT_EQ(outcome.exit_code, 0) << note << outcome.err;
    expect_found(outcome.out, note);
  };
  for (const auto &[separator, word] :
       {std::pair{";", "';'"}, std::pair{"\t", "tabs"}, std::pair{" ", "blanks"}})
    read_as("separated.csv", read(write_rows("separated.csv", rows, separator)),
            std::string("values are separated by ") + word);
  Rows changed = rows;
  for (auto &row : changed)
    for (std::string &value : row)
      value = '"' + value + '"';
  read_as("quoted.csv", read(write_rows("quoted.csv", changed)), "values are in quotes");
  changed = rows;
  changed[0] = {"ID", "X", "Y", "Volume"};
  read_as("upper.csv", read(write_rows("upper.csv", changed)),
          "names of columns are in upper case");
  read_as("comment.csv", "# by another code\n" + read(nodes_file), "1 comment line is left out");
  std::string peridigm = "# x y z block_id volume\n";
  for (std::size_t r = 1; r < rows.size(); ++r)
    peridigm += rows[r][1] + ' ' + rows[r][2] + " 0.0 1 " + rows[r][3] + '\n';
  read_as("peridigm.txt", peridigm, "there is no column id, as in Peridigm's text");

  const Outcome solid = check(write("solid.txt", peridigm + ".1 .2 .5 1 .01\n"), bonds_file);
  EXPECT_EQ(solid.exit_code, 2);
  expect_found(solid.err, "z = 0.5 where other nodes have 0");
  changed = rows;
  changed[1][1] = "-0,3125";
  const Outcome comma = check(write_rows("comma.csv", changed, ";"), bonds_file);
  EXPECT_EQ(comma.exit_code, 2);
  expect_found(comma.err, "x = '-0,3125' is not a finite number; write decimal points");
}

TEST(CheckCauses, weights_that_are_printed_with_few_digits_are_right)
{
  const Weights weights = example_weights("IPA-AC-R2", .2);
  const Files files = files_of(weights);
  for (const int n_digits : {6, 7, 8, 10})
  {
    const auto printed = [&](const std::string &file, const std::vector<std::size_t> &columns)
    {
      Rows rows = rows_of(file);
      for (const std::size_t column : columns)
        rows = mapped(
            rows, column, [](double x) { return x; }, n_digits);
      return rows;
    };
    const Outcome outcome =
        check(write_rows("few_nodes.csv", printed(files.nodes, {1, 2, 3})),
              write_rows("few_bonds.csv", printed(files.bonds, {2, 3, 4})), "--json");
    EXPECT_EQ(outcome.exit_code, 0) << n_digits << outcome.err << outcome.out;
    expect_not_found(outcome.out, "outlier: ");
  }
}

TEST(CheckCauses, what_is_found_does_not_depend_on_the_origin_and_the_units)
{
  // lengths times a unit and moved, weights in another unit than volumes, kernel points absent
  const Files files = files_of(example_weights("FA", 0));
  const auto lines = [](const std::string &json)
  {
    std::string result;
    std::istringstream in(json);
    for (std::string line; std::getline(in, line);)
      if (line.find("outlier: ") != std::string::npos)
        result += line + '\n';
      else if (line.find("the weights are those of FA") != std::string::npos)
        result += "those of FA\n";
    return result;
  };
  const std::string plain = lines(check(files.nodes, files.bonds, "--json").out);
  expect_found(plain, "those of FA");
  expect_not_found(plain, "outlier");
  struct Change
  {
    double origin, unit, weight;
  };
  for (const Change &change : {Change{5e6, 1, 1}, Change{-3e5, 1, 1}, Change{0, 1e-6, 1},
                               Change{0, 1e3, 1}, Change{0, 1, 1e6}})
  {
    const auto number = [](double x)
    {
      std::ostringstream text;
      text.precision(17);
      text << x;
      return text.str();
    };
    Rows nodes = rows_of(files.nodes), bonds = rows_of(files.bonds);
    for (const std::size_t column : {1, 2})
      nodes = mapped(nodes, column, [&](double x) { return change.unit * x + change.origin; });
    nodes = mapped(nodes, 3, [&](double v) { return change.unit * change.unit * v; });
    for (auto &row : bonds)
      row.resize(3);
    bonds =
        mapped(bonds, 2, [&](double w) { return change.weight * change.unit * change.unit * w; });
    const double a = change.origin, b = change.origin + change.unit;
    const Outcome outcome =
        check(write_rows("moved_nodes.csv", nodes), write_rows("moved_bonds.csv", bonds),
              "--json --set 'Domain/boxes=" + number(a) + "," + number(a) + ":" + number(b) + "," +
                  number(b) + "' --set Study/h=" + number(.125 * change.unit) +
                  " --set 'Problem/solution=wave: 1'");
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(lines(outcome.out), plain)
        << change.origin << ", " << change.unit << ", " << change.weight << outcome.err;
  }
}

TEST(CheckCauses, bodies_that_are_not_checked_are_refused_before_all_else)
{
  // keys that would be refused, too, come later
  const std::string more = "--set Methods/nodes=vertices --set Problem/load=1 ";
  for (const auto &[key, text] :
       {std::pair{"'Domain/cracks=.2,.5 : .8,.5'", "'plumbline check' does not support cracks of "
                                                   "scenes: Domain/cracks is given; clear it, "
                                                   "and give --crack"},
        std::pair{"Domain/boundary=free",
                  "'plumbline check' does not take free or periodic boundaries from the scene"}})
  {
    const Outcome outcome = check(nodes_file, bonds_file, more + "--set " + key);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err.find(std::string("plumbline: ") + text), 0u) << outcome.err;
  }
}

TEST(CheckCauses, a_signal_ends_it_even_if_its_parent_ignores_that_signal)
{
  const auto before = std::signal(SIGTERM, SIG_IGN); // which the child inherits
  const pid_t child =
      start("check " + nodes_file + " " + bonds_file + " --quiet --scene " + scene_file);
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0)
  {
    kill(child, SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::signal(SIGTERM, before);
  EXPECT_TRUE(WIFSIGNALED(status)) << status;
}

TEST(CheckCauses, threads_are_taken)
{
  EXPECT_EQ(check(nodes_file, bonds_file, "--quiet --threads 1").exit_code, 0);
}

// a scene of another mesh size or horizon: the bonds, which are right, are not blamed
TEST(CheckCauses, a_scene_of_other_bonds_is_asked_about_first)
{
  const std::string question = "do h and horizon belong to these bonds? ";
  struct Other
  {
    std::string changes, numbers;
  };
  for (const Other &other :
       {Other{"--set Study/h=0.25 --set Study/m=1.6",
              "the nodes' spacing is 0.125, but h is 0.25 and the horizon 0.4; give the h and the "
              "horizon of your bonds (Study/h, and Study/m or Study/horizon)"},
        Other{"--set Study/m=4.3", // there are neighbours between
              "the longest bond is 0.450694, but the horizon is 0.5375 for a spacing of 0.125; "
              "give"},
        Other{"--set Study/m=5",
              "the longest bond is 0.450694, but the horizon is 0.625 for a spacing of 0.125; "
              "give"}})
  {
    const Outcome outcome = check(nodes_file, bonds_file, other.changes);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    expect_found(outcome.out, question + other.numbers);
    EXPECT_LT(outcome.out.find(question), outcome.out.find("not asymptotically compatible"));
    expect_not_found(outcome.out, "cause: ");
  }
  const Outcome own = check(nodes_file, (folder / "bonds_wrong.csv").string());
  EXPECT_EQ(own.exit_code, 1) << own.err;
  expect_not_found(own.out, question);
  // where the scene's nodes are fewer, those of the file do not fit in
  const Outcome outside = check(nodes_file, bonds_file, "--set Study/h=0.1");
  EXPECT_EQ(outside.exit_code, 2);
  expect_found(outside.err, "h = 0.1, horizon = 0.3, while the nodes' spacing is 0.125; if "
                            "those are not the h and horizon of your bonds (Study), correct "
                            "them");
}
