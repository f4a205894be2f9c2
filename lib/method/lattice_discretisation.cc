#include "method/lattice_discretisation.h"

#include "algebra/sparse.h"
#include "method/lattice_motion.h"
#include "method/stencil_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plumbline::method
{
  namespace
  {
    /// The constraint at all positions within `margin` of the bounding box that are not free, less
    /// the middle of its range: the operator does not see a constant, but the solver's tolerance
    /// and rounding would.
    struct CollarData
    {
      std::vector<double> values; ///< 0 where nodes are free
      std::vector<double> middle; ///< of each component
    };

    CollarData collar_data(const problem::Problem<2> &problem, const geometry::NodeSet &nodes,
                           int margin)
    {
      std::vector<std::size_t> constrained; // component by component
      CollarData data{collar_values(problem, nodes, margin, &constrained), {}};
      const std::size_t n_values = data.values.size() / nodes.n_components;
      auto first = constrained.begin();
      for (unsigned int c = 0; c < nodes.n_components; ++c)
      {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        const auto last = std::lower_bound(first, constrained.end(), (c + 1) * n_values);
        for (auto place = first; place != last; ++place)
        {
          low = std::min(low, data.values[*place]);
          high = std::max(high, data.values[*place]);
        }
        data.middle.push_back(first == last ? 0 : low + (high - low) / 2);
        for (; first != last; ++first)
          data.values[*first] -= data.middle.back();
      }
      return data;
    }

    /// Solution and data together on positions -1 ... n.
    std::vector<double> merge(const geometry::NodeSet &nodes, const Vector &solution,
                              const CollarData &data, int margin)
    {
      std::vector<double> values;
      const std::size_t width = nodes.n[0] + 2 * margin, height = nodes.n[1] + 2 * margin;
      values.reserve(static_cast<std::size_t>(nodes.n_blocks()) * (nodes.n[0] + 2) *
                     (nodes.n[1] + 2));
      for (std::size_t s = 0; s < nodes.n_blocks(); ++s)
        for (int j = -1; j <= nodes.n[1]; ++j)
          for (int i = -1; i <= nodes.n[0]; ++i)
          {
            double value = data.values[(s * height + j + margin) * width + i + margin];
            if (i >= 0 && j >= 0 && i < nodes.n[0] && j < nodes.n[1])
              value += solution[(s * nodes.n[1] + j) * nodes.n[0] + i];
            values.push_back(value + data.middle[s / nodes.n_families()]);
          }
      return values;
    }
  } // namespace

  LatticeDiscretisation::LatticeDiscretisation(const problem::Problem<2> &problem,
                                               geometry::NodeSet nodes, algebra::Stencil stencil,
                                               std::vector<double> mass)
      : lattice_(*problem.lattice()), nodes_(std::move(nodes)), stencil_(std::move(stencil)),
        mass_(std::move(mass)), backend_(problem.settings.solver.operator_backend)
  {
  }

  CaseData LatticeDiscretisation::data(const problem::Problem<2> &problem) const
  {
    const int margin = stencil_.reach();
    const auto around = std::make_shared<const CollarData>(collar_data(problem, nodes_, margin));
    CaseData result;
    result.load = load(problem);
    result.load -= collar_action(stencil_, nodes_, around->values);
    result.field = [this, around, margin](const Vector &u)
    { return field(merge(nodes_, u, *around, margin)); };
    return result;
  }

  LinearEquations<2> LatticeDiscretisation::equations(const problem::Problem<2> &problem) const
  {
    StencilRows made = make_rows(stencil_, {{nodes_.n[0], nodes_.n[1], 1},
                                            nodes_.n_families(),
                                            nodes_.n_components,
                                            [&](unsigned int family, const std::array<int, 3> &at)
                                            { return nodes_.free(family, at[0], at[1]); }});
    LinearEquations<2> result;
    result.n_components = nodes_.n_components;
    result.n_free = made.n_free;
    result.rows = std::move(made.rows);
    for (const StencilRows::Node &node : made.nodes)
    {
      const auto place = nodes_.place(node.family, node.position[0], node.position[1]);
      result.nodes.push_back(lattice_.point(place[0], place[1]));
    }
    const Vector over_nodes = load(problem);
    for (const std::size_t position : algebra::free_positions(nodes_))
      result.load.push_back(over_nodes[position]);
    for (std::size_t k = result.n_free; k < result.nodes.size(); ++k)
      for (unsigned int c = 0; c < result.n_components; ++c)
        result.constraint.push_back(problem.constraint.value(result.nodes[k], c));
    if (is_collocated())
      result.volumes.assign(result.n_free, lattice_.h() * lattice_.h());
    return result;
  }

  std::unique_ptr<algebra::LinearSystem> LatticeDiscretisation::tangent() const
  {
    return std::make_unique<algebra::StencilSystem>(stencil_, nodes_, maximal_rectangles(lattice_),
                                                    backend_);
  }

  std::unique_ptr<EquationOfMotion> LatticeDiscretisation::motion(bool is_lumped) const
  {
    const algebra::Stencil mass = mass_stencil();
    const auto n = static_cast<unsigned int>(nodes_.n_families());
    const bool is_collocated = n == 1 && mass_[0] == 1; // equations at nodes
    return move_on_lattice({lattice_, nodes_, stencil_, is_lumped ? algebra::lump(mass, n) : mass,
                            backend_,
                            [this](const problem::Problem<2> &instant) { return load(instant); },
                            is_collocated ? lattice_.h() * lattice_.h() : 1});
  }

  algebra::Stencil LatticeDiscretisation::mass_stencil() const
  {
    algebra::Stencil mass(stencil_.n_blocks(), 0);
    for (unsigned int s = 0; s < mass.n_blocks(); ++s)
      mass(s, s, 0, 0) = mass_[s % nodes_.n_families()];
    return mass;
  }

  std::optional<algebra::WaveOperator> LatticeDiscretisation::waves() const
  {
    std::vector<algebra::Vector3> places;
    for (const geometry::AxisSpecies &along_y : nodes_.axis)
      for (const geometry::AxisSpecies &along_x : nodes_.axis)
        places.push_back({along_x.offset, along_y.offset});
    return algebra::WaveOperator{lattice_.h(), stencil_, mass_stencil(), nodes_.n_components,
                                 places};
  }

  DiscreteOperator make_discrete_operator(const geometry::Lattice &lattice,
                                          const geometry::NodeSet &nodes,
                                          const algebra::Stencil &stencil,
                                          const std::vector<double> &mass)
  {
    constexpr std::size_t most_entries = 20000000;
    DiscreteOperator result;
    result.n_components = nodes.n_components;
    result.nodes = free_points(lattice, nodes);
    for (unsigned int s = 0; s < nodes.n_families(); ++s)
      for (int j = 0; j < nodes.n[1]; ++j)
        for (int i = 0; i < nodes.n[0]; ++i)
          if (nodes.free(s, i, j))
            result.mass.push_back(mass[s]);
    if (stencil.n_entries() / stencil.n_blocks() * nodes.n_unknowns() <= most_entries)
      result.rows = algebra::assemble(stencil, nodes);
    if (const int reach = stencil.reach(); stencil.n_blocks() == 1)
    {
      for (int k2 = -reach; k2 <= reach; ++k2)
        for (int k1 = -reach; k1 <= reach; ++k1)
          result.second_moment -= stencil(0, 0, k1, k2) * std::pow(k1 * lattice.h(), 2) / mass[0];
      result.reach = reach * lattice.h();
    }
    result.action = algebra::restrict(make_operator(stencil, nodes), nodes.size(),
                                      algebra::free_positions(nodes));
    return result;
  }

  double expected_lattice_bytes(const ProblemSize &size, unsigned int n_families,
                                unsigned int n_components, double reach)
  {
    const double n_blocks = n_families * n_components, value = sizeof(double), bond = 48;
    // solution, data, five vectors of conjugate gradients, a sine solver or one of reflections
    const double of_unknown = n_families == 1 ? 9 * value : 38 * value;
    // a field, its modes, and half of the symbol's blocks
    const double of_mode = value * n_blocks * (2 + (n_blocks + 1) / 2);
    const bool is_in_space = size.depth > 0;
    const double n = size.extents[0] * size.extents[1] * (is_in_space ? size.depth : 1);
    const double n_padded = (size.extents[0] + 2 * reach) * (size.extents[1] + 2 * reach) *
                            (is_in_space ? size.depth + 2 * reach : 1);
    const double width = 2 * reach + 1, n_bonds = is_in_space ? 4.2 * reach : 3.2;
    return n * n_blocks * of_unknown + n_padded * of_mode +
           std::pow(width * n_blocks, 2) * (is_in_space ? width : 1) * value +
           n_bonds * reach * reach * bond;
  }

  std::vector<dealii::Point<2>> free_points(const geometry::Lattice &lattice,
                                            const geometry::NodeSet &nodes)
  {
    std::vector<dealii::Point<2>> result;
    for (unsigned int s = 0; s < nodes.n_families(); ++s)
      for (int j = 0; j < nodes.n[1]; ++j)
        for (int i = 0; i < nodes.n[0]; ++i)
          if (nodes.free(s, i, j))
          {
            const auto place = nodes.place(s, i, j);
            result.push_back(lattice.point(place[0], place[1]));
          }
    return result;
  }
} // namespace plumbline::method
