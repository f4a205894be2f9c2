#include "algebra/operator.h"

#include "algebra/convolution.h"
#include "algebra/direct.h"
#include "algebra/sparse.h"
#include "base/error.h"

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace plumbline::algebra
{
  namespace
  {
    /// Set to zero what is not free.
    void restrict_to_free(const geometry::NodeSet &nodes, double *values)
    {
      for (unsigned int c = 0; c < nodes.n_components; ++c)
        for (const char is_free : nodes.is_free)
          *values++ *= is_free != 0 ? 1. : 0.;
    }

    /// A shared stencil applied by one of the two backends for it.
    template <class Application>
    class StencilOperator : public Operator
    {
    public:
      /// @param nodes  none: all positions are free
      StencilOperator(std::uint64_t n_bonds, std::optional<geometry::NodeSet> nodes,
                      std::string backend, Application &&application)
          : nodes_(std::move(nodes)), backend_(std::move(backend)),
            application_(std::move(application)), n_bonds_(n_bonds),
            is_masked_(nodes_ && std::any_of(nodes_->is_free.begin(), nodes_->is_free.end(),
                                             [](char c) { return c == 0; }))
      {
      }
      void vmult(Vector &result, const Vector &input) const override
      {
        application_.apply(input.begin(), result.begin());
        if (is_masked_)
          restrict_to_free(*nodes_, result.begin());
      }
      std::string backend() const override { return backend_; }
      std::uint64_t n_bonds() const override { return n_bonds_; }

    private:
      std::optional<geometry::NodeSet> nodes_;
      std::string backend_;
      Application application_;
      std::uint64_t n_bonds_;
      bool is_masked_;
    };

    /// By transforms or directly.
    std::unique_ptr<Operator>
    make_shared_operator(const Stencil &stencil, const std::array<int, 3> &n, std::uint64_t n_bonds,
                         std::optional<geometry::NodeSet> nodes, OperatorBackend backend)
    {
      if (backend == OperatorBackend::automatic)
      {
        const bool direct_is_faster =
            DirectStencil::fits(stencil) &&
            DirectStencil::estimated_seconds(stencil, n) <
                Convolution::estimated_seconds(stencil.n_blocks(), stencil.reaches(), n);
        backend = direct_is_faster ? OperatorBackend::direct : OperatorBackend::fft;
      }
      if (backend == OperatorBackend::fft)
        return std::make_unique<StencilOperator<Convolution>>(n_bonds, std::move(nodes), "fft",
                                                              Convolution(stencil, n, 0));
      if (!DirectStencil::fits(stencil))
        throw InputError("Solver/operator = direct needs one node family with one to three "
                         "components; choose automatic or fft");
      return std::make_unique<StencilOperator<DirectStencil>>(n_bonds, std::move(nodes), "direct",
                                                              DirectStencil(stencil, n));
    }
  } // namespace

  std::unique_ptr<Operator> make_operator(const Stencil &stencil, const geometry::NodeSet &nodes,
                                          OperatorBackend backend)
  {
    if (backend == OperatorBackend::sparse)
      return std::make_unique<SparseOperator>(stencil, nodes);
    return make_shared_operator(stencil, {nodes.n[0], nodes.n[1], 1},
                                stencil.n_entries() * nodes.n_unknowns() / nodes.n_blocks(), nodes,
                                backend);
  }

  std::unique_ptr<Operator> make_operator(const Stencil &stencil, const std::array<int, 3> &n,
                                          OperatorBackend backend)
  {
    if (backend == OperatorBackend::sparse)
      throw InputError("Solver/operator = sparse is for lattices in the plane; choose automatic, "
                       "direct or fft");
    const std::uint64_t n_nodes = static_cast<std::uint64_t>(n[0]) * n[1] * n[2];
    return make_shared_operator(stencil, n, stencil.n_entries() * n_nodes, {}, backend);
  }

  Vector collar_action(const Stencil &stencil, const geometry::NodeSet &nodes,
                       const std::vector<double> &data)
  {
    Vector result(nodes.size());
    Convolution(stencil, nodes.n, stencil.reach()).apply(data.data(), result.begin());
    restrict_to_free(nodes, result.begin());
    return result;
  }

  Vector collar_action(const Stencil &stencil, const std::array<int, 3> &n,
                       const std::vector<double> &data)
  {
    Vector result(static_cast<std::size_t>(stencil.n_blocks()) * n[0] * n[1] * n[2]);
    Convolution(stencil, n, stencil.reach()).apply(data.data(), result.begin());
    return result;
  }
} // namespace plumbline::algebra
