#include "meshfree/family_statistics.h"

#include <algorithm>

namespace plumbline::meshfree
{
  void describe_weights(const std::vector<Bond> &family, const Fit &fit,
                        study::Diagnostics &diagnostics)
  {
    diagnostics.n_neighbours =
        std::max(diagnostics.n_neighbours, static_cast<unsigned int>(family.size()));
    for (const Bond &bond : family)
    {
      diagnostics.smallest_weight_ratio =
          std::min(diagnostics.smallest_weight_ratio, bond.weight / bond.area);
      diagnostics.n_negative_weights += bond.weight < 0 ? 1 : 0;
    }
    if (diagnostics.n_conditions == 0 || fit.rank < diagnostics.rank)
      diagnostics.rank = fit.rank;
    diagnostics.n_conditions = fit.n_conditions;
    diagnostics.smallest_singular_value =
        std::min(diagnostics.smallest_singular_value, fit.smallest_singular_value);
  }

  void FamilyStatistics::add(const Kernel<2> &kernel, const Family &family)
  {
    const auto any = [&](const auto &is) -> int
    { return std::any_of(family.bonds.begin(), family.bonds.end(), is) ? 1 : 0; };
    describe_weights(family.bonds, family.fit, weights_);
    n_families_ += 1;
    n_negative_ += any([](const Bond &bond) { return bond.weight < 0; });
    n_unstable_ +=
        any([&](const Bond &bond) { return bond.weight * radial_value(kernel, bond) < 0; });
    n_dependent_ += family.fit.rank < family.fit.n_conditions ? 1 : 0;
    n_clipped_ += family.is_clipped ? 1 : 0;
  }

  study::Diagnostics FamilyStatistics::diagnostics(const base::Team &team) const
  {
    const auto total = [&](double n) { return static_cast<std::uint64_t>(team.sum(n)); };
    study::Diagnostics result;
    result.n_neighbours = static_cast<unsigned int>(team.largest(weights_.n_neighbours));
    result.smallest_weight_ratio = -team.largest(-weights_.smallest_weight_ratio);
    result.n_negative_weights = static_cast<unsigned int>(total(weights_.n_negative_weights));
    result.n_conditions = static_cast<unsigned int>(team.largest(weights_.n_conditions));
    result.rank = result.n_conditions -
                  static_cast<unsigned int>(team.largest(weights_.n_conditions - weights_.rank));
    result.smallest_singular_value = -team.largest(-weights_.smallest_singular_value);
    const std::string n_families = std::to_string(total(n_families_));
    const auto note = [&](double n, const std::string &what, const std::string &so)
    {
      if (const std::uint64_t n_concerned = total(n); n_concerned > 0)
        result.notes.push_back(what + " in " + std::to_string(n_concerned) + " of " + n_families +
                               " families" + so);
    };
    note(n_clipped_, "kernel negative at nodes beyond the horizon", ", clipped at 0");
    note(n_dependent_, "dependent moments", ", met all the same");
    note(n_negative_, "negative weights", "");
    note(n_unstable_, "negative bond coefficients",
         ": their rows are not diagonally dominant, the matrix is no M-matrix");
    return result;
  }
} // namespace plumbline::meshfree
