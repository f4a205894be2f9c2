#include "base/error.h"
#include "scene/keys.h"
#include "scene/problem_sections.h"
#include "scene/values.h"

namespace plumbline::base
{
  template <>
  inline constexpr auto words<physics::Mean> = std::array{"arithmetic", "harmonic"};
} // namespace plumbline::base

namespace plumbline::scene
{
  void KernelSection::declare(Keys &keys)
  {
    std::vector<std::string> types;
    for (const physics::KernelType &one : physics::kernel_types())
      types.push_back(one.name);
    keys.add("type", type, one_of(types),
             "Radial profile of the kernel, scalar or bond tensor; see 'plumbline list kernels'.");
    keys.add("limit", limit,
             "The local operator that the kernel is scaled to as the horizon tends to 0: -1/2 "
             "Laplace (the moment of xi_1^2 is 1), -Laplace, Navier with 'bulk modulus' (bond "
             "tensors), or none: 'constant' is taken as it is.");
    keys.add("bulk modulus", bulk_modulus, positive(),
             "kappa of bond tensors; lambda = mu = 3 kappa / 5 (plane strain). [force/length^2]");
    keys.add("constant", constant, any_number(), "The factor c where limit = none.");
    keys.add("coefficients", coefficients, numbers(),
             "a_0, a_1, ... of the profile p(t) = a_0 + a_1 t + ..., t = r / horizon, of "
             "polynomial kernels.");
    keys.add("singularity", singularity, count(0, 1), "a of the polynomial profile p(t) / t^a.");
    keys.add("coefficient", coefficient,
             "a > 0 of a kernel a C: an expression in x and y. Empty: homogeneous. Needs a mesh.");
    keys.add(
        "materials", "", any_text(),
        [this](const std::string &text)
        {
          materials.clear();
          for (const Case &one : to_cases(text))
            materials.push_back({one.name, to_number(one.expression)});
        },
        "The same by the physical surfaces of a gmsh file: 'omega_steel: 5; omega_resin: 1; "
        "collar: 1', a positive number for each.");
    keys.add("symmetrisation", symmetrisation,
             "The mean of the coefficients at both ends of a bond.");
  }

  void KernelSection::complete()
  {
    const physics::KernelType &known = physics::kernel_type(type);
    structure = known.structure;
    profile = known.profile;
    if (!profile.empty() && !coefficients.empty())
      throw InputError("Kernel/coefficients is for polynomial kernels, but Kernel/type = '" + type +
                       "'; clear it or choose a polynomial type");
    if (profile.empty() && coefficients.empty())
      throw InputError("Kernel/type = '" + type +
                       "' needs its polynomial; give Kernel/coefficients");
    for (std::size_t i = 0; i < coefficients.size(); ++i)
      profile.push_back({coefficients[i], static_cast<int>(i) - static_cast<int>(singularity)});
  }
} // namespace plumbline::scene
