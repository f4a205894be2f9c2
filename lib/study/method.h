#pragma once

#include "algebra/spectrum.h"
#include "scene/problem.h"
#include "study/capabilities.h"
#include "study/results.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::study
{
  /// What a method yields for one problem: the same view for both sides, so that they can be
  /// compared.
  struct Solution
  {
    std::vector<dealii::Point<2>> nodes; ///< the method's own free nodes in Ω
    std::vector<double> nodal;           ///< values there, shape (n_nodes, n_components)
    std::vector<double> averages; ///< over the comparison cells, shape (n_cells, n_components)
    std::function<double(const dealii::Point<2> &, unsigned int component)> value; ///< in Ω
    std::function<void(const std::string &file)> write_vtu;
    base::Cost cost;
    Diagnostics diagnostics;
  };

  /// The operator that a method solves with, on its free unknowns: Σ_j A_ij u_j = m_i b(x_i) and
  /// what the collar adds.
  struct DiscreteOperator
  {
    unsigned int n_components = 1;
    std::vector<dealii::Point<2>> nodes; ///< unknowns are numbered node by node
    std::vector<double> mass; ///< m of each node [length^2], or 1 where all are alike; > 0
    /// Of one component on a lattice with one node a cell: -Σ_j A_ij (x_j - x_i)_1² / m_i over all
    /// neighbours of a node, in the collar too, and how far they are along an axis; else 0.
    double second_moment = 0, reach = 0;
    bool is_collocated = true; ///< row i states the equation at node i: no Galerkin method
    algebra::Rows rows;        ///< A; empty where only its action is there
    algebra::Action action;    ///< of a symmetric A, matrix-free; empty where only rows are there
    Diagnostics diagnostics;   ///< weights, moments

    std::size_t size() const { return nodes.size() * n_components; }
  };

  /// How large a problem is, which can be known before anything of it is made.
  struct ProblemSize
  {
    scene::Level level;
    std::array<double, 2> extents{}; ///< of Ω's bounding box on a lattice [cells]
    double n_cells = 0, n_free = 0;  ///< of a mesh with its collar, and in Ω
    double cell_area = 0;            ///< of a mesh, in the mean [length^2]

    bool is_lattice() const { return extents[0] > 0; }
  };

  /// A way to solve scenes, on either side.
  class Method
  {
  public:
    virtual ~Method() = default;
    virtual std::string name() const = 0;
    virtual std::string family() const = 0; ///< "meshfree", "reference" or "local"
    virtual std::string help() const = 0;

    /// Whether Methods/names = all takes it: not where it is there to show how it fails.
    virtual bool is_in_all() const { return true; }

    /// What a scene may need of it; see refusal.h.
    virtual Capabilities can() const { return all_capabilities(); }

    /// Empty if the method can do the scene, else the reason that is none of its capabilities.
    /// @param problem  of any case and level
    virtual std::string why_not(const scene::Scene &scene, const scene::Problem &problem) const = 0;

    /// @throws NumericalError  no solution; @throws InputError  data that is not finite
    virtual Solution solve(const scene::Scene &scene, const scene::Problem &problem) const = 0;

    /// The operator at one level, for its stability; empty: the method does not show it. Meshes: by
    /// the first outer rule. On this rank alone.
    /// @throws NumericalError  there is none, e.g. weights are infeasible
    virtual std::optional<DiscreteOperator> discrete_operator(const scene::Scene &,
                                                              const scene::Problem &) const
    {
      return {};
    }

    /// The most memory that `solve` takes above what stood before (Cost::peak_bytes), within a
    /// factor of 2 where it is more than some 50 MB, for one rank; 0 where it is little. Not in it:
    /// the factors of a direct solver.
    virtual double expected_bytes(const scene::Scene &, const ProblemSize &) const { return 0; }

    /// The rate at which field and averages tend to a smooth solution at a fixed horizon, at least:
    /// p + 1 of Galerkin methods whose kernel is integrable. For error estimates.
    virtual unsigned int order() const { return 1; }

    /// The same method one polynomial degree higher, if it has one: for its error estimate.
    virtual std::shared_ptr<const Method> higher_degree() const { return nullptr; }
  };

  using Methods = std::vector<std::shared_ptr<const Method>>;

  /// The cells that solutions are averaged over, one for each meshfree node: the lattice cells of
  /// Ω, or squares around its inner vertices. One family of nodes with the given number of
  /// components.
  geometry::NodeSet comparison_nodes(const scene::Scene &scene, const geometry::Lattice &lattice,
                                     unsigned int n_components);
} // namespace plumbline::study
