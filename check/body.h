#pragma once

#include "check/requirements.h"
#include "check/scene_findings.h"
#include "meshfree/check/bond_values.h"
#include "report/tables.h"

namespace plumbline::check
{
  /// A body whose weights are checked.
  struct GivenBody
  {
    scene::Boundary boundary = scene::Boundary::constrained;
    std::vector<geometry::Polygon> parts;   ///< of Ω, see geometry::VisibleBody
    std::vector<geometry::Polyline> cracks; ///< relative to the origin of the nodes

    bool is_free() const { return boundary == scene::Boundary::free; }
    bool is_periodic() const { return boundary == scene::Boundary::periodic; }
    /// Whether families are cut; else balls are whole.
    bool is_cut() const { return is_free() || !cracks.empty(); }
    /// Width of the collar of Ω: in periodic boxes with nodes on the sides, images of neighbours
    /// lie as far as the horizon from the box, and not on the edge of this collar.
    double collar(const problem::Level &level) const
    {
      return is_free() ? 0 : level.horizon + (is_periodic() ? level.h : 0);
    }
  };

  /// @param word  one of those of scene::Boundary
  /// @param key   that has it, for the message
  scene::Boundary to_boundary(const std::string &word, const std::string &key);

  /// If Ω is periodic (one box), takes its nodes into the box; otherwise leaves them as they are.
  /// @throws InputError  Ω is no box, and as geometry::PeriodicBox::take_in
  void take_into_box(const GivenBody &body, const geometry::Domain &omega,
                     meshfree::GivenNodes<2> &nodes);

  /// Then the images in the mesh of Ω and its collar.
  /// @throws InputError  as geometry::PeriodicBox::check_sides
  void add_images(const geometry::Mesh &mesh, const problem::Level &level,
                  meshfree::GivenNodes<2> &nodes);

  /// What of a problem the check of weights needs: nodes on a mesh.
  problem::Problem<2> problem_on(const geometry::Mesh &mesh,
                                 const std::shared_ptr<const geometry::NodeCells<2>> &cells,
                                 const physics::Kernel<2> &kernel, double h);

  /// What is found of weights whose families are read: near free surfaces and cracks, and then of
  /// all families of whole balls.
  /// @param key      that gives the cracks, for messages
  /// @param weights  without volumes; values as the other code has them
  /// @param problem  with the mesh and the kernel
  /// @param found    has its level
  /// @param meant    rules that the weights may be of
  /// @throws InputError  as meshfree::check_body and geometry::check_cracks
  void find_defects(const GivenBody &body, const std::string &key, meshfree::BondValues values,
                    meshfree::GivenWeights<2> weights, std::vector<double> uncut_areas,
                    problem::Problem<2> problem, const std::vector<std::string> &meant,
                    Findings<2> &found);

  // What is said of a body, as of all weights in requirements.h.
  std::vector<std::string> body_complaints(const Findings<2> &found, const Requirements &required);
  std::vector<std::string> body_verdicts(const Findings<2> &found);
  report::Table body_table(const Findings<2> &found);

  /// The value of "body" in check.json.
  std::string body_json(const Findings<2> &found);
} // namespace plumbline::check
