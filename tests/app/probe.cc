// Force constants from the forces of another program, which is a script here, and what `check` says
// of them.
#include "command.h"

#include "base/number_text.h"
#include "meshfree/rules/rules.h"

#include <nlohmann/json.hpp>

#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <set>
#include <thread>

namespace
{
  using namespace plumbline;
  using namespace plumbline::app;
  using dealii::Point;
  using meshfree::Bond;

  constexpr int m = 2;

  /// awk -f code.awk NODES BONDS: forces by the force constants of bonds, of nodes in reverse
  /// order.
  const std::string code = R"(
    BEGIN { FS = "," }
    NR == 1 { dim = int(NF / 2) }
    FNR == 1 { next }
    NR == FNR {
      id[NR] = $1
      for (d = 1; d <= dim; ++d) { place[$1, d] = $(1 + d); moved[$1, d] = $(1 + dim + d) }
      last = NR
      next
    }
    {
      along = square = 0
      for (d = 1; d <= dim; ++d) {
        xi[d] = place[$2, d] - place[$1, d]
        square += xi[d] ^ 2
        along += xi[d] * (moved[$2, d] - moved[$1, d])
      }
      for (d = 1; d <= dim; ++d)
        force[$1, d] += $3 * along / square * (1 + cubic * along ^ 2) * xi[d] / (volume ? volume : 1)
    }
    END {
      print dim == 2 ? "id,fx,fy" : "id,fx,fy,fz"
      for (k = last; k > 1; --k) {
        printf "%s", id[k]
        for (d = 1; d <= dim; ++d)
          printf ",%.17g", force[id[k], d]
        print ""
      }
    })";

  std::string scene(int dim, const std::string &rule)
  {
    const bool is_in_space = dim == 3;
    return std::string("subsection Domain\n") +
           (is_in_space ? " set dimension = 3\n set boxes = 0, 0, 0 : 1, 1, 1\n" : "") +
           "end\nsubsection Kernel\n set type = bond-tensor\n set limit = Navier\nend\n"
           "subsection Problem\n set solution = " +
           (is_in_space ? "x, y, z" : "x, y") + "\nend\nsubsection Methods\n set names = " + rule +
           "\nend\nsubsection Study\n set h = 0.5\n set m = 2\n set norms = nodal Linf\nend\n";
  }

  template <int dim>
  std::vector<Bond<dim>> family_of(const std::string &name, const physics::Kernel<dim> &kernel,
                                   double h)
  {
    const meshfree::Rule rule = meshfree::find_rule(name, "rule");
    if constexpr (dim == 2)
      return lattice_bonds(rule.in_plane(kernel), kernel, h, geometry::Backend::fast).family;
    else
      return lattice_bonds(rule.in_space(kernel), kernel, h, geometry::Backend::fast).family;
  }

  class Probe : public testing::Test
  {
  protected:
    Probe() : folder_(temporary("probe")) { fs::create_directories(folder_); }
    ~Probe() override { fs::remove_all(folder_); }

    std::string path(const std::string &name) const { return (folder_ / name).string(); }

    /// A program with a rule's weights on the unit square or cube of n^dim nodes and around it.
    template <int dim>
    void write_program(const std::string &rule, int n) const
    {
      const double h = 1. / n, volume = std::pow(h, dim);
      const auto kernel = physics::Kernel<dim>::with_bulk_modulus(
          physics::kernel_type("bond-tensor").profile, m * h, 1);
      const auto family = family_of<dim>(rule, kernel, h);
      std::ofstream nodes(path("nodes.csv")), bonds(path("bonds.csv"));
      std::ofstream(path("scene.prm")) << scene(dim, rule);
      std::ofstream(path("code.awk")) << code;
      nodes << (dim == 2 ? "id,x,y,volume\n" : "id,x,y,z,volume\n");
      bonds << "i,j,weight\n";
      const int width = n + 2 * m;
      std::array<int, 3> at{};
      const auto id = [&](const std::array<int, 3> &of)
      { return 10 + of[0] + width * (of[1] + width * of[2]); };
      for (at[2] = 0; at[2] < (dim == 3 ? width : 1); ++at[2])
        for (at[1] = 0; at[1] < width; ++at[1])
          for (at[0] = 0; at[0] < width; ++at[0])
          {
            nodes << id(at);
            for (unsigned int d = 0; d < dim; ++d)
              nodes << ',' << base::to_text((at[d] - m + .5) * h, 17);
            nodes << ',' << base::to_text(volume, 17) << '\n';
            for (const Bond<dim> &bond : family)
            {
              std::array<int, 3> to = at;
              bool is_there = true;
              for (unsigned int d = 0; d < dim; ++d)
              {
                to[d] += static_cast<int>(std::lround(bond.xi[d] / h));
                is_there = is_there && to[d] >= 0 && to[d] < width;
              }
              if (is_there)
                bonds << id(at) << ',' << id(to) << ','
                      << base::to_text(volume * bond.weight * radial_value(kernel, bond), 17)
                      << '\n';
            }
          }
    }

    Outcome probe(const std::string &command, const std::string &options) const
    {
      return run("probe " + path("nodes.csv") + " --command \"" + command + "\" -o " +
                 path("probed.csv") + " " + options);
    }

    std::string program(const std::string &options = "") const
    {
      return "awk -f " + path("code.awk") + " " + options + " {nodes} " + path("bonds.csv") +
             " > {forces}";
    }

    Outcome check(const std::string &more) const
    {
      return run("check " + path("nodes.csv") + " " + path("probed.csv") + " --scene " +
                 path("scene.prm") + " --bonds-are 'force constants' " + more);
    }

    /// Force constants in a file by the nodes of their bonds.
    std::map<std::string, double> constants(const std::string &name) const
    {
      std::map<std::string, double> result;
      std::ifstream file(path(name));
      std::string line;
      std::getline(file, line);
      EXPECT_EQ(line, "i,j,weight");
      while (std::getline(file, line))
        result[line.substr(0, line.rfind(','))] = std::stod(line.substr(line.rfind(',') + 1));
      return result;
    }

    /// All bonds of so many nodes that have a force constant.
    void expect_recovered(std::size_t n_nodes) const
    {
      const auto expected = constants("bonds.csv"), found = constants("probed.csv");
      const auto node = [](const std::string &bond) { return bond.substr(0, bond.find(',')); };
      std::set<std::string> nodes;
      for (const auto &[bond, constant] : found)
        nodes.insert(node(bond));
      EXPECT_EQ(nodes.size(), n_nodes);
      double largest = 0;
      for (const auto &[bond, constant] : expected)
        largest = std::max(largest, std::abs(constant));
      std::size_t n_bonds = 0;
      for (const auto &[bond, constant] : expected)
      {
        const bool is_probed = nodes.count(node(bond)) > 0 &&
                               std::abs(constant) > 1e-9 * largest; // OPT has weights of 0
        EXPECT_EQ(found.count(bond), is_probed ? 1u : 0u) << bond;
        n_bonds += is_probed ? 1 : 0;
        if (is_probed)
        {
          EXPECT_NEAR(found.at(bond), constant, 1e-9 * largest) << bond;
        }
      }
      EXPECT_EQ(found.size(), n_bonds);
    }

    void expect_refused(const std::string &command, const std::string &words,
                        const std::string &options = "--horizon 0.5") const
    {
      const Outcome outcome = probe(command, options);
      EXPECT_EQ(outcome.exit_code, 2) << command << outcome.out << outcome.err;
      EXPECT_NE(outcome.err.find(words), std::string::npos) << command << '\n' << outcome.err;
      EXPECT_EQ(outcome.out, "");
      EXPECT_FALSE(fs::exists(path("probed.csv")));
    }

    /// @return  a command that runs a script with the two files as $1 and $2
    std::string script(const std::string &text) const
    {
      std::ofstream(path("script")) << text << '\n';
      return "sh " + path("script") + " {nodes} {forces}";
    }

    fs::path folder_;
  };
} // namespace

