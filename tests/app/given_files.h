// Weights of our own rules as the files of another code.
#pragma once

#include "check_command.h"
#include "scene/problem.h"

#include "tests/meshfree/given_bonds.h"

#include <functional>

namespace plumbline::app
{
  using namespace plumbline::meshfree;

  /// Weights of a rule for the scene of the example, on its lattice or on nodes moved from there.
  inline Weights example_weights(const std::string &rule, double perturbation,
                                 const std::vector<plumbline::scene::Override> &more = {})
  {
    std::vector<plumbline::scene::Override> overrides = {
        {"Domain/mesh", "squares"}, {"Methods/perturbation", std::to_string(perturbation)}};
    overrides.insert(overrides.end(), more.begin(), more.end());
    const auto scene = plumbline::scene::read_scene(scene_file, overrides);
    return weights_of(rule,
                      plumbline::scene::make_problem(scene, 0, scene.study.series[0].levels[0]));
  }

  struct Files
  {
    std::string nodes, bonds;
  };

  /// As another code would write them; node k has the id k + 1.
  inline Files files_of(const Weights &weights)
  {
    std::ostringstream nodes, bonds;
    nodes.precision(15);
    bonds.precision(15);
    nodes << "id,x,y,volume\n";
    bonds << "i,j,weight,qx,qy\n";
    const auto &cells = *weights.problem.cells();
    for (std::size_t k = 0; k < cells.size(); ++k)
      nodes << k + 1 << ',' << cells.nodes[k][0] << ',' << cells.nodes[k][1] << ','
            << weights.volumes[k] << '\n';
    for (std::size_t i = 0; i < weights.families.size(); ++i)
      for (std::size_t k = 0; k < weights.families[i].bonds.size(); ++k)
      {
        const Bond<2> &bond = weights.families[i].bonds[k];
        bonds << i + 1 << ',' << weights.families[i].neighbours[k] + 1 << ',' << bond.weight << ','
              << bond.kernel_point[0] << ',' << bond.kernel_point[1] << '\n';
      }
    return {write("given_nodes.csv", nodes.str()), write("given_bonds.csv", bonds.str())};
  }
} // namespace plumbline::app
