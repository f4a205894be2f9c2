#include "analysis/statics.h"
#include "arrays.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "bindings.h"
#include "method/discretisation.h"
#include "method/discretisation_in_space.h"
#include "method/linear_equations.h"
#include "problem/in_space.h"
#include "rule.h"

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

// The linear equations of a method as arrays.
namespace plumbline::python
{
  using namespace py::literals;

  namespace
  {
    template <int dim>
    void require_finite(const method::LinearEquations<dim> &made)
    {
      const auto check = [](const std::vector<double> &values, const std::string &name)
      {
        for (std::size_t k = 0; k < values.size(); ++k)
          if (!std::isfinite(values[k]))
            throw InputError(name + "[" + std::to_string(k) +
                             "] of the matrix is not finite; give "
                             "load and constraint that are finite "
                             "at all nodes");
      };
      check(made.load, "load");
      check(made.constraint, "constraint");
      check(made.rows.value, "data");
    }

    /// @param origin  of the nodes' coordinates
    template <int dim>
    py::dict to_dict(method::LinearEquations<dim> made, const std::string &name,
                     const Point<dim> &origin)
    {
      for (Point<dim> &x : made.nodes)
        x += origin - Point<dim>();
      const py::object volumes =
          made.volumes.empty() ? py::object(py::none()) : to_array(std::move(made.volumes));
      return py::dict("data"_a = to_array(std::move(made.rows.value)),
                      "indices"_a = to_array(std::move(made.rows.column)),
                      "indptr"_a = to_array(std::move(made.rows.start)),
                      "load"_a = to_array(std::move(made.load)), "nodes"_a = to_array(made.nodes),
                      "n_unknown_nodes"_a = made.n_free,
                      "constraint"_a = to_array(std::move(made.constraint)), "volumes"_a = volumes,
                      "n_components"_a = made.n_components,
                      "is_exact"_a = !made.has_quadrature_error, "method"_a = name);
    }

    template <int dim, class Discretisation>
    method::LinearEquations<dim> equations_of(const Discretisation &discretisation,
                                              const std::string &name,
                                              const problem::Problem<dim> &problem)
    {
      const auto *able = dynamic_cast<const method::HasLinearEquations<dim> *>(&discretisation);
      if (able == nullptr)
        throw InputError("method '" + name +
                         "' has no sparse matrix for this problem: bodies with a free boundary are "
                         "solved matrix-free, and LOCAL is not nonlocal; choose a problem with "
                         "constrained nodes around the domain and a meshfree rule or a Galerkin "
                         "method (plumbline.methods())");
      method::LinearEquations<dim> made = able->equations(problem);
      require_finite(made);
      return made;
    }

    void require_length(const std::optional<double> &h)
    {
      if (h && !(*h > 0 && std::isfinite(*h)))
        throw InputError("h = " + std::to_string(*h) + "; give a length above 0, or None");
    }

    /// Before anything is made at another h: the entries of a matrix with so many cells, whose rows
    /// reach so far.
    /// @throws InputError  they do not fit into memory
    void require_memory_at(double h, double n_cells, double reach, unsigned int dim,
                           unsigned int n_components)
    {
      const double m = reach / h, ball = dim == 2 ? M_PI * m * m : 4 * M_PI / 3 * m * m * m;
      base::require_memory(n_cells * ball * std::pow(n_components, 2) *
                               (sizeof(double) + sizeof(unsigned int)),
                           "the matrix at h = " + base::to_text(h, 6), "choose a larger h");
    }

    py::dict matrix(const problem::Case<2> &given, const py::object &method,
                    const std::optional<double> &h)
    {
      const auto found = to_method(method);
      require_length(h);
      if (h && !given.at_h)
        throw InputError("h = " + std::to_string(*h) +
                         ": this problem is defined on its own mesh only; omit h");
      method::LinearEquations<2> made;
      {
        const py::gil_scoped_release others;
        std::optional<problem::Problem<2>> other;
        if (h)
        {
          const geometry::Lattice *lattice = given.problem.lattice();
          const double n_cells =
              lattice != nullptr
                  ? static_cast<double>(lattice->n_cells()[0]) * lattice->n_cells()[1]
                  : static_cast<double>(given.problem.cells()->n_free);
          require_memory_at(*h, n_cells * std::pow(given.problem.h / *h, 2),
                            (given.problem.dilatation ? 2 : 1) * given.problem.horizon(), 2,
                            given.problem.n_components);
          other = given.at_h(*h);
        }
        const problem::Problem<2> &problem = other ? *other : given.problem;
        refuse_unless_able(*found, problem);
        if (problem.is_periodic())
          throw InputError(
              "a periodic problem has no constrained nodes, and its static operator is "
              "singular; matrix() needs a problem with a constraint around the domain");
        if (problem.dimension() == 1)
          throw InputError("matrix() is for two and three dimensions, and this problem has one");
        const auto discretisation = found->discretise(problem);
        if (discretisation->has_quadrature_error() && problem.settings.quadrature.tolerance > 0)
        {
          const auto n = analysis::solve(*found, problem).diagnostics.n_refinements;
          for (unsigned int k = 0; k < n; ++k)
            discretisation->refine_quadrature();
        }
        made = equations_of<2>(*discretisation, found->name(), problem);
      }
      return to_dict<2>(std::move(made), found->name(), given.problem.origin);
    }

    py::dict matrix_in_space(const problem::Problem<3> &given, const std::string &name,
                             const std::optional<double> &h)
    {
      const auto found = to_method_in_space(name, given);
      require_length(h);
      if (h && given.cells)
        throw InputError(
            "h = " + std::to_string(*h) +
            ": this problem is defined on its own mesh or scattered nodes only; omit h");
      method::LinearEquations<3> made;
      {
        const py::gil_scoped_release others;
        std::optional<problem::Problem<3>> other;
        if (h)
        {
          require_memory_at(*h,
                            static_cast<double>(given.lattice.size()) * std::pow(given.h() / *h, 3),
                            given.reach(), 3, given.n_components);
          other = problem::at_spacing(given, *h);
        }
        const problem::Problem<3> &problem = other ? *other : given;
        const auto discretisation = found->discretise_in_space(problem);
        made = equations_of<3>(*discretisation, found->name(), problem);
      }
      return to_dict<3>(std::move(made), found->name(), {});
    }
  } // namespace

  void add_matrix(py::module_ &module)
  {
    module.def(
        "matrix_arrays",
        [](const std::shared_ptr<problem::Case<2>> &problem, const py::object &method,
           const std::optional<double> &h) { return matrix(*problem, method, h); },
        "problem"_a.none(false), "method"_a, "h"_a = py::none());
    module.def(
        "matrix_in_space",
        [](const std::shared_ptr<problem::Problem<3>> &problem, const std::string &method,
           const std::optional<double> &h) { return matrix_in_space(*problem, method, h); },
        "problem"_a.none(false), "method"_a, "h"_a = py::none());
  }
} // namespace plumbline::python
