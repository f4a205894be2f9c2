#include "physics/elastic_constants.h"

#include <gtest/gtest.h>

using namespace plumbline::physics;

// an isotropic medium of E = 200 and ν = .3, by its Lamé constants
TEST(ElasticConstants, of_an_isotropic_medium_are_its_own)
{
  constexpr double E = 200, nu = .3, mu = E / (2 * (1 + nu)),
                   lambda = E * nu / ((1 + nu) * (1 - 2 * nu)),
                   in_plane = 2 * mu * lambda / (lambda + 2 * mu); // of plane stress
  const auto expect = [&](const EngineeringConstants &found)
  {
    EXPECT_NEAR(found.E, E, 1e-12);
    EXPECT_NEAR(found.nu, nu, 1e-15);
    EXPECT_NEAR(found.shear_along, mu, 1e-12);
    EXPECT_NEAR(found.shear_across, mu, 1e-12);
    EXPECT_NEAR(found.anisotropy, 1, 1e-14);
  };
  expect(engineering_constants({lambda + 2 * mu, lambda, mu}, ElasticState::plane_strain));
  expect(engineering_constants({lambda + 2 * mu, lambda, mu}, ElasticState::solid));
  expect(engineering_constants({in_plane + 2 * mu, in_plane, mu}, ElasticState::plane_stress));
}

TEST(ElasticConstants, of_a_cubic_medium_differ_along_and_across_its_axes)
{
  const auto found = engineering_constants({10, 4, 6}, ElasticState::solid);
  EXPECT_DOUBLE_EQ(found.anisotropy, 2);
  EXPECT_DOUBLE_EQ(found.E, (10. - 4) * (10 + 2 * 4) / (10 + 4));
}

TEST(ElasticConstants, bonds_are_made_for_a_modulus)
{
  for (const ElasticState state :
       {ElasticState::plane_stress, ElasticState::plane_strain, ElasticState::solid})
  {
    const double mu = .6 * bulk_modulus_of_bonds(7, state); // λ = μ = 3κ/5
    EXPECT_NEAR(engineering_constants({3 * mu, mu, mu}, state).E, 7, 1e-14);
  }
}
