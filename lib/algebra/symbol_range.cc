// The ends of a symbol's range over the Brillouin zone.
#include "algebra/symbol.h"
#include "algebra/symbol_pencil.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

namespace plumbline::algebra
{
  namespace
  {
    using Complex = std::complex<double>;
    using Matrix = Eigen::MatrixXcd;
    using Eigen::Index;
    using Point = Eigen::Vector2d; ///< κ = k h

    /// e^{iκ j}, -reach <= j <= reach.
    std::vector<Complex> phases(double kappa, int reach)
    {
      std::vector<Complex> result;
      for (int j = -reach; j <= reach; ++j)
        result.push_back(std::polar(1., kappa * j));
      return result;
    }

    /// Σ_j A(j) e^{iκ·j} for many κ_1 at the same κ_2. Without the families' places, which change
    /// no eigenvalue.
    class Slice
    {
    public:
      Slice(const Stencil &stencil, double kappa2)
          : n_blocks_(stencil.n_blocks()), reach_(stencil.reach()),
            columns_(static_cast<std::size_t>(2 * reach_ + 1) * n_blocks_ * n_blocks_)
      {
        const auto phase = phases(kappa2, reach_);
        auto column = columns_.begin();
        for (int j1 = -reach_; j1 <= reach_; ++j1)
          for (unsigned int t = 0; t < n_blocks_; ++t)
            for (unsigned int s = 0; s < n_blocks_; ++s, ++column)
              for (int j2 = -reach_; j2 <= reach_; ++j2)
                if (const double a = stencil(s, t, j1, j2); a != 0)
                  *column += a * phase[j2 + reach_];
      }

      /// @param phase  `phases` of κ_1, of this reach or a larger one
      Matrix at(const std::vector<Complex> &phase) const
      {
        Matrix sum = Matrix::Zero(n_blocks_, n_blocks_);
        const std::size_t n = n_blocks_ * n_blocks_, skipped = phase.size() / 2 - reach_;
        for (std::size_t j = 0; j < columns_.size() / n; ++j)
          for (std::size_t k = 0; k < n; ++k)
            sum.data()[k] += phase[skipped + j] * columns_[j * n + k];
        return sum;
      }

    private:
      unsigned int n_blocks_;
      int reach_;
      std::vector<Complex> columns_; ///< shape (2 reach + 1, n_blocks, n_blocks), by columns
    };

    /// A matrix at κ and its derivatives in κ_1 and κ_2.
    struct Jet
    {
      Matrix value;
      std::array<Matrix, 2> first;
      std::array<Matrix, 3> second; ///< 11, 12, 22

      Jet(const Stencil &stencil, const Point &kappa)
      {
        const unsigned int n = stencil.n_blocks();
        const int reach = stencil.reach();
        const auto e1 = phases(kappa[0], reach), e2 = phases(kappa[1], reach);
        value = first[0] = first[1] = second[0] = second[1] = second[2] = Matrix::Zero(n, n);
        for (unsigned int s = 0; s < n; ++s)
          for (unsigned int t = 0; t < n; ++t)
            for (int j2 = -reach; j2 <= reach; ++j2)
              for (int j1 = -reach; j1 <= reach; ++j1)
                if (const double a = stencil(s, t, j1, j2); a != 0)
                {
                  const Complex term = a * e1[j1 + reach] * e2[j2 + reach], i(0, 1);
                  const double x = j1, y = j2;
                  value(s, t) += term;
                  first[0](s, t) += i * x * term;
                  first[1](s, t) += i * y * term;
                  second[0](s, t) -= x * x * term;
                  second[1](s, t) -= x * y * term;
                  second[2](s, t) -= y * y * term;
                }
      }
    };

    /// The largest eigenvalue λ about κ to second order.
    struct Quadratic
    {
      double value = 0;
      Point gradient;
      Eigen::Matrix2d hessian;
    };

