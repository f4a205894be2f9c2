#include "uq/line_rule.h"

#include "base/symmetric_eigen.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace plumbline::uq
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
    // Genz and Keister's points come from a system whose condition is 1e9
    using Real = long double;
    using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
    using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

    /// Off the diagonal of the recurrence of orthonormal Hermite polynomials, below degree n.
    RealVector hermite_recurrence(Eigen::Index n)
    {
      RealVector beside(n - 1);
      for (Eigen::Index k = 1; k < n; ++k)
        beside[k - 1] = std::sqrt(static_cast<Real>(k));
      return beside;
    }

    /// Of degrees 0 ... degree.
    RealVector hermite(Real x, Eigen::Index degree)
    {
      RealVector h(degree + 1);
      h[0] = 1;
      for (Eigen::Index k = 0; k < degree; ++k)
        h[k + 1] = (x * h[k] - (k > 0 ? std::sqrt(static_cast<Real>(k)) * h[k - 1] : 0)) /
                   std::sqrt(static_cast<Real>(k + 1));
      return h;
    }

    /// The even polynomial h_m + Σ c_j h_j that has with the odd one of the nodes no mean against
    /// any polynomial of degree < m. @return c, shape (m)
    RealVector extension(Eigen::Index m, const std::vector<Real> &nodes)
    {
      const auto n_gauss = static_cast<Eigen::Index>(nodes.size()) + m; // exact where it must be
      const Real scale = 2 * std::sqrt(static_cast<Real>(n_gauss));     // above all nodes
      Eigen::SelfAdjointEigenSolver<RealMatrix> jacobi; // see base/symmetric_eigen.cc
      jacobi.computeFromTridiagonal(RealVector::Zero(n_gauss), hermite_recurrence(n_gauss) / scale);
      RealMatrix A = RealMatrix::Zero(m / 2, m / 2); // odd degrees against even ones
      RealVector b = RealVector::Zero(m / 2);
      for (Eigen::Index g = 0; g < n_gauss; ++g)
      {
        const Real x = scale * jacobi.eigenvalues()[g], first = jacobi.eigenvectors()(0, g);
        Real P = first * first; // with the weight
        for (std::size_t i = 0; i < nodes.size(); ++i)
          P *= (x - nodes[i]) / std::sqrt(static_cast<Real>(i + 1));
        const RealVector h = hermite(x, m);
        for (Eigen::Index k = 0; k < m / 2; ++k)
        {
          b[k] -= P * h[m] * h[2 * k + 1];
          for (Eigen::Index j = 0; j < m / 2; ++j)
            A(k, j) += P * h[2 * j] * h[2 * k + 1];
        }
      }
      const RealVector even = A.fullPivLu().solve(b);
      RealVector c = RealVector::Zero(m);
      for (Eigen::Index j = 0; j < m / 2; ++j)
        c[2 * j] = even[j];
      return c;
    }

    void add_points(Eigen::Index n_new, std::vector<Real> &nodes)
    {
      const RealVector c = extension(n_new, nodes), beside = hermite_recurrence(n_new);
      RealMatrix colleague = RealMatrix::Zero(n_new, n_new);
      for (Eigen::Index k = 1; k < n_new; ++k)
        colleague(k, k - 1) = colleague(k - 1, k) = beside[k - 1];
      colleague.row(n_new - 1) -= std::sqrt(static_cast<Real>(n_new)) * c.transpose();
      const Eigen::EigenSolver<RealMatrix> roots(colleague, false);
      for (Eigen::Index i = 0; i < n_new; ++i)
        nodes.push_back(roots.eigenvalues()[i].real());
      std::sort(nodes.begin(), nodes.end());
      for (std::size_t i = 0, j = nodes.size() - 1; i < j; ++i, --j)
      {
        nodes[j] = .5L * (nodes[j] - nodes[i]);
        nodes[i] = -nodes[j];
      }
    }

    /// With which as many polynomials have their mean.
    RealVector interpolatory_weights(const std::vector<Real> &nodes)
    {
      const auto n = static_cast<Eigen::Index>(nodes.size());
      RealMatrix values(n, n);
      RealVector scale(n);
      for (Eigen::Index i = 0; i < n; ++i)
      {
        const Real x = nodes[static_cast<std::size_t>(i)];
        scale[i] = std::exp(-x * x / 4);
        values.col(i) = scale[i] * hermite(x, n - 1);
      }
      return values.fullPivLu().solve(RealVector::Unit(n, 0)).cwiseProduct(scale);
    }
  } // namespace

  LineRule gauss_rule(Law law, unsigned int n)
  {
    // off the diagonal of the polynomials' recurrence
    Eigen::VectorXd beside(n > 0 ? n - 1 : 0);
    for (unsigned int k = 1; k < n; ++k)
      beside[k - 1] = law == Law::normal ? std::sqrt(k) : k / std::sqrt(4. * k * k - 1);
    const auto jacobi = base::tridiagonal_eigen(Eigen::VectorXd::Zero(n), beside);
    LineRule rule;
    for (unsigned int i = 0; i < n; ++i)
    {
      rule.nodes.push_back(jacobi.values[i]);
      rule.weights.push_back(jacobi.vectors(0, i) * jacobi.vectors(0, i));
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

  LineRule fejer_rule(unsigned int n)
  {
    LineRule rule;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double angle = M_PI * (i + .5) / n;
      double sum = 1; // of the means of T_0, T_2, ... times 2 T_k at the node
      for (unsigned int k = 2; k < n; k += 2)
        sum += 2 * std::cos(k * angle) / (1. - static_cast<double>(k) * k);
      rule.nodes.push_back(-std::cos(angle));
      rule.weights.push_back(sum / n);
    }
    symmetrise(rule);
    return rule;
  }

  LineRule genz_keister_rule(unsigned int level)
  {
    std::vector<Real> nodes = {0};
    for (const int n_new : {2, 6, 10, 16})
      if (--level > 0)
        add_points(n_new, nodes);
      else
        break;
    LineRule rule;
    const RealVector weights = interpolatory_weights(nodes);
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      rule.nodes.push_back(static_cast<double>(nodes[i]));
      rule.weights.push_back(static_cast<double>(weights[static_cast<Eigen::Index>(i)]));
    }
    symmetrise(rule);
    return rule;
  }
} // namespace plumbline::uq
