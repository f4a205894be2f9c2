#pragma once

#include "method/method.h"
#include "scene/capabilities.h"
#include "scene/problem.h"

namespace plumbline::study
{
  using method::Method;
  using method::Methods;

  /// Why a method cannot do a scene, which others can, and what to write instead; empty: it can.
  /// @param problem    of any case and level
  /// @param available  the others are among them
  std::string refusal(const Method &method, const scene::Scene &scene,
                      const problem::Problem<2> &problem, const Methods &available);

  /// The same of a scene in space.
  std::string refusal_in_space(const Method &method, const scene::Scene &scene,
                               const Methods &available);

  /// As far as the problem says so itself.
  bool can_solve(const Method &method, const problem::Problem<2> &problem);

  /// Methods by capabilities, as a table in Markdown; methods that can do the same share a row.
  std::string capability_table(const Methods &methods);
} // namespace plumbline::study
