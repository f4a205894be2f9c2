#include "meshfree/check/weights_in_space.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/number_text.h"
#include "meshfree/check/images.h"
#include "meshfree/rules/family_moments.h"
#include "meshfree/rules/rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace plumbline::meshfree
{
  namespace
  {
    using Index = std::unordered_map<std::int64_t, std::size_t>; ///< of nodes by their ids

    std::string number(double value)
    {
      constexpr int digits = 5;
      return base::to_text(value, digits);
    }

    bool is_inside(const geometry::Cuboid &omega, const Point<3> &x)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (!(x[d] > omega.lower[d] && x[d] < omega.upper[d]))
          return false;
      return true;
    }

    /// @param sizes  the rounding errors of weights by their digits, relative
    std::vector<BondInSpace> read_bonds(const std::string &file, const Index &index,
                                        std::vector<double> &roundings)
    {
      base::Csv csv(file, {"i", "j", "weight"});
      std::vector<BondInSpace> bonds;
      const auto node = [&](const std::string &column)
      {
        const auto found = index.find(csv.integer(column));
        if (found == index.end())
          csv.fail(column + " = " + std::to_string(csv.integer(column)) +
                   " is the id of no node; give ids of the nodes file");
        return found->second;
      };
      while (csv.next())
      {
        BondInSpace bond;
        bond.i = node("i");
        bond.j = node("j");
        bond.weight = csv.number("weight");
        if (csv.has("qx") && !csv.is_empty("qx"))
          bond.kernel_point = Point<3>(csv.number("qx"), csv.number("qy"), csv.number("qz"));
        bond.line = csv.line();
        bonds.push_back(bond);
        if (bond.weight != 0)
          roundings.push_back(csv.digits("weight").rounding(bond.weight) / std::abs(bond.weight));
      }
      return bonds;
    }

    /// Whether no pair has bonds both ways.
    /// @param sorted  by node, then by neighbour
    bool is_half_list(const std::vector<const BondInSpace *> &sorted)
    {
      using Ends = std::pair<std::size_t, std::size_t>;
      const auto is_listed = [&](const Ends &ends)
      {
        const auto at = std::lower_bound(sorted.begin(), sorted.end(), ends,
                                         [](const BondInSpace *bond, const Ends &wanted)
                                         { return Ends(bond->i, bond->j) < wanted; });
        return at != sorted.end() && Ends((*at)->i, (*at)->j) == ends;
      };
      return std::none_of(sorted.begin(), sorted.end(),
                          [&](const BondInSpace *bond) {
                            return is_listed({bond->j, bond->i});
                          });
    }

    double median(std::vector<double> values)
    {
      if (values.empty())
        return 0;
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      return *middle;
    }
  } // namespace

  WeightsInSpace read_nodes_in_space(const std::string &file)
  {
    WeightsInSpace given;
    base::Csv csv(file, {"id", "x", "y", "z", "volume"});
    std::unordered_set<std::int64_t> ids;
    std::map<std::array<double, 3>, std::size_t> line_of_place;
    while (csv.next())
    {
      const std::int64_t id = csv.integer("id");
      if (!ids.insert(id).second)
        csv.fail("id " + std::to_string(id) +
                 " is given already; give every node an id of its own");
      given.id.push_back(id);
      given.places.emplace_back(csv.number("x"), csv.number("y"), csv.number("z"));
      const auto &x = given.places.back();
      if (const auto [other, is_new] =
              line_of_place.emplace(std::array{x[0], x[1], x[2]}, csv.line());
          !is_new)
        csv.fail("node " + std::to_string(id) + " lies where that of line " +
                 std::to_string(other->second) + " is; take one of them out");
      given.volumes.push_back(csv.number("volume"));
      if (!(given.volumes.back() > 0))
        csv.fail("the volume of node " + std::to_string(id) +
                 " is not positive; give that of its cell");
    }
    return given;
  }

  Point<3> WeightsInSpace::vector_between(std::size_t i, std::size_t j) const
  {
    const Point<3> xi(places[j] - places[i]);
    return box ? box->shortest(xi) : xi;
  }

  void set_families(WeightsInSpace &given, const std::vector<BondInSpace> &bonds,
                    const geometry::Cuboid &omega, const std::string &nodes_name,
                    const std::string &bonds_name)
  {
    const auto id = [&](std::size_t node) { return "node " + std::to_string(given.id[node]); };
    const auto fail = [&](const BondInSpace &bond, const std::string &what)
    { return InputError(bonds_name + ", line " + std::to_string(bond.line) + ": " + what); };
    given.free.clear();
    if (given.box)
      given.box->take_in(given.places, id);
    for (std::size_t node = 0; node < given.id.size(); ++node)
      if (given.box || is_inside(omega, given.places[node]))
        given.free.push_back(node);
    if (given.free.empty())
      throw InputError(nodes_name + ": no node lies inside the box; give the box of the nodes that "
                                    "are solved for");
    std::vector<const BondInSpace *> sorted;
    for (const BondInSpace &bond : bonds)
    {
      if (bond.i == bond.j)
        throw fail(bond, id(bond.i) + " has a bond with itself; leave its own volume out");
      if (bond.kernel_point && !(bond.kernel_point->square() > 0))
        throw fail(bond, "the kernel is taken at 0, where " + id(bond.i) +
                             " is; give its place relative to it");
      sorted.push_back(&bond);
    }
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const BondInSpace *a, const BondInSpace *b)
                     { return std::pair(a->i, a->j) < std::pair(b->i, b->j); });
    // where every pair is listed once, some nodes may have no bonds
    const bool is_half = is_half_list(sorted);
    given.families.assign(given.free.size(), {});
    given.lines.assign(given.free.size(), {});
    auto next = sorted.begin();
    for (std::size_t f = 0; f < given.free.size(); ++f)
    {
      Family<3> &family = given.families[f];
      while (next != sorted.end() && (*next)->i < given.free[f])
        ++next;
      for (; next != sorted.end() && (*next)->i == given.free[f]; ++next)
      {
        const BondInSpace &one = **next;
        if (!family.neighbours.empty() && family.neighbours.back() == one.j)
          throw fail(one, "the bond from " + id(one.i) + " to " + id(one.j) +
                              " is given already; give every bond once");
        Bond<3> bond;
        bond.xi = given.vector_between(one.i, one.j);
        bond.weight = one.weight;
        bond.area = given.volumes[one.j];
        bond.kernel_point = one.kernel_point.value_or(bond.xi);
        family.neighbours.push_back(static_cast<unsigned int>(one.j));
        family.bonds.push_back(bond);
        given.lines[f].push_back(one.line);
      }
      if (family.bonds.empty() && !is_half)
        throw InputError(bonds_name + ": " + id(given.free[f]) +
                         ", which lies in the box, has no bond; list the bonds of every node "
                         "there");
    }
  }

  WeightsInSpace read_weights_in_space(const std::string &nodes_file, const std::string &bonds_file,
                                       const geometry::Cuboid &omega, bool is_periodic)
  {
    WeightsInSpace given = read_nodes_in_space(nodes_file);
    if (is_periodic)
      given.box = {omega.lower, omega.upper};
    Index index;
    for (std::size_t node = 0; node < given.id.size(); ++node)
      index[given.id[node]] = node;
    std::vector<double> roundings;
    const auto bonds = read_bonds(bonds_file, index, roundings);
    set_families(given, bonds, omega, "file '" + nodes_file + "'", "file '" + bonds_file + "'");
    given.rounding = median(std::move(roundings));
    return given;
  }

  namespace
  {
    void check_moments(const WeightsInSpace &given, const Kernel<3> &kernel, FindingsInSpace &found)
    {
      const BallMoments<3> first(kernel, 1), both(kernel, 2);
      std::vector<double> defects;
      const auto raise = [](Worst &worst, double value, std::size_t node)
      {
        if (value > worst.value)
          worst = {value, node};
      };
      for (std::size_t f = 0; f < given.families.size(); ++f)
      {
        const auto &bonds = given.families[f].bonds;
        defects.push_back(both.worst_defect(bonds));
        raise(found.first, first.worst_defect(bonds), given.free[f]);
        raise(found.second, defects.back(), given.free[f]);
        found.n_bonds += bonds.size();
        for (const Bond<3> &bond : bonds)
          found.n_negative += bond.weight < 0 ? 1 : 0;
      }
      found.typical = median(defects);
    }

    /// Pairs of free nodes seen from both ends.
    void check_pairs(const WeightsInSpace &given, const Kernel<3> &kernel, FindingsInSpace &found)
    {
      std::vector<std::size_t> family_of(given.id.size(), given.free.size());
      for (std::size_t f = 0; f < given.free.size(); ++f)
        family_of[given.free[f]] = f;
      double largest = 0, worst = 0;
      const auto force = [&](std::size_t f, std::size_t k)
      {
        const Bond<3> &bond = given.families[f].bonds[k];
        return given.volumes[given.free[f]] * bond.weight * radial_value(kernel, bond);
      };
      for (std::size_t f = 0; f < given.families.size(); ++f)
        for (std::size_t k = 0; k < given.families[f].bonds.size(); ++k)
        {
          const std::size_t other = family_of[given.families[f].neighbours[k]];
          if (other == given.free.size())
            continue;
          const auto &back = given.families[other].neighbours;
          const auto at = std::lower_bound(back.begin(), back.end(), given.free[f]);
          largest = std::max(largest, std::abs(force(f, k)));
          if (at == back.end() || *at != given.free[f])
            ++found.n_unpaired;
          else
            worst = std::max(
                worst,
                std::abs(force(f, k) - force(other, static_cast<std::size_t>(at - back.begin()))));
        }
      found.imbalance = largest > 0 ? worst / largest : 0;
    }

    /// A rule's weights by where neighbours are on a lattice.
    class RuleOnLattice
    {
    public:
      RuleOnLattice(const Bonds<3> &bonds, double h) : h_(h), n_bonds_(bonds.family.size())
      {
        for (const Bond<3> &bond : bonds.family)
          for (unsigned int d = 0; d < 3; ++d)
            reach_ = std::max(reach_, static_cast<int>(std::lround(std::abs(bond.xi[d]) / h)));
        const std::size_t width = 2 * static_cast<std::size_t>(reach_) + 1;
        bonds_.resize(width * width * width);
        for (const Bond<3> &bond : bonds.family)
          bonds_[*place(bond.xi)] = bond;
      }
      /// Weight 0 where the rule has none.
      Bond<3> at(const Point<3> &xi) const
      {
        const auto index = place(xi);
        return index ? bonds_[*index] : Bond<3>();
      }
      std::size_t n_bonds() const { return n_bonds_; }

    private:
      std::optional<std::size_t> place(const Point<3> &xi) const
      {
        std::size_t index = 0;
        for (unsigned int d = 3; d-- > 0;)
        {
          const int k = static_cast<int>(std::lround(xi[d] / h_));
          if (std::abs(k) > reach_)
            return {};
          index = index * (2 * static_cast<std::size_t>(reach_) + 1) +
                  static_cast<std::size_t>(k + reach_);
        }
        return index;
      }

      double h_;
      std::size_t n_bonds_;
      int reach_ = 0;
      std::vector<Bond<3>> bonds_;
    };

    bool are_on_lattice(const WeightsInSpace &given, double h)
    {
      constexpr double off = 1e-4; // of h
      for (const Family<3> &family : given.families)
        for (const Bond<3> &bond : family.bonds)
          for (unsigned int d = 0; d < 3; ++d)
            if (std::abs(bond.xi[d] / h - std::round(bond.xi[d] / h)) > off)
              return false;
      return true;
    }

    /// How the weights compare with one rule.
    struct Match
    {
      std::string rule;
      double factor = 1;
      std::size_t n_unlike = 0, n_other_points = 0; ///< bonds, those that are missing among them
      std::vector<std::string> unlike;              ///< the first of them
    };

    Match compare(const WeightsInSpace &given, const std::string &name, const RuleOnLattice &rule,
                  double h)
    {
      constexpr double least = 1e-6; // of h³, for weights to differ; of h, for kernel points
      constexpr std::size_t most_named = 5;
      Match match;
      match.rule = name;
      std::vector<double> ratios;
      for (const Family<3> &family : given.families)
        for (const Bond<3> &bond : family.bonds)
          if (const double own = rule.at(bond.xi).weight; own != 0)
            ratios.push_back(bond.weight / own);
      match.factor = median(ratios);
      const double tolerance =
          std::max(least, 10 * given.rounding) * h * h * h * std::max(1e-3, std::abs(match.factor));
      const auto tell = [&](const std::string &text)
      {
        ++match.n_unlike;
        if (match.unlike.size() < most_named)
          match.unlike.push_back(text);
      };
      for (std::size_t f = 0; f < given.families.size(); ++f)
      {
        const Family<3> &family = given.families[f];
        const std::string from =
            "the bond from node " + std::to_string(given.id[given.free[f]]) + " to node ";
        std::size_t n_found = 0;
        for (std::size_t k = 0; k < family.bonds.size(); ++k)
        {
          const Bond<3> own = rule.at(family.bonds[k].xi);
          n_found += own.weight != 0 ? 1 : 0;
          if (std::abs(family.bonds[k].weight - match.factor * own.weight) > tolerance)
            tell(from + std::to_string(given.id[family.neighbours[k]]) + " (line " +
                 std::to_string(given.lines[f][k]) + ") has the weight " +
                 number(family.bonds[k].weight) + " where " + number(match.factor * own.weight) +
                 " is expected");
          else if ((family.bonds[k].kernel_point - own.kernel_point).norm() > 1e-4 * h)
            ++match.n_other_points;
        }
        if (n_found < rule.n_bonds())
        {
          tell("node " + std::to_string(given.id[given.free[f]]) + " lacks " +
               std::to_string(rule.n_bonds() - n_found) + " of the " +
               std::to_string(rule.n_bonds()) + " bonds of " + name);
          match.n_unlike += rule.n_bonds() - n_found - 1;
        }
      }
      return match;
    }

    /// The rule that the weights are like most, of those that are meant if they tie.
    std::optional<Match> best_match(const WeightsInSpace &given, const Kernel<3> &kernel, double h,
                                    const std::vector<std::string> &meant)
    {
      std::optional<Match> best;
      const auto is_meant = [&](const std::string &name)
      { return std::find(meant.begin(), meant.end(), name) != meant.end(); };
      std::vector<Rule> all = rules();
      all.insert(all.end(), rules_on_request().begin(), rules_on_request().end());
      const bool is_tensor = kernel.n_components() > 1;
      for (const Rule &rule : all)
        if (rule.in_space && !(rule.is_scalar && is_tensor))
          try
          {
            const auto bonds = lattice_bonds(rule.in_space(kernel), kernel, h, Backend::fast);
            const Match match = compare(given, rule.name, RuleOnLattice(bonds, h), h);
            const bool is_tie = best && match.n_unlike == best->n_unlike &&
                                match.n_other_points == best->n_other_points;
            if (!best || match.n_unlike < best->n_unlike ||
                (match.n_unlike == best->n_unlike && match.n_other_points < best->n_other_points) ||
                (is_tie && is_meant(rule.name) && !is_meant(best->rule)))
              best = match;
          }
          catch (const NumericalError &) // the rule has no weights here
          {
          }
      return best;
    }

    std::string words_of(double factor, double h, const std::string &rule)
    {
      constexpr double alike = 1e-4;
      const auto is = [&](double value) { return std::abs(factor / value - 1) < alike; };
      if (is(-1))
        return "all weights are negated";
      if (is(2))
        return "all weights are doubled";
      if (is(.5))
        return "all weights are halved";
      if (is(1 / h))
        return "all weights are areas, h^2 in place of h^3";
      if (is(1 / (h * h * h)))
        return "all weights lack the volume h^3 of the neighbour";
      return "all weights are " + number(factor) + " times those of " + rule;
    }

    /// Bonds that are longer in the box than to the nearest image, across each pair of sides.
    std::vector<std::size_t> crossing_bonds(const WeightsInSpace &given)
    {
      std::vector<std::size_t> result(3);
      for (std::size_t f = 0; f < given.free.size(); ++f)
        for (const unsigned int j : given.families[f].neighbours)
        {
          const Point<3> xi(given.places[j] - given.places[given.free[f]]);
          for (unsigned int d = 0; d < 3; ++d)
            result[d] += given.box->crosses(xi, d) ? 1 : 0;
        }
      return result;
    }

    void name_causes(const WeightsInSpace &given, const std::optional<Match> &match, double h,
                     const std::vector<std::string> &meant, FindingsInSpace &found)
    {
      constexpr double alike = 1e-4;
      const auto is_meant = [&](const std::string &name)
      { return std::find(meant.begin(), meant.end(), name) != meant.end(); };
      if (const std::string text = missing_crossings(found.n_crossing); !text.empty())
      {
        found.causes.push_back(text);
        return;
      }
      if (2 * found.n_unpaired > found.n_bonds / 2 && found.n_unpaired > 0)
      {
        found.causes.push_back("each pair of nodes is listed once: a half list; list every bond "
                               "from both ends");
        return;
      }
      const double volume = median(given.volumes) / (h * h * h);
      if (std::abs(volume - 1) > .01)
        found.causes.push_back("the volumes are " + number(volume) +
                               " times h^3, h = " + number(h) +
                               (std::abs(volume * h - 1) < alike ? ": they are areas, h^2" : ""));
      if (!match)
        return;
      if (std::abs(match->factor - 1) > alike)
        found.causes.push_back(words_of(match->factor, h, match->rule));
      if (2 * match->n_other_points > found.n_bonds)
        found.causes.push_back("the kernel is not taken where " + match->rule +
                               " takes it, at the centroid of ball and cell; give qx, qy and qz");
      for (const std::string ramp : {"LAMMPS", "QWJ"})
        if (match->rule == "FA" && is_meant(ramp) && !is_meant("FA"))
          found.causes.push_back("the weights are those of FA: the ramp of " + ramp +
                                 " at the horizon is missing");
    }
  } // namespace

  double node_spacing(const WeightsInSpace &given, const geometry::Cuboid &omega)
  {
    double volume = 1;
    for (unsigned int d = 0; d < 3; ++d)
      volume *= omega.upper[d] - omega.lower[d];
    return std::cbrt(volume / static_cast<double>(given.free.size()));
  }

  FindingsInSpace find_defects(const WeightsInSpace &given, const Kernel<3> &kernel,
                               const geometry::Cuboid &omega, const std::vector<std::string> &meant)
  {
    FindingsInSpace found;
    found.spacing = node_spacing(given, omega);
    check_moments(given, kernel, found);
    check_pairs(given, kernel, found);
    found.elastic = elastic_ranges(given.families, kernel);
    if (given.box)
      found.n_crossing = crossing_bonds(given);
    std::optional<Match> match;
    if (are_on_lattice(given, found.spacing))
      match = best_match(given, kernel, found.spacing, meant);
    if (match && 10 * match->n_unlike > found.n_bonds)
      match.reset();
    if (match)
    {
      found.rule = match->rule;
      found.rule_factor = match->factor;
      found.outliers = match->unlike;
      if (match->n_unlike > match->unlike.size())
        found.outliers.push_back(std::to_string(match->n_unlike - match->unlike.size()) +
                                 " bonds more");
    }
    name_causes(given, match, found.spacing, meant, found);
    return found;
  }
} // namespace plumbline::meshfree
