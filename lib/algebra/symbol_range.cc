// The ends of a symbol's range over the Brillouin zone.
#include "algebra/symbol.h"
#include "algebra/symbol_pencil.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>

namespace plumbline::algebra
{
  namespace
  {
    using Complex = std::complex<double>;
    using Matrix = Eigen::MatrixXcd;
    using Eigen::Index;
    // κ = k h has two or three coordinates, and so have the Hessians' axes
    using Point = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
    using Hessian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

    /// 2 in the plane.
    int dimension(const WaveOperator &waves)
    {
      return waves.stiffness.reaches()[2] > 0 || waves.mass.reaches()[2] > 0 ? 3 : 2;
    }

    /// e^{iκ j}, -reach <= j <= reach.
    std::vector<Complex> phases(double kappa, int reach)
    {
      std::vector<Complex> result;
      for (int j = -reach; j <= reach; ++j)
        result.push_back(std::polar(1., kappa * j));
      return result;
    }

    /// Σ_j A(j) e^{iκ·j} for many κ_1 at the same κ_2, of a stencil in the plane, or in space at
    /// the same κ_3, too. Without the families' places, which change no eigenvalue.
    class Slice
    {
    public:
      /// @param phase3  `phases` of κ_3
      Slice(const Stencil &stencil, const std::vector<Complex> &phase3)
          : n_blocks_(stencil.n_blocks()), reaches_(stencil.reaches())
      {
        for (int j1 = -reaches_[0]; j1 <= reaches_[0]; ++j1)
          for (unsigned int t = 0; t < n_blocks_; ++t)
            for (unsigned int s = 0; s < n_blocks_; ++s)
              for (int j2 = -reaches_[1]; j2 <= reaches_[1]; ++j2)
              {
                Complex sum = 0;
                for (int j3 = -reaches_[2]; j3 <= reaches_[2]; ++j3)
                  if (const double a = stencil(s, t, j1, j2, j3); a != 0)
                    sum += a * phase3[skipped(phase3, reaches_[2]) + j3 + reaches_[2]];
                layer_.push_back(sum);
              }
      }

      /// @param phase2  `phases` of κ_2
      void turn_to(const std::vector<Complex> &phase2)
      {
        const std::size_t n = 2 * reaches_[1] + 1, first = skipped(phase2, reaches_[1]);
        columns_.assign(layer_.size() / n, 0);
        for (std::size_t column = 0; column < columns_.size(); ++column)
          for (std::size_t j2 = 0; j2 < n; ++j2)
            columns_[column] += layer_[column * n + j2] * phase2[first + j2];
      }

      /// @param phase1  `phases` of κ_1
      Matrix at(const std::vector<Complex> &phase1) const
      {
        Matrix sum = Matrix::Zero(n_blocks_, n_blocks_);
        const std::size_t n = n_blocks_ * n_blocks_, first = skipped(phase1, reaches_[0]);
        for (std::size_t j = 0; j < columns_.size() / n; ++j)
          for (std::size_t k = 0; k < n; ++k)
            sum.data()[k] += phase1[first + j] * columns_[j * n + k];
        return sum;
      }

    private:
      /// Phases of a longer reach than this, at either end.
      static std::size_t skipped(const std::vector<Complex> &phase, int reach)
      {
        return phase.size() / 2 - reach;
      }

      unsigned int n_blocks_;
      std::array<int, 3> reaches_;
      /// shape (2 reaches[0] + 1, n_blocks, n_blocks, 2 reaches[1] + 1), blocks by columns; and
      /// summed over the last
      std::vector<Complex> layer_, columns_;
    };

    /// A matrix at κ and its derivatives.
    struct Jet
    {
      Matrix value;
      std::array<Matrix, 3> first;
      std::array<std::array<Matrix, 3>, 3> second; ///< [d][e], d <= e

