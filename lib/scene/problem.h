#pragma once

#include "geometry/vertex_cells.h"
#include "physics/chebyshev.h"
#include "physics/coefficient.h"
#include "physics/kernel.h"
#include "scene/scene.h"

#include <functional>
#include <memory>
#include <optional>

namespace plumbline::scene
{
  /// A field given pointwise, and as a series where it is smooth.
  struct Field
  {
    std::function<double(const dealii::Point<2> &, unsigned int component)> value;
    std::optional<physics::ChebyshevField> series; ///< on the bounding box of Ω

    /// In Ω, by the series where there is one, which is cheaper.
    double operator()(const dealii::Point<2> &x, unsigned int component) const
    {
      return series ? (*series)(x, component) : value(x, component);
    }
  };

  /// One case of a scene at one level: what a method needs to know, and nothing of other levels. It
  /// stands either on a lattice or on a mesh with the cells of its nodes.
  struct Problem
  {
    std::optional<geometry::Lattice> lattice;
    std::shared_ptr<const geometry::Mesh> mesh;       ///< of Ω and its collar; empty on a lattice
    std::shared_ptr<const geometry::NodeCells> cells; ///< of the nodes; empty on a lattice
    /// Of a body with a free boundary: the lattice of its nodes, which `cells` number by `source`.
    std::optional<geometry::NodeLattice> body;
    double h = 0; ///< of the level [length]
    physics::Kernel<2> kernel;
    std::optional<physics::Coefficient> coefficient; ///< of the bonds; empty: homogeneous
    std::optional<physics::Dilatation> dilatation;   ///< empty: bonds are all
    unsigned int n_components = 0;
    Field load;                          ///< b on Ω
    Field constraint;                    ///< u in the collar
    std::optional<Field> solution;       ///< the exact nonlocal solution, if known
    std::optional<Field> local_solution; ///< the solution of the local limit, if known
    double horizon() const { return kernel.horizon(); }
  };

  /// @param case_index  into Scene::case_names()
  /// @param t           of a scene that moves: its state at this time, the load being the static
  /// one, -F(u) of a manufactured u
  /// @param known_load  of the same case, horizon and time on another level, dear to make again
  /// @param same_place  a problem of the same level: its mesh, nodes and cells are taken, which
  /// would come out the same
  /// @throws InputError  an expression that is not finite somewhere in Ω or its collar, a mesh or
  /// nodes that cannot be used
  Problem make_problem(const Scene &scene, unsigned int case_index, const Level &level,
                       double t = 0, const Field *known_load = nullptr,
                       const Problem *same_place = nullptr);
} // namespace plumbline::scene
