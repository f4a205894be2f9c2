#include "meshfree/check/probe.h"

#include "base/error.h"
#include "base/number_text.h"

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace plumbline::meshfree
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /// Of the forces on all nodes, by the displacement of a group along each axis.
    template <int dim>
    struct Derivatives
    {
      std::array<NodeVectors<dim>, dim> along;
    };

    template <int dim>
    Derivatives<dim> differentiate(const ProbePlan<dim> &plan,
                                   const std::vector<std::size_t> &group, double step,
                                   const Forces<dim> &forces)
    {
      Derivatives<dim> result;
      for (unsigned int d = 0; d < dim; ++d)
      {
        NodeVectors<dim> displacements(plan.places.size());
        const auto displace = [&](double by)
        {
          for (const std::size_t k : group)
            displacements[plan.displaced[k]][d] = by;
        };
        displace(step);
        NodeVectors<dim> &derivative = result.along[d];
        derivative = forces(displacements);
        displace(-step);
        const NodeVectors<dim> back = forces(displacements);
        for (std::size_t i = 0; i < back.size(); ++i)
          derivative[i] = (derivative[i] - back[i]) / (2 * step);
      }
      return result;
    }

    /// ∂F_i/∂u_j.
    template <int dim>
    Tensor<2, dim> block(const Derivatives<dim> &derivatives, std::size_t i)
    {
      Tensor<2, dim> result;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          result[a][b] = derivatives.along[b][i][a];
      return result;
    }

    void raise(ProbeDefect &defect, double value, std::size_t i, std::size_t j)
    {
      if (value > defect.value)
        defect = {value, i, j};
    }

    /// Forces beyond the horizon of all nodes of a group.
    template <int dim>
    void check_reach(const ProbePlan<dim> &plan, const std::vector<std::size_t> &group,
                     const Derivatives<dim> &derivatives, double largest)
    {
      std::vector<bool> is_near(plan.places.size());
      for (const std::size_t k : group)
      {
        is_near[plan.displaced[k]] = true;
        for (const std::size_t i : plan.neighbours[k])
          is_near[i] = true;
      }
      double farthest = 0;
      for (std::size_t i = 0; i < plan.places.size(); ++i)
        if (!is_near[i] && block(derivatives, i).norm() > ProbeFindings::negligible * largest)
        {
          double nearest = HUGE_VAL;
          for (const std::size_t k : group)
            nearest = std::min(nearest, plan.places[i].distance(plan.places[plan.displaced[k]]));
          farthest = std::max(farthest, nearest);
        }
      if (farthest > 0)
        throw InputError(
            "the horizon " + base::to_text(plan.settings.horizon, 6) +
            " is too small: the force on a node changes when a node at a distance of " +
            base::to_text(farthest, 6) +
            " is displaced; give a horizon of at least this distance that includes all bonds. In "
            "state-based materials forces extend to twice the horizon; they have no bond weights");
    }

    /// Σ_i ∂F_i/∂u_j over the nodes that node j reaches.
    template <int dim>
    double imbalance(const ProbePlan<dim> &plan, std::size_t k, const Derivatives<dim> &derivatives)
    {
      Tensor<2, dim> sum = block(derivatives, plan.displaced[k]);
      for (const std::size_t i : plan.neighbours[k])
        sum += block(derivatives, i);
      return sum.norm();
    }

    template <int dim>
    double difference(const ProbePlan<dim> &plan, const std::vector<std::size_t> &group,
                      const Derivatives<dim> &a, const Derivatives<dim> &b)
    {
      double result = 0;
      for (const std::size_t k : group)
        for (const std::size_t i : plan.neighbours[k])
          result = std::max(result, (block(a, i) - block(b, i)).norm());
      return result;
    }

    /// Force constants by displacements of node j, by index of j in the displaced nodes and that of
    /// i in its neighbours.
    using Columns = std::vector<std::vector<double>>;

    /// Displaces all groups.
    template <int dim>
    Columns probe_groups(const ProbePlan<dim> &plan, const Forces<dim> &forces,
                         ProbeFindings &found)
    {
      Columns columns(plan.displaced.size());
      for (const std::vector<std::size_t> &group : plan.groups)
      {
        const double step = plan.settings.step;
        const Derivatives<dim> derivatives = differentiate(plan, group, step, forces);
        for (const std::size_t k : group)
        {
          const std::size_t j = plan.displaced[k];
          for (const std::size_t i : plan.neighbours[k])
          {
            const Tensor<2, dim> stiffness = block(derivatives, i);
            const Tensor<1, dim> xi = plan.places[j] - plan.places[i], n = xi / xi.norm();
            const double along = n * (stiffness * n);
            columns[k].push_back(along);
            found.largest = std::max(found.largest, std::abs(along));
            raise(found.noncentral, (stiffness - along * outer_product(n, n)).norm(), i, j);
          }
          found.imbalance = std::max(found.imbalance, imbalance(plan, k, derivatives));
        }
        if (found.largest == 0)
          throw InputError("no force changes when nodes are displaced; make the command use the "
                           "displacements ux, uy (and uz) in {nodes}, or give a larger --step");
        check_reach(plan, group, derivatives, found.largest);
        if (&group == &plan.groups.front())
          found.nonlinearity =
              difference(plan, group, derivatives, differentiate(plan, group, .5 * step, forces));
      }
      return columns;
    }

    /// The force constant of the force on node i by node j.
    class ForceConstants
    {
    public:
      template <int dim>
      ForceConstants(const ProbePlan<dim> &plan, const Columns &columns)
          : neighbours_(plan.neighbours), columns_(columns), column_of_(plan.places.size())
      {
        for (std::size_t k = 0; k < plan.displaced.size(); ++k)
          column_of_[plan.displaced[k]] = k;
      }

      /// Nothing where node j was not displaced.
      std::optional<double> find(std::size_t i, std::size_t j) const
      {
        if (!column_of_[j])
          return {};
        const std::vector<std::size_t> &near = neighbours_[*column_of_[j]];
        const auto at = std::lower_bound(near.begin(), near.end(), i) - near.begin();
        return columns_[*column_of_[j]][static_cast<std::size_t>(at)];
      }

    private:
      const std::vector<std::vector<std::size_t>> &neighbours_;
      const Columns &columns_;
      std::vector<std::optional<std::size_t>> column_of_;
    };

    template <int dim>
    void collect_bonds(const ProbePlan<dim> &plan, const Columns &columns, ProbeFindings &found)
    {
      const ForceConstants constants(plan, columns);
      for (std::size_t k = 0; k < plan.displaced.size(); ++k)
      {
        const std::size_t i = plan.displaced[k];
        for (std::size_t l = 0; l < plan.neighbours[k].size(); ++l)
        {
          const std::size_t j = plan.neighbours[k][l];
          const double back = columns[k][l]; // on node j by node i
          const auto own = constants.find(i, j);
          if (own && i < j)
          {
            ++found.n_two_sided;
            raise(found.asymmetry, std::abs(*own - back), i, j);
          }
          if (const double value = own.value_or(back);
              std::abs(value) > ProbeFindings::negligible * found.largest)
            found.bonds.push_back({i, j, value});
        }
      }
    }
  } // namespace

  template <int dim>
  ProbeFindings probe(const ProbePlan<dim> &plan, const Forces<dim> &forces)
  {
    ProbeFindings found;
    const NodeVectors<dim> undisplaced = forces(NodeVectors<dim>(plan.places.size()));
    const Columns columns = probe_groups(plan, forces, found);
    collect_bonds(plan, columns, found);
    const double rounding = ProbeFindings::negligible * found.largest * plan.settings.step;
    for (std::size_t i = 0; i < undisplaced.size(); ++i)
      if (const double force = undisplaced[i].norm(); force > rounding)
      {
        ++found.n_loaded;
        found.loaded = force > undisplaced[found.loaded].norm() ? i : found.loaded;
      }
    for (double *const defect :
         {&found.asymmetry.value, &found.noncentral.value, &found.imbalance, &found.nonlinearity})
      *defect /= found.largest;
    return found;
  }

  template ProbeFindings probe(const ProbePlan<2> &, const Forces<2> &);
  template ProbeFindings probe(const ProbePlan<3> &, const Forces<3> &);
} // namespace plumbline::meshfree
