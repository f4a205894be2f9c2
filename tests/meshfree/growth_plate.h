// Plates that cracks grow in, for tests.
#pragma once

#include "meshfree/fracture/breaking_network.h"
#include "meshfree/rules/rules.h"
#include "scene/scene.h"

namespace growth_plate
{
  using namespace plumbline;
  using dealii::Point;
  using dealii::Tensor;

  constexpr double h = .05;

  /// A plate of n1 × n2 nodes about y = 0 with a notch from the left, its upper and lower rows held
  /// and pulled apart by 1 at load 1.
  inline meshfree::BreakingSolid<2> plate(int n1, int n2, double notch, double nu, int m = 3)
  {
    const double length = n1 * h, half = .5 * n2 * h, grip = m * h;
    meshfree::BreakingSolid<2> solid;
    solid.domain.include = {{{0, -half}, {length, half}}};
    solid.grips = {{{0, half - grip}, {length, half}}, {{0, -half}, {length, grip - half}}};
    if (notch > 0)
      solid.notch = {{{-h, 0}, {notch, 0}}};
    solid.constrained = [](const Point<2> &x)
    {
      Tensor<1, 2> u;
      u[1] = x[1] > 0 ? .5 : -.5;
      return u;
    };
    solid.material = [nu](const Point<2> &)
    { return physics::lame_from_young(1, nu, physics::PlaneState::strain); };
    solid.toughness = [](const Point<2> &) { return 1.; };
    return solid;
  }

  inline physics::Kernel<2> influence(double horizon)
  {
    return physics::influence_function<2>(physics::kernel_type("1/r").profile, horizon);
  }

  inline meshfree::BondNetwork<2> network(const meshfree::BreakingSolid<2> &solid, int m = 3)
  {
    const auto K = influence(m * h);
    return make_bond_network(solid, meshfree::full_area(physics::deviatoric_kernel(K, 1)), K, h,
                             geometry::Backend::fast);
  }

  inline problem::FractureSettings rules(problem::BreakMode breaking = problem::BreakMode::events)
  {
    problem::FractureSettings result;
    result.breaking = breaking;
    result.least_reaction = 0; // until it has parted
    return result;
  }
} // namespace growth_plate
