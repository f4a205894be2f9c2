#include "study/energy.h"

#include "base/choice.h"
#include "base/error.h"
#include "method/discrete_operator.h"
#include "method/discretisation.h"
#include "scene/study_sections.h"
#include "study/equations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <utility>

namespace plumbline::study
{
  namespace
  {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();

    /// Of the row's node.
    template <int dim>
    double weight(const method::LinearEquations<dim> &of, std::size_t row)
    {
      return of.volumes.empty() ? 1 : of.volumes[row / of.n_components];
    }

    /// Values less the mean of the constrained ones, component by component: a constant has no
    /// energy and would cancel. Zero constraints stay zero, for which the form is that of free
    /// nodes alone.
    std::vector<double> without_mean(std::vector<double> values, std::size_t n_free,
                                     unsigned int n_components)
    {
      std::vector<double> mean(n_components, 0);
      const double n = static_cast<double>(values.size() - n_free) / n_components;
      for (std::size_t i = n_free; i < values.size(); ++i)
        mean[i % n_components] += values[i] / n;
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] -= mean[i % n_components];
      return values;
    }

    /// Values at nodes in the order of others, which are the same ones. Nodes of discontinuous
    /// spaces coincide; such values must be in that order already.
    /// @param h  of the level: nodes are farther apart than a thousandth of it
    template <int dim>
    std::vector<double> in_order(const std::vector<dealii::Point<dim>> &order,
                                 const std::vector<dealii::Point<dim>> &nodes,
                                 const std::vector<double> &values, double h)
    {
      constexpr double close = 1e-3;
      if (std::equal(order.begin(), order.end(), nodes.begin(), nodes.end(),
                     [&](const auto &a, const auto &b) { return a.distance(b) < close * h; }))
        return values;
      const auto key = [&](const dealii::Point<dim> &x)
      {
        std::array<long long, dim> k{};
        for (unsigned int d = 0; d < dim; ++d)
          k[d] = std::llround(x[d] / (close * h) + .25); // not between two
        return k;
      };
      std::map<std::array<long long, dim>, std::size_t> place;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!place.emplace(key(nodes[i]), i).second)
          throw NumericalError("the norm energy: two nodes coincide and cannot be distinguished; "
                               "write nodal or averages norms");
      const std::size_t n_components = nodes.empty() ? 1 : values.size() / nodes.size();
      std::vector<double> result;
      for (const dealii::Point<dim> &x : order)
      {
        const auto found = place.find(key(x));
        if (found == place.end())
          throw NumericalError("the norm energy needs a value at every free node of the method; "
                               "write nodal or averages norms");
        for (std::size_t c = 0; c < n_components; ++c)
          result.push_back(values[found->second * n_components + c]);
      }
      return result;
    }

    double problem_size(const problem::Problem<2> &problem)
    {
      return problem.h;
    }

    double problem_size(const problem::Problem<3> &problem)
    {
      return problem.h();
    }

    /// Σ w_i |a_ij| over free nodes.
    template <int dim>
    double sum_of_sizes(const method::LinearEquations<dim> &of)
    {
      double sum = 0;
      for (std::size_t row = 0; row < of.rows.n_rows(); ++row)
        for (std::size_t k = of.rows.start[row]; k < of.rows.start[row + 1]; ++k)
          if (of.rows.column[k] < of.rows.n_rows())
            sum += weight(of, row) * std::abs(of.rows.value[k]);
      return sum;
    }
  } // namespace

  template <int dim>
  double energy(const method::LinearEquations<dim> &of, const std::vector<double> &values)
  {
    const std::size_t n_free = of.rows.n_rows();
    const std::vector<double> u = without_mean(values, n_free, of.n_components);
    double sum = 0;
    for (std::size_t row = 0; row < n_free; ++row)
      for (std::size_t k = of.rows.start[row]; k < of.rows.start[row + 1]; ++k)
      {
        const std::size_t column = of.rows.column[k];
        const double term = of.rows.value[k] * u[column];
        sum += weight(of, row) * u[row] * term;
        if (column >= n_free) // less the same component of the constrained node
          sum += weight(of, row) * term *
                 (u[row] - u[column - column % of.n_components + row % of.n_components]);
      }
    return .5 * sum;
  }

  template <int dim>
  std::optional<double> energy_norm(const method::LinearEquations<dim> &of,
                                    const std::vector<double> &e)
  {
    constexpr double safety = 10;
    double sum = 0, terms = 0;
    for (std::size_t row = 0; row < of.rows.n_rows(); ++row)
      for (std::size_t k = of.rows.start[row]; k < of.rows.start[row + 1]; ++k)
        if (of.rows.column[k] < of.rows.n_rows())
        {
          const double term = weight(of, row) * e[row] * of.rows.value[k] * e[of.rows.column[k]];
          sum += term;
          terms += std::abs(term);
        }
    if (!std::isfinite(sum))
      throw NumericalError("the energy of the error is not a finite number: u is not finite at "
                           "some node; check Problem/solution and local solution");
    if (sum < -safety * epsilon * terms)
      return {};
    return std::sqrt(std::max(0., sum));
  }

  namespace
  {
    /// A method's bilinear form, its constrained nodes having the values of the problem.
    template <int dim>
    struct Form
    {
      unsigned int n_components = 1;
      std::vector<dealii::Point<dim>> nodes; ///< the free ones
      std::function<double(const std::vector<double> &free)> energy;
      std::function<std::optional<double>(const std::vector<double> &error)> norm;
      double largest_norm = 0; ///< see enter_energies; 0: not known
    };

    template <int dim>
    Form<dim> form(method::LinearEquations<dim> equations)
    {
      const auto of = std::make_shared<const method::LinearEquations<dim>>(std::move(equations));
      const auto energy_of = [of](std::vector<double> values)
      {
        values.insert(values.end(), of->constraint.begin(), of->constraint.end());
        return energy(*of, values);
      };
      return {of->n_components,
              {of->nodes.begin(), of->nodes.begin() + static_cast<std::ptrdiff_t>(of->n_free)},
              energy_of,
              [of](const std::vector<double> &e) { return energy_norm(*of, e); },
              std::sqrt(sum_of_sizes(*of))};
    }

    /// Of a body with a free boundary, whose equations are times the nodes' volumes and whose
    /// constraint is 0.
    Form<2> form(const method::Discretisation &body)
    {
      const auto of = std::make_shared<const method::DiscreteOperator>(body.matrix());
      const auto square = [of](const std::vector<double> &u)
      {
        std::vector<double> Au(u.size());
        of->action(u, Au);
        std::pair<double, double> sums; // of terms, and of their sizes
        for (std::size_t i = 0; i < u.size(); ++i)
        {
          sums.first += u[i] * Au[i];
          sums.second += std::abs(u[i] * Au[i]);
        }
        return sums;
      };
      constexpr double round_off = 1e-12; // of sums by transforms
      return {of->n_components, of->nodes,
              [square](const std::vector<double> &u) { return .5 * square(u).first; },
              [square](const std::vector<double> &e) -> std::optional<double>
              {
                const auto [sum, sizes] = square(e);
                if (sum < -round_off * sizes)
                  return {};
                return std::sqrt(std::max(0., sum));
              }};
    }

    Form<2> form(const method::Method &method, const problem::Problem<2> &problem)
    {
      const auto discretisation = method.discretise(problem);
      const bool has_matrix =
          dynamic_cast<const method::HasLinearEquations<2> *>(discretisation.get()) != nullptr;
      if (!has_matrix && problem.body() != nullptr)
        return form(*discretisation);
      return form(equations_of(*discretisation, problem, method.name()));
    }

    Form<3> form(const method::Method &method, const problem::Problem<3> &problem)
    {
      return form(equations_of(method, problem));
    }

    /// The energy of a known solution, and the energy norm of the error of `own`.
    template <int dim>
    void enter_known(const Form<dim> &of, const std::vector<double> &own, scene::Target target,
                     const problem::Field<dim> &u, const std::string &unit,
                     const std::string &norm_unit, Record &record)
    {
      std::vector<double> known, error;
      for (const dealii::Point<dim> &node : of.nodes)
        for (unsigned int c = 0; c < of.n_components; ++c)
        {
          known.push_back(u(node, c));
          error.push_back(own[error.size()] - known.back());
        }
      record.set("energy of " + base::word(target), of.energy(known), unit);
      if (const auto norm = of.norm(error))
        record.set(scene::DecisiveError{scene::Norm::energy, target}.text(), *norm, norm_unit);
      else
        record.notes.push_back("no energy norm of the error against the " + base::word(target) +
                               " solution: a(e, e) is negative because the rule's operator is "
                               "not positive definite");
    }
  } // namespace

  template <int dim>
  void
  enter_energies(const method::Method &method, const std::vector<scene::Norm> &norms,
                 const problem::Problem<dim> &problem, const std::vector<dealii::Point<dim>> &nodes,
                 const std::vector<double> &nodal, Record &record, const base::Communicator &ranks)
  {
    if (!has_energy(norms))
      return;
    if (ranks.n_ranks() > 1)
      throw InputError("Study/norms = energy is computed on one rank; run without mpirun, or write "
                       "nodal or averages norms");
    const Form<dim> of = form(method, problem);
    const std::vector<double> own = in_order(of.nodes, nodes, nodal, problem_size(problem));
    const std::string unit = dim == 2 ? "b u length^2" : "b u length^3",
                      norm_unit = "(" + unit + ")^(1/2)";
    const double stored = of.energy(own);
    record.set("energy", stored, unit);
    if (of.largest_norm > 0)
      record.set("largest energy norm", of.largest_norm,
                 "(b length^" + std::to_string(dim) + " / u)^(1/2)");
    record.set("energy size",
               stored > 0                ? std::sqrt(2 * stored)
               : record.has("variation") ? of.largest_norm * record["variation"]
                                         : 0,
               norm_unit);
    if (problem.solution)
      enter_known(of, own, scene::Target::exact, *problem.solution, unit, norm_unit, record);
    if (problem.local_solution)
      enter_known(of, own, scene::Target::local, *problem.local_solution, unit, norm_unit, record);
  }

#define INSTANTIATE(dim)                                                                           \
  template double energy(const method::LinearEquations<dim> &, const std::vector<double> &);       \
  template std::optional<double> energy_norm(const method::LinearEquations<dim> &,                 \
                                             const std::vector<double> &);                         \
  template void enter_energies(const method::Method &, const std::vector<scene::Norm> &,           \
                               const problem::Problem<dim> &,                                      \
                               const std::vector<dealii::Point<dim>> &,                            \
                               const std::vector<double> &, Record &, const base::Communicator &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace plumbline::study
