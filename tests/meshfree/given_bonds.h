// Weights of our own rules as another code could give them, to be spoilt.
#pragma once

#include "meshfree/check/bond_outliers.h"
#include "meshfree/rules/families.h"
#include "meshfree/rules/rules.h"
#include "scene/problem.h"
#include "scene/scene.h"

#include <stdexcept>

namespace plumbline::meshfree
{
  constexpr double node_distance = .125; ///< h on lattices; nodes are moved from there

  inline problem::Problem<2> nodes_for(double m, double perturbation, const std::string &kernel)
  {
    const bool is_tensor = kernel == "bond-tensor";
    const auto scene = scene::parse_scene(
        "given.prm",
        "subsection Domain\n set mesh = squares\nend\nsubsection Methods\n set names = FA\n set "
        "perturbation = " +
            std::to_string(perturbation) + "\nend\nsubsection Kernel\n set type = " + kernel +
            (is_tensor ? "\n set limit = Navier" : "") +
            "\nend\nsubsection Problem\n set solution = x" + (is_tensor ? ", y" : "") + "\nend\n");
    return scene::make_problem(scene, 0, {node_distance, m * node_distance});
  }

  /// Families and volumes that own what they refer to.
  struct Weights
  {
    problem::Problem<2> problem;
    std::vector<Family<2>> families;
    std::vector<double> volumes;

    GivenBonds<2> given() const { return {families, problem.kernel, *problem.cells(), volumes}; }
  };

  inline Weights weights_of(const std::string &rule, const problem::Problem<2> &problem)
  {
    Weights result{problem, {}, problem.cells()->area};
    result.families =
        rule_families(rule, GivenBonds<2>{{}, problem.kernel, *problem.cells(), result.volumes});
    for (Family<2> &family : result.families)
      for (std::size_t k = 0; k < family.bonds.size(); ++k)
        family.bonds[k].area = result.volumes[family.neighbours[k]];
    return result;
  }

  /// Index of a bond of a free node about as long as 1.4 h, to another free node.
  inline std::size_t some_bond(const Weights &weights, std::size_t node)
  {
    const Family<2> &family = weights.families[node];
    for (std::size_t k = 0; k < family.bonds.size(); ++k)
      if (family.neighbours[k] < weights.families.size() &&
          std::abs(family.bonds[k].xi.norm() / node_distance - 1.5) < .4)
        return k;
    throw std::logic_error("no bond of that length");
  }
} // namespace plumbline::meshfree
