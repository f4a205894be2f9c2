#pragma once

#include "check/requirements.h"
#include "meshfree/check/bond_values.h"

namespace plumbline::check
{
  /// Takes nodes of a periodic box into it and adds their images, makes cells and spacing.
  /// @param level        that the nodes are of
  /// @param is_periodic  omega is
  /// @return             weights without families and volumes
  /// @throws InputError  no node in Ω, as geometry::PeriodicBox::take_in and check_sides
  meshfree::GivenWeights<3> with_cells(meshfree::GivenNodes<3> nodes, const geometry::Cuboid &omega,
                                       bool is_periodic, const problem::Level &level);

  /// What is found of weights whose families are read.
  /// @param values  as the other code has them
  /// @param found   has its level
  /// @param meant   rules that the weights may be of
  void find_defects(meshfree::BondValues values, meshfree::GivenWeights<3> weights,
                    const physics::Kernel<3> &kernel, const std::vector<std::string> &meant,
                    Findings<3> &found);

  /// @pre     scene.domain.is_in_space()
  /// @throws InputError  files that cannot be used
  Findings<3> find_in_space(const scene::Scene &scene, const Input &input);

  /// The findings as a record, for a study of levels.
  study::Record record_of(const Findings<3> &found);
} // namespace plumbline::check
