#include "meshfree/check/node_moments.h"

#include "meshfree/check/bond_check.h"
#include "meshfree/check/bond_profile.h"
#include "meshfree/rules/moments.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::meshfree
{
  namespace
  {
    /// One moment: of the weights alone (degree 0), or of w C_ab ξ^α.
    struct Component
    {
      unsigned int degree;
      Exponents<2> alpha;
      unsigned int a, b;
      double size; ///< of ∫ |C| |ξ|^degree, or the ball
    };

    std::vector<Component> all_components(const Kernel<2> &kernel)
    {
      const double ball = M_PI * kernel.horizon() * kernel.horizon();
      std::vector<Component> result{{0, {0, 0}, 0, 0, ball}};
      for (const unsigned int degree : {1U, 2U})
        for (const Exponents<2> &alpha :
             exponents<2>(static_cast<int>(degree), static_cast<int>(degree)))
          for (unsigned int a = 0; a < kernel.n_components(); ++a)
            for (unsigned int b = a; b < kernel.n_components(); ++b)
              result.push_back(
                  {degree, alpha, a, b, kernel_size(kernel, static_cast<int>(degree))});
      return result;
    }

    /// What a weight of 1 adds to a moment.
    double share(const Kernel<2> &kernel, const Bond<2> &bond, const Component &c)
    {
      if (c.degree == 0)
        return 1 / c.size;
      return kernel_value(kernel, bond, c.a, c.b) * std::pow(bond.xi[0], c.alpha[0]) *
             std::pow(bond.xi[1], c.alpha[1]) / c.size;
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
    struct AllMoments
    {
      std::vector<Component> components;
      std::vector<Vector> values; ///< shape (n_components, n_nodes)
      std::vector<Spread> spreads;
      double floor; ///< rounding of the files

      explicit AllMoments(const GivenBonds &given)
          : components(all_components(given.kernel)),
            floor(std::max(given.precision.weight, given.precision.moments))
      {
        for (const Component &component : components)
        {
          Vector own(given.families.size());
          for (std::size_t i = 0; i < own.size(); ++i)
            for (const Bond<2> &bond : given.families[i].bonds)
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
    void explain(const GivenBonds &given, const AllMoments &moments, const Vector &residual,
                 const Pair *first, const Pair *last, Outlier &outlier)
    {
      constexpr double explained = .05, apart = 3;
      double best = std::numeric_limits<double>::infinity(), next = best, best_change = 0;
      const Pair *at = nullptr;
      for (const Pair *pair = first; pair != last; ++pair)
      {
        const Bond<2> bond =
            pair->bond != Outlier::none ? bond_of(given, *pair) : Bond<2>{pair->xi, 0, pair->xi, 0};
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
      outlier.defect = at->bond == Outlier::none ? Defect::missing : Defect::weight;
      outlier.neighbour = at->neighbour;
      outlier.bond = at->bond;
      outlier.found = at->bond == Outlier::none ? 0 : bond_of(given, *at).weight;
      outlier.expected = outlier.found - best_change;
    }
  } // namespace

  std::vector<Outlier> find_moment_outliers(const GivenBonds &given, const std::vector<Pair> &pairs)
  {
    const AllMoments moments(given);
    std::vector<Outlier> outliers;
    const Pair *first = pairs.data(), *const end = first + pairs.size(); // node by node
    for (std::size_t i = 0; i < given.families.size(); ++i)
    {
      const Pair *const last =
          std::find_if(first, end, [i](const Pair &pair) { return pair.node != i; });
      const Vector residual = moments.residual(i);
      const std::size_t worst = static_cast<std::size_t>(
          std::max_element(residual.begin(), residual.end(),
                           [](double a, double b) { return std::abs(a) < std::abs(b); }) -
          residual.begin());
      if (std::abs(residual[worst]) > 1)
      {
        Outlier one{Defect::moments, i};
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
} // namespace plumbline::meshfree
