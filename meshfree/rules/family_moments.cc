#include "meshfree/rules/family_moments.h"

#include "meshfree/rules/moments.h"
#include "method/diagnostics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::meshfree
{
  namespace
  {
    /// Of one order, the last axis' exponents falling.
    template <int dim>
    std::vector<Exponents<dim>> of_order(int order)
    {
      auto all = exponents<dim>(order, order);
      std::reverse(all.begin(), all.end());
      return all;
    }

    template <int dim>
    double largest_second_moment(const Kernel<dim> &kernel)
    {
      double largest = 0;
      for (unsigned int a = 0; a < kernel.n_components(); ++a)
        for (unsigned int b = a; b < kernel.n_components(); ++b)
          for (const Exponents<dim> &alpha : of_order<dim>(2))
            largest = std::max(largest, std::abs(kernel.moment(alpha, a, b)));
      return largest;
    }
  } // namespace

  template <int dim>
  BallMoments<dim>::BallMoments(const Kernel<dim> &kernel, unsigned int order)
      : kernel_(kernel), order_(order), scale_(largest_second_moment(kernel))
  {
    for (int n = 1; n <= static_cast<int>(order); ++n)
      for (const Exponents<dim> &alpha : of_order<dim>(n))
        exponents_.push_back(alpha);
    for (unsigned int a = 0; a < kernel.n_components(); ++a)
      for (unsigned int b = a; b < kernel.n_components(); ++b)
        for (const Exponents<dim> &alpha : exponents_)
        {
          const int n = std::accumulate(alpha.begin(), alpha.end(), 0);
          exact_.push_back(kernel.moment(alpha, a, b) /
                           (scale_ * std::pow(kernel.horizon(), n - 2)));
        }
  }

  template <int dim>
  std::vector<double> BallMoments<dim>::defects(const std::vector<Bond<dim>> &family) const
  {
    constexpr unsigned int most = 6;
    const double horizon = kernel_.horizon();
    std::vector<double> defects(exact_.size());
    std::array<std::array<double, most + 1>, dim> power{};
    for (const Bond<dim> &bond : family)
    {
      for (unsigned int d = 0; d < dim; ++d)
      {
        power[d][0] = 1;
        for (unsigned int n = 1; n <= order_; ++n)
          power[d][n] = power[d][n - 1] * bond.xi[d] / horizon;
      }
      std::size_t place = 0;
      for (unsigned int a = 0; a < kernel_.n_components(); ++a)
        for (unsigned int b = a; b < kernel_.n_components(); ++b)
        {
          const double C =
              bond.weight * kernel_value(kernel_, bond, a, b) * horizon * horizon / scale_;
          for (const Exponents<dim> &alpha : exponents_)
          {
            double product = C;
            for (unsigned int d = 0; d < dim; ++d)
              product *= power[d][alpha[d]];
            defects[place++] += product;
          }
        }
    }
    for (std::size_t i = 0; i < defects.size(); ++i)
      defects[i] -= exact_[i];
    return defects;
  }

  template <int dim>
  double BallMoments<dim>::worst_defect(const std::vector<Bond<dim>> &family) const
  {
    double worst = 0;
    for (const double defect : defects(family))
      worst = std::max(worst, std::abs(defect));
    return worst;
  }

  template <int dim>
  double BallMoments<dim>::area_defect(const std::vector<Bond<dim>> &family) const
  {
    double difference = 0, whole = 0;
    for (const Bond<dim> &bond : family)
    {
      const double size = std::abs(radial_value(kernel_, bond)) * bond.xi.norm_square();
      difference += std::abs(bond.weight - bond.area) * size;
      whole += bond.area * size;
    }
    return difference / whole;
  }

  template class BallMoments<1>;
  template class BallMoments<2>;
  template class BallMoments<3>;

  template <int dim>
  double MomentBias<dim>::Part::spread(std::size_t i) const
  {
    return std::sqrt(std::max(0., squares[i] / n - mean(i) * mean(i)));
  }

  template <int dim>
  void MomentBias<dim>::Part::operator+=(const Part &other)
  {
    n += other.n;
    for (std::size_t i = 0; i < most_defects; ++i)
    {
      sum[i] += other.sum[i];
      squares[i] += other.squares[i];
    }
  }

  template <int dim>
  void MomentBias<dim>::add(const Point<dim> &node, const std::vector<double> &defects,
                            std::size_t n_bonds)
  {
    std::size_t place = 0;
    for (unsigned int axis = dim; axis-- > 0;)
    {
      const double width = upper_[axis] - lower_[axis];
      const double way = width > 0 ? (node[axis] - lower_[axis]) / width : 0;
      const double part = std::clamp(std::floor(way * n_side), 0., n_side - 1.);
      place = place * n_side + static_cast<std::size_t>(part);
    }
    Part &part = parts_[place];
    part.n += 1;
    for (std::size_t i = 0; i < defects.size(); ++i)
    {
      part.sum[i] += defects[i];
      part.squares[i] += defects[i] * defects[i];
    }
    n_bonds_ = std::max(n_bonds_, static_cast<double>(n_bonds));
  }

  template <int dim>
  typename MomentBias<dim>::Answer
  MomentBias<dim>::answer(const base::Communicator &communicator) const
  {
    constexpr double n_errors = 4; // standard errors of a mean, to be no chance among hundreds
    // those of a ball of twice the radius
    const double n_in_common = (dim == 2 ? 4 : 8) * communicator.largest(n_bonds_);
    Answer answer;
    Part whole;
    const auto is_bias = [](double mean, double spread, double n)
    { return std::abs(mean) > n_errors * spread / std::sqrt(n) + method::LimitProof::tolerance; };
    for (Part part : parts_)
    {
      part.n = communicator.sum(part.n);
      for (std::size_t i = 0; i < most_defects; ++i)
      {
        part.sum[i] = communicator.sum(part.sum[i]);
        part.squares[i] = communicator.sum(part.squares[i]);
        if (part.n >= n_in_common && part.n > 0 &&
            is_bias(part.mean(i), part.spread(i), part.n / n_in_common) &&
            std::abs(part.mean(i)) > std::abs(answer.mean_of_part))
          answer.mean_of_part = part.mean(i);
      }
      whole += part;
    }
    answer.is_biased = answer.mean_of_part != 0;
    for (std::size_t i = 0; i < most_defects && whole.n > 0; ++i)
    {
      answer.is_biased = answer.is_biased || is_bias(whole.mean(i), whole.spread(i), whole.n);
      if (std::abs(whole.mean(i)) > std::abs(answer.mean))
      {
        answer.mean = whole.mean(i);
        answer.spread = whole.spread(i);
      }
    }
    return answer;
  }

  template class MomentBias<2>;
  template class MomentBias<3>;
} // namespace plumbline::meshfree
