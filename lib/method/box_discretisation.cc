#include "method/box_discretisation.h"

#include "algebra/multiplier_system.h"
#include "algebra/slab_system.h"
#include "base/error.h"
#include "geometry/maximal_boxes.h"
#include "geometry/node_planes.h"
#include "method/stencil_rows.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace plumbline::method
{
  namespace
  {
    using Point = dealii::Point<3>;

    using geometry::CubeRange;

    /// Positions of a range, component by component, x fastest.
    template <class Visit>
    void for_each_position(const CubeRange &range, unsigned int n_components, const Visit &visit)
    {
      for (unsigned int c = 0; c < n_components; ++c)
        geometry::for_each_index(range.lower, range.upper,
                                 [&](const std::array<int, 3> &at) { visit(c, at); });
    }

    /// The place of a position's component in arrays over a range.
    std::size_t place_in(const CubeRange &range, std::size_t component,
                         const std::array<int, 3> &at)
    {
      std::size_t result = component;
      for (unsigned int d = 3; d-- > 0;)
        result = result * (range.upper[d] - range.lower[d]) + at[d] - range.lower[d];
      return result;
    }

    CubeRange with_margin(CubeRange range, int margin)
    {
      for (unsigned int d = 0; d < 3; ++d)
      {
        range.lower[d] -= margin;
        range.upper[d] += margin;
      }
      return range;
    }

    /// Whether a position is so near to Ω that a free node or the average of a cell needs its
    /// value.
    class Nearness
    {
    public:
      /// @param margin  the reach of the stencil, at least 1
      /// @param own     positions of this rank: those within the margin around them are asked for
      Nearness(const geometry::CubeLattice &lattice, NodePlace nodes, int margin,
               const CubeRange &own)
          // vertex p has the cells p and p + 1 on its sides; a free one has vertices of Ω around it
          : below_(nodes == NodePlace::vertices ? margin - 1 : margin), above_(margin + 1),
            first_(std::clamp(own.lower[2] - margin - below_, 0, lattice.n_cells()[2]))
      {
        if (lattice.is_box())
          return;
        const auto cells = geometry::planes_of(geometry::cell_centres(lattice),
                                               {first_, own.upper[2] + margin + above_});
        cells_.emplace(cells.is_free, cells.n);
      }

      bool operator()(const std::array<int, 3> &at) const
      {
        const int z = at[2] - first_;
        return !cells_ || cells_->in({{at[0] - below_, at[1] - below_, z - below_},
                                      {at[0] + above_, at[1] + above_, z + above_}}) > 0;
      }

    private:
      int below_, above_;
      int first_;                                 ///< plane of the cells
      std::optional<geometry::CellCounts> cells_; ///< none: Ω is a box, and all positions are near
    };

    /// The constraint around the nodes of this rank, less the middle of its range: the operator
    /// does not see a constant, but the solver's tolerance and rounding would.
    struct Surroundings
    {
      CubeRange range;            ///< of positions
      std::vector<double> values; ///< shape (n_components, range), 0 where it is not needed
      std::vector<double> middle; ///< of each component, the same on all ranks
    };

    /// @param ranks     that have other parts of it
    /// @param place     of a position
    /// @param is_given  the constraint is needed there
    template <class IsGiven>
    Surroundings surroundings(const problem::Problem<3> &problem, const CubeRange &range,
                              const base::Communicator &ranks,
                              const std::function<Point(const std::array<int, 3> &)> &place,
                              const IsGiven &is_given)
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      Surroundings around{range, {}, {}};
      around.values.resize(place_in(range, problem.n_components, range.lower));
      std::vector<double> low(problem.n_components, infinity),
          high(problem.n_components, -infinity);
      auto value = around.values.begin();
      const auto evaluate = [&](unsigned int c, const std::array<int, 3> &at)
      {
        if (is_given(at))
        {
          *value = problem.constraint.value(place(at), c);
          low[c] = std::min(low[c], *value);
          high[c] = std::max(high[c], *value);
        }
        ++value;
      };
      ranks.together([&] { for_each_position(range, problem.n_components, evaluate); });
      for (unsigned int c = 0; c < problem.n_components; ++c)
      {
        low[c] = -ranks.largest(-low[c]);
        high[c] = ranks.largest(high[c]);
        around.middle.push_back(low[c] + (high[c] - low[c]) / 2);
      }
      value = around.values.begin();
      for_each_position(range, problem.n_components,
                        [&](unsigned int c, const std::array<int, 3> &at)
                        {
                          if (is_given(at))
                            *value -= around.middle[c];
                          ++value;
                        });
      return around;
    }

    /// The positions that the cells of this rank need: the nodes at their centres or vertices, and
    /// along x and y one more on each side.
    CubeRange positions_of_cells(NodePlace nodes, const std::array<int, 3> &n,
                                 const base::Slabs::Range &planes)
    {
      const int below = nodes == NodePlace::vertices ? 1 : 0; // cell k: vertices k - 1 and k
      return {{-1, -1, planes.first - below},
              {n[0] + 1, n[1] + 1, std::max(planes.first - below, planes.second)}};
    }

    /// Solution and constraint at these positions.
    /// @param u  this rank's
    std::vector<double> merge(const geometry::BoxNodes &nodes, const base::Slabs &slabs,
                              const algebra::Vector &u, const Surroundings &around,
                              const std::function<CubeRange(unsigned int rank)> &wanted)
    {
      const CubeRange range = wanted(slabs.ranks().rank()),
                      known = {{0, 0, range.lower[2]}, {nodes.n[0], nodes.n[1], range.upper[2]}};
      const std::size_t plane_size = static_cast<std::size_t>(nodes.n[0]) * nodes.n[1];
      std::vector<double> values;
      values.reserve(place_in(range, around.middle.size(), range.lower));
      for (unsigned int c = 0; c < around.middle.size(); ++c)
      {
        const std::size_t n_own = plane_size * slabs.n_owned();
        std::vector<double> own(u.begin() + c * n_own, u.begin() + (c + 1) * n_own);
        own = slabs.fetch(own, plane_size,
                          [&](unsigned int rank) -> base::Slabs::Range {
                            return {wanted(rank).lower[2], wanted(rank).upper[2]};
                          });
        for_each_position(range, 1,
                          [&](unsigned int, const std::array<int, 3> &at)
                          {
                            values.push_back(around.middle[c] +
                                             (nodes.free(at)
                                                  ? own[place_in(known, 0, at)]
                                                  : around.values[place_in(around.range, c, at)]));
                          });
      }
      return values;
    }

    /// A solution on the cells of Ω: constant where nodes are at centres, else trilinear.
    class OnCells
    {
    public:
      /// @param slabs   of cells
      /// @param range   positions_of_cells() of this rank
      /// @param values  solution and, around it, the constraint: shape (n_components, range)
      OnCells(const geometry::CubeLattice &lattice, NodePlace nodes, const base::Slabs &slabs,
              const CubeRange &range, std::vector<double> values)
          : lattice_(lattice), slabs_(slabs), is_distributed_(slabs.ranks().n_ranks() > 1),
            range_(range), values_(std::move(values)),
            first_(nodes == NodePlace::vertices ? -1 : 0),
            n_along_(nodes == NodePlace::vertices ? 2 : 1)
      {
      }

      /// Of this rank's cells, shape (n_cells, n_components).
      std::vector<double> averages(unsigned int n_components) const
      {
        const double weight = 1. / static_cast<double>(n_along_ * n_along_ * n_along_);
        const auto &n = lattice_.n_cells();
        const auto [first, second] = slabs_.owned();
        std::vector<double> result;
        for_each_position({{0, 0, first}, {n[0], n[1], second}}, 1,
                          [&](unsigned int, const std::array<int, 3> &cell)
                          {
                            for (unsigned int c = 0; lattice_.is_inside(cell) && c < n_components;
                                 ++c)
                            {
                              double sum = 0;
                              for_each_corner([&](const std::array<int, 3> &corner)
                                              { sum += values_[at(c, cell, corner)]; });
                              result.push_back(weight * sum);
                            }
                          });
        return result;
      }

      /// @throws NumericalError  a point outside Ω
      double operator()(const Point &x, unsigned int component) const
      {
        const auto cell = cell_of(x);
        double sum = 0;
        for_each_corner_owned(cell,
                              [&](const std::array<int, 3> &corner)
                              {
                                double weight = 1;
                                for (unsigned int d = 0; d < 3 && n_along_ == 2; ++d)
                                  weight *= factor(x, cell, corner, d);
                                sum += weight * values_[at(component, cell, corner)];
                              });
        return of_owner(sum);
      }

      /// Of a trilinear function.
      /// @throws NumericalError  a point outside Ω
      dealii::Tensor<1, 3> gradient(const Point &x, unsigned int component) const
      {
        const auto cell = cell_of(x);
        dealii::Tensor<1, 3> sum;
        for_each_corner_owned(cell,
                              [&](const std::array<int, 3> &corner)
                              {
                                const double u =
                                    values_[at(component, cell, corner)] / lattice_.h();
                                for (unsigned int d = 0; d < 3; ++d)
                                {
                                  const unsigned int a = (d + 1) % 3, b = (d + 2) % 3;
                                  sum[d] += (corner[d] == 0 ? -u : u) * factor(x, cell, corner, a) *
                                            factor(x, cell, corner, b);
                                }
                              });
        for (unsigned int d = 0; d < 3; ++d)
          sum[d] = of_owner(sum[d]);
        return sum;
      }

    private:
      std::array<int, 3> cell_of(const Point &x) const
      {
        const auto cell = lattice_.cell_at(x);
        if (!cell)
        {
          std::ostringstream message;
          message << "(" << x << ") is outside the domain; take points in Domain/boxes";
          throw NumericalError(message.str());
        }
        return *cell;
      }

      /// A corner's linear function along an axis.
      double factor(const Point &x, const std::array<int, 3> &cell,
                    const std::array<int, 3> &corner, unsigned int d) const
      {
        const double s = (x[d] - lattice_.coordinate(d, cell[d])) / lattice_.h();
        return corner[d] == 0 ? 1 - s : s;
      }

      /// What the rank that owns the cell found, the others 0.
      double of_owner(double found) const
      {
        return is_distributed_ ? slabs_.ranks().sum(found) : found;
      }

      template <class Visit>
      void for_each_corner(const Visit &visit) const
      {
        geometry::for_each_index({0, 0, 0}, {n_along_, n_along_, n_along_}, visit);
      }

      template <class Visit>
      void for_each_corner_owned(const std::array<int, 3> &cell, const Visit &visit) const
      {
        if (slabs_.owns(cell[2]))
          for_each_corner(visit);
      }

      /// Of a cell's own node, or its vertices from its lower one on.
      std::size_t at(std::size_t component, const std::array<int, 3> &cell,
                     const std::array<int, 3> &corner) const
      {
        return place_in(range_, component,
                        {cell[0] + first_ + corner[0], cell[1] + first_ + corner[1],
                         cell[2] + first_ + corner[2]});
      }

      geometry::CubeLattice lattice_;
      base::Slabs slabs_; ///< of cells
      bool is_distributed_;
      CubeRange range_;
      std::vector<double> values_;
      int first_, n_along_;
    };

    /// Cells outside of Ω are blanked: ParaView neither shows them nor takes them into a range.
    void write_hidden_cells(const geometry::CubeLattice &lattice, std::ostream &out)
    {
      constexpr int hidden_cell = 32; // vtkDataSetAttributes::HIDDENCELL
      out << "<DataArray type=\"UInt8\" Name=\"vtkGhostType\" format=\"ascii\">\n";
      for (const char is_inside : lattice.mask())
        out << (is_inside != 0 ? 0 : hidden_cell) << '\n';
      out << "</DataArray>\n";
    }
  } // namespace

  void write_vti(const problem::Problem<3> &problem, const std::vector<double> &averages,
                 const std::string &file)
  {
    const geometry::CubeLattice &lattice = problem.lattice;
    const auto &n = lattice.n_cells();
    const unsigned int n_components = problem.n_components;
    std::ofstream out(file);
    if (!out)
      throw InputError("cannot write '" + file + "'; give a writable output folder (-o)");
    std::ostringstream extent;
    for (const int n_along : n)
      extent << "0 " << n_along << ' ';
    out.precision(std::numeric_limits<double>::max_digits10);
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\">\n"
        << "<ImageData WholeExtent=\"" << extent.str() << "\" Origin=\"" << lattice.origin()
        << "\" Spacing=\"" << lattice.h() << ' ' << lattice.h() << ' ' << lattice.h()
        << "\">\n<Piece Extent=\"" << extent.str() << "\">\n<CellData>\n"
        << "<DataArray type=\"Float64\" Name=\"u\" NumberOfComponents=\"" << n_components
        << "\" format=\"ascii\">\n";
    auto average = averages.begin();
    for_each_position({{}, n}, 1,
                      [&](unsigned int, const std::array<int, 3> &cell)
                      {
                        for (unsigned int c = 0; c < n_components; ++c)
                          out << (lattice.is_inside(cell) ? *average++ : 0.)
                              << (c + 1 == n_components ? '\n' : ' ');
                      });
    out << "</DataArray>\n";
    if (!lattice.is_box())
      write_hidden_cells(lattice, out);
    out << "</CellData>\n</Piece>\n</ImageData>\n</VTKFile>\n";
    if (!out.flush())
      throw InputError("cannot write all of '" + file +
                       "'; free some space, or give another output folder (-o)");
  }

  BoxDiscretisation::BoxDiscretisation(const problem::Problem<3> &problem, NodePlace nodes,
                                       algebra::Stencil stencil)
      : lattice_(problem.lattice), node_place_(nodes),
        nodes_(nodes == NodePlace::vertices ? geometry::inner_vertices(lattice_)
                                            : geometry::cell_centres(lattice_)),
        cell_slabs_(slabs_of_cells(lattice_, base::Communicator::alone())),
        node_slabs_(cell_slabs_.with_planes(nodes_.n[2])), n_components_(problem.n_components),
        stencil_(std::move(stencil)), backend_(problem.settings.solver.operator_backend)
  {
    if (nodes_.n_free() == 0)
      throw NumericalError("Domain is one cell thick everywhere, so that no vertex is free; choose "
                           "a smaller h (Study/h)");
  }

  double BoxDiscretisation::coordinate(unsigned int axis, int position) const
  {
    return lattice_.coordinate(axis, position + (node_place_ == NodePlace::vertices ? 1 : .5));
  }

  Point BoxDiscretisation::place(const std::array<int, 3> &position) const
  {
    return {coordinate(0, position[0]), coordinate(1, position[1]), coordinate(2, position[2])};
  }

  std::size_t BoxDiscretisation::n_unknowns() const
  {
    return n_components_ * nodes_.n_free();
  }

  bool BoxDiscretisation::distribute(const base::Communicator &ranks)
  {
    // FFTW has no distributed transform along a line
    const auto is_line = [](const CubeRange &box)
    { return box.upper[0] - box.lower[0] == 1 && box.upper[1] - box.lower[1] == 1; };
    const std::vector<CubeRange> boxes = nodes_.is_free.empty()
                                             ? std::vector<CubeRange>{{{}, nodes_.n}}
                                             : geometry::maximal_boxes(nodes_.is_free, nodes_.n);
    if (std::any_of(boxes.begin(), boxes.end(), is_line))
      return false;
    cell_slabs_ = slabs_of_cells(lattice_, ranks);
    node_slabs_ = cell_slabs_.with_planes(nodes_.n[2]);
    return true;
  }

  CubeRange BoxDiscretisation::own_nodes() const
  {
    const auto [first, second] = node_slabs_.owned();
    return {{0, 0, first}, {nodes_.n[0], nodes_.n[1], second}};
  }

  algebra::Vector BoxDiscretisation::tested(const problem::Field<3> &field) const
  {
    const CubeRange own = own_nodes();
    const auto is_free = geometry::planes_of(nodes_, node_slabs_.owned()).is_free;
    physics::AxisFunctionals functionals;
    for (unsigned int d = 0; d < 3; ++d)
      for (int i = own.lower[d]; i < own.upper[d]; ++i)
        functionals[d].push_back(load_functional(coordinate(d, i)));
    Vector result(static_cast<Vector::size_type>(place_in(own, n_components_, own.lower)));
    auto value = result.begin();
    node_slabs_.ranks().together(
        [&]
        {
          for (unsigned int c = 0; c < n_components_; ++c)
          {
            const auto of_component = field.apply(c, functionals, is_free);
            value = std::copy(of_component.begin(), of_component.end(), value);
          }
        });
    return result;
  }

  std::vector<double> BoxDiscretisation::constraint_values(const problem::Problem<3> &problem,
                                                           int margin) const
  {
    const Nearness is_near(lattice_, node_place_, margin, own_nodes());
    const CubeRange range = with_margin(own_nodes(), margin);
    std::vector<double> values;
    values.reserve(place_in(range, n_components_, range.lower));
    const auto evaluate = [&](unsigned int c, const std::array<int, 3> &at) {
      values.push_back(!nodes_.free(at) && is_near(at) ? problem.constraint.value(place(at), c)
                                                       : 0);
    };
    node_slabs_.ranks().together([&] { for_each_position(range, n_components_, evaluate); });
    return values;
  }

  std::vector<Point> BoxDiscretisation::free_points() const
  {
    std::vector<Point> points;
    for_each_position(own_nodes(), 1,
                      [&](unsigned int, const std::array<int, 3> &at)
                      {
                        if (nodes_.free(at))
                          points.push_back(place(at));
                      });
    return points;
  }

  BoxDiscretisation::Data BoxDiscretisation::data(const problem::Problem<3> &problem) const
  {
    const int margin = std::max(1, stencil_.reach());
    const CubeRange own = own_nodes();
    const Nearness is_near(lattice_, node_place_, margin, own);
    const auto around = std::make_shared<const Surroundings>(surroundings(
        problem, with_margin(own, margin), node_slabs_.ranks(),
        [this](const std::array<int, 3> &at) { return place(at); },
        [&](const std::array<int, 3> &at) { return !nodes_.free(at) && is_near(at); }));
    Data result;
    result.load = tested(problem.load);
    result.load -=
        collar_action(stencil_, geometry::planes_of(nodes_, node_slabs_.owned()), around->values);
    result.field = [this, own, around](const Vector &u)
    {
      FieldInSpace field;
      for_each_position(own, 1,
                        [&](unsigned int, const std::array<int, 3> &at)
                        {
                          if (!nodes_.free(at))
                            return;
                          field.nodes.push_back(place(at));
                          for (unsigned int c = 0; c < n_components_; ++c)
                            field.nodal.push_back(around->middle[c] + u[place_in(own, c, at)]);
                        });
      const auto wanted = [this](unsigned int rank)
      { return positions_of_cells(node_place_, nodes_.n, cell_slabs_.owned(rank)); };
      const auto on_cells = std::make_shared<const OnCells>(
          lattice_, node_place_, cell_slabs_, wanted(cell_slabs_.ranks().rank()),
          merge(nodes_, node_slabs_, u, *around, wanted));
      field.averages = on_cells->averages(n_components_);
      field.value = [on_cells](const Point &x, unsigned int component)
      { return (*on_cells)(x, component); };
      if (node_place_ == NodePlace::vertices)
        field.gradient = [on_cells](const Point &x, unsigned int component)
        { return on_cells->gradient(x, component); };
      return field;
    };
    return result;
  }

  LinearEquations<3> BoxDiscretisation::equations(const problem::Problem<3> &problem) const
  {
    StencilRows made = make_rows(stencil_, {nodes_.n, 1, n_components_,
                                            [&](unsigned int, const std::array<int, 3> &at)
                                            { return nodes_.free(at); }});
    LinearEquations<3> result;
    result.n_components = n_components_;
    result.n_free = made.n_free;
    result.rows = std::move(made.rows);
    for (const StencilRows::Node &node : made.nodes)
      result.nodes.push_back(place(node.position));
    const Vector over_nodes = tested(problem.load);
    for (std::size_t k = 0; k < made.n_free; ++k)
      for (unsigned int c = 0; c < n_components_; ++c)
        result.load.push_back(
            over_nodes[c * nodes_.n_positions() +
                       geometry::number_within(made.nodes[k].position, nodes_.n)]);
    for (std::size_t k = made.n_free; k < result.nodes.size(); ++k)
      for (unsigned int c = 0; c < n_components_; ++c)
        result.constraint.push_back(problem.constraint.value(result.nodes[k], c));
    if (is_collocated())
      result.volumes.assign(made.n_free, std::pow(lattice_.h(), 3));
    return result;
  }

  std::optional<algebra::WaveOperator> BoxDiscretisation::waves() const
  {
    return algebra::WaveOperator{lattice_.h(), stencil_, mass_stencil(), n_components_, {{}}};
  }

  std::unique_ptr<algebra::LinearSystem> BoxDiscretisation::tangent() const
  {
    if (node_slabs_.ranks().n_ranks() > 1)
      return std::make_unique<algebra::SlabSystem>(stencil_, nodes_, node_slabs_, backend_);
    return make_box_system(stencil_, nodes_, backend_);
  }
} // namespace plumbline::method
