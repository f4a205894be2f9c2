// Weights of another code in space: right ones pass, wrong ones are named with their cause.
#include "command.h"

#include "base/number_text.h"
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

  /// A rule's weights on a lattice of n cells along a side, with nodes around the unit cube.
  Dump dump(const std::string &name, bool is_tensor, const int n = ::n)
  {
    const double h = 1. / n;
    const auto kernel = is_tensor ? physics::Kernel<3>::with_bulk_modulus(
                                        physics::kernel_type("bond-tensor").profile, m * h, 1)
                                  : physics::Kernel<3>::with_diffusion(
                                        physics::kernel_type("linear-decay").profile, m * h, .5);
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
      std::ofstream(folder_ / "scene.prm") << replaced(text, "MEANT", meant);
      return run("check '" + (folder_ / "nodes").string() + ending + "' '" +
                 (folder_ / "bonds").string() + ending + "' --scene " +
                 (folder_ / "scene.prm").string() + " " + options);
    }

    fs::path folder_;

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
            " --scene " + (folder_ / "short.prm").string());
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
    const auto records = read_json(folder_ / "out" / "check.json")["records"];
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

TEST_F(CheckInSpace, names_what_is_wrong)
{
  struct Wrong
  {
    std::string rule, meant;
    bool is_tensor;
    std::function<void(Dump &)> change;
    std::string words;
  };
  const auto times = [](double factor)
  {
    return [factor](Dump &one)
    {
      for (Row &row : one.rows)
        row.weight *= factor;
    };
  };
  const std::vector<Wrong> all = {
      {"FA", "FA", false, [](Dump &) {}, "second moments by 1.19 %"},
      {"IPA-AC-R2", "IPA-AC-R2", false, times(2), "cause: all weights are doubled"},
      {"IPA-AC-R2", "IPA-AC-R2", true, times(.5), "cause: all weights are halved"},
      {"IPA-AC-R2", "IPA-AC-R2", true, times(-1), "cause: all weights are negated"},
      {"FA", "FA", true, times(1 / h), "cause: all weights are areas, h^2 in place of h^3"},
      {"FA", "FA", true, times(1 / (h * h * h)), "cause: all weights lack the volume h^3"},
      {"OPT", "OPT", true, times(1.1), "cause: all weights are 1.1 times those of OPT"},
      {"FA", "LAMMPS", true, [](Dump &) {}, "the ramp of LAMMPS at the horizon is missing"},
      {"IPA-AC-R2", "IPA-AC-R2", false, [](Dump &one) { one.has_points = false; },
       "cause: the kernel is not taken where"},
      {"IPA-AC-R2", "IPA-AC-R2", true,
       [](Dump &one)
       {
         for (double &volume : one.volumes)
           volume = h * h;
       },
       "cause: the volumes are 5 times h^3, h = 0.2: they are areas, h^2"},
      {"IPA-AC-R2", "IPA-AC-R2", true,
       [](Dump &one)
       {
         one.rows.erase(std::remove_if(one.rows.begin(), one.rows.end(),
                                       [](const Row &row) { return row.j < row.i; }),
                        one.rows.end());
       },
       "cause: each pair of nodes is listed once"},
      {"IPA-AC-R2", "IPA-AC-R2", true, [](Dump &one) { one.rows[1234].weight *= 1.5; },
       "outlier: the bond from node"},
      {"IPA-AC-R2", "IPA-AC-R2", true, [](Dump &one) { one.rows.erase(one.rows.begin() + 77); },
       "lacks 1 of the"}};
  for (const auto &[rule, meant, is_tensor, change, words] : all)
  {
    Dump one = dump(rule, is_tensor);
    change(one);
    write(one);
    const Outcome outcome = check(meant, is_tensor);
    EXPECT_EQ(outcome.exit_code, 1) << words << outcome.out << outcome.err;
    expect_found(outcome.out, words);
  }
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
                                    ? "512 nodes in the periodic box"
                                    : "no bond crosses the sides of the periodic box in z: ");
      if (!has_crossing)
        continue;
      expect_found(outcome.out, "the weights are those of IPA-AC-R2\n");
      one.rows.erase(std::remove_if(one.rows.begin(), one.rows.end(),
                                    [](const Row &row) { return row.j < row.i; }),
                     one.rows.end());
      write(one); // the last node has no bond then
      expect_found(check("IPA-AC-R2", false, periodic).out,
                   "cause: each pair of nodes is listed once: a half list");
      EXPECT_NE(check("IPA-AC-R2", false, "--set Study/h=0.125").exit_code, 0); // not periodic
    }
}

TEST_F(CheckInSpace, gives_elastic_constants_and_json)
{
  write(dump("IPA-AC-R2", true));
  const Outcome outcome = check("IPA-AC-R2", true);
  // kappa = 1: mu = lambda = 3/5
  for (const std::string line :
       {"C1111: 1.8 (1.8 ... 1.8)", "C1122: 0.6 (0.6", "C1212: 0.6 (0.6", "nu: 0.25 (0.25"})
    EXPECT_NE(outcome.out.find(line), std::string::npos) << outcome.out;
  const Outcome json = check("IPA-AC-R2", true, "--json -o " + (folder_ / "out").string());
  EXPECT_EQ(json.exit_code, 0);
  EXPECT_NE(json.out.find("\"second moment defect\""), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "out" / "check.json"));
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
  expect_refused("line 3: node 2 lies where that of line 2 is");
  Dump one = right;
  one.rows[3].j = one.rows[3].i;
  write(one);
  expect_refused("has a bond with itself");
  one = right;
  one.rows[3] = one.rows[2];
  write(one);
  expect_refused("is given already; give every bond once");
  one = right;
  one.volumes[7] = -1;
  write(one);
  expect_refused("is not positive");
  one = right;
  one.rows[3].j = 99999;
  write(one);
  expect_refused("is the id of no node");
  write(right);
  expect_refused("the spacing of the nodes is 0.2, but the nearest level of the scene has h = 0.1",
                 "--set Study/h=0.1");
}
