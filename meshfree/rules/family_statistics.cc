#include "meshfree/rules/family_statistics.h"

#include "base/number_text.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  template <int dim>
  void describe_weights(const std::vector<Bond<dim>> &family, const Fit &fit,
                        method::Diagnostics &diagnostics)
  {
    diagnostics.n_neighbours =
        std::max(diagnostics.n_neighbours, static_cast<unsigned int>(family.size()));
    for (const Bond<dim> &bond : family)
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

  template void describe_weights(const std::vector<Bond<1>> &, const Fit &, method::Diagnostics &);
  template void describe_weights(const std::vector<Bond<2>> &, const Fit &, method::Diagnostics &);
  template void describe_weights(const std::vector<Bond<3>> &, const Fit &, method::Diagnostics &);

  namespace
  {
    /// What the moments of all families say of the limit.
    template <class Bias>
    void judge_moments(method::LimitProof &limit, const Bias &bias, bool is_m_matrix)
    {
      using Answer = method::LimitProof::Answer;
      limit.mean_defect = bias.mean;
      limit.spread = bias.spread;
      if (!limit.has_wrong_moments())
      {
        limit.answer = is_m_matrix ? Answer::compatible : Answer::unknown;
        limit.reason = std::string("moments up to the second are exact in all families") +
                       (is_m_matrix ? ", and no bond coefficient is negative: consistent and stable"
                                    : ": consistent, but stability is only observed");
        return;
      }
      limit.answer = bias.is_biased ? Answer::incompatible : Answer::unknown;
      const bool is_local = std::abs(bias.mean_of_part) > 2 * std::abs(bias.mean);
      limit.reason = "second moments are off by " + base::to_percent(bias.mean) +
                     " on average over the families, in the worst component, with a spread of " +
                     base::to_percent(bias.spread) +
                     (is_local ? ", by " + base::to_percent(bias.mean_of_part) +
                                     " on average in a part of the domain"
                               : "") +
                     ", and moments up to the second by " + base::to_percent(limit.defect) +
                     " at worst";
    }
  } // namespace

  template <int dim>
  FamilyStatistics<dim>::FamilyStatistics(const geometry::NodeCells<dim> &cells,
                                          unsigned int ball_order)
      : ball_order_(ball_order)
  {
    if (cells.n_free == 0)
      return;
    Point<dim> lower = cells.nodes.front(), upper = lower;
    for (std::size_t i = 0; i < cells.n_free; ++i)
      for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], cells.nodes[i][d]);
        upper[d] = std::max(upper[d], cells.nodes[i][d]);
      }
    bias_ = {lower, upper};
  }

  template <int dim>
  void FamilyStatistics<dim>::add(const Kernel<dim> &kernel, const Point<dim> &node,
                                  const Family<dim> &family)
  {
    const auto any = [&](const auto &is) -> int
    { return std::any_of(family.bonds.begin(), family.bonds.end(), is) ? 1 : 0; };
    describe_weights(family.bonds, family.fit, weights_);
    n_families_ += 1;
    is_scalar_ = kernel.structure() == physics::Structure::scalar;
    if (!second_)
    {
      second_.emplace(kernel, 2);
      if (ball_order_ > 0)
        all_.emplace(kernel, ball_order_);
    }
    const std::vector<double> defects = second_->defects(family.bonds);
    double defect = 0;
    for (const double one : defects)
      defect = std::max(defect, std::abs(one));
    worst_defect_ = std::max(worst_defect_, defect);
    bias_.add(node, defects, family.bonds.size());
    if (all_)
    {
      ball_defect_ = std::max(ball_defect_, all_->worst_defect(family.bonds));
      area_defect_ = std::max(area_defect_, all_->area_defect(family.bonds));
    }
    n_negative_ += any([](const Bond<dim> &bond) { return bond.weight < 0; });
    n_unstable_ +=
        any([&](const Bond<dim> &bond) { return bond.weight * radial_value(kernel, bond) < 0; });
    n_dependent_ += family.fit.rank < family.fit.n_conditions ? 1 : 0;
    n_clipped_ += family.is_clipped ? 1 : 0;
  }

  template <int dim>
  method::Diagnostics
  FamilyStatistics<dim>::diagnostics(const base::Communicator &communicator) const
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
    result.limit.defect = communicator.largest(worst_defect_);
    result.limit.ball_defect = communicator.largest(ball_defect_);
    result.limit.area_defect = communicator.largest(area_defect_);
    judge_moments(result.limit, bias_.answer(communicator), is_scalar_ && total(n_unstable_) == 0);
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

  template class FamilyStatistics<2>;
  template class FamilyStatistics<3>;
} // namespace plumbline::meshfree