    /// By perturbation: with v*Mv = 1 and F_a = A_a - λM_a, λ_a = v*F_a v and λ_ab = v*(A_ab -
    /// λM_ab - λ_a M_b - λ_b M_a)v + 2 Re Σ (v*F_a w)(w*F_b v) / (λ - μ) over the other
    /// eigenpairs (μ, w).
    Quadratic expand(const WaveOperator &waves, const Point &kappa)
    {
      constexpr double equal = 1e-13; // of the largest: eigenvalues that rounding alone parts
      const Jet a(waves.stiffness, kappa), m(waves.mass, kappa);
      const auto solver = solve_pencil(a.value, m.value, true);
      const Index top = a.value.rows() - 1;
      const auto &values = solver.eigenvalues();
      const Matrix &vectors = solver.eigenvectors();
      const Eigen::VectorXcd v = vectors.col(top);
      const auto form = [&](const Matrix &matrix) { return v.dot(matrix * v).real(); };
      Quadratic result;
      result.value = values[top];
      std::array<Eigen::VectorXcd, 2> moved; // w*F_a v for all w
      for (int d = 0; d < 2; ++d)
      {
        moved[d] = vectors.adjoint() * ((a.first[d] - result.value * m.first[d]) * v);
        result.gradient[d] = moved[d][top].real();
      }
      for (int d = 0; d < 2; ++d)
        for (int e = 0; e < 2; ++e)
        {
          double sum = form(a.second[d + e]) - result.value * form(m.second[d + e]) -
                       result.gradient[d] * form(m.first[e]) -
                       result.gradient[e] * form(m.first[d]);
          for (Index j = 0; j < top; ++j)
            if (const double gap = result.value - values[j]; gap > equal * std::abs(result.value))
              sum += 2 * (std::conj(moved[d][j]) * moved[e][j]).real() / gap;
          result.hessian(d, e) = sum;
        }
      return result;
    }

    /// The step up: Newton's along axes of the Hessian that bend down, all of the radius along
    /// those that do not.
    Point step_up(const Quadratic &model, double radius)
    {
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(model.hessian);
      const Point slope = axes.eigenvectors().transpose() * model.gradient;
      Point step;
      for (int d = 0; d < 2; ++d)
      {
        const double bend = -axes.eigenvalues()[d], size = std::abs(slope[d]);
        step[d] = std::copysign(size < bend * radius ? size / bend : radius, slope[d]);
      }
      return axes.eigenvectors() * step;
    }

    /// The local maximum near κ, by Newton's method in a trust region.
    /// Accuracy: rounding, for the error is quadratic in that of κ.
    double climb(const WaveOperator &waves, Point kappa, double spacing)
    {
      constexpr unsigned int most_steps = 100;
      constexpr double rounding = 1e-15; // of the value: steps gain nothing more
      constexpr double shortest = 1e-9;  // of the spacing, the gain then 1e-18
      double radius = spacing / 2;
      Quadratic here = expand(waves, kappa);
      for (unsigned int i = 0; i < most_steps && radius > shortest * spacing; ++i)
      {
        const Point step = step_up(here, radius);
        const double expected = here.gradient.dot(step) + .5 * step.dot(here.hessian * step);
        if (!(expected > rounding * std::abs(here.value)))
          break;
        const Quadratic there = expand(waves, kappa + step);
        const double ratio = (there.value - here.value) / expected;
        if (ratio < .25)
          radius = .25 * std::min(radius, step.norm());
        else if (ratio > .75)
          radius = std::min(2 * radius, spacing);
        if (ratio > 0)
        {
          kappa += step;
          here = there;
        }
      }
      return here.value;
    }

    /// An eigenvalue over a grid of the half zone 0 <= κ_1 <= π, 0 <= κ_2 < 2π, the other half
    /// being the same turned by π.
    struct Grid
    {
      int n;                      ///< intervals on π
      std::vector<double> values; ///< shape (2 n, n + 1)

      double spacing() const { return M_PI / n; }

