#include "meshfree/check/bond_check.h"

#include "base/error.h"
#include "meshfree/check/sizes.h"
#include "meshfree/rules/moments.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::meshfree
{
  namespace
  {
    /// Σ w C_ab(kernel_point) ξ^α of a family, for all pairs a <= b and 1 <= |α| <= highest.
    template <int dim>
    class Moments
    {
    public:
      Moments(const Kernel<dim> &kernel, int highest)
          : kernel_(kernel), exponents_(exponents<dim>(1, highest))
      {
        for (unsigned int a = 0; a < kernel.n_components(); ++a)
          for (unsigned int b = a; b < kernel.n_components(); ++b)
          {
            entries_.push_back({a, b});
            for (const Exponents<dim> &alpha : exponents_)
              exact_.push_back(kernel.moment(alpha, a, b));
          }
        sums_.resize(exact_.size());
      }

      void take(const Family<dim> &family)
      {
        std::fill(sums_.begin(), sums_.end(), 0.);
        for (const Bond<dim> &bond : family.bonds)
          add(bond);
      }

      /// The largest difference from the exact moments of a degree.
      double defect(int degree) const
      {
        double worst = 0;
        for (std::size_t k = 0; k < sums_.size(); ++k)
          if (order(exponents_[k % exponents_.size()]) == degree)
            worst = std::max(worst, std::abs(sums_[k] - exact_[k]));
        return worst;
      }

      /// Of Σ w tr C |ξ|² to its exact value.
      double second_moment_ratio() const
      {
        double exact = 0, sum = 0;
        for (std::size_t k = 0; k < sums_.size(); ++k)
        {
          const auto &[a, b] = entries_[k / exponents_.size()];
          const Exponents<dim> &alpha = exponents_[k % exponents_.size()];
          if (a != b || order(alpha) != 2 || *std::max_element(alpha.begin(), alpha.end()) != 2)
            continue;
          exact += exact_[k];
          sum += sums_[k];
        }
        return sum / exact;
      }

    private:
      void add(const Bond<dim> &bond)
      {
        const double radial = bond.weight * radial_value(kernel_, bond);
        if (radial == 0)
          return;
        values_.clear();
        for (const Exponents<dim> &alpha : exponents_)
        {
          double value = radial;
          for (unsigned int d = 0; d < dim; ++d)
            for (int k = 0; k < alpha[d]; ++k)
              value *= bond.xi[d];
          values_.push_back(value);
        }
        std::size_t k = 0;
        for (const auto &[a, b] : entries_)
        {
          const double factor = kernel_.direction_factor(a, b, bond.kernel_point);
          for (const double value : values_)
            sums_[k++] += factor * value;
        }
      }

      const Kernel<dim> &kernel_;
      std::vector<Exponents<dim>> exponents_;
      std::vector<std::array<unsigned int, 2>> entries_; ///< a and b
      std::vector<double> exact_, sums_;                 ///< shape (n_entries, n_exponents)
      std::vector<double> values_;
    };

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

  template <int dim>
  double kernel_size(const Kernel<dim> &kernel, int degree)
  {
    static const dealii::QIterated<1> rule(dealii::QGauss<1>(8), 32);
    double sum = 0;
    for (unsigned int q = 0; q < rule.size(); ++q)
    {
      const double r = kernel.horizon() * rule.point(q)[0];
      sum += rule.weight(q) * std::abs(kernel.radial(r)) * std::pow(r, degree + dim - 1);
    }
    return (dim == 2 ? 2 : 4) * M_PI * kernel.horizon() * sum;
  }

  double MomentCheck::typical() const
  {
    std::vector<double> larger = second_defects;
    for (std::size_t i = 0; i < larger.size(); ++i)
      larger[i] = std::max(larger[i], defects[0].values[i]);
    return median(larger);
  }

  template <int dim>
  MomentCheck check_moments(const std::vector<Family<dim>> &families, const Kernel<dim> &kernel,
                            int highest)
  {
    Exponents<dim> along{};
    along[0] = 2;
    const double second_moment = kernel.moment(along), second_size = kernel_size(kernel, 2);
    if (!(std::abs(second_moment) > 1e-12 * second_size))
      throw InputError("the kernel's second moment is 0, so it has no local limit that weights "
                       "could be checked for; choose another kernel (Kernel)");
    MomentCheck check;
    std::vector<double> sizes;
    for (int degree = 1; degree <= highest; ++degree)
    {
      sizes.push_back(degree == 2 ? std::abs(second_moment) : kernel_size(kernel, degree));
      check.defects.push_back({degree, {}, 0, std::vector<double>(families.size())});
    }
    Moments<dim> moments(kernel, highest);
    double sum = 0;
    for (std::size_t i = 0; i < families.size(); ++i)
    {
      moments.take(families[i]);
      for (MomentDefect &defect : check.defects)
        defect.values[i] = moments.defect(defect.degree) / sizes[defect.degree - 1];
      check.ratios.push_back(moments.second_moment_ratio());
      sum += check.ratios.back();
    }
    for (MomentDefect &defect : check.defects)
    {
      defect.worst = largest(defect.values);
      defect.median = median(defect.values);
      if (check.exact_degree == defect.degree - 1 && defect.worst.value < MomentCheck::tolerance)
        check.exact_degree = defect.degree;
    }
    check.second_defects = check.defects[1].values;
    for (std::size_t i = 0; i < families.size(); ++i)
      check.second_defects[i] = std::max(check.second_defects[i], std::abs(check.ratios[i] - 1));
    check.mean_ratio = sum / static_cast<double>(families.size());
    check.second = largest(check.second_defects);
    return check;
  }

  template <int dim>
  WeightCheck check_weights(const std::vector<Family<dim>> &families, const Kernel<dim> &kernel,
                            const std::vector<double> &volumes)
  {
    const double ball = ball_volume<dim>(kernel.horizon());
    WeightCheck check;
    check.smallest_ratio = std::numeric_limits<double>::infinity();
    check.largest_ratio = -check.smallest_ratio;
    std::vector<double> defects;
    for (std::size_t i = 0; i < families.size(); ++i)
    {
      const std::vector<Bond<dim>> &bonds = families[i].bonds;
      double sum = volumes[i];
      for (const Bond<dim> &bond : bonds)
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

  template <int dim>
  SymmetryCheck check_symmetry(const std::vector<Family<dim>> &families, const Kernel<dim> &kernel,
                               const std::vector<double> &volumes)
  {
    SymmetryCheck check;
    double scale = 0, scale_of_forces = 0;
    for (std::size_t i = 0; i < families.size(); ++i)
      for (std::size_t k = 0; k < families[i].bonds.size(); ++k)
      {
        const Bond<dim> &bond = families[i].bonds[k];
        const double size = std::abs(bond.weight * radial_value(kernel, bond));
        scale = std::max(scale, size);
        scale_of_forces = std::max(scale_of_forces, volumes[i] * size);
        const std::size_t j = families[i].neighbours[k];
        if (j >= families.size())
          continue;
        const auto &others = families[j].neighbours;
        const auto partner = std::lower_bound(others.begin(), others.end(), i);
        const Bond<dim> *back = nullptr;
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

  template double kernel_size(const Kernel<2> &, int);
  template MomentCheck check_moments(const std::vector<Family<2>> &, const Kernel<2> &, int);
  template WeightCheck check_weights(const std::vector<Family<2>> &, const Kernel<2> &,
                                     const std::vector<double> &);
  template SymmetryCheck check_symmetry(const std::vector<Family<2>> &, const Kernel<2> &,
                                        const std::vector<double> &);
  template double kernel_size(const Kernel<3> &, int);
  template MomentCheck check_moments(const std::vector<Family<3>> &, const Kernel<3> &, int);
  template WeightCheck check_weights(const std::vector<Family<3>> &, const Kernel<3> &,
                                     const std::vector<double> &);
  template SymmetryCheck check_symmetry(const std::vector<Family<3>> &, const Kernel<3> &,
                                        const std::vector<double> &);
} // namespace plumbline::meshfree
