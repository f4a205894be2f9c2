// Debian's LAMMPS as a peer: its peri/pmb weights in a plane of nodes, measured by moving one
// neighbour at a time and reading the force, are those of our rule LAMMPS; and `plumbline check`
// says of the real ones that their limit is wrong.

#include "tests/app/command.h"

#include "meshfree/rules/rules.h"

#include <cmath>
#include <cstdio>
#include <map>

namespace
{
  using namespace plumbline;
  using namespace plumbline::app;
  using meshfree::Bond;
  using meshfree::Point;

  /// What lmp prints of a force has 17 digits; a force is eps w / r.
  constexpr double tolerance = 1e-12;

  /// By how much neighbours are moved along the bond, in spacings: forces of the microelastic
  /// model are linear in the stretch.
  constexpr double moved = 1e-2;

  using Place = std::array<int, 2>; ///< of a neighbour, in spacings

  /// Neighbours in one octant, a little beyond the horizon.
  std::vector<Place> octant(double m)
  {
    std::vector<Place> places;
    const int n = static_cast<int>(m + 1.5);
    for (int i = 1; i <= n; ++i)
      for (int j = 0; j <= i; ++j)
        if (std::hypot(i, j) < m + 1.3)
          places.push_back({i, j});
    return places;
  }

  /// Input for lmp: a plane of nodes with spacing 1 and volume 1, bond constant 1.
  std::string input(double m)
  {
    constexpr int n = 13, centre = n / 2;
    char text[4096];
    std::snprintf(text, sizeof text,
                  "units si\ndimension 3\nboundary f f f\natom_style peri\n"
                  "atom_modify map array sort 0 0\nlattice sc 1.0\n"
                  "region b block -0.5 %g -0.5 %g -0.5 0.5\ncreate_box 1 b\ncreate_atoms 1 box\n"
                  "pair_style peri/pmb\npair_coeff * * 1.0 %.17g 1e10 0.0\n"
                  "set group all density 1.0\nset group all volume 1.0\nneighbor 1.0 bin\n"
                  "comm_modify cutoff %.17g\nfix 1 all nve\ntimestep 1e-12\nrun 0 post no\n",
                  n - .5, n - .5, m, m + 2);
    std::string result = text;
    int k = 0;
    for (const auto &[i, j] : octant(m))
    {
      const double r = std::hypot(i, j), dx = moved * i / r, dy = moved * j / r;
      std::snprintf(text, sizeof text,
                    "region r%d block %g %g %g %g INF INF units box\ngroup g%d region r%d\n"
                    "displace_atoms g%d move %.17g %.17g 0 units box\nrun 0 post no\n"
                    "variable f%d equal \"sqrt(fx[%d]^2+fy[%d]^2)\"\n"
                    "print \"W %d %d $(v_f%d:%%25.17g)\"\n"
                    "displace_atoms g%d move %.17g %.17g 0 units box\n",
                    k, centre + i - .1, centre + i + .1, centre + j - .1, centre + j + .1, k, k, k,
                    dx, dy, k, centre * n + centre + 1, centre * n + centre + 1, i, j, k, k, -dx,
                    -dy);
      result += text;
      ++k;
    }
    return result;
  }

  /// Weights over volumes that lmp uses, by place in the octant.
  std::map<Place, double> measured(double m)
  {
    const std::string in = write("lmp.in", input(m));
    const std::string out = temporary("lmp.out").string();
    const int status = std::system(
        ("OMP_NUM_THREADS=1 lmp -in " + in + " -log none -nocite >" + out + " 2>&1 </dev/null")
            .c_str());
    EXPECT_EQ(status, 0) << read(out);
    std::map<Place, double> weights;
    std::istringstream lines(read(out));
    for (std::string line; std::getline(lines, line);)
    {
      std::istringstream words(line);
      std::string mark;
      Place place{};
      double force = 0;
      if (words >> mark >> place[0] >> place[1] >> force && mark == "W")
        weights[place] = force / moved * std::hypot(place[0], place[1]);
    }
    return weights;
  }

  Place in_octant(int i, int j)
  {
    return {std::max(std::abs(i), std::abs(j)), std::min(std::abs(i), std::abs(j))};
  }

  /// Our rule's, on a lattice of spacing 1.
  std::map<Place, double> ours(double m)
  {
    const auto kernel = physics::Kernel<2>::with_bulk_modulus({{1, -1}}, m, 1);
    std::map<Place, double> weights;
    for (const Bond<2> &bond :
         meshfree::lattice_bonds(meshfree::lammps(kernel), kernel, 1, geometry::Backend::fast)
             .family)
      weights[in_octant(static_cast<int>(std::lround(bond.xi[0])),
                        static_cast<int>(std::lround(bond.xi[1])))] = bond.weight;
    return weights;
  }
} // namespace

TEST(Lammps, weights_are_those_of_our_rule)
{
  for (const double m : {3., 3.015, 3.3, 4.})
  {
    const auto theirs = measured(m);
    EXPECT_EQ(theirs.size(), octant(m).size()) << m;
    const auto own = ours(m);
    for (const auto &[place, weight] : theirs)
    {
      const auto found = own.find(place);
      EXPECT_NEAR(weight, found == own.end() ? 0 : found->second, tolerance)
          << "m = " << m << " at " << place[0] << ", " << place[1];
    }
  }
}

TEST(Lammps, check_says_that_the_limit_of_its_weights_is_wrong)
{
  const double m = 3, h = .125;
  const auto weights = measured(m);
  // the unit square in cells of h, and a collar of m cells
  const int n = 8, collar = 3, size = n + 2 * collar;
  std::ostringstream nodes, bonds;
  nodes.precision(17);
  bonds.precision(17);
  nodes << "id,x,y,volume\n";
  bonds << "i,j,weight\n";
  const auto id = [&](int i, int j) { return (j + collar) * size + i + collar; };
  for (int j = -collar; j < n + collar; ++j)
    for (int i = -collar; i < n + collar; ++i)
      nodes << id(i, j) << ',' << (i + .5) * h << ',' << (j + .5) * h << ',' << h * h << '\n';
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      for (int k = -collar; k <= collar; ++k)
        for (int l = -collar; l <= collar; ++l)
          if (const auto found = weights.find(in_octant(k, l));
              found != weights.end() && found->second > 1e-9) // the force is 0 beyond
            bonds << id(i, j) << ',' << id(i + k, j + l) << ',' << found->second * h * h << '\n';
  const std::string files =
      write("lmp_nodes.csv", nodes.str()) + " " + write("lmp_bonds.csv", bonds.str());
  const std::string scene = " --scene " PLUMBLINE_PEERS "/lammps.prm";
  const fs::path folder = temporary("lmp");
  const Outcome outcome = run("check " + files + scene + " -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_found(outcome.out, "the weights are those of LAMMPS");
  expect_found(outcome.out, "trace, the strength of the operator, by -13");
  expect_found(outcome.out, "required ac: second moments are off by 13");
  EXPECT_EQ(outcome.out.find("outlier: "), std::string::npos) << outcome.out;
  EXPECT_EQ(run("check " + files + scene + " --quiet --require consistent").exit_code, 0);
  EXPECT_EQ(run("check " + files + scene + " --quiet --require moments=0.1").exit_code, 1);
}
