#include "meshfree/check/surface_correction.h"

#include "meshfree/check/bond_profile.h"

#include <cmath>
#include <limits>

namespace plumbline::meshfree
{
  namespace
  {
    double factor_of(Correction correction, double bulk, double at_node, double at_neighbour)
    {
      switch (correction)
      {
      case Correction::volume:
        return 2 * bulk / (at_node + at_neighbour);
      case Correction::whole_ball:
        return bulk / at_node;
      default:
        return 1;
      }
    }

    /// Sum over each family of the weights that bonds of the bulk would have times a function.
    std::vector<double> sums(const GivenWeights<2> &given, const BulkBonds &bulk,
                             const std::function<double(const Bond<2> &, double ratio)> &of)
    {
      std::vector<double> result(given.cells->size(), std::numeric_limits<double>::quiet_NaN());
      for (std::size_t i = 0; i < given.given.families.size(); ++i)
      {
        const Family<2> &family = given.given.families[i];
        result[i] = 0;
        for (std::size_t k = 0; k < family.bonds.size(); ++k)
          if (const BulkBonds::Kind *kind = bulk.find(family.bonds[k].xi))
            result[i] += given.volumes[family.neighbours[k]] * of(family.bonds[k], kind->ratio);
      }
      return result;
    }

    std::vector<FamilySize> sizes(const GivenWeights<2> &given, const BulkBonds &bulk,
                                  const std::vector<double> &visible, const Kernel<2> &kernel)
    {
      std::vector<double> whole = sums(given, bulk, [](const Bond<2> &, double) { return 1.; }),
                          partial = sums(given, bulk,
                                         [](const Bond<2> &, double ratio) { return ratio; });
      const auto with_own = [&](std::vector<double> values)
      {
        for (std::size_t i = 0; i < values.size(); ++i)
          values[i] += given.volumes[i];
        return values;
      };
      const auto second = [&](const Bond<2> &bond, double ratio)
      { return ratio * radial_value(kernel, bond) * bond.xi.square(); };
      return {{"the area of the visible part", visible},
              {"the sum of the neighbours' volumes", whole},
              {"the sum of the neighbours' volumes and the node's own", with_own(whole)},
              {"the sum of the neighbours' partial volumes", partial},
              {"the sum of the neighbours' partial volumes and the node's own", with_own(partial)},
              {"the second moment of the family", sums(given, bulk, second)}};
    }

    double median_in(const std::vector<double> &values, const std::vector<char> &is_bulk)
    {
      std::vector<double> of_bulk;
      for (std::size_t i = 0; i < is_bulk.size(); ++i)
        if (is_bulk[i] != 0)
          of_bulk.push_back(values[i]);
      return spread_of(of_bulk).median;
    }

    /// Sums of a method along both axes, relative to their medians in the bulk.
    FamilySize axis_sums(const SurfaceCorrection &method, const GivenWeights<2> &given,
                         const BulkBonds &bulk, const std::vector<char> &is_bulk,
                         const Kernel<2> &kernel)
    {
      FamilySize size;
      size.sums.resize(given.cells->size());
      size.places = given.cells->nodes;
      for (unsigned int axis = 0; axis < 2; ++axis)
      {
        const std::vector<double> values =
            sums(given, bulk,
                 [&](const Bond<2> &bond, double ratio)
                 {
                   const double stiffness = ratio * radial_value(kernel, bond);
                   return method.of_bond(bond.xi, ratio, stiffness)[axis];
                 });
        const double in_bulk = median_in(values, is_bulk);
        for (std::size_t i = 0; i < values.size(); ++i)
          size.sums[i][axis] = values[i] / in_bulk;
      }
      return size;
    }

    /// A bond that a correction changes, and its weight over the neighbour's volume.
    struct Changed
    {
      std::size_t node, neighbour;
      Point<2> xi;
      double ratio;
    };

    /// Of families that are cut, or whose neighbour's is.
    std::vector<Changed> changed_bonds(const GivenWeights<2> &given, const BulkBonds &bulk,
                                       const std::vector<char> &is_cut)
    {
      std::vector<Changed> bonds;
      for (std::size_t i = 0; i < given.given.families.size(); ++i)
      {
        const Family<2> &family = given.given.families[i];
        for (std::size_t k = 0; k < family.bonds.size(); ++k)
        {
          const std::size_t j = family.neighbours[k];
          const BulkBonds::Kind *kind = bulk.find(family.bonds[k].xi);
          if ((is_cut[i] != 0 || is_cut[j] != 0) && kind != nullptr && kind->ratio != 0)
            bonds.push_back({i, j, family.bonds[k].xi, family.bonds[k].weight / given.volumes[j]});
        }
      }
      return bonds;
    }

    /// Median difference from the bonds of the bulk, with a correction undone.
    double difference(const std::vector<Changed> &bonds, const BulkBonds &bulk,
                      const FoundCorrection &correction)
    {
      std::vector<double> values;
      for (const Changed &one : bonds)
        values.push_back(std::abs(
            one.ratio / (bulk.find(one.xi)->ratio * correction.factor(one.node, one.neighbour)) -
            1));
      return spread_of(values).median;
    }
  } // namespace

  double FoundCorrection::factor(std::size_t node, std::size_t neighbour) const
  {
    if (correction == Correction::none)
      return 1;
    const double result =
        !size.sums.empty()
            ? on_ellipse(size.sums[node], size.sums[neighbour],
                         size.places[neighbour] - size.places[node])
            : factor_of(correction, size.in_bulk, size.values[node], size.values[neighbour]);
    return std::isfinite(result) ? result : 1;
  }

  FoundCorrection find_correction(const GivenWeights<2> &given, const BulkBonds &bulk,
                                  const std::vector<char> &is_cut, const std::vector<char> &is_bulk,
                                  const std::vector<double> &visible, const Kernel<2> &kernel)
  {
    constexpr double alike = .01, explained = .25, near = .02;
    const std::vector<Changed> bonds = changed_bonds(given, bulk, is_cut);
    FoundCorrection best;
    if (bonds.empty())
      return best;
    best.before = best.after = difference(bonds, bulk, best);
    const auto attempt = [&](Correction correction, const FamilySize &size)
    {
      FoundCorrection one{correction, size, best.before, 0};
      const auto factor = [&](std::size_t i, std::size_t j) { return one.factor(i, j); };
      // families of scattered nodes differ in V, and those of small bodies have cut neighbours
      one.after = difference(bonds, bulk.without(factor, given, is_bulk), one);
      if (one.before > alike && one.after < near && one.after < explained * one.before &&
          one.after < best.after)
        best = one;
    };
    for (FamilySize &size : sizes(given, bulk, visible, kernel))
    {
      size.in_bulk = median_in(size.values, is_bulk);
      for (const Correction correction : {Correction::volume, Correction::whole_ball})
        attempt(correction, size);
    }
    if (kernel.n_components() > 1)
    {
      attempt(Correction::force_density,
              axis_sums(force_density_method(), given, bulk, is_bulk, kernel));
      attempt(Correction::energy, axis_sums(energy_method(), given, bulk, is_bulk, kernel));
    }
    return best;
  }
} // namespace plumbline::meshfree
