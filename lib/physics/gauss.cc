#include "physics/gauss.h"

#include <deal.II/base/quadrature_lib.h>

#include <map>
#include <mutex>

namespace plumbline::physics
{
  const dealii::Quadrature<1> &gauss(unsigned int n)
  {
    static std::mutex mutex;
    static std::map<unsigned int, dealii::QGauss<1>> rules;
    const std::lock_guard<std::mutex> lock(mutex);
    return rules.try_emplace(n, n).first->second;
  }
} // namespace plumbline::physics
