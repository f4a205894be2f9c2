#include "meshfree/check/hypothesis.h"

#include "base/number_text.h"
#include "meshfree/check/bond_check.h"
#include "meshfree/check/bond_profile.h"

#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    template <int dim>
    using Vector = dealii::Tensor<1, dim>;

    /// Σ w C ξ of each node, with the kernel's radial factor, over ∫ |C| |ξ|.
    template <int dim>
    std::vector<Vector<dim>> first_moments(const std::vector<Family<dim>> &families,
                                           const Kernel<dim> &kernel)
    {
      const double size = kernel_size(kernel, 1);
      std::vector<Vector<dim>> result;
      for (const Family<dim> &family : families)
      {
        result.emplace_back();
        for (const Bond<dim> &bond : family.bonds)
          result.back() += bond.weight * radial_value(kernel, bond) / size * Vector<dim>(bond.xi);
      }
      return result;
    }

    /// The medians of the components.
    template <int dim>
    Vector<dim> middle(const std::vector<Vector<dim>> &vectors)
    {
      Vector<dim> result;
      for (unsigned int d = 0; d < dim; ++d)
      {
        std::vector<double> values;
        for (const Vector<dim> &one : vectors)
          values.push_back(one[d]);
        result[d] = spread_of(values).median;
      }
      return result;
    }

    template <int dim>
    std::string direction_text(const Vector<dim> &vector)
    {
      const auto text = [&](unsigned int d)
      { return base::to_text(std::round(100 * vector[d] / vector.norm()) / 100 + 0., 2); };
      return "(" + text(0) + ", " + text(1) + (dim == 3 ? ", " + text(dim - 1) : "") + ")";
    }

    template <int dim>
    double median_norm(const std::vector<Vector<dim>> &vectors)
    {
      std::vector<double> values;
      for (const Vector<dim> &one : vectors)
        values.push_back(one.norm());
      return spread_of(values).median;
    }

    /// Takes a share off the weights ahead and adds it behind, as linear in ξ, so that the first
    /// moments vanish on average.
    template <int dim>
    void level(const Kernel<dim> &kernel, std::vector<Family<dim>> &families)
    {
      dealii::Tensor<2, dim> second;
      for (const Family<dim> &family : families)
        for (const Bond<dim> &bond : family.bonds)
          second += bond.weight * radial_value(kernel, bond) / kernel_size(kernel, 1) *
                    outer_product(Vector<dim>(bond.xi), Vector<dim>(bond.xi));
      second /= static_cast<double>(families.size());
      if (!(std::abs(determinant(second)) > 0))
        return;
      const Vector<dim> slope = invert(second) * middle(first_moments(families, kernel));
      for (Family<dim> &family : families)
        for (Bond<dim> &bond : family.bonds)
          bond.weight *= 1 - slope * Vector<dim>(bond.xi);
    }
  } // namespace

  template <int dim>
  std::optional<Mend<dim>> drift(const Evidence<dim> &evidence)
  {
    constexpr double alike = .7, much_less = .5;
    const GivenBonds<dim> &given = evidence.given;
    const auto moments = first_moments(given.families, given.kernel);
    const Vector<dim> mean = middle(moments);
    if (mean.norm() < 10 * given.precision.moments || mean.norm() < alike * median_norm(moments))
      return {};
    std::vector<Family<dim>> levelled = given.families;
    level(given.kernel, levelled);
    if (median_norm(first_moments(levelled, given.kernel)) > much_less * mean.norm())
      return {};
    Mend<dim> mend{
        {"drift", "the weights have a drift: the first moments of most nodes are off alike, "
                  "by " +
                      base::to_percent(mean.norm()) + " in the direction " + direction_text(mean) +
                      ", since weights to that side are larger than those to the other; it "
                      "acts as a term b . grad u with b that grows like 1/horizon"},
        [&kernel = given.kernel](std::vector<Family<dim>> &families) { level(kernel, families); }};
    return mend;
  }

  template std::optional<Mend<2>> drift(const Evidence<2> &);
  template std::optional<Mend<3>> drift(const Evidence<3> &);
} // namespace plumbline::meshfree
