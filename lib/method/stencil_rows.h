#pragma once

#include "algebra/csr_matrix.h"
#include "algebra/stencil.h"

#include <array>
#include <functional>
#include <vector>

namespace plumbline::method
{
  /// The degrees of freedom of a lattice; in the plane n[2] = 1.
  struct LatticeNodes
  {
    std::array<int, 3> n{};
    unsigned int n_families = 1, n_components = 1;
    std::function<bool(unsigned int family, const std::array<int, 3> &position)> is_free;
  };

  /// The rows of a stencil at free nodes, as a matrix.
  struct StencilRows
  {
    struct Node
    {
      unsigned int family = 0;
      std::array<int, 3> position{};
    };

    /// The free nodes, then the constrained ones that their rows reach: each family by family, x
    /// fastest.
    std::vector<Node> nodes;
    std::size_t n_free = 0;
    algebra::CsrMatrix rows; ///< columns node by node, shape (n_free, n_nodes) · n_components
  };

  /// @throws InputError  it needs more memory than there is
  StencilRows make_rows(const algebra::Stencil &stencil, const LatticeNodes &nodes);
} // namespace plumbline::method
