#include "algebra/operator.h"

#include "algebra/convolution.h"
#include "algebra/direct.h"
#include "algebra/sparse.h"
#include "base/error.h"

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <utility>

namespace plumbline::algebra
{
  namespace
  {
    /// Which positions are free, the same for each component; empty: all.
    struct Mask
    {
      std::vector<char> is_free;
      unsigned int n_components = 1;
    };

    Mask mask_of(const geometry::NodeSet &nodes)
    {
      const bool are_all_free = std::all_of(nodes.is_free.begin(), nodes.is_free.end(),
                                            [](char is_free) { return is_free != 0; });
      return {are_all_free ? std::vector<char>() : nodes.is_free, nodes.n_components};
    }

    /// Set to zero what is not free.
    void restrict_to_free(const Mask &mask, double *values)
    {
      for (unsigned int c = 0; c < mask.n_components; ++c)
        for (const char is_free : mask.is_free)
          *values++ *= is_free != 0 ? 1. : 0.;
    }

    /// A shared stencil applied by one of the two backends for it.
    template <class Application>
    class StencilOperator : public Operator
    {
    public:
      StencilOperator(std::uint64_t n_bonds, Mask mask, std::string backend,
                      Application &&application)
          : mask_(std::move(mask)), backend_(std::move(backend)),
            application_(std::move(application)), n_bonds_(n_bonds)
      {
      }
      void vmult(Vector &result, const Vector &input) const override
      {
        application_.apply(input.begin(), result.begin());
        restrict_to_free(mask_, result.begin());
      }
      std::string backend() const override { return backend_; }
      std::uint64_t n_bonds() const override { return n_bonds_; }

    private:
      Mask mask_;
      std::string backend_;
      Application application_;
      std::uint64_t n_bonds_;
    };

    /// By transforms or directly.
    std::unique_ptr<Operator> make_shared_operator(const Stencil &stencil,
                                                   const std::array<int, 3> &n,
                                                   std::uint64_t n_bonds, Mask mask,
                                                   OperatorBackend backend)
    {
      if (!is_direct(stencil, n, backend))
        return std::make_unique<StencilOperator<Convolution>>(n_bonds, std::move(mask), "fft",
                                                              Convolution(stencil, n, 0));
      return std::make_unique<StencilOperator<DirectStencil>>(n_bonds, std::move(mask), "direct",
                                                              DirectStencil(stencil, n));
    }
  } // namespace

  bool is_direct(const Stencil &stencil, const std::array<int, 3> &n, OperatorBackend backend)
  {
    if (backend == OperatorBackend::sparse)
      throw InputError("Solver/operator = sparse is for lattices in the plane; choose automatic, "
                       "direct or fft");
    if (backend == OperatorBackend::automatic)
      return DirectStencil::fits(stencil) &&
             DirectStencil::estimated_seconds(stencil, n) <
                 Convolution::estimated_seconds(stencil.n_blocks(), stencil.reaches(), n);
    if (backend == OperatorBackend::direct && !DirectStencil::fits(stencil))
      throw InputError("Solver/operator = direct needs one node family with one to three "
                       "components; choose automatic or fft");
    return backend == OperatorBackend::direct;
  }

  std::unique_ptr<Operator> make_operator(const Stencil &stencil, const geometry::NodeSet &nodes,
                                          OperatorBackend backend)
  {
    if (backend == OperatorBackend::sparse)
      return std::make_unique<SparseOperator>(stencil, nodes);
    return make_shared_operator(stencil, {nodes.n[0], nodes.n[1], 1},
                                stencil.n_entries() * nodes.n_unknowns() / nodes.n_blocks(),
                                mask_of(nodes), backend);
  }

  std::unique_ptr<Operator> make_operator(const Stencil &stencil, const geometry::BoxNodes &nodes,
                                          OperatorBackend backend)
  {
    return make_shared_operator(stencil, nodes.n, stencil.n_entries() * nodes.n_free(),
                                {nodes.is_free, stencil.n_blocks()}, backend);
  }

  Vector collar_action(const Stencil &stencil, const geometry::NodeSet &nodes,
                       const std::vector<double> &data)
  {
    Vector result(nodes.size());
    Convolution(stencil, nodes.n, stencil.reach()).apply(data.data(), result.begin());
    restrict_to_free(mask_of(nodes), result.begin());
    return result;
  }

  Vector collar_action(const Stencil &stencil, const geometry::BoxNodes &nodes,
                       const std::vector<double> &data)
  {
    Vector result(stencil.n_blocks() * nodes.n_positions());
    Convolution(stencil, nodes.n, stencil.reach()).apply(data.data(), result.begin());
    restrict_to_free({nodes.is_free, stencil.n_blocks()}, result.begin());
    return result;
  }
} // namespace plumbline::algebra
