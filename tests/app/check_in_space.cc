// Weights of another code in space: right ones pass, wrong ones are named with their cause.
#include "command.h"

#include "base/number_text.h"
#include "geometry/node_cells_in_space.h"
#include "meshfree/rules/families.h"
#include "meshfree/rules/rules.h"

#include <deal.II/base/numbers.h>
#include <deal.II/base/point.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

namespace
{
  using namespace plumbline;
  using namespace plumbline::app;
  using dealii::Point;
  using meshfree::Bond;

  constexpr int n = 5, m = 2;
  constexpr double h = 1. / n;

  const std::string scene = R"(subsection Domain
  set dimension = 3
  set boxes     = 0, 0, 0 : 1, 1, 1
end
subsection Kernel
  set type  = KERNEL
  set limit = LIMIT
end
subsection Problem
  set solution = SOLUTION
end
subsection Methods
  set names = MEANT
end
subsection Study
  set h = 0.2
  set m = 2
  set norms = nodal Linf
end
)";

  std::string replaced(std::string text, const std::string &what, const std::string &by)
  {
    return text.replace(text.find(what), what.size(), by);
  }

  struct Row
  {
    int i = 0, j = 0;
    double weight = 0;
    Point<3> kernel_point;
  };

  /// What another code wrote.
  struct Dump
  {
    std::vector<Point<3>> places;
    std::vector<double> volumes;
    std::vector<Row> rows;
    bool has_points = true;
    std::string separator = ",";
    int first_id = 1;
  };

  physics::Kernel<3> kernel_of(bool is_tensor, double horizon)
  {
    return is_tensor
               ? physics::Kernel<3>::with_bulk_modulus(physics::kernel_type("bond-tensor").profile,
                                                       horizon, 1)
               : physics::Kernel<3>::with_diffusion(physics::kernel_type("linear-decay").profile,
                                                    horizon, .5);
  }

  /// A rule's weights on a lattice of n cells along a side, with nodes around the unit cube.
  Dump dump(const std::string &name, bool is_tensor, const int n = ::n, const int m = ::m)
  {
    const double h = 1. / n;
    const auto kernel = kernel_of(is_tensor, m * h);
    const meshfree::Rule &rule = meshfree::find_rule(name, "rule");
    const auto bonds = lattice_bonds(rule.in_space(kernel), kernel, h, geometry::Backend::fast);
    const int margin = m + 1, width = n + 2 * margin;
    const auto index = [=](const std::array<int, 3> &at)
    { return at[0] + margin + width * (at[1] + margin + width * (at[2] + margin)); };
    Dump result;
    std::array<int, 3> at{};
    for (at[2] = -margin; at[2] < n + margin; ++at[2])
      for (at[1] = -margin; at[1] < n + margin; ++at[1])
        for (at[0] = -margin; at[0] < n + margin; ++at[0])
        {
          result.places.emplace_back((at[0] + .5) * h, (at[1] + .5) * h, (at[2] + .5) * h);
          result.volumes.push_back(h * h * h);
          if (*std::min_element(at.begin(), at.end()) < 0 ||
              *std::max_element(at.begin(), at.end()) >= n)
            continue;
          for (const Bond<3> &bond : bonds.family)
          {
            std::array<int, 3> to = at;
            for (unsigned int d = 0; d < 3; ++d)
              to[d] += static_cast<int>(std::lround(bond.xi[d] / h));
            result.rows.push_back({index(at), index(to), bond.weight, bond.kernel_point});
          }
        }
    return result;
  }

  /// A rule's weights on nodes moved by up to a part of h, in Voronoi cells.
  Dump scattered_dump(const std::string &name, bool is_tensor, double moved, int m = ::m)
  {
    const auto kernel = kernel_of(is_tensor, m * h);
    const geometry::CubeLattice omega({{{{0, 0, 0}, {1, 1, 1}}}, {}}, h);
    const auto nodes = geometry::lattice_nodes(omega, geometry::layers_for(m * h, h), moved, 1);
    const geometry::NodeCells<3> cells = geometry::voronoi_cells(nodes, omega, m * h);
    const meshfree::Families<3> families(meshfree::find_rule(name, "rule").in_space(kernel), kernel,
                                         cells, geometry::Backend::fast);
    Dump result;
    result.places = cells.nodes;
    result.volumes = cells.area;
    meshfree::Family<3> family;
    for (std::size_t i = 0; i < cells.n_free; ++i)
    {
      families.make(i, family);
      for (std::size_t k = 0; k < family.bonds.size(); ++k)
        result.rows.push_back({static_cast<int>(i), static_cast<int>(family.neighbours[k]),
                               family.bonds[k].weight, family.bonds[k].kernel_point});
    }
    return result;
  }

  class CheckInSpace : public testing::Test
  {
  protected:
    CheckInSpace() : folder_(temporary("check_in_space")) { fs::create_directories(folder_); }
    ~CheckInSpace() override { fs::remove_all(folder_); }

    void write(const Dump &dump) const
    {
      const std::string &s = dump.separator;
      std::ofstream nodes(folder_ / "nodes.csv"), bonds(folder_ / "bonds.csv");
      nodes << "id" << s << "x" << s << "y" << s << "z" << s << "volume\n";
      for (std::size_t i = 0; i < dump.places.size(); ++i)
        nodes << static_cast<int>(i) + dump.first_id << s << text(dump.places[i][0]) << s
              << text(dump.places[i][1]) << s << text(dump.places[i][2]) << s
              << text(dump.volumes[i]) << '\n';
      bonds << "i" << s << "j" << s << "weight";
      if (dump.has_points)
        bonds << s << "qx" << s << "qy" << s << "qz";
      bonds << '\n';
      for (const Row &row : dump.rows)
      {
        bonds << row.i + dump.first_id << s << row.j + dump.first_id << s << text(row.weight);
        for (unsigned int d = 0; d < 3 && dump.has_points; ++d)
          bonds << s << text(row.kernel_point[d]);
        bonds << '\n';
      }
    }

    /// @param ending  of the names of files
    Outcome check(const std::string &meant, bool is_tensor, const std::string &options = "",
                  const std::string &ending = ".csv") const
    {
      std::string text = replaced(scene, "KERNEL", is_tensor ? "bond-tensor" : "linear-decay");
      text = replaced(text, "LIMIT", is_tensor ? "Navier" : "-1/2 Laplace");
      text = replaced(text, "SOLUTION", is_tensor ? "x, y, z" : "x");
      const std::string side = base::to_text(side_, 8);
      text = replaced(text, "1, 1, 1", side + ", " + side + ", " + side);
      text = replaced(text, "h = 0.2", "h = " + base::to_text(side_ * h, 8));
      text = replaced(text, "set m = 2", "set m = " + std::to_string(m_));
      std::ofstream(folder_ / "scene.prm") << replaced(text, "MEANT", meant);
      return run(
          "check '" + (folder_ / "nodes").string() + ending + "' '" + (folder_ / "bonds").string() +
          ending + "' --scene " + (folder_ / "scene.prm").string() + " " + options +
          (options.find("-o ") == std::string::npos ? " -o " + (folder_ / "out").string() : ""));
    }

    fs::path folder_;
    double side_ = 1; ///< of the cube
    int m_ = m;

  private:
    static std::string text(double value) { return base::to_text(value, 17); }
  };

  void shuffle(Dump &dump)
  {
    std::mt19937 random(3);
    std::shuffle(dump.rows.begin(), dump.rows.end(), random);
  }
} // namespace

