// What IPA-AC takes at the centroid of ball ∩ cell and what at the node, model by model: as
// docs/theory/rules.md states it.

#include "growth_plate.h"
#include "meshfree/body/operator.h"
#include "meshfree/lattice/stencil.h"
#include "meshfree/rules/double_well_bonds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
  using namespace plumbline;
  using namespace plumbline::meshfree;
  using dealii::Tensor;
  using physics::Structure;

  constexpr double h = .1, horizon = 2.3 * h;

  Bonds<2> bonds_of(const Kernel<2> &kernel)
  {
    return lattice_bonds(improved_partial_area(kernel), kernel, h, Backend::fast);
  }

  std::array<int, 2> steps(const Bond<2> &bond)
  {
    return {static_cast<int>(std::lround(bond.xi[0] / h)),
            static_cast<int>(std::lround(bond.xi[1] / h))};
  }

  Tensor<1, 2> unit(const Point<2> &x)
  {
    return x / x.norm();
  }

  /// The bond to the cell (1, 2), which the ball cuts askew: its centroid by fine sampling.
  const Bond<2> &cut_bond(const Bonds<2> &bonds)
  {
    return *std::find_if(bonds.family.begin(), bonds.family.end(),
                         [](const Bond<2> &bond) {
                           return steps(bond) == std::array{1, 2};
                         });
  }

  const Kernel<2> influence =
      physics::influence_function<2>(physics::kernel_type("1/r").profile, horizon);
} // namespace

TEST(Centroids, of_cut_cells_are_those_of_ball_and_cell)
{
  const Bond<2> bond = cut_bond(bonds_of({Structure::scalar, {{1, 0}}, horizon, 1}));
  constexpr int n = 1000;
  Tensor<1, 2> sum;
  double n_inside = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      if (const Point<2> x((.5 + (i + .5) / n) * h, (1.5 + (j + .5) / n) * h); x.norm() < horizon)
      {
        sum += x;
        ++n_inside;
      }
  EXPECT_NEAR(bond.weight, n_inside / (n * n) * h * h, 1e-4 * h * h);
  EXPECT_NEAR((bond.kernel_point - sum / n_inside).norm(), 0, 1e-4 * h);
  EXPECT_GT(bond.kernel_point.distance(bond.xi), .05 * h);
  EXPECT_GT((unit(bond.kernel_point) - unit(bond.xi)).norm(), .01); // not along the bond
}

TEST(Centroids, are_where_scalar_kernels_and_bond_tensors_are_taken)
{
  for (const Structure structure : {Structure::scalar, Structure::tensor})
  {
    const Kernel<2> kernel{structure, {{1, 0}, {-1, 1}}, horizon, 1};
    const Bonds<2> bonds = bonds_of(kernel);
    const algebra::Stencil stencil = lattice_operator(kernel, bonds);
    const Bond<2> &bond = cut_bond(bonds);
    const Point<2> &q = bond.kernel_point;
    for (unsigned int a = 0; a < kernel.n_components(); ++a)
      for (unsigned int b = 0; b < kernel.n_components(); ++b)
      {
        const double of_direction = structure == Structure::scalar ? 1 : q[a] * q[b] / q.square();
        EXPECT_NEAR(stencil(a, b, 1, 2), -bond.weight * kernel.radial(q.norm()) * of_direction,
                    1e-13 * std::abs(stencil(a, b, 1, 2)));
      }
  }
}

TEST(Centroids, are_where_double_wells_in_the_plane_are_taken_as_a_whole)
{
  const physics::DoubleWell law(2, std::vector<physics::PowerTerm>{{1, 0}, {-1, 1}}, 1.3, 2.1,
                                horizon);
  const Bonds<2> bonds = bonds_of(law.linear_kernel());
  const Bond<2> &bond = cut_bond(bonds);
  const Point<2> &q = bond.kernel_point;
  for (const WellBond &well : well_bonds(law, bonds))
    if (well.k == steps(bond))
    {
      EXPECT_NEAR(well.strength,
                  law.force_factor() * law.c() * bond.weight * law.influence(q.norm()),
                  1e-13 * well.strength);
      for (unsigned int d = 0; d < 2; ++d) // r and e, and so the strain
        EXPECT_NEAR(well.way[d], std::sqrt(law.beta() / q.norm()) * q[d] / q.norm(),
                    1e-13 * well.way[1]);
    }
}