      Jet(const Stencil &stencil, const Point &kappa)
      {
        const unsigned int n = stencil.n_blocks();
        const auto &reach = stencil.reaches();
        std::array<std::vector<Complex>, 3> phase;
        for (int d = 0; d < 3; ++d)
          phase[d] = phases(d < kappa.size() ? kappa[d] : 0, reach[d]);
        value = Matrix::Zero(n, n);
        first.fill(value);
        second.fill(first);
        for (unsigned int s = 0; s < n; ++s)
          for (unsigned int t = 0; t < n; ++t)
            stencil.for_each_offset(
                [&](int j1, int j2, int j3)
                {
                  if (const double a = stencil(s, t, j1, j2, j3); a != 0)
                    add(s, t, {j1, j2, j3},
                        a * phase[0][j1 + reach[0]] * phase[1][j2 + reach[1]] *
                            phase[2][j3 + reach[2]]);
                });
      }

    private:
      void add(unsigned int s, unsigned int t, const std::array<int, 3> &j, const Complex &term)
      {
        value(s, t) += term;
        for (int d = 0; d < 3; ++d)
        {
          first[d](s, t) += Complex(0, j[d]) * term;
          for (int e = d; e < 3; ++e)
            second[d][e](s, t) -= static_cast<double>(j[d] * j[e]) * term;
        }
      }
    };

    /// The largest eigenvalue λ about κ to second order.
    struct Quadratic
    {
      double value = 0;
      Point gradient;
      Hessian hessian;
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
      const auto dim = static_cast<int>(kappa.size());
      result.value = values[top];
      result.gradient.resize(dim);
      result.hessian.resize(dim, dim);
      std::array<Eigen::VectorXcd, 3> moved; // w*F_a v for all w
      for (int d = 0; d < dim; ++d)
      {
        moved[d] = vectors.adjoint() * ((a.first[d] - result.value * m.first[d]) * v);
        result.gradient[d] = moved[d][top].real();
      }
      for (int d = 0; d < dim; ++d)
        for (int e = 0; e < dim; ++e)
        {
          const auto [low, high] = std::minmax(d, e);
          double sum = form(a.second[low][high]) - result.value * form(m.second[low][high]) -
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
      const Eigen::SelfAdjointEigenSolver<Hessian> axes(model.hessian);
      const Point slope = axes.eigenvectors().transpose() * model.gradient;
      Point step(slope.size());
      for (Index d = 0; d < slope.size(); ++d)
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

    /// Numbers of a point along the axes; in the plane the third is 0.
    using Place = std::array<int, 3>;

    /// An eigenvalue over a grid of the half zone 0 <= κ_1 <= π, 0 <= κ_d < 2π of the others, the
    /// other half follows from the symmetry κ → -κ.
    struct Grid
    {
      int n;                           ///< intervals on π
      int dim;                         ///< 2 or 3
      std::vector<double> values = {}; ///< shape (n_layers, 2 n, n + 1)

      double spacing() const { return M_PI / n; }
      int n_layers() const { return dim == 3 ? 2 * n : 1; }

      double at(const Place &i) const
      {
        const int folded = i[0] > n ? 2 * n - i[0] : std::abs(i[0]);
        const int sign = folded == i[0] ? 1 : -1;
        const auto wrapped = [&](int j) { return (sign * j + 4 * n) % (2 * n); };
        return values[(static_cast<std::size_t>(dim == 3 ? wrapped(i[2]) : 0) * 2 * n +
                       wrapped(i[1])) *
                          (n + 1) +
                      folded];
      }

      Point kappa(const Place &i) const
      {
        Point result(dim);
        for (int d = 0; d < dim; ++d)
          result[d] = spacing() * i[d];
        return result;
      }
    };

    /// The neighbours of a point, one of each pair of opposite ones.
    std::vector<Place> half_of_neighbours(int dim)
    {
      std::vector<Place> result;
      for (int d3 = dim == 3 ? -1 : 0; d3 <= (dim == 3 ? 1 : 0); ++d3)
        for (int d2 = -1; d2 <= 1; ++d2)
          for (int d1 = -1; d1 <= 1; ++d1)
            if (std::array{d3, d2, d1} > std::array{0, 0, 0})
              result.push_back({d1, d2, d3});
      return result;
    }

    /// A point of a grid that is no lower than its neighbours.
    struct Top
    {
      double value;
      double bound; ///< of the local maximum near it
      Place place;
    };

    /// The top at a point of a grid, if there is one.
    std::optional<Top> top_at(const Grid &grid, const std::vector<Place> &neighbours,
                              const Place &i)
    {
      // between points a parabola rises by an eighth of its second difference at most: twice that
      // along each of the axes and diagonals
      constexpr double rise = 2. / 8;
      const double value = grid.at(i);
      double differences = 0;
      for (const auto &[d1, d2, d3] : neighbours)
      {
        const double up = grid.at({i[0] + d1, i[1] + d2, i[2] + d3}),
                     down = grid.at({i[0] - d1, i[1] - d2, i[2] - d3});
        if (up > value || down > value)
          return {};
        differences += 2 * value - up - down;
      }
      return Top{value, value + rise * differences, i};
    }

    /// The local maxima of a grid, highest bounds first, of equal ones one.
    std::vector<Top> tops(const Grid &grid)
    {
      // symmetry makes up to eight (in space 48) of each, and rounding parts them
      constexpr double equal = 1e-12;
      const auto neighbours = half_of_neighbours(grid.dim);
      std::vector<Top> all, distinct;
      for (int i3 = 0; i3 < grid.n_layers(); ++i3)
        for (int i2 = 0; i2 < 2 * grid.n; ++i2)
          for (int i1 = 0; i1 <= grid.n; ++i1)
            if (const auto top = top_at(grid, neighbours, {i1, i2, i3}))
              all.push_back(*top);
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
      constexpr std::array<double, 3> beside = {1e-3, .6e-3, .3e-3};
      double largest = *std::max_element(grid.values.begin(), grid.values.end());
      for (const Top &one : tops(grid))
        if (one.bound > largest)
        {
          Point start = grid.kappa(one.place);
          for (int d = 0; d < grid.dim; ++d)
            start[d] += beside[d] * grid.spacing();
          largest = std::max(largest, climb(waves, start, grid.spacing()));
        }
      return largest;
    }
  } // namespace

