#include "meshfree/check/bond_hypotheses.h"

#include "base/number_text.h"
#include "meshfree/check/bond_check.h"
#include "meshfree/check/bond_pairs.h"
#include "meshfree/check/bond_profile.h"
#include "meshfree/check/hypothesis.h"
#include "meshfree/check/sizes.h"
#include "meshfree/check/volume_check.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    constexpr double exact = file_tolerance;

    template <int dim>
    constexpr std::array<Hypothesis<dim>, 11> hypotheses = {
        all_zero<dim>,      half_list<dim>,          kernel_in_weights<dim>, own_volume<dim>,
        kernel_points<dim>, kernel_at_nodes<dim>,    whole_ball<dim>,        factor_of_weights<dim>,
        drift<dim>,         missing_at_horizon<dim>, missing_ramp<dim>};

    std::string percent(double defect)
    {
      return defect < exact ? "nothing" : base::to_percent(defect);
    }

    std::string closer(const Cause &cause)
    {
      const auto with_worst = [](double typical, double worst)
      {
        constexpr double like = 1.05;
        return percent(typical) +
               (worst > exact && worst > like * typical ? " (worst " + percent(worst) + ")" : "");
      };
      return "; without that the moments are off by " + with_worst(cause.after, cause.worst_after) +
             " instead of " + with_worst(cause.before, cause.worst_before);
    }

    struct Defect
    {
      double typical, worst;
    };

    template <int dim>
    Defect defect_of(const std::vector<Family<dim>> &families, const Kernel<dim> &kernel)
    {
      const MomentCheck check = check_moments(families, kernel, 2);
      return {check.typical(), std::max(check.defects[0].worst.value, check.second.value)};
    }

    /// Moments of most nodes, or of the worst where most stay.
    bool is_better(const Cause &cause)
    {
      const double gain = cause.before - cause.after;
      return std::abs(gain) > exact * std::min(1., cause.before)
                 ? gain > 0
                 : cause.worst_before - cause.worst_after > exact;
    }

    /// Sets what each cause does to the moments, the others being undone.
    /// @param families  scratch: a second copy of large families would take much memory
    template <int dim>
    void weigh(const GivenBonds<dim> &given, std::vector<Family<dim>> &families,
               std::vector<Mend<dim>> &mends)
    {
      const auto undo_all_but = [&](const Mend<dim> *left)
      {
        families = given.families;
        for (const Mend<dim> &mend : mends)
          if (&mend != left)
            mend.undo(families);
        return defect_of(families, given.kernel);
      };
      const Defect after = undo_all_but(nullptr);
      for (Mend<dim> &mend : mends)
      {
        const Defect before = undo_all_but(&mend);
        mend.cause.before = before.typical;
        mend.cause.worst_before = before.worst;
        mend.cause.after = after.typical;
        mend.cause.worst_after = after.worst;
      }
    }

    /// The one place where causes are dropped whose removal does not make the moments better.
    template <int dim>
    void keep_what_helps(const GivenBonds<dim> &given, std::vector<Family<dim>> &scratch,
                         std::vector<Mend<dim>> &mends)
    {
      const auto helps = [](const Mend<dim> &mend)
      {
        return mend.need == Need::nothing || is_better(mend.cause) ||
               (mend.need == Need::not_worse && mend.cause.after <= mend.cause.before + exact);
      };
      weigh(given, scratch, mends);
      while (!std::all_of(mends.begin(), mends.end(), helps))
      { // the last one first: earlier ones leave the stronger marks
        mends.erase(std::find_if_not(mends.rbegin(), mends.rend(), helps).base() - 1);
        weigh(given, scratch, mends);
      }
    }

    /// What there is to say of a factor of the volumes.
    template <int dim>
    void add_volume_factor(double factor, double size, std::vector<Cause> &causes)
    {
      constexpr double same = 1e-3;
      if (factor == 1)
        return;
      const std::string times = base::to_text(factor, 4) + " times the " + measure<dim>() +
                                "s of their cells, " + unit_text(factor, dim, size);
      for (Cause &cause : causes)
        if (std::abs(std::abs(cause.factor) / factor - 1) < same)
        {
          cause.text = "the volumes are " + times + ", and " + cause.text;
          return;
        }
      Cause cause{"volumes", "the volumes are " + times + "; the weights do not carry that factor"};
      causes.insert(causes.begin(), cause);
    }
  } // namespace

  template <int dim>
  Explanation<dim> explain(const GivenBonds<dim> &given, const std::optional<Recognised<dim>> &rule,
                           const Circumstances<dim> &circumstances)
  {
    Explanation<dim> result{{}, rule};
    std::vector<Mend<dim>> mends;
    std::vector<Family<dim>> families = given.families;
    const GivenBonds<dim> mended{families,        given.kernel, given.cells,  given.volumes,
                                 given.precision, given.origin, given.lattice};
    for (const Hypothesis<dim> &hypothesis : hypotheses<dim>)
    {
      const bool has_factor = std::any_of(
          mends.begin(), mends.end(), [](const Mend<dim> &mend) { return mend.cause.factor != 1; });
      auto mend = hypothesis({mended, result.rule, circumstances, has_factor});
      if (!mend)
        continue;
      mend->undo(families);
      if (mend->changes_rule)
        result.rule = recognise(mended);
      mends.push_back(*mend);
      if (mend->cause.factor == 0)
        break; // of weights that are all 0 there is nothing else to say
    }
    keep_what_helps(given, families, mends);
    for (const Mend<dim> &mend : mends)
    {
      result.causes.push_back(mend.cause);
      if (mend.says_closer)
        result.causes.back().text += is_better(mend.cause)
                                         ? closer(mend.cause)
                                         : "; for this kernel the moments do not depend on it";
    }
    add_volume_factor<dim>(circumstances.volume_factor, node_size(given), result.causes);
    return result;
  }

  template <int dim>
  std::vector<Cause> find_causes(const GivenBonds<dim> &given,
                                 const std::optional<Recognised<dim>> &rule,
                                 const std::vector<std::string> &meant)
  {
    return explain(given, rule, Circumstances<dim>{meant}).causes;
  }

  template <int dim>
  std::function<void(std::vector<Family<dim>> &)> for_each_bond(Change<dim> change)
  {
    return [change = std::move(change)](std::vector<Family<dim>> &families)
    {
      for (std::size_t i = 0; i < families.size(); ++i)
        for (std::size_t k = 0; k < families[i].bonds.size(); ++k)
          change(families[i].bonds[k], i, families[i].neighbours[k]);
    };
  }

  template <int dim>
  double typical(const std::vector<Family<dim>> &families, const Kernel<dim> &kernel)
  {
    return check_moments(families, kernel, 2).typical();
  }

  template <int dim>
  double common_ratio(const std::vector<Family<dim>> &families)
  {
    std::vector<double> ratios;
    for (const Family<dim> &family : families)
      for (const Bond<dim> &bond : family.bonds)
        ratios.push_back(bond.weight / bond.area);
    return spread_of(ratios).median;
  }

  bool explains(double before, double after)
  {
    constexpr double much_closer = .25;
    return before > exact && (after < exact || after <= much_closer * before);
  }

  template Explanation<2> explain(const GivenBonds<2> &, const std::optional<Recognised<2>> &,
                                  const Circumstances<2> &);
  template std::vector<Cause> find_causes(const GivenBonds<2> &,
                                          const std::optional<Recognised<2>> &,
                                          const std::vector<std::string> &);
  template std::function<void(std::vector<Family<2>> &)> for_each_bond(Change<2>);
  template double typical(const std::vector<Family<2>> &, const Kernel<2> &);
  template double common_ratio(const std::vector<Family<2>> &);
  template Explanation<3> explain(const GivenBonds<3> &, const std::optional<Recognised<3>> &,
                                  const Circumstances<3> &);
  template std::vector<Cause> find_causes(const GivenBonds<3> &,
                                          const std::optional<Recognised<3>> &,
                                          const std::vector<std::string> &);
  template std::function<void(std::vector<Family<3>> &)> for_each_bond(Change<3>);
  template double typical(const std::vector<Family<3>> &, const Kernel<3> &);
  template double common_ratio(const std::vector<Family<3>> &);
} // namespace plumbline::meshfree
