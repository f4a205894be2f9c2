#include "meshfree/check/hypothesis.h"

#include "base/number_text.h"
#include "meshfree/check/bond_pairs.h"
#include "meshfree/check/bond_profile.h"
#include "meshfree/check/length_profile.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  template <int dim>
  std::optional<Mend<dim>> all_zero(const Evidence<dim> &evidence)
  {
    for (const Family<dim> &family : evidence.given.families)
      for (const Bond<dim> &bond : family.bonds)
        if (bond.weight != 0)
          return {};
    Mend<dim> mend{{"all zero", "all weights are zero"}, [](std::vector<Family<dim>> &) {}};
    mend.cause.factor = 0;
    mend.cause.is_structural = true;
    mend.need = Need::nothing;
    mend.says_closer = false;
    return mend;
  }

  namespace
  {
    /// Weights over volumes at the lengths of bonds that are there.
    template <int dim>
    class Ratios
    {
    public:
      Ratios(const GivenBonds<dim> &given, const std::vector<Family<dim>> &families)
      {
        for (const Family<dim> &family : families)
          for (std::size_t k = 0; k < family.bonds.size(); ++k)
            samples_.emplace_back(family.bonds[k].xi.norm(),
                                  family.bonds[k].weight / given.volumes[family.neighbours[k]]);
        std::sort(samples_.begin(), samples_.end());
      }

      double longest() const { return samples_.empty() ? 0 : samples_.back().first; }

      /// The median of the five nearest in length.
      double at(double length) const
      {
        const auto right =
            std::lower_bound(samples_.begin(), samples_.end(), std::pair(length, -HUGE_VAL));
        const auto from = right - std::min<std::ptrdiff_t>(2, right - samples_.begin());
        const auto to = from + std::min<std::ptrdiff_t>(5, samples_.end() - from);
        std::vector<double> values;
        for (auto sample = from; sample != to; ++sample)
          values.push_back(sample->second);
        return spread_of(values).median;
      }

    private:
      std::vector<std::pair<double, double>> samples_;
    };

    template <int dim>
    void add_bond(Family<dim> &family, std::size_t j, const Bond<dim> &bond)
    {
      const auto at = std::lower_bound(family.neighbours.begin(), family.neighbours.end(), j);
      family.bonds.insert(family.bonds.begin() + (at - family.neighbours.begin()), bond);
      family.neighbours.insert(at, static_cast<unsigned int>(j));
    }

    /// The bond from its other end, with the volume there.
    template <int dim>
    Bond<dim> reversed(const Bond<dim> &bond, double volume_here, double volume_there)
    {
      const Point<dim> none;
      return {none - dealii::Tensor<1, dim>(bond.xi), bond.weight * volume_here / volume_there,
              none - dealii::Tensor<1, dim>(bond.kernel_point), volume_here};
    }

    /// Adds the other one of each pair: from the bond that is there, else, where a neighbour in the
    /// collar has none either, with the weight that bonds of that length have.
    template <int dim>
    void complete_pairs(const GivenBonds<dim> &given, const std::vector<CollarBond<dim>> &of_collar,
                        std::vector<Family<dim>> &families)
    {
      constexpr double rounding = 1e-9;
      const std::vector<Family<dim>> before = families;
      const auto add_reversed = [&](std::size_t i, std::size_t j, const Bond<dim> &bond)
      {
        if (j < families.size() && !find_bond(families[j], i))
          add_bond(families[j], i, reversed(bond, given.volumes[i], given.volumes[j]));
      };
      for (std::size_t i = 0; i < before.size(); ++i)
        for (std::size_t k = 0; k < before[i].bonds.size(); ++k)
          add_reversed(i, before[i].neighbours[k], before[i].bonds[k]);
      for (const CollarBond<dim> &one : of_collar)
        add_reversed(one.node, one.neighbour, one.bond);
      const Ratios ratios(given, before);
      const double longest = ratios.longest() * (1 + rounding) + 4 * given.precision.length;
      for (const Pair<dim> &pair :
           all_pairs(GivenBonds<dim>{families, given.kernel, given.cells, given.volumes}))
        if (pair.bond == Outlier<dim>::none && pair.neighbour >= families.size() &&
            pair.xi.norm() <= longest)
          add_bond(families[pair.node], pair.neighbour,
                   {pair.xi, given.volumes[pair.neighbour] * ratios.at(pair.xi.norm()), pair.xi,
                    given.volumes[pair.neighbour]});
    }
  } // namespace

  template <int dim>
  std::optional<Mend<dim>> half_list(const Evidence<dim> &evidence)
  {
    constexpr std::size_t fewest = 20;
    constexpr double nearly_none = .02;
    const GivenBonds<dim> &given = evidence.given;
    std::size_t n = 0, n_paired = 0;
    for (std::size_t i = 0; i < given.families.size(); ++i)
      for (const unsigned int j : given.families[i].neighbours)
        if (j < given.families.size())
        {
          ++n;
          n_paired += find_bond(given.families[j], i) ? 1 : 0;
        }
    if (n < fewest || static_cast<double>(n_paired) > nearly_none * static_cast<double>(n))
      return {};
    Mend<dim> mend{
        {"half list",
         "each pair of nodes is listed only once (a half list): list each bond both from i "
         "to j and from j to i"},
        [&given_volumes = given.volumes, &kernel = given.kernel, &cells = given.cells,
         precision = given.precision,
         &of_collar = evidence.circumstances.of_collar](std::vector<Family<dim>> &families)
        {
          complete_pairs(GivenBonds<dim>{families, kernel, cells, given_volumes, precision},
                         of_collar, families);
        }};
    mend.cause.is_structural = true;
    mend.changes_rule = true;
    return mend;
  }

  namespace
  {
    /// A profile that weights may carry, as a function of length over horizon.
    struct Profile
    {
      const char *name;
      double (*value)(double t);
    };

    const std::vector<Profile> profiles = {
        {"1 - r/horizon", [](double t) { return 1 - t; }},
        {"(1 - r/horizon)^2", [](double t) { return (1 - t) * (1 - t); }},
        {"(1 - r/horizon)^3", [](double t) { return (1 - t) * (1 - t) * (1 - t); }},
        {"1 - (r/horizon)^2", [](double t) { return 1 - t * t; }},
        {"(1 - (r/horizon)^2)^2", [](double t) { return (1 - t * t) * (1 - t * t); }},
        {"1/r", [](double t) { return 1 / t; }},
        {"1/r^2", [](double t) { return 1 / (t * t); }},
        {"1/r^3", [](double t) { return 1 / (t * t * t); }},
        {"exp(-r/horizon)", [](double t) { return std::exp(-t); }},
        {"exp(-(r/horizon)^2)", [](double t) { return std::exp(-t * t); }},
        {"exp(-4 (r/horizon)^2)", [](double t) { return std::exp(-4 * t * t); }},
        {"exp(-9 (r/horizon)^2)", [](double t) { return std::exp(-9 * t * t); }}};

    /// How far a profile's ratios are from a multiple of some values, relative to the largest.
    template <class Value>
    double misfit(const LengthProfile &profile, const Value &value)
    {
      double square = 0, product = 0, worst = 0;
      for (const LengthProfile::Bin &bin : profile.bins)
      {
        product += bin.ratio * value(bin.length);
        square += value(bin.length) * value(bin.length);
      }
      for (const LengthProfile::Bin &bin : profile.bins)
        worst = std::max(worst, std::abs(bin.ratio - product / square * value(bin.length)));
      return square > 0 ? worst / profile.largest() : HUGE_VAL;
    }

    /// The known profile that fits best.
    struct BestProfile
    {
      std::string name;    ///< empty: none fits
      bool is_own = false; ///< the scene's kernel fits as well
    };

    template <int dim>
    BestProfile best_profile(const LengthProfile &profile, const Kernel<dim> &kernel)
    {
      constexpr double fits = .02; // of the largest: bins are up to a tenth of a node wide
      constexpr double rounding = 1e-9;
      BestProfile result;
      double best = fits;
      for (const Profile &one : profiles)
        if (const double own =
                misfit(profile, [&](double r) { return one.value(r / kernel.horizon()); });
            own < best)
        {
          best = own;
          result.name = one.name;
        }
      result.is_own = misfit(profile, [&](double r) { return kernel.radial(r); }) < best + rounding;
      return result;
    }

    std::string kernel_text(const LengthProfile &profile, const BestProfile &best)
    {
      const LengthProfile::Bin &first = profile.bins.front(), &last = profile.bins.back();
      return "the ratio of weight to volume decreases with bond length " +
             (best.name.empty() ? "(from " + base::to_text(first.ratio, 3) +
                                      " at r = " + base::to_text(first.length, 3) + " to " +
                                      base::to_text(last.ratio, 3) +
                                      " at r = " + base::to_text(last.length, 3) + ")"
                                : "like " + best.name) +
             (best.is_own
                  ? ", as the scene's kernel does: the weights already contain the kernel, which "
                    "is then applied twice"
                  : ", which is not the scene's kernel but another one: the weights already "
                    "contain a kernel or influence function, and the scene's kernel is applied in "
                    "addition") +
             "; give volumes as weights, or, if the values are w C, choose --bonds-are "
             "stiffness";
    }
  } // namespace

  template <int dim>
  std::optional<Mend<dim>> kernel_in_weights(const Evidence<dim> &evidence)
  {
    constexpr std::size_t fewest = 3;
    constexpr double much = .25;      // more than weights that correct moments vary
    constexpr double very_much = .75; // of a profile that is not known
    constexpr double same = .06;      // of bonds of one length, with the slope within a bin
    const GivenBonds<dim> &given = evidence.given;
    if (evidence.rule)
      return {};
    const LengthProfile profile = length_profile(given);
    if (profile.bins.size() < fewest || profile.variation() < much || profile.scatter() > same ||
        !profile.falls())
      return {};
    const BestProfile best = best_profile(profile, given.kernel);
    if (best.name.empty() && !best.is_own && profile.variation() < very_much)
      return {};
    const double sign = profile.bins.front().ratio < 0 ? -1 : 1;
    Mend<dim> mend{{"kernel in the weights", kernel_text(profile, best)},
                   for_each_bond<dim>(
                       [&volumes = given.volumes, sign](Bond<dim> &bond, std::size_t, std::size_t j)
                       { bond.weight = sign * volumes[j]; })};
    mend.cause.is_structural = true;
    mend.changes_rule = true;
    return mend;
  }

  template <int dim>
  std::optional<Mend<dim>> own_volume(const Evidence<dim> &evidence)
  {
    constexpr double apart = .01, much_less = .25;
    const GivenBonds<dim> &given = evidence.given;
    if (evidence.rule)
      return {};
    const double to_neighbour = length_profile(given).scatter(),
                 to_own = length_profile(given, VolumeOf::node).scatter();
    if (to_neighbour < apart || to_own > much_less * to_neighbour)
      return {};
    Mend<dim> mend{
        {"own volume", "the weights are made with the volume of node i itself, not with that "
                       "of its neighbour j"},
        for_each_bond<dim>([&volumes = given.volumes](Bond<dim> &bond, std::size_t i, std::size_t j)
                           { bond.weight *= volumes[j] / volumes[i]; })};
    mend.cause.is_structural = true;
    mend.changes_rule = true;
    return mend;
  }

  template <int dim>
  std::optional<Mend<dim>> missing_at_horizon(const Evidence<dim> &evidence)
  {
    const GivenBonds<dim> &given = evidence.given;
    if (!evidence.rule || !evidence.rule->is_full_area())
      return {};
    std::vector<std::pair<std::size_t, std::size_t>> missing;
    std::size_t n = 0;
    for (std::size_t i = 0; i < given.families.size(); ++i)
      for_both(given.families[i], evidence.rule->families[i],
               [&](const Bond<dim> *own, const Bond<dim> *right, std::size_t j)
               {
                 if (!right || !is_at_horizon(given, right->xi))
                   return;
                 ++n;
                 if (!own)
                   missing.emplace_back(i, j);
               });
    if (missing.empty())
      return {};
    const bool are_all = missing.size() == n;
    Mend<dim> mend{
        {"bonds at the horizon",
         (are_all ? "all " : std::to_string(missing.size()) + " of ") + std::to_string(n) +
             " bonds as long as the horizon are left out" +
             (are_all ? ", r < horizon instead of r <= horizon" : ", as rounding decides")},
        [missing, &nodes = given.cells.nodes,
         &volumes = given.volumes](std::vector<Family<dim>> &families)
        {
          const double ratio = common_ratio(families);
          for (const auto &[i, j] : missing)
          {
            const Point<dim> xi(nodes[j] - nodes[i]);
            if (!find_bond(families[i], j))
              add_bond(families[i], j, {xi, ratio * volumes[j], xi, volumes[j]});
          }
        }};
    mend.cause.is_own_error = are_all;
    return mend;
  }

  template std::optional<Mend<2>> all_zero(const Evidence<2> &);
  template std::optional<Mend<2>> half_list(const Evidence<2> &);
  template std::optional<Mend<2>> kernel_in_weights(const Evidence<2> &);
  template std::optional<Mend<2>> own_volume(const Evidence<2> &);
  template std::optional<Mend<2>> missing_at_horizon(const Evidence<2> &);
  template std::optional<Mend<3>> all_zero(const Evidence<3> &);
  template std::optional<Mend<3>> half_list(const Evidence<3> &);
  template std::optional<Mend<3>> kernel_in_weights(const Evidence<3> &);
  template std::optional<Mend<3>> own_volume(const Evidence<3> &);
  template std::optional<Mend<3>> missing_at_horizon(const Evidence<3> &);
} // namespace plumbline::meshfree
