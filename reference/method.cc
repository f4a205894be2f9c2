#include "reference/method.h"

#include "reference/lattice/solution.h"
#include "reference/local/local_limit.h"
#include "reference/mesh/solution.h"
#include "study/lattice_solve.h"
#include "study/limit_proof.h"

#include <algorithm>

namespace plumbline::reference
{
  namespace
  {
    class GalerkinMethod : public study::Method
    {
    public:
      GalerkinMethod(unsigned int n_vertices, bool is_continuous, unsigned int degree)
          : n_vertices_(n_vertices), is_continuous_(is_continuous), degree_(degree)
      {
      }
      std::string name() const override
      {
        return std::string(is_continuous_ ? "" : "DG") + (n_vertices_ == 4 ? "Q" : "P") +
               std::to_string(degree_);
      }
      std::string family() const override { return "reference"; }
      std::string help() const override
      {
        return std::string(is_continuous_ ? "continuous" : "discontinuous") +
               " Galerkin of degree " + std::to_string(degree_) +
               (n_vertices_ == 4 ? " on quadrilaterals; entries exact to round-off on lattices and "
                                   "axis-aligned rectangles"
                                 : " on triangles") +
               (degree_ == 0 ? " (not asymptotically compatible)" : "");
      }
      study::Capabilities can() const override
      {
        using study::Capability;
        study::Capabilities can = {Capability::free_boundary, Capability::heterogeneous,
                                   Capability::nonlocal};
        if (n_vertices_ == 4)
          can.insert({Capability::lattice, Capability::quadrilaterals});
        else
          can.insert(Capability::triangles);
        return can;
      }
      std::string why_not(const scene::Scene &scene, const scene::Problem &problem) const override
      {
        if (problem.body && !scene.domain.is_floating &&
            std::all_of(problem.mesh->cells.begin(), problem.mesh->cells.end(),
                        [](const geometry::MeshCell &cell) { return cell.is_inside; }))
          return "no cell of Domain/mesh = " + scene.domain.mesh.name +
                 " has its centroid in Domain/fixed, so that nothing holds the body; give smaller "
                 "cells there, or take meshfree methods alone";
        if (scene.solver.iteration == base::Iteration::cg && problem.dilatation &&
            !problem.dilatation->is_symmetric())
          return "Solver/iteration = cg needs a symmetric operator, but harmonic means of "
                 "constants "
                 "that vary in space (LPS) make none; write automatic, gmres or bicgstab";
        return {};
      }
      unsigned int order() const override { return degree_ + 1; }
      std::shared_ptr<const study::Method> higher_degree() const override
      {
        return std::make_shared<GalerkinMethod>(n_vertices_, is_continuous_, degree_ + 1);
      }
      study::Solution solve(const scene::Scene &scene, const scene::Problem &problem) const override
      {
        study::Solution solution =
            problem.lattice ? lattice_solution(scene, problem, AxisShapes(is_continuous_, degree_))
                            : mesh_solution(scene, problem, is_continuous_, degree_);
        if (degree_ > 0)
          solution.diagnostics.limit = study::prove_galerkin(scene, problem, solution.diagnostics);
        return solution;
      }
      double expected_bytes(const scene::Scene &scene,
                            const study::ProblemSize &size) const override
      {
        if (!size.is_lattice())
          return expected_mesh_bytes(scene, size, n_vertices_, is_continuous_, degree_);
        const unsigned int n_axis = is_continuous_ ? degree_ : degree_ + 1;
        return study::expected_lattice_bytes(size, n_axis * n_axis, scene.is_vector() ? 2 : 1,
                                             scene.reach(size.level.horizon) / size.level.h + 1);
      }
      std::optional<study::DiscreteOperator>
      discrete_operator(const scene::Scene &scene, const scene::Problem &problem) const override
      {
        if (problem.lattice)
          return lattice_discrete(scene, problem, AxisShapes(is_continuous_, degree_));
        return mesh_discrete(scene, problem, is_continuous_, degree_);
      }

    private:
      unsigned int n_vertices_;
      bool is_continuous_;
      unsigned int degree_;
    };

    class LocalMethod : public study::Method
    {
    public:
      std::string name() const override { return "LOCAL"; }
      std::string family() const override { return "local"; }
      std::string help() const override
      {
        return "classical finite elements of degree 2 for the local limit (Poisson, Navier)";
      }
      study::Capabilities can() const override
      {
        using study::Capability;
        return {Capability::quadrilaterals, Capability::triangles, Capability::heterogeneous,
                Capability::zero_dilatation, Capability::mixed_dilatation};
      }
      std::string why_not(const scene::Scene &, const scene::Problem &) const override
      {
        return {};
      }
      study::Solution solve(const scene::Scene &, const scene::Problem &problem) const override
      {
        return as_solution(problem, solve_local(problem));
      }
    };
  } // namespace

  study::Methods methods()
  {
    study::Methods methods;
    for (const unsigned int n_vertices : {4u, 3u})
    {
      for (unsigned int degree = 1; degree <= 3; ++degree)
        methods.push_back(std::make_shared<GalerkinMethod>(n_vertices, true, degree));
      for (unsigned int degree = 0; degree <= 3; ++degree)
        methods.push_back(std::make_shared<GalerkinMethod>(n_vertices, false, degree));
    }
    methods.push_back(std::make_shared<LocalMethod>());
    return methods;
  }
} // namespace plumbline::reference
