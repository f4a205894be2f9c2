#pragma once

#include "check/requirements.h"
#include "meshfree/check/bond_values.h"

namespace plumbline::check
{
  /// Moves nodes into a periodic box, adds their images, and computes cells and spacing.
  /// @param level        of the nodes
  /// @param is_periodic  omega is periodic
  /// @return             weights without families and volumes
  /// @throws InputError  no node in Ω, as geometry::PeriodicBox::take_in and check_sides
  meshfree::GivenWeights<3> with_cells(meshfree::GivenNodes<3> nodes, const geometry::Cuboid &omega,
                                       bool is_periodic, const problem::Level &level);

  /// The findings for weights whose families have been read.
  /// @param values  as the other code has them
  /// @param found   has its level
  /// @param meant   rules that the weights are intended to follow
  void find_defects(meshfree::BondValues values, meshfree::GivenWeights<3> weights,
                    const physics::Kernel<3> &kernel, const std::vector<std::string> &meant,
                    Findings<3> &found);

  /// @pre     scene.domain.is_in_space()
  /// @throws InputError  files that cannot be used
  Findings<3> find_in_space(const scene::Scene &scene, const Input &input);

  /// The findings as a record, for a study of levels.
  study::Record record_of(const Findings<3> &found);
} // namespace plumbline::check
