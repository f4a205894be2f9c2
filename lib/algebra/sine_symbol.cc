#include "algebra/sine_symbol.h"

#include "base/error.h"

#include <cmath>
#include <sstream>

namespace plumbline::algebra
{
  namespace
  {
    /// cos(k θ_p), θ_p = π (p + 1) / (n + 1), times 2 for k > 0 (both signs of k): shape (n_modes,
    /// reach + 1).
    std::vector<double> cosines(int n, const std::pair<int, int> &modes, int reach)
    {
      std::vector<double> result;
      for (int p = modes.first + 1; p <= modes.second; ++p)
        for (int k = 0; k <= reach; ++k)
          result.push_back((k == 0 ? 1 : 2) * std::cos(M_PI * k * p / (n + 1)));
      return result;
    }

    /// Σ_k values(i, k, j) cosines(p, k), shape (n_outer, n_modes, n_inner)
    std::vector<double> contract(const std::vector<double> &values,
                                 const std::vector<double> &cosines, std::size_t n_offsets,
                                 std::size_t n_inner)
    {
      const std::size_t n_modes = cosines.size() / n_offsets,
                        n_outer = values.size() / (n_offsets * n_inner);
      std::vector<double> result(n_outer * n_modes * n_inner);
      for (std::size_t i = 0; i < n_outer; ++i)
        for (std::size_t p = 0; p < n_modes; ++p)
          for (std::size_t k = 0; k < n_offsets; ++k)
            for (std::size_t j = 0; j < n_inner; ++j)
              result[(i * n_modes + p) * n_inner + j] +=
                  values[(i * n_offsets + k) * n_inner + j] * cosines[p * n_offsets + k];
      return result;
    }
  } // namespace

  std::vector<double> sine_symbol(const Stencil &stencil, unsigned int component,
                                  const std::array<int, 3> &n, const std::pair<int, int> &rows)
  {
    const auto &reach = stencil.reaches();
    std::vector<double> values;
    if (rows.first == rows.second)
      return values;
    for (int k3 = 0; k3 <= reach[2]; ++k3)
      for (int k2 = 0; k2 <= reach[1]; ++k2)
        for (int k1 = 0; k1 <= reach[0]; ++k1)
          values.push_back(stencil(component, component, k1, k2, k3));
    std::size_t n_inner = 1;
    for (unsigned int d = 0; d < 3; ++d)
    {
      const std::pair<int, int> modes = d == 1 ? rows : std::pair(0, n[d]);
      values = contract(values, cosines(n[d], modes, reach[d]),
                        static_cast<std::size_t>(reach[d]) + 1, n_inner);
      n_inner *= modes.second - modes.first;
    }
    return values;
  }

  void check_positive(double least, double largest)
  {
    if (least > 0)
      return;
    std::ostringstream message;
    message << "the operator is not positive definite: its symbol reaches " << least << " (largest "
            << largest << "); the rule is unstable here, change the rule or the ratio horizon / h";
    throw NumericalError(message.str());
  }
} // namespace plumbline::algebra
