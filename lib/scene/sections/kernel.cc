#include "base/error.h"
#include "scene/kernel_table.h"
#include "scene/keys.h"
#include "scene/problem_sections.h"
#include "scene/values.h"

#include <filesystem>

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
             "tensors), or none: 'constant' is used as given.");
    keys.add("bulk modulus", bulk_modulus, positive(),
             "kappa of bond tensors; lambda = mu = 3 kappa / 5 (plane strain). [force/length^2]");
    keys.add("constant", constant, any_number(), "The factor c if limit = none.");
    keys.add("coefficients", coefficients, numbers(),
             "a_0, a_1, ... of the profile p(t) = a_0 + a_1 t + ..., t = r / horizon, of "
             "polynomial kernels.");
    keys.add("singularity", singularity, count(0, 1), "a of the polynomial profile p(t) / t^a.");
    keys.add(
        "width", "", any_text(),
        [this](const std::string &text)
        {
          width.reset();
          if (!text.empty())
            width = to_number(text);
        },
        "s > 0 of gaussian and exponential kernels, in horizons: exp(-(t/s)^2) and exp(-t/s), t = "
        "r "
        "/ horizon.");
    keys.add("table file", table_file,
             "For tabulated kernels: a .csv file with the columns t = r / horizon, from 0 to 1, "
             "and rho; piecewise linear interpolation, 1000 rows at most.");
    keys.add("coefficient", coefficient,
             "a > 0 of a kernel a C: an expression in x and y. Empty: homogeneous. Needs a mesh.");
    keys.add(
        "materials", "", any_text(),
        [this](const std::string &text)
        {
          materials.clear();
          for (const NamedExpression &one : to_named_expressions(text))
            materials.push_back({one.name, to_number(one.expression)});
        },
        "The coefficient a by physical surface (in three dimensions volume) of a gmsh file: "
        "'omega_steel: 5; omega_resin: 1; "
        "collar: 1', a positive number for each.");
    keys.add("symmetrisation", symmetrisation,
             "Mean of the coefficients at the two ends of a bond.");
  }

  namespace
  {
    std::string types_with(const std::string &key)
    {
      std::vector<std::string> types;
      for (const physics::KernelType &one : physics::kernel_types())
        if (one.key == key)
          types.push_back(one.name);
      return join(types, ", ");
    }
  } // namespace

  void KernelSection::complete(const std::string &folder)
  {
    const physics::KernelType &known = physics::kernel_type(type);
    structure = known.structure;
    for (const auto &[key, is_given] :
         {std::pair("coefficients", !coefficients.empty()), std::pair("width", width.has_value()),
          std::pair("table file", !table_file.empty())})
    {
      if (is_given && known.key != key)
        throw InputError("Kernel/" + std::string(key) + " is for " + types_with(key) +
                         ", but Kernel/type = '" + type + "'; clear it or choose one of them");
      if (!is_given && known.key == key)
        throw InputError("Kernel/type = '" + type + "' needs a profile; give Kernel/" + key +
                         " ('plumbline describe Kernel/" + key + "' explains it)");
    }
    profile = known.profile;
    if (known.make == nullptr)
      return;
    physics::ProfileKeys given{coefficients, singularity, width.value_or(0), {}};
    const std::string file = (std::filesystem::path(folder) / table_file).string();
    try
    {
      if (!table_file.empty())
        given.table = read_kernel_table(file);
      profile = known.make(given);
    }
    catch (const InputError &error)
    {
      throw InputError(table_file.empty() ? error.what()
                                          : "Kernel/table file = " + file + ": " + error.what());
    }
  }
} // namespace plumbline::scene
