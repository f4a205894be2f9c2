#pragma once

#include "base/error.h"
#include "method/discretisation.h"

#include <functional>
#include <utility>

namespace plumbline::method
{
  /// A lattice with one axis (Domain/dimension = 1), the same for both sides: what moves on it.
  /// Statics, spectra and waves are those of the plane.
  class LineDiscretisation : public Discretisation
  {
  public:
    /// @param n_more  points of forces beyond those that are enough, where they are by quadrature
    using Move =
        std::function<std::unique_ptr<EquationOfMotion>(bool is_lumped, unsigned int n_more)>;

    LineDiscretisation(std::size_t n_unknowns, bool has_finer, Move move)
        : n_unknowns_(n_unknowns), has_finer_(has_finer), move_(std::move(move))
    {
    }

    std::size_t n_unknowns() const override { return n_unknowns_; }
    std::unique_ptr<EquationOfMotion> motion(bool is_lumped) const override
    {
      return move_(is_lumped, 0);
    }
    std::unique_ptr<EquationOfMotion> finer_motion(bool is_lumped) const override
    {
      return has_finer_ ? move_(is_lumped, 1) : nullptr;
    }
    Diagnostics diagnostics() const override { return {}; }

    CaseData data(const problem::Problem<2> &) const override { refuse(); }
    std::unique_ptr<algebra::LinearSystem> tangent() const override { refuse(); }
    DiscreteOperator matrix() const override { refuse(); }

  private:
    [[noreturn]] static void refuse()
    {
      throw NumericalError("a lattice with one axis moves, and does nothing else");
    }

    std::size_t n_unknowns_;
    bool has_finer_;
    Move move_;
  };
} // namespace plumbline::method
