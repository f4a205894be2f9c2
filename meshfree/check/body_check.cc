#include "meshfree/check/body_check.h"

#include "base/error.h"
#include "meshfree/check/bond_profile.h"
#include "meshfree/rules/families.h"
#include "meshfree/rules/moments.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace plumbline::meshfree
{
  using geometry::FamilyCut;
  using geometry::Passage;

  namespace
  {
    /// What of the balls of all nodes is visible.
    struct View
    {
      std::vector<FamilyCut> cut;
      std::vector<char> is_cut;
      std::vector<double> area; ///< of the visible part [length^2]
    };

    View view_of(const geometry::VisibleBody &body, const geometry::NodeCells<2> &cells,
                 double horizon)
    {
      View result;
      std::vector<geometry::Polygon> visible;
      for (const Point<2> &x : cells.nodes)
      {
        const geometry::Ball ball{x, horizon};
        result.cut.push_back(body.find(ball, visible));
        result.is_cut.push_back(static_cast<char>(result.cut.back() != FamilyCut::none));
        double area = 0;
        for (const geometry::Polygon &polygon : visible)
          area += geometry::intersect(ball, geometry::ConvexCell(polygon)).area;
        result.area.push_back(area);
      }
      return result;
    }

    /// Families of whole balls, and if there are such, only those whose neighbours have whole balls
    /// as well: no surface correction changes their weights.
    std::vector<char> bulk_of(const GivenFamilies<2> &given, const View &seen)
    {
      std::vector<char> is_whole, is_bulk;
      for (std::size_t i = 0; i < given.families.size(); ++i)
      {
        const std::vector<unsigned int> &neighbours = given.families[i].neighbours;
        is_whole.push_back(static_cast<char>(seen.is_cut[i] == 0));
        is_bulk.push_back(
            static_cast<char>(seen.is_cut[i] == 0 &&
                              std::none_of(neighbours.begin(), neighbours.end(),
                                           [&](unsigned int j) { return seen.is_cut[j] != 0; })));
      }
      if (std::find(is_whole.begin(), is_whole.end(), 1) == is_whole.end())
        throw InputError("no node is a horizon away from free surfaces and cracks, so that there "
                         "are no families of the bulk to compare with; give a larger body, or a "
                         "smaller horizon (Study/m)");
      return std::find(is_bulk.begin(), is_bulk.end(), 1) == is_bulk.end() ? is_whole : is_bulk;
    }

    /// ∫ C_ab ξ^α over the visible part of a ball.
    class VisibleMoments
    {
    public:
      VisibleMoments(const Kernel<2> &kernel, const Point<2> &centre,
                     const std::vector<geometry::Polygon> &visible)
          : n_more_(kernel.n_components() == 1 ? 0 : 2)
      {
        const auto degree = static_cast<unsigned int>(2 + n_more_);
        values_.assign((degree + 1) * (degree + 2) / 2, 0.);
        for (const Kernel<2> &part : kernel.parts())
        {
          const auto of_part = geometry::weighted_moments(
              {centre, part.horizon()}, visible,
              [&](double r) { return part.radial(r) / (n_more_ == 0 ? 1 : r * r); }, degree);
          for (std::size_t k = 0; k < values_.size(); ++k)
            values_[k] += of_part[k];
        }
      }

      /// Tensors are radial(r) ξ_a ξ_b / r².
      double operator()(const Exponents<2> &alpha, unsigned int a, unsigned int b) const
      {
        const std::size_t n = static_cast<std::size_t>(alpha[0] + alpha[1] + n_more_),
                          n_y = static_cast<std::size_t>(alpha[1]) + (n_more_ == 0 ? 0 : a + b);
        return values_[n * (n + 1) / 2 + n_y];
      }

    private:
      int n_more_;
      std::vector<double> values_; ///< of monomials, in the order of weighted_moments
    };

    /// How the moments of a family compare with those of the visible part.
    struct Comparison
    {
      double first = 0, second = 0; ///< differences, see MomentDefect
      double exact = 1, given = 1;  ///< tr C |ξ|², relative to the whole ball
    };

    /// @param exact  moment of α, a and b
    template <class Exact>
    Comparison compare(const Family<2> &family, const std::vector<double> &factors,
                       const Kernel<2> &kernel, const Exact &exact)
    {
      Comparison result;
      double bulk_trace = 0, exact_trace = 0, given_trace = 0;
      for (const int degree : {1, 2})
        for (const Exponents<2> &alpha : exponents<2>(degree, degree))
          for (unsigned int a = 0; a < kernel.n_components(); ++a)
            for (unsigned int b = a; b < kernel.n_components(); ++b)
            {
              double as_given = 0, undone = 0;
              for (std::size_t k = 0; k < family.bonds.size(); ++k)
              {
                const Bond<2> &bond = family.bonds[k];
                const double part = bond.weight * kernel_value(kernel, bond, a, b) *
                                    std::pow(bond.xi[0], alpha[0]) * std::pow(bond.xi[1], alpha[1]);
                as_given += part;
                undone += part / factors[k];
              }
              const double value = exact(alpha, a, b), off = std::abs(undone - value);
              double &worst = degree == 1 ? result.first : result.second;
              worst = std::max(worst, off);
              if (degree == 2 && a == b && alpha[0] != 1)
              {
                bulk_trace += kernel.moment(alpha, a, b);
                exact_trace += value;
                given_trace += as_given;
              }
            }
      result.first /= kernel_size(kernel, 1);
      result.second /= std::abs(kernel.moment({2, 0}));
      result.exact = exact_trace / bulk_trace;
      result.given = given_trace / bulk_trace;
      return result;
    }

    double median(const std::vector<Comparison> &all, double Comparison::*of)
    {
      std::vector<double> values;
      for (const Comparison &one : all)
        values.push_back(one.*of);
      return spread_of(values).median;
    }

    double least(const std::vector<Comparison> &all, double Comparison::*of)
    {
      double result = HUGE_VAL;
      for (const Comparison &one : all)
        result = std::min(result, one.*of);
      return result;
    }

    /// Of the families that are cut in one way.
    CutFamilies families_of(FamilyCut cut, const GivenWeights<2> &given, const View &seen,
                            const FoundCorrection &correction, const geometry::VisibleBody &body,
                            const Kernel<2> &kernel)
    {
      CutFamilies result;
      result.cut = cut;
      std::vector<Comparison> all;
      std::vector<Family<2>> families;
      std::vector<geometry::Polygon> visible;
      for (std::size_t i = 0; i < given.given.families.size(); ++i)
      {
        if (seen.cut[i] != cut)
          continue;
        const Family<2> &family = given.given.families[i];
        std::vector<double> factors;
        for (const unsigned int j : family.neighbours)
          factors.push_back(correction.factor(i, j));
        const Point<2> &x = given.cells->nodes[i];
        body.find({x, kernel.horizon()}, visible);
        const auto of_ball = [&](const Exponents<2> &alpha, unsigned int a, unsigned int b)
        { return kernel.moment(alpha, a, b); };
        all.push_back(cut == FamilyCut::none
                          ? compare(family, factors, kernel, of_ball)
                          : compare(family, factors, kernel, VisibleMoments(kernel, x, visible)));
        families.push_back(family);
        for (const auto &[worst, value] : {std::pair{&result.first, all.back().first},
                                           std::pair{&result.second, all.back().second}})
          if (value >= worst->value)
            *worst = {value, given.cells->source[i]};
      }
      result.n = all.size();
      if (all.empty())
        return result;
      result.median_first = median(all, &Comparison::first);
      result.median_second = median(all, &Comparison::second);
      result.exact = median(all, &Comparison::exact);
      result.least_exact = least(all, &Comparison::exact);
      result.given = median(all, &Comparison::given);
      result.least_given = least(all, &Comparison::given);
      result.elastic = elastic_ranges(families, kernel);
      return result;
    }

    /// Pairs of nodes that cross a crack and have a bond, and those that have none though all such
    /// pairs have in the bulk.
    void check_pairs(const GivenWeights<2> &given, const View &seen,
                     const geometry::VisibleBody &body, const BulkBonds &bulk, BodyCheck &check)
    {
      const geometry::NodeCells<2> &cells = *given.cells;
      std::vector<geometry::Box> boxes;
      for (const Point<2> &x : cells.nodes)
        boxes.push_back({x, x});
      const geometry::BoxSearch<2> search(boxes);
      std::set<std::pair<std::size_t, std::size_t>> crossing, missing, at_ends;
      std::vector<unsigned int> near;
      for (std::size_t i = 0; i < given.given.families.size(); ++i)
      {
        const std::vector<unsigned int> &neighbours = given.given.families[i].neighbours;
        const Point<2> &x = cells.nodes[i];
        for (const unsigned int j : neighbours)
          if (body.passage(x, cells.nodes[j]) == Passage::crosses)
            crossing.insert(std::minmax(i, std::size_t(j)));
        if (seen.is_cut[i] == 0)
          continue;
        search.find(box_around(x, bulk.reach()), near);
        for (const unsigned int j : near)
        {
          const Point<2> &y = cells.nodes[j];
          const BulkBonds::Kind *kind = bulk.find(Point<2>(y - x));
          if (j == i || kind == nullptr || !kind->is_always_there())
            continue;
          const Passage passage = body.passage(x, y);
          if (passage == Passage::touches_end)
            at_ends.insert(std::minmax(i, std::size_t(j)));
          else if (passage == Passage::clear &&
                   !std::binary_search(neighbours.begin(), neighbours.end(), j) && body.holds(x, y))
            missing.insert(std::minmax(i, std::size_t(j)));
        }
      }
      const auto in_file = [&](const auto &pairs)
      {
        std::vector<NodePair> result;
        for (const auto &[i, j] : pairs)
          result.push_back({cells.source[i], cells.source[j]});
        return result;
      };
      check.crossing = in_file(crossing);
      check.n_at_ends = at_ends.size();
      if (!given.given.is_half_list)
        check.missing = in_file(missing);
    }

    /// Bonds of cut families whose weights are not those of the bulk, the largest difference first.
    void check_weights_of_cut(const GivenWeights<2> &given, const View &seen,
                              const geometry::VisibleBody &body, const BulkBonds &bulk,
                              BodyCheck &check)
    {
      constexpr double alike = .05, deviations = 4;
      const geometry::NodeCells<2> &cells = *given.cells;
      for (std::size_t i = 0; i < given.given.families.size(); ++i)
      {
        const Family<2> &family = given.given.families[i];
        for (std::size_t k = 0; seen.is_cut[i] != 0 && k < family.bonds.size(); ++k)
        {
          const std::size_t j = family.neighbours[k];
          const BulkBonds::Kind *kind = bulk.find(family.bonds[k].xi);
          if (kind == nullptr || kind->ratio == 0 ||
              body.passage(cells.nodes[i], cells.nodes[j]) != Passage::clear)
            continue;
          ++check.n_compared;
          const double factor = family.bonds[k].weight / (kind->ratio * given.volumes[j]) /
                                check.correction.factor(i, j);
          if (std::abs(factor - 1) > std::max(alike, deviations * kind->deviation))
            check.different.push_back({cells.source[i], cells.source[j], factor});
        }
      }
      std::stable_sort(check.different.begin(), check.different.end(),
                       [](const NodePair &a, const NodePair &b)
                       { return std::abs(a.factor - 1) > std::abs(b.factor - 1); });
    }

    /// The same weights with nodes in another order, the first of them free; a correction undone.
    GivenWeights<2> reordered_weights(const GivenWeights<2> &given,
                                      const std::vector<std::size_t> &order, std::size_t n_free,
                                      const FoundCorrection &correction)
    {
      GivenWeights<2> result;
      result.nodes = given.nodes;
      result.cells =
          std::make_shared<const geometry::NodeCells<2>>(reordered(*given.cells, order, n_free));
      std::vector<unsigned int> place(order.size());
      for (std::size_t k = 0; k < order.size(); ++k)
      {
        place[order[k]] = static_cast<unsigned int>(k);
        result.volumes.push_back(given.volumes[order[k]]);
      }
      const GivenFamilies<2> &old = given.given;
      result.given.n_ignored = old.n_ignored;
      result.given.is_half_list = old.is_half_list;
      result.given.weight_rounding = old.weight_rounding;
      result.given.notes = old.notes;
      for (CollarBond<2> one : old.of_collar)
      {
        one.node = place[one.node];
        one.neighbour = place[one.neighbour];
        result.given.of_collar.push_back(one);
      }
      result.given.families.resize(n_free);
      result.given.lines.resize(n_free);
      for (std::size_t i = 0; i < old.families.size(); ++i)
      {
        const Family<2> &family = old.families[i];
        std::vector<CollarBond<2>> bonds;
        for (std::size_t k = 0; k < family.bonds.size(); ++k)
        {
          bonds.push_back(
              {place[i], place[family.neighbours[k]], family.bonds[k], old.lines[i][k]});
          bonds.back().bond.weight /= correction.factor(i, family.neighbours[k]);
        }
        std::sort(bonds.begin(), bonds.end(),
                  [](const CollarBond<2> &a, const CollarBond<2> &b)
                  { return a.neighbour < b.neighbour; });
        for (const CollarBond<2> &one : bonds)
          if (one.node >= n_free)
            result.given.of_collar.push_back(one);
          else
          {
            result.given.families[one.node].neighbours.push_back(
                static_cast<unsigned int>(one.neighbour));
            result.given.families[one.node].bonds.push_back(one.bond);
            result.given.lines[one.node].push_back(one.line);
          }
      }
      return result;
    }
  } // namespace

  bool BodyCheck::is_different() const
  {
    constexpr double share = .3;
    return static_cast<double>(different.size()) > share * static_cast<double>(n_compared);
  }

  BodyCheck check_body(GivenWeights<2> &given, std::vector<double> &uncut_areas,
                       const geometry::VisibleBody &body, const Kernel<2> &kernel, double spacing)
  {
    const View seen = view_of(body, *given.cells, kernel.horizon());
    const std::vector<char> is_bulk = bulk_of(given.given, seen);
    const BulkBonds as_given(given, is_bulk, spacing);
    BodyCheck check;
    check.spacing = spacing;
    check.n_families = given.given.families.size();
    for (const Family<2> &family : given.given.families)
      check.n_bonds += family.bonds.size();
    check_pairs(given, seen, body, as_given, check);
    check.correction = find_correction(given, as_given, seen.is_cut, is_bulk, seen.area, kernel);
    const BulkBonds bulk = as_given.without([&](std::size_t i, std::size_t j)
                                            { return check.correction.factor(i, j); },
                                            given, is_bulk);
    check_weights_of_cut(given, seen, body, bulk, check);
    for (const FamilyCut cut : {FamilyCut::none, FamilyCut::surface, FamilyCut::crack})
      if (CutFamilies families = families_of(cut, given, seen, check.correction, body, kernel);
          families.n > 0)
        check.families.push_back(std::move(families));
    check.symmetry = check_symmetry(given.given.families, kernel, given.volumes);
    for (std::size_t &node : check.symmetry.nodes)
      node = given.cells->source[node];

    // a correction that is known to some digits only leaves its remainder beside the surface
    constexpr double exactly = 1e-6;
    const bool is_exact =
        check.correction.correction == Correction::none || check.correction.after < exactly;
    std::vector<std::size_t> order(given.cells->size());
    std::iota(order.begin(), order.end(), 0);
    const auto first_cut = std::stable_partition(
        order.begin(), order.end(),
        [&](std::size_t i)
        { return i < is_bulk.size() && (is_exact ? seen.is_cut[i] == 0 : is_bulk[i] != 0); });
    std::vector<double> areas;
    for (const std::size_t i : order)
      areas.push_back(uncut_areas[i]);
    uncut_areas = std::move(areas);
    given = reordered_weights(given, order, static_cast<std::size_t>(first_cut - order.begin()),
                              check.correction);
    return check;
  }
} // namespace plumbline::meshfree
