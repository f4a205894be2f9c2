#include "meshfree/check/bond_outliers.h"

#include "meshfree/check/bond_nodes.h"
#include "meshfree/check/bond_pairs.h"
#include "meshfree/check/bond_profile.h"
#include "meshfree/check/exact_families.h"
#include "meshfree/check/node_moments.h"
#include "meshfree/check/rule_comparison.h"
#include "meshfree/check/sizes.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace plumbline::meshfree
{
  namespace
  {
    /// Of a bond beyond its usual values; negative among them.
    double excess(double value, const BondProfile::Usual &usual)
    {
      return std::max(usual.low - value, value - usual.high);
    }

    /// The same in what is allowed; at most 1: in line.
    double distance(double value, const BondProfile::Usual &usual)
    {
      return std::max(0., excess(value, usual)) / usual.allowed;
    }

    double nearest(double value, const BondProfile::Usual &usual)
    {
      return std::clamp(value, usual.low, usual.high);
    }

    template <int dim>
    Outlier<dim> outlier(Defect defect, const Pair<dim> &pair, double distance)
    {
      Outlier<dim> result{defect, pair.node, pair.neighbour, pair.bond};
      result.distance = distance;
      return result;
    }

    /// That a bond is there, as others like it are.
    template <int dim>
    bool has_weight(const GivenBonds<dim> &given, const Pair<dim> &pair,
                    const BondProfile::Usual &usual, double floor)
    {
      return pair.bond != Outlier<dim>::none && usual.low > floor &&
             bond_of(given, pair).weight != 0;
    }

    /// Weights over volumes, absent bonds as 0, against the profile.
    template <int dim>
    void compare_weights(const GivenBonds<dim> &given, const std::vector<Pair<dim>> &pairs,
                         const BondProfile &profile, std::vector<Outlier<dim>> &outliers)
    {
      const std::vector<double> values = weights_over_volumes(given, pairs);
      const double floor = given.precision.weight;
      const auto usual = profile.usual(values, floor);
      for (std::size_t k = 0; k < pairs.size(); ++k)
        if (const double away = distance(values[k], usual[k]); away > 1)
        {
          if (is_at_horizon(given, pairs[k].xi) && !has_weight(given, pairs[k], usual[k], floor))
            continue; // r < horizon or r <= horizon: a choice
          const double volume = given.volumes[pairs[k].neighbour],
                       expected = nearest(values[k], usual[k]);
          const Defect defect = pairs[k].bond == Outlier<dim>::none ? Defect::missing
                                : std::abs(expected) < floor        ? Defect::spurious
                                                                    : Defect::weight;
          outliers.push_back(outlier(defect, pairs[k], away));
          outliers.back().found = values[k] * volume;
          outliers.back().expected = expected * volume;
        }
    }

    /// The size of the cross product.
    template <int dim>
    double cross(const dealii::Tensor<1, dim> &a, const dealii::Tensor<1, dim> &b)
    {
      if constexpr (dim == 2)
        return std::abs(a[0] * b[1] - a[1] * b[0]);
      else
        return dealii::cross_product_3d(a, b).norm();
    }

    /// From where kernel points are measured: a part of the way to the neighbours, or the centroids
    /// of their cells, whichever most bonds are nearer to.
    template <int dim>
    std::vector<Point<dim>> usual_points(const GivenBonds<dim> &given,
                                         const std::vector<Pair<dim>> &bonds, double point_scale)
    {
      std::vector<Point<dim>> nodes, centroids;
      std::vector<double> to_nodes, to_centroids;
      for (const Pair<dim> &pair : bonds)
      {
        const std::size_t j = pair.neighbour;
        const Point<dim> &q = bond_of(given, pair).kernel_point;
        nodes.push_back(point_scale * pair.xi);
        centroids.push_back(pair.xi + (given.cells.centroid[j] - given.cells.nodes[j]));
        to_nodes.push_back(q.distance(nodes.back()));
        to_centroids.push_back(q.distance(centroids.back()));
      }
      return spread_of(to_nodes).median <= spread_of(to_centroids).median ? nodes : centroids;
    }

    /// Of kernel points, in sizes of a node.
    template <int dim>
    double point_tolerance(const GivenBonds<dim> &given)
    {
      return file_tolerance + 4 * given.precision.length / node_size(given);
    }

    /// Where the kernel is taken: along the bond and beside it, in sizes of the neighbour.
    template <int dim>
    void compare_points(const GivenBonds<dim> &given, const std::vector<Pair<dim>> &pairs,
                        double point_scale, std::vector<Outlier<dim>> &outliers)
    {
      std::vector<Pair<dim>> bonds;
      std::vector<Point<dim>> xi;
      for (const Pair<dim> &pair : pairs)
        if (pair.bond != Outlier<dim>::none)
        {
          bonds.push_back(pair);
          xi.push_back(pair.xi);
        }
      const auto base = usual_points(given, bonds, point_scale);
      std::vector<double> along, beside;
      for (std::size_t k = 0; k < bonds.size(); ++k)
      {
        const dealii::Tensor<1, dim> away = bond_of(given, bonds[k]).kernel_point - base[k];
        const double r = xi[k].norm(), size = cell_size<dim>(given.volumes[bonds[k].neighbour]);
        along.push_back(away * xi[k] / (r * size));
        beside.push_back(cross<dim>(away, xi[k]) / (r * size));
      }
      const BondProfile profile(xi, node_size(given), given.precision.length);
      const double floor = point_tolerance(given);
      const auto usual_along = profile.usual(along, floor),
                 usual_beside = profile.usual(beside, floor);
      for (std::size_t k = 0; k < bonds.size(); ++k)
        if (const double away =
                std::max(distance(along[k], usual_along[k]), distance(beside[k], usual_beside[k]));
            away > 1)
        {
          const double r = xi[k].norm(), size = cell_size<dim>(given.volumes[bonds[k].neighbour]);
          outliers.push_back(outlier(Defect::kernel_point, bonds[k], away));
          outliers.back().found_point = bond_of(given, bonds[k]).kernel_point;
          outliers.back().expected_point =
              base[k] + nearest(along[k], usual_along[k]) * size / r * xi[k];
        }
    }

    /// w C over the neighbour's volume, from both ends. The end that is named is the one that is
    /// farther from what is usual at its length.
    template <int dim>
    void compare_ends(const GivenBonds<dim> &given, const std::vector<Pair<dim>> &pairs,
                      std::vector<Outlier<dim>> &outliers)
    {
      std::vector<Pair<dim>> bonds;
      std::vector<Point<dim>> xi;
      std::vector<double> values;
      std::map<std::pair<std::size_t, std::size_t>, std::size_t> index_of;
      double scale = 0;
      for (const Pair<dim> &pair : pairs)
        if (pair.bond != Outlier<dim>::none && pair.neighbour < given.families.size())
        {
          const Bond<dim> &bond = bond_of(given, pair);
          index_of[{pair.node, pair.neighbour}] = bonds.size();
          bonds.push_back(pair);
          xi.push_back(pair.xi);
          values.push_back(bond.weight * radial_value(given.kernel, bond) /
                           given.volumes[pair.neighbour]);
          scale = std::max(scale, std::abs(values.back()));
        }
      struct Ends
      {
        std::size_t there, back;
      };
      std::vector<Ends> twos;
      std::vector<Point<dim>> xi_of_twos;
      std::vector<double> differences;
      for (std::size_t k = 0; k < bonds.size(); ++k)
        if (const auto back = index_of.find({bonds[k].neighbour, bonds[k].node});
            back != index_of.end() && bonds[k].node < bonds[k].neighbour)
        { // without a bond back: a matter of the weights
          twos.push_back({k, back->second});
          xi_of_twos.push_back(xi[k]);
          differences.push_back(values[k] - values[back->second]);
        }
      const double floor = given.precision.weight * scale, size = node_size(given),
                   rounding = given.precision.length;
      const auto usual_value = BondProfile(xi, size, rounding).usual(values, floor);
      const auto usual = BondProfile(xi_of_twos, size, rounding).usual(differences, floor);
      for (std::size_t two = 0; two < twos.size(); ++two)
        if (const double away = distance(differences[two], usual[two]); away > 1)
        {
          const auto [there, back] = twos[two];
          const bool is_there =
              excess(values[there], usual_value[there]) >= excess(values[back], usual_value[back]);
          outliers.push_back(outlier(Defect::symmetry, bonds[is_there ? there : back], away));
          outliers.back().found = values[is_there ? there : back];
          outliers.back().expected = values[is_there ? back : there];
        }
    }

    /// Weight outliers of one node, or to one node, that are most of its bonds: one outlier.
    template <int dim>
    void gather(const GivenBonds<dim> &given, std::vector<Outlier<dim>> &outliers)
    {
      constexpr double most = .8;
      constexpr std::size_t few = 4;
      // of 0 any factor makes 0
      const auto is_nothing = [&](double weight, std::size_t j)
      { return std::abs(weight) <= given.precision.weight * given.volumes[j]; };
      std::vector<std::size_t> n_of(given.families.size()), n_to(given.cells.size());
      for (std::size_t i = 0; i < given.families.size(); ++i)
        for (std::size_t k = 0; k < given.families[i].bonds.size(); ++k)
        {
          const std::size_t j = given.families[i].neighbours[k];
          if (!is_nothing(given.families[i].bonds[k].weight, j))
          {
            ++n_of[i];
            ++n_to[j];
          }
        }
      const auto is_weight = [](const Outlier<dim> &o) { return o.defect == Defect::weight; };
      for (const Outlier<dim> &o : outliers)
        if (is_weight(o) && is_nothing(o.found, o.neighbour))
        {
          ++n_of[o.node];
          ++n_to[o.neighbour];
        }
      for (const bool is_to : {true, false})
      {
        std::map<std::size_t, std::vector<double>> ratios;
        for (const Outlier<dim> &o : outliers)
          if (is_weight(o) && o.expected != 0)
            ratios[is_to ? o.neighbour : o.node].push_back(o.found / o.expected);
        for (const auto &[node, own] : ratios)
        {
          const std::size_t n = is_to ? n_to[node] : n_of[node];
          if (n < few || static_cast<double>(own.size()) < most * static_cast<double>(n))
            continue;
          Outlier<dim> one{is_to ? Defect::neighbour : Defect::family, node};
          one.found = spread_of(own).median;
          one.expected = 1;
          for (const Outlier<dim> &o : outliers)
            if (is_weight(o) && (is_to ? o.neighbour : o.node) == node)
              one.distance = std::max(one.distance, o.distance);
          outliers.erase(std::remove_if(outliers.begin(), outliers.end(),
                                        [&, at = node](const Outlier<dim> &o) {
                                          return is_weight(o) &&
                                                 (is_to ? o.neighbour : o.node) == at;
                                        }),
                         outliers.end());
          outliers.push_back(one);
        }
      }
    }

    /// Two bonds that are missing from both ends are one outlier.
    template <int dim>
    void pair_up(std::vector<Outlier<dim>> &outliers)
    {
      std::map<std::pair<std::size_t, std::size_t>, std::size_t> missing;
      for (std::size_t k = 0; k < outliers.size(); ++k)
        if (outliers[k].defect == Defect::missing)
          missing[{outliers[k].node, outliers[k].neighbour}] = k;
      std::vector<bool> is_double(outliers.size());
      for (const auto &[ends, k] : missing)
        if (const auto back = missing.find({ends.second, ends.first});
            back != missing.end() && ends.first < ends.second)
        {
          outliers[k].is_both_ways = true;
          is_double[back->second] = true;
        }
      std::size_t k = 0;
      outliers.erase(std::remove_if(outliers.begin(), outliers.end(),
                                    [&](const Outlier<dim> &) { return is_double[k++]; }),
                     outliers.end());
    }

    template <int dim>
    bool names(const Outlier<dim> &o, std::size_t node, std::size_t neighbour)
    {
      return (o.node == node && o.neighbour == neighbour) ||
             (o.node == neighbour && o.neighbour == node);
    }

    /// Adds those that say something that no other one says.
    template <int dim>
    void add_new(const std::vector<Outlier<dim>> &more, std::vector<Outlier<dim>> &outliers)
    {
      const std::size_t n = outliers.size();
      for (const Outlier<dim> &one : more)
        if (std::none_of(outliers.begin(), outliers.begin() + static_cast<std::ptrdiff_t>(n),
                         [&](const Outlier<dim> &o)
                         {
                           if (o.neighbour == Outlier<dim>::none)
                             return o.node == one.node ||
                                    (o.defect == Defect::neighbour && o.node == one.neighbour);
                           return one.neighbour == Outlier<dim>::none
                                      ? o.node == one.node ||
                                            (o.is_both_ways && o.neighbour == one.node)
                                      : names(o, one.node, one.neighbour);
                         }))
          outliers.push_back(one);
    }
  } // namespace

  namespace
  {
    template <int dim>
    void find_by_rule(const GivenBonds<dim> &given, const Recognised<dim> &rule,
                      const std::vector<Pair<dim>> &pairs, const ExactFamilies<dim> &exact,
                      double point_scale, std::vector<Outlier<dim>> &outliers)
    {
      outliers = compare_with_rule(given, rule);
      if (!rule.has_kernel_points)
      {
        std::vector<Outlier<dim>> points;
        compare_points(given, pairs, point_scale, points);
        add_new(points, outliers);
      }
      exact.acquit(outliers);
      gather(given, outliers);
    }

    /// Without a rule to compare with. Nodes with a factor of their own first, since it hides what
    /// else there is.
    template <int dim>
    void find_by_others(const GivenBonds<dim> &raw, const std::vector<Pair<dim>> &pairs,
                        const ExactFamilies<dim> &exact, double point_scale,
                        std::vector<Outlier<dim>> &outliers)
    {
      std::vector<Point<dim>> xi;
      for (const Pair<dim> &pair : pairs)
        xi.push_back(pair.xi);
      const BondProfile profile(xi, node_size(raw), raw.precision.length);
      outliers = find_scaled_nodes(raw, pairs, profile);
      exact.acquit(outliers);
      const std::vector<Family<dim>> families = without_factors(raw.families, outliers);
      const GivenBonds<dim> given{families,    raw.kernel,    raw.cells,
                                  raw.volumes, raw.precision, raw.origin};
      compare_weights(given, pairs, profile, outliers);
      std::vector<Outlier<dim>> more;
      compare_points(given, pairs, point_scale, more);
      add_new(more, outliers);
      exact.acquit(outliers);
      gather(given, outliers);
      more.clear();
      compare_ends(given, pairs, more);
      exact.acquit(more);
      add_new(more, outliers);
      more = find_moment_outliers(given, pairs);
      exact.acquit(more);
      add_new(more, outliers);
    }

    template <int dim>
    std::vector<Family<dim>> scaled(std::vector<Family<dim>> families, double scale)
    {
      for (Family<dim> &family : families)
        for (Bond<dim> &bond : family.bonds)
          bond.weight *= scale;
      return families;
    }

    /// What makes most weights about as large as the volumes, whatever their unit is.
    template <int dim>
    double weight_scale(const GivenBonds<dim> &given, const std::vector<Pair<dim>> &pairs)
    {
      constexpr double like_volumes = 4; // then the numbers stay as they are
      std::vector<double> sizes;
      for (const double ratio : weights_over_volumes(given, pairs))
        if (ratio != 0)
          sizes.push_back(std::abs(ratio));
      const double scale = spread_of(sizes).median;
      return scale > 0 && (scale > like_volumes || scale < 1 / like_volumes) ? scale : 1;
    }

    bool is_of_weights(Defect defect)
    {
      return defect == Defect::weight || defect == Defect::missing || defect == Defect::spurious ||
             defect == Defect::symmetry;
    }
  } // namespace

  template <int dim>
  std::vector<Outlier<dim>> find_outliers(const GivenBonds<dim> &given,
                                          const std::optional<Recognised<dim>> &rule,
                                          double point_scale)
  {
    const std::vector<Pair<dim>> pairs = all_pairs(given);
    const ExactFamilies<dim> exact(given);
    std::vector<Outlier<dim>> outliers;
    if (rule)
      find_by_rule(given, *rule, pairs, exact, point_scale, outliers);
    else
    {
      const double scale = weight_scale(given, pairs);
      const std::vector<Family<dim>> families = scaled(given.families, 1 / scale);
      find_by_others(
          GivenBonds<dim>{families, given.kernel, given.cells, given.volumes, given.precision},
          pairs, exact, point_scale, outliers);
      for (Outlier<dim> &one : outliers)
        if (is_of_weights(one.defect))
        {
          one.found *= scale;
          one.expected *= scale;
        }
    }
    pair_up(outliers);
    std::stable_sort(outliers.begin(), outliers.end(),
                     [](const Outlier<dim> &a, const Outlier<dim> &b)
                     { return a.distance > b.distance; });
    return outliers;
  }

  template std::vector<Outlier<2>> find_outliers(const GivenBonds<2> &,
                                                 const std::optional<Recognised<2>> &, double);
  template std::vector<Outlier<3>> find_outliers(const GivenBonds<3> &,
                                                 const std::optional<Recognised<3>> &, double);
} // namespace plumbline::meshfree
