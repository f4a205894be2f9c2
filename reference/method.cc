#include "reference/method.h"

#include "method/lattice_discretisation.h"
#include "reference/lattice/discretisation.h"
#include "reference/lattice/intervals.h"
#include "reference/lattice/polygonal_ball.h"
#include "reference/lattice/torus_motion.h"
#include "reference/local/local_limit.h"
#include "reference/mesh/discretisation.h"
#include "reference/strip/cracked_strip.h"
#include "reference/tetrahedra/discretisation.h"

#include <algorithm>

namespace plumbline::reference
{
  namespace
  {
    class GalerkinMethod : public method::Method,
                           public method::StripSolver,
                           public method::MethodOnIntervals
    {
    public:
      /// @param by_quadrature  its entries, where exact ones are known, too
      GalerkinMethod(unsigned int n_vertices, bool is_continuous, unsigned int degree,
                     bool by_quadrature = false)
          : n_vertices_(n_vertices), is_continuous_(is_continuous), degree_(degree),
            by_quadrature_(by_quadrature)
      {
      }
      std::string name() const override
      {
        return std::string(is_continuous_ ? "" : "DG") + (n_vertices_ == 4 ? "Q" : "P") +
               std::to_string(degree_) + (by_quadrature_ ? "-quadrature" : "");
      }
      method::MethodFamily family() const override { return method::MethodFamily::reference; }
      std::string help() const override
      {
        return std::string(is_continuous_ ? "continuous" : "discontinuous") +
               " Galerkin of degree " + std::to_string(degree_) +
               (n_vertices_ == 4
                    ? std::string(" on quadrilaterals; entries exact to round-off on lattices and "
                                  "axis-aligned rectangles") +
                          (is_on_hexahedra() ? "; in three dimensions on cubes or hexahedra" : "")
                    : std::string(" on triangles") +
                          (is_on_tetrahedra()
                               ? ", in three dimensions on tetrahedra (six per cube, or of a mesh)"
                               : "")) +
               (by_quadrature_ ? ", all entries by quadrature: to chart exact ones against" : "") +
               (degree_ == 0 ? " (not asymptotically compatible)" : "");
      }
      method::Capabilities can() const override
      {
        using method::Capability;
        method::Capabilities can = {
            Capability::meshes,        Capability::free_boundary, Capability::floating,
            Capability::heterogeneous, Capability::dilatation,    Capability::nonlocal,
            Capability::dynamic,       Capability::cracks,        Capability::damaged_dilatation,
            Capability::free_surfaces};
        if (n_vertices_ == 3)
          can.insert(Capability::triangles);
        else
          can.insert({Capability::lattice, Capability::quadrilaterals});
        if (n_vertices_ == 4 && is_continuous_)
          can.insert({Capability::double_well, Capability::periodic, Capability::line});
        if (!by_quadrature_ && (n_vertices_ == 4 ? degree_ <= 2 : is_on_tetrahedra()))
          can.insert(Capability::space);
        return can;
      }
      method::Capabilities can_in_space() const override
      {
        using method::Capability;
        method::Capabilities all = can();
        if (all.count(Capability::space) == 0)
          return all;
        if (n_vertices_ == 3)
          return {Capability::lattice,       Capability::meshes,     Capability::triangles,
                  Capability::nonlocal,      Capability::dynamic,    Capability::space,
                  Capability::heterogeneous, Capability::dilatation, Capability::free_boundary};
        if (!is_on_hexahedra())
          all.erase(Capability::quadrilaterals);
        if (degree_ > 0)
          for (const Capability capability : {Capability::heterogeneous, Capability::free_boundary})
            all.erase(capability);
        return all;
      }
      std::string why_not_in_space(const physics::Kernel<3> &kernel, bool has_dilatation,
                                   bool is_on_mesh) const override
      {
        if (n_vertices_ != 3 && !is_on_mesh)
          return "";
        const TetrahedralShapes shapes =
            n_vertices_ == 3 ? tetrahedral_shapes() : tetrahedral_shapes().on_hexahedra();
        return refuse_tetrahedra(kernel, has_dilatation, shapes);
      }
      std::string why_not(const problem::Problem<2> &problem) const override
      {
        if (problem.body() && !problem.is_floating() &&
            std::all_of(problem.mesh()->cells.begin(), problem.mesh()->cells.end(),
                        [](const geometry::MeshCell &cell) { return cell.is_inside; }))
          return "no cell of Domain/mesh = " + problem.on_mesh()->name +
                 " has its centroid in Domain/fixed, so that nothing holds the body; give smaller "
                 "cells there, or take meshfree methods alone";
        const problem::SurfaceTerms terms = problem.damage.surface_terms;
        if (problem.dilatation && problem.damage.is_there() &&
            terms != problem::SurfaceTerms::none && terms != problem::SurfaceTerms::energy)
          return "Galerkin methods have no forces in place of missing bonds, but Material/surface "
                 "terms is " +
                 base::word(terms) + "; write energy or none";
        if (problem.settings.solver.iteration == base::Iteration::cg && !is_symmetric(problem))
          return "Solver/iteration = cg needs a symmetric operator, but harmonic means of "
                 "constants that vary in space (LPS) and Material/surface terms = none at cracks "
                 "make none; write automatic, gmres or bicgstab";
        if (problem.damage.outside && problem.mesh() && !problem.mesh()->wholes.empty())
          return "Domain/outside is not available with Domain/sides = curved; write Domain/sides = "
                 "straight";
        if (by_quadrature_ && problem.mesh() && !problem.mesh()->wholes.empty())
          return "Domain/sides = curved has no entries by quadrature; take " +
                 GalerkinMethod(n_vertices_, is_continuous_, degree_).name() +
                 ", or write Domain/sides = straight";
        return refuse_curves(problem, is_continuous_, degree_);
      }
      unsigned int order() const override { return degree_ + 1; }
      std::shared_ptr<const method::Method> higher_degree() const override
      {
        return std::make_shared<GalerkinMethod>(n_vertices_, is_continuous_, degree_ + 1,
                                                by_quadrature_);
      }
      std::unique_ptr<method::Discretisation>
      discretise(const problem::Problem<2> &problem,
                 const base::Communicator &communicator) const override
      {
        if (problem.dimension() == 1)
          return discretise_on_line(problem, AxisShapes(is_continuous_, degree_));
        if (problem.lattice())
          return discretise_on_lattice(problem, AxisShapes(is_continuous_, degree_));
        return discretise_on_mesh(problem, is_continuous_, degree_,
                                  problem.settings.quadrature.exact_entries && !by_quadrature_,
                                  communicator);
      }
      std::unique_ptr<method::DiscretisationInSpace>
      discretise_in_space(const problem::Problem<3> &problem) const override
      {
        if (n_vertices_ == 3)
          return discretise_on_tetrahedra(problem, tetrahedral_shapes());
        if (problem.mesh)
          return discretise_on_tetrahedra(problem, tetrahedral_shapes().on_hexahedra());
        const AxisShapes shapes(is_continuous_, degree_);
        if (shapes.families().size() == 1)
          return discretise_on_box(problem, shapes);
        return discretise_by_families(problem, shapes);
      }
      std::string why_not_on_intervals(const physics::Kernel<1> &kernel) const override
      {
        if (n_vertices_ == 3)
          return "its cells are triangles";
        return reference::why_not_on_intervals(kernel, is_continuous_);
      }
      std::unique_ptr<method::IntervalDiscretisation>
      discretise_on_intervals(const problem::Problem<1> &problem) const override
      {
        return reference::discretise_on_intervals(problem, AxisShapes(is_continuous_, degree_));
      }
      const method::StripSolver *strip_solver() const override
      {
        return n_vertices_ == 4 ? this : nullptr;
      }
      std::unique_ptr<method::ContinuousMotion> continuous_motion(const physics::DoubleWell &law,
                                                                  const geometry::Box &torus,
                                                                  unsigned int dimension,
                                                                  unsigned int n) const override
      {
        return move_on_torus(law, torus, dimension, n);
      }
      method::StripState solve_strip(const method::RiceStrip &strip,
                                     const physics::Kernel<2> &influence) const override
      {
        return reference::solve_strip(strip, physics::deviatoric_kernel(influence, 1),
                                      AxisShapes(is_continuous_, degree_));
      }
      double expected_bytes(const method::ProblemSize &size) const override
      {
        if (!size.is_lattice())
          return expected_mesh_bytes(size, n_vertices_, is_continuous_, degree_);
        if (n_vertices_ == 3)
          return expected_bytes_on_tetrahedra(size, tetrahedral_shapes());
        if (size.depth > 0 && size.n_cells > 0 && is_on_hexahedra())
          return expected_bytes_on_tetrahedra(size, tetrahedral_shapes().on_hexahedra());
        const unsigned int n_axis = is_continuous_ ? degree_ : degree_ + 1;
        const unsigned int n_families = n_axis * n_axis * (size.depth > 0 ? n_axis : 1);
        return method::expected_lattice_bytes(size, n_families, size.n_components,
                                              size.reach() / size.level.h + 1);
      }
      bool is_distributed_in_space(const method::ProblemSize &size) const override
      {
        return n_vertices_ == 4 && has_one_family() && size.depth > 0 && size.n_cells == 0;
      }

    private:
      /// Of shape functions per cell.
      bool has_one_family() const { return degree_ == (is_continuous_ ? 1 : 0); }

      bool is_on_tetrahedra() const { return n_vertices_ == 3 && degree_ <= 1 && !by_quadrature_; }
      /// Q1 and DGQ0.
      bool is_on_hexahedra() const { return n_vertices_ == 4 && has_one_family(); }
      TetrahedralShapes tetrahedral_shapes() const
      {
        return is_continuous_ || degree_ == 0 ? TetrahedralShapes(is_continuous_)
                                              : TetrahedralShapes::discontinuous_linear();
      }

      unsigned int n_vertices_;
      bool is_continuous_;
      unsigned int degree_;
      bool by_quadrature_;
    };