TEST_F(CheckInSpace, passes_right_weights_however_they_are_written)
{
  struct Right
  {
    std::string rule;
    bool is_tensor;
    std::function<void(Dump &)> change;
    std::string options;
  };
  const auto as_it_is = [](Dump &) {};
  const std::vector<Right> all = {
      {"IPA-AC-R2", false, as_it_is, ""},
      {"IPA-AC-R4", false, as_it_is, ""},
      {"IPA-AC-R2", true, [](Dump &one) { one.has_points = false; }, ""}, // taken at nodes
      {"OPT", true, as_it_is, ""},
      {"IPA-AC-R2", false, shuffle, "--require ac,symmetric,m-matrix"},
      {"IPA-AC-R2", false, [](Dump &one) { one.separator = ";"; }, ""},
      {"IPA-AC-R2", true, [](Dump &one) { one.first_id = 1000; }, ""},
      {"FA", false, as_it_is, "--require moments=0.05"},
      {"PA-AC", true, as_it_is, "--require symmetric"},
      {"GFD", true, as_it_is, ""}, // rules that `all` leaves out
      {"PDDO", false, as_it_is, ""},
      {"GMLS", false, as_it_is, ""}};
  for (const auto &[rule, is_tensor, change, options] : all)
  {
    Dump one = dump(rule, is_tensor);
    change(one);
    write(one);
    const Outcome outcome = check(rule, is_tensor, options);
    EXPECT_EQ(outcome.exit_code, 0) << rule << outcome.out << outcome.err;
    EXPECT_NE(outcome.out.find("the weights are those of " + rule + "\n"), std::string::npos)
        << outcome.out;
  }
}

