#pragma once

#include "meshfree/check/bond_hypotheses.h"

#include <functional>

// What bond_hypotheses.h tries, one by one.
namespace plumbline::meshfree
{
  /// The bonds, with the causes that are found already undone.
  struct Evidence
  {
    const GivenBonds &given;
    const std::optional<Recognised> &rule;
    const Circumstances &circumstances;
    bool has_factor = false; ///< a factor of the weights is among the causes
  };

  /// What the moments must be, once it is undone, for something to be a cause.
  enum class Need
  {
    better,
    not_worse,
    nothing ///< the scene says that it is one
  };

  /// A cause that left its mark, and how it is undone.
  struct Mend
  {
    Cause cause;
    std::function<void(std::vector<Family<2>> &)> undo;
    Need need = Need::better;
    bool changes_rule = false; ///< another rule may be recognised once it is undone
    bool says_closer = true;   ///< its sentence ends with what it does to the moments
  };

  using Hypothesis = std::optional<Mend> (*)(const Evidence &);

  // Of the list of bonds and of each weight.
  std::optional<Mend> all_zero(const Evidence &evidence);
  std::optional<Mend> half_list(const Evidence &evidence);
  std::optional<Mend> kernel_in_weights(const Evidence &evidence);
  std::optional<Mend> own_volume(const Evidence &evidence);
  std::optional<Mend> drift(const Evidence &evidence);
  std::optional<Mend> missing_at_horizon(const Evidence &evidence);

  // Of kernel points, factors and ramps.
  std::optional<Mend> kernel_points(const Evidence &evidence);
  std::optional<Mend> whole_ball(const Evidence &evidence);
  std::optional<Mend> factor_of_weights(const Evidence &evidence);
  std::optional<Mend> missing_ramp(const Evidence &evidence);

  using Change = std::function<void(Bond<2> &bond, std::size_t node, std::size_t neighbour)>;

  /// A mend of each bond by itself.
  std::function<void(std::vector<Family<2>> &)> for_each_bond(Change change);

  /// Median defect of the moments of degree 1 and 2.
  double typical(const std::vector<Family<2>> &families, const Kernel<2> &kernel);

  /// Median of weights over the neighbours' volumes.
  double common_ratio(const std::vector<Family<2>> &families);

  /// To be explained by a cause that leaves no other mark, a defect must shrink to a quarter of
  /// itself, or to round-off of a file.
  bool explains(double before, double after);
} // namespace plumbline::meshfree
