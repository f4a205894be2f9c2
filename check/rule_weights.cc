#include "check/rule_weights.h"

#include "base/error.h"
#include "base/number_text.h"
#include "meshfree/rules/rules.h"
#include "scene/values.h"

#include <cmath>

namespace plumbline::check
{
  namespace
  {
    /// Weights do not depend on its constant.
    template <int dim>
    physics::Kernel<dim> kernel_of(const RuleOnLattice &options)
    {
      const physics::KernelType &type = physics::kernel_type(options.kernel);
      if (type.make != nullptr)
        throw InputError("--kernel: the profile of '" + options.kernel +
                         "' takes keys of a scene; choose another one ('plumbline list kernels')");
      const double horizon = options.m * options.h;
      return type.structure == physics::Structure::tensor
                 ? physics::Kernel<dim>::with_bulk_modulus(type.profile, horizon, 1)
                 : physics::Kernel<dim>::with_diffusion(type.profile, horizon, 1);
    }

    template <int dim>
    std::string csv(const RuleOnLattice &options,
                    const meshfree::NeighbourhoodQuadrature<dim> &rule,
                    const physics::Kernel<dim> &kernel)
    {
      constexpr int digits = 17;
      const auto bonds = lattice_bonds(rule, kernel, options.h, geometry::Backend::fast);
      const auto point = [&](const dealii::Point<dim> &x)
      {
        std::string text;
        for (unsigned int d = 0; d < dim; ++d)
          text += (d == 0 ? "" : ",") + base::to_text(x[d], digits);
        return text;
      };
      std::string lines = dim == 2 ? "x,y,weight,qx,qy,area\n" : "x,y,z,weight,qx,qy,qz,volume\n";
      for (const meshfree::Bond<dim> &bond : bonds.family)
        lines += point(bond.xi) + ',' + base::to_text(bond.weight, digits) + ',' +
                 point(bond.kernel_point) + ',' + base::to_text(bond.area, digits) + '\n';
      return lines;
    }
  } // namespace

  std::string weights_csv(const RuleOnLattice &options)
  {
    constexpr double most_ratio = 50;
    if (!(options.m >= 1 && options.m <= most_ratio))
      throw InputError("--m: horizon / h = " + base::to_text(options.m, 4) +
                       " is not between 1, where a node has its first neighbours, and 50");
    if (!(options.h > 0) || !std::isfinite(options.h))
      throw InputError("--h: the mesh size is " + base::to_text(options.h, 4) +
                       "; give a positive length");
    const meshfree::Rule rule = meshfree::find_rule(scene::method_name(options.rule), "rule");
    if (options.dimension == 2)
    {
      const auto kernel = kernel_of<2>(options);
      return csv<2>(options, rule.in_plane(kernel), kernel);
    }
    if (options.dimension == 3)
    {
      const auto kernel = kernel_of<3>(options);
      return csv<3>(options, rule.in_space(kernel), kernel);
    }
    throw InputError("--dimension: " + std::to_string(options.dimension) + " is neither 2 nor 3");
  }
} // namespace plumbline::check
