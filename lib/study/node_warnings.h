#pragma once

#include "method/method.h"
#include "scene/problem.h"

#include <string>
#include <vector>

namespace plumbline::study
{
  /// Of a case that is discretised by nodes: features of the material between nodes
  /// (unseen_features), and, where any of the methods has bonds, cracks that end on bonds
  /// (geometry::TipOnBonds). One sentence each, without its full stop.
  std::vector<std::string> node_warnings(const scene::Case &one, const method::Methods &methods);
} // namespace plumbline::study