TEST_F(CheckInSpace, finds_no_missing_volume_where_h_is_about_1)
{
  // 1/h^3, 1/h and 1/c are then within rounding of m of 1, the factor of right weights
  for (const double cell : {.9997, 1., 1.0003})
    for (const std::string rule : {"FA", "LAMMPS"})
    {
      side_ = n * cell;
      Dump one = dump(rule, false);
      for (Point<3> &place : one.places)
        place *= side_;
      for (double &volume : one.volumes)
        volume *= std::pow(side_, 3);
      for (Row &row : one.rows)
      {
        row.weight *= std::pow(side_, 3);
        row.kernel_point *= side_;
      }
      write(one);
      const Outcome outcome = check(rule, false, "--require moments=0.5");
      EXPECT_EQ(outcome.exit_code, 0) << cell << ", " << rule << outcome.out << outcome.err;
      for (Row &row : one.rows)
        row.weight *= 2;
      write(one);
      const Outcome twice = check(rule, false, "--require moments=0.5");
      EXPECT_EQ(twice.exit_code, 1);
      EXPECT_NE(twice.out.find("twice too large"), std::string::npos) << twice.out;
    }
}

TEST_F(CheckInSpace, misses_no_ramp_where_whole_cells_are_meant)
{
  m_ = 3;
  write(dump("FA", true, n, m_));
  const Outcome outcome = check("FA", true, "--require moments=0.9");
  std::ifstream file(folder_ / "out" / "check.json");
  EXPECT_TRUE(nlohmann::json::parse(file).at("causes").empty()) << outcome.out;
}

TEST_F(CheckInSpace, needs_neither_rules_nor_a_problem)
{
  for (const bool is_tensor : {false, true})
  {
    write(dump("IPA-AC-R2", is_tensor));
    const Outcome whole = check("IPA-AC-R2", is_tensor);
    std::ifstream file(folder_ / "scene.prm");
    std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    for (const std::string section : {"subsection Problem", "subsection Methods"})
    {
      const auto from = text.find(section);
      text.erase(from, text.find("end\n", from) + 4 - from);
    }
    std::ofstream(folder_ / "short.prm") << text;
    const Outcome outcome =
        run("check " + (folder_ / "nodes.csv").string() + " " + (folder_ / "bonds.csv").string() +
            " --scene " + (folder_ / "short.prm").string() + " -o " + (folder_ / "out").string());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, whole.out);
  }
}

