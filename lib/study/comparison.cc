#include "study/comparison.h"

#include "geometry/rough_rule.h"
#include "scene/scene.h"
#include "study/motion_norms.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace plumbline::study
{
  namespace
  {
    using geometry::NodeSet;
    using Field = problem::Field<2>;
    using scene::Quantity;
    using scene::Target;

    /// Means of T_k over [x - h/2, x + h/2] around all nodes of an axis, shape (n, n_terms).
    std::vector<double> basis_means(const physics::ChebyshevField &series, unsigned int axis,
                                    const geometry::Lattice &lattice, const NodeSet &cells)
    {
      const unsigned int n_terms = series.n_terms();
      const dealii::QGauss<1> gauss(n_terms / 2 + 1);
      std::vector<double> rows;
      for (int i = 0; i < cells.n[axis]; ++i)
      {
        std::vector<double> mean(n_terms);
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const double s = i + cells.axis[0].offset - .5 + gauss.point(q)[0];
          const auto basis = series.basis(axis, lattice.origin()[axis] + lattice.h() * s);
          for (unsigned int k = 0; k < n_terms; ++k)
            mean[k] += gauss.weight(q) * basis[k];
        }
        rows.insert(rows.end(), mean.begin(), mean.end());
      }
      return rows;
    }

    /// For fields that have no series: of cells that may hold jumps and kinks.
    geometry::RoughRule rough_rule(const Field &field, std::size_t n_cells,
                                   const std::function<geometry::Polygon(std::size_t)> &cell,
                                   unsigned int component)
    {
      constexpr unsigned int degree = 11;
      return {degree, n_cells, cell,
              [&](const dealii::Point<2> &x) { return field.value(x, component); }};
    }

    /// Means over the squares around all nodes that are free, a component after the other.
    std::vector<std::vector<double>>
    quadrature_means(const Field &field, const geometry::Lattice &lattice, const NodeSet &cells)
    {
      const double h = lattice.h(), offset = cells.axis[0].offset;
      const auto square = [&](int i, int j)
      {
        const auto corners = geometry::square(lattice.point(i + offset - .5, j + offset - .5), h);
        return geometry::Polygon(corners.begin(), corners.end());
      };
      std::vector<std::vector<double>> means(cells.n_components);
      for (unsigned int c = 0; c < cells.n_components; ++c)
      {
        const auto rule = rough_rule(
            field, cells.n_positions(),
            [&](std::size_t k)
            { return square(static_cast<int>(k) % cells.n[0], static_cast<int>(k) / cells.n[0]); },
            c);
        for (int j = 0; j < cells.n[1]; ++j)
          for (int i = 0; i < cells.n[0]; ++i)
            means[c].push_back(cells.free(0, i, j)
                                   ? rule.integral(square(i, j), [&](const dealii::Point<2> &x)
                                                   { return field.value(x, c); }) /
                                         (h * h)
                                   : 0);
      }
      return means;
    }

    /// Largest and mean square of differences as they come.
    struct Accumulator
    {
      double largest = 0, squares = 0;
      void add(double difference, double measure)
      {
        largest = std::max(largest, std::abs(difference));
        squares += difference * difference * measure;
      }
    };

    using Norms = std::vector<scene::Norm>;

    void enter(std::map<std::string, double> &errors, const Norms &norms, Quantity quantity,
               Target target, const Accumulator &sum)
    {
      for (const scene::Norm norm : norms)
        if (scene::quantity(norm) == quantity)
          errors[scene::DecisiveError{norm, target}.text()] =
              scene::is_largest(norm) ? sum.largest : std::sqrt(sum.squares);
    }

    bool is_wanted(const Norms &norms, Quantity quantity)
    {
      return std::any_of(norms.begin(), norms.end(),
                         [quantity](scene::Norm norm)
                         { return scene::quantity(norm) == quantity; });
    }

    Accumulator nodal_difference(const problem::Problem<2> &problem, const Solution &solution,
                                 const Field &field)
    {
      const double area = node_area(problem, solution);
      const unsigned int n = problem.n_components;
      Accumulator sum;
      for (std::size_t i = 0; i < solution.nodes.size(); ++i)
        for (unsigned int c = 0; c < n; ++c)
          sum.add(solution.nodal[i * n + c] - field.value(solution.nodes[i], c), area);
      return sum;
    }

    std::vector<double> nodal_values(const Field &field, const std::vector<dealii::Point<2>> &nodes,
                                     unsigned int n_components)
    {
      std::vector<double> values;
      for (const dealii::Point<2> &node : nodes)
        for (unsigned int c = 0; c < n_components; ++c)
          values.push_back(field.value(node, c));
      return values;
    }

    Accumulator averages_difference(const problem::Problem<2> &problem,
                                    const std::vector<double> &a, const std::vector<double> &b)
    {
      Accumulator sum;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum.add(a[i] - b[i], cell_area(problem, i / problem.n_components));
      return sum;
    }

    /// Calls f(x, weight) with a rule on every cell of Ω.
    template <class F>
    void for_each_point(const problem::Problem<2> &problem, const dealii::Quadrature<2> &on_square,
                        unsigned int degree, const F &f)
    {
      if (problem.lattice())
      {
        const geometry::Lattice &lattice = *problem.lattice();
        const double area = lattice.h() * lattice.h();
        for (int j = 0; j < lattice.n_cells()[1]; ++j)
          for (int i = 0; i < lattice.n_cells()[0]; ++i)
            for (unsigned int q = 0; q < on_square.size() && lattice.is_inside(i, j); ++q)
              f(lattice.point(i + on_square.point(q)[0], j + on_square.point(q)[1]),
                area * on_square.weight(q));
        return;
      }
      const geometry::Mesh &mesh = *problem.mesh();
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        if (mesh.cells[cell].is_inside)
        {
          const auto rule = geometry::polygon_rule(geometry::view(mesh.polygon(cell)), degree);
          for (std::size_t q = 0; q < rule.points.size(); ++q)
            f(rule.points[q], rule.weights[q]);
        }
    }

    Accumulator field_difference(const problem::Problem<2> &problem, const Solution &solution,
                                 const Field &field)
    {
      static const dealii::QIterated<2> on_square(dealii::QGauss<1>(3), 2);
      constexpr unsigned int degree = 9;
      Accumulator sum;
      for_each_point(problem, on_square, degree,
                     [&](const dealii::Point<2> &x, double weight)
                     {
                       for (unsigned int c = 0; c < problem.n_components; ++c)
                         sum.add(solution.value(x, c) - field.value(x, c), weight);
                     });
      return sum;
    }

    /// Bounding box of Ω.
    geometry::Box bounding_box(const problem::Problem<2> &problem)
    {
      if (problem.mesh())
        return geometry::bounding_box(*problem.mesh());
      const auto &n = problem.lattice()->n_cells();
      return {problem.lattice()->origin(), problem.lattice()->point(n[0], n[1])};
    }
  } // namespace

  std::vector<double> cell_averages(const Field &field, const geometry::Lattice &lattice,
                                    const NodeSet &cells)
  {
    std::vector<std::vector<double>> means(cells.n_components);
    if (field.series)
      for (unsigned int c = 0; c < cells.n_components; ++c)
        means[c] = field.series->contract(c, basis_means(*field.series, 0, lattice, cells),
                                          basis_means(*field.series, 1, lattice, cells));
    else
      means = quadrature_means(field, lattice, cells);
    std::vector<double> result;
    result.reserve(cells.n_unknowns());
    for (int j = 0; j < cells.n[1]; ++j)
      for (int i = 0; i < cells.n[0]; ++i)
        for (unsigned int c = 0; c < cells.n_components && cells.free(0, i, j); ++c)
          result.push_back(means[c][static_cast<std::size_t>(j) * cells.n[0] + i]);
    return result;
  }

  std::vector<double> cell_averages(const Field &field, const geometry::NodeCells<2> &cells,
                                    unsigned int n_components)
  {
    constexpr unsigned int degree = 9;
    std::vector<double> result(cells.n_free * n_components);
    for (unsigned int c = 0; c < n_components; ++c)
    {
      const auto value = [&](const dealii::Point<2> &x) { return field(x, c); };
      const auto piece = [&](std::size_t i) { return cells.pieces[i]; };
      const geometry::RoughRule rule =
          field.series ? geometry::RoughRule(degree)
                       : rough_rule(field, cells.first_piece[cells.n_free], piece, c);
      for (std::size_t cell = 0; cell < cells.n_free; ++cell)
        for (std::size_t k = cells.first_piece[cell]; k < cells.first_piece[cell + 1]; ++k)
          result[cell * n_components + c] +=
              rule.integral(cells.pieces[k], value) / cells.area[cell];
    }
    return result;
  }

  std::vector<double> cell_averages(const Field &field, const problem::Problem<2> &problem)
  {
    if (problem.cells())
      return cell_averages(field, *problem.cells(), problem.n_components);
    return cell_averages(field, *problem.lattice(),
                         method::comparison_nodes(problem, problem.n_components));
  }

  double cell_area(const problem::Problem<2> &problem, std::size_t cell)
  {
    return problem.cells() ? problem.cells()->area[cell] : problem.h * problem.h;
  }

  double node_area(const problem::Problem<2> &problem, const Solution &solution)
  {
    return area_of(problem) / static_cast<double>(std::max<std::size_t>(1, solution.nodes.size()));
  }

  std::vector<dealii::Point<2>> comparison_points(const problem::Problem<2> &problem)
  {
    if (problem.cells())
      return {problem.cells()->nodes.begin(),
              problem.cells()->nodes.begin() +
                  static_cast<std::ptrdiff_t>(problem.cells()->n_free)};
    std::vector<dealii::Point<2>> points;
    const NodeSet cells = method::comparison_nodes(problem, 1);
    for (int j = 0; j < cells.n[1]; ++j)
      for (int i = 0; i < cells.n[0]; ++i)
        if (cells.free(0, i, j))
        {
          const auto place = cells.place(0, i, j);
          points.push_back(problem.lattice()->point(place[0], place[1]));
        }
    return points;
  }

  std::vector<double> coarsen_averages(const std::vector<double> &fine, const NodeSet &fine_cells,
                                       const NodeSet &cells)
  {
    const unsigned int n_components = cells.n_components;
    std::vector<std::size_t> place(fine_cells.n_positions());
    std::size_t n_before = 0;
    for (std::size_t i = 0; i < place.size(); ++i)
      place[i] = fine_cells.is_free[i] != 0 ? n_before++ : 0;

    const int first = cells.axis[0].at_vertex ? -1 : 0;
    std::vector<double> result;
    for (int j = 0; j < cells.n[1]; ++j)
      for (int i = 0; i < cells.n[0]; ++i)
        for (unsigned int c = 0; c < n_components && cells.free(0, i, j); ++c)
        {
          double sum = 0;
          for (int b = 2 * j + first; b < 2 * j + first + 2; ++b)
            for (int a = 2 * i + first; a < 2 * i + first + 2; ++a)
              sum +=
                  fine[place[static_cast<std::size_t>(b) * fine_cells.n[0] + a] * n_components + c];
          result.push_back(sum / 4);
        }
    return result;
  }

  double averages_l2(const problem::Problem<2> &problem, const std::vector<double> &a,
                     const std::vector<double> &b)
  {
    return std::sqrt(averages_difference(problem, a, b).squares);
  }

  double field_l2(const problem::Problem<2> &problem, const Values &a, const Values &b,
                  unsigned int degree)
  {
    Accumulator sum;
    for_each_point(problem, dealii::QGauss<2>(degree / 2 + 1), degree,
                   [&](const dealii::Point<2> &x, double weight)
                   {
                     for (unsigned int c = 0; c < problem.n_components; ++c)
                       sum.add(a(x, c) - b(x, c), weight);
                   });
    return std::sqrt(sum.squares);
  }

  int cells_per_block(const std::array<int, 2> &n)
  {
    constexpr int most_blocks = 32;
    const int least = (std::max(n[0], n[1]) + most_blocks - 1) / most_blocks;
    for (int size = least; size <= 2 * least; ++size)
      if (n[0] % size == 0 && n[1] % size == 0)
        return size;
    return least;
  }

  void BlockMeans::add(std::size_t block, const double *u, unsigned int n_components)
  {
    sum_[block] +=
        n_components == 1 ? *u : std::sqrt(std::inner_product(u, u + n_components, u, 0.));
    ++n_[block];
  }

  std::vector<double> BlockMeans::means(const base::Communicator &ranks) const
  {
    std::vector<double> sum = sum_, n = n_, means;
    dealii::Utilities::MPI::sum(sum, ranks.mpi, sum);
    dealii::Utilities::MPI::sum(n, ranks.mpi, n);
    for (std::size_t i = 0; i < n.size(); ++i)
      means.push_back(n[i] > 0 ? sum[i] / n[i] : std::numeric_limits<double>::quiet_NaN());
    return means;
  }

  ErrorMap error_map(scene::Norm decisive, const problem::Problem<2> &problem,
                     const Solution &solution, const std::vector<double> &reference)
  {
    ErrorMap map;
    const auto box = bounding_box(problem);
    const std::array<int, 2> n = {
        static_cast<int>(std::lround((box.upper[0] - box.lower[0]) / problem.h)),
        static_cast<int>(std::lround((box.upper[1] - box.lower[1]) / problem.h))};
    const int per_block = cells_per_block({std::max(1, n[0]), std::max(1, n[1])});
    map.h = problem.h;
    map.horizon = problem.horizon();
    map.n_x = std::max(1, (n[0] + per_block - 1) / per_block);
    map.n_y = std::max(1, (n[1] + per_block - 1) / per_block);
    map.lower = {problem.origin[0] + box.lower[0], problem.origin[1] + box.lower[1]};
    map.upper = {map.lower[0] + map.h * per_block * map.n_x,
                 map.lower[1] + map.h * per_block * map.n_y};
    map.values.assign(static_cast<std::size_t>(map.n_x) * map.n_y,
                      std::numeric_limits<double>::quiet_NaN());
    map.n_components = problem.n_components;
    // nodes on the boundary, or beyond it, belong to the last or first block
    const auto block_of = [&](const dealii::Point<2> &x)
    {
      std::array<std::size_t, 2> block{};
      for (unsigned int d = 0; d < 2; ++d)
        block[d] =
            std::min<std::size_t>(static_cast<std::size_t>(std::max(
                                      0., (x[d] - box.lower[d]) / (map.h * per_block) + 1e-9)),
                                  (d == 0 ? map.n_x : map.n_y) - 1);
      return block[1] * map.n_x + block[0];
    };
    const bool is_nodal = problem.solution && quantity(decisive) == scene::Quantity::nodal;
    map.quantity = is_nodal ? "nodal values" : "cell averages";
    const std::vector<dealii::Point<2>> points =
        is_nodal ? solution.nodes : comparison_points(problem);
    const std::vector<double> &u = is_nodal ? solution.nodal : solution.averages;
    std::vector<double> right = reference;
    if (is_nodal)
      right = nodal_values(*problem.solution, points, map.n_components);
    else if (problem.solution)
      right = cell_averages(*problem.solution, problem);
    BlockMeans means(map.values.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const std::size_t block = block_of(points[i]), first = i * map.n_components;
      means.add(block, &u[first], map.n_components);
      for (std::size_t k = first; k < first + map.n_components; ++k)
        map.values[block] = // takes the number where it is still NaN
            std::fmax(map.values[block], std::abs(u[k] - right[k]));
    }
    map.solution = means.means();
    return map;
  }

  std::map<std::string, double> errors(const Norms &norms, const problem::Problem<2> &problem,
                                       const Solution &solution, const Targets &targets)
  {
    std::map<std::string, double> result;
    const auto compare = [&](Target target, const Field &field)
    {
      if (is_wanted(norms, Quantity::nodal))
        enter(result, norms, Quantity::nodal, target, nodal_difference(problem, solution, field));
      if (is_wanted(norms, Quantity::averages))
        enter(result, norms, Quantity::averages, target,
              averages_difference(problem, solution.averages, cell_averages(field, problem)));
      if (is_wanted(norms, Quantity::field))
        enter(result, norms, Quantity::field, target, field_difference(problem, solution, field));
    };
    if (problem.solution)
      compare(Target::exact, *problem.solution);
    if (problem.local_solution)
      compare(Target::local, *problem.local_solution);
    if (!targets.local.empty())
      enter(result, norms, Quantity::averages, Target::local,
            averages_difference(problem, solution.averages, targets.local));
    if (!targets.reference.empty())
      enter(result, norms, Quantity::averages, Target::reference,
            averages_difference(problem, solution.averages, targets.reference));
    return result;
  }
} // namespace plumbline::study
