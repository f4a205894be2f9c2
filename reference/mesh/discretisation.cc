#include "reference/mesh/discretisation.h"

#include "algebra/distributed_matrix.h"
#include "base/error.h"
#include "base/number_text.h"
#include "method/limit_proof.h"
#include "method/sparse_motion.h"
#include "reference/geometry_check.h"
#include "reference/mesh/assembly.h"
#include "reference/mesh/cell_order.h"
#include "reference/mesh/dilatation.h"
#include "reference/mesh/entry_check.h"
#include "reference/mesh/inclusion_check.h"
#include "reference/mesh/load.h"
#include "reference/mesh/mass.h"
#include "reference/mesh/polygon_pairs.h"
#include "reference/mesh/weighted_volume.h"

#include <deal.II/base/parallel.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using method::Vector;

    /// The volume constraint at the degrees of freedom that are not free. Data may jump across
    /// cracks: a space that jumps as well takes them from inside of each cell.
    std::vector<double> constrained_values(const problem::Problem<2> &problem,
                                           const MeshSpace &space)
    {
      const double inwards = problem.damage.is_there() && !space.is_continuous() ? 1e-12 : 0;
      const unsigned int n = space.shapes().size(), nc = problem.n_components;
      std::vector<double> values((space.n_dofs() - space.n_free()) * nc);
      for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
      {
        const unsigned int *dofs = space.dofs(cell);
        dealii::Tensor<1, 2> middle;
        for (unsigned int a = 0; a < n; ++a)
          middle += space.support(dofs[a]) / n;
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int c = 0; dofs[a] >= space.n_free() && c < nc; ++c)
          {
            const auto &x = space.support(dofs[a]);
            values[(dofs[a] - space.n_free()) * nc + c] =
                problem.constraint.value(x + inwards * (middle - x), c);
          }
      }
      return values;
    }

    /// The coefficient of the bonds. Where families end at a free boundary, the part of the ball
    /// that is left carries all of the shear modulus.
    std::optional<physics::Coefficient> bond_coefficient(const problem::Problem<2> &problem)
    {
      if (!problem.body())
        return problem.coefficient;
      const auto influence =
          physics::influence_function<2>(problem.kernel.profile(), problem.horizon());
      const auto volume = std::make_shared<const WeightedVolume>(*problem.mesh(), influence);
      return physics::Coefficient([mu = *problem.coefficient, volume](const Point<2> &x)
                                  { return mu.at(x) * 2 / (*volume)(x); },
                                  "shear modulus", physics::Mean::arithmetic);
    }

    /// Of each cell of the mesh whether it is one of the interaction domain beyond a free surface;
    /// empty: there is no surface.
    std::vector<char> find_ghosts(const problem::Problem<2> &problem)
    {
      std::vector<char> is_ghost;
      const auto outside = problem.damage.outside;
      for (std::size_t i = 0; outside && i < problem.mesh()->cells.size(); ++i)
      {
        const geometry::Polygon cell = problem.mesh()->polygon(i);
        is_ghost.push_back(!problem.mesh()->cells[i].is_inside &&
                           outside(geometry::ConvexCell(cell).moments().centroid) > 0);
      }
      return is_ghost;
    }

    /// The places of these cells.
    std::vector<geometry::Box> find_gaps(const problem::Problem<2> &problem)
    {
      std::vector<geometry::Box> gaps;
      const std::vector<char> is_ghost = find_ghosts(problem);
      for (std::size_t i = 0; i < is_ghost.size(); ++i)
        if (is_ghost[i] != 0)
          gaps.push_back(geometry::bounding_box(geometry::view(problem.mesh()->polygon(i))));
      return gaps;
    }

    Correction correction_of(const problem::Damage<2> &damage)
    {
      if (!damage.is_there())
        return Correction::none;
      return damage.surface_terms == problem::SurfaceTerms::energy ? Correction::energy
                                                                   : Correction::dilatation;
    }

    /// The matrix with an outer rule refined so many times.
    MeshMatrix assemble_all(const problem::Problem<2> &problem, const MeshSpace &space,
                            const MeshCells &cells, const AssemblyOptions &options,
                            const base::Communicator &communicator)
    {
      MeshMatrix matrix =
          assemble(space, cells, problem.kernel, bond_coefficient(problem), options, communicator);
      if (problem.dilatation)
      {
        const DilatationOptions dilatation{options.refinement, problem.body() != nullptr,
                                           options.backend,    correction_of(problem.damage),
                                           options.cracks,     find_gaps(problem)};
        matrix.rows = add(matrix.rows, assemble_dilatation(space, cells, *problem.dilatation,
                                                           dilatation, communicator));
        matrix.is_exact = false;
        matrix.way += ", dilatations by quadrature";
        if (dilatation.correction != Correction::none)
          matrix.way += ", corrected where bonds are missing";
      }
      return matrix;
    }

    /// Without the cells beyond free surfaces, which only complete families of nodes.
    std::shared_ptr<const geometry::Mesh> mesh_of_body(const problem::Problem<2> &problem)
    {
      const std::vector<char> is_ghost = find_ghosts(problem);
      if (is_ghost.empty())
        return problem.mesh();
      constexpr unsigned int none = -1;
      const geometry::Mesh &all = *problem.mesh();
      std::vector<unsigned int> number(all.vertices.size(), none);
      geometry::Mesh body;
      body.groups = all.groups;
      for (std::size_t i = 0; i < all.cells.size(); ++i)
      {
        geometry::MeshCell cell = all.cells[i];
        for (unsigned int v = 0; v < cell.n_vertices && is_ghost[i] == 0; ++v)
        {
          unsigned int &own = number[cell.vertex[v]];
          if (own == none)
          {
            own = static_cast<unsigned int>(body.vertices.size());
            body.vertices.push_back(all.vertices[cell.vertex[v]]);
          }
          cell.vertex[v] = own;
        }
        if (is_ghost[i] == 0)
          body.cells.push_back(cell);
      }
      return std::make_shared<const geometry::Mesh>(std::move(body));
    }

    /// Spaces stand on triangles with straight sides, whose functions go on up to the curves.
    std::shared_ptr<const geometry::Mesh> mesh_of_space(const problem::Problem<2> &problem)
    {
      if (problem.mesh()->wholes.empty())
        return mesh_of_body(problem);
      return std::make_shared<const geometry::Mesh>(geometry::straightened(*problem.mesh()));
    }

    std::shared_ptr<const MeshSpace> make_space(const problem::Problem<2> &problem,
                                                bool is_continuous, unsigned int degree,
                                                unsigned int n_ranks)
    {
      const auto mesh = mesh_of_space(problem);
      MeshSpace::Middles middles;
      for (const geometry::WholeCell &whole : problem.mesh()->wholes)
        middles.push_back(whole.middles);
      auto space = std::make_shared<const MeshSpace>(mesh, is_continuous, degree, middles,
                                                     order_for_ranks(*mesh, n_ranks));
      if (space->n_free() == 0)
        throw NumericalError("no degree of freedom is free: every cell of the domain touches the "
                             "collar; refine the mesh");
      return space;
    }

    algebra::SparseOptions solver_options(const problem::Problem<2> &problem,
                                          const MeshSpace &space)
    {
      algebra::SparseOptions options;
      options.is_symmetric = is_symmetric(problem);
      options.n_components = problem.n_components;
      for (std::size_t dof = 0; dof < space.n_free(); ++dof)
        options.nodes.push_back(space.support(dof));
      return options;
    }

    double relative_change(const MeshField &before, const MeshField &now)
    {
      MeshField difference = now;
      for (std::size_t i = 0; i < now.values.size(); ++i)
        difference.values[i] -= before.values[i];
      const double size = l2_norm(now);
      return size > 0 ? l2_norm(difference) / size : l2_norm(difference);
    }

    class GalerkinOnMesh : public method::SparseDiscretisation
    {
    public:
      GalerkinOnMesh(const problem::Problem<2> &problem, std::shared_ptr<const MeshSpace> space,
                     bool exact_entries, const base::Communicator &communicator)
          : SparseDiscretisation(problem.settings.solver, solver_options(problem, *space),
                                 communicator),
            problem_(problem), space_(std::move(space)),
            cells_(std::make_shared<const MeshCells>(*mesh_of_body(problem))),
            options_{0, exact_entries, problem.settings.geometry.backend,
                     geometry::straight_parts(problem.damage.cracks)}
      {
        make_rows();
      }

      method::CaseData data(const problem::Problem<2> &problem) const override
      {
        method::CaseData result;
        std::vector<double> constrained_data;
        communicator().together(
            [&]
            {
              constrained_data = constrained_values(problem, *space_);
              result.load = load_vector(problem, *space_, *cells_, communicator());
            });
        method::subtract_constrained(*constrained(), constrained_data, result.load);
        const auto around =
            std::make_shared<const std::vector<double>>(std::move(constrained_data));
        result.field = [this, around](const Vector &u) {
          return as_field(std::make_shared<const MeshField>(field(u, *around)), *problem_.cells());
        };
        result.relative_change = [this, around](const Vector &u, const Vector &v)
        { return relative_change(field(u, *around), field(v, *around)); };
        return result;
      }

      method::LinearEquations<2> equations(const problem::Problem<2> &problem) const override
      {
        method::LinearEquations<2> result;
        result.n_components = problem.n_components;
        for (std::size_t dof = 0; dof < space_->n_dofs(); ++dof)
          result.nodes.push_back(space_->support(dof));
        result.n_free = space_->n_free();
        result.rows = method::join(*free(), *constrained());
        const Vector load = load_vector(problem, *space_, *cells_, communicator());
        result.load.assign(load.begin(), load.end());
        result.constraint = constrained_values(problem, *space_);
        result.has_quadrature_error = has_quadrature_error();
        return result;
      }

      method::DiscreteOperator matrix() const override
      {
        method::DiscreteOperator result;
        result.n_components = problem_.n_components;
        result.is_collocated = false;
        for (std::size_t dof = 0; dof < space_->n_free(); ++dof)
          result.nodes.push_back(space_->support(dof));
        result.mass = lumped_masses(*space_, *cells_);
        result.rows = *free();
        return result;
      }

      std::unique_ptr<method::EquationOfMotion> motion(bool is_lumped) const override
      {
        std::vector<Point<2>> nodes;
        for (std::size_t dof = 0; dof < space_->n_free(); ++dof)
          nodes.push_back(space_->support(dof));
        method::PartitionedRows mass;
        if (!is_lumped)
          mass = method::part(mass_rows(*space_, *cells_, problem_.n_components),
                              space_->n_free() * problem_.n_components);
        return method::move_by_rows<2>(
            {nodes, problem_.n_components, free(), constrained(),
             is_lumped ? lumped_masses(*space_, *cells_) : std::vector<double>(), std::move(mass),
             [this](const problem::Problem<2> &instant)
             { return load_vector(instant, *space_, *cells_, communicator()); },
             [this](const problem::Problem<2> &instant)
             { return constrained_values(instant, *space_); }});
      }

      method::Diagnostics diagnostics() const override
      {
        method::Diagnostics result;
        result.is_outer_error_known = is_exact_ || problem_.settings.quadrature.tolerance > 0;
        result.notes.push_back("entries " + way_);
        if (!is_exact_ && problem_.settings.quadrature.tolerance == 0)
          result.notes.push_back("outer quadrature not refined: its error is not known");
        if (const std::size_t n_cells = count_cracked_cells(); n_cells > 0)
          result.notes.push_back(
              "cracks run through " + std::to_string(n_cells) +
              " cells, in which no solution jumps, so that the field's error falls "
              "like the root of h; let sides run along them");
        if (space_->shapes().degree() > 0 && !problem_.damage.is_there())
          result.limit = method::prove_galerkin(problem_, result);
        const problem::GeometrySettings &geometry = problem_.settings.geometry;
        const auto check =
            check_geometry(*cells_, problem_.horizon(), geometry.n_checks, geometry.seed);
        add_entry_check(geometry, result);
        add_inclusion_check(geometry, result);
        result.n_geometry_checks = check.n_checked;
        result.geometry_difference = check.worst_difference;
        return result;
      }

      bool has_quadrature_error() const override { return !is_exact_; }

      void refine_quadrature() override
      {
        ++options_.refinement;
        set_rows({});
        make_rows();
      }

    private:
      std::size_t count_cracked_cells() const
      {
        std::vector<geometry::Cut> inside;
        std::size_t n_cells = 0;
        for (std::size_t cell = 0; cell < cells_->size(); ++cell)
        {
          const auto vertices = (*cells_)[cell].vertices();
          if (geometry::find_between(options_.cracks, vertices, vertices, inside) !=
              geometry::Sight::clear)
            ++n_cells;
        }
        return n_cells;
      }

      /// What another way gives for a sample of entries.
      void add_entry_check(const problem::GeometrySettings &geometry,
                           method::Diagnostics &result) const
      {
        if (problem_.dilatation || problem_.body() || communicator().n_ranks() > 1 ||
            problem_.damage.is_there() || (problem_.coefficient && !is_exact_))
          return;
        const EntryCheck check =
            check_entries(*space_, *cells_, problem_.kernel, problem_.coefficient, *free(),
                          geometry.n_checks, geometry.seed);
        if (check.n_entries == 0)
          return;
        constexpr double rounding = 1e-12;
        const double decade = check.worst_difference <= rounding
                                  ? rounding
                                  : std::pow(10., std::ceil(std::log10(check.worst_difference)));
        result.notes.push_back("a sample of entries, made again by correlations of pairs of cells, "
                               "agrees to " +
                               base::to_text(decade, 1) + " of the diagonal");
      }

      /// Whether decisions of an exact assembly are those of exact predicates.
      void add_inclusion_check(const problem::GeometrySettings &geometry,
                               method::Diagnostics &result) const
      {
        if (!is_exact_ || geometry.n_checks == 0)
          return;
        const bool by_edges =
            goes_by_edges(*space_, *cells_, problem_.kernel, problem_.coefficient);
        result.notes.push_back(check_inclusions(*space_, *cells_, problem_.kernel,
                                                by_edges ? Decider::edges : Decider::sides_of_pairs,
                                                geometry.n_checks, geometry.seed)
                                   .text());
      }

      void make_rows()
      {
        MeshMatrix matrix;
        communicator().together(
            [&] { matrix = assemble_all(problem_, *space_, *cells_, options_, communicator()); });
        is_exact_ = !communicator().any(!matrix.is_exact);
        way_ = matrix.way;
        const std::size_t n = space_->n_free() * problem_.n_components;
        if (communicator().n_ranks() > 1)
          matrix.rows = algebra::sum_own_rows(
              matrix.rows, algebra::OwnedRanges(n, problem_.n_components, communicator()));
        set_rows(method::part(std::move(matrix.rows), n));
      }

      MeshField field(const Vector &u, const std::vector<double> &constrained) const
      {
        MeshField result{space_, cells_, problem_.n_components, {u.begin(), u.end()}};
        result.values.insert(result.values.end(), constrained.begin(), constrained.end());
        return result;
      }

      const problem::Problem<2> &problem_;
      std::shared_ptr<const MeshSpace> space_;
      std::shared_ptr<const MeshCells> cells_;
      AssemblyOptions options_;
      bool is_exact_ = false;
      std::string way_;
    };
  } // namespace

  std::unique_ptr<method::Discretisation>
  discretise_on_mesh(const problem::Problem<2> &problem, bool is_continuous, unsigned int degree,
                     bool exact_entries, const base::Communicator &communicator)
  {
    return std::make_unique<GalerkinOnMesh>(
        problem, make_space(problem, is_continuous, degree, communicator.n_ranks()), exact_entries,
        communicator);
  }

  bool is_symmetric(const problem::Problem<2> &problem)
  {
    return !problem.dilatation || (problem.dilatation->is_symmetric() &&
                                   (!problem.damage.is_there() ||
                                    problem.damage.surface_terms == problem::SurfaceTerms::energy));
  }

  std::string refuse_curves(const problem::Problem<2> &problem, bool is_continuous,
                            unsigned int degree)
  {
    if (!problem.mesh() || problem.mesh()->wholes.empty())
      return "";
    const std::string reason = PolygonPairs::refuse(
        MeshSpace(mesh_of_space(problem), is_continuous, degree), problem.kernel);
    return reason.empty()
               ? ""
               : "Domain/sides = curved is for what pairs of sides can do, but " + reason +
                     "; take a Galerkin method of degree 0 to 2, another kernel, or "
                     "write Domain/sides = straight";
  }

  double expected_mesh_bytes(const method::ProblemSize &size, unsigned int n_vertices,
                             bool is_continuous, unsigned int degree)
  {
    // assembled upper half, both halves, what eliminates, the solver's copy; space and geometry of
    // a cell; all measured
    const bool is_shared = is_continuous && degree > 0;
    // by sides of triangles entries are combined in place: 24, but 44 where a material varies
    const double of_entry = n_vertices == 3 && is_shared && degree == 1 ? 32 : 44;
    constexpr double of_cell = 1000;
    const double p = degree, n_components = size.n_components;
    const double n_dofs = n_vertices == 4 ? (is_shared ? p * p : (p + 1) * (p + 1))
                                          : (is_shared ? p * p / 2 : (p + 1) * (p + 2) / 2);
    // the support of a shape function widens the ball: by one cell, or by those about its vertex
    const double wider = !is_shared ? .85 : degree == 1 ? 1.9 : 1.4;
    const double reach = size.reach() / std::sqrt(size.cell_area) + wider;
    const double n_columns = M_PI * reach * reach * n_dofs * n_components;
    return size.n_free * n_dofs * n_components * n_columns * of_entry + size.n_cells * of_cell;
  }

  method::Field as_field(std::shared_ptr<const MeshField> field,
                         const geometry::NodeCells<2> &cells)
  {
    method::Field result;
    const unsigned int nc = field->n_components;
    for (std::size_t dof = 0; dof < field->space->n_free(); ++dof)
      result.nodes.push_back(field->space->support(dof));
    const auto n_nodal = static_cast<std::ptrdiff_t>(result.nodes.size() * nc);
    result.nodal.assign(field->values.begin(), field->values.begin() + n_nodal);
    result.averages = field->averages(cells);
    result.value = [field](const Point<2> &x, unsigned int c) { return field->value(x, c); };
    if (field->space->is_continuous() && field->space->shapes().degree() > 0)
      result.gradient = [field](const Point<2> &x, unsigned int c)
      { return field->gradient(x, c); };
    result.write_vtu = [field](const std::string &file) { write_vtu(*field, file); };
    return result;
  }
} // namespace plumbline::reference
