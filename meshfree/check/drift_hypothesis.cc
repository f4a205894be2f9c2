#include "meshfree/check/hypothesis.h"

#include "base/number_text.h"
#include "meshfree/check/bond_check.h"
#include "meshfree/check/bond_profile.h"

#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    using Vector = dealii::Tensor<1, 2>;

    /// Σ w C ξ of each node, with the kernel's radial factor, over ∫ |C| |ξ|.
    std::vector<Vector> first_moments(const std::vector<Family<2>> &families,
                                      const Kernel<2> &kernel)
    {
      const double size = kernel_size(kernel, 1);
      std::vector<Vector> result;
      for (const Family<2> &family : families)
      {
        result.emplace_back();
        for (const Bond<2> &bond : family.bonds)
          result.back() += bond.weight * radial_value(kernel, bond) / size * Vector(bond.xi);
      }
      return result;
    }

    /// The medians of the components.
    Vector middle(const std::vector<Vector> &vectors)
    {
      Vector result;
      for (const unsigned int d : {0U, 1U})
      {
        std::vector<double> values;
        for (const Vector &one : vectors)
          values.push_back(one[d]);
        result[d] = spread_of(values).median;
      }
      return result;
    }

    std::string direction_text(const Vector &vector)
    {
      const auto text = [&](unsigned int d)
      { return base::to_text(std::round(100 * vector[d] / vector.norm()) / 100 + 0., 2); };
      return "(" + text(0) + ", " + text(1) + ")";
    }

    double median_norm(const std::vector<Vector> &vectors)
    {
      std::vector<double> values;
      for (const Vector &one : vectors)
        values.push_back(one.norm());
      return spread_of(values).median;
    }

    /// Takes a share off the weights ahead and adds it behind, as linear in ξ, so that the first
    /// moments vanish on average.
    void level(const Kernel<2> &kernel, std::vector<Family<2>> &families)
    {
      dealii::Tensor<2, 2> second;
      for (const Family<2> &family : families)
        for (const Bond<2> &bond : family.bonds)
          second += bond.weight * radial_value(kernel, bond) / kernel_size(kernel, 1) *
                    outer_product(Vector(bond.xi), Vector(bond.xi));
      second /= static_cast<double>(families.size());
      if (!(std::abs(determinant(second)) > 0))
        return;
      const Vector slope = invert(second) * middle(first_moments(families, kernel));
      for (Family<2> &family : families)
        for (Bond<2> &bond : family.bonds)
          bond.weight *= 1 - slope * Vector(bond.xi);
    }
  } // namespace

  std::optional<Mend> drift(const Evidence &evidence)
  {
    constexpr double alike = .7, much_less = .5;
    const GivenBonds &given = evidence.given;
    const auto moments = first_moments(given.families, given.kernel);
    const Vector mean = middle(moments);
    if (mean.norm() < 10 * given.precision.moments || mean.norm() < alike * median_norm(moments))
      return {};
    std::vector<Family<2>> levelled = given.families;
    level(given.kernel, levelled);
    if (median_norm(first_moments(levelled, given.kernel)) > much_less * mean.norm())
      return {};
    Mend mend{
        {"drift", "the weights have a drift: the first moments of most nodes are off alike, "
                  "by " +
                      base::to_percent(mean.norm()) + " in the direction " + direction_text(mean) +
                      ", since weights to that side are larger than those to the other; it "
                      "acts as a term b . grad u with b that grows like 1/horizon"},
        [&kernel = given.kernel](std::vector<Family<2>> &families) { level(kernel, families); }};
    return mend;
  }
} // namespace plumbline::meshfree
