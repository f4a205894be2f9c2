#include "meshfree/body/operator.h"

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::meshfree
{
  using algebra::Side;
  using algebra::Stencil;
  using algebra::Vector;

  namespace
  {
    /// The rectangle around the free nodes, and what its sides are.
    struct Frame
    {
      geometry::CellRange nodes;
      algebra::Sides sides;
    };

    std::array<int, 2> steps(const VariationalBody &body, std::size_t i)
    {
      return {static_cast<int>(i % body.n[0]), static_cast<int>(i / body.n[0])};
    }

    Frame frame(const VariationalBody &body)
    {
      Frame result{{body.n, {0, 0}}, {}};
      auto &[lower, upper] = result.nodes;
      for (std::size_t i = 0; i < body.size(); ++i)
        if (body.V[i] > 0 && body.is_fixed[i] == 0)
          for (unsigned int d = 0; d < 2; ++d)
          {
            lower[d] = std::min(lower[d], steps(body, i)[d]);
            upper[d] = std::max(upper[d], steps(body, i)[d] + 1);
          }
      for (auto &sides : result.sides)
        sides = {Side::mirrored, Side::mirrored};
      for (std::size_t i = 0; i < body.size(); ++i)
        if (body.V[i] > 0)
          for (unsigned int d = 0; d < 2; ++d)
          {
            if (steps(body, i)[d] < lower[d])
              result.sides[d][0] = Side::zero;
            if (steps(body, i)[d] >= upper[d])
              result.sides[d][1] = Side::zero;
          }
      for (unsigned int d = 0; d < 2; ++d)
        if (upper[d] - lower[d] == 1)
          result.sides[d][0] = Side::zero; // there is nothing between two mirrors
      return result;
    }

    /// B's rows far from the boundary of a body of mean constants, but for what couples components.
    Stencil inner_stencil(const VariationalBody &body, const std::vector<Neighbour> &family)
    {
      double area = 0, k = 0, l = 0, m = 0;
      for (std::size_t i = 0; i < body.size(); ++i)
      {
        area += body.V[i];
        k += body.V[i] * body.k[i];
        l += body.V[i] * body.l[i];
      }
      const double V = body.h * body.h;
      for (const Neighbour &other : family)
        m += V * other.weight * other.d.norm_square();
      const double alpha = l / area / m, tau = (4 * k - l) / area / (m * m);
      const int r = reach(family);
      Stencil stencil(2, 2 * r);
      for (const auto &[k, d, weight] : family)
        for (unsigned int a = 0; a < 2; ++a)
        {
          const double bond = 2 * alpha * V * V * weight * d[a] * d[a] / d.norm_square();
          stencil(a, a, 0, 0) += bond;
          stencil(a, a, k[0], k[1]) -= bond;
          for (const Neighbour &other : family)
            stencil(a, a, other.k[0] - k[0], other.k[1] - k[1]) +=
                tau * V * V * V * weight * d[a] * other.weight * other.d[a];
        }
      return stencil;
    }

    /// A rectangle solver between two multiplications by a field.
    class ScaledSolver : public algebra::RectangleSolver
    {
    public:
      ScaledSolver(std::unique_ptr<RectangleSolver> solver, Vector scale)
          : solver_(std::move(solver)), scale_(std::move(scale)), scaled_(scale_.size()),
            solved_(scale_.size())
      {
      }
      void add_inverse(Vector &result, const Vector &input) const override
      {
        scaled_ = input;
        scaled_.scale(scale_);
        solved_ = 0.;
        solver_->add_inverse(solved_, scaled_);
        solved_.scale(scale_);
        result += solved_;
      }

    private:
      std::unique_ptr<RectangleSolver> solver_;
      Vector scale_;
      mutable Vector scaled_, solved_;
    };

    /// √(whole cell's V l / V l), l the mean over node and family; 0 where nothing is free.
    Vector scaling(const VariationalBody &body, const std::vector<Neighbour> &family,
                   const Frame &frame)
    {
      const std::size_t n = body.size();
      std::vector<double> lV(n);
      for (std::size_t i = 0; i < n; ++i)
        lV[i] = body.l[i] * body.V[i];
      const auto weight = [](const Neighbour &other) { return other.weight; };
      const std::vector<double> sum = correlate(family, body.n, body.V, weight),
                                sum_l = correlate(family, body.n, lV, weight);
      const double area = std::accumulate(body.V.begin(), body.V.end(), 0.),
                   mean_l = std::accumulate(lV.begin(), lV.end(), 0.) / area;
      Vector result(2 * n);
      for (std::size_t i = 0; i < n; ++i)
        if (body.V[i] > 0 && body.is_fixed[i] == 0)
        {
          const std::array<int, 2> at = steps(body, i);
          double V = body.h * body.h;
          for (unsigned int d = 0; d < 2; ++d)
            if ((at[d] == frame.nodes.lower[d] && frame.sides[d][0] == Side::mirrored) ||
                (at[d] == frame.nodes.upper[d] - 1 && frame.sides[d][1] == Side::mirrored))
              V /= 2;
          const double l = .5 * (body.l[i] + sum_l[i] / sum[i]);
          result[i] = result[n + i] = std::sqrt(V * mean_l / (body.V[i] * l));
        }
      return result;
    }

    algebra::SchwarzPreconditioner preconditioner(const VariationalBody &body,
                                                  const std::vector<Neighbour> &family)
    {
      const Frame around = frame(body);
      Stencil stencil = inner_stencil(body, family);
      const bool is_constrained = std::any_of(
          around.sides.begin(), around.sides.end(),
          [](const auto &side) { return side[0] == Side::zero || side[1] == Side::zero; });
      if (!is_constrained) // the constant is in the kernel: as if held over the size of the body
        for (unsigned int a = 0; a < 2; ++a)
          stencil(a, a, 0, 0) *=
              1 + std::pow(static_cast<double>(stencil.reach()) / (body.n[0] + body.n[1]), 2);
      const geometry::NodeSet nodes{{{0, false, 0}}, 2, body.n, {}};
      std::vector<std::unique_ptr<algebra::RectangleSolver>> solvers;
      solvers.push_back(std::make_unique<ScaledSolver>(
          algebra::make_sine_solver(stencil, nodes, around.nodes, around.sides),
          scaling(body, family, around)));
      return algebra::SchwarzPreconditioner(std::move(solvers));
    }
  } // namespace

  algebra::SolveResult solve(const VariationalOperator &matrix, Vector &u, const Vector &f,
                             double tolerance, unsigned int max_iterations)
  {
    return algebra::solve(matrix, preconditioner(matrix.body(), matrix.family()), u, f, tolerance,
                          max_iterations);
  }
} // namespace plumbline::meshfree
