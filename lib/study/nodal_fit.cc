#include "study/nodal_fit.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/householder.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace plumbline::study
{
  namespace
  {
    using dealii::Point;

    constexpr unsigned int degree = 3;

    /// Of a cubic.
    template <int dim>
    constexpr unsigned int n_terms = dim == 1   ? 4
                                     : dim == 2 ? 10
                                                : 20;

    /// Nodes of a fit: three for each coefficient, so that a lattice of the plane or of space has
    /// five of them in each direction and a corner four.
    template <int dim>
    constexpr std::size_t most_nodes = 3 * n_terms<dim>;

    /// The nodes nearest to a point, the nearest first; of equal distances, that of the smaller
    /// number.
    template <int dim>
    std::vector<std::size_t> nearest(const Point<dim> &x, const std::vector<Point<dim>> &nodes)
    {
      std::vector<std::size_t> order(nodes.size());
      std::iota(order.begin(), order.end(), 0);
      const std::size_t n = std::min(most_nodes<dim>, nodes.size());
      std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n), order.end(),
                        [&](std::size_t a, std::size_t b)
                        {
                          const double of_a = x.distance_square(nodes[a]),
                                       of_b = x.distance_square(nodes[b]);
                          return of_a < of_b || (of_a == of_b && a < b);
                        });
      order.resize(n);
      return order;
    }

    /// Monomials of degree 3 at most, in the order of their number.
    template <int dim>
    std::vector<double> monomials(const dealii::Tensor<1, dim> &x)
    {
      constexpr unsigned int second = dim == 1 ? 0 : degree, last = dim < 3 ? 0 : degree;
      std::vector<double> values;
      for (unsigned int i = 0; i <= degree; ++i)
        for (unsigned int j = 0; j <= second && i + j <= degree; ++j)
          for (unsigned int k = 0; k <= last && i + j + k <= degree; ++k)
            values.push_back(std::pow(x[0], i) * std::pow(x[dim == 1 ? 0 : 1], j) *
                             std::pow(x[dim - 1], k));
      return values;
    }

    /// The value at a point of the polynomial about it, component by component.
    template <int dim>
    void add_fit(const Point<dim> &x, const std::vector<Point<dim>> &nodes,
                 const std::vector<double> &nodal, unsigned int n_components,
                 std::vector<double> &values)
    {
      constexpr double on_node = 1e-9; // of the reach: the fit would divide by zero
      const std::vector<std::size_t> near = nearest(x, nodes);
      const double reach = x.distance(nodes[near.back()]);
      if (x.distance(nodes[near.front()]) <= on_node * reach)
      {
        const double *const u = &nodal[near.front() * n_components];
        values.insert(values.end(), u, u + n_components);
        return;
      }
      dealii::FullMatrix<double> terms(near.size(), n_terms<dim>);
      dealii::Vector<double> weights(near.size()), data(near.size()), coefficients(n_terms<dim>);
      for (unsigned int k = 0; k < near.size(); ++k)
      {
        const dealii::Tensor<1, dim> at = (nodes[near[k]] - x) / reach;
        weights[k] = 1 / at.norm(); // its square weighs the squares
        const std::vector<double> of_node = monomials<dim>(at);
        for (unsigned int term = 0; term < n_terms<dim>; ++term)
          terms(k, term) = weights[k] * of_node[term];
      }
      const dealii::Householder<double> solver(terms);
      for (unsigned int c = 0; c < n_components; ++c)
      {
        for (unsigned int k = 0; k < near.size(); ++k)
          data[k] = weights[k] * nodal[near[k] * n_components + c];
        solver.least_squares(coefficients, data);
        values.push_back(coefficients[0]);
      }
    }

    template <int dim>
    std::vector<double> fit(const std::vector<Point<dim>> &points,
                            const std::vector<Point<dim>> &nodes, const std::vector<double> &nodal,
                            unsigned int n_components)
    {
      std::vector<double> values;
      for (const Point<dim> &x : points)
        if (nodes.size() < n_terms<dim>)
          values.insert(values.end(), n_components, std::numeric_limits<double>::quiet_NaN());
        else
          add_fit(x, nodes, nodal, n_components, values);
      return values;
    }
  } // namespace

  std::vector<double> values_by_fit(const std::vector<Point<1>> &points,
                                    const std::vector<Point<1>> &nodes,
                                    const std::vector<double> &nodal, unsigned int n_components)
  {
    return fit(points, nodes, nodal, n_components);
  }

  std::vector<double> values_by_fit(const std::vector<Point<2>> &points,
                                    const std::vector<Point<2>> &nodes,
                                    const std::vector<double> &nodal, unsigned int n_components)
  {
    return fit(points, nodes, nodal, n_components);
  }

  std::vector<double> values_by_fit(const std::vector<Point<3>> &points,
                                    const std::vector<Point<3>> &nodes,
                                    const std::vector<double> &nodal, unsigned int n_components)
  {
    return fit(points, nodes, nodal, n_components);
  }
} // namespace plumbline::study
