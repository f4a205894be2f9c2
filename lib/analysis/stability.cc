#include "analysis/stability.h"

#include "algebra/sparse_system.h"
#include "analysis/critical_step.h"
#include "base/error.h"
#include "method/discretisation.h"
#include "physics/load.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plumbline::analysis
{
  namespace
  {
    using algebra::CsrMatrix;
    using method::DiscreteOperator;
    using Values = std::vector<double>;

    /// y = A x.
    void apply(const DiscreteOperator &matrix, const Values &x, Values &y)
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
    Values masses(const DiscreteOperator &matrix)
    {
      Values mass;
      for (const double m : matrix.mass)
        mass.insert(mass.end(), matrix.n_components, m);
      return mass;
    }

    /// The symmetric part of M^(-1/2) A M^(-1/2).
    algebra::Action symmetric_part(const DiscreteOperator &matrix)
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
    CsrMatrix rows_of(const DiscreteOperator &matrix)
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

    /// Component c of L_δ applied to x^a y^b e_d, exact by the kernel's moments.
    double image(const physics::Kernel<2> &kernel, const dealii::Point<2> &x, int a, int b,
                 unsigned int c, unsigned int d)
    {
      double sum = 0;
      for (int i = 0; i <= a; ++i)
        for (int j = i == 0 ? 1 : 0; j <= b; ++j)
          sum -= binomial(a, i) * binomial(b, j) * std::pow(x[0], a - i) * std::pow(x[1], b - j) *
                 kernel.moment({i, j}, c, d);
      return sum;
    }
  } // namespace

  Stability measure(const method::DiscreteOperator &matrix)
  {
    Stability result;
    result.n_unknowns = matrix.size();
    const auto spectrum = algebra::spectrum(symmetric_part(matrix), matrix.size());
    result.smallest = spectrum.smallest;
    result.largest = largest_eigenvalue(symmetric_part(matrix), matrix.size());
    result.n_zero = static_cast<unsigned int>(spectrum.zero_modes.size());
    result.modes = {matrix.n_components, matrix.nodes, spectrum.zero_modes};
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

  namespace
  {
    /// A f / m for a field at the nodes.
    Values act(const DiscreteOperator &matrix,
               const std::function<double(const dealii::Point<2> &, unsigned int)> &f)
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
    std::vector<char> inner_nodes(const DiscreteOperator &matrix, double size)
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

    unsigned int reproduced_degree(const DiscreteOperator &matrix, const physics::Kernel<2> &kernel,
                                   const std::vector<char> &is_inner, double size)
    {
      constexpr int highest = 4;
      constexpr double tolerance = 1e-8;
      const unsigned int nc = matrix.n_components;
      for (int degree = 1; degree <= highest; ++degree)
      {
        double worst = 0, scale = size * std::pow(kernel.horizon(), degree);
        for (int a = 0; a <= degree; ++a)
          for (unsigned int d = 0; d < nc; ++d)
          {
            const int b = degree - a;
            const Values y = act(matrix, [&](const dealii::Point<2> &x, unsigned int c)
                                 { return c == d ? std::pow(x[0], a) * std::pow(x[1], b) : 0; });
            for (std::size_t i = 0; i < y.size(); ++i)
              if (is_inner[i / nc] != 0)
              {
                const double exact = image(kernel, matrix.nodes[i / nc], a, b, i % nc, d);
                scale = std::max(scale, std::abs(exact));
                worst = std::max(worst, std::abs(y[i] - exact));
              }
          }
        if (worst > tolerance * scale)
          return static_cast<unsigned int>(degree) - 1;
      }
      return highest;
    }

    double barrier(const DiscreteOperator &matrix, const problem::Problem<2> &problem,
                   const std::vector<char> &is_inner)
    {
      unsigned int narrow = 0;
      std::array<double, 2> centre, half;
      for (unsigned int d = 0; d < 2; ++d)
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
        const Values y = act(matrix, [&](const dealii::Point<2> &x, unsigned int)
                             { return std::pow(x[narrow] - centre[narrow], 2); });
        reach = problem.horizon() + problem.h;
        C = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < y.size(); ++i)
          if (is_inner[i] != 0)
            C = std::min(C, -y[i]);
      }
      return C > 0 ? std::pow(half[narrow] + reach, 2) / C : 0;
    }
  } // namespace

  Consistency check_consistency(const method::DiscreteOperator &matrix,
                                const problem::Problem<2> &problem)
  {
    Consistency result;
    const double size = physics::operator_scale(problem.kernel);
    const auto is_inner = inner_nodes(matrix, size);
    if (matrix.is_collocated && !problem.dilatation && !problem.coefficient)
    {
      result.n_inner = static_cast<std::size_t>(std::count(is_inner.begin(), is_inner.end(), 1));
      if (result.n_inner > 0)
        result.degree = reproduced_degree(matrix, problem.kernel, is_inner, size);
    }
    if (matrix.n_components == 1)
      result.barrier = barrier(matrix, problem, is_inner);
    return result;
  }
} // namespace plumbline::analysis
