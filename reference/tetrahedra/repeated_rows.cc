#include "reference/tetrahedra/repeated_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using Position = std::array<int, 3>;

    /// Where unknowns are in a mesh of six tetrahedra per cube: one for each vertex, or one or four
    /// for each cell of a cube.
    class Places
    {
    public:
      Places(const geometry::CubeLattice &lattice, int n_layers, TetrahedralShapes shapes)
          : n_types_(shapes.is_continuous ? 1 : 6 * shapes.n_per_cell())
      {
        for (unsigned int d = 0; d < 3; ++d)
          n_[d] = lattice.n_cells()[d] + 2 * n_layers + (shapes.is_continuous ? 1 : 0);
      }

      const Position &n() const { return n_; }
      std::size_t n_types() const { return n_types_; }

      /// The number that TetrahedralSpace::dof_at() takes.
      std::size_t number(const Position &at, std::size_t type) const
      {
        return geometry::number_within(at, n_) * n_types_ + type;
      }

    private:
      Position n_{};
      std::size_t n_types_;
    };
  } // namespace

  RepeatedRows::RepeatedRows(const physics::Kernel<3> &kernel, double h, TetrahedralShapes shapes,
                             const FaceRule &rule, FaceRuleUse *use,
                             const std::optional<physics::Dilatation<3>> &dilatation)
      : shapes_(shapes), n_components_(kernel.n_components()),
        n_layers_(geometry::layers_within((dilatation ? 2 : 1) * kernel.horizon(), h))
  {
    const double side = shapes.is_continuous ? 2 * h : h; // with one free vertex, or six free cells
    const geometry::CubeLattice lattice(
        {{{dealii::Point<3>(), dealii::Point<3>(side, side, side)}}, {}}, h);
    const TetrahedralSpace space(
        std::make_shared<const TetrahedralMesh>(geometry::six_per_cube(lattice, n_layers_)),
        shapes);
    const Places places(lattice, n_layers_, shapes);
    const int own = n_layers_ + (shapes.is_continuous ? 1 : 0);
    FaceRule of_lattice = rule;
    of_lattice.spacing = h;
    const algebra::CsrMatrix matrix =
        assemble_by_faces(space, kernel, places.n_types(), of_lattice, use, dilatation);

    std::vector<Entry> of_dof(space.n_dofs());
    geometry::for_each_index({0, 0, 0}, places.n(),
                             [&](const Position &at)
                             {
                               for (std::size_t type = 0; type < places.n_types(); ++type)
                                 of_dof[space.dof_at(places.number(at, type))] = {
                                     {at[0] - own, at[1] - own, at[2] - own}, type, 0};
                             });
    const unsigned int n = n_components_;
    rows_.resize(n * places.n_types());
    for (std::size_t row = 0; row < rows_.size(); ++row)
      for (std::size_t k = matrix.start[row]; k < matrix.start[row + 1]; ++k)
      {
        const auto &[offset, type, _] = of_dof[matrix.column[k] / n];
        rows_[n * of_dof[row / n].type + row % n].push_back(
            {offset, n * type + matrix.column[k] % n, matrix.value[k]});
      }
    make_symmetric();
  }

  void RepeatedRows::make_symmetric()
  {
    // the entry of unknowns i and j is found from both
    std::map<std::tuple<std::size_t, Position, std::size_t>, double> values;
    for (std::size_t row = 0; row < rows_.size(); ++row)
      for (const auto &[offset, type, value] : rows_[row])
        values[{row, offset, type}] = value;
    for (std::size_t row = 0; row < rows_.size(); ++row)
      for (auto &[offset, type, value] : rows_[row])
      {
        const auto found = values.find({type, {-offset[0], -offset[1], -offset[2]}, row});
        value = .5 * (value + (found == values.end() ? 0 : found->second));
      }
  }

  algebra::CsrMatrix RepeatedRows::on(const TetrahedralSpace &space,
                                      const geometry::CubeLattice &lattice) const
  {
    const Places places(lattice, n_layers_, shapes_);
    const unsigned int n = n_components_;
    algebra::CsrMatrix matrix;
    matrix.start.push_back(0);
    std::vector<std::pair<unsigned int, double>> sorted;
    const auto add_row = [&](const Position &at, const std::vector<Entry> &row)
    {
      sorted.clear();
      for (const auto &[offset, type, value] : row)
        sorted.emplace_back(
            n * space.dof_at(places.number(
                    {at[0] + offset[0], at[1] + offset[1], at[2] + offset[2]}, type / n)) +
                type % n,
            value);
      std::sort(sorted.begin(), sorted.end());
      for (const auto &[column, value] : sorted)
      {
        matrix.column.push_back(column);
        matrix.value.push_back(value);
      }
      matrix.start.push_back(matrix.column.size());
    };
    // free unknowns are numbered in the order of their vertices and cells
    geometry::for_each_index({0, 0, 0}, places.n(),
                             [&](const Position &at)
                             {
                               for (std::size_t type = 0; type < places.n_types(); ++type)
                                 if (space.dof_at(places.number(at, type)) < space.n_free())
                                   for (unsigned int a = 0; a < n; ++a)
                                     add_row(at, rows_[n * type + a]);
                             });
    return matrix;
  }

  double RepeatedRows::difference(const RepeatedRows &other) const
  {
    std::map<std::tuple<std::size_t, Position, std::size_t>, double> changes;
    double largest = 0, worst = 0;
    for (std::size_t row = 0; row < rows_.size(); ++row)
    {
      for (const auto &[offset, type, value] : rows_[row])
      {
        changes[{row, offset, type}] += value;
        largest = std::max(largest, std::abs(value));
      }
      for (const auto &[offset, type, value] : other.rows_[row])
        changes[{row, offset, type}] -= value;
    }
    for (const auto &[place, change] : changes)
      if (!(std::abs(change) <= worst) && !std::isnan(worst)) // NaN is larger than all
        worst = std::abs(change);
    return worst / largest;
  }
} // namespace plumbline::reference
