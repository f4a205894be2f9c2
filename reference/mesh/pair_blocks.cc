#include "reference/mesh/pair_blocks.h"

namespace plumbline::reference
{
  void transform(const std::vector<double> &left, const std::vector<double> &right, unsigned int n,
                 std::vector<double> &block)
  {
    const std::size_t n_entries = block.size() / (static_cast<std::size_t>(n) * n);
    const auto multiply =
        [&](const std::vector<double> &factor, std::size_t along, std::size_t across)
    {
      if (factor.empty())
        return;
      std::vector<double> before(n);
      for (unsigned int k = 0; k < n; ++k)
        for (std::size_t e = 0; e < n_entries; ++e)
        {
          double *const line = &block[k * across * n_entries + e];
          for (unsigned int b = 0; b < n; ++b)
            before[b] = line[b * along * n_entries];
          for (unsigned int a = 0; a < n; ++a)
          {
            double sum = 0;
            for (unsigned int b = 0; b < n; ++b)
              sum += factor[a * n + b] * before[b];
            line[a * along * n_entries] = sum;
          }
        }
    };
    multiply(left, n, 1);
    multiply(right, 1, n);
  }
} // namespace plumbline::reference
