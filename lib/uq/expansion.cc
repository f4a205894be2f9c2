#include "uq/expansion.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace plumbline::uq
{
  namespace
  {
    void require_modes(std::size_t wanted, unsigned int n_modes)
    {
      if (wanted > n_modes)
        throw InputError(std::to_string(wanted) + " modes are asked of an expansion that has " +
                         std::to_string(n_modes) + "; ask for fewer, or compute more");
    }
  } // namespace

  double Expansion::total_variance() const
  {
    return std::accumulate(variance.begin(), variance.end(), 0.) * grid.cell_area();
  }

  double Expansion::variance_kept(unsigned int n) const
  {
    require_modes(n, n_modes());
    const double total = total_variance();
    if (!(total > 0))
      return 1;
    return std::min(1., std::accumulate(eigenvalue.begin(), eigenvalue.begin() + n, 0.) / total);
  }

  std::optional<unsigned int> Expansion::modes_for(double share) const
  {
    for (unsigned int n = 0; n <= n_modes(); ++n)
      if (variance_kept(n) >= share)
        return n;
    return {};
  }

  std::vector<double> Expansion::variance_of_modes(unsigned int n) const
  {
    require_modes(n, n_modes());
    std::vector<double> sum(grid.size());
    for (unsigned int k = 0; k < n; ++k)
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += eigenvalue[k] * mode[k][i] * mode[k][i];
    return sum;
  }

  GridField Expansion::realise(const std::vector<double> &xi, Interpolation between) const
  {
    require_modes(xi.size(), n_modes());
    std::vector<double> values = mean;
    for (std::size_t k = 0; k < xi.size(); ++k)
    {
      const double amplitude = xi[k] * std::sqrt(eigenvalue[k]);
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] += amplitude * mode[k][i];
    }
    return GridField(grid, std::move(values), between);
  }

  std::vector<double> Expansion::coordinates(const std::vector<double> &values) const
  {
    std::vector<double> xi(n_modes());
    for (unsigned int k = 0; k < n_modes(); ++k)
    {
      double product = 0;
      for (std::size_t i = 0; i < mean.size(); ++i)
        product += (values[i] - mean[i]) * mode[k][i];
      if (eigenvalue[k] > 0)
        xi[k] = product * grid.cell_area() / std::sqrt(eigenvalue[k]);
    }
    return xi;
  }
} // namespace plumbline::uq
