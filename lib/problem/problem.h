#pragma once

#include "physics/chebyshev.h"
#include "physics/coefficient.h"
#include "physics/double_well.h"
#include "physics/kernel.h"
#include "physics/state_based.h"
#include "problem/domain.h"
#include "problem/level.h"
#include "problem/settings.h"
#include "problem/surface_terms.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plumbline::problem
{
  /// A field given pointwise, and as a series where it is smooth.
  template <int dim>
  struct Field
  {
    std::function<double(const dealii::Point<dim> &, unsigned int component)> value;
    std::optional<physics::ChebyshevField> series; ///< on the bounding box of Ω
    /// Of a field whose values cost an integral each: the same to 12 digits, by series where they
    /// resolve it. Empty: `value` is cheap, and right wherever it is asked for.
    std::function<double(const dealii::Point<dim> &, unsigned int component)> fast = {};
    bool is_smooth_in_cells = false; ///< without a series: Gauss points of a cell see all of it
    bool is_piecewise =
        false; ///< no series is looked for: no number of points shows where pieces end

    bool is_smooth() const { return series || is_smooth_in_cells; }

    /// In Ω.
    double operator()(const dealii::Point<dim> &x, unsigned int component) const
    {
      return fast ? fast(x, component) : value(x, component);
    }
  };

  /// Where bonds are broken.
  template <int dim>
  struct Damage
  {
    std::vector<std::vector<dealii::Point<dim>>> cracks; ///< lines that break the bonds across them
    /// Positive beyond free surfaces; empty: there are none. Give each thread a copy.
    std::function<double(const dealii::Point<dim> &)> outside = {};
    SurfaceTerms surface_terms = SurfaceTerms::published; ///< of a linear peridynamic solid

    bool is_there() const { return !cracks.empty() || outside; }
  };

  /// A constant of the material that varies in space.
  template <int dim>
  struct SpatialValue
  {
    std::string key; ///< its name, of a scene its key, e.g. "Material/E"
    std::function<double(const dealii::Point<dim> &)> at;
  };

  /// One boundary-value problem at one level: all that a method needs to know, and nothing of other
  /// levels. Made by ProblemBuilder.
  template <int dim>
  struct Problem
  {
    Domain domain;
    double h = 0; ///< of the level [length]
    physics::Kernel<dim> kernel;
    std::optional<physics::Coefficient> coefficient = {};  ///< of the bonds; empty: homogeneous
    std::optional<physics::Dilatation<2>> dilatation = {}; ///< empty: bonds only
    unsigned int n_components = 0;
    Field<dim> load = {};                          ///< b on Ω
    Field<dim> constraint = {};                    ///< u in the interaction domain
    std::optional<Field<dim>> solution = {};       ///< the exact nonlocal solution, if known
    std::optional<Field<dim>> local_solution = {}; ///< of the local limit, if known and another
    bool is_load_given = true;                     ///< else it is manufactured from the solution
    bool is_homogeneous = true;                    ///< no constant of the material varies in space
    bool has_collar_dilatation =
        true; ///< else the dilatation counts as 0 in the interaction domain
    Damage<dim> damage = {};
    /// λ and μ of a body with a free boundary; give each thread its own copy.
    std::function<physics::Lame(const dealii::Point<dim> &)> lame = {};
    std::optional<physics::DoubleWell> double_well = {}; ///< `kernel` is that of its small strains
    std::function<double(const dealii::Point<dim> &)> boundary_function = {}; ///< ω; empty: 1
    std::vector<SpatialValue<dim>> spatial_values = {};                       ///< of the material
    MethodSettings settings = {};
    /// Of coordinates: those of domain, cracks, meshes and nodes are relative to it [length].
    dealii::Point<dim> origin = {};

    double horizon() const { return kernel.horizon(); }
    Level level() const { return {h, horizon()}; }

    /// How far bonds and dilatations reach from a point of Ω [length].
    double reach() const { return dilatation ? 2 * horizon() : horizon(); }

    // what stands on another domain is null
    const geometry::Lattice *lattice() const
    {
      const auto *on = std::get_if<LatticeDomain>(&domain);
      return on != nullptr ? &on->lattice : nullptr;
    }
    const MeshDomain *on_mesh() const ///< of a body, too
    {
      const auto *on = std::get_if<BodyDomain>(&domain);
      return on != nullptr ? on : std::get_if<MeshDomain>(&domain);
    }
    MeshDomain *on_mesh() { return const_cast<MeshDomain *>(std::as_const(*this).on_mesh()); }
    const std::shared_ptr<const geometry::Mesh> &mesh() const
    {
      static const std::shared_ptr<const geometry::Mesh> none;
      return on_mesh() != nullptr ? on_mesh()->mesh : none;
    }
    const std::shared_ptr<const geometry::NodeCells<2>> &cells() const
    {
      static const std::shared_ptr<const geometry::NodeCells<2>> none;
      return on_mesh() != nullptr ? on_mesh()->cells : none;
    }
    const geometry::NodeLattice *body() const
    {
      const auto *on = std::get_if<BodyDomain>(&domain);
      return on != nullptr ? &on->lattice : nullptr;
    }
    bool is_floating() const
    {
      const auto *on = std::get_if<BodyDomain>(&domain);
      return on != nullptr && on->is_floating;
    }
    bool is_periodic() const
    {
      const auto *on = std::get_if<LatticeDomain>(&domain);
      return on != nullptr && on->is_periodic;
    }
    unsigned int dimension() const
    {
      const auto *on = std::get_if<LatticeDomain>(&domain);
      return on != nullptr ? on->dimension : dim;
    }
  };

  /// A problem with what poses it again, for error estimates and measured savings.
  template <int dim>
  struct Case
  {
    std::string name;
    Problem<dim> problem;
    /// It on cells of another size, each with its node at its centre; empty: it is known on its own
    /// cells alone. @throws InputError  there are no cells of this size
    std::function<Problem<dim>(double h)> at_h = {};
    /// It with nothing left out, to show that what is left out is not missed; empty: nothing is.
    std::function<Problem<dim>()> full_model = {};
  };
} // namespace plumbline::problem
