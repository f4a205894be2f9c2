#include "reference/lattice/discretisation.h"

#include "geometry/rough_rule.h"
#include "method/lattice_discretisation.h"
#include "method/limit_proof.h"
#include "method/line_discretisation.h"
#include "reference/geometry_check.h"
#include "reference/lattice/dilatation.h"
#include "reference/lattice/double_well_motion.h"
#include "reference/lattice/field.h"
#include "reference/lattice/mass.h"
#include "reference/lattice/polygonal_ball.h"
#include "reference/lattice/stencil.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/vector.h>

#include <cmath>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using algebra::Vector;
    using geometry::NodeSet;
    using geometry::Point;

    /// ∫ T_k(x) φ_s,i(x) dx for all positions i along an axis: row-major, shape (n, n_terms).
    std::vector<double> test_basis(const physics::ChebyshevField &series, unsigned int axis,
                                   const geometry::Lattice &lattice, const AxisShapes &shapes,
                                   unsigned int family)
    {
      const unsigned int n_terms = series.n_terms();
      const int n = lattice.n_cells()[axis];
      const dealii::QGauss<1> gauss((n_terms + shapes.degree()) / 2 + 1);
      std::vector<double> rows(static_cast<std::size_t>(n) * n_terms);
      for (int cell = 0; cell < n; ++cell)
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const double x = gauss.point(q)[0];
          const auto basis = series.basis(axis, lattice.origin()[axis] + lattice.h() * (cell + x));
          for (const auto &part : shapes.restrictions(family))
          {
            const int i = cell - part.cell;
            if (i < 0 || i >= n)
              continue;
            const double weight = lattice.h() * gauss.weight(q) * shapes.value(part.local, x);
            for (unsigned int k = 0; k < n_terms; ++k)
              rows[static_cast<std::size_t>(i) * n_terms + k] += weight * basis[k];
          }
        }
      return rows;
    }

    /// ∫ b φ of all families for a load without a series: Gauss points on each cell, or on parts.
    /// @param blocks  of all families, zero
    void test_by_cells(const problem::Problem<2> &problem, const AxisShapes &shapes,
                       unsigned int component, std::size_t n_positions, double *blocks)
    {
      const geometry::Lattice &lattice = *problem.lattice();
      const auto &n = lattice.n_cells();
      const double h = lattice.h();
      const auto n_axis = static_cast<unsigned int>(shapes.families().size());
      const auto f = [&](const Point<2> &x) { return problem.load(x, component); };
      const auto square = [&](int i, int j)
      {
        const auto corners = geometry::square(lattice.point(i, j), h);
        return geometry::Polygon(corners.begin(), corners.end());
      };
      const auto cell = [&](std::size_t k)
      { return square(static_cast<int>(k) % n[0], static_cast<int>(k) / n[0]); };
      const unsigned int degree = 2 * shapes.degree() + 7;
      const geometry::RoughRule rule =
          problem.load.is_smooth()
              ? geometry::RoughRule(degree)
              : geometry::RoughRule(degree, static_cast<std::size_t>(n[0]) * n[1], cell, f);
      geometry::RoughRule::Sampled sampled;
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
        {
          if (!lattice.is_inside(i, j))
            continue;
          rule.sample(square(i, j), f, sampled);
          const Point<2> corner = lattice.point(i, j);
          for (std::size_t q = 0; q < sampled.values.size(); ++q)
          {
            const double value = sampled.rule.weights[q] * sampled.values[q];
            const double s = (sampled.rule.points[q][0] - corner[0]) / h,
                         t = (sampled.rule.points[q][1] - corner[1]) / h;
            double *block = blocks;
            for (unsigned int family = 0; family < n_axis * n_axis; ++family, block += n_positions)
              for (const auto &a : shapes.restrictions(family % n_axis))
                for (const auto &b : shapes.restrictions(family / n_axis))
                  if (i - a.cell >= 0 && i - a.cell < n[0] && j - b.cell >= 0 && j - b.cell < n[1])
                    block[static_cast<std::size_t>(j - b.cell) * n[0] + i - a.cell] +=
                        value * shapes.value(a.local, s) * shapes.value(b.local, t);
          }
        }
    }

    Vector load_vector(const problem::Problem<2> &problem, const AxisShapes &shapes,
                       const NodeSet &nodes)
    {
      Vector load(nodes.size());
      const auto n_axis = static_cast<unsigned int>(nodes.axis.size());
      std::size_t block = 0;
      for (unsigned int c = 0; c < nodes.n_components; ++c)
      {
        if (!problem.load.series)
          test_by_cells(problem, shapes, c, nodes.n_positions(), load.begin() + block);
        for (unsigned int s = 0; s < nodes.n_families(); ++s, block += nodes.n_positions())
          if (problem.load.series)
          {
            const auto &series = *problem.load.series;
            const auto values =
                series.contract(c, test_basis(series, 0, *problem.lattice(), shapes, s % n_axis),
                                test_basis(series, 1, *problem.lattice(), shapes, s / n_axis));
            std::copy(values.begin(), values.end(), load.begin() + block);
          }
      }
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes.is_free[i % nodes.is_free.size()] == 0)
          load[i] = 0;
      return load;
    }

    /// @param n_sides  of the polygon that replaces the ball; 0: the ball
    algebra::Stencil make_stencil(const problem::Problem<2> &problem, const AxisShapes &shapes,
                                  unsigned int n_sides)
    {
      const double h = problem.lattice()->h();
      const geometry::Polygon polygon = inscribed_polygon(problem.horizon(), n_sides);
      const algebra::Stencil bonds = galerkin_stencil(
          problem.kernel, h, shapes, problem.settings.geometry.backend, geometry::view(polygon));
      if (!problem.dilatation)
        return bonds;
      const physics::Lame lame = problem.dilatation->material({});
      return add(bonds, dilatation_stencil(problem.dilatation->influence, lame.lambda - lame.mu, h,
                                           shapes));
    }

    /// Masses of all families, from those along an axis.
    std::vector<double> masses(const AxisShapes &shapes, double h)
    {
      const dealii::QGauss<1> gauss(shapes.degree() + 1);
      std::vector<double> squares(shapes.n_local()), along(shapes.families().size()), result;
      double sum = 0;
      for (unsigned int a = 0; a < shapes.n_local(); ++a)
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const double part = gauss.weight(q) * std::pow(shapes.value(a, gauss.point(q)[0]), 2);
          squares[a] += part;
          sum += part;
        }
      for (unsigned int s = 0; s < along.size(); ++s)
        for (const auto &part : shapes.restrictions(s))
          along[s] += squares[part.local] / sum;
      for (const double b : along)
        for (const double a : along)
          result.push_back(a * b * h * h);
      return result;
    }

    class GalerkinOnLattice : public method::LatticeDiscretisation
    {
    public:
      GalerkinOnLattice(const problem::Problem<2> &problem, const AxisShapes &shapes,
                        unsigned int n_sides)
          : LatticeDiscretisation(
                problem, free_nodes(*problem.lattice(), shapes.families(), problem.n_components),
                make_stencil(problem, shapes, n_sides), masses(shapes, problem.lattice()->h())),
            shapes_(shapes), horizon_(problem.horizon()),
            n_geometry_checks_(n_sides == 0 ? problem.settings.geometry.n_checks : 0),
            seed_(problem.settings.geometry.seed),
            cells_(method::comparison_nodes(problem, problem.n_components)),
            wells_(problem.double_well && problem.is_periodic() ? &problem : nullptr)
      {
        if (n_sides > 0)
          limit_ = limit_of_polygon(problem, n_sides);
        else if (shapes.degree() == 0)
          limit_ = method::prove_by_moments(problem, stencil(), problem.h * problem.h);
        else
          limit_ = method::prove_galerkin(problem, {});
      }

      method::DiscreteOperator matrix() const override
      {
        method::DiscreteOperator result = LatticeDiscretisation::matrix();
        result.is_collocated = false;
        return result;
      }

      std::unique_ptr<method::EquationOfMotion> motion(bool is_lumped) const override
      {
        return wells_ != nullptr ? move_wells(is_lumped, 0)
                                 : LatticeDiscretisation::motion(is_lumped);
      }

      std::unique_ptr<method::EquationOfMotion> finer_motion(bool is_lumped) const override
      {
        return wells_ != nullptr ? move_wells(is_lumped, 1) : nullptr;
      }

      method::Diagnostics diagnostics() const override
      {
        method::Diagnostics result;
        result.n_neighbours =
            static_cast<unsigned int>(stencil().n_entries() / stencil().n_blocks() - 1);
        result.limit = limit_;
        const auto check = check_geometry(horizon_, lattice().h(), n_geometry_checks_, seed_);
        result.n_geometry_checks = check.n_checked;
        result.geometry_difference = check.worst_difference;
        return result;
      }

    private:
      std::unique_ptr<method::EquationOfMotion> move_wells(bool is_lumped,
                                                           unsigned int n_more) const
      {
        algebra::WaveOperator small = *waves();
        if (is_lumped)
          small.mass = algebra::lump(small.mass, nodes().n_families());
        return move_galerkin_on_torus(*wells_, shapes_, is_lumped,
                                      algebra::Symbol(small).range().largest, n_more);
      }

      bool is_collocated() const override { return false; }

      Vector load(const problem::Problem<2> &problem) const override
      {
        return load_vector(problem, shapes_, nodes());
      }

      algebra::Stencil mass_stencil() const override
      {
        return reference::mass_stencil<2>(shapes_, nodes().n_components, lattice().h());
      }

      method::Field field(std::vector<double> values) const override
      {
        const unsigned int nc = nodes().n_components;
        const auto field =
            std::make_shared<const LatticeField>(lattice(), shapes_, nc, std::move(values));
        const auto local = [&](unsigned int family)
        { return shapes_.is_continuous() && family == 0 ? 0 : family; };
        const auto n_axis = static_cast<unsigned int>(nodes().axis.size());
        method::Field result;
        result.nodes = method::free_points(lattice(), nodes());
        for (unsigned int s = 0; s < nodes().n_families(); ++s)
          for (int j = 0; j < nodes().n[1]; ++j)
            for (int i = 0; i < nodes().n[0]; ++i)
              if (nodes().free(s, i, j))
                for (unsigned int c = 0; c < nc; ++c)
                  result.nodal.push_back(
                      field->local(c, i, j, local(s % n_axis), local(s / n_axis)));
        result.averages = field->averages(cells_);
        result.value = [field](const Point<2> &x, unsigned int c) { return field->value(x, c); };
        if (shapes_.is_continuous())
          result.gradient = [field](const Point<2> &x, unsigned int c)
          { return field->gradient(x, c); };
        result.write_vtu = [field](const std::string &file) { reference::write_vtu(*field, file); };
        return result;
      }

      AxisShapes shapes_;
      double horizon_;
      unsigned int n_geometry_checks_, seed_;
      NodeSet cells_; ///< to compare over
      const problem::Problem<2>
          *wells_; ///< double wells on a torus; the stencil is of small strains
      method::LimitProof limit_;
    };
  } // namespace

  std::unique_ptr<method::Discretisation> discretise_on_line(const problem::Problem<2> &problem,
                                                             const AxisShapes &shapes)
  {
    return std::make_unique<method::LineDiscretisation>(
        problem.lattice()->n_cells()[0] * shapes.degree(), true,
        [&problem, shapes](bool is_lumped, unsigned int n_more)
        { return move_galerkin_on_torus(problem, shapes, is_lumped, {}, n_more); });
  }

  std::unique_ptr<method::Discretisation> discretise_on_lattice(const problem::Problem<2> &problem,
                                                                const AxisShapes &shapes,
                                                                unsigned int n_sides)
  {
    return std::make_unique<GalerkinOnLattice>(problem, shapes, n_sides);
  }
} // namespace plumbline::reference
