#include "analysis/stability.h"

#include "algebra/sparse_system.h"
#include "analysis/critical_step.h"
#include "base/error.h"
#include "geometry/for_each_index.h"
#include "physics/load.h"
#include "physics/load_in_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plumbline::analysis
{
  namespace
  {
    using algebra::CsrMatrix;
    using method::DiscreteOperatorOf;
    using Values = std::vector<double>;

    /// y = A x.
    template <int dim>
    void apply(const DiscreteOperatorOf<dim> &matrix, const Values &x, Values &y)
    {
      if (matrix.action)
        return matrix.action(x, y);
      const CsrMatrix &rows = matrix.rows;
      for (std::size_t i = 0; i < rows.n_rows(); ++i)
      {
        y[i] = 0;
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          y[i] += rows.value[k] * x[rows.column[k]];
      }
    }

    /// Of each unknown.
    template <int dim>
    Values masses(const DiscreteOperatorOf<dim> &matrix)
    {
      Values mass;
      for (const double m : matrix.mass)
        mass.insert(mass.end(), matrix.n_components, m);
      return mass;
    }

    /// The symmetric part of M^(-1/2) A M^(-1/2).
    template <int dim>
    algebra::Action symmetric_part(const DiscreteOperatorOf<dim> &matrix)
    {
      Values scale = masses(matrix);
      for (double &s : scale)
        s = 1 / std::sqrt(s);
      if (matrix.action)
        return [&matrix, scale, scaled = Values(scale.size())](const Values &x, Values &y) mutable
        {
          for (std::size_t i = 0; i < x.size(); ++i)
            scaled[i] = scale[i] * x[i];
          matrix.action(scaled, y);
          for (std::size_t i = 0; i < x.size(); ++i)
            y[i] *= scale[i];
        };
      return [&rows = matrix.rows, scale](const Values &x, Values &y)
      {
        y.assign(x.size(), 0);
        for (std::size_t i = 0; i < rows.n_rows(); ++i)
          for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          {
            const auto j = rows.column[k];
            const double half = .5 * scale[i] * rows.value[k] * scale[j];
            y[i] += half * x[j];
            y[j] += half * x[i];
          }
      };
    }

    /// Column by column from the action of a symmetric A.
    template <int dim>
    CsrMatrix rows_of(const DiscreteOperatorOf<dim> &matrix)
    {
      constexpr std::size_t most_unknowns = 1500;
      const std::size_t n = matrix.size();
      if (!matrix.rows.start.empty() || n > most_unknowns)
        return matrix.rows;
      CsrMatrix rows;
      rows.start.assign(1, 0);
      Values unit(n), column(n);
      for (std::size_t i = 0; i < n; ++i)
      {
        unit[i] = 1;
        matrix.action(unit, column);
        unit[i] = 0;
        for (unsigned int j = 0; j < n; ++j)
          if (column[j] != 0)
          {
            rows.column.push_back(j);
            rows.value.push_back(column[j]);
          }
        rows.start.push_back(rows.column.size());
      }
      return rows;
    }

    /// ‖A⁻¹M‖∞ = ‖M A⁻ᵀ‖₁ for a positive definite A. The convex function ‖M A⁻ᵀ x‖₁ climbs over the
    /// corners of the unit ball.
    double inverse_norm(const CsrMatrix &rows, const Values &mass, bool is_m_matrix,
                        bool is_symmetric)
    {
      constexpr unsigned int most_steps = 5;
      algebra::SparseOptions options;
      options.is_symmetric = is_symmetric;
      options.tolerance = 1e-10;
      const auto solve = [&](const CsrMatrix &matrix, const Values &right_hand_side)
      {
        return algebra::solve_sparse(matrix, right_hand_side, options, base::Communicator::alone())
            .values;
      };
      const auto largest = [](const Values &values)
      {
        return static_cast<std::size_t>(std::max_element(values.begin(), values.end(),
                                                         [](double a, double b)
                                                         { return std::abs(a) < std::abs(b); }) -
                                        values.begin());
      };
      const std::size_t n = mass.size();
      if (is_m_matrix)
      {
        const Values u = solve(rows, mass);
        return std::abs(u[largest(u)]);
      }
      const CsrMatrix other = is_symmetric ? CsrMatrix() : algebra::transpose(rows);
      Values x(n, 1 / static_cast<double>(n));
      double norm = 0;
      for (unsigned int step = 0; step < most_steps; ++step)
      {
        Values y = solve(is_symmetric ? rows : other, x), sign(n);
        double now = 0;
        for (std::size_t i = 0; i < n; ++i)
        {
          now += std::abs(mass[i] * y[i]);
          sign[i] = y[i] < 0 ? -mass[i] : mass[i];
        }
        if (now <= norm)
          break;
        norm = now;
        const Values slope = solve(rows, sign);
        x.assign(n, 0);
        x[largest(slope)] = 1;
      }
      return norm;
    }

    /// Of M⁻¹A, by the ends of the symmetric part's spectrum where that tells them.
    algebra::Eigenvalues eigenvalues_of(CsrMatrix rows, const Values &mass, const Stability &known)
    {
      if (known.is_symmetric() && known.smallest >= -1e-10 * known.largest)
        return {known.smallest, std::abs(known.smallest), known.largest, 0, 2};
      for (std::size_t i = 0; i < rows.n_rows(); ++i)
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          rows.value[k] /= mass[i];
      try
      {
        return known.has_signs ? algebra::eigenvalues(rows) : algebra::Eigenvalues();
      }
      catch (const NumericalError &)
      {
        return {}; // they do not settle: not known
      }
    }

    double binomial(int n, int k)
    {
      return k == 0 ? 1 : binomial(n - 1, k - 1) * n / k;
    }

    /// L_δ x^α e_d at x, component c, exact by the kernel's moments.
    template <int dim>
    double image(const physics::Kernel<dim> &kernel, const dealii::Point<dim> &x,
                 const std::array<int, dim> &alpha, unsigned int c, unsigned int d)
    {
      double sum = 0;
      std::array<int, 3> last{};
      std::copy(alpha.begin(), alpha.end(), last.begin());
      geometry::for_each_index({0, 0, 0}, {last[0] + 1, last[1] + 1, last[2] + 1},
                               [&](const std::array<int, 3> &moved)
                               {
                                 if (moved == std::array<int, 3>{})
                                   return;
                                 double factor = 1;
                                 std::array<int, dim> beta;
                                 for (unsigned int k = 0; k < dim; ++k)
                                 {
                                   beta[k] = moved[k];
                                   factor *= binomial(alpha[k], beta[k]) *
                                             std::pow(x[k], alpha[k] - beta[k]);
                                 }
                                 sum -= factor * kernel.moment(beta, c, d);
                               });
      return sum;
    }

    template <int dim>
    Modes modes_on(const std::vector<dealii::Point<dim>> &nodes, unsigned int n_components)
    {
      Modes modes{n_components, dim, {}, {}};
      for (const dealii::Point<dim> &x : nodes)
        modes.nodes.emplace_back(x[0], x[1], dim == 3 ? x[dim - 1] : 0);
      return modes;
    }
  } // namespace

  template <int dim>
  Stability measure(const DiscreteOperatorOf<dim> &matrix)
  {
    Stability result;
    result.n_unknowns = matrix.size();
    result.is_collocated = matrix.is_collocated;
    const auto spectrum = algebra::spectrum(symmetric_part(matrix), matrix.size());
    result.smallest = spectrum.smallest;
    result.largest = largest_eigenvalue(symmetric_part(matrix), matrix.size());
    result.n_zero = static_cast<unsigned int>(spectrum.zero_modes.size());
    result.modes = modes_on(matrix.nodes, matrix.n_components);
    result.modes.values = spectrum.zero_modes;
    if (result.n_zero == 0)
      result.modes.values = {spectrum.lowest_mode};
    const Values mass = masses(matrix);
    for (Values &mode : result.modes.values)
      for (std::size_t i = 0; i < mass.size(); ++i)
        mode[i] /= std::sqrt(mass[i]);

    const CsrMatrix rows = rows_of(matrix);
    result.has_signs = rows.n_rows() > 0;
    if (result.has_signs)
    {
      result.signs = algebra::check_signs(rows);
      result.is_norm_exact = result.signs.is_m_matrix();
    }
    result.eigenvalues = eigenvalues_of(rows, mass, result);
    if (result.has_signs && result.is_definite())
      try
      {
        result.inverse_norm = inverse_norm(rows, mass, result.is_norm_exact, result.is_symmetric());
      }
      catch (const NumericalError &)
      {
        result.inverse_norm = 0; // the solver gives up: not known
      }
    return result;
  }

  template Stability measure(const DiscreteOperatorOf<2> &);
  template Stability measure(const DiscreteOperatorOf<3> &);

  namespace
  {
    /// A f / m for a field at the nodes.
    template <int dim, class Field>
    Values act(const DiscreteOperatorOf<dim> &matrix, const Field &f)
    {
      const unsigned int nc = matrix.n_components;
      Values x(matrix.size()), y(matrix.size());
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = f(matrix.nodes[i / nc], i % nc);
      apply(matrix, x, y);
      for (std::size_t i = 0; i < y.size(); ++i)
        y[i] /= matrix.mass[i / nc];
      return y;
    }

    /// Nodes where constants are mapped to 0.
    template <int dim>
    std::vector<char> inner_nodes(const DiscreteOperatorOf<dim> &matrix, double size)
    {
      constexpr double rounding = 1e-9;
      std::vector<char> is_inner(matrix.nodes.size(), 1);
      for (unsigned int d = 0; d < matrix.n_components; ++d)
      {
        const Values y =
            act(matrix, [&](const auto &, unsigned int c) { return c == d ? 1. : 0.; });
        for (std::size_t i = 0; i < y.size(); ++i)
          if (std::abs(y[i]) > rounding * size)
            is_inner[i / matrix.n_components] = 0;
      }
      return is_inner;
    }

    /// All α with |α| = degree.
    template <int dim>
    std::vector<std::array<int, dim>> exponents(int degree)
    {
      std::vector<std::array<int, dim>> result;
      for (int b = 0; b <= degree; ++b)
        for (int c = 0; c <= (dim == 3 ? degree - b : 0); ++c)
        {
          std::array<int, dim> alpha{degree - b - c, b};
          if constexpr (dim == 3)
            alpha[2] = c;
          result.push_back(alpha);
        }
      return result;
    }

    template <int dim>
    double power(const dealii::Point<dim> &x, const std::array<int, dim> &alpha)
    {
      double value = 1;
      for (unsigned int d = 0; d < dim; ++d)
        value *= std::pow(x[d], alpha[d]);
      return value;
    }

    template <int dim>
    unsigned int reproduced_degree(const DiscreteOperatorOf<dim> &matrix,
                                   const physics::Kernel<dim> &kernel,
                                   const std::vector<char> &is_inner, double size)
    {
      constexpr int highest = 4;
      constexpr double tolerance = 1e-8;
      const unsigned int nc = matrix.n_components;
      dealii::Point<dim> centre; // polynomials about it cancel least, wherever the nodes are
      for (const dealii::Point<dim> &x : matrix.nodes)
        centre += (x - dealii::Point<dim>()) / static_cast<double>(matrix.nodes.size());
      const auto from_centre = [&](const dealii::Point<dim> &x)
      { return dealii::Point<dim>(x - centre); };
      for (int degree = 1; degree <= highest; ++degree)
      {
        double worst = 0, scale = size * std::pow(kernel.horizon(), degree);
        for (const std::array<int, dim> &alpha : exponents<dim>(degree))
          for (unsigned int d = 0; d < nc; ++d)
          {
            const Values y = act(matrix, [&](const dealii::Point<dim> &x, unsigned int c)
                                 { return c == d ? power<dim>(from_centre(x), alpha) : 0; });
            for (std::size_t i = 0; i < y.size(); ++i)
              if (is_inner[i / nc] != 0)
              {
                const double exact =
                    image<dim>(kernel, from_centre(matrix.nodes[i / nc]), alpha, i % nc, d);
                scale = std::max(scale, std::abs(exact));
                worst = std::max(worst, std::abs(y[i] - exact));
              }
          }
        if (worst > tolerance * scale)
          return static_cast<unsigned int>(degree) - 1;
      }
      return highest;
    }

    template <int dim>
    double barrier(const DiscreteOperatorOf<dim> &matrix, double reach_at_most,
                   const std::vector<char> &is_inner)
    {
      unsigned int narrow = 0;
      std::array<double, dim> centre, half;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const auto ends =
            std::minmax_element(matrix.nodes.begin(), matrix.nodes.end(),
                                [d](const auto &a, const auto &b) { return a[d] < b[d]; });
        centre[d] = .5 * ((*ends.first)[d] + (*ends.second)[d]);
        half[d] = .5 * ((*ends.second)[d] - (*ends.first)[d]);
        narrow = half[d] < half[narrow] ? d : narrow;
      }
      double C = matrix.second_moment, reach = matrix.reach;
      if (C == 0 && matrix.is_collocated)
      {
        const Values y = act(matrix, [&](const dealii::Point<dim> &x, unsigned int)
                             { return std::pow(x[narrow] - centre[narrow], 2); });
        reach = reach_at_most;
        C = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < y.size(); ++i)
          if (is_inner[i] != 0)
            C = std::min(C, -y[i]);
      }
      return C > 0 ? std::pow(half[narrow] + reach, 2) / C : 0;
    }
  } // namespace

  template <int dim>
  Consistency check_consistency(const DiscreteOperatorOf<dim> &matrix,
                                const problem::Problem<dim> &problem)
  {
    Consistency result;
    const double size = physics::operator_scale(problem.kernel);
    const auto is_inner = inner_nodes(matrix, size);
    bool is_bonds_alone = !problem.dilatation;
    if constexpr (dim == 2)
      is_bonds_alone = is_bonds_alone && !problem.coefficient;
    if (matrix.is_collocated && is_bonds_alone)
    {
      result.n_inner = static_cast<std::size_t>(std::count(is_inner.begin(), is_inner.end(), 1));
      if (result.n_inner > 0)
        result.degree = reproduced_degree(matrix, problem.kernel, is_inner, size);
    }
    if (matrix.n_components == 1)
      result.barrier = barrier(matrix, problem.level().horizon + problem.level().h, is_inner);
    return result;
  }

  template Consistency check_consistency(const DiscreteOperatorOf<2> &,
                                         const problem::Problem<2> &);
  template Consistency check_consistency(const DiscreteOperatorOf<3> &,
                                         const problem::Problem<3> &);
} // namespace plumbline::analysis
