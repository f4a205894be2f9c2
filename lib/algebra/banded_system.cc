#include "algebra/banded_system.h"

#include "base/error.h"
#include "base/memory.h"

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::algebra
{
  Vector line_action(const Stencil &stencil, int n, const std::vector<char> &is_free,
                     const std::vector<double> &data)
  {
    const int reach = stencil.reach();
    const std::size_t width = static_cast<std::size_t>(n) + 2 * static_cast<std::size_t>(reach);
    Vector result(is_free.size());
    for (unsigned int s = 0; s < stencil.n_blocks(); ++s)
      for (int i = 0; i < n; ++i)
      {
        const std::size_t place = static_cast<std::size_t>(s) * n + i;
        if (is_free[place] == 0)
          continue;
        double sum = 0;
        for (unsigned int t = 0; t < stencil.n_blocks(); ++t)
          for (int k = -reach; k <= reach; ++k)
            sum += stencil(s, t, k, 0) * data[t * width + static_cast<std::size_t>(i + k + reach)];
        result[place] = sum;
      }
    return result;
  }

  BandedSystem::BandedSystem(const Stencil &stencil, int n, const std::vector<char> &is_free)
      : stencil_(symmetric(stencil)), n_(n), is_free_(is_free)
  {
    factor();
  }

  void BandedSystem::factor()
  {
    const unsigned int n_blocks = stencil_.n_blocks();
    std::vector<int> position;
    std::vector<unsigned int> family;
    for (int i = 0; i < n_; ++i)
      for (unsigned int s = 0; s < n_blocks; ++s)
        if (is_free_[static_cast<std::size_t>(s) * n_ + i] != 0)
        {
          place_.push_back(static_cast<std::size_t>(s) * n_ + i);
          position.push_back(i);
          family.push_back(s);
        }
    const std::size_t n = place_.size();
    band_ = std::min((static_cast<std::size_t>(stencil_.reach()) + 1) * n_blocks, n);
    base::require_memory(
        8. * static_cast<double>(n) * static_cast<double>(band_ + 1),
        "the banded factor of " + std::to_string(n) + " unknowns",
        "choose a larger h or a smaller horizon (Study/h, Study/m, Study/horizon)");
    factor_.assign(n * (band_ + 1), 0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i < band_ ? 0 : i - band_; j <= i; ++j)
      {
        const int k = position[j] - position[i];
        double value = std::abs(k) <= stencil_.reach() ? stencil_(family[i], family[j], k, 0) : 0;
        const std::size_t from = std::max(i < band_ ? 0 : i - band_, j < band_ ? 0 : j - band_);
        for (std::size_t l = from; l < j; ++l)
          value -= row(i)[l + band_ - i] * row(j)[l + band_ - j];
        if (j < i)
          row(i)[j + band_ - i] = value / row(j)[band_];
        else if (const double diagonal = stencil_(family[i], family[i], 0, 0);
                 !(value > 1e-13 * diagonal))
        {
          std::ostringstream message;
          message << "the matrix is not positive definite (pivot " << value << " of " << diagonal
                  << "), so this method is not stable for this problem; take another "
                     "method or kernel";
          throw NumericalError(message.str());
        }
        else
          row(i)[band_] = std::sqrt(value);
      }
  }

  void BandedSystem::vmult(Vector &y, const Vector &x) const
  {
    const int reach = stencil_.reach();
    const std::size_t width = static_cast<std::size_t>(n_) + 2 * static_cast<std::size_t>(reach);
    std::vector<double> padded(stencil_.n_blocks() * width);
    for (const std::size_t place : place_)
      padded[place / n_ * width + place % n_ + static_cast<std::size_t>(reach)] = x[place];
    y = line_action(stencil_, n_, is_free_, padded);
  }

  LinearSolve BandedSystem::solve(Vector &x, const Vector &b, const Stopping &) const
  {
    const std::size_t n = place_.size();
    std::vector<double> u(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      double value = b[place_[i]];
      for (std::size_t j = i < band_ ? 0 : i - band_; j < i; ++j)
        value -= row(i)[j + band_ - i] * u[j];
      u[i] = value / row(i)[band_];
    }
    for (std::size_t i = n; i-- > 0;)
    {
      u[i] /= row(i)[band_];
      for (std::size_t j = i < band_ ? 0 : i - band_; j < i; ++j)
        u[j] -= row(i)[j + band_ - i] * u[i];
    }
    x = 0;
    for (std::size_t i = 0; i < n; ++i)
      x[place_[i]] = u[i];
    Vector residual(b.size());
    vmult(residual, x);
    residual -= b;
    LinearSolve solved;
    const double size = b.l2_norm();
    solved.relative_residual = size > 0 ? residual.l2_norm() / size : 0;
    solved.backend = "direct";
    solved.n_bonds = stencil_.n_entries() * static_cast<std::uint64_t>(n_);
    if (!std::isfinite(solved.relative_residual))
      throw NumericalError("the solution has values that are not finite");
    return solved;
  }
} // namespace plumbline::algebra
