#include "meshfree/moments.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /// A condition of norm 1 whose part orthogonal to others is shorter depends on them.
    constexpr double rank_tolerance = 1e-7;

    /// Least |y| with columnsᵀ y = values, up to what is inconsistent: modified Gram-Schmidt with
    /// pivoting.
    /// @param columns  shape (n_neighbours, n_conditions), of norm 1
    VectorXd least_norm(MatrixXd columns, VectorXd values, unsigned int &rank,
                        double &smallest_pivot)
    {
      const Index n = columns.cols();
      VectorXd y = VectorXd::Zero(columns.rows());
      VectorXd squares = columns.colwise().squaredNorm(); // kept up to rounding
      for (rank = 0; rank < n; ++rank)
      {
        Index pivot;
        squares.tail(n - rank).maxCoeff(&pivot);
        pivot += rank;
        columns.col(rank).swap(columns.col(pivot));
        std::swap(values[rank], values[pivot]);
        std::swap(squares[rank], squares[pivot]);
        auto direction = columns.col(rank);
        const double norm = direction.norm();
        if (norm < rank_tolerance)
          break;
        smallest_pivot = std::min(smallest_pivot, norm);
        direction /= norm;
        values[rank] /= norm;
        y += values[rank] * direction;
        for (Index i = rank + 1; i < n; ++i)
        {
          const double share = columns.col(i).dot(direction);
          columns.col(i) -= share * direction;
          values[i] -= share * values[rank];
          squares[i] -= share * share;
        }
      }
      return y;
    }
  } // namespace

  std::vector<Exponents> exponents(int lowest, int highest)
  {
    std::vector<Exponents> result;
    for (int order = lowest; order <= highest; ++order)
      for (int a = order; a >= 0; --a)
        result.push_back({a, order - a});
    return result;
  }

  std::vector<Exponents> even_exponents(int lowest, int highest)
  {
    std::vector<Exponents> result;
    for (const Exponents &e : exponents(lowest, highest))
      if (e[0] % 2 == 0 && e[1] % 2 == 0)
        result.push_back(e);
    return result;
  }

  void meet(const MomentConditions &conditions, Family &family)
  {
    const auto n = static_cast<Index>(family.bonds.size());
    const auto n_conditions = static_cast<Index>(conditions.exponents.size());
    const int highest = conditions.exponents.back()[0] + conditions.exponents.back()[1];
    // in y = w / √ω the conditions have the columns g s^α √ω, scaled to norm 1
    VectorXd root(n), before(n);
    std::array<MatrixXd, 2> powers{MatrixXd(n, highest + 1), MatrixXd(n, highest + 1)};
    for (Index j = 0; j < n; ++j)
    {
      const Bond &bond = family.bonds[j];
      root[j] = std::sqrt(conditions.scale(bond));
      before[j] = bond.weight / root[j];
      powers[0](j, 0) = conditions.factor(bond) * root[j];
      powers[1](j, 0) = 1;
      for (unsigned int d = 0; d < 2; ++d)
        for (int p = 0; p < highest; ++p)
          powers[d](j, p + 1) = powers[d](j, p) * bond.xi[d] / conditions.horizon;
    }
    MatrixXd columns(n, n_conditions);
    VectorXd moments(n_conditions);
    for (Index i = 0; i < n_conditions; ++i)
    {
      const Exponents &alpha = conditions.exponents[i];
      columns.col(i) = powers[0].col(alpha[0]).cwiseProduct(powers[1].col(alpha[1]));
      const double norm = columns.col(i).norm(), scale = norm > 0 ? 1 / norm : 1;
      columns.col(i) *= scale;
      moments[i] = conditions.moments[i] * scale;
    }
    family.fit = {conditions.degree, static_cast<unsigned int>(n_conditions), 0, 0, 1};
    const VectorXd after = before + least_norm(columns, moments - columns.transpose() * before,
                                               family.fit.rank, family.fit.smallest_pivot);
    family.fit.residual = (columns.transpose() * after - moments).cwiseAbs().maxCoeff() /
                          moments.cwiseAbs().maxCoeff();
    for (Index j = 0; j < n; ++j)
      family.bonds[j].weight = after[j] * root[j];
  }
} // namespace plumbline::meshfree
