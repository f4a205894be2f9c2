#include "meshfree/check/node_moments.h"

#include "meshfree/check/bond_check.h"
#include "meshfree/check/bond_profile.h"
#include "meshfree/check/sizes.h"
#include "meshfree/rules/moments.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::meshfree
{
  namespace
  {
    /// One moment: of the weights alone (degree 0), or of w C_ab ξ^α.
    template <int dim>
    struct Component
    {
      unsigned int degree;
      Exponents<dim> alpha;
      unsigned int a, b;
      double size; ///< of ∫ |C| |ξ|^degree, or the ball
    };

    template <int dim>
    std::vector<Component<dim>> all_components(const Kernel<dim> &kernel)
    {
      const double ball = ball_volume<dim>(kernel.horizon());
      std::vector<Component<dim>> result{{0, {}, 0, 0, ball}};
      for (const unsigned int degree : {1U, 2U})
        for (const Exponents<dim> &alpha :
             exponents<dim>(static_cast<int>(degree), static_cast<int>(degree)))
          for (unsigned int a = 0; a < kernel.n_components(); ++a)
            for (unsigned int b = a; b < kernel.n_components(); ++b)
              result.push_back(
                  {degree, alpha, a, b, kernel_size(kernel, static_cast<int>(degree))});
      return result;
    }

    /// What a weight of 1 adds to a moment.
    template <int dim>
    double share(const Kernel<dim> &kernel, const Bond<dim> &bond, const Component<dim> &c)
    {
      if (c.degree == 0)
        return 1 / c.size;
      double value = kernel_value(kernel, bond, c.a, c.b) / c.size;
      for (unsigned int d = 0; d < dim; ++d)
        value *= std::pow(bond.xi[d], c.alpha[d]);
      return value;
    }

    using Vector = std::vector<double>;

    double norm(const Vector &v)
    {
      double sum = 0;
      for (const double x : v)
        sum += x * x;
      return std::sqrt(sum);
    }

    /// What is left of a residual without its part along a direction.
    /// @param change  times the direction: that part; overwritten
    double unexplained(const Vector &residual, const Vector &direction, double &change)
    {
      double dot = 0, square = 0;
      for (std::size_t c = 0; c < residual.size(); ++c)
      {
        dot += residual[c] * direction[c];
        square += direction[c] * direction[c];
      }
      change = square > 0 ? dot / square : 0;
      Vector left = residual;
      for (std::size_t c = 0; c < residual.size(); ++c)
        left[c] -= change * direction[c];
      return norm(left);
    }

    /// The moments of all nodes.
    template <int dim>
    struct AllMoments
    {
      std::vector<Component<dim>> components;
      std::vector<Vector> values; ///< shape (n_components, n_nodes)
      std::vector<Spread> spreads;
      double floor; ///< rounding of the files

      explicit AllMoments(const GivenBonds<dim> &given)
          : components(all_components(given.kernel)),
            floor(std::max(given.precision.weight, given.precision.moments))
      {
        for (const Component<dim> &component : components)
        {
          Vector own(given.families.size());
          for (std::size_t i = 0; i < own.size(); ++i)
            for (const Bond<dim> &bond : given.families[i].bonds)
              if (component.degree > 0 || !is_at_horizon(given, bond.xi))
                own[i] += bond.weight * share(given.kernel, bond, component);
          spreads.push_back(spread_of(own));
          values.push_back(std::move(own));
        }
      }

      double allowed(std::size_t c) const { return spreads[c].allowed(floor); }

      /// How far those of a node are from the medians, in what is allowed.
      Vector residual(std::size_t node) const
      {
        Vector result;
        for (std::size_t c = 0; c < components.size(); ++c)
          result.push_back((values[c][node] - spreads[c].median) / allowed(c));
        return result;
      }
    };

    /// Make it about the pair whose weight alone explains the residual, if there is one such.
    template <int dim>
    void explain(const GivenBonds<dim> &given, const AllMoments<dim> &moments,
                 const Vector &residual, const Pair<dim> *first, const Pair<dim> *last,
                 Outlier<dim> &outlier)
    {
      constexpr double explained = .05, apart = 3;
      double best = std::numeric_limits<double>::infinity(), next = best, best_change = 0;
      const Pair<dim> *at = nullptr;
      for (const Pair<dim> *pair = first; pair != last; ++pair)
      {
        const Bond<dim> bond = pair->bond != Outlier<dim>::none
                                   ? bond_of(given, *pair)
                                   : Bond<dim>{pair->xi, 0, pair->xi, 0};
        Vector direction;
        for (std::size_t c = 0; c < residual.size(); ++c)
          direction.push_back(share(given.kernel, bond, moments.components[c]) /
                              moments.allowed(c));
        double change = 0;
        const double left = unexplained(residual, direction, change);
        next = std::min(next, std::max(left, best));
        if (left < best)
        {
          best = left;
          best_change = change;
          at = pair;
        }
      }
      if (!at || best > std::max(1., explained * norm(residual)) || next <= apart * best)
        return;
      outlier.defect = at->bond == Outlier<dim>::none ? Defect::missing : Defect::weight;
      outlier.neighbour = at->neighbour;
      outlier.bond = at->bond;
      outlier.found = at->bond == Outlier<dim>::none ? 0 : bond_of(given, *at).weight;
      outlier.expected = outlier.found - best_change;
    }
  } // namespace

  template <int dim>
  std::vector<Outlier<dim>> find_moment_outliers(const GivenBonds<dim> &given,
                                                 const std::vector<Pair<dim>> &pairs)
  {
    const AllMoments<dim> moments(given);
    std::vector<Outlier<dim>> outliers;
    const Pair<dim> *first = pairs.data(), *const end = first + pairs.size(); // node by node
    for (std::size_t i = 0; i < given.families.size(); ++i)
    {
      const Pair<dim> *const last =
          std::find_if(first, end, [i](const Pair<dim> &pair) { return pair.node != i; });
      const Vector residual = moments.residual(i);
      const std::size_t worst = static_cast<std::size_t>(
          std::max_element(residual.begin(), residual.end(),
                           [](double a, double b) { return std::abs(a) < std::abs(b); }) -
          residual.begin());
      if (std::abs(residual[worst]) > 1)
      {
        Outlier<dim> one{Defect::moments, i};
        one.distance = std::abs(residual[worst]);
        one.degree = moments.components[worst].degree;
        one.found = moments.values[worst][i];
        one.expected = moments.spreads[worst].median;
        explain(given, moments, residual, first, last, one);
        outliers.push_back(one);
      }
      first = last;
    }
    return outliers;
  }

  template std::vector<Outlier<2>> find_moment_outliers(const GivenBonds<2> &,
                                                        const std::vector<Pair<2>> &);
  template std::vector<Outlier<3>> find_moment_outliers(const GivenBonds<3> &,
                                                        const std::vector<Pair<3>> &);
} // namespace plumbline::meshfree
