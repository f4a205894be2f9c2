// Explicit steps beside Debian's LAMMPS (lmp) in one run: the same nodes and the same bonds of
// horizon 3 h, prescribed small velocities, velocity Verlet, one thread, CPU time. Bond updates a
// second are directed bonds that LAMMPS counts, over the time of a step, for both. The work
// differs: LAMMPS evaluates finite stretches with a square root for each bond, tests whether the
// bond breaks, and adds short-range contact; ours is the linear force of small displacements and
// bonds that do not break, which a lattice does by convolution or directly with one stencil.
// Scattered nodes have the motion of a scene: forces, masses of cells of unequal volumes, update.
// Not counted, on either side: what is done once, such as finding bonds.
//
// Run: build/release/benchmarks/lammps [NODES_ALONG_AN_AXIS [STEPS]]
//
// Ends with 1 if the numbers of bonds differ.

#include "algebra/operator.h"
#include "analysis/transient.h"
#include "base/cost.h"
#include "meshfree/lattice/stencil.h"
#include "meshfree/rules/rules.h"
#include "meshfree/scattered/motion.h"
#include "meshfree/scattered/operator.h"
#include "physics/state_based.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/lac/vector.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

using namespace plumbline;

namespace
{
  using Nodes = std::vector<dealii::Point<3>>;
  using Values = std::vector<double>;

  constexpr double horizon = 3.0001; // with the nodes at 3 h
  constexpr double density = 1, bulk = 1, shear = .5, step = 1e-3, speed = 1e-8;
  constexpr int n_repetitions = 3;