TEST_F(Probe, recovers_weights_in_the_plane_and_check_judges_them)
{
  for (const auto &[rule, exit_code] : {std::pair{"OPT", 0}, std::pair{"FA", 1}})
  {
    write_program<2>(rule, 2);
    const Outcome outcome = probe(program(), "--horizon 1");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("warning"), std::string::npos) << outcome.out;
    expect_recovered(4);
    const Outcome judged = check("-o " + path("check"));
    EXPECT_EQ(judged.exit_code, exit_code) << judged.out << judged.err;
    expect_found(judged.out, std::string("the weights are those of ") + rule);
  }
}

TEST_F(Probe, recovers_weights_in_space_and_check_judges_them)
{
  for (const auto &[rule, exit_code] : {std::pair{"OPT", 0}, std::pair{"FA", 1}})
  {
    write_program<3>(rule, 2);
    const Outcome outcome = probe(program(), "--horizon 1");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_found(outcome.out, "8 displaced");
    expect_found(outcome.out, "55 of the command");
    expect_recovered(8);
    const Outcome judged = check("-o " + path("check"));
    EXPECT_EQ(judged.exit_code, exit_code) << judged.out << judged.err;
    expect_found(judged.out, std::string("the weights are those of ") + rule + "\n");
  }
}

TEST_F(Probe, takes_force_densities)
{
  write_program<2>("FA", 2);
  const Outcome outcome =
      probe(program("-v volume=0.25"), "--horizon 1 --forces-are densities --nodes 1 --quiet");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  expect_recovered(4);
}

