#pragma once

#include "method/method.h"
#include "scene/capabilities.h"
#include "scene/problem.h"

namespace plumbline::study
{
  using method::Method;
  using method::Methods;

  /// Why a method cannot do a scene, which others can, and what to write instead; empty: it can.
  /// @param one        of any case and level
  /// @param available  the others are among them
  std::string refusal(const Method &method, const scene::Case &one, const Methods &available);

  /// Methods by capabilities, as a table in Markdown; methods that can do the same share a row.
  std::string capability_table(const Methods &methods);
} // namespace plumbline::study
