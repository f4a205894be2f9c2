#include "algebra/symbol.h"

#include "algebra/symbol_pencil.h"
#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>

namespace plumbline::algebra
{
  namespace
  {
    using Complex = std::complex<double>;
    using Matrix = Eigen::MatrixXcd;
    using Real = Eigen::MatrixXd;
    using Eigen::Index;

    /// Sums over a stencil's offsets d [cells] along a direction n: Σ A f(n·d), block by block.
    template <typename Factor>
    Matrix sum_over(const WaveOperator &waves, const Stencil &stencil, const Vector3 &n,
                    const Factor &factor)
    {
      const auto n_blocks = stencil.n_blocks();
      Matrix result = Matrix::Zero(n_blocks, n_blocks);
      for (unsigned int s = 0; s < n_blocks; ++s)
        for (unsigned int t = 0; t < n_blocks; ++t)
        {
          const Vector3 &from = waves.places[s % waves.n_families()],
                        &to = waves.places[t % waves.n_families()];
          stencil.for_each_offset(
              [&](int j1, int j2, int j3)
              {
                if (const double a = stencil(s, t, j1, j2, j3); a != 0)
                  result(s, t) +=
                      a * factor(n[0] * (j1 + (to[0] - from[0])) + n[1] * (j2 + (to[1] - from[1])) +
                                 n[2] * (j3 + (to[2] - from[2])));
              });
        }
      return result;
    }

    /// Of waves in direction n.
    std::vector<Vector3> polarisations(const Vector3 &n, unsigned int n_components)
    {
      if (n_components == 1)
        return {{1}};
      const Vector3 across{-n[1], n[0]};
      if (n_components == 2)
        return {n, across};
      const double size = std::hypot(n[0], n[1]);
      const Vector3 level =
          size > 0 ? Vector3{across[0] / size, across[1] / size} : Vector3{1, 0, 0};
      return {n, level,
              Vector3{-n[2] * level[1], n[2] * level[0], n[0] * level[1] - n[1] * level[0]}};
    }

    /// Values at the nodes of plane waves, polarisation by polarisation: (n_blocks, n_waves).
    Matrix plane_waves(const WaveOperator &waves, const Vector3 &n)
    {
      const auto n_families = waves.n_families();
      Matrix result = Matrix::Zero(waves.n_components * n_families, waves.n_components);
      Index wave = 0;
      for (const Vector3 &polarisation : polarisations(n, waves.n_components))
      {
        for (unsigned int c = 0; c < waves.n_components; ++c)
          for (unsigned int s = 0; s < n_families; ++s)
            result(c * n_families + s, wave) = polarisation[c];
        ++wave;
      }
      return result;
    }

