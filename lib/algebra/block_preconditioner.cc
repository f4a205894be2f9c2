#include "algebra/block_preconditioner.h"

#include <algorithm>

namespace plumbline::algebra
{
  namespace
  {
    /// This rank's rows of the leading block A.
    CsrMatrix leading_block(const CsrView &own, const OwnedRanges &ranges)
    {
      const std::size_t n = ranges.size_of_all();
      CsrMatrix block;
      block.start = {0};
      for (std::size_t i = 0; i < ranges.own_size; ++i)
      {
        for (std::size_t e = own.start[i]; e < own.start[i + 1] && own.column[e] < n; ++e)
        {
          block.column.push_back(own.column[e]);
          block.value.push_back(own.value[e]);
        }
        block.start.push_back(block.column.size());
      }
      return block;
    }
  } // namespace

  BlockPreconditioner::BlockPreconditioner(const DistributedMatrix &matrix, std::size_t n_first,
                                           unsigned int n_components,
                                           const std::vector<dealii::Point<2>> &nodes)
      : matrix_(matrix), first_(matrix.ranges(), n_first),
        multigrid_(leading_block(matrix.own(), first_), first_, n_components, nodes)
  {
  }

  void BlockPreconditioner::vmult(Vector &z, const Vector &r) const
  {
    const auto n_own = static_cast<std::ptrdiff_t>(first_.own_size);
    Vector x(first_.own(), first_.communicator.mpi), f(x);
    std::copy(r.begin(), r.begin() + n_own, f.begin());
    multigrid_.vmult(x, f);

    Vector product(z); // C x, where z = (x, 0)
    z = 0;
    std::copy(x.begin(), x.begin() + n_own, z.begin());
    matrix_.vmult(product, z, first_.size_of_all());
    for (std::size_t i = first_.own_size; i < matrix_.ranges().own_size; ++i)
      z.begin()[i] = r.begin()[i] - product.begin()[i];
  }
} // namespace plumbline::algebra
