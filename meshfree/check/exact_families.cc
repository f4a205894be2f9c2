#include "meshfree/check/exact_families.h"

#include "meshfree/check/bond_check.h"

#include <algorithm>

namespace plumbline::meshfree
{
  template <int dim>
  ExactFamilies<dim>::ExactFamilies(const GivenBonds<dim> &given)
      : is_exact_(given.families.size()), is_to_by_exact_(given.cells.size(), true)
  {
    const MomentCheck check = check_moments(given.families, given.kernel, 2);
    for (std::size_t i = 0; i < is_exact_.size(); ++i)
    {
      is_exact_[i] =
          std::max(check.defects[0].values[i], check.second_defects[i]) <= given.precision.moments;
      if (!is_exact_[i])
        for (const unsigned int j : given.families[i].neighbours)
          is_to_by_exact_[j] = false;
    }
  }

  template <int dim>
  void ExactFamilies<dim>::acquit(std::vector<Outlier<dim>> &outliers) const
  {
    outliers.erase(std::remove_if(outliers.begin(), outliers.end(),
                                  [this](const Outlier<dim> &one) { return is_right(one); }),
                   outliers.end());
  }

  template <int dim>
  bool ExactFamilies<dim>::is_right(const Outlier<dim> &one) const
  {
    switch (one.defect)
    {
    case Defect::volume:
    case Defect::kernel_point: // moments of kernels that are constant do not feel it
      return false;
    case Defect::neighbour:
      return is_to_by_exact_[one.node];
    case Defect::symmetry:
      return is_exact_[one.node] && is_exact_[one.neighbour];
    default:
      return is_exact_[one.node];
    }
  }

  template class ExactFamilies<2>;
  template class ExactFamilies<3>;
} // namespace plumbline::meshfree
