#include "algebra/multiplier_system.h"

#include "algebra/conjugate_gradients.h"
#include "algebra/slab_inverse.h"
#include "base/error.h"

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace plumbline::algebra
{
  namespace
  {
    using Values = std::vector<double>; ///< on the layer, shape (n_blocks, n_layer)

    double dot(const Values &x, const Values &y)
    {
      return std::inner_product(x.begin(), x.end(), y.begin(), 0.);
    }
  } // namespace

  struct MultiplierSystem::Parts
  {
    std::unique_ptr<Operator> matrix;
    mutable PeriodicBox box;
    std::vector<SlabInverse> slabs;

    Parts(const Stencil &stencil, const std::array<int, 3> &n, OperatorBackend backend)
        : matrix(make_operator(stencil, geometry::BoxNodes{n}, backend)), box(stencil, n)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (box.period()[d] > n[d])
          slabs.emplace_back(box, d);
    }

    /// Means of each component.
    std::array<double, 3> means(const Values &values) const
    {
      std::array<double, 3> result{};
      for (unsigned int c = 0; c < box.n_blocks(); ++c)
      {
        const auto begin = values.begin() + c * box.n_layer();
        result[c] = std::accumulate(begin, begin + box.n_layer(), 0.) / box.n_layer();
      }
      return result;
    }

    void subtract(Values &values, const std::array<double, 3> &constants) const
    {
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] -= constants[i / box.n_layer()];
    }

    /// Xλ without its mean.
    Values apply(const double *force, const Values &multipliers) const
    {
      box.set_box(force);
      box.add_layer(multipliers.data());
      box.invert();
      Values result(multipliers.size());
      box.get_layer(result.data());
      subtract(result, means(result));
      return result;
    }

    Values precondition(const Values &values) const
    {
      Values result(values.size());
      for (const SlabInverse &slab : slabs)
        slab.add(box, values.data(), result.data());
      subtract(result, means(result));
      return result;
    }

    /// u = C⁻¹ (f + λ) + c, c from the layer's means.
    void displacements(const double *force, const Values &multipliers, Vector &u) const
    {
      box.set_box(force);
      box.add_layer(multipliers.data());
      box.invert();
      Values around(multipliers.size());
      box.get_layer(around.data());
      const auto constants = means(around);
      box.get_box(u.begin());
      const std::size_t n_nodes = u.size() / box.n_blocks();
      for (std::size_t i = 0; i < u.size(); ++i)
        u[i] -= constants[i / n_nodes];
    }
  };

  namespace
  {
    /// Conjugate gradients for the multipliers of one force.
    class Multipliers
    {
    public:
      template <class Parts>
      Multipliers(const Parts &parts, const Vector &force);

      /// Until the preconditioned norm of the residual has fallen so far since the beginning.
      template <class Parts>
      unsigned int advance(const Parts &parts, double reduction, unsigned int max_iterations);

      const Values &values() const { return values_; }

    private:
      Values values_, residual_, direction_, none_;
      double first_ = 0, last_ = 0; ///< squares of the norm
    };

    template <class Parts>
    Multipliers::Multipliers(const Parts &parts, const Vector &force)
        : values_(parts.box.n_blocks() * parts.box.n_layer()), none_(force.size())
    {
      const std::size_t n_nodes = force.size() / parts.box.n_blocks();
      for (unsigned int c = 0; c < parts.box.n_blocks(); ++c)
      {
        const auto begin = force.begin() + c * n_nodes;
        std::fill_n(values_.begin() + c * parts.box.n_layer(), parts.box.n_layer(),
                    -std::accumulate(begin, begin + n_nodes, 0.) / parts.box.n_layer());
      }
      residual_ = parts.apply(force.begin(), values_);
      for (double &value : residual_)
        value = -value;
      direction_ = parts.precondition(residual_);
      first_ = last_ = dot(residual_, direction_);
    }

    template <class Parts>
    unsigned int Multipliers::advance(const Parts &parts, double reduction,
                                      unsigned int max_iterations)
    {
      unsigned int n_iterations = 0;
      while (last_ > reduction * reduction * first_ && n_iterations < max_iterations)
      {
        const Values product = parts.apply(none_.data(), direction_);
        const double step = last_ / dot(direction_, product);
        for (std::size_t i = 0; i < values_.size(); ++i)
        {
          values_[i] += step * direction_[i];
          residual_[i] -= step * product[i];
        }
        const Values preconditioned = parts.precondition(residual_);
        const double next = dot(residual_, preconditioned), share = next / last_;
        for (std::size_t i = 0; i < direction_.size(); ++i)
          direction_[i] = preconditioned[i] + share * direction_[i];
        last_ = next;
        ++n_iterations;
      }
      return n_iterations;
    }
  } // namespace

  MultiplierSystem::MultiplierSystem(const Stencil &stencil, const std::array<int, 3> &n,
                                     OperatorBackend backend)
      : parts_(std::make_unique<Parts>(symmetric(stencil), n, backend))
  {
  }
  MultiplierSystem::~MultiplierSystem() = default;

  void MultiplierSystem::vmult(Vector &y, const Vector &x) const
  {
    parts_->matrix->vmult(y, x);
  }

  LinearSolve MultiplierSystem::solve(Vector &x, const Vector &b, const Stopping &stopping) const
  {
    const double scale = b.l2_norm();
    if (!std::isfinite(scale))
      throw NumericalError("the right-hand side holds a value that is not a finite number");
    if (scale == 0)
    {
      x = 0.;
      return {0, 0, parts_->matrix->backend(), parts_->matrix->n_bonds()};
    }
    check_range(scale);
    constexpr double least_reduction = 1e-14; // beyond it recurrences lose the true residual
    constexpr double rounding = std::numeric_limits<double>::epsilon();
    Vector residual(b.size()), u(b.size()), next(b.size());
    const auto find_residual = [&](const Vector &of, Vector &result)
    {
      parts_->matrix->vmult(result, of);
      result.sadd(-1, 1, b);
      return result.l2_norm();
    };
    double norm = find_residual(x, residual);
    unsigned int n_iterations = 0;
    const auto is_reached = [&](double of, const Vector &solution)
    {
      return of <= std::max(stopping.tolerance * scale,
                            rounding * parts_->box.largest() * solution.l2_norm());
    };
    for (bool is_better = true; is_better && !is_reached(norm, x);)
    {
      Multipliers multipliers(*parts_, residual);
      double reduction = .3 * stopping.tolerance * scale / norm;
      double found = norm;
      do
      {
        n_iterations += multipliers.advance(*parts_, std::max(reduction, least_reduction),
                                            stopping.max_iterations - n_iterations);
        parts_->displacements(residual.begin(), multipliers.values(), u);
        u += x;
        found = find_residual(u, next);
        reduction *= .3 * stopping.tolerance * scale / found;
      } while (!is_reached(found, u) && reduction > .1 * least_reduction &&
               n_iterations < stopping.max_iterations);
      is_better = found < .5 * norm && n_iterations < stopping.max_iterations;
      if (found < norm)
      {
        x = u;
        residual = next;
        norm = found;
      }
    }
    if (!is_reached(norm, x))
    {
      std::ostringstream message;
      message << "conjugate gradients on the multipliers of constrained nodes stop after "
              << n_iterations << " iterations at the relative residual " << norm / scale
              << ", wanted " << stopping.tolerance
              << "; the operator may not be positive definite, or raise Solver/max iterations";
      throw NumericalError(message.str());
    }
    return {n_iterations, norm / scale, parts_->matrix->backend(), parts_->matrix->n_bonds()};
  }

  double coupling(const Stencil &stencil)
  {
    double result = 1;
    const unsigned int n_axes = stencil.reaches()[2] > 0 ? 3 : 2;
    if (stencil.n_blocks() != n_axes)
      return result;
    for (unsigned int d = 0; d < n_axes; ++d)
    {
      std::array<double, 3> moment{};
      stencil.for_each_offset(
          [&](int k1, int k2, int k3)
          {
            const double k = std::array{k1, k2, k3}[d];
            for (unsigned int c = 0; c < n_axes; ++c)
              moment[c] -= k * k * stencil(c, c, k1, k2, k3);
          });
      for (unsigned int c = 0; c < n_axes; ++c)
        if (moment[c] > 0)
          result = std::max(result, moment[d] / moment[c]);
    }
    return result;
  }

  double multiplier_bytes(unsigned int n_blocks, const std::array<int, 3> &n,
                          const std::array<int, 3> &reaches)
  {
    constexpr double value = sizeof(double);
    const auto periods = PeriodicBox::periods(reaches, n);
    double points = 1, nodes = 1, matrices = 0;
    for (unsigned int d = 0; d < 3; ++d)
    {
      points *= periods[d];
      nodes *= n[d];
      matrices += SlabInverse::bytes(n_blocks, n, periods, d);
    }
    // the symbol, a field and its modes; multipliers, conjugate gradients and planes; residuals
    return matrices + points * value * n_blocks * (2 + (n_blocks + 1) / 4.) +
           (points - nodes) * value * n_blocks * 8 + nodes * value * n_blocks * 3;
  }

  double most_multiplier_bytes(unsigned int n_blocks, const std::array<int, 3> &n)
  {
    constexpr double per_unknown = 400, always = 2e8;
    return std::max(always, per_unknown * n_blocks * n[0] * n[1] * n[2]);
  }

  double expected_multiplier_bytes(unsigned int n_blocks, const std::array<int, 3> &n, int least,
                                   int most)
  {
    const double limit = most_multiplier_bytes(n_blocks, n);
    if (multiplier_bytes(n_blocks, n, {least, least, least}) > limit)
      return 0;
    return std::min(limit, multiplier_bytes(n_blocks, n, {most, most, most}));
  }

  bool has_mirror_images(const Stencil &stencil)
  {
    constexpr double rounding = 1e-14;
    double largest = 0, defect = 0;
    for (unsigned int s = 0; s < stencil.n_blocks(); ++s)
      for (unsigned int t = 0; t < stencil.n_blocks(); ++t)
        stencil.for_each_offset(
            [&](int k1, int k2, int k3)
            {
              const double entry = stencil(s, t, k1, k2, k3);
              largest = std::max(largest, std::abs(entry));
              for (unsigned int d = 0; d < 3; ++d)
              {
                std::array<int, 3> image = {k1, k2, k3};
                image[d] = -image[d];
                const double sign = (s == d) != (t == d) ? -1 : 1;
                defect = std::max(
                    defect, std::abs(entry - sign * stencil(s, t, image[0], image[1], image[2])));
              }
            });
    return defect <= rounding * largest;
  }

  std::unique_ptr<LinearSystem>
  make_box_system(const Stencil &stencil, const geometry::BoxNodes &nodes, OperatorBackend backend)
  {
    const unsigned int n_blocks = stencil.n_blocks();
    if (nodes.is_free.empty() && n_blocks <= 3 && coupling(stencil) > strong_coupling &&
        stencil.is_even() && has_mirror_images(stencil) &&
        multiplier_bytes(n_blocks, nodes.n, stencil.reaches()) <=
            most_multiplier_bytes(n_blocks, nodes.n))
      try
      {
        return std::make_unique<MultiplierSystem>(stencil, nodes.n, backend);
      }
      catch (const NumericalError &)
      {
        // a wave along one axis may be unstable, though those that vanish around the box are not
      }
    return std::make_unique<StencilSystem>(stencil, nodes, backend);
  }
} // namespace plumbline::algebra
