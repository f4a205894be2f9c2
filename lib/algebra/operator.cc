#include "algebra/operator.h"

#include "algebra/convolution.h"
#include "algebra/direct.h"
#include "algebra/sparse.h"
#include "base/error.h"

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

    /// A shared stencil applied by one of the two roads for it.
    template <class Application>
    class StencilOperator : public Operator
    {
    public:
      StencilOperator(const Stencil &stencil, const geometry::NodeSet &nodes, std::string road,
                      Application &&application)
          : nodes_(nodes), road_(std::move(road)), application_(std::move(application)),
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
      std::string road() const override { return road_; }
      std::uint64_t n_bonds() const override { return n_bonds_; }

    private:
      geometry::NodeSet nodes_;
      std::string road_;
      Application application_;
      std::uint64_t n_bonds_;
      bool is_masked_;
    };
  } // namespace

  Road road_from_name(const std::string &name)
  {
    if (name == "automatic")
      return Road::automatic;
    if (name == "fft")
      return Road::fft;
    if (name == "direct")
      return Road::direct;
    if (name == "sparse")
      return Road::sparse;
    throw InputError("Solver/operator = '" + name +
                     "' is not known; choose automatic, fft, direct or sparse");
  }

  std::unique_ptr<Operator> make_operator(const Stencil &stencil, const geometry::NodeSet &nodes,
                                          Road road)
  {
    if (road == Road::automatic)
    {
      const bool direct_is_faster =
          DirectStencil::fits(stencil) &&
          DirectStencil::estimated_seconds(stencil, nodes.n) <
              Convolution::estimated_seconds(stencil.n_blocks(), stencil.reach(), nodes.n);
      road = direct_is_faster ? Road::direct : Road::fft;
    }
    if (road == Road::sparse)
      return std::make_unique<SparseOperator>(stencil, nodes);
    if (road == Road::fft)
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
