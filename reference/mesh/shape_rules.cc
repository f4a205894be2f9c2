#include "reference/mesh/shape_rules.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace plumbline::reference
{
  namespace
  {
    constexpr unsigned int n_whole_rules = 7;
    /// Points of a graded rule along an axis, of the smallest parts and degree 0; two more for each
    /// doubling of the part keep the errors of all parts alike (measured).
    constexpr unsigned int n_graded = 4;

    /// Exact to degree 2 n - 1.
    dealii::Quadrature<2> gauss(unsigned int n_vertices, unsigned int n)
    {
      if (n_vertices == 4)
        return dealii::QGauss<2>(n);
      return dealii::QWitherdenVincentSimplex<2>(n);
    }

    /// Of least cost, exact to degree 2 p (at least 2).
    dealii::Quadrature<2> outer_gauss(unsigned int n_vertices, unsigned int p)
    {
      if (n_vertices == 4)
        return dealii::QGauss<2>(std::max(2u, p + 1));
      if (p <= 1)
        return dealii::Quadrature<2>(
            {Point<2>(1. / 6, 1. / 6), Point<2>(2. / 3, 1. / 6), Point<2>(1. / 6, 2. / 3)},
            std::vector<double>(3, 1. / 6));
      return dealii::QWitherdenVincentSimplex<2>(p + 1);
    }

    /// For integrands like d log d at distances d from the sides and smooth inside: n² points on
    /// axes stretched at both ends by t²(3 - 2t), for triangles with one side collapsed.
    dealii::Quadrature<2> graded_gauss(unsigned int n_vertices, unsigned int n)
    {
      const dealii::QGauss<2> gauss(n);
      auto points = gauss.get_points();
      auto weights = gauss.get_weights();
      for (std::size_t q = 0; q < points.size(); ++q)
      {
        Point<2> &x = points[q];
        for (unsigned int d = 0; d < 2; ++d)
        {
          weights[q] *= 6 * x[d] * (1 - x[d]);
          x[d] *= x[d] * (3 - 2 * x[d]);
        }
        if (n_vertices == 3)
        {
          weights[q] *= 1 - x[0];
          x[1] *= 1 - x[0];
        }
      }
      return {points, weights};
    }

    ShapeRule shape_rule(const CellShapes &shapes, const dealii::Quadrature<2> &gauss)
    {
      ShapeRule rule{gauss.get_points(), gauss.get_weights(), {}};
      rule.phi.resize(rule.unit.size() * shapes.size());
      for (std::size_t q = 0; q < rule.unit.size(); ++q)
        shapes.values(rule.unit[q], &rule.phi[q * shapes.size()]);
      return rule;
    }
  } // namespace

  PairRules pair_rules(const CellShapes &shapes, unsigned int refinement)
  {
    const unsigned int n_vertices = shapes.n_vertices(), n = shapes.size();
    PairRules rules;
    rules.outer = shape_rule(shapes, outer_gauss(n_vertices, shapes.degree()));
    rules.refined = shape_rule(shapes, gauss(n_vertices, shapes.degree() + 2));
    for (unsigned int i = 0; i <= refinement; ++i)
      rules.graded.push_back(
          shape_rule(shapes, graded_gauss(n_vertices, shapes.degree() + n_graded + 2 * i)));
    for (unsigned int i = 1; i <= n_whole_rules; ++i)
      rules.whole.push_back(shape_rule(shapes, gauss(n_vertices, i)));
    rules.integrals.assign(n, 0.);
    rules.mass.assign(n * n, 0.);
    const ShapeRule &fine = rules.whole[shapes.degree()];
    const double unit_area = n_vertices == 3 ? .5 : 1;
    for (std::size_t q = 0; q < fine.unit.size(); ++q)
      for (unsigned int a = 0; a < n; ++a)
      {
        const double value = fine.weight[q] / unit_area * fine.phi[q * n + a];
        rules.integrals[a] += value;
        for (unsigned int b = 0; b < n; ++b)
          rules.mass[a * n + b] += value * fine.phi[q * n + b];
      }
    return rules;
  }
} // namespace plumbline::reference