      double at(int i1, int i2) const
      {
        const int folded = i1 > n ? 2 * n - i1 : std::abs(i1);
        const int turned = folded == i1 ? i2 : -i2;
        return values[static_cast<std::size_t>((turned + 4 * n) % (2 * n)) * (n + 1) + folded];
      }
    };

    /// A point of a grid that is no lower than its neighbours.
    struct Top
    {
      double value;
      double bound; ///< of the local maximum near it
      int i1, i2;
    };

    /// The local maxima of a grid, highest bounds first, of equal ones one.
    std::vector<Top> tops(const Grid &grid)
    {
      constexpr double equal = 1e-12; // symmetry makes up to eight of each, rounding parts them
      // between points a parabola rises by an eighth of its second difference at most: twice that
      // along each of the axes and diagonals
      constexpr double rise = 2. / 8;
      std::vector<Top> all, distinct;
      for (int i2 = 0; i2 < 2 * grid.n; ++i2)
        for (int i1 = 0; i1 <= grid.n; ++i1)
        {
          const double value = grid.at(i1, i2);
          double differences = 0;
          bool is_top = true;
          for (const auto &[d1, d2] : {std::array{1, 0}, {0, 1}, {1, 1}, {1, -1}})
          {
            const double up = grid.at(i1 + d1, i2 + d2), down = grid.at(i1 - d1, i2 - d2);
            is_top = is_top && up <= value && down <= value;
            differences += 2 * value - up - down;
          }
          if (is_top)
            all.push_back({value, value + rise * differences, i1, i2});
        }
      std::sort(all.begin(), all.end(),
                [](const Top &a, const Top &b) { return a.bound > b.bound; });
      for (const Top &one : all)
        if (distinct.empty() ||
            distinct.back().bound - one.bound > equal * std::abs(distinct.front().bound))
          distinct.push_back(one);
      return distinct;
    }

    /// The largest value, by a climb from each of the grid's local maxima that may lead to it.
    double maximum(const Grid &grid, const WaveOperator &waves)
    {
      // off the axes of symmetry, on which waves have equal eigenvalues and slopes along them only
      const Point beside(1e-3 * grid.spacing(), .6e-3 * grid.spacing());
      double largest = *std::max_element(grid.values.begin(), grid.values.end());
      for (const Top &one : tops(grid))
        if (one.bound > largest)
          largest = std::max(largest, climb(waves, grid.spacing() * Point(one.i1, one.i2) + beside,
                                            grid.spacing()));
      return largest;
    }
  } // namespace

  SymbolRange Symbol::range() const
  {
    // The symbol is a trigonometric polynomial whose degree is the reach. Along a line such a
    // polynomial p of degree N falls off from its largest |p| no faster than cos(N x) does (M.
    // Riesz), so that a point of a grid with eight points on the shortest oscillation keeps
    // cos(π/4) of it in the plane, and each hill of the symbol shows as a top of the grid.
    const int n = std::max(24, 4 * std::max(waves_.stiffness.reach(), waves_.mass.reach()));
    Grid largest{n, {}};
    double least = std::numeric_limits<double>::infinity();
    const auto reach = std::max(waves_.stiffness.reach(), waves_.mass.reach());
    std::vector<std::vector<Complex>> phase; // over κ_1
    for (int i1 = 0; i1 <= n; ++i1)
      phase.push_back(phases(i1 * largest.spacing(), reach));
    for (int i2 = 0; i2 < 2 * n; ++i2)
    {
      const double kappa2 = i2 * largest.spacing();
      const Slice stiffness(waves_.stiffness, kappa2), mass(waves_.mass, kappa2);
      for (int i1 = 0; i1 <= n; ++i1)
      {
        const auto solver = solve_pencil(stiffness.at(phase[i1]), mass.at(phase[i1]), false);
        largest.values.push_back(solver.eigenvalues()[solver.eigenvalues().size() - 1]);
        least = std::min(least, solver.eigenvalues()[0]);
      }
    }
    return {least, maximum(largest, waves_)};
  }
} // namespace plumbline::algebra
