#include "algebra/operator.h"

#include "algebra/convolution.h"
#include "algebra/direct.h"
#include "algebra/sparse.h"
#include "base/error.h"

#include <deal.II/lac/vector.h>

#include <algorithm>

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
      StencilOperator(const Stencil &stencil, const geometry::NodeSet &nodes, std::string backend,
                      Application &&application)
          : nodes_(nodes), backend_(std::move(backend)), application_(std::move(application)),
            n_bonds_(stencil.n_entries() * nodes.n_unknowns() / nodes.n_blocks()),
            is_masked_(std::any_of(nodes.is_free.begin(), nodes.is_free.end(),
                                   [](char c) { return c == 0; }))
      {
      }
      void vmult(Vector &result, const Vector &input) const override
      {
        application_.apply(input.begin(), result.begin());
        if (is_masked_)
          restrict_to_free(nodes_, result.begin());
      }
      std::string backend() const override { return backend_; }
      std::uint64_t n_bonds() const override { return n_bonds_; }

    private:
      geometry::NodeSet nodes_;
      std::string backend_;
      Application application_;
      std::uint64_t n_bonds_;
      bool is_masked_;
    };
  } // namespace

  std::unique_ptr<Operator> make_operator(const Stencil &stencil, const geometry::NodeSet &nodes,
                                          OperatorBackend backend)
  {
    if (backend == OperatorBackend::automatic)
    {
      const bool direct_is_faster =
          DirectStencil::fits(stencil) &&
          DirectStencil::estimated_seconds(stencil, nodes.n) <
              Convolution::estimated_seconds(stencil.n_blocks(), stencil.reach(), nodes.n);
      backend = direct_is_faster ? OperatorBackend::direct : OperatorBackend::fft;
    }
    if (backend == OperatorBackend::sparse)
      return std::make_unique<SparseOperator>(stencil, nodes);
    if (backend == OperatorBackend::fft)
      return std::make_unique<StencilOperator<Convolution>>(stencil, nodes, "fft",
                                                            Convolution(stencil, nodes.n, 0));
    if (!DirectStencil::fits(stencil))
      throw InputError("Solver/operator = direct needs one node family with one or two components; "
                       "choose automatic or fft");
    return std::make_unique<StencilOperator<DirectStencil>>(stencil, nodes, "direct",
                                                            DirectStencil(stencil, nodes.n));
  }

  Vector collar_action(const Stencil &stencil, const geometry::NodeSet &nodes,
                       const std::vector<double> &data)
  {
    Vector result(nodes.size());
    Convolution(stencil, nodes.n, stencil.reach()).apply(data.data(), result.begin());
    restrict_to_free(nodes, result.begin());
    return result;
  }
} // namespace plumbline::algebra
