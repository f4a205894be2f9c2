#include "study/comparison.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::study
{
  namespace
  {
    using geometry::NodeSet;
    using scene::Field;

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

    double quadrature_mean(const Field &field, const geometry::Lattice &lattice, double s, double t,
                           unsigned int component)
    {
      static const dealii::QIterated<2> rule(dealii::QGauss<1>(6), 2);
      double mean = 0;
      for (unsigned int q = 0; q < rule.size(); ++q)
        mean += rule.weight(q) *
                field.value(lattice.point(s - .5 + rule.point(q)[0], t - .5 + rule.point(q)[1]),
                            component);
      return mean;
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

    void enter(std::map<std::string, double> &errors, const scene::Scene &scene,
               const std::string &kind, const std::string &target, const Accumulator &sum)
    {
      const auto is_wanted = [&](const std::string &norm)
      { return std::find(scene.norms.begin(), scene.norms.end(), norm) != scene.norms.end(); };
      if (is_wanted(kind + " Linf"))
        errors[kind + " Linf | " + target] = sum.largest;
      if (is_wanted(kind + " L2"))
        errors[kind + " L2 | " + target] = std::sqrt(sum.squares);
    }

    bool is_wanted(const scene::Scene &scene, const std::string &kind)
    {
      return std::any_of(scene.norms.begin(), scene.norms.end(),
                         [&](const std::string &norm)
                         { return norm.compare(0, kind.size() + 1, kind + " ") == 0; });
    }

    Accumulator nodal_difference(const Solution &solution, const Field &field, double h,
                                 unsigned int n_components)
    {
      Accumulator sum;
      for (std::size_t i = 0; i < solution.nodes.size(); ++i)
        for (unsigned int c = 0; c < n_components; ++c)
          sum.add(solution.nodal[i * n_components + c] - field.value(solution.nodes[i], c), h * h);
      return sum;
    }

    Accumulator averages_difference(const std::vector<double> &a, const std::vector<double> &b,
                                    double h)
    {
      Accumulator sum;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum.add(a[i] - b[i], h * h);
      return sum;
    }

    /// Cells along a side of a block of error maps: a divisor of both extents if there is a near
    /// one.
    int cells_per_block(const std::array<int, 2> &n)
    {
      constexpr int most_blocks = 32;
      const int least = (std::max(n[0], n[1]) + most_blocks - 1) / most_blocks;
      for (int size = least; size <= 2 * least; ++size)
        if (n[0] % size == 0 && n[1] % size == 0)
          return size;
      return least;
    }

    Accumulator field_difference(const Solution &solution, const Field &field,
                                 const geometry::Lattice &lattice, unsigned int n_components)
    {
      static const dealii::QIterated<2> rule(dealii::QGauss<1>(3), 2);
      Accumulator sum;
      const double area = lattice.h() * lattice.h();
      for (int j = 0; j < lattice.n_cells()[1]; ++j)
        for (int i = 0; i < lattice.n_cells()[0]; ++i)
          if (lattice.is_inside(i, j))
            for (unsigned int q = 0; q < rule.size(); ++q)
            {
              const auto x = lattice.point(i + rule.point(q)[0], j + rule.point(q)[1]);
              for (unsigned int c = 0; c < n_components; ++c)
                sum.add(solution.value(x, c) - field.value(x, c), area * rule.weight(q));
            }
      return sum;
    }
  } // namespace

  geometry::NodeSet comparison_nodes(const scene::Scene &scene, const geometry::Lattice &lattice,
                                     unsigned int n_components)
  {
    const geometry::AxisSpecies nodes = scene.nodes_at_vertices
                                            ? geometry::AxisSpecies{0, true, 0}
                                            : geometry::AxisSpecies{.5, false, 0};
    return free_nodes(lattice, {nodes}, n_components);
  }

  std::vector<double> cell_averages(const Field &field, const geometry::Lattice &lattice,
                                    const NodeSet &cells)
  {
    std::vector<std::vector<double>> means(cells.n_components);
    if (field.series)
      for (unsigned int c = 0; c < cells.n_components; ++c)
        means[c] = field.series->contract(c, basis_means(*field.series, 0, lattice, cells),
                                          basis_means(*field.series, 1, lattice, cells));
    std::vector<double> result;
    result.reserve(cells.n_unknowns());
    for (int j = 0; j < cells.n[1]; ++j)
      for (int i = 0; i < cells.n[0]; ++i)
        for (unsigned int c = 0; c < cells.n_components && cells.free(0, i, j); ++c)
          result.push_back(field.series ? means[c][static_cast<std::size_t>(j) * cells.n[0] + i]
                                        : quadrature_mean(field, lattice, i + cells.axis[0].offset,
                                                          j + cells.axis[0].offset, c));
    return result;
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

  double averages_l2(const std::vector<double> &a, const std::vector<double> &b, double h)
  {
    return std::sqrt(averages_difference(a, b, h).squares);
  }

  ErrorMap error_map(const scene::Scene &scene, const scene::Problem &problem,
                     const Solution &solution, const std::vector<double> &reference)
  {
    ErrorMap map;
    const geometry::Lattice &lattice = problem.lattice;
    const auto &n = lattice.n_cells();
    const int per_block = cells_per_block(n);
    map.h = lattice.h();
    map.horizon = problem.horizon();
    map.n_x = (n[0] + per_block - 1) / per_block;
    map.n_y = (n[1] + per_block - 1) / per_block;
    map.lower = {lattice.origin()[0], lattice.origin()[1]};
    map.upper = {map.lower[0] + map.h * per_block * map.n_x,
                 map.lower[1] + map.h * per_block * map.n_y};
    map.values.assign(static_cast<std::size_t>(map.n_x) * map.n_y,
                      std::numeric_limits<double>::quiet_NaN());
    const auto enter = [&](const dealii::Point<2> &x, double difference)
    {
      std::array<std::size_t, 2> block{};
      for (unsigned int d = 0; d < 2; ++d)
        // nodes on the upper boundary belong to the last block
        block[d] = std::min<std::size_t>(
            static_cast<std::size_t>((x[d] - map.lower[d]) / (map.h * per_block) + 1e-9),
            (d == 0 ? map.n_x : map.n_y) - 1);
      double &value = map.values[block[1] * map.n_x + block[0]];
      value = std::fmax(value, std::abs(difference)); // takes the number where it is still NaN
    };

    if (problem.solution && scene.decisive_error.compare(0, 5, "nodal") == 0)
    {
      map.quantity = "nodal values";
      for (std::size_t i = 0; i < solution.nodes.size(); ++i)
        for (unsigned int c = 0; c < problem.n_components; ++c)
          enter(solution.nodes[i], solution.nodal[i * problem.n_components + c] -
                                       problem.solution->value(solution.nodes[i], c));
      return map;
    }
    map.quantity = "cell averages";
    const NodeSet cells = comparison_nodes(scene, lattice, problem.n_components);
    const std::vector<double> target =
        problem.solution ? cell_averages(*problem.solution, lattice, cells) : reference;
    std::size_t index = 0;
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        for (unsigned int c = 0; c < problem.n_components && cells.free(0, i, j); ++c, ++index)
        {
          const auto place = cells.place(0, i, j);
          if (!target.empty())
            enter(lattice.point(place[0], place[1]), solution.averages[index] - target[index]);
        }
    return map;
  }

  std::map<std::string, double> errors(const scene::Scene &scene, const scene::Problem &problem,
                                       const Solution &solution,
                                       const std::vector<double> &reference)
  {
    const double h = problem.lattice.h();
    std::map<std::string, double> result;
    const auto compare = [&](const std::string &target, const Field &field)
    {
      if (is_wanted(scene, "nodal"))
        enter(result, scene, "nodal", target,
              nodal_difference(solution, field, h, problem.n_components));
      if (is_wanted(scene, "averages"))
        enter(result, scene, "averages", target,
              averages_difference(
                  solution.averages,
                  cell_averages(field, problem.lattice,
                                comparison_nodes(scene, problem.lattice, problem.n_components)),
                  h));
      if (is_wanted(scene, "field"))
        enter(result, scene, "field", target,
              field_difference(solution, field, problem.lattice, problem.n_components));
    };
    if (problem.solution)
      compare("exact", *problem.solution);
    if (problem.local_solution && scene.local_solution != "solution")
      compare("local", *problem.local_solution);
    if (!reference.empty())
      enter(result, scene, "averages", "reference",
            averages_difference(solution.averages, reference, h));
    return result;
  }
} // namespace plumbline::study
