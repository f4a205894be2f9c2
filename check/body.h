#pragma once

#include "check/findings.h"
#include "check/requirements.h"
#include "report/tables.h"

namespace plumbline::check
{
  /// A body whose weights are checked.
  struct GivenBody
  {
    bool has_free_boundary = false; ///< else u is prescribed around Ω, and balls are whole there
    std::vector<geometry::Polygon> parts;   ///< of Ω, see geometry::VisibleBody
    std::vector<geometry::Polyline> cracks; ///< relative to the origin of the nodes

    bool is_there() const { return has_free_boundary || !cracks.empty(); }
  };

  /// @param word  "constrained" or "free"
  /// @param key   that has it, for the message
  bool is_free_boundary(const std::string &word, const std::string &key);

  /// Checks what lies near free surfaces and cracks, and leaves the families of whole balls.
  /// @param key  that gives the cracks, for messages
  /// @throws InputError  as meshfree::check_body and geometry::check_cracks
  meshfree::BodyCheck check_body(const GivenBody &body, const std::string &key,
                                 const physics::Kernel<2> &kernel, double spacing,
                                 meshfree::GivenWeights &weights, std::vector<double> &uncut_areas);

  // What is said of a body, as of all weights in requirements.h.
  std::vector<std::string> body_complaints(const Findings &found, const Requirements &required);
  std::vector<std::string> body_verdicts(const Findings &found);
  report::Table body_table(const Findings &found);

  /// The value of "body" in check.json.
  std::string body_json(const Findings &found);
} // namespace plumbline::check
