#include "meshfree/rules/family_statistics.h"

#include "base/number_text.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  void describe_weights(const std::vector<Bond> &family, const Fit &fit,
                        method::Diagnostics &diagnostics)
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

  namespace
  {
    /// Of the second moments Σ w C_ab ξ_c ξ_d and the first, times the horizon, from those of the
    /// ball, relative to the largest; and of their trace Σ w tr C |ξ|² relative to its exact value,
    /// less 1.
    std::pair<double, double> moment_defects(const Kernel<2> &kernel, const Family &family)
    {
      const unsigned int n = kernel.n_components();
      double worst = 0, largest = 0, trace = 0, exact_trace = 0;
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = a; b < n; ++b)
        {
          std::array<double, 2> first{};
          std::array<double, 3> second{}; // of ξ_1², ξ_1 ξ_2, ξ_2²
          for (const Bond &bond : family.bonds)
          {
            const double C = bond.weight * kernel_value(kernel, bond, a, b);
            const Point<2> &xi = bond.xi;
            for (unsigned int c = 0; c < 2; ++c)
              first[c] += C * xi[c];
            second[0] += C * xi[0] * xi[0];
            second[1] += C * xi[0] * xi[1];
            second[2] += C * xi[1] * xi[1];
          }
          const std::array<double, 3> exact = {kernel.moment({2, 0}, a, b),
                                               kernel.moment({1, 1}, a, b),
                                               kernel.moment({0, 2}, a, b)};
          for (unsigned int i = 0; i < 3; ++i)
          {
            worst = std::max(worst, std::abs(second[i] - exact[i]));
            largest = std::max(largest, std::abs(exact[i]));
            if (a == b && i != 1)
            {
              trace += second[i];
              exact_trace += exact[i];
            }
          }
          for (const double sum : first)
            worst = std::max(worst, std::abs(sum) * kernel.horizon());
        }
      return {worst / largest, trace / exact_trace - 1};
    }

    /// What the moments of all families say of the limit.
    void judge_moments(method::LimitProof &limit, double n_families, bool is_m_matrix)
    {
      using Answer = method::LimitProof::Answer;
      constexpr double n_errors = 3; // standard errors of the mean, to be more than chance
      if (!limit.has_wrong_moments())
      {
        limit.answer = is_m_matrix ? Answer::compatible : Answer::unknown;
        limit.reason = std::string("moments up to the second are exact in all families") +
                       (is_m_matrix ? ", and no bond coefficient is negative: consistent and stable"
                                    : ": consistent, but stability is only observed");
        return;
      }
      const bool is_biased =
          std::abs(limit.mean_defect) >
          n_errors * limit.spread / std::sqrt(n_families) + method::LimitProof::tolerance;
      limit.answer = is_biased ? Answer::incompatible : Answer::unknown;
      limit.reason = "second moments are off by " + base::to_percent(limit.mean_defect) +
                     " on average over the families, with a spread of " +
                     base::to_percent(limit.spread) + " and moments up to the second by " +
                     base::to_percent(limit.defect) + " at worst";
    }
  } // namespace

  void FamilyStatistics::add(const Kernel<2> &kernel, const Family &family)
  {
    const auto any = [&](const auto &is) -> int
    { return std::any_of(family.bonds.begin(), family.bonds.end(), is) ? 1 : 0; };
    describe_weights(family.bonds, family.fit, weights_);
    n_families_ += 1;
    is_scalar_ = kernel.structure() == physics::Structure::scalar;
    const auto [defect, ratio] = moment_defects(kernel, family);
    worst_defect_ = std::max(worst_defect_, defect);
    ratio_ += ratio;
    squared_ratio_ += ratio * ratio;
    n_negative_ += any([](const Bond &bond) { return bond.weight < 0; });
    n_unstable_ +=
        any([&](const Bond &bond) { return bond.weight * radial_value(kernel, bond) < 0; });
    n_dependent_ += family.fit.rank < family.fit.n_conditions ? 1 : 0;
    n_clipped_ += family.is_clipped ? 1 : 0;
  }

  method::Diagnostics FamilyStatistics::diagnostics(const base::Communicator &communicator) const
  {
    const auto total = [&](double n) { return static_cast<std::uint64_t>(communicator.sum(n)); };
    method::Diagnostics result;
    result.n_neighbours = static_cast<unsigned int>(communicator.largest(weights_.n_neighbours));
    result.smallest_weight_ratio = -communicator.largest(-weights_.smallest_weight_ratio);
    result.n_negative_weights = static_cast<unsigned int>(total(weights_.n_negative_weights));
    result.n_conditions = static_cast<unsigned int>(communicator.largest(weights_.n_conditions));
    result.rank =
        result.n_conditions -
        static_cast<unsigned int>(communicator.largest(weights_.n_conditions - weights_.rank));
    result.smallest_singular_value = -communicator.largest(-weights_.smallest_singular_value);
    const double n = communicator.sum(n_families_), mean = communicator.sum(ratio_) / n;
    result.limit.defect = communicator.largest(worst_defect_);
    result.limit.mean_defect = mean;
    result.limit.spread =
        std::sqrt(std::max(0., communicator.sum(squared_ratio_) / n - mean * mean));
    judge_moments(result.limit, n, is_scalar_ && total(n_unstable_) == 0);
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
