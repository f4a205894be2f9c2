#include "random/line_rule.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace plumbline::random
{
  namespace
  {
    /// What symmetry leaves of rounding.
    void symmetrise(LineRule &rule)
    {
      const std::size_t n = rule.nodes.size();
      for (std::size_t i = 0; i < n; ++i)
      {
        const std::size_t j = n - 1 - i;
        if (i > j)
          break;
        const double x = i == j ? 0 : .5 * (rule.nodes[j] - rule.nodes[i]),
                     w = .5 * (rule.weights[i] + rule.weights[j]);
        rule.nodes[i] = -x;
        rule.nodes[j] = x;
        rule.weights[i] = rule.weights[j] = w;
      }
      if (n % 2 == 1)
        rule.nodes[n / 2] = 0; // not -0
    }
  } // namespace

  LineRule gauss_rule(Law law, unsigned int n)
  {
    // off the diagonal of the polynomials' recurrence
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n), beside(n > 0 ? n - 1 : 0);
    for (unsigned int k = 1; k < n; ++k)
      beside[k - 1] = law == Law::normal ? std::sqrt(k) : k / std::sqrt(4. * k * k - 1);
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> jacobi;
    jacobi.computeFromTridiagonal(diagonal, beside);
    LineRule rule;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double first = jacobi.eigenvectors()(0, i);
      rule.nodes.push_back(jacobi.eigenvalues()[i]);
      rule.weights.push_back(first * first);
    }
    symmetrise(rule);
    return rule;
  }

  LineRule clenshaw_curtis_rule(unsigned int n)
  {
    if (n == 1)
      return {{0}, {1}};
    const unsigned int m = n - 1;
    LineRule rule;
    for (unsigned int i = 0; i <= m; ++i)
    {
      double sum = 1; // of the means of T_0, T_2, ... times T_k at the node
      for (unsigned int k = 2; k <= m; k += 2)
        sum += (k == m ? 1. : 2.) * std::cos(M_PI * static_cast<double>(k * i) / m) /
               (1. - static_cast<double>(k) * k);
      rule.nodes.push_back(-std::cos(M_PI * i / m));
      rule.weights.push_back((i == 0 || i == m ? .5 : 1.) * sum / m);
    }
    symmetrise(rule);
    return rule;
  }
} // namespace plumbline::random
