#pragma once

#include "method/diagnostics.h"
#include "study/study_results.h"

#include <map>
#include <string>
#include <vector>

// The record of a static solution: errors are scalars named "norm | target", e.g. "nodal Linf |
// exact"; what the method says of itself are scalars and texts, forces at crack tips a curve.
namespace plumbline::study
{
  /// By "norm | target".
  std::map<std::string, double> errors_of(const Record &record);

  /// Maximum minus minimum cell average of a component; 0: not known. A constant counts for
  /// nothing, as for the operator.
  double size_of(const Record &record);

  /// What an error is relative to: size_of() in its norm, or of truncation errors the load.
  double size_of(const Record &record, const std::string &error);

  /// Errors up to this are round-off, see study/round_off.h and study/truncation.h; 0: not known.
  double round_off_of(const Record &record, const std::string &error);

  /// Of Ω: the L2 norm of a constant 1 is its root; 1 where it is not known [length^2].
  double area_of(const Record &record);

  /// What making the mesh and, for meshfree methods, the cells of nodes took. Methods of a level
  /// share it; it is in no cost [CPU s].
  double geometry_seconds(const Record &record);

  /// Neighbours and weights, and conditions on their moments, as far as they are known.
  void set_weights(Record &record, const Diagnostics &diagnostics);

  void set_limit(Record &record, const LimitProof &limit);
  LimitProof limit_of(const Record &record);

  void set_tip_forces(Record &record, const std::vector<method::TipForce> &forces);
  std::vector<method::TipForce> tip_forces_of(const Record &record);

  /// Everything that a method says about its own solution.
  void set_diagnostics(Record &record, const Diagnostics &diagnostics);
} // namespace plumbline::study
