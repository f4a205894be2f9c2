#include "meshfree/scattered/operator.h"

#include "meshfree/scattered/damage.h"

#include <algorithm>
#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    /// The coupling of a node to one neighbour, or to itself.
    struct Block
    {
      unsigned int node;
      std::array<std::array<double, 2>, 2> entries; ///< C_ab
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

  ScatteredOperator scattered_operator(const FamilySource &families,
                                       const problem::Problem<2> &problem,
                                       std::pair<std::size_t, std::size_t> share)
  {
    const std::size_t n_free = problem.cells()->n_free;
    const unsigned int n_components = problem.n_components;
    const auto a = coefficients(problem);
    ScatteredOperator result;
    algebra::CsrMatrix rows; // columns of all nodes
    rows.start.assign(share.first * n_components + 1, 0);
    result.statistics = {*problem.cells(), problem.settings.ball_order};
    const BrokenBonds broken({problem.damage.cracks, {}}, *problem.cells(), problem.horizon());
    Family<2> family;
    std::vector<char> is_intact;
    std::vector<Block> blocks;
    for (auto i = static_cast<unsigned int>(share.first); i < share.second; ++i)
    {
      families(i, family);
      result.statistics.add(problem.kernel, problem.cells()->nodes[i], family);
      if (!broken.find(i, family, is_intact))
        check_constrained(is_intact, *problem.cells(), i);
      blocks.clear();
      Block own{i, {}};
      for (std::size_t k = 0; k < family.bonds.size(); ++k)
      {
        if (is_intact[k] == 0)
          continue;
        const Bond<2> &bond = family.bonds[k];
        const unsigned int j = family.neighbours[k];
        const double mean = a.empty() ? 1 : problem.coefficient->mean(a[i], a[j]);
        const double factor = mean * bond.weight * radial_value(problem.kernel, bond);
        if (factor == 0)
          continue;
        Block block{j, {}};
        for (unsigned int c = 0; c < n_components; ++c)
          for (unsigned int d = 0; d < n_components; ++d)
          {
            const double entry = factor * problem.kernel.direction_factor(c, d, bond.kernel_point);
            block.entries[c][d] = -entry;
            own.entries[c][d] += entry;
          }
        blocks.push_back(block);
      }
      blocks.insert(std::find_if(blocks.begin(), blocks.end(),
                                 [i](const Block &block) { return block.node > i; }),
                    own);
      for (unsigned int c = 0; c < n_components; ++c)
      {
        for (const Block &block : blocks)
          for (unsigned int d = 0; d < n_components; ++d)
          {
            rows.column.push_back(block.node * n_components + d);
            rows.value.push_back(block.entries[c][d]);
          }
        rows.start.push_back(rows.column.size());
      }
    }
    rows.start.resize(n_free * n_components + 1, rows.column.size());
    result.rows = method::part(std::move(rows), n_free * n_components);
    return result;
  }

  ScatteredOperator scattered_operator(const Families &families, const problem::Problem<2> &problem,
                                       std::pair<std::size_t, std::size_t> share)
  {
    return scattered_operator([&](std::size_t i, Family<2> &family) { families.make(i, family); },
                              problem, share);
  }
} // namespace plumbline::meshfree
