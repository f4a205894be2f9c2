// `plumbline probe` on Debian's LAMMPS: the weights that it derives from the forces of peri/pmb are
// those of our rule LAMMPS. The input files are those that the documentation shows.

#include "tests/app/command.h"

#include "base/csv.h"
#include "meshfree/rules/rules.h"

#include <array>
#include <cmath>
#include <map>

namespace
{
  using namespace plumbline;
  using namespace plumbline::app;
  using meshfree::Bond;

  /// Differences of forces that are not linear in displacements of 1e-5 horizons, here relative to
  /// the largest force constant.
  constexpr double tolerance = 1e-9;

  constexpr double h = .5;
  constexpr int n = 8; ///< nodes along each axis, whose middle ones have whole families to 3 h

  /// lmp on a square or cubic lattice, with the bond constant of our kernel.
  template <int dim>
  class Lammps
  {
  public:
    explicit Lammps(int m)
        : folder_(temporary("lammps")),
          kernel_(physics::Kernel<dim>::with_bulk_modulus({{1, -1}}, m * h, 1))
    {
      fs::create_directories(folder_);
      std::ofstream nodes(path("nodes.csv"));
      nodes << "id,x,y,z,volume\n";
      int id = 0;
      for (int k = 0; k < (dim == 3 ? n : 1); ++k)
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i)
            nodes << ++id << ',' << i * h << ',' << j * h << ',' << k * h << ',' << std::pow(h, dim)
                  << '\n';
    }
    ~Lammps() { fs::remove_all(folder_); }
    Lammps(const Lammps &) = delete;
    Lammps &operator=(const Lammps &) = delete;

    std::string path(const std::string &name) const { return (folder_ / name).string(); }

    Outcome probe() const
    {
      std::ostringstream arguments;
      arguments.precision(17);
      arguments << "probe " << path("nodes.csv")
                << " --command \"" PLUMBLINE_DOCS "/lammps/forces.sh {nodes} {forces} -var nz "
                << (dim == 3 ? n : 1) << " -var volume " << std::pow(h, dim) << " -var horizon "
                << kernel_.horizon() << " -var c " << kernel_.radial(1)
                << "\" --forces-are densities --horizon " << kernel_.horizon() << " -o "
                << path("bonds.csv");
      return run(arguments.str());
    }

    /// Our rule's force constants by the bonds' vectors in spacings.
    std::map<std::array<long, dim>, double> expected() const
    {
      std::map<std::array<long, dim>, double> result;
      for (const Bond<dim> &bond :
           lattice_bonds(meshfree::lammps(kernel_), kernel_, h, geometry::Backend::fast).family)
      {
        std::array<long, dim> place{};
        for (unsigned int d = 0; d < dim; ++d)
          place[d] = std::lround(bond.xi[d] / h);
        result[place] = std::pow(h, dim) * bond.weight * radial_value(kernel_, bond);
      }
      return result;
    }

  private:
    fs::path folder_;
    physics::Kernel<dim> kernel_;
  };

  template <int dim>
  void expect_our_weights(const Lammps<dim> &lammps)
  {
    const auto expected = lammps.expected();
    double largest = 0;
    for (const auto &[place, constant] : expected)
      largest = std::max(largest, constant);
    base::Csv bonds(lammps.path("bonds.csv"), {"i", "j", "weight"});
    std::size_t n_bonds = 0;
    while (bonds.next())
    {
      ++n_bonds;
      std::array<long, dim> place{};
      long i = bonds.integer("i") - 1, j = bonds.integer("j") - 1;
      for (long &one : place)
      {
        one = j % n - i % n;
        i /= n;
        j /= n;
      }
      const auto found = expected.find(place);
      ASSERT_NE(found, expected.end()) << bonds.line();
      EXPECT_NEAR(bonds.number("weight"), found->second, tolerance * largest) << bonds.line();
    }
    EXPECT_EQ(n_bonds, expected.size() * (dim == 3 ? 8 : 4));
  }
} // namespace

TEST(LammpsProbe, derives_the_weights_of_our_rule_in_the_plane)
{
  const Lammps<2> lammps(2);
  const Outcome outcome = lammps.probe();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_our_weights(lammps);
}

TEST(LammpsProbe, derives_the_weights_of_our_rule_in_space)
{
  for (const int m : {2, 3})
  {
    const Lammps<3> lammps(m);
    const Outcome outcome = lammps.probe();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("warning"), std::string::npos) << outcome.out;
    expect_our_weights(lammps);
    // the eight nodes in the middle are those of a cube
    std::ofstream(lammps.path("scene.prm"))
        << "subsection Domain\n set dimension = 3\n"
           " set boxes = 1.25, 1.25, 1.25 : 2.25, 2.25, 2.25\nend\n"
           "subsection Kernel\n set type = bond-tensor\n set limit = Navier\nend\n"
           "subsection Problem\n set solution = x, y, z\nend\n"
           "subsection Methods\n set names = LAMMPS\nend\n"
           "subsection Study\n set h = 0.5\n set norms = nodal Linf\n set m = "
        << m << "\nend\n";
    const Outcome judged =
        run("check " + lammps.path("nodes.csv") + " " + lammps.path("bonds.csv") +
            " --bonds-are 'force constants' --scene " + lammps.path("scene.prm") + " -o " +
            lammps.path("check"));
    EXPECT_EQ(judged.exit_code, 1) << judged.err;
    expect_found(judged.out, "the weights are those of LAMMPS\n");
    expect_found(judged.out, "required ac: second moments are off by");
  }
}