  SymbolRange Symbol::range() const
  {
    // The symbol is a trigonometric polynomial whose degree is the reach. Along a line such a
    // polynomial p of degree N falls off from its largest |p| no faster than cos(N x) does (M.
    // Riesz), so that a point of a grid with eight points on the shortest oscillation keeps
    // cos(π/4) of it along each axis, and each hill of the symbol shows as a top of the grid.
    const auto reach = std::max(waves_.stiffness.reach(), waves_.mass.reach());
    Grid largest{std::max(24, 4 * reach), dimension(waves_)};
    const int n = largest.n;
    double least = std::numeric_limits<double>::infinity();
    std::vector<std::vector<Complex>> phase;
    for (int i = 0; i < 2 * n; ++i)
      phase.push_back(phases(i * largest.spacing(), reach));
    for (int i3 = 0; i3 < largest.n_layers(); ++i3)
    {
      Slice stiffness(waves_.stiffness, phase[i3]), mass(waves_.mass, phase[i3]);
      for (int i2 = 0; i2 < 2 * n; ++i2)
      {
        stiffness.turn_to(phase[i2]);
        mass.turn_to(phase[i2]);
        for (int i1 = 0; i1 <= n; ++i1)
        {
          const auto solver = solve_pencil(stiffness.at(phase[i1]), mass.at(phase[i1]), false);
          largest.values.push_back(solver.eigenvalues()[solver.eigenvalues().size() - 1]);
          least = std::min(least, solver.eigenvalues()[0]);
        }
      }
    }
    return {least, maximum(largest, waves_)};
  }
} // namespace plumbline::algebra