TEST(Centroids, of_double_wells_on_a_line_are_where_j_alone_is_taken)
{
  const physics::DoubleWell law(1, std::vector<physics::PowerTerm>{{1, 0}, {-1, 1}}, 1.3, 2.1,
                                horizon);
  const std::vector<WellBond> bonds = axis_bonds(law, h, "IPA-AC");
  const auto last =
      std::find_if(bonds.begin(), bonds.end(), [](const WellBond &bond) { return bond.k[0] == 2; });
  ASSERT_NE(last, bonds.end()); // its cell reaches from 1.5 h to 2.5 h, the part in it to 2.3 h
  EXPECT_NEAR(last->strength, law.force_factor() * law.c() * .8 * h * law.influence(1.9 * h),
              1e-13 * last->strength);
  EXPECT_NEAR(last->way[0], std::sqrt(law.beta() / (2 * h)), 1e-13 * last->way[0]);
}

TEST(Centroids, of_state_based_solids_are_where_k_and_the_direction_are_taken_not_dilatations)
{
  const physics::Lame lame{3, 1};
  const physics::Dilatation<2> dilatation{influence, [&](const Point<2> &) { return lame; }, true,
                                          true};
  const Bonds<2> bonds = bonds_of(physics::deviatoric_kernel(influence, lame.mu));
  const algebra::Stencil stencil = state_based_stencil(dilatation, bonds);
  Tensor<2, 2> expected; // at (1, 2)
  for (const Bond<2> &one : bonds.family)
  {
    const double of_one = one.weight * influence.radial(one.kernel_point.norm());
    if (steps(one) == std::array{1, 2})
    {
      const Tensor<1, 2> e = unit(one.kernel_point);
      expected -= 8 * lame.mu * of_one * outer_product(e, e);
    }
    for (const Bond<2> &two : bonds.family)
      if (steps(one)[0] + steps(two)[0] == 1 && steps(one)[1] + steps(two)[1] == 2)
        expected -= (lame.lambda - lame.mu) * of_one * two.weight *
                    influence.radial(two.kernel_point.norm()) *
                    outer_product(Tensor<1, 2>(one.xi), Tensor<1, 2>(two.xi));
  }
  for (unsigned int a = 0; a < 2; ++a)
    for (unsigned int b = 0; b < 2; ++b)
      EXPECT_NEAR(stencil(a, b, 1, 2), expected[a][b], 1e-13 * expected.norm()) << a << b;
}

TEST(Centroids, of_the_variational_model_are_where_the_influence_alone_is_taken)
{
  const Bonds<2> bonds = bonds_of(influence);
  const VariationalMaterial material{[](const Point<2> &) { return 1.; },
                                     [](const Point<2> &) { return 4.; }};
  const VariationalOperator body(
      body_on_vertices(geometry::Lattice({{{{0, 0}, {1, 1}}}, {}}, h), {}, material), influence,
      bonds);
  for (const Neighbour &one : body.family())
    if (one.k == std::array{1, 2})
    {
      const Bond<2> &bond = cut_bond(bonds);
      EXPECT_NEAR(one.weight, bond.weight / (h * h) * influence.radial(bond.kernel_point.norm()),
                  1e-13 * one.weight);
      EXPECT_NEAR((one.d - bond.xi).norm(), 0, 1e-15);
    }
}

TEST(Centroids, of_cracks_that_grow_are_where_stiffness_is_taken_not_stretches)
{
  const Kernel<2> of_plate = growth_plate::influence(2.3 * growth_plate::h),
                  deviatoric = physics::deviatoric_kernel(of_plate, 1);
  const BondNetwork<2> net = make_bond_network(
      growth_plate::plate(12, 12, 3 * growth_plate::h, .35), improved_partial_area(deviatoric),
      of_plate, growth_plate::h, Backend::fast);
  const Bonds<2> all =
      lattice_bonds(improved_partial_area(deviatoric), deviatoric, growth_plate::h, Backend::fast);
  std::size_t n_seen = 0;
  for (const Bond<2> &bond : all.family)
    for (const BondNetwork<2>::Bond &one : net.bonds)
      if ((one.xi - bond.xi).norm() < 1e-9 * growth_plate::h)
      {
        ++n_seen;
        const double share = bond.weight * of_plate.radial(bond.kernel_point.norm());
        EXPECT_NEAR(one.share, share, 1e-12 * share);
        EXPECT_NEAR((one.way - unit(bond.kernel_point)).norm(), 0, 1e-13);
      }
  EXPECT_GT(n_seen, 100u);
}
