#include "method/box_discretisation.h"

#include "base/error.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

namespace plumbline::method
{
  namespace
  {
    using Point = dealii::Point<3>;

    /// Positions of nodes within a margin around them, component by component, x fastest.
    template <class Visit>
    void for_each_position(const std::array<int, 3> &n, unsigned int n_components, int margin,
                           const Visit &visit)
    {
      for (unsigned int c = 0; c < n_components; ++c)
        for (int k = -margin; k < n[2] + margin; ++k)
          for (int j = -margin; j < n[1] + margin; ++j)
            for (int i = -margin; i < n[0] + margin; ++i)
              visit(c, std::array<int, 3>{i, j, k});
    }

    bool is_free(const std::array<int, 3> &n, const std::array<int, 3> &position)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (position[d] < 0 || position[d] >= n[d])
          return false;
      return true;
    }

    /// The constraint around the nodes, less the middle of its range: the operator does not see a
    /// constant, but the solver's tolerance and rounding would.
    struct Surroundings
    {
      std::vector<double> values; ///< 0 where nodes are free
      std::vector<double> middle; ///< of each component
    };

    /// @param place  of a position
    Surroundings surroundings(const problem::Problem<3> &problem, const std::array<int, 3> &n,
                              int margin,
                              const std::function<Point(const std::array<int, 3> &)> &place)
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      Surroundings around;
      std::vector<double> low(problem.n_components, infinity),
          high(problem.n_components, -infinity);
      for_each_position(n, problem.n_components, margin,
                        [&](unsigned int c, const std::array<int, 3> &at)
                        {
                          around.values.push_back(0);
                          if (is_free(n, at))
                            return;
                          around.values.back() = problem.constraint.value(place(at), c);
                          low[c] = std::min(low[c], around.values.back());
                          high[c] = std::max(high[c], around.values.back());
                        });
      for (unsigned int c = 0; c < problem.n_components; ++c)
        around.middle.push_back(low[c] + (high[c] - low[c]) / 2);
      auto value = around.values.begin();
      for_each_position(n, problem.n_components, margin,
                        [&](unsigned int c, const std::array<int, 3> &at)
                        {
                          if (!is_free(n, at))
                            *value -= around.middle[c];
                          ++value;
                        });
      return around;
    }

    /// Solution and constraint at positions -1 ... n.
    std::vector<double> merge(const std::array<int, 3> &n, const algebra::Vector &u,
                              const Surroundings &around, int margin)
    {
      const auto index = [&](unsigned int c, const std::array<int, 3> &at, int width)
      {
        std::size_t result = c;
        for (unsigned int d = 3; d-- > 0;)
          result = result * (n[d] + 2 * width) + at[d] + width;
        return result;
      };
      std::vector<double> values;
      for_each_position(n, static_cast<unsigned int>(around.middle.size()), 1,
                        [&](unsigned int c, const std::array<int, 3> &at)
                        {
                          values.push_back(around.middle[c] +
                                           (is_free(n, at) ? u[index(c, at, 0)]
                                                           : around.values[index(c, at, margin)]));
                        });
      return values;
    }
  } // namespace

  void write_vti(const problem::Problem<3> &problem, const std::vector<double> &averages,
                 const std::string &file)
  {
    const geometry::CubeLattice &lattice = problem.lattice;
    std::ofstream out(file);
    if (!out)
      throw InputError("cannot write '" + file + "'; give a writable output folder (-o)");
    std::ostringstream extent;
    for (const int n : lattice.n_cells())
      extent << "0 " << n << ' ';
    out.precision(std::numeric_limits<double>::max_digits10);
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\">\n"
        << "<ImageData WholeExtent=\"" << extent.str() << "\" Origin=\"" << lattice.origin()
        << "\" Spacing=\"" << lattice.h() << ' ' << lattice.h() << ' ' << lattice.h()
        << "\">\n<Piece Extent=\"" << extent.str() << "\">\n<CellData>\n"
        << "<DataArray type=\"Float64\" Name=\"u\" NumberOfComponents=\"" << problem.n_components
        << "\" format=\"ascii\">\n";
    for (std::size_t i = 0; i < averages.size(); ++i)
      out << averages[i] << ((i + 1) % problem.n_components == 0 ? '\n' : ' ');
    out << "</DataArray>\n</CellData>\n</Piece>\n</ImageData>\n</VTKFile>\n";
    if (!out.flush())
      throw InputError("cannot write all of '" + file +
                       "'; free some space, or give another output folder (-o)");
  }

  BoxDiscretisation::BoxDiscretisation(const problem::Problem<3> &problem, NodePlace nodes,
                                       algebra::Stencil stencil)
      : lattice_(problem.lattice), nodes_(nodes), n_(problem.lattice.n_cells()),
        n_components_(problem.n_components), stencil_(std::move(stencil)),
        backend_(problem.settings.solver.operator_backend)
  {
    for (int &n : n_)
      if (nodes == NodePlace::vertices && --n == 0)
        throw NumericalError("the box is one cell thick, so that no vertex is free; choose a "
                             "smaller h (Study/h)");
  }

  double BoxDiscretisation::coordinate(unsigned int axis, int position) const
  {
    return lattice_.coordinate(axis, position + (nodes_ == NodePlace::vertices ? 1 : .5));
  }

  Point BoxDiscretisation::place(const std::array<int, 3> &position) const
  {
    return {coordinate(0, position[0]), coordinate(1, position[1]), coordinate(2, position[2])};
  }

  std::size_t BoxDiscretisation::n_unknowns() const
  {
    return static_cast<std::size_t>(n_components_) * n_[0] * n_[1] * n_[2];
  }

  BoxDiscretisation::Data BoxDiscretisation::data(const problem::Problem<3> &problem) const
  {
    const int margin = std::max(1, stencil_.reach());
    const auto around = std::make_shared<const Surroundings>(surroundings(
        problem, n_, margin, [this](const std::array<int, 3> &at) { return place(at); }));
    physics::AxisFunctionals functionals;
    for (unsigned int d = 0; d < 3; ++d)
      for (int i = 0; i < n_[d]; ++i)
        functionals[d].push_back(load_functional(coordinate(d, i)));
    Data result;
    result.load.reinit(static_cast<Vector::size_type>(n_unknowns()));
    auto value = result.load.begin();
    for (unsigned int c = 0; c < n_components_; ++c)
    {
      const auto tested = problem.load.apply(c, functionals);
      value = std::copy(tested.begin(), tested.end(), value);
    }
    result.load -= collar_action(stencil_, n_, around->values);
    result.field = [this, around, margin](const Vector &u)
    {
      FieldInSpace field;
      for_each_position(n_, 1, 0,
                        [&](unsigned int, const std::array<int, 3> &at)
                        { field.nodes.push_back(place(at)); });
      const std::vector<double> values = merge(n_, u, *around, margin);
      const std::size_t n = field.nodes.size();
      for (std::size_t i = 0; i < n; ++i)
        for (unsigned int c = 0; c < n_components_; ++c)
          field.nodal.push_back(around->middle[c] + u[c * n + i]);
      field.averages = averages(values);
      return field;
    };
    return result;
  }

  std::vector<double> BoxDiscretisation::averages(const std::vector<double> &values) const
  {
    // position p is at index p + 1: a cell's own node, or its vertices from its lower one on
    const std::size_t first = nodes_ == NodePlace::vertices ? 0 : 1,
                      n_along = nodes_ == NodePlace::vertices ? 2 : 1;
    const double weight = 1. / static_cast<double>(n_along * n_along * n_along);
    const std::size_t row = n_[0] + 2, layer = row * (n_[1] + 2), block = layer * (n_[2] + 2);
    std::vector<double> result;
    for_each_position(
        lattice_.n_cells(), 1, 0,
        [&](unsigned int, const std::array<int, 3> &cell)
        {
          for (unsigned int c = 0; c < n_components_; ++c)
          {
            double sum = 0;
            for (std::size_t r = first; r < first + n_along; ++r)
              for (std::size_t t = first; t < first + n_along; ++t)
                for (std::size_t s = first; s < first + n_along; ++s)
                  sum +=
                      values[c * block + (cell[2] + r) * layer + (cell[1] + t) * row + cell[0] + s];
            result.push_back(weight * sum);
          }
        });
    return result;
  }

  algebra::WaveOperator BoxDiscretisation::waves() const
  {
    return {lattice_.h(), stencil_, mass_stencil(), n_components_, {{}}};
  }

  std::unique_ptr<algebra::LinearSystem> BoxDiscretisation::tangent() const
  {
    return std::make_unique<algebra::StencilSystem>(stencil_, n_, backend_);
  }
} // namespace plumbline::method
