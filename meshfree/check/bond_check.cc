#include "meshfree/check/bond_check.h"

#include "base/error.h"
#include "meshfree/rules/moments.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::meshfree
{
  namespace
  {
    /// Σ w C_ab(kernel_point) ξ^α.
    double discrete_moment(const Family<2> &family, const Kernel<2> &kernel,
                           const Exponents<2> &alpha, unsigned int a, unsigned int b)
    {
      double sum = 0;
      for (const Bond<2> &bond : family.bonds)
        sum += bond.weight * kernel_value(kernel, bond, a, b) * std::pow(bond.xi[0], alpha[0]) *
               std::pow(bond.xi[1], alpha[1]);
      return sum;
    }

    double moment_defect(const Family<2> &family, const Kernel<2> &kernel, int degree)
    {
      double worst = 0;
      for (const Exponents<2> &alpha : exponents<2>(degree, degree))
        for (unsigned int a = 0; a < kernel.n_components(); ++a)
          for (unsigned int b = a; b < kernel.n_components(); ++b)
            worst = std::max(worst, std::abs(discrete_moment(family, kernel, alpha, a, b) -
                                             kernel.moment(alpha, a, b)));
      return worst;
    }

    /// Of Σ w tr C |ξ|² to its exact value.
    double second_moment_ratio(const Family<2> &family, const Kernel<2> &kernel)
    {
      double exact = 0, sum = 0;
      for (unsigned int a = 0; a < kernel.n_components(); ++a)
        for (const Exponents<2> &alpha : {Exponents<2>{2, 0}, Exponents<2>{0, 2}})
        {
          exact += kernel.moment(alpha, a, a);
          sum += discrete_moment(family, kernel, alpha, a, a);
        }
      return sum / exact;
    }

    Worst largest(const std::vector<double> &values)
    {
      const auto at = std::max_element(values.begin(), values.end());
      return {*at, static_cast<std::size_t>(at - values.begin())};
    }

    double median(std::vector<double> values)
    {
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      return *middle;
    }
  } // namespace

  double kernel_size(const Kernel<2> &kernel, int degree)
  {
    static const dealii::QIterated<1> rule(dealii::QGauss<1>(8), 32);
    double sum = 0;
    for (unsigned int q = 0; q < rule.size(); ++q)
    {
      const double r = kernel.horizon() * rule.point(q)[0];
      sum += rule.weight(q) * std::abs(kernel.radial(r)) * std::pow(r, degree + 1);
    }
    return 2 * M_PI * kernel.horizon() * sum;
  }

  double MomentCheck::typical() const
  {
    std::vector<double> larger = second_defects;
    for (std::size_t i = 0; i < larger.size(); ++i)
      larger[i] = std::max(larger[i], defects[0].values[i]);
    return median(larger);
  }

  MomentCheck check_moments(const std::vector<Family<2>> &families, const Kernel<2> &kernel)
  {
    constexpr int highest = 4;
    const double second_moment = kernel.moment({2, 0}), second_size = kernel_size(kernel, 2);
    if (!(std::abs(second_moment) > 1e-12 * second_size))
      throw InputError("the kernel's second moment is 0, so it has no local limit that weights "
                       "could be checked for; choose another kernel (Kernel)");
    MomentCheck check;
    std::vector<double> values(families.size()), &second = check.second_defects;
    for (int degree = 1; degree <= highest; ++degree)
    {
      const double size = degree == 2 ? std::abs(second_moment) : kernel_size(kernel, degree);
      for (std::size_t i = 0; i < families.size(); ++i)
        values[i] = moment_defect(families[i], kernel, degree) / size;
      check.defects.push_back({degree, largest(values), median(values), values});
      if (check.exact_degree == degree - 1 &&
          check.defects.back().worst.value < MomentCheck::tolerance)
        check.exact_degree = degree;
      if (degree == 2)
        second = values;
    }

    double sum = 0;
    for (std::size_t i = 0; i < families.size(); ++i)
    {
      const double ratio = second_moment_ratio(families[i], kernel);
      sum += ratio;
      check.ratios.push_back(ratio);
      second[i] = std::max(second[i], std::abs(ratio - 1));
    }
    check.mean_ratio = sum / static_cast<double>(families.size());
    check.second = largest(second);
    return check;
  }

  WeightCheck check_weights(const std::vector<Family<2>> &families, const Kernel<2> &kernel,
                            const std::vector<double> &volumes)
  {
    const double ball = M_PI * kernel.horizon() * kernel.horizon();
    WeightCheck check;
    check.smallest_ratio = std::numeric_limits<double>::infinity();
    check.largest_ratio = -check.smallest_ratio;
    std::vector<double> defects;
    for (std::size_t i = 0; i < families.size(); ++i)
    {
      const std::vector<Bond<2>> &bonds = families[i].bonds;
      double sum = volumes[i];
      for (const Bond<2> &bond : bonds)
      {
        sum += bond.weight;
        check.n_negative += bond.weight < 0 ? 1 : 0;
        check.smallest_ratio = std::min(check.smallest_ratio, bond.weight / bond.area);
        check.largest_ratio = std::max(check.largest_ratio, bond.weight / bond.area);
      }
      check.n_bonds += bonds.size();
      check.largest_family =
          std::max(check.largest_family, static_cast<unsigned int>(bonds.size()));
      defects.push_back(std::abs(sum - ball) / ball);
    }
    check.area = largest(defects);
    return check;
  }

  SymmetryCheck check_symmetry(const std::vector<Family<2>> &families, const Kernel<2> &kernel,
                               const std::vector<double> &volumes)
  {
    SymmetryCheck check;
    double scale = 0, scale_of_forces = 0;
    for (std::size_t i = 0; i < families.size(); ++i)
      for (std::size_t k = 0; k < families[i].bonds.size(); ++k)
      {
        const Bond<2> &bond = families[i].bonds[k];
        const double size = std::abs(bond.weight * radial_value(kernel, bond));
        scale = std::max(scale, size);
        scale_of_forces = std::max(scale_of_forces, volumes[i] * size);
        const std::size_t j = families[i].neighbours[k];
        if (j >= families.size())
          continue;
        const auto &others = families[j].neighbours;
        const auto partner = std::lower_bound(others.begin(), others.end(), i);
        const Bond<2> *back = nullptr;
        if (partner != others.end() && *partner == i)
          back = &families[j].bonds[partner - others.begin()];
        else
          ++check.n_unpaired;
        for (unsigned int a = 0; a < kernel.n_components(); ++a)
          for (unsigned int b = a; b < kernel.n_components(); ++b)
          {
            const double there = bond.weight * kernel_value(kernel, bond, a, b),
                         other = back ? back->weight * kernel_value(kernel, *back, a, b) : 0,
                         difference = std::abs(there - other);
            check.imbalance =
                std::max(check.imbalance, std::abs(volumes[i] * there - volumes[j] * other));
            if (difference > check.asymmetry)
            {
              check.asymmetry = difference;
              check.nodes = {i, j};
            }
          }
      }
    check.asymmetry /= scale > 0 ? scale : 1;
    check.imbalance /= scale_of_forces > 0 ? scale_of_forces : 1;
    return check;
  }
} // namespace plumbline::meshfree
