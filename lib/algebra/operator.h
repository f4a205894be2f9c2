#pragma once

#include "algebra/stencil.h"
#include "base/solver_choices.h"
#include "geometry/cube_lattice.h"

#include <memory>
#include <string>

namespace dealii
{
  template <typename Number>
  class Vector; // <deal.II/lac/vector.h> is large; sources that look into vectors include it
}

namespace plumbline::algebra
{
  using Vector = dealii::Vector<double>;

  using base::OperatorBackend;

  /// A linear operator on the vectors of a NodeSet; positions that are not free are zero in and
  /// out.
  class Operator
  {
  public:
    virtual ~Operator() = default;
    virtual void vmult(Vector &result, const Vector &input) const = 0;
    virtual std::string backend() const = 0;
    virtual std::uint64_t n_bonds() const = 0; ///< pairs one application sums over
  };

  /// Couplings between free nodes of a stencil, by the backend asked for.
  /// @throws InputError  OperatorBackend::direct for a stencil that is not even or has more than
  /// three blocks
  std::unique_ptr<Operator> make_operator(const Stencil &stencil, const geometry::NodeSet &nodes,
                                          OperatorBackend backend = OperatorBackend::automatic);

  /// The same in space for nodes of one family. Not for: OperatorBackend::sparse.
  std::unique_ptr<Operator> make_operator(const Stencil &stencil, const geometry::BoxNodes &nodes,
                                          OperatorBackend backend = OperatorBackend::automatic);

  /// Whether a stencil is applied directly on a box of these extents, not by transforms.
  /// @throws InputError  a backend that cannot do it, see `make_operator`
  bool is_direct(const Stencil &stencil, const std::array<int, 3> &n, OperatorBackend backend);

  /// The action of given values outside the free nodes on the free nodes: Σ_k A(k) g(i + k).
  /// @param data  shape (n_blocks, n[1] + 2 reach, n[0] + 2 reach), 0 at free positions
  Vector collar_action(const Stencil &stencil, const geometry::NodeSet &nodes,
                       const std::vector<double> &data);

  /// The same in space.
  /// @param data  shape (n_blocks, n[2] + 2 reach, n[1] + 2 reach, n[0] + 2 reach)
  /// @pre the same reach along all axes
  Vector collar_action(const Stencil &stencil, const geometry::BoxNodes &nodes,
                       const std::vector<double> &data);
} // namespace plumbline::algebra
