#include "meshfree/scattered/operator.h"

#include "meshfree/scattered/damage.h"

#include <algorithm>
#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    /// The coupling of a node to one neighbour, or to itself.
    template <int dim>
    struct Block
    {
      unsigned int node;
      std::array<std::array<double, dim>, dim> entries; ///< C_ab
    };

    std::vector<double> coefficients(const problem::Problem<2> &problem)
    {
      std::vector<double> values;
      if (problem.coefficient)
        for (const Point<2> &x : problem.cells()->nodes)
          values.push_back(problem.coefficient->at(x));
      return values;
    }
  } // namespace

  template <int dim>
  algebra::CsrMatrix bond_rows(const FamilySource<dim> &families, const Kernel<dim> &kernel,
                               unsigned int n_components, std::pair<std::size_t, std::size_t> share,
                               const std::function<void(std::size_t node, const Family<dim> &family,
                                                        std::vector<double> &factors)> &factors)
  {
    algebra::CsrMatrix rows;
    rows.start.assign(share.first * n_components + 1, 0);
    Family<dim> family;
    std::vector<double> of_bonds;
    std::vector<Block<dim>> blocks;
    for (auto i = static_cast<unsigned int>(share.first); i < share.second; ++i)
    {
      families(i, family);
      of_bonds.assign(family.bonds.size(), 1);
      factors(i, family, of_bonds);
      blocks.clear();
      Block<dim> own{i, {}};
      for (std::size_t k = 0; k < family.bonds.size(); ++k)
      {
        const Bond<dim> &bond = family.bonds[k];
        const double factor = of_bonds[k] * bond.weight * radial_value(kernel, bond);
        if (factor == 0)
          continue;
        Block<dim> block{family.neighbours[k], {}};
        for (unsigned int c = 0; c < n_components; ++c)
          for (unsigned int d = 0; d < n_components; ++d)
          {
            const double entry = factor * kernel.direction_factor(c, d, bond.kernel_point);
            block.entries[c][d] = -entry;
            own.entries[c][d] += entry;
          }
        blocks.push_back(block);
      }
      blocks.insert(std::find_if(blocks.begin(), blocks.end(),
                                 [i](const Block<dim> &block) { return block.node > i; }),
                    own);
      for (unsigned int c = 0; c < n_components; ++c)
      {
        for (const Block<dim> &block : blocks)
          for (unsigned int d = 0; d < n_components; ++d)
          {
            rows.column.push_back(block.node * n_components + d);
            rows.value.push_back(block.entries[c][d]);
          }
        rows.start.push_back(rows.column.size());
      }
    }
    return rows;
  }

  template algebra::CsrMatrix
  bond_rows(const FamilySource<2> &, const Kernel<2> &, unsigned int,
            std::pair<std::size_t, std::size_t>,
            const std::function<void(std::size_t, const Family<2> &, std::vector<double> &)> &);
  template algebra::CsrMatrix
  bond_rows(const FamilySource<3> &, const Kernel<3> &, unsigned int,
            std::pair<std::size_t, std::size_t>,
            const std::function<void(std::size_t, const Family<3> &, std::vector<double> &)> &);

  ScatteredOperator scattered_operator(const FamilySource<2> &families,
                                       const problem::Problem<2> &problem,
                                       std::pair<std::size_t, std::size_t> share)
  {
    const unsigned int n_components = problem.n_components;
    const auto a = coefficients(problem);
    ScatteredOperator result;
    result.statistics = {*problem.cells(), problem.settings.ball_order};
    const BrokenBonds broken({problem.damage.cracks, {}}, *problem.cells(), problem.horizon());
    std::vector<char> is_intact;
    algebra::CsrMatrix rows =
        bond_rows<2>(families, problem.kernel, n_components, share,
                     [&](std::size_t i, const Family<2> &family, std::vector<double> &factors)
                     {
                       result.statistics.add(problem.kernel, problem.cells()->nodes[i], family);
                       if (!broken.find(i, family, is_intact))
                         check_constrained(is_intact, *problem.cells(), i);
                       for (std::size_t k = 0; k < factors.size(); ++k)
                         if (is_intact[k] == 0)
                           factors[k] = 0;
                         else if (!a.empty())
                           factors[k] = problem.coefficient->mean(a[i], a[family.neighbours[k]]);
                     });
    const std::size_t n_free = problem.cells()->n_free * n_components;
    rows.start.resize(n_free + 1, rows.column.size());
    result.rows = method::part(std::move(rows), n_free);
    return result;
  }

  ScatteredOperator scattered_operator(const Families<2> &families,
                                       const problem::Problem<2> &problem,
                                       std::pair<std::size_t, std::size_t> share)
  {
    return scattered_operator([&](std::size_t i, Family<2> &family) { families.make(i, family); },
                              problem, share);
  }
} // namespace plumbline::meshfree