  /// A lattice of spacing 1, each node moved by up to so much along each axis; x fastest.
  Nodes make_nodes(int n, double moved)
  {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-moved, moved);
    Nodes nodes;
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          nodes.emplace_back(i + uniform(random), j + uniform(random), k + uniform(random));
    return nodes;
  }

  /// Between 0.8 and 1.2.
  Values make_volumes(std::size_t n)
  {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> uniform(.8, 1.2);
    Values volumes;
    for (std::size_t i = 0; i < n; ++i)
      volumes.push_back(uniform(random));
    return volumes;
  }

  double median(Values values)
  {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  }

  double children_seconds()
  {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  }

  struct Peer
  {
    double seconds = 0; ///< a step
    double n_bonds = 0; ///< directed
  };

  /// LAMMPS' steps: CPU time of a run with so many less that of one with few.
  Peer run_lammps(const Nodes &nodes, const Values &volumes, int n, const std::string &pair,
                  int n_steps)
  {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("plumbline-lammps-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    {
      std::ofstream data(folder / "nodes");
      data.precision(17);
      data << "nodes\n\n" << nodes.size() << " atoms\n1 atom types\n";
      for (const char axis : {'x', 'y', 'z'})
        data << -1. << ' ' << n << ' ' << axis << "lo " << axis << "hi\n";
      data << "\nAtoms\n\n";
      for (std::size_t i = 0; i < nodes.size(); ++i)
        data << i + 1 << " 1 " << volumes[i] << ' ' << density << ' ' << nodes[i] << '\n';
    }
    Peer peer;
    const auto seconds = [&](int steps)
    {
      std::ofstream input(folder / "in");
      input << "units si\nboundary f f f\natom_style peri\natom_modify map array\nread_data "
            << (folder / "nodes").string() << "\n"
            << pair << "\nneighbor 0.01 bin\ncomm_modify cutoff 8\n"
            << "velocity all create " << speed << " 87287 loop geom\nfix 1 all nve\n"
            << "timestep " << step << "\nthermo 1000\nrun " << steps << "\n";
      input.close();
      const double before = children_seconds();
      const std::string command = "OMP_NUM_THREADS=1 lmp -in " + (folder / "in").string() +
                                  " -log none -nocite >" + (folder / "out").string() +
                                  " 2>&1 </dev/null";
      if (std::system(command.c_str()) != 0)
      {
        std::cerr << std::ifstream(folder / "out").rdbuf() << "lmp failed (package lammps)\n";
        std::filesystem::remove_all(folder);
        std::exit(2);
      }
      return children_seconds() - before;
    };
    Values differences;
    constexpr int few = 1;
    for (int i = 0; i < n_repetitions; ++i)
      differences.push_back((seconds(few + n_steps) - seconds(few)) / n_steps);
    peer.seconds = median(differences);
    std::ifstream out(folder / "out");
    for (std::string line; std::getline(out, line);)
      if (const auto at = line.find("total # of bonds = "); at != std::string::npos)
        peer.n_bonds = std::stod(line.substr(at + 19));
    std::filesystem::remove_all(folder);
    return peer;
  }

  /// Ours: CPU time of a step of velocity Verlet.
  double seconds_of_step(const analysis::Motion &motion, int n_steps)
  {
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0, speed);
    Values times;
    for (int i = 0; i < n_repetitions; ++i)
    {
      analysis::State state{Values(motion.n), Values(motion.n), 0};
      for (double &v : state.v)
        v = normal(random);
      const base::CpuTimer timer;
      analysis::integrate(motion, analysis::scheme("velocity Verlet"), {step}, n_steps * step,
                          state);
      times.push_back(timer.seconds() / n_steps);
    }
    return median(times);
  }

  /// Unit masses.
  analysis::Motion motion_by(const algebra::Action &stiffness, std::size_t n_unknowns)
  {
    return {n_unknowns, [stiffness](const Values &u, double, Values &a)
            {
              stiffness(u, a);
              for (double &value : a)
                value /= -density;
            }};
  }

  /// @return  both have as many bonds
  bool report(const char *what, double n_own, double seconds, const Peer &peer, double wanted)
  {
    constexpr double rounding = 1e-6; // relative: LAMMPS prints its number so
    const double ratio = peer.seconds / seconds;
    std::printf("%-44s %.3ge6 directed bonds (LAMMPS %.3ge6): %7.2f ms per step, %.3fe9 bonds/s; "
                "LAMMPS %7.2f ms, %.4fe9 bonds/s: %.1f times as fast (target %g)\n",
                what, 1e-6 * n_own, 1e-6 * peer.n_bonds, 1e3 * seconds,
                1e-9 * peer.n_bonds / seconds, 1e3 * peer.seconds,
                1e-9 * peer.n_bonds / peer.seconds, ratio, wanted);
    std::fflush(stdout);
    return std::abs(n_own - peer.n_bonds) <= rounding * n_own;
  }

  /// Directed bonds between the nodes of a lattice.
  double count_bonds(int n)
  {
    double sum = 0;
    const int reach = static_cast<int>(horizon);
    for (int k = -reach; k <= reach; ++k)
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i)
          if (const int square = i * i + j * j + k * k; square > 0 && square <= horizon * horizon)
            sum += static_cast<double>(n - std::abs(i)) * (n - std::abs(j)) * (n - std::abs(k));
    return sum;
  }

  /// Bonds of scattered nodes, kernel at the node.
  meshfree::FamilySource<3> scattered_families(const Nodes &nodes, const Values &volumes, int n)
  {
    return [&nodes, &volumes, n](std::size_t node, meshfree::Family<3> &family)
    {
      family = {};
      const int reach = static_cast<int>(horizon) + 1, own = static_cast<int>(node);
      const std::array<int, 3> at = {own % n, own / n % n, own / (n * n)};
      const auto from = [&](unsigned int d) { return std::max(0, at[d] - reach); };
      const auto to = [&](unsigned int d) { return std::min(n - 1, at[d] + reach); };
      for (int k = from(2); k <= to(2); ++k)
        for (int j = from(1); j <= to(1); ++j)
          for (int i = from(0); i <= to(0); ++i)
          {
            const auto other = static_cast<unsigned int>(i + n * (j + n * k));
            const dealii::Point<3> xi(nodes[other] - nodes[node]);
            if (other == node || xi.norm() > horizon)
              continue;
            family.neighbours.push_back(other);
            family.bonds.push_back({xi, volumes[other], xi, volumes[other]});
          }
    };
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const int n = argc > 1 ? std::atoi(argv[1]) : 41, n_steps = argc > 2 ? std::atoi(argv[2]) : 20;
  char pmb[200], lps[200];
  std::snprintf(pmb, sizeof pmb, "pair_style peri/pmb\npair_coeff * * 1.0 %g 1e10 0.0", horizon);
  std::snprintf(lps, sizeof lps, "pair_style peri/lps\npair_coeff * * %g %g %g 1e10 0.0", bulk,
                shear, horizon);
  const Nodes lattice = make_nodes(n, 0), scattered = make_nodes(n, .3);
  const Values ones(lattice.size(), 1), volumes = make_volumes(scattered.size());
  const geometry::BoxNodes box{{n, n, n}};

  const auto kernel = physics::Kernel<3>::with_bulk_modulus(
      physics::kernel_type("bond-tensor").profile, horizon, bulk);
  const auto apply = [&](const algebra::Stencil &stencil)
  {
    std::vector<std::size_t> all(stencil.n_blocks() * box.n_positions());
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = i;
    const std::size_t size = all.size();
    return algebra::restrict(make_operator(stencil, box), size, std::move(all));
  };
  const std::size_t n_unknowns = 3 * box.n_positions();
  const auto bonds =
      meshfree::lattice_bonds(meshfree::full_area(kernel), kernel, 1, geometry::Backend::fast);
  std::puts("LAMMPS: finite stretches, a square root for each bond, breakage, short-range contact; "
            "ours: linear forces, bonds that do not break");
  bool is_same = report(
      "bonds, lattice", count_bonds(n),
      seconds_of_step(motion_by(apply(meshfree::lattice_operator(kernel, bonds)), n_unknowns),
                      5 * n_steps),
      run_lammps(lattice, ones, n, pmb, n_steps), 10);

  const physics::Dilatation<3> solid{physics::influence_function<3>({{1, -1}}, horizon),
                                     [](const auto &) {
                                       return physics::Lame{bulk - 2 * shear / 3, shear};
                                     },
                                     false, true};
  const auto deviatoric = physics::deviatoric_kernel(solid.influence, shear);
  is_same &= report(
      "linear peridynamic solid, lattice", count_bonds(n),
      seconds_of_step(
          motion_by(apply(meshfree::state_based_stencil(
                        solid, meshfree::lattice_bonds(meshfree::full_area(deviatoric), deviatoric,
                                                       1, geometry::Backend::fast))),
                    n_unknowns),
          5 * n_steps),
      run_lammps(lattice, ones, n, lps, n_steps), 10);

  const auto cells = std::make_shared<geometry::NodeCells<3>>();
  cells->nodes = scattered;
  cells->area = volumes;
  cells->n_free = scattered.size();
  const auto rows = meshfree::bond_rows<3>(scattered_families(scattered, volumes, n), kernel, 3,
                                           {0, cells->n_free}, [](auto &&...) {});
  algebra::CsrMatrix none;
  none.start.resize(rows.start.size());
  const auto equation = meshfree::move_nodes<3>(
      cells, 3, rows, none, [](const problem::Problem<3> &) { return Values(); });
  const analysis::Transient transient(*equation, analysis::TimeSeries(Values(equation->size())),
                                      density, 0);
  is_same &=
      report("bonds, scattered, whole steps",
             static_cast<double>(rows.column.size()) / 9 - static_cast<double>(scattered.size()),
             seconds_of_step(transient.motion(), n_steps),
             run_lammps(scattered, volumes, n, pmb, n_steps), 3);
  if (!is_same)
    std::fputs("the bonds are not as many in both\n", stderr);
  return is_same ? 0 : 1;
}
