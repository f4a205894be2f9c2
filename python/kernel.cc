#include "physics/kernel.h"
#include "arrays.h"
#include "bindings.h"

#include <cmath>
#include <optional>

namespace plumbline::python
{
  using namespace py::literals;
  using physics::Kernel;
  using physics::Structure;

  namespace
  {
    /// At most one of the three scales is given.
    Kernel<2> make_kernel(const std::string &type, double horizon, std::optional<double> diffusion,
                          std::optional<double> bulk_modulus, std::optional<double> constant,
                          const std::vector<double> &coefficients, unsigned int singularity,
                          double width, const std::vector<std::array<double, 2>> &table)
    {
      const physics::KernelType &row = physics::kernel_type(type);
      const physics::RadialProfile profile =
          row.make != nullptr ? row.make({coefficients, singularity, width, table}) : row.profile;
      const bool is_tensor = row.structure == Structure::tensor;
      if (diffusion.has_value() + bulk_modulus.has_value() + constant.has_value() > 1)
        throw InputError("Kernel: diffusion, bulk_modulus and constant each set the same factor; "
                         "give one of them");
      if (is_tensor ? diffusion.has_value() : bulk_modulus.has_value())
        throw InputError("Kernel: " + type +
                         (is_tensor ? " is a tensor, which has no diffusion; "
                                      "give bulk_modulus"
                                    : " is scalar, which has no bulk_modulus; "
                                      "give diffusion"));
      if (constant)
        return {row.structure, profile, horizon, *constant};
      return is_tensor ? Kernel<2>::with_bulk_modulus(profile, horizon, bulk_modulus.value_or(1))
                       : Kernel<2>::with_diffusion(profile, horizon, diffusion.value_or(1));
    }

    /// C(ξ) of bonds, 0 beyond the horizon.
    py::array values(const Kernel<2> &kernel, const Doubles &bonds)
    {
      const std::vector<Point<2>> xi = to_points(bonds, "xi");
      const unsigned int n = kernel.n_components();
      std::vector<double> result;
      for (std::size_t k = 0; k < xi.size(); ++k)
      {
        const double r = xi[k].norm();
        if (r == 0)
          throw InputError("xi[" + std::to_string(k) +
                           "] is 0, where kernels may be infinite; leave it out");
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            result.push_back(
                r < kernel.horizon() ? kernel.radial(r) * kernel.direction_factor(a, b, xi[k]) : 0);
      }
      const auto size = static_cast<py::ssize_t>(xi.size());
      return n == 1 ? to_array(std::move(result)) : to_array(std::move(result), {size, n, n});
    }

    double moment(const Kernel<2> &kernel, const std::array<int, 2> &alpha, unsigned int a,
                  unsigned int b)
    {
      if (alpha[0] < 0 || alpha[1] < 0 || a >= kernel.n_components() || b >= kernel.n_components())
        throw InputError("moment: alpha must not be negative, and a and b must be below " +
                         std::to_string(kernel.n_components()));
      return kernel.moment(alpha, a, b);
    }

    py::list all_types()
    {
      py::list result;
      for (const physics::KernelType &row : physics::kernel_types())
        result.append(py::dict("type"_a = row.name, "formula"_a = row.formula,
                               "is_tensor"_a = row.structure == Structure::tensor,
                               "source"_a = row.source));
      return result;
    }
  } // namespace

  void add_kernel(py::module_ &module)
  {
    py::class_<Kernel<2>>(
        module, "Kernel",
        R"(The kernel C(xi) of L u(x) = -int C(xi) (u(x+xi) - u(x)) dxi over |xi| < horizon.

Kernel(type, horizon, *, diffusion=None, bulk_modulus=None, constant=None, ...)

type          a name, see kernels()
horizon       > 0 [length]
diffusion     D of scalar kernels: L tends to -D Laplace as the horizon tends to 0; default 1
bulk_modulus  of tensor kernels: lambda = mu = 3/5 of it, plane strain [force/length^2]; default 1
constant      c itself instead of either
coefficients, singularity, width, table   of the types that have a profile of one's own)")
        .def(py::init(&make_kernel), "type"_a, "horizon"_a, py::kw_only(),
             "diffusion"_a = py::none(), "bulk_modulus"_a = py::none(), "constant"_a = py::none(),
             "coefficients"_a = std::vector<double>(), "singularity"_a = 0, "width"_a = 0.,
             "table"_a = std::vector<std::array<double, 2>>())
        .def_property_readonly("horizon", &Kernel<2>::horizon, "[length]")
        .def_property_readonly("constant", &Kernel<2>::constant)
        .def_property_readonly("n_components", &Kernel<2>::n_components,
                               "1 for scalar kernels, 2 for tensors")
        .def_property_readonly("is_tensor", [](const Kernel<2> &kernel)
                               { return kernel.structure() == Structure::tensor; })
        .def("__call__", values, "xi"_a,
             "C(xi) of bonds, xi of shape (n, 2) [length]: shape (n,), of tensors (n, 2, 2); 0 "
             "beyond the horizon.")
        .def("moment", moment, "alpha"_a, "a"_a = 0, "b"_a = 0,
             "The integral of C_ab(xi) xi_1^alpha[0] xi_2^alpha[1] over the ball; exact.")
        .def_property_readonly(
            "limit",
            [](const Kernel<2> &kernel)
            {
              const auto limit = kernel.limit();
              return kernel.n_components() == 1
                         ? py::dict("diffusion"_a = limit.diffusion)
                         : py::dict("lambda"_a = limit.lambda, "mu"_a = limit.mu);
            },
            "Constants of the local operator that L tends to.")
        .def("__repr__",
             [](const Kernel<2> &kernel)
             {
               return "<plumbline.Kernel, horizon " + std::to_string(kernel.horizon()) +
                      (kernel.n_components() == 1 ? ", scalar>" : ", tensor>");
             });
    module.def("kernels", all_types,
               "All kernels: a list of dicts with type, formula, is_tensor "
               "and source.");
  }
} // namespace plumbline::python
