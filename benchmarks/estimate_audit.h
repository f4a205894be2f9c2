#pragma once

#include "analysis/statics.h"
#include "scene/problem.h"
#include "study/results.h"

#include <string>
#include <vector>

/// Error estimates of Galerkin solutions beside their errors.
namespace plumbline::audit
{
  /// One solution's error and estimate in one norm.
  struct Entry
  {
    std::string problem, method; ///< problem: case and what the estimate is made of
    std::string norm;            ///< "averages" or "field", both L2
    double h, truth, estimate;
    double size;                   ///< of the solution's averages (L2)
    unsigned int certified_digits; ///< of the averages
    study::ErrorEstimate details;

    bool is_bound() const { return truth <= estimate; }
    double ratio() const { return estimate / truth; }
  };

  /// Full and, on meshes, cheap estimates of one solution in both norms; without errors that are
  /// round-off. Where no solution is known the error is the distance to one of h / n and one more
  /// degree.
  /// @param seconds  out: of the solution [CPU s]
  /// @throws as Method::solve
  std::vector<Entry> audit(const scene::Case &one, const method::Method &method, unsigned int n,
                           double &seconds);

  /// The middle one of estimate / error.
  double median_ratio(const std::vector<Entry> &entries);
} // namespace plumbline::audit