    /// The eigenvector nearest to each plane wave, none twice.
    /// @param overlaps  |v*M p| of eigenvectors and plane waves, shape (n_vectors, n_waves)
    std::vector<Index> nearest(const Real &overlaps)
    {
      std::vector<Index> chosen;
      for (Index wave = 0; wave < overlaps.cols(); ++wave)
      {
        Index best = -1;
        for (Index i = 0; i < overlaps.rows(); ++i)
          if (std::find(chosen.begin(), chosen.end(), i) == chosen.end() &&
              (best < 0 || overlaps(i, wave) > overlaps(best, wave)))
            best = i;
        chosen.push_back(best);
      }
      return chosen;
    }
  } // namespace

  Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>
  solve_pencil(const Matrix &stiffness, const Matrix &mass, bool has_vectors)
  {
    Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(
        stiffness, mass,
        (has_vectors ? Eigen::ComputeEigenvectors : Eigen::EigenvaluesOnly) | Eigen::Ax_lBx);
    if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite())
      throw NumericalError("the symbol has no eigenvalues: its mass matrix is not positive "
                           "definite, or an entry of the stencil is not finite");
    return solver;
  }

  Symbol::Symbol(WaveOperator waves) : waves_(std::move(waves))
  {
    constexpr double tolerance = 1e-10; // of the largest entry: stencils are symmetric to 1e-13
    for (const Stencil *stencil : {&waves_.stiffness, &waves_.mass})
      if (!(stencil->symmetry_defect() <= tolerance))
        throw NumericalError("the stencil is not symmetric, so it has no waves; take a rule with "
                             "one weight for both ends of a bond");
  }

  std::vector<PlaneWave> Symbol::waves(double k, const Vector3 &n) const
  {
    const double kh = k * waves_.h;
    const auto value = [kh](double d) { return Complex(std::cos(kh * d), std::sin(kh * d)); };
    const auto slope = [&](double d) { return Complex(0, waves_.h * d) * value(d); };
    const auto sum = [&](const Stencil &stencil, const auto &factor)
    { return sum_over(waves_, stencil, n, factor); };
    const Matrix mass = sum(waves_.mass, value);
    const auto solver = solve_pencil(sum(waves_.stiffness, value), mass, true);
    const Matrix stiffness_slope = sum(waves_.stiffness, slope),
                 mass_slope = sum(waves_.mass, slope);
    const auto &vectors = solver.eigenvectors();
    std::vector<PlaneWave> result;
    for (const Index i : nearest((vectors.adjoint() * mass * plane_waves(waves_, n)).cwiseAbs()))
    {
      const double squared = solver.eigenvalues()[i];
      const Matrix change = stiffness_slope - squared * mass_slope;
      result.push_back({squared, vectors.col(i).dot(change * vectors.col(i)).real()});
    }
    return result;
  }

  std::vector<double> Symbol::long_waves(const Vector3 &n) const
  {
    // below this part of the largest entry an eigenvalue of A(0) is that of a constant
    constexpr double zero = 1e-10;
    const auto sum = [&](const Stencil &stencil, const auto &factor)
    { return sum_over(waves_, stencil, n, factor); };
    const auto one = [](double) { return 1.; };
    const Matrix constants = plane_waves(waves_, n);
    const Matrix at_zero = sum(waves_.stiffness, one);
    // A(k) = A(0) + i kh X - (kh)²/2 Y
    const Matrix x = sum(waves_.stiffness, [](double d) { return d; }) * constants,
                 y = sum(waves_.stiffness, [](double d) { return d * d; }) * constants;
    const auto spectrum =
        solve_pencil(at_zero, Matrix::Identity(at_zero.rows(), at_zero.cols()), true);
    double scale = 0;
    for (unsigned int s = 0; s < waves_.stiffness.n_blocks(); ++s)
      scale = std::max(scale, std::abs(waves_.stiffness(s, s, 0, 0)));
    Matrix second = -.5 * constants.adjoint() * y;
    for (Index i = 0; i < at_zero.rows(); ++i)
      if (spectrum.eigenvalues()[i] > zero * scale)
      {
        const Matrix part = spectrum.eigenvectors().col(i).adjoint() * x;
        second -= part.adjoint() * part / spectrum.eigenvalues()[i];
      }
    const Matrix mass = constants.adjoint() * sum(waves_.mass, one) * constants;
    const auto solver = solve_pencil(.5 * (second + second.adjoint()), mass, true);
    std::vector<double> result;
    for (const Index i : nearest((solver.eigenvectors().adjoint() * mass).cwiseAbs()))
      result.push_back(waves_.h * waves_.h * solver.eigenvalues()[i]);
    return result;
  }

  Stencil lump(const Stencil &mass, unsigned int n_families)
  {
    double total = 0, diagonal = 0;
    for (unsigned int s = 0; s < n_families; ++s)
    {
      diagonal += mass(s, s, 0, 0);
      for (unsigned int t = 0; t < n_families; ++t)
        mass.for_each_offset([&](int j1, int j2, int j3) { total += mass(s, t, j1, j2, j3); });
    }
    Stencil lumped(mass.n_blocks(), 0);
    for (unsigned int s = 0; s < mass.n_blocks(); ++s)
      lumped(s, s, 0, 0) = mass(s, s, 0, 0) * total / diagonal;
    return lumped;
  }

  bool couples_cells(const Stencil &mass)
  {
    bool couples = false;
    for (unsigned int s = 0; s < mass.n_blocks(); ++s)
      for (unsigned int t = 0; t < mass.n_blocks(); ++t)
        mass.for_each_offset(
            [&](int j1, int j2, int j3)
            {
              if ((j1 != 0 || j2 != 0 || j3 != 0) && mass(s, t, j1, j2, j3) != 0)
                couples = true;
            });
    return couples;
  }
} // namespace plumbline::algebra
