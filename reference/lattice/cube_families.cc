// Galerkin methods with several families of shape functions on unions of boxes in space.
#include "algebra/family_system.h"
#include "algebra/spectrum.h"
#include "geometry/maximal_boxes.h"
#include "method/limit_proof.h"
#include "method/linear_equations.h"
#include "method/linear_motion.h"
#include "method/stencil_rows.h"
#include "physics/gauss.h"
#include "reference/lattice/cube_field.h"
#include "reference/lattice/discretisation.h"
#include "reference/lattice/mass.h"
#include "reference/lattice/solid_stencil.h"

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using algebra::Vector;
    using Index = std::array<int, 3>;
    using Point = dealii::Point<3>;

    /// visit(component, family, position) within a margin around the cells, in the order of
    /// vectors.
    template <class Visit>
    void for_each_node(const geometry::CubeFamilies &nodes, int margin, const Visit &visit)
    {
      for (unsigned int c = 0; c < nodes.n_components; ++c)
        for (unsigned int family = 0; family < nodes.n_families(); ++family)
          geometry::for_each_index({-margin, -margin, -margin},
                                   {nodes.n[0] + margin, nodes.n[1] + margin, nodes.n[2] + margin},
                                   [&](const Index &at) { visit(c, family, at); });
    }

    /// Whether a node is so near to Ω that a free one or the average of a cell needs its value. A
    /// stencil of reach R couples cells at most R - 1 apart; a vertex has two cells along an axis.
    class Nearness
    {
    public:
      Nearness(const geometry::CubeLattice &lattice, const geometry::CubeFamilies &nodes, int reach)
          : nodes_(nodes), reach_(reach),
            cells_(lattice.is_box() ? std::vector<char>(lattice.size(), 1) : lattice.mask(),
                   lattice.n_cells())
      {
      }

      bool operator()(unsigned int family, const Index &at) const
      {
        geometry::CubeRange range;
        for (unsigned int d = 0; d < 3; ++d)
        {
          const bool at_vertex = nodes_.axis[nodes_.along(family)[d]].at_vertex;
          range.lower[d] = at[d] - (at_vertex ? reach_ : reach_ - 1);
          range.upper[d] = at[d] + reach_;
        }
        return cells_.in(range) > 0;
      }

    private:
      const geometry::CubeFamilies &nodes_;
      int reach_;
      geometry::CellCounts cells_;
    };

    /// The constraint around the nodes, less the middle of its range: the operator does not see a
    /// constant, but the solver's tolerance and rounding would.
    struct Surroundings
    {
      std::vector<double> values; ///< 0 where nodes are free, or Ω is far away
      std::vector<double> middle; ///< of each component
    };

    /// Values on positions -1 ... n.
    std::vector<double> merge(const geometry::CubeFamilies &nodes, const Vector &u,
                              const Surroundings &around, int margin)
    {
      const auto place = [&](unsigned int block, const Index &at, int width)
      {
        std::size_t result = block;
        for (unsigned int d = 3; d-- > 0;)
          result = result * (nodes.n[d] + 2 * width) + at[d] + width;
        return result;
      };
      std::vector<double> values;
      for_each_node(nodes, 1,
                    [&](unsigned int c, unsigned int family, const Index &at)
                    {
                      const unsigned int block = c * nodes.n_families() + family;
                      values.push_back(around.middle[c] +
                                       (nodes.free(family, at)
                                            ? u[place(block, at, 0)]
                                            : around.values[place(block, at, margin)]));
                    });
      return values;
    }

    /// The maximal boxes of cells in Ω.
    std::vector<geometry::CubeRange> covering_boxes(const geometry::CubeLattice &lattice)
    {
      return lattice.is_box() ? std::vector<geometry::CubeRange>{{{0, 0, 0}, lattice.n_cells()}}
                              : geometry::maximal_boxes(lattice.mask(), lattice.n_cells());
    }

    /// Couplings of one component between free nodes.
    algebra::CsrMatrix assemble(const algebra::Stencil &stencil,
                                const geometry::CubeFamilies &nodes)
    {
      const Index &reach = stencil.reaches();
      std::vector<unsigned int> number(nodes.is_free.size());
      unsigned int n_free = 0;
      for (std::size_t i = 0; i < number.size(); ++i)
        number[i] = nodes.is_free[i] != 0 ? n_free++ : 0;
      algebra::CsrMatrix rows;
      rows.start.assign(1, 0);
      nodes.for_each_free(
          [&](unsigned int s, const Index &at)
          {
            for (unsigned int t = 0; t < nodes.n_families(); ++t)
              geometry::for_each_index(
                  {-reach[0], -reach[1], -reach[2]}, {reach[0] + 1, reach[1] + 1, reach[2] + 1},
                  [&](const Index &k)
                  {
                    const Index there = {at[0] + k[0], at[1] + k[1], at[2] + k[2]};
                    const double value = stencil(s, t, k[0], k[1], k[2]);
                    if (value == 0 || !nodes.free(t, there))
                      return;
                    rows.column.push_back(
                        number[t * nodes.n_positions() + geometry::number_within(there, nodes.n)]);
                    rows.value.push_back(value);
                  });
            rows.start.push_back(rows.column.size());
          });
      return rows;
    }

    class GalerkinByFamilies : public method::DiscretisationInSpace,
                               public method::HasLinearEquations<3>
    {
    public:
      GalerkinByFamilies(const problem::Problem<3> &problem, const AxisShapes &shapes)
          : lattice_(problem.lattice), shapes_(shapes),
            nodes_(geometry::free_families(lattice_, shapes.families(), problem.n_components)),
            stencil_(galerkin_stencil(problem.kernel, problem.h(), shapes, problem.dilatation)),
            backend_(problem.settings.solver.operator_backend),
            limit_(method::prove_galerkin(problem))
      {
      }

      std::size_t n_unknowns() const override { return nodes_.n_components * nodes_.n_free(); }
      Data data(const problem::Problem<3> &problem) const override;
      method::LinearEquations<3> equations(const problem::Problem<3> &problem) const override;
      std::optional<algebra::WaveOperator> waves() const override;
      std::unique_ptr<method::MotionOf<3>> motion(bool is_lumped) const override;

      std::unique_ptr<algebra::LinearSystem> tangent() const override
      {
        return std::make_unique<algebra::FamilySystem>(stencil_, nodes_, covering_boxes(lattice_),
                                                       backend_);
      }

      method::Diagnostics diagnostics() const override
      {
        method::Diagnostics result;
        result.n_neighbours =
            static_cast<unsigned int>(stencil_.n_entries() / stencil_.n_blocks() - 1);
        result.limit = limit_;
        return result;
      }

    private:
      Point place(unsigned int family, const Index &at) const;
      std::vector<Point> free_points() const;
      algebra::Stencil mass_stencil() const
      {
        return reference::mass_stencil<3>(shapes_, nodes_.n_components, lattice_.h());
      }

      /// ∫ φ over the cells of its support along an axis, by Gauss's rule.
      physics::AxisFunctional load_functional(unsigned int axis, unsigned int family,
                                              int position) const;
      /// A field by the shape functions, 0 where nodes are not free.
      Vector tested(const problem::Field<3> &field) const;

      /// The constraint within a margin, 0 where nodes are free or Ω is farther than the reach.
      std::vector<double> constraint_values(const problem::Problem<3> &problem, int margin,
                                            std::vector<char> *is_given = nullptr) const;
      Surroundings surroundings(const problem::Problem<3> &problem, int margin) const;
      method::FieldInSpace field(const Vector &u, const Surroundings &around, int margin) const;

      geometry::CubeLattice lattice_;
      AxisShapes shapes_;
      geometry::CubeFamilies nodes_;
      algebra::Stencil stencil_;
      algebra::OperatorBackend backend_;
      method::LimitProof limit_;
    };

    Point GalerkinByFamilies::place(unsigned int family, const Index &at) const
    {
      Point x;
      for (unsigned int d = 0; d < 3; ++d)
        x[d] = lattice_.coordinate(d, at[d] + nodes_.axis[nodes_.along(family)[d]].offset);
      return x;
    }

    std::vector<Point> GalerkinByFamilies::free_points() const
    {
      std::vector<Point> points;
      nodes_.for_each_free([&](unsigned int family, const Index &at)
                           { points.push_back(place(family, at)); });
      return points;
    }

    physics::AxisFunctional
    GalerkinByFamilies::load_functional(unsigned int axis, unsigned int family, int position) const
    {
      constexpr unsigned int n_points = 6;
      const auto &gauss = physics::gauss(n_points);
      const double h = lattice_.h();
      physics::AxisFunctional tested;
      if (position == 0 && nodes_.axis[family].at_vertex)
        return tested; // not free
      for (const auto &part : shapes_.restrictions(family))
        for (unsigned int q = 0; q < n_points; ++q)
        {
          const double s = gauss.point(q)[0];
          tested.emplace_back(lattice_.coordinate(axis, position + part.cell + s),
                              h * gauss.weight(q) * shapes_.value(part.local, s));
        }
      return tested;
    }

    Vector GalerkinByFamilies::tested(const problem::Field<3> &field) const
    {
      Vector result(static_cast<Vector::size_type>(nodes_.size()));
      auto value = result.begin();
      for (unsigned int c = 0; c < nodes_.n_components; ++c)
        for (unsigned int family = 0; family < nodes_.n_families(); ++family)
        {
          physics::AxisFunctionals functionals;
          for (unsigned int d = 0; d < 3; ++d)
            for (int i = 0; i < nodes_.n[d]; ++i)
              functionals[d].push_back(load_functional(d, nodes_.along(family)[d], i));
          const auto first =
              nodes_.is_free.begin() + static_cast<std::ptrdiff_t>(family * nodes_.n_positions());
          const auto values = field.apply(
              c, functionals, {first, first + static_cast<std::ptrdiff_t>(nodes_.n_positions())});
          value = std::copy(values.begin(), values.end(), value);
        }
      return result;
    }

    std::vector<double> GalerkinByFamilies::constraint_values(const problem::Problem<3> &problem,
                                                              int margin,
                                                              std::vector<char> *is_given) const
    {
      const Nearness is_near(lattice_, nodes_, std::max(margin, 1));
      std::vector<double> values;
      for_each_node(nodes_, margin,
                    [&](unsigned int c, unsigned int family, const Index &at)
                    {
                      const bool is_needed = !nodes_.free(family, at) && is_near(family, at);
                      values.push_back(is_needed ? problem.constraint.value(place(family, at), c)
                                                 : 0);
                      if (is_given != nullptr)
                        is_given->push_back(is_needed ? 1 : 0);
                    });
      return values;
    }

    Surroundings GalerkinByFamilies::surroundings(const problem::Problem<3> &problem,
                                                  int margin) const
    {
      std::vector<char> is_given;
      Surroundings around{constraint_values(problem, margin, &is_given), {}};
      const std::size_t n_values = around.values.size() / nodes_.n_components;
      for (std::size_t from = 0; from < around.values.size(); from += n_values)
      {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t i = from; i < from + n_values; ++i)
          if (is_given[i] != 0)
          {
            low = std::min(low, around.values[i]);
            high = std::max(high, around.values[i]);
          }
        around.middle.push_back(low + (high - low) / 2);
        for (std::size_t i = from; i < from + n_values; ++i)
          if (is_given[i] != 0)
            around.values[i] -= around.middle.back();
      }
      return around;
    }

    method::FieldInSpace GalerkinByFamilies::field(const Vector &u, const Surroundings &around,
                                                   int margin) const
    {
      method::FieldInSpace result;
      result.nodes = free_points();
      const std::size_t n_of_component = nodes_.is_free.size();
      nodes_.for_each_free(
          [&](unsigned int family, const Index &at)
          {
            const std::size_t i =
                family * nodes_.n_positions() + geometry::number_within(at, nodes_.n);
            for (unsigned int c = 0; c < nodes_.n_components; ++c)
              result.nodal.push_back(around.middle[c] + u[c * n_of_component + i]);
          });
      const auto field =
          std::make_shared<const CubeField>(lattice_, shapes_, merge(nodes_, u, around, margin));
      result.averages = field->averages();
      result.value = [field](const Point &x, unsigned int component)
      { return field->value(x, component); };
      if (shapes_.is_continuous())
        result.gradient = [field](const Point &x, unsigned int component)
        { return field->gradient(x, component); };
      return result;
    }

    GalerkinByFamilies::Data GalerkinByFamilies::data(const problem::Problem<3> &problem) const
    {
      const int margin = stencil_.reach();
      const auto around = std::make_shared<const Surroundings>(surroundings(problem, margin));
      Data result;
      result.load = tested(problem.load);
      result.load -= collar_action(stencil_, nodes_, around->values);
      result.field = [this, around, margin](const Vector &u) { return field(u, *around, margin); };
      return result;
    }

    method::LinearEquations<3>
    GalerkinByFamilies::equations(const problem::Problem<3> &problem) const
    {
      method::StencilRows made =
          method::make_rows(stencil_, {nodes_.n, nodes_.n_families(), nodes_.n_components,
                                       [&](unsigned int family, const Index &at)
                                       { return nodes_.free(family, at); }});
      method::LinearEquations<3> result;
      result.n_components = nodes_.n_components;
      result.n_free = made.n_free;
      result.rows = std::move(made.rows);
      for (const method::StencilRows::Node &node : made.nodes)
        result.nodes.push_back(place(node.family, node.position));
      const Vector over_nodes = tested(problem.load);
      nodes_.for_each_free(
          [&](unsigned int family, const Index &at)
          {
            for (unsigned int c = 0; c < nodes_.n_components; ++c)
              result.load.push_back(
                  over_nodes[(c * nodes_.n_families() + family) * nodes_.n_positions() +
                             geometry::number_within(at, nodes_.n)]);
          });
      for (std::size_t k = made.n_free; k < result.nodes.size(); ++k)
        for (unsigned int c = 0; c < result.n_components; ++c)
          result.constraint.push_back(problem.constraint.value(result.nodes[k], c));
      return result;
    }

    std::optional<algebra::WaveOperator> GalerkinByFamilies::waves() const
    {
      std::vector<algebra::Vector3> places;
      for (unsigned int family = 0; family < nodes_.n_families(); ++family)
      {
        const auto along = nodes_.along(family);
        places.push_back({nodes_.axis[along[0]].offset, nodes_.axis[along[1]].offset,
                          nodes_.axis[along[2]].offset});
      }
      return algebra::WaveOperator{lattice_.h(), stencil_, mass_stencil(), nodes_.n_components,
                                   places};
    }

    std::unique_ptr<method::MotionOf<3>> GalerkinByFamilies::motion(bool is_lumped) const
    {
      using Instant = problem::Problem<3>;
      using State = method::SemiDiscreteMotion::State;
      const auto mass = std::make_shared<const algebra::Stencil>(
          is_lumped ? algebra::lump(mass_stencil(), nodes_.n_families()) : mass_stencil());
      const auto places = nodes_.free_places();
      const std::size_t n_nodes = nodes_.n_free();
      const auto unknowns = [places](const Vector &over_nodes)
      {
        State u;
        u.reserve(places.size());
        for (const std::size_t place : places)
          u.push_back(over_nodes[place]);
        return u;
      };
      const auto driven = [this, unknowns](const algebra::Stencil &by,
                                           const problem::Field<3> &field, const Instant &instant)
      {
        Vector result = tested(field);
        if (by.reach() > 0)
          result -= collar_action(by, nodes_, constraint_values(instant, by.reach()));
        return unknowns(result);
      };
      method::LinearParts<3> parts{
          free_points(),
          nodes_.n_components,
          {},
          method::MassRoot(assemble(*mass, nodes_), nodes_.n_components),
          algebra::restrict(algebra::make_operator(stencil_, nodes_, backend_), nodes_.size(),
                            places),
          {},
          [=](const Instant &instant) { return driven(stencil_, instant.load, instant); },
          [=](const Instant &instant) { return driven(*mass, *instant.solution, instant); },
          1};
      for (std::size_t k = 0; k < places.size(); ++k)
        parts.place.push_back(k % nodes_.n_components * n_nodes + k / nodes_.n_components);
      return method::move_linear<3>(std::move(parts));
    }
  } // namespace

  std::unique_ptr<method::DiscretisationInSpace>
  discretise_by_families(const problem::Problem<3> &problem, const AxisShapes &shapes)
  {
    return std::make_unique<GalerkinByFamilies>(problem, shapes);
  }
} // namespace plumbline::reference
