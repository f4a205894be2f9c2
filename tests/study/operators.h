#pragma once

#include "meshfree/method.h"
#include "method/discretisation.h"
#include "reference/method.h"
#include "scene/problem.h"
#include "study/stability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

/// Operators of methods on small scenes.
namespace plumbline::study
{
  using analysis::measure;
  using method::DiscreteOperator;

  inline scene::Scene make_scene(bool is_tensor, const std::string &more = "")
  {
    return scene::parse_scene(
        "test.prm",
        std::string("subsection Methods\n set names = all\nend\n") +
            (is_tensor ? "subsection Kernel\n set type = bond-tensor\n set limit = Navier\nend\n"
                         "subsection Problem\n set solution = x, y\nend\n"
                       : "subsection Problem\n set solution = x\nend\n") +
            more);
  }

  inline const std::string squares = "subsection Domain\n set mesh = squares\nend\n";

  /// Of either side.
  inline std::shared_ptr<const method::Method> method_of(const std::string &name)
  {
    method::Methods methods = meshfree::methods();
    for (const auto &method : reference::methods())
      methods.push_back(method);
    return *std::find_if(methods.begin(), methods.end(),
                         [&](const auto &one) { return one->name() == name; });
  }

  inline DiscreteOperator operator_of(const std::string &name, const scene::Scene &scene,
                                      const problem::Level &level)
  {
    const problem::Problem<2> problem = scene::make_problem(scene, 0, level);
    return method_of(name)->discretise(problem)->matrix();
  }

  inline method::Diagnostics diagnostics_of(const std::string &name, const scene::Scene &scene,
                                            const problem::Level &level)
  {
    const problem::Problem<2> problem = scene::make_problem(scene, 0, level);
    return method_of(name)->discretise(problem)->diagnostics();
  }
} // namespace plumbline::study
