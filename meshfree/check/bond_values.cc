#include "meshfree/check/bond_values.h"

#include "base/error.h"
#include "base/number_text.h"

#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    template <int dim>
    void divide(Bond<dim> &bond, const Kernel<dim> &kernel, double volume, const std::string &place)
    {
      if (bond.weight == 0)
        return;
      const double factor = volume * radial_value(kernel, bond);
      if (factor == 0 || !std::isfinite(factor))
        throw InputError("the kernel is " + base::to_text(factor, 4) + " at a bond (" + place +
                         ") of length " + base::to_text(bond.kernel_point.norm(), 6) +
                         ", horizon " + base::to_text(kernel.horizon(), 6) +
                         ": its stiffness gives no weight; leave the bond out, or give weights");
      bond.weight /= factor;
    }

    double factor_of(BondValues values, double volume)
    {
      return values == BondValues::force_constants ? volume : 1;
    }
  } // namespace

  BondValues to_bond_values(const std::string &word, const std::string &key)
  {
    if (const auto values = base::from_word<BondValues>(word))
      return *values;
    std::string all;
    for (const char *const one : base::words<BondValues>)
      all += (all.empty() ? "'" : ", '") + std::string(one) + "'";
    throw InputError(key + " = '" + word + "' is not known; choose one of " + all);
  }

  template <int dim>
  void to_weights(BondValues values, const Kernel<dim> &kernel, GivenWeights<dim> &given)
  {
    if (values == BondValues::weights)
      return;
    const auto place = [&](std::size_t line)
    { return given.given.unit + " " + std::to_string(line); };
    for (std::size_t i = 0; i < given.given.families.size(); ++i)
      for (std::size_t k = 0; k < given.given.families[i].bonds.size(); ++k)
        divide(given.given.families[i].bonds[k], kernel, factor_of(values, given.volumes[i]),
               place(given.given.lines[i][k]));
    for (CollarBond<dim> &one : given.given.of_collar)
      divide(one.bond, kernel, factor_of(values, given.volumes[one.node]), place(one.line));
  }

  template void to_weights(BondValues, const Kernel<2> &, GivenWeights<2> &);
  template void to_weights(BondValues, const Kernel<3> &, GivenWeights<3> &);
} // namespace plumbline::meshfree
