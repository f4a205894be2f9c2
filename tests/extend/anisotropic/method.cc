#include "anisotropic/method.h"

#include "anisotropic/kernel.h"

#include <meshfree/lattice/nodal_field.h>
#include <method/lattice_discretisation.h>

#include <cmath>

namespace anisotropic
{
  namespace
  {
    using namespace plumbline;

    /// Row i is -Σ C(kernel_point) (u(x_i + ξ) - u_i) weight.
    algebra::Stencil make_stencil(const problem::Problem<2> &problem,
                                  const meshfree::Bonds<2> &bonds, double a)
    {
      const FibreKernel kernel(problem.kernel, a);
      algebra::Stencil stencil(1, static_cast<int>(std::ceil(problem.horizon() / bonds.h)) + 1);
      for (const meshfree::Bond<2> &bond : bonds.family)
      {
        const double entry = meshfree::radial_value(problem.kernel, bond) *
                             kernel.factor(bond.kernel_point) * bond.weight;
        stencil(0, 0, static_cast<int>(std::lround(bond.xi[0] / bonds.h)),
                static_cast<int>(std::lround(bond.xi[1] / bonds.h))) -= entry;
        stencil(0, 0, 0, 0) += entry;
      }
      return stencil;
    }

    class Discretisation : public method::LatticeDiscretisation
    {
    public:
      Discretisation(const problem::Problem<2> &problem, const meshfree::Bonds<2> &bonds, double a)
          : LatticeDiscretisation(problem, method::comparison_nodes(problem, 1),
                                  make_stencil(problem, bonds, a), {1})
      {
      }

      method::Diagnostics diagnostics() const override { return {}; }

    private:
      method::Vector load(const problem::Problem<2> &problem) const override
      {
        method::Vector load(nodes().size());
        for (int j = 0, position = 0; j < nodes().n[1]; ++j)
          for (int i = 0; i < nodes().n[0]; ++i, ++position)
            if (nodes().free(0, i, j))
            {
              const auto place = nodes().place(0, i, j);
              load[position] = problem.load.value(lattice().point(place[0], place[1]), 0);
            }
        return load;
      }

      method::Field field(std::vector<double> values) const override
      {
        const auto nodal = std::make_shared<const meshfree::NodalField>(
            meshfree::NodalField{lattice(), nodes(), std::move(values)});
        method::Field result;
        result.nodes = method::free_points(lattice(), nodes());
        for (const Point<2> &x : result.nodes)
          result.nodal.push_back(nodal->value(x, 0));
        result.averages = result.nodal;
        result.value = [nodal](const Point<2> &x, unsigned int c) { return nodal->value(x, c); };
        result.write_vtu = [nodal](const std::string &file) { nodal->write_vtu(file); };
        return result;
      }
    };

    class Fibres : public method::Method
    {
    public:
      Fibres(meshfree::Rule rule, double a) : rule_(std::move(rule)), a_(a) {}

      std::string name() const override { return "fibres " + rule_.name; }
      method::MethodFamily family() const override { return method::MethodFamily::meshfree; }
      std::string help() const override { return "fibres along x: " + rule_.help; }
      method::Capabilities can() const override
      {
        return {method::Capability::lattice, method::Capability::nonlocal};
      }
      std::string why_not(const problem::Problem<2> &problem) const override
      {
        return problem.n_components > 1 ? "fibres are for scalar kernels; choose one (Kernel/type)"
                                        : "";
      }
      std::unique_ptr<method::Discretisation> discretise(const problem::Problem<2> &problem,
                                                         const base::Communicator &) const override
      {
        const auto bonds =
            meshfree::lattice_bonds(rule_.in_plane(problem.kernel), problem.kernel,
                                    problem.lattice()->h(), problem.settings.geometry.backend);
        return std::make_unique<Discretisation>(problem, bonds, a_);
      }

    private:
      meshfree::Rule rule_;
      double a_;
    };
  } // namespace

  std::shared_ptr<const method::Method> fibres(meshfree::Rule rule, double a)
  {
    return std::make_shared<Fibres>(std::move(rule), a);
  }
} // namespace anisotropic
