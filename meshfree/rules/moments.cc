#include "meshfree/rules/moments.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::meshfree
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /// A condition of norm 1 whose part orthogonal to others is shorter depends on them.
    constexpr double rank_tolerance = 1e-7;

    /// Of a square upper triangular matrix whose diagonal falls, to 1 % of itself: inverse
    /// iteration with RᵀR, from the last unit vector and a little of all others.
    double smallest_singular_value(const MatrixXd &R)
    {
      constexpr double tolerance = 1e-5; // of the change in one iteration
      constexpr int most_iterations = 100;
      if ((R.diagonal().array() == 0).any())
        return 0;
      VectorXd x(R.cols()); // orthogonal to no singular vector, most likely
      for (Index i = 0; i < x.size(); ++i)
        x[i] = .02 + .01 * std::sin(1. + static_cast<double>(i * i));
      x[x.size() - 1] = 1;
      double inverse = 0;
      for (int iteration = 0; iteration < most_iterations; ++iteration)
      {
        x.normalize();
        R.transpose().triangularView<Eigen::Lower>().solveInPlace(x);
        const double before = inverse;
        inverse = x.norm();
        if (inverse - before <= tolerance * inverse)
          break;
        R.triangularView<Eigen::Upper>().solveInPlace(x);
      }
      return 1 / inverse;
    }

    /// Least |y| with columnsᵀ y = values, up to what is inconsistent: modified Gram-Schmidt with
    /// pivoting. Eigen's ColPivHouseholderQR gives the same to round-off in 1.2 to 1.5 times the
    /// time (28 or 80 neighbours, 5 to 27 conditions).
    /// @param columns  shape (n_neighbours, n_conditions), of norm 1
    VectorXd least_norm(MatrixXd columns, VectorXd values, unsigned int &rank,
                        double &smallest_singular)
    {
      const Index n = columns.cols();
      VectorXd y = VectorXd::Zero(columns.rows());
      VectorXd squares = columns.colwise().squaredNorm(); // kept up to rounding
      MatrixXd R = MatrixXd::Zero(n, n);
      rank = 0;
      for (Index k = 0; k < n; ++k)
      {
        Index pivot;
        squares.tail(n - k).maxCoeff(&pivot);
        pivot += k;
        if (pivot != k)
        {
          columns.col(k).swap(columns.col(pivot));
          R.col(k).swap(R.col(pivot));
          std::swap(values[k], values[pivot]);
          std::swap(squares[k], squares[pivot]);
        }
        auto direction = columns.col(k);
        const double norm = direction.norm();
        R(k, k) = norm;
        if (norm == 0)
          break;
        direction /= norm;
        values[k] /= norm;
        if (norm >= rank_tolerance) // pivots fall: those below tell of the singular value alone
        {
          y += values[k] * direction;
          ++rank;
        }
        for (Index i = k + 1; i < n; ++i)
        {
          const double share = columns.col(i).dot(direction);
          R(k, i) = share;
          columns.col(i) -= share * direction;
          values[i] -= share * values[k];
          squares[i] -= share * share;
        }
      }
      smallest_singular = smallest_singular_value(R);
      return y;
    }

    /// Those of an order in all axes from `axis` on, the first axes' exponents falling.
    template <int dim>
    void append_exponents(Exponents<dim> e, unsigned int axis, int order,
                          std::vector<Exponents<dim>> &result)
    {
      if (axis + 1 == dim)
      {
        e[axis] = order;
        result.push_back(e);
        return;
      }
      for (e[axis] = order; e[axis] >= 0; --e[axis])
        append_exponents<dim>(e, axis + 1, order - e[axis], result);
    }

    /// The axes of the first two factors of a monomial of degree 2 or more.
    template <std::size_t dim>
    std::array<unsigned int, 2> first_two(const std::array<int, dim> &beta)
    {
      std::array<unsigned int, 2> axes{};
      unsigned int n = 0;
      for (unsigned int d = 0; d < dim; ++d)
        for (int k = 0; k < beta[d] && n < 2; ++k)
          axes[n++] = d;
      return axes;
    }
  } // namespace

  template <int dim>
  std::vector<Exponents<dim>> exponents(int lowest, int highest)
  {
    std::vector<Exponents<dim>> result;
    for (int order = lowest; order <= highest; ++order)
      append_exponents<dim>({}, 0, order, result);
    return result;
  }

  template <int dim>
  std::vector<Exponents<dim>> even_exponents(int lowest, int highest)
  {
    std::vector<Exponents<dim>> result;
    for (const Exponents<dim> &e : exponents<dim>(lowest, highest))
      if (std::all_of(e.begin(), e.end(), [](int one) { return one % 2 == 0; }))
        result.push_back(e);
    return result;
  }

  template <int dim>
  MomentConditions<dim> kernel_conditions(const Kernel<dim> &kernel, unsigned int degree,
                                          std::vector<Exponents<dim>> (*select)(int lowest,
                                                                                int highest))
  {
    const bool is_tensor = kernel.n_components() > 1;
    const double horizon = kernel.horizon();
    const int raise = is_tensor ? 2 : 0;
    MomentConditions<dim> conditions{
        degree, horizon, select(1 + raise, static_cast<int>(degree) + raise), {}, {}, {}};
    for (const Exponents<dim> &beta : conditions.exponents)
    {
      Exponents<dim> alpha = beta;
      const auto [a, b] = first_two(beta);
      if (is_tensor)
      {
        --alpha[a];
        --alpha[b];
      }
      conditions.moments.push_back((is_tensor ? kernel.moment(alpha, a, b) : kernel.moment(alpha)) /
                                   std::pow(horizon, order(alpha)));
    }
    conditions.factor = [kernel, is_tensor](const Bond<dim> &bond)
    {
      const double scale = kernel.horizon() * kernel.horizon() / bond.xi.square();
      return radial_value(kernel, bond) * (is_tensor ? scale : 1);
    };
    conditions.scale = [](const Bond<dim> &bond) { return bond.area; };
    return conditions;
  }

  template <int dim>
  Bond<dim> coefficient_bond(const Kernel<dim> &kernel, const Candidate<dim> &candidate)
  {
    constexpr double rounding = 1e-9;
    Exponents<dim> second{};
    second[0] = 2;
    const double scale = kernel.moment(second) / std::pow(kernel.horizon(), dim + 2);
    Bond<dim> result = full_area_bond(kernel, candidate);
    if (result.weight != 0 && std::abs(radial_value(kernel, result)) <= rounding * scale)
      result.weight = 0;
    return result;
  }

  template <int dim>
  void meet(const MomentConditions<dim> &conditions, Family<dim> &family)
  {
    const auto n = static_cast<Index>(family.bonds.size());
    const auto n_conditions = static_cast<Index>(conditions.exponents.size());
    const int highest = order(conditions.exponents.back());
    // in y = w / √ω the conditions have the columns g s^α √ω, scaled to norm 1
    VectorXd root(n), before(n);
    std::array<MatrixXd, dim> powers;
    powers.fill(MatrixXd::Ones(n, highest + 1));
    for (Index j = 0; j < n; ++j)
    {
      const Bond<dim> &bond = family.bonds[j];
      root[j] = std::sqrt(conditions.scale(bond));
      before[j] = bond.weight / root[j];
      powers[0](j, 0) = conditions.factor(bond) * root[j];
      const Point<dim> along = bond.xi / conditions.horizon;
      for (unsigned int d = 0; d < dim; ++d)
        for (int p = 0; p < highest; ++p)
          powers[d](j, p + 1) = powers[d](j, p) * along[d];
    }
    MatrixXd columns(n, n_conditions);
    VectorXd moments(n_conditions);
    for (Index i = 0; i < n_conditions; ++i)
    {
      const Exponents<dim> &alpha = conditions.exponents[i];
      if constexpr (dim == 1)
        columns.col(i) = powers[0].col(alpha[0]);
      else
        columns.col(i) = powers[0].col(alpha[0]).cwiseProduct(powers[1].col(alpha[1]));
      for (unsigned int d = 2; d < dim; ++d)
        columns.col(i) = columns.col(i).cwiseProduct(powers[d].col(alpha[d]));
      for (Index j = 0; j < n && conditions.own_factor; ++j)
        columns(j, i) *= conditions.own_factor(family.bonds[j], i);
      const double norm = columns.col(i).norm(), scale = norm > 0 ? 1 / norm : 1;
      columns.col(i) *= scale;
      moments[i] = conditions.moments[i] * scale;
    }
    family.fit = {conditions.degree, static_cast<unsigned int>(n_conditions), 0, 0, 1};
    const VectorXd after = before + least_norm(columns, moments - columns.transpose() * before,
                                               family.fit.rank, family.fit.smallest_singular_value);
    family.fit.residual = (columns.transpose() * after - moments).cwiseAbs().maxCoeff() /
                          moments.cwiseAbs().maxCoeff();
    for (Index j = 0; j < n; ++j)
      family.bonds[j].weight = after[j] * root[j];
  }

#define PLUMBLINE_INSTANTIATE(dim)                                                                 \
  template std::vector<Exponents<dim>> exponents<dim>(int, int);                                   \
  template std::vector<Exponents<dim>> even_exponents<dim>(int, int);                              \
  template MomentConditions<dim> kernel_conditions<dim>(                                           \
      const Kernel<dim> &, unsigned int, std::vector<Exponents<dim>> (*)(int, int));               \
  template Bond<dim> coefficient_bond(const Kernel<dim> &, const Candidate<dim> &);                \
  template void meet(const MomentConditions<dim> &, Family<dim> &);
  PLUMBLINE_INSTANTIATE(1)
  PLUMBLINE_INSTANTIATE(2)
  PLUMBLINE_INSTANTIATE(3)
#undef PLUMBLINE_INSTANTIATE
} // namespace plumbline::meshfree
