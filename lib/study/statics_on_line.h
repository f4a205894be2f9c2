#pragma once

#include "method/interval_discretisation.h"
#include "study/statics.h"

#include <string>

// Static solutions on intervals, Domain/dimension = 1.
namespace plumbline::study
{
  struct SolutionOnLine : method::FieldOnLine
  {
    base::Cost cost;
    method::Diagnostics diagnostics;
  };

  /// @pre  the method is a MethodOnIntervals that can do the kernel
  /// @throws NumericalError  there is no solution
  SolutionOnLine solve_on_line(const Method &method, const problem::Problem<1> &problem);

  /// Why a method cannot do a scene on intervals, and which can; empty: it can.
  std::string refusal_on_line(const Method &method, const scene::Scene &scene,
                              const Methods &available);

  /// The problems and references of a level on intervals, before its first method.
  /// @throws NumericalError  a reference whose error is too large
  void open_statics_on_line(const Place &place, const Methods &available,
                            const StaticsOptions &options);

  /// Static solutions on intervals by one method at one level, a record for each case, as
  /// statics_analysis() has them in the plane. Each rank does all of it.
  /// @param available  for the reference
  Records statics_on_line(const Place &place, const Method &method, const Methods &available,
                          const StaticsOptions &options);
} // namespace plumbline::study
