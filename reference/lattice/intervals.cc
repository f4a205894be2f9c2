#include "reference/lattice/intervals.h"

#include "method/limit_proof.h"
#include "physics/gauss.h"

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using algebra::Vector;
    using Coefficients = std::vector<double>; ///< of powers of τ

    /// Shifted Legendre polynomials P_n(2τ - 1) by powers of τ: (-1)^(n+i) C(n, i) C(n+i, i).
    std::vector<Coefficients> shifted_legendre(unsigned int n_modes)
    {
      std::vector<Coefficients> result;
      for (unsigned int n = 0; n < n_modes; ++n)
      {
        Coefficients powers(n_modes);
        double entry = n % 2 == 0 ? 1 : -1;
        for (unsigned int i = 0; i <= n; ++i)
        {
          powers[i] = entry;
          entry *= -static_cast<double>((n - i) * (n + i + 1)) / ((i + 1) * (i + 1));
        }
        result.push_back(std::move(powers));
      }
      return result;
    }

    /// E on the first cell, by powers of τ. The terms that vanish are left out: the constant one,
    /// and where functions are continuous the linear one.
    Coefficients first_cell(const Correlations &r, unsigned int s, unsigned int t, int k,
                            bool is_continuous)
    {
      static thread_local std::vector<Coefficients> legendre_powers;
      const unsigned int n_modes = r.n_modes();
      if (legendre_powers.size() != n_modes)
        legendre_powers = shifted_legendre(n_modes);
      Coefficients result(n_modes);
      for (const bool is_right : {true, false})
        if (const double *const modes = r.coefficients(s, t, is_right ? -k : -k - 1))
          for (unsigned int n = 0; n < n_modes; ++n)
          {
            // r(-k - τ) = Σ m_n P_n(1 - 2τ), P_n being even or odd
            const double mode = is_right || n % 2 == 0 ? modes[n] : -modes[n];
            for (unsigned int i = is_continuous ? 2 : 1; i < n_modes; ++i)
              result[i] -= mode * legendre_powers[n][i];
          }
      return result;
    }

    double correlation(const Correlations &r, unsigned int s, unsigned int t, double tau)
    {
      const int j = static_cast<int>(std::floor(tau));
      const double *const modes = r.coefficients(s, t, j);
      if (modes == nullptr)
        return 0;
      std::vector<double> values(r.n_modes());
      legendre(2 * (tau - j) - 1, r.n_modes(), values.data());
      double sum = 0;
      for (unsigned int n = 0; n < r.n_modes(); ++n)
        sum += modes[n] * values[n];
      return sum;
    }

    /// Points z in (0, δ) and weights C(z) dz.
    struct Rule
    {
      std::vector<double> z, weight;
    };

    /// On one cell, between the breaks of the profile.
    Rule rule_on(const physics::Kernel<1> &kernel, double h, int cell, unsigned int n_modes)
    {
      const double horizon = kernel.horizon();
      const unsigned int degree = kernel.profile().degree(std::min(1., h / horizon));
      const auto &gauss = physics::gauss(14 + n_modes / 2 + degree / 2);
      std::vector<double> ends = {cell * h};
      for (const double r : kernel.breaks())
        if (r > cell * h && r < (cell + 1) * h)
          ends.push_back(r);
      ends.push_back(std::min((cell + 1) * h, horizon));
      Rule rule;
      for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        for (unsigned int q = 0; q < gauss.size() && ends[i] < ends[i + 1]; ++q)
        {
          rule.z.push_back(ends[i] + (ends[i + 1] - ends[i]) * gauss.point(q)[0]);
          rule.weight.push_back((ends[i + 1] - ends[i]) * gauss.weight(q) *
                                kernel.radial(rule.z.back()));
        }
      return rule;
    }

    double horner(const Coefficients &powers, double tau)
    {
      double value = 0;
      for (std::size_t i = powers.size(); i-- > 0;)
        value = value * tau + powers[i];
      return value;
    }

    class GalerkinOnIntervals : public method::IntervalDiscretisation
    {
    public:
      GalerkinOnIntervals(const problem::Problem<1> &problem, const AxisShapes &shapes)
          : IntervalDiscretisation(problem, shapes.families(),
                                   galerkin_stencil(problem.kernel, problem.h(), shapes)),
            shapes_(shapes)
      {
        if (shapes.degree() > 0)
          diagnostics_.limit = method::prove_galerkin(problem);
        else
          diagnostics_.limit = method::prove_by_moments(problem, stencil(), problem.h());
      }

      method::Diagnostics diagnostics() const override { return diagnostics_; }

    private:
      Vector load(const problem::Problem<1> &problem) const override
      {
        const auto n = static_cast<std::size_t>(lattice().n_cells());
        Vector result(static_cast<unsigned int>(families().size() * n));
        const auto &gauss = physics::gauss(shapes_.degree() + 6);
        lattice().for_each_cell(
            [&](int cell)
            {
              for (unsigned int q = 0; q < gauss.size(); ++q)
              {
                const double s = gauss.point(q)[0],
                             b = lattice().h() * gauss.weight(q) *
                                 problem.load.value(
                                     dealii::Point<1>(lattice().coordinate(cell + s)), 0);
                for (unsigned int a = 0; a < shapes_.n_local(); ++a)
                  if (const auto owner = shapes_.owner(a);
                      is_free(owner.family, cell + owner.shift))
                    result[owner.family * n + cell + owner.shift] += b * shapes_.value(a, s);
              }
            });
        return result;
      }
      double value_in(int cell, double s, const method::LineValues &values) const override
      {
        double sum = 0;
        for (unsigned int a = 0; a < shapes_.n_local(); ++a)
          sum += shapes_.value(a, s) *
                 values.at(shapes_.owner(a).family, cell + shapes_.owner(a).shift);
        return sum;
      }
      double average_over(int cell, const method::LineValues &values) const override
      {
        const auto &gauss = physics::gauss(shapes_.degree() / 2 + 1);
        double sum = 0;
        for (unsigned int q = 0; q < gauss.size(); ++q)
          sum += gauss.weight(q) * value_in(cell, gauss.point(q)[0], values);
        return sum;
      }

      AxisShapes shapes_;
      method::Diagnostics diagnostics_;
    };
  } // namespace

  algebra::Stencil galerkin_stencil(const physics::Kernel<1> &kernel, double h,
                                    const AxisShapes &shapes)
  {
    const Correlations r(shapes);
    const auto n_families = static_cast<unsigned int>(shapes.families().size());
    const int n_cells = static_cast<int>(std::ceil(kernel.horizon() / h * (1 - 1e-14))),
              reach = n_cells + 1;
    algebra::Stencil stencil(n_families, std::array<int, 3>{reach, 0, 0});
    for (int cell = 0; cell < n_cells; ++cell)
    {
      const Rule rule = rule_on(kernel, h, cell, r.n_modes());
      for (unsigned int s = 0; s < n_families; ++s)
        for (unsigned int t = 0; t < n_families; ++t)
          for (int k = -reach; k <= reach; ++k)
          {
            double sum = 0;
            if (cell == 0)
            {
              const Coefficients E = first_cell(r, s, t, k, shapes.is_continuous());
              for (std::size_t q = 0; q < rule.z.size(); ++q)
                sum += rule.weight[q] * horner(E, rule.z[q] / h);
            }
            else if (const double middle = 2 * correlation(r, s, t, -k);
                     middle != 0 || std::abs(std::abs(k) - cell) <= 2)
              for (std::size_t q = 0; q < rule.z.size(); ++q)
                sum += rule.weight[q] * (middle - correlation(r, s, t, rule.z[q] / h - k) -
                                         correlation(r, s, t, -rule.z[q] / h - k));
            stencil(s, t, k, 0) += h * sum;
          }
    }
    return stencil;
  }

  std::string why_not_on_intervals(const physics::Kernel<1> &kernel, bool is_continuous)
  {
    if (is_continuous || kernel.profile().lowest_exponent() > -2)
      return {};
    return "with a kernel like r^" + std::to_string(kernel.profile().lowest_exponent()) +
           " at r = 0 jumps of u have infinite energy in one dimension; take Q1, Q2 or Q3";
  }

  std::unique_ptr<method::IntervalDiscretisation>
  discretise_on_intervals(const problem::Problem<1> &problem, const AxisShapes &shapes)
  {
    return std::make_unique<GalerkinOnIntervals>(problem, shapes);
  }
} // namespace plumbline::reference
