#include "reference/tetrahedra/discretisation.h"

#include "base/error.h"
#include "base/number_text.h"
#include "geometry/tetrahedral_domain.h"
#include "method/limit_proof.h"
#include "method/linear_equations.h"
#include "method/sparse_discretisation.h"
#include "method/sparse_motion.h"
#include "reference/tetrahedra/assembly.h"
#include "reference/tetrahedra/face_potential.h"
#include "reference/tetrahedra/field.h"
#include "reference/tetrahedra/hexahedra.h"
#include "reference/tetrahedra/jump_assembly.h"
#include "reference/tetrahedra/mass.h"
#include "reference/tetrahedra/repeated_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using dealii::Point;

    class GalerkinOnTetrahedra : public method::DiscretisationInSpace,
                                 public method::HasLinearEquations<3>
    {
    public:
      GalerkinOnTetrahedra(const problem::Problem<3> &problem, TetrahedralShapes shapes)
          : lattice_(problem.lattice), is_of_cubes_(!problem.make_tetrahedra && !problem.mesh),
            n_components_(problem.kernel.n_components())
      {
        const auto mesh = std::make_shared<const TetrahedralMesh>(make_mesh(problem, shapes));
        space_ = std::make_shared<const TetrahedralSpace>(mesh, shapes);
        if (space_->n_free() == 0)
          throw NumericalError("no vertex is inside the domain; choose a smaller h (Study/h)");
        options_.n_components = n_components_;
        options_.solver = problem.settings.solver.linear_solver;
        options_.iteration = problem.settings.solver.iteration;
        if (shapes.is_trilinear())
          settle_quadrature(problem);
        else
          set_rows(make_rows(problem));
        diagnostics_.n_neighbours = static_cast<unsigned int>(
            (free_->column.size() + constrained_.column.size()) / n_unknowns() / n_components_ - 1);
        if (shapes.degree > 0 && is_of_cubes_)
          diagnostics_.limit = method::prove_galerkin(problem);
      }

      std::size_t n_unknowns() const override { return space_->n_free() * n_components_; }

      Data data(const problem::Problem<3> &problem) const override
      {
        // the operator does not see a constant, but the solver's tolerance and rounding would
        std::vector<double> around = constraint_values(problem);
        const std::vector<double> middle = remove_middle(around);
        Data result;
        const std::vector<double> tested = load(problem);
        result.load.reinit(static_cast<unsigned int>(tested.size()));
        std::copy(tested.begin(), tested.end(), result.load.begin());
        method::subtract_constrained(constrained_, around, result.load);
        result.field = [this, around = std::move(around), middle](const Vector &u)
        { return field(u, around, middle); };
        return result;
      }

      method::LinearEquations<3> equations(const problem::Problem<3> &problem) const override
      {
        method::LinearEquations<3> result;
        result.n_components = n_components_;
        for (std::size_t dof = 0; dof < space_->n_dofs(); ++dof)
          result.nodes.push_back(space_->support(dof));
        result.n_free = space_->n_free();
        result.rows = method::join(*free_, constrained_);
        result.load = load(problem);
        result.constraint = constraint_values(problem);
        return result;
      }

      std::unique_ptr<algebra::LinearSystem> tangent() const override
      {
        return std::make_unique<algebra::SparseSystem>(free_, options_,
                                                       base::Communicator::alone());
      }

      std::unique_ptr<method::MotionOf<3>> motion(bool is_lumped) const override
      {
        method::SparseParts<3> parts;
        for (std::size_t dof = 0; dof < space_->n_free(); ++dof)
          parts.nodes.push_back(space_->support(dof));
        parts.n_components = n_components_;
        parts.stiffness = free_;
        parts.constrained = std::make_shared<const algebra::CsrMatrix>(constrained_);
        if (is_lumped)
          parts.masses = volumes(*space_);
        else
          parts.mass = method::part(mass_rows(*space_, n_components_), n_unknowns());
        parts.load = [this](const problem::Problem<3> &instant)
        {
          const std::vector<double> tested = load(instant);
          return Vector(tested.begin(), tested.end());
        };
        parts.around = [this](const problem::Problem<3> &instant)
        { return constraint_values(instant); };
        return method::move_by_rows<3>(std::move(parts));
      }

      method::Diagnostics diagnostics() const override { return diagnostics_; }

    private:
      void set_rows(const algebra::CsrMatrix &all)
      {
        method::PartitionedRows rows = method::part(all, n_unknowns());
        free_ = std::make_shared<const algebra::CsrMatrix>(std::move(rows.free));
        constrained_ = std::move(rows.constrained);
      }

      /// Of values at nodes, each with the volume of its cells, in L2.
      static double relative_change(const method::FieldInSpace &before,
                                    const method::FieldInSpace &after)
      {
        double change = 0, size = 0;
        for (std::size_t i = 0; i < after.nodal.size(); ++i)
        {
          const double volume = after.volumes.empty() ? 1 : after.volumes[i],
                       difference = after.nodal[i] - before.nodal[i];
          change += volume * difference * difference;
          size += volume * after.nodal[i] * after.nodal[i];
        }
        return std::sqrt(change / std::max(size, std::numeric_limits<double>::min()));
      }

      /// Rows on hexahedra by quadrature, which is refined until the solution settles.
      void settle_quadrature(const problem::Problem<3> &problem)
      {
        const auto &[is_exact, tolerance, most] = problem.settings.quadrature;
        const auto solve = [&](unsigned int refinement) -> method::FieldInSpace
        {
          set_rows(assemble_on_hexahedra(*space_, problem.kernel, n_unknowns(),
                                         HexahedralRule(refinement)));
          if (tolerance <= 0)
            return {};
          const Data given = data(problem);
          Vector u(static_cast<unsigned int>(n_unknowns()));
          tangent()->solve(
              u, given.load,
              {problem.settings.solver.tolerance, problem.settings.solver.max_iterations});
          return given.field(u);
        };
        method::FieldInSpace u = solve(0);
        double change = std::numeric_limits<double>::infinity();
        unsigned int refinement = 0;
        while (tolerance > 0 && change > tolerance)
        {
          if (refinement == most && refinement == 0)
            throw NumericalError("quadrature over pairs of hexahedra is not refined, so it is not "
                                 "known by how much that changes the solution; raise "
                                 "Quadrature/max refinements, or write Quadrature/tolerance = 0");
          if (refinement == most)
            throw NumericalError(
                "quadrature over pairs of hexahedra, refinement " + std::to_string(refinement) +
                ", changes the solution by " + base::to_text(change, 2) +
                " (relative), more than Quadrature/tolerance = " + base::to_text(tolerance, 2) +
                "; raise Quadrature/max refinements or the tolerance, or refine the mesh");
          method::FieldInSpace finer = solve(++refinement);
          change = relative_change(u, finer);
          u = std::move(finer);
        }
        diagnostics_.n_refinements = refinement;
        diagnostics_.is_outer_error_known = tolerance > 0;
        diagnostics_.outer_change = tolerance > 0 ? change : 0;
        const HexahedralRule rule(refinement);
        const auto points = [](unsigned int n)
        { return std::to_string(n) + " x " + std::to_string(n) + " x " + std::to_string(n); };
        diagnostics_.notes.push_back(
            "entries by Gauss rules over pairs of hexahedra, of " + points(rule.n_cut) +
            " points where they touch or the horizon cuts them and of " + points(rule.n_smooth) +
            " elsewhere; " +
            (tolerance > 0 ? "the last refinement changes the solution by " +
                                 base::to_text(change, 1) + " (relative)"
                           : "their error is not known (Quadrature/tolerance = 0)") +
            " (no error for linear fields)" + FacePotential::note(problem.kernel));
      }

      /// Of a mesh whose shapes differ the rows that are sampled are those about the thinnest
      /// cells.
      TetrahedralMesh make_mesh(const problem::Problem<3> &problem,
                                const TetrahedralShapes &shapes) const
      {
        if (is_of_cubes_)
          return geometry::six_per_cube(lattice_,
                                        geometry::layers_within(problem.reach(), problem.h()));
        if (problem.mesh && shapes.is_on_hexahedra)
          return *problem.mesh;
        constexpr std::size_t n_first = 4; // cells, which have at least as many vertices
        return geometry::with_thinnest_first(
            problem.mesh ? *problem.mesh : problem.make_tetrahedra(), n_first);
      }

      /// The constraint at the nodes that free ones see, 0 at others.
      std::vector<double> constraint_values(const problem::Problem<3> &problem) const
      {
        const std::size_t n_nodes = space_->n_dofs() - space_->n_free();
        std::vector<double> values(n_nodes * n_components_);
        std::vector<char> is_reached(n_nodes);
        for (const unsigned int column : constrained_.column)
          is_reached[column / n_components_] = 1;
        const TetrahedralMesh &mesh = space_->mesh();
        for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
          for (unsigned int corner = 0; corner < 4; ++corner)
            if (const unsigned int dof = space_->dof(cell, corner);
                mesh.is_inside[cell] != 0 && dof >= space_->n_free())
              is_reached[dof - space_->n_free()] = 1; // averages are of it
        for (std::size_t k = 0; k < n_nodes; ++k)
          for (unsigned int c = 0; is_reached[k] != 0 && c < n_components_; ++c)
            values[k * n_components_ + c] =
                problem.constraint.value(space_->support(space_->n_free() + k), c);
        return values;
      }

      /// Subtract from each component the middle of its values, and return it.
      std::vector<double> remove_middle(std::vector<double> &around) const
      {
        std::vector<double> middle(n_components_);
        for (unsigned int c = 0; c < n_components_ && !around.empty(); ++c)
        {
          double low = around[c], high = low;
          for (std::size_t k = c; k < around.size(); k += n_components_)
          {
            low = std::min(low, around[k]);
            high = std::max(high, around[k]);
          }
          middle[c] = low + (high - low) / 2;
          for (std::size_t k = c; k < around.size(); k += n_components_)
            around[k] -= middle[c];
        }
        return middle;
      }

      method::FieldInSpace field(const Vector &u, const std::vector<double> &around,
                                 const std::vector<double> &middle) const
      {
        method::FieldInSpace result;
        for (std::size_t dof = 0; dof < space_->n_free(); ++dof)
          result.nodes.push_back(space_->support(dof));
        if (!is_of_cubes_)
          result.volumes = volumes(*space_);
        std::vector<std::shared_ptr<const TetrahedralField>> fields;
        std::vector<std::vector<double>> averages;
        result.nodal.resize(n_unknowns());
        for (unsigned int c = 0; c < n_components_; ++c)
        {
          std::vector<double> values;
          for (std::size_t k = c; k < u.size(); k += n_components_)
          {
            values.push_back(u[static_cast<unsigned int>(k)] + middle[c]);
            result.nodal[k] = values.back();
          }
          for (std::size_t k = c; k < around.size(); k += n_components_)
            values.push_back(around[k] + middle[c]);
          fields.push_back(std::make_shared<const TetrahedralField>(space_, std::move(values)));
          averages.push_back(fields.back()->averages(lattice_));
        }
        for (std::size_t cell = 0; cell < averages.front().size(); ++cell)
          for (const std::vector<double> &of_component : averages)
            result.averages.push_back(of_component[cell]);
        result.value = [fields](const Point<3> &x, unsigned int c) { return fields[c]->value(x); };
        if (space_->degree() > 0)
          result.gradient = [fields](const Point<3> &x, unsigned int c)
          { return fields[c]->gradient(x); };
        return result;
      }

      /// Tested by the free unknowns, shape (n_free, n_components).
      std::vector<double> load(const problem::Problem<3> &problem) const
      {
        std::vector<double> result(n_unknowns());
        for (unsigned int c = 0; c < n_components_; ++c)
        {
          const std::vector<double> of_component = tested_load(problem.load, *space_, c);
          for (std::size_t k = 0; k < of_component.size(); ++k)
            result[k * n_components_ + c] = of_component[k];
        }
        return result;
      }

      /// The rows of the free unknowns, and a note on how they were made, with quadrature as an
      /// independent check.
      algebra::CsrMatrix make_rows(const problem::Problem<3> &problem)
      {
        const TetrahedralShapes &shapes = space_->shapes();
        const BondFactors factors(problem, space_->mesh());
        const bool has_jumps =
            shapes.degree > 0 && (!shapes.is_continuous || !factors.are_all_one());
        FaceRule exact = FaceRule::exact();
        exact.spacing = problem.h(); // parts of meshes may be lattices, too
        FaceRule check = FaceRule::quadrature(1);
        if (has_jumps)
        {
          check = exact;
          check.of_jumps = exact.of_jumps / 10;
        }
        FaceRuleUse use;
        algebra::CsrMatrix matrix;
        double change = 0; // of entries, relative to the diagonal
        if (is_of_cubes_)
        {
          const RepeatedRows rows(problem.kernel, problem.h(), shapes, exact, &use,
                                  problem.dilatation);
          matrix = rows.on(*space_, lattice_);
          change =
              RepeatedRows(problem.kernel, problem.h(), shapes, check, nullptr, problem.dilatation)
                  .difference(rows);
        }
        else
        {
          constexpr double of_meshes = 1e-12; // of a pair
          exact.tolerance = of_meshes;
          check.tolerance = of_meshes;
          exact.of_jumps *= 10;
          check.of_jumps *= 10;
          if (shapes.degree > 0 && !factors.are_all_one())
            matrix = rows_with_factors(problem, factors, exact, check, use, change);
          else
          {
            matrix = assemble_by_faces(*space_, problem.kernel, space_->n_free(), exact, &use,
                                       problem.dilatation);
            change = difference(assemble_by_faces(*space_, problem.kernel, n_sampled(), check,
                                                  nullptr, problem.dilatation),
                                matrix);
            if (!factors.are_all_one())
              set_factors_of_cells(factors, *space_, n_components_, matrix);
          }
        }
        constexpr double most_error = 1e-10;
        const double most_change = has_jumps ? 1e-3 : .25;
        if (!(use.error <= most_error) || !(change <= most_change) || !(use.open <= most_change))
          throw NumericalError(
              "integrals over pairs of faces have round-off of up to " +
              base::to_text(use.error, 1) + " of the diagonal" +
              (has_jumps ? ", a smaller tolerance of quadrature changes entries by "
                         : " and differ from quadrature by ") +
              base::to_text(change, 1) + open_pairs(use) + ": tetrahedra are too thin; " +
              (problem.make_tetrahedra ? "choose a smaller Methods/perturbation"
               : !problem.mesh || problem.mesh->hexahedra.empty()
                   ? "give a mesh without thin tetrahedra "
                     "(Mesh.OptimizeThreshold of gmsh)"
                   : "give hexahedra that are less distorted, or take "
                     "Q1"));
        note(use, change, has_jumps);
        diagnostics_.notes.back() += FacePotential::note(problem.kernel);
        return matrix;
      }

      /// Rows of linear functions with bonds that have factors.
      /// @param change  of a sample of entries by the check
      algebra::CsrMatrix rows_with_factors(const problem::Problem<3> &problem,
                                           const BondFactors &factors, const FaceRule &exact,
                                           const FaceRule &check, FaceRuleUse &use,
                                           double &change) const
      {
        const bool is_continuous = space_->is_continuous();
        const TetrahedralSpace broken(std::make_shared<const TetrahedralMesh>(space_->mesh()),
                                      TetrahedralShapes::discontinuous_linear());
        const auto rows = [&](std::size_t n_rows, const FaceRule &rule, FaceRuleUse *how)
        {
          return is_continuous
                     ? assemble_interfaces(broken, problem.kernel, n_rows, rule, how, factors)
                     : assemble_with_jumps(broken, problem.kernel, n_rows, rule, how, {}, &factors);
        };
        algebra::CsrMatrix matrix = rows(broken.n_free(), exact, &use);
        change = difference(
            rows(std::min(n_sampled_cells * broken.shapes().n_per_cell(), broken.n_free()), check,
                 nullptr),
            matrix);
        return is_continuous ? joined(*space_, broken, n_components_, matrix) : matrix;
      }

      /// Pairs whose quadrature did not reach its tolerance, if there are any.
      static std::string open_pairs(const FaceRuleUse &use)
      {
        if (use.n_open == 0)
          return {};
        return " and " + std::to_string(use.n_open) +
               " pairs of faces do not reach the tolerance, which may add up to " +
               base::to_text(use.open, 1) + " of the diagonal for one face";
      }

      /// How entries were made.
      void note(const FaceRuleUse &use, double change, bool has_jumps)
      {
        const auto &[n_double, n_long, n_quad, n_octuple] = use.n_pairs;
        const std::string sample = is_of_cubes_ ? "all entries" : "a sample of entries";
        diagnostics_.notes.push_back(
            std::string(has_jumps ? "entries of continuous functions" : "entries") +
            " exact to round-off by integrals along lines: " +
            std::to_string(n_double + n_long + n_quad + n_octuple) +
            " integrals over pairs of faces, " + std::to_string(n_long) +
            " of them in long double and " + std::to_string(n_quad + n_octuple) +
            " with 124 bits or more, each to " + base::to_text(use.error, 1) +
            " of the diagonal; " +
            (has_jumps
                 ? "jumps are integrated by Gauss rules along the sides of one face, to about "
                   "1e-8, and by quadrature over the other, where a tolerance ten times "
                   "smaller would change "
                 : "quadrature over pairs of faces would change ") +
            sample + " by " + base::to_text(change, 1) +
            (has_jumps ? " of the largest entry (no change for linear fields)" + open_pairs(use)
                       : ""));
      }

      /// Rows for a check: the thinnest cells come first.
      std::size_t n_sampled() const
      {
        return std::min(n_sampled_cells *
                            (space_->is_continuous() ? 1 : space_->shapes().n_per_cell()),
                        space_->n_free());
      }

      static constexpr std::size_t n_sampled_cells = 4; ///< or vertices

      geometry::CubeLattice lattice_;
      bool is_of_cubes_; ///< the mesh is that of the lattice
      unsigned int n_components_;
      std::shared_ptr<const TetrahedralSpace> space_;
      std::shared_ptr<const algebra::CsrMatrix> free_;
      algebra::CsrMatrix constrained_;
      algebra::SparseOptions options_;
      method::Diagnostics diagnostics_;
    };
  } // namespace

  std::string refuse_tetrahedra(const physics::Kernel<3> &kernel, bool has_dilatation,
                                TetrahedralShapes shapes)
  {
    if (kernel.structure() == physics::Structure::tensor && shapes.is_trilinear())
      return "bond tensors and state-based solids have entries on tetrahedra and hexahedra by P1, "
             "DGP0, DGP1 and DGQ0; take these";
    if (has_dilatation && !FacePotential::has_power_parts(kernel.profile()))
      return "dilatations have entries on tetrahedra and hexahedra for influence functions that "
             "are sums of powers of r without a constant; write Kernel/type = 1/r, or polynomial "
             "with 0 as the coefficient of (r/δ)^0, or take Q1 or DGQ0 on a lattice of cubes";
    return FacePotential::refuse(kernel);
  }

  std::unique_ptr<method::DiscretisationInSpace>
  discretise_on_tetrahedra(const problem::Problem<3> &problem, TetrahedralShapes shapes)
  {
    if (const std::string reason =
            refuse_tetrahedra(problem.kernel, problem.dilatation.has_value(), shapes);
        !reason.empty())
      throw InputError(reason);
    return std::make_unique<GalerkinOnTetrahedra>(problem, shapes);
  }

  double expected_bytes_on_tetrahedra(const method::ProblemSize &size, TetrahedralShapes shapes)
  {
    if (shapes.is_continuous && !shapes.is_on_hexahedra && (size.has_factors || size.is_body))
      return expected_bytes_on_tetrahedra(size, TetrahedralShapes::discontinuous_linear());
    // entries of 12 bytes, for a while whole and parted; cells of the mesh; on moved meshes also
    // what all faces keep, and rows of faces that are assembled at a time; measured, but for
    // trilinear functions, where they are counted
    const bool has_jumps = !shapes.is_continuous && shapes.degree > 0 && !shapes.is_on_hexahedra;
    const double of_lattice_entry = has_jumps ? 30 : 20,
                 of_scattered_entry = shapes.is_trilinear() ? 75 : 50,
                 of_entry = size.is_scattered ? of_scattered_entry : of_lattice_entry,
                 of_cell = size.is_scattered && !shapes.is_trilinear() ? 1000 : 100,
                 of_pair = has_jumps ? 350 : 220; // of a lattice, known once
    const double reach = size.reach() / size.level.h,
                 n_types = shapes.is_continuous     ? 1
                           : shapes.is_on_hexahedra ? shapes.n_per_cell()
                                                    : 6 * shapes.n_per_cell(),
                 wider = shapes.is_continuous ? 2 : 1.2,
                 n_cubes = size.extents[0] * size.extents[1] * size.depth,
                 n_all = (size.extents[0] + 2 * reach) * (size.extents[1] + 2 * reach) *
                         (size.depth + 2 * reach),
                 n_near = 4 * M_PI / 3 * std::pow(reach + wider, 3) * n_types,
                 // of trilinear functions: all vertices of cells whose boxes are within the horizon
        n_columns = shapes.is_trilinear() ? 1.4 * (64 + 96 * reach + 12 * M_PI * reach * reach +
                                                   4 * M_PI / 3 * reach * reach * reach)
                                          : n_near;
    // 12 faces per vertex, with half of those around them
    const double n_pairs = 72 * 4 * M_PI / 3 * std::pow(reach + 1, 3);
    // with jumps, two cells' blocks of 16 entries by half of the cells about a face, in vectors
    // that have grown: 256 faces at a time, on a lattice only those of one cube, see RepeatedRows
    constexpr double grown = 1.5, n_at_once = 256, n_of_cube = 18;
    const double of_block = 8 + 128 * std::pow(size.n_components, 2),
                 of_face = of_block * grown * n_columns / shapes.n_per_cell(),
                 of_lattice_faces = has_jumps ? n_of_cube * of_face : 0,
                 of_scattered_faces = has_jumps                ? n_at_once * of_face
                                      : size.n_components == 1 ? 6e7
                                                               : 1e8,
                 of_faces = size.is_scattered ? of_scattered_faces : of_lattice_faces;
    return n_cubes * n_types * n_columns * std::pow(size.n_components, 2) * of_entry +
           n_all * 6 * of_cell + of_faces + n_pairs * of_pair;
  }
} // namespace plumbline::reference
