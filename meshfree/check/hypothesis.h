#pragma once

#include "meshfree/check/bond_hypotheses.h"

#include <algorithm>
#include <functional>

// What bond_hypotheses.h tries, one by one.
namespace plumbline::meshfree
{
  /// The bonds, with the causes that are found already undone.
  template <int dim>
  struct Evidence
  {
    const GivenBonds<dim> &given;
    const std::optional<Recognised<dim>> &rule;
    const Circumstances<dim> &circumstances;
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
  template <int dim>
  struct Mend
  {
    Cause cause;
    std::function<void(std::vector<Family<dim>> &)> undo;
    Need need = Need::better;
    bool changes_rule = false; ///< another rule may be recognised once it is undone
    bool says_closer = true;   ///< its sentence ends with what it does to the moments
  };

  template <int dim>
  using Hypothesis = std::optional<Mend<dim>> (*)(const Evidence<dim> &);

  // Of the list of bonds and of each weight.
  template <int dim>
  std::optional<Mend<dim>> all_zero(const Evidence<dim> &evidence);
  template <int dim>
  std::optional<Mend<dim>> half_list(const Evidence<dim> &evidence);
  template <int dim>
  std::optional<Mend<dim>> kernel_in_weights(const Evidence<dim> &evidence);
  template <int dim>
  std::optional<Mend<dim>> own_volume(const Evidence<dim> &evidence);
  template <int dim>
  std::optional<Mend<dim>> drift(const Evidence<dim> &evidence);
  template <int dim>
  std::optional<Mend<dim>> missing_at_horizon(const Evidence<dim> &evidence);

  // Of kernel points, factors and ramps.
  template <int dim>
  std::optional<Mend<dim>> kernel_points(const Evidence<dim> &evidence);
  template <int dim>
  std::optional<Mend<dim>> kernel_at_nodes(const Evidence<dim> &evidence);
  template <int dim>
  std::optional<Mend<dim>> whole_ball(const Evidence<dim> &evidence);
  template <int dim>
  std::optional<Mend<dim>> factor_of_weights(const Evidence<dim> &evidence);
  template <int dim>
  std::optional<Mend<dim>> missing_ramp(const Evidence<dim> &evidence);

  template <int dim>
  using Change = std::function<void(Bond<dim> &bond, std::size_t node, std::size_t neighbour)>;

  /// The bond to a neighbour; null: there is none.
  template <int dim>
  const Bond<dim> *find_bond(const Family<dim> &family, std::size_t neighbour)
  {
    const auto at = std::lower_bound(family.neighbours.begin(), family.neighbours.end(), neighbour);
    return at != family.neighbours.end() && *at == neighbour
               ? &family.bonds[static_cast<std::size_t>(at - family.neighbours.begin())]
               : nullptr;
  }

  /// A mend of each bond by itself.
  template <int dim>
  std::function<void(std::vector<Family<dim>> &)> for_each_bond(Change<dim> change);

  /// Median defect of the moments of degree 1 and 2.
  template <int dim>
  double typical(const std::vector<Family<dim>> &families, const Kernel<dim> &kernel);

  /// Median of weights over the neighbours' volumes.
  template <int dim>
  double common_ratio(const std::vector<Family<dim>> &families);

  /// To be explained by a cause that leaves no other mark, a defect must shrink to a quarter of
  /// itself, or to round-off of a file.
  bool explains(double before, double after);
} // namespace plumbline::meshfree
