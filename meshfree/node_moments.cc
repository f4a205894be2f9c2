#include "meshfree/node_moments.h"

#include "meshfree/bond_check.h"
#include "meshfree/bond_profile.h"
#include "meshfree/moments.h"

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
      Exponents alpha;
      unsigned int a, b;
      double size; ///< of ∫ |C| |ξ|^degree, or the ball
    };

    std::vector<Component> components(const Kernel<2> &kernel)
    {
      const double ball = M_PI * kernel.horizon() * kernel.horizon();
      std::vector<Component> result{{0, {0, 0}, 0, 0, ball}};
      for (const unsigned int degree : {1U, 2U})
        for (const Exponents &alpha : exponents(static_cast<int>(degree), static_cast<int>(degree)))
          for (unsigned int a = 0; a < kernel.n_components(); ++a)
            for (unsigned int b = a; b < kernel.n_components(); ++b)
              result.push_back(
                  {degree, alpha, a, b, kernel_size(kernel, static_cast<int>(degree))});
      return result;
    }

    /// What a weight of 1 adds to a moment.
    double share(const Kernel<2> &kernel, const Bond &bond, const Component &c)
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

    /// What is left of a residual when it is freed from its part along a direction.
    /// @param change  of the weight; overwritten
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
  } // namespace

  std::vector<Outlier> find_moment_outliers(const GivenBonds &given, const std::vector<Pair> &pairs)
  {
    constexpr double explained = .05, apart = 3;
    const auto all = components(given.kernel);
    const std::size_t n = given.families.size();
    std::vector<Vector> moments(all.size(), Vector(n));
    std::vector<Spread> spreads;
    for (std::size_t c = 0; c < all.size(); ++c)
    {
      for (std::size_t i = 0; i < n; ++i)
        for (const Bond &bond : given.families[i].bonds)
          moments[c][i] += bond.weight * share(given.kernel, bond, all[c]);
      spreads.push_back(spread_of(moments[c]));
    }
    std::vector<Outlier> outliers;
    std::size_t first = 0; // of the node's pairs, which stand node by node
    for (std::size_t i = 0; i < n; ++i)
    {
      std::size_t last = first;
      while (last < pairs.size() && pairs[last].node == i)
        ++last;
      Vector residual;
      std::size_t worst = 0;
      for (std::size_t c = 0; c < all.size(); ++c)
      {
        residual.push_back((moments[c][i] - spreads[c].median) /
                           spreads[c].allowed(file_tolerance));
        worst = std::abs(residual[c]) > std::abs(residual[worst]) ? c : worst;
      }
      if (std::abs(residual[worst]) > 1)
      {
        Outlier one{Defect::moments, i};
        one.distance = std::abs(residual[worst]);
        one.degree = all[worst].degree;
        one.found = moments[worst][i];
        one.expected = spreads[worst].median;
        double best = std::numeric_limits<double>::infinity(), next = best, best_change = 0;
        const Pair *at = nullptr;
        for (std::size_t k = first; k < last; ++k)
        {
          const Bond bond = pairs[k].bond != Outlier::none ? bond_of(given, pairs[k])
                                                           : Bond{pairs[k].xi, 0, pairs[k].xi, 0};
          Vector direction;
          for (std::size_t c = 0; c < all.size(); ++c)
            direction.push_back(share(given.kernel, bond, all[c]) /
                                spreads[c].allowed(file_tolerance));
          double change = 0;
          const double left = unexplained(residual, direction, change);
          next = std::min(next, std::max(left, best));
          if (left < best)
          {
            best = left;
            best_change = change;
            at = &pairs[k];
          }
        }
        if (at && best <= std::max(1., explained * norm(residual)) && next > apart * best)
        {
          one.defect = at->bond == Outlier::none ? Defect::missing : Defect::weight;
          one.neighbour = at->neighbour;
          one.bond = at->bond;
          one.found = at->bond == Outlier::none ? 0 : bond_of(given, *at).weight;
          one.expected = one.found - best_change;
        }
        outliers.push_back(one);
      }
      first = last;
    }
    return outliers;
  }
} // namespace plumbline::meshfree