TEST_F(Probe, warns_of_pairs_whose_forces_differ)
{
  write_program<2>("FA", 2);
  // the nodes of the four in the middle have the ids 24, 25, 30 and 31
  std::string bonds = read(path("bonds.csv"));
  bonds.insert(bonds.find("24,25,") + 6, "1"); // its force constant gets larger
  std::ofstream(path("bonds.csv")) << bonds;
  const Outcome outcome = probe(program(), "--horizon 1");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "warning: the force constants k_ij and k_ji of nodes 24 and 25 differ");
  expect_found(outcome.out, "warning: the forces due to the displacement of one node sum to");
  expect_recovered(4);
}

TEST_F(Probe, refuses_commands_that_do_not_give_forces)
{
  write_program<2>("FA", 2);
  expect_refused("true {forces}", "has no {nodes}, which stands for the displaced nodes");
  expect_refused("true {nodes}", "has no {forces}");
  expect_refused("no-such-program {nodes} {forces}", "failed with exit code 127");
  expect_refused(script("echo out of licences; exit 3"), "failed with exit code 3");
  expect_refused(script("echo out of licences; exit 3"), "it printed:\nout of licences");
  expect_refused(script("kill -SEGV $$"), "failed with exit code 139");
  expect_refused("true {nodes} {forces}", "wrote no forces; write CSV with the columns fx,fy");
  expect_refused("cp {nodes} {forces}", "has no column fx");
  expect_refused(script("head -3 $1 | sed s/u/f/g >$2"), "has forces of 2 of the 36 nodes");
  expect_refused(script("sed s/u/f/g $1 >$2; tail -1 $1 >>$2"), "is given already");
  expect_refused(script("(echo fx,fy; yes 0,0 | head -37) >$2"), "more than the 36 nodes");
  expect_refused(script("(echo fx,fy; yes 0,nan | head -36) >$2"), "line 2");
  expect_refused(script("(echo fx,fy; yes 0,none | head -36) >$2"), "none");
  expect_refused(script("(echo id,fx,fy; yes 7,0,0 | head -36) >$2"),
                 "id = 7 is the id of no node");
  expect_refused(script("(echo fx,fy; yes 0,0 | head -36) >$2"), "no force changes when");
}