// At a fixed horizon / h what is off is the same at all levels.
TEST_F(CheckInSpace, takes_a_series_of_files)
{
  const std::string options = "--set Study/h=0.2,0.1 -o " + (folder_ / "out").string();
  for (const std::string rule : {"FA", "IPA-AC-R2"})
  {
    for (const auto &[n_cells, size] : {std::pair(5, "0.2"), std::pair(10, "0.1")})
    {
      write(dump(rule, false, n_cells));
      for (const std::string file : {"nodes", "bonds"})
        fs::rename(folder_ / (file + ".csv"), folder_ / (file + "_" + size + ".csv"));
    }
    const Outcome outcome = check(rule, false, options, "_{h}.csv");
    const bool is_right = rule != "FA";
    EXPECT_EQ(outcome.exit_code, is_right ? 0 : 1) << outcome.out << outcome.err;
    for (const std::string size : {"0.2", "0.1"})
      EXPECT_EQ(outcome.out.find("h = " + size + ": required ac: ") == std::string::npos, is_right)
          << outcome.out;
    expect_found(outcome.out, "not checked in three dimensions: ");
    const auto records = read_json(folder_ / "out" / "check.json")["study"]["records"];
    ASSERT_EQ(records.size(), 2u);
    const auto defect = [&](std::size_t level)
    { return records[level]["scalars"]["second moment defect"]["value"].get<double>(); };
    for (const std::size_t level : {0u, 1u})
    {
      EXPECT_NEAR(records[level]["key"]["h"], level == 0 ? .2 : .1, 1e-12);
      EXPECT_EQ(records[level]["key"]["level"], level);
      EXPECT_NEAR(defect(level), is_right ? 0 : .0119, is_right ? 1e-12 : 5e-5);
    }
    EXPECT_NEAR(defect(0), defect(1), 1e-12);
    const Outcome one = check(rule, false, options + " --budget 1e-9 --json", "_{h}.csv");
    const Outcome all = check(rule, false, options + " --budget 1e9", "_{h}.csv");
    EXPECT_EQ(all.out, outcome.out);
    const auto json = parse_json(one.out);
    EXPECT_EQ(json["levels"].size(), 1u);
    ASSERT_EQ(json["study"]["left_out"].size(), 1u);
    expect_found(json["study"]["left_out"][0], " CPU s"); // of what the level before it took
    const std::string table = read(folder_ / "out" / "levels.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  }
}

TEST_F(CheckInSpace, takes_stiffnesses_and_force_constants)
{
  constexpr double delta = m * h;
  const double c = 45 / (2 * dealii::numbers::PI * std::pow(delta, 5)); // integral of C x^2: 1
  for (const std::string rule : {"IPA-AC-R2", "IPA-AC-R4"})
    for (const bool are_forces : {false, true})
    {
      Dump one = dump(rule, false);
      for (Row &row : one.rows)
        row.weight *=
            c * (1 - row.kernel_point.norm() / delta) * (are_forces ? one.volumes[row.i] : 1);
      write(one);
      const std::string kind = are_forces ? "'force constants'" : "stiffness";
      const Outcome right = check(rule, false, "--bonds-are " + kind);
      EXPECT_EQ(right.exit_code, 0) << rule << kind << right.out << right.err;
      EXPECT_NE(right.out.find("the weights are those of " + rule + "\n"), std::string::npos)
          << kind << right.out;
      EXPECT_EQ(check(rule, false).exit_code, 1) << rule << kind; // they are not weights
    }
}

namespace
{
  using Change = std::function<void(Dump &)>;

  Change times(double factor)
  {
    return [factor](Dump &one)
    {
      for (Row &row : one.rows)
        row.weight *= factor;
    };
  }

  /// Each bond by itself.
  Change each(const std::function<void(Row &, const Dump &)> &change)
  {
    return [change](Dump &one)
    {
      for (Row &row : one.rows)
        change(row, one);
    };
  }

  Point<3> vector_of(const Row &row, const Dump &one)
  {
    return Point<3>(one.places[row.j] - one.places[row.i]);
  }

  Change without(const std::function<bool(const Row &, const Dump &)> &is_left_out)
  {
    return [is_left_out](Dump &one)
    {
      one.rows.erase(std::remove_if(one.rows.begin(), one.rows.end(),
                                    [&](const Row &row) { return is_left_out(row, one); }),
                     one.rows.end());
    };
  }

  struct Wrong
  {
    std::string rule, meant;
    bool is_tensor;
    Change change;
    std::string words;
    int ratio = m; ///< of horizon and h
  };

  /// Of the list and of each weight.
  std::vector<Wrong> wrong_lists()
  {
    constexpr double delta = 3 * h;
    const double c = kernel_of(false, delta).constant();
    const auto stiffness = each([=](Row &row, const Dump &)
                                { row.weight *= c * (1 - row.kernel_point.norm() / delta); });
    return {
        {"FA", "FA", false, times(0), "cause: all weights are zero"},
        {"IPA-AC-R2", "IPA-AC-R2", true,
         without([](const Row &row, const Dump &) { return row.j < row.i; }),
         "cause: each pair of nodes is listed only once (a half list): list each bond both from i"},
        {"FA", "FA", false, stiffness,
         "like 1 - r/horizon, as the scene's kernel does: the weights already contain the kernel, "
         "which is then applied twice; give volumes as weights, or, if the values are w C, choose "
         "--bonds-are stiffness",
         3},
        {"FA", "FA", true, stiffness, "the weights already contain a kernel or influence", 3},
        {"FA", "FA", true,
         without([](const Row &row, const Dump &one)
                 { return vector_of(row, one).norm() > (m - 1e-6) * h; }),
         "bonds as long as the horizon are left out, r < horizon instead of r <= horizon"},
        {"IPA-AC-R2", "IPA-AC-R2", true,
         each([](Row &row, const Dump &one)
              { row.weight *= 1 + .03 * vector_of(row, one)[2] / h; }),
         "cause: the weights have a drift", 3}};
  }

  /// Of kernel points and volumes.
  std::vector<Wrong> wrong_points()
  {
    return {{"IPA-AC-R2", "IPA-AC-R2", false, [](Dump &one) { one.has_points = false; },
             "cause: the kernel is evaluated at the nodes; IPA-AC-R2 evaluates it at the centroid "
             "of ball and cell; give qx, qy and qz"},
            {"IPA-AC-R2", "IPA-AC-R2", false,
             each([](Row &row, const Dump &) { row.kernel_point *= .5; }),
             "cause: the kernel is evaluated at the midpoints of the bonds"},
            {"IPA-AC-R2", "IPA-AC-R2", false,
             each([](Row &row, const Dump &) { row.kernel_point *= -1; }),
             "cause: the kernel points (qx, qy, qz) are reversed"},
            {"IPA-AC-R2", "IPA-AC-R2", false,
             each([](Row &row, const Dump &one)
                  { row.kernel_point += dealii::Tensor<1, 3>(one.places[row.i]); }),
             "cause: the kernel points (qx, qy, qz) are absolute positions"},
            {"IPA-AC-R2", "IPA-AC-R2", true,
             [](Dump &one) { one.volumes.assign(one.volumes.size(), h * h); },
             "cause: the volumes are 5 times the volumes of their cells, as areas h^2 in place of "
             "volumes h^3, h = 0.2; the weights do not carry that factor"},
            {"FA", "FA", true,
             [](Dump &one)
             {
               times(1e9)(one);
               one.volumes.assign(one.volumes.size(), 1e9 * h * h * h);
             },
             "cause: the volumes are 1e+09 times the volumes of their cells, as in units of length "
             "1/1000 of the scene's, mm for m, and all weights carry the same factor"}};
  }

  /// Of factors that all weights carry.
  std::vector<Wrong> wrong_factors()
  {
    constexpr double pi = dealii::numbers::PI, ball = 4 * pi / 3 * m * m * m;
    const double c = kernel_of(false, m * h).constant();
    return {{"IPA-AC-R2", "IPA-AC-R2", false, times(2),
             "cause: all weights are twice too large, as if made for the limit -Laplace, not -0.5 "
             "Laplace; each pair may be counted from both ends"},
            {"IPA-AC-R2", "IPA-AC-R2", true, times(.5),
             "cause: all weights are half of what they should be; each pair may be shared"},
            {"IPA-AC-R2", "IPA-AC-R2", true, times(-1), "cause: all weights have the wrong sign"},
            {"FA", "FA", true, times(1 / h), "cause: all weights are areas, h^2 in place of h^3"},
            {"FA", "FA", true, times(1 / (h * h * h)), "cause: all weights lack the volume h^3"},
            {"FA", "FA", true, times(h * h * h),
             "cause: all weights contain the volume h^3 of the neighbour's cell twice, h = 0.2; if "
             "they are force constants, choose --bonds-are 'force constants'"},
            {"IPA-AC-R2", "IPA-AC-R2", false, times(1 / c),
             "cause: all weights lack the kernel's constant c = "},
            {"FA", "FA", true, times(4. * m / 3),
             "cause: all weights carry the factor 4 m/3 = 2.667, the volume of a ball"},
            {"IPA-AC-R2", "IPA-AC-R2", true, times(.8 * m),
             "cause: all weights carry the factor 1.6, the bond constant of plane strain"},
            {"IPA-AC-R2", "IPA-AC-R2", true, times(.75 * m),
             "cause: all weights carry the factor 1.5, the bond constant of plane stress"},
            {"IPA-AC-R2", "IPA-AC-R2", false, times(8. / 9 * m),
             "cause: all weights carry the factor 1.778, the kernel's constant in a plate"},
            {"FA", "FA", true, times(ball / 32),
             "cause: the weights of a node add up to the whole ball: its own volume is included"},
            {"OPT", "OPT", true, times(1.1), "cause: all weights carry a common factor of 1.1"},
            {"FA", "LAMMPS", true, [](Dump &) {}, "the partial volumes of LAMMPS are missing at "}};
  }

  /// Of single bonds and nodes.
  std::vector<Wrong> outliers()
  {
    return {{"IPA-AC-R2", "IPA-AC-R2", true, [](Dump &one) { one.rows[1234].weight *= 1.5; },
             "outlier: the bond from node"},
            {"IPA-AC-R2", "IPA-AC-R2", true,
             [](Dump &one) { one.rows.erase(one.rows.begin() + 77); }, " is missing; a weight of "},
            {"IPA-AC-R2", "IPA-AC-R2", false,
             [](Dump &one) { one.rows[777].kernel_point[2] += .3 * h; }, " takes the kernel at ("},
            {"IPA-AC-R2", "IPA-AC-R2", false,
             [](Dump &one) { one.volumes[one.rows[999].i] *= 1.7; },
             "outlier: the volume of node "}};
  }
} // namespace

TEST_F(CheckInSpace, names_what_is_wrong)
{
  for (const auto &group : {wrong_lists(), wrong_points(), wrong_factors(), outliers()})
    for (const auto &[rule, meant, is_tensor, change, words, ratio] : group)
    {
      Dump one = dump(rule, is_tensor, n, ratio);
      change(one);
      write(one);
      const Outcome outcome =
          check(meant, is_tensor, "--set Study/m=" + std::to_string(ratio) + " --json");
      EXPECT_EQ(outcome.exit_code, 1) << words << outcome.out << outcome.err;
      expect_found(outcome.out, words);
    }
}

TEST_F(CheckInSpace, takes_stiffnesses_as_its_remedy_says)
{
  constexpr double delta = 3 * h;
  Dump one = dump("FA", false, n, 3);
  for (Row &row : one.rows)
    row.weight *= kernel_of(false, delta).constant() * (1 - row.kernel_point.norm() / delta);
  one.rows.erase(std::remove_if(one.rows.begin(), one.rows.end(),
                                [&](const Row &row)
                                { return row.kernel_point.norm() > delta * (1 - 1e-9); }),
                 one.rows.end()); // the kernel is 0 there
  write(one);
  const Outcome outcome =
      check("FA", false, "--set Study/m=3 --bonds-are stiffness --require moments=.05");
  EXPECT_EQ(outcome.out.find("already contain"), std::string::npos) << outcome.out;
  expect_found(outcome.out, "the weights are those of FA");
}

// no rule raises an alarm, on lattices and on scattered nodes, where it is asked for what it has
TEST_F(CheckInSpace, finds_nothing_in_right_weights)
{
  for (const double moved : {0., .3})
    for (const bool is_tensor : {false, true})
      for (const std::string rule : {"FA", "LAMMPS", "IPA-AC", "IPA-AC-R2"})
      {
        if (moved > 0 && is_tensor == (rule == "IPA-AC"))
          continue; // kernel points of scalars differ, those of tensors are the same
        write(moved > 0 ? scattered_dump(rule, is_tensor, moved) : dump(rule, is_tensor));
        const Outcome outcome =
            check(rule, is_tensor,
                  "--json" + std::string(rule == "IPA-AC-R2" ? "" : " --require moments=1"));
        EXPECT_EQ(outcome.exit_code, 0) << rule << moved << outcome.out << outcome.err;
        expect_found(outcome.out, "the weights are those of " + rule + "\"");
        expect_found(outcome.out, "\"complaints\": []");
      }
}

TEST_F(CheckInSpace, names_what_is_wrong_on_scattered_nodes)
{
  struct WrongOnNodes
  {
    Change change;
    std::string words;
  };
  const std::vector<WrongOnNodes> all = {
      {times(2), "cause: all weights are twice too large"},
      {each([](Row &row, const Dump &one)
            { row.weight *= one.volumes[row.i] / one.volumes[row.j]; }),
       "cause: the weights are made with the volume of node i itself"},
      {without([](const Row &row, const Dump &) { return row.j < row.i; }), "(a half list)"},
      {[](Dump &one) { one.rows[1234].weight *= 1.5; }, "outlier: the bond from node"}};
  const auto expect_named =
      [&](const Dump &right, const std::string &rule, bool is_tensor, const WrongOnNodes &wrong)
  {
    Dump one = right;
    wrong.change(one);
    write(one);
    const Outcome outcome = check(rule, is_tensor, "--json --require moments=1");
    EXPECT_EQ(outcome.exit_code, 1) << wrong.words << outcome.out << outcome.err;
    expect_found(outcome.out, wrong.words);
  };
  const Dump right = scattered_dump("FA", true, .3);
  for (const WrongOnNodes &one : all)
    expect_named(right, "FA", true, one);
  const auto to_neighbour =
      each([](Row &row, const Dump &one)
           { row.kernel_point -= dealii::Tensor<1, 3>(vector_of(row, one)); });
  expect_named(scattered_dump("IPA-AC-R2", false, .3), "IPA-AC-R2", false,
               {to_neighbour, "cause: the kernel points (qx, qy, qz) are relative to node j"});
}

TEST_F(CheckInSpace, asks_whether_the_scene_is_that_of_the_bonds)
{
  write(dump("IPA-AC-R2", false));
  for (const auto &[set, words] :
       {std::pair{"--set Study/h=0.1", "the nodes' spacing is 0.2, but h is 0.1"},
        std::pair{"--set Study/m=4", "the longest bond is 0.489898, but the horizon is 0.8"}})
  {
    const Outcome outcome = check("IPA-AC-R2", false, set);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    expect_found(outcome.out, std::string("do h and horizon belong to these bonds? ") + words);
    EXPECT_EQ(outcome.out.find("cause: "), std::string::npos) << outcome.out;
  }
}

TEST_F(CheckInSpace, writes_a_page_and_tables_as_in_the_plane)
{
  Dump one = dump("IPA-AC-R2", true);
  one.rows[1234].weight *= 1.5;
  write(one);
  const Outcome outcome = check("IPA-AC-R2", true);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const std::string nodes = read(folder_ / "out" / "nodes.csv"),
                    outliers = read(folder_ / "out" / "outliers.csv"),
                    page = read(folder_ / "out" / "report.html");
  EXPECT_EQ(nodes.find("id,x,y,z,volume,cell_volume,bonds,second_moment_ratio"), 0u);
  EXPECT_EQ(std::count(nodes.begin(), nodes.end(), '\n'), n * n * n + 1);
  EXPECT_EQ(outliers.find("node,neighbour,line,found,expected,what"), 0u);
  EXPECT_EQ(std::count(outliers.begin(), outliers.end(), '\n'), 2);
  expect_found(outliers, "1.5 times");
  for (const std::string part : {"Outliers", "Moments", "Elastic constants", "C1212"})
    expect_found(page, part);
}

TEST_F(CheckInSpace, takes_periodic_boxes)
{
  // as dump() has them, on a torus of 8 nodes an edge
  constexpr int edge = 8;
  constexpr double size = 1. / edge;
  const auto kernel = physics::Kernel<3>::with_diffusion(
      physics::kernel_type("linear-decay").profile, m * size, .5);
  const auto family = lattice_bonds(meshfree::find_rule("IPA-AC-R2", "rule").in_space(kernel),
                                    kernel, size, geometry::Backend::fast)
                          .family;
  const std::string periodic = "--boundary periodic --set Study/h=0.125 --require ac,symmetric";
  for (const double offset : {.5, 0.})
    for (const bool has_crossing : {true, false})
    {
      Dump one;
      for (int k = 0; k < edge * edge * edge; ++k)
      {
        const std::array<int, 3> at = {k % edge, k / edge % edge, k / edge / edge};
        one.places.emplace_back((at[0] + offset) * size, (at[1] + offset) * size,
                                (at[2] + offset) * size);
        one.volumes.push_back(size * size * size);
        for (const Bond<3> &bond : family)
        {
          std::array<int, 3> to{};
          bool crosses_z = false;
          for (unsigned int d = 0; d < 3; ++d)
          {
            const int target = at[d] + static_cast<int>(std::lround(bond.xi[d] / size));
            to[d] = (target + edge) % edge;
            crosses_z = d == 2 && to[d] != target;
          }
          if (has_crossing || !crosses_z)
            one.rows.push_back(
                {k, to[0] + edge * (to[1] + edge * to[2]), bond.weight, bond.kernel_point});
        }
      }
      write(one);
      const Outcome outcome = check("IPA-AC-R2", false, periodic);
      EXPECT_EQ(outcome.exit_code, has_crossing ? 0 : 1) << outcome.out << outcome.err;
      expect_found(outcome.out, has_crossing
                                    ? "512 in the periodic box"
                                    : "no bond crosses the sides of the periodic box in z: ");
      if (!has_crossing)
        continue;
      expect_found(outcome.out, "the weights are those of IPA-AC-R2\n");
      one.rows.erase(std::remove_if(one.rows.begin(), one.rows.end(),
                                    [](const Row &row) { return row.j < row.i; }),
                     one.rows.end());
      write(one); // the last node has no bond then
      expect_found(check("IPA-AC-R2", false, periodic).out,
                   "cause: each pair of nodes is listed only once (a half list)");
      EXPECT_NE(check("IPA-AC-R2", false, "--set Study/h=0.125").exit_code, 0); // not periodic
    }
}

TEST_F(CheckInSpace, gives_elastic_constants_and_json)
{
  write(dump("IPA-AC-R2", true));
  const Outcome outcome = check("IPA-AC-R2", true);
  // kappa = 1: mu = lambda = 3/5
  for (const std::string line :
       {"C1111             1.8         1.8         1.8         1.8", "C1122             0.6 ",
        "C1212             0.6 ", "moduli    E = 1.5, nu = 0.25 (medians over the nodes)"})
    expect_found(outcome.out, line);
  const Outcome json = check("IPA-AC-R2", true, "--json -o " + (folder_ / "out").string());
  EXPECT_EQ(json.exit_code, 0);
  EXPECT_NE(json.out.find("\"second_moment\""), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "out" / "check.json"));
}

TEST_F(CheckInSpace, tells_moduli_that_are_off)
{
  write(dump("FA", true));
  const Outcome outcome = check("FA", true);
  // sums over 32 neighbours by hand
  expect_found(outcome.out, "C1111 is off by 3.13 %");
  expect_found(outcome.out, "C1212 is off by -11.9 %");
  expect_found(outcome.out, "is 0.7968 instead of 1");
  expect_found(outcome.out, "FA itself has these moduli at m = 2");
  Dump half = dump("FA", true);
  for (Row &row : half.rows)
    row.weight /= 2;
  write(half);
  EXPECT_EQ(check("FA", true).out.find("itself has these moduli"), std::string::npos);
}

TEST_F(CheckInSpace, refuses_files_that_cannot_be_used)
{
  const Dump right = dump("FA", false);
  const auto expect_refused = [&](const std::string &words, const std::string &options = "")
  {
    const Outcome outcome = check("FA", false, options);
    EXPECT_EQ(outcome.exit_code, 2) << words;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  };
  write(right);
  std::ofstream(folder_ / "nodes.csv") << "id,x,y,volume\n1,0.1,0.1,0.008\n";
  expect_refused("has no column z");
  std::ofstream(folder_ / "nodes.csv") << "id,x,y,z,volume\n1,0.1,0.1,0.1,0.008\n"
                                          "2,0.1,0.1,0.1,0.008\n";
  expect_refused("node 2 lies at (0.1, 0.1, 0.1), where that of line 2 is");
  Dump one = right;
  one.rows[3].j = one.rows[3].i;
  write(one);
  expect_refused("with itself; take it out");
  one = right;
  one.rows[3] = one.rows[2];
  write(one);
  expect_refused("already; take one of them out, or add their weights");
  one = right;
  one.volumes[7] = -1;
  write(one);
  expect_refused("is not positive");
  one = right;
  one.rows[3].j = 99999;
  write(one);
  expect_refused("is no node of '");
}
