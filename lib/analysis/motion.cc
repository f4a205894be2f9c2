#include "analysis/motion.h"

#include <cmath>

namespace plumbline::analysis
{
  double dot(const Vector &x, const Vector &y, const base::Communicator &ranks)
  {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += x[i] * y[i];
    return ranks.sum(sum);
  }

  double norm(const Vector &x, const base::Communicator &ranks)
  {
    return std::sqrt(dot(x, x, ranks));
  }

  void add(Vector &x, double factor, const Vector &y)
  {
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] += factor * y[i];
  }
} // namespace plumbline::analysis