    class LocalMethod : public method::Method
    {
    public:
      std::string name() const override { return "LOCAL"; }
      method::MethodFamily family() const override { return method::MethodFamily::local; }
      std::string help() const override
      {
        return "classical finite elements of degree 2 for the local limit (Poisson, Navier)";
      }
      method::Capabilities can() const override
      {
        using method::Capability;
        return {Capability::meshes,          Capability::quadrilaterals,
                Capability::triangles,       Capability::heterogeneous,
                Capability::dilatation,      Capability::zero_dilatation,
                Capability::mixed_dilatation};
      }
      std::string why_not(const problem::Problem<2> &problem) const override
      {
        return !problem.mesh() || problem.mesh()->wholes.empty()
                   ? ""
                   : "Domain/sides = curved is not for classical elements; write straight";
      }
      std::unique_ptr<method::Discretisation> discretise(const problem::Problem<2> &problem,
                                                         const base::Communicator &) const override
      {
        return discretise_local_limit(problem);
      }
    };
  } // namespace

  method::Methods methods()
  {
    method::Methods methods;
    for (const unsigned int n_vertices : {4u, 3u})
    {
      for (unsigned int degree = 1; degree <= 3; ++degree)
        methods.push_back(std::make_shared<GalerkinMethod>(n_vertices, true, degree));
      for (unsigned int degree = 0; degree <= 3; ++degree)
        methods.push_back(std::make_shared<GalerkinMethod>(n_vertices, false, degree));
    }
    for (const bool is_continuous : {true, false})
      methods.push_back(std::make_shared<GalerkinMethod>(3, is_continuous, 1, true));
    methods.push_back(std::make_shared<LocalMethod>());
    const method::Methods polygonal = polygonal_balls();
    methods.insert(methods.end(), polygonal.begin(), polygonal.end());
    return methods;
  }
} // namespace plumbline::reference
