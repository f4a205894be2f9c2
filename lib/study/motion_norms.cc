#include "study/motion_norms.h"

#include "analysis/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace plumbline::study
{
  double norm_of(const std::vector<double> &values, unsigned int n_components, double area,
                 bool is_largest, const base::Communicator &ranks)
  {
    double sum = 0, largest = 0;
    for (std::size_t i = 0; i < values.size(); i += n_components)
    {
      double square = 0;
      for (unsigned int c = 0; c < n_components; ++c)
        square += values[i + c] * values[i + c];
      sum += square;
      largest = std::max(largest, std::sqrt(square));
    }
    return is_largest ? ranks.largest(largest)
                      : std::sqrt(area * ranks.sum(sum) * n_components /
                                  ranks.sum(static_cast<double>(values.size())));
  }

  double area_of(const problem::Problem<2> &problem)
  {
    if (problem.cells())
      return std::accumulate(
          problem.cells()->area.begin(),
          problem.cells()->area.begin() + static_cast<std::ptrdiff_t>(problem.cells()->n_free), 0.);
    const geometry::Lattice &lattice = *problem.lattice();
    double n = 0;
    for (int j = 0; j < lattice.n_cells()[1]; ++j)
      for (int i = 0; i < lattice.n_cells()[0]; ++i)
        n += lattice.is_inside(i, j) ? 1 : 0;
    return n * std::pow(lattice.h(), problem.dimension());
  }

  double area_of(const problem::Problem<3> &problem)
  {
    return static_cast<double>(problem.lattice.size()) * std::pow(problem.h(), 3);
  }

  double extent_of(const std::vector<double> &nodal, unsigned int n_components,
                   const base::Communicator &ranks)
  {
    double extent = 0;
    for (unsigned int c = 0; c < n_components; ++c)
    {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (std::size_t i = c; i < nodal.size(); i += n_components)
      {
        low = std::min(low, nodal[i]);
        high = std::max(high, nodal[i]);
      }
      extent = std::max(extent, ranks.largest(high) + ranks.largest(-low));
    }
    return extent;
  }

  std::vector<double> difference(std::vector<double> a, const std::vector<double> &b)
  {
    analysis::add(a, -1, b);
    return a;
  }
} // namespace plumbline::study
