#pragma once

/** \dir
    The check of another code's weights on a scene: findings, what is required of them, pages. */

#include "meshfree/check/body_check.h"
#include "meshfree/check/findings.h"
#include "method/method.h"
#include "scene/scene.h"
#include "study/study_results.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::check
{
  /// The weights of another code, and what they are meant for.
  struct Input
  {
    std::string nodes_file, bonds_file, scene_file; ///< {h} in names: a series of levels
    std::string bonds_are = "weights";              ///< or what else, see meshfree::BondValues
    std::string boundary = "constrained";           ///< or free: that of the domain is a surface
    std::vector<std::string> cracks;                ///< each "x0, y0 : x1, y1", like Domain/cracks
    std::vector<scene::Override> overrides;         ///< of the scene
    std::string assumption; ///< on what neither the scene nor the command gives; may be empty
  };

  /// A level of a scene, and what led to it.
  struct ChosenLevel
  {
    problem::Level level;
    std::string series;
    double node_size = 0; ///< spacing of the nodes in Ω: see meshfree::node_spacing [length]

    std::string text() const;
    bool is_near() const; ///< h is the spacing, as closely as that of scattered nodes can be told
  };

  /// What one case of the scene shows, in the records of a study: of its solution by the weights,
  /// which may have failed, and of that by the reference.
  struct CaseCheck
  {
    study::Record weights, reference;

    const std::string &name() const { return weights.key.problem; }
  };

  /// All that is found of the weights of another code on a scene.
  template <int dim>
  struct Findings : meshfree::Findings<dim>
  {
    std::string scene_name, purpose;
    std::vector<std::int64_t> ids;       ///< of the nodes, numbered as the cells
    std::vector<std::string> notes;      ///< how files were read that are not plain CSV
    std::size_t n_on_boundary = 0;       ///< free nodes on the boundary of Ω
    std::vector<std::size_t> n_crossing; ///< bonds across the sides of a periodic box, else empty
    ChosenLevel level;
    std::vector<CaseCheck> cases; ///< none of bodies
    /// For a body with free surfaces or cracks, in the plane; the other members are then about
    /// its families with whole balls only.
    std::optional<meshfree::BodyCheck> body = {};

    std::string id(std::size_t node) const { return std::to_string(ids[node]); }
  };

  /// Says that the horizon is the default one, where neither the scene file nor the command gives
  /// it, and what else is assumed; empty: nothing.
  std::string assumptions(const scene::Scene &scene, const Input &input,
                          const problem::Level &level);

  /// The level whose h is nearest to the spacing of the nodes, by their ratio.
  ChosenLevel choose_level(const scene::Scene &scene, double spacing);

  /// How the files were read, and with which horizon.
  template <int dim>
  std::vector<std::string> notes_of(const Findings<dim> &found, const std::string &assumed,
                                    const Input &input);

  /// @param references  Galerkin methods for the solutions that those by the weights are held
  /// against
  /// @param known       records of cases from an earlier run of the same check: not solved
  /// again
  /// @note Collective: the solutions are shared among the ranks.
  /// @throws InputError      files or a scene that cannot be used
  /// @throws NumericalError  no solution by the reference
  Findings<2> find(scene::Scene scene, const Input &input, const method::Methods &references,
                   const study::Records &known = {});
} // namespace plumbline::check