TEST_F(Probe, refuses_what_it_cannot_use)
{
  write_program<2>("FA", 2);
  expect_refused(program(), "the horizon 0.7 is too small", "--horizon 0.7"); // the longest is 1
  expect_refused(program(), "the horizon 0.3 is less than", "--horizon 0.3");
  expect_refused(program(), "--horizon is missing", "");
  expect_refused(program(), "the step of the displacements is 0", "--horizon 1 --step 0");
  expect_refused(program(), "no node is displaced", "--horizon 1 --nodes 0");
  expect_refused(program(), "--forces-are = 'weights' is not known",
                 "--horizon 1 --forces-are weights");
  const std::string across = script(R"(awk -F, '
    NR > 1 { id[NR] = $1; x[NR] = $2; y[NR] = $3; u[NR] = $4; v[NR] = $5 }
    END {
      print "id,fx,fy"
      for (i = 2; i <= NR; i++) {
        f = g = 0
        for (j = 2; j <= NR; j++)
          if ((x[i] - x[j])^2 + (y[i] - y[j])^2 < 1.1) { f += u[j] - u[i]; g += v[j] - v[i] }
        printf "%s,%.17g,%.17g\n", id[i], f, g
      }
    }' $1 >$2)");
  expect_refused(across, "forces are not along the bonds", "--horizon 1");
  std::ofstream(path("nodes.csv")) << "id,x,y\n1,2,3\n";
  expect_refused(program(), "has no column volume");
}

TEST_F(Probe, refuses_forces_that_are_not_linear)
{
  write_program<2>("FA", 2);
  expect_refused(program("-v cubic=1e8"), "forces are not linear in the displacements",
                 "--horizon 1");
}

TEST_F(Probe, refuses_a_folder_as_its_file_before_anything_is_run)
{
  write_program<2>("FA", 2);
  const Outcome outcome =
      run("probe " + path("nodes.csv") + " --command \"" + script("touch " + path("begun")) +
          "\" --horizon 1 -o " + folder_.string());
  EXPECT_EQ(outcome.exit_code, 2);
  expect_found(outcome.err, "is a folder; give the name of a file");
  EXPECT_FALSE(fs::exists(path("begun")));
}

TEST_F(Probe, ends_what_the_command_left_in_the_background)
{
  write_program<2>("FA", 2);
  expect_refused(script("(trap 'touch " + path("ended") +
                        "; exit' TERM; sleep 30 & wait) & "
                        "sleep .3; exit 3"),
                 "failed with exit code 3");
  for (int i = 0; i < 100 && !fs::exists(path("ended")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_TRUE(fs::exists(path("ended")));
}

TEST_F(Probe, writes_no_file_when_interrupted)
{
  write_program<2>("FA", 2);
  const std::string command = script("sed s/u/f/g $1 >$2; touch " + path("begun") + "; sleep .1");
  EXPECT_EQ(interrupt_at("probe " + path("nodes.csv") + " --command '" + command + "' -o " +
                             path("probed.csv") + " --horizon 1",
                         path("begun")),
            130);
  EXPECT_FALSE(fs::exists(path("probed.csv")));
}

TEST_F(Probe, gives_its_findings_to_programs)
{
  write_program<2>("OPT", 2);
  const Outcome text = probe(program(), "--horizon 1"),
                outcome = probe(program(), "--horizon 1 --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_recovered(4);
  const auto found = parse_json(outcome.out);
  EXPECT_EQ(found["analysis"], "probe");
  ASSERT_EQ(found["records"].size(), 1u);
  const auto &record = found["records"][0];
  const auto scalar = [&](const std::string &name) -> double
  { return record["scalars"][name]["value"]; };
  EXPECT_EQ(scalar("dimension"), 2);
  EXPECT_EQ(scalar("displaced nodes"), 4);
  EXPECT_EQ(scalar("bonds"), constants("probed.csv").size());
  expect_found(text.out, "runs       " + std::to_string(static_cast<int>(scalar("runs"))) + " of");
  EXPECT_LT(scalar("asymmetry"), 1e-8);
  EXPECT_LT(scalar("nonlinearity"), 1e-8);
  EXPECT_EQ(record["texts"]["bonds file"], path("probed.csv"));
  EXPECT_TRUE(record["notes"].empty());
  // what is a warning of the text is a note
  const auto uneven =
      parse_json(probe(program("-v cubic=1e8"), "--horizon 1 --step 2e-6 --json").out);
  ASSERT_FALSE(uneven["records"][0]["notes"].empty());
  expect_found(uneven["records"][0]["notes"][0], "force constants change by ");
}
