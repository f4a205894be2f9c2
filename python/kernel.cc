#include "physics/kernel.h"
#include "arrays.h"
#include "bindings.h"
#include "scene/kernel_table.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace plumbline::python
{
  using namespace py::literals;
  using physics::Kernel;
  using physics::Structure;

  namespace
  {
    using Table = std::vector<std::array<double, 2>>;

    /// Rows [t, rho], or a file of them.
    Table to_table(const py::object &given)
    {
      if (given.is_none())
        return {};
      const bool is_path = py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__");
      if (is_path)
        return scene::read_kernel_table(
            py::module_::import("os").attr("fspath")(given).cast<std::string>());
      try
      {
        return given.cast<Table>();
      }
      catch (const py::cast_error &)
      {
        throw InputError("Kernel: table is neither rows [t, rho] nor the name of a CSV file with "
                         "the columns t and rho; give for example [[0, 1], [1, 0]]");
      }
    }

    /// What a profile of one's own is given by, and no other.
    void check_profile(const physics::KernelType &row, bool has_coefficients, bool has_width,
                       bool has_table)
    {
      struct Argument
      {
        const char *key, *name, *example;
        bool is_given;
      };
      for (const Argument &one :
           {Argument{"coefficients", "coefficients",
                     "[a_0, a_1, ...] of p(t) = a_0 + a_1 t + ..., t = r / horizon; for example "
                     "coefficients=[1, -1]",
                     has_coefficients},
            Argument{"width", "width", "s in horizons; for example width=0.5", has_width},
            Argument{"table file", "table",
                     "rows [t, rho] or a CSV file with the columns t and rho, t = r / horizon from "
                     "0 to 1; for example table=[[0, 1], [1, 0]]",
                     has_table}})
        if (row.key == one.key && !one.is_given)
          throw InputError("Kernel: '" + row.name + "' = " + row.formula + " needs " + one.name +
                           ", " + one.example);
        else if (row.key != one.key && one.is_given)
          throw InputError("Kernel: '" + row.name + "' = " + row.formula + " has no " + one.name +
                           "; leave it out, or choose another type (plumbline.kernels())");
    }

    /// At most one of the three scales is given.
    template <int dim>
    Kernel<dim> make_kernel(const std::string &type, double horizon,
                            std::optional<double> diffusion, std::optional<double> bulk_modulus,
                            std::optional<double> constant, const std::vector<double> &coefficients,
                            unsigned int singularity, std::optional<double> width,
                            const py::object &table)
    {
      const physics::KernelType &row = physics::kernel_type(type);
      const Table rows = to_table(table);
      check_profile(row, !coefficients.empty(), width.has_value(), !rows.empty());
      const physics::RadialProfile profile =
          row.make != nullptr ? row.make({coefficients, singularity, width.value_or(0), rows})
                              : row.profile;
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
      return is_tensor ? Kernel<dim>::with_bulk_modulus(profile, horizon, bulk_modulus.value_or(1))
                       : Kernel<dim>::with_diffusion(profile, horizon, diffusion.value_or(1));
    }

    /// C(ξ) of bonds, 0 beyond the horizon.
    template <int dim>
    py::array values(const Kernel<dim> &kernel, const Doubles &bonds)
    {
      const std::vector<Point<dim>> xi = to_points<dim>(bonds, "xi");
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

    template <int dim>
    double moment(const Kernel<dim> &kernel, const std::array<int, dim> &alpha, unsigned int a,
                  unsigned int b)
    {
      if (*std::min_element(alpha.begin(), alpha.end()) < 0 || a >= kernel.n_components() ||
          b >= kernel.n_components())
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

    template <int dim>
    void bind_kernel(py::module_ &module, const char *name, const char *documentation)
    {
      const std::string n = std::to_string(dim);
      py::class_<Kernel<dim>>(module, name, documentation)
          .def(py::init(&make_kernel<dim>), "type"_a, "horizon"_a, py::kw_only(),
               "diffusion"_a = py::none(), "bulk_modulus"_a = py::none(), "constant"_a = py::none(),
               "coefficients"_a = std::vector<double>(), "singularity"_a = 0,
               "width"_a = py::none(), "table"_a = py::none())
          .def_property_readonly("horizon", &Kernel<dim>::horizon, "[length]")
          .def_property_readonly("constant", &Kernel<dim>::constant)
          .def_property_readonly("n_components", &Kernel<dim>::n_components,
                                 ("1 for scalar kernels, " + n + " for tensors").c_str())
          .def_property_readonly("is_tensor", [](const Kernel<dim> &kernel)
                                 { return kernel.structure() == Structure::tensor; })
          .def("__call__", values<dim>, "xi"_a,
               ("C(xi) of bonds, xi of shape (n, " + n + ") [length]: shape (n,), of tensors (n, " +
                n + ", " + n + "); 0 beyond the horizon.")
                   .c_str())
          .def("moment", moment<dim>, "alpha"_a, "a"_a = 0, "b"_a = 0,
               "The integral of C_ab(xi) times the product of xi_d^alpha[d] over the ball; exact.")
          .def_property_readonly(
              "limit",
              [](const Kernel<dim> &kernel)
              {
                const auto limit = kernel.limit();
                return kernel.n_components() == 1
                           ? py::dict("diffusion"_a = limit.diffusion)
                           : py::dict("lambda"_a = limit.lambda, "mu"_a = limit.mu);
              },
              "Constants of the local operator that L tends to.")
          .def("__repr__",
               [name = std::string(name)](const Kernel<dim> &kernel)
               {
                 return "<plumbline." + name + ", horizon " + std::to_string(kernel.horizon()) +
                        (kernel.n_components() == 1 ? ", scalar>" : ", tensor>");
               });
    }
  } // namespace

  void add_kernel(py::module_ &module)
  {
    bind_kernel<2>(
        module, "Kernel",
        R"(The kernel C(xi) of L u(x) = -int C(xi) (u(x+xi) - u(x)) dxi over |xi| < horizon.

Kernel(type, horizon, *, diffusion=None, bulk_modulus=None, constant=None, ...)

type          a name, see kernels()
horizon       > 0 [length]
diffusion     D of scalar kernels: L tends to -D Laplace as the horizon tends to 0; default 1
bulk_modulus  of tensor kernels: lambda = mu = 3/5 of it, plane strain [force/length^2]; default 1.
              For Young's modulus E give 5/8 E in plane stress, 2/3 E in plane strain
constant      c itself instead of either
coefficients  [a_0, a_1, ...], with singularity a: p(t) / t^a, t = r / horizon, of polynomial types
width         s in horizons, of gaussian and exponential types
table         of table types: rows [t, rho], or a CSV file with the columns t and rho)");
    bind_kernel<3>(
        module, "SpaceKernel",
        R"(The kernel in three dimensions, see plumbline.Kernel, whose arguments it takes.

bulk_modulus is that of a solid with nu = 1/4: lambda = mu = 3/5 of it [force/length^2])");
    module.def("kernels", all_types,
               "All kernels: a list of dicts with type, formula, is_tensor "
               "and source.");
  }
} // namespace plumbline::python
