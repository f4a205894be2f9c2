#include "problem/builder.h"

#include "base/error.h"
#include "base/number_text.h"
#include "problem/manufactured_load.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace plumbline::problem
{
  namespace
  {
    using dealii::Point;
    using Function = physics::ChebyshevField::Function;

    double size_of_cells(const Domain &domain)
    {
      if (const auto *on = std::get_if<LatticeDomain>(&domain))
        return on->lattice.h();
      if (const auto *body = std::get_if<BodyDomain>(&domain))
        return body->lattice.h;
      const auto *on = std::get_if<MeshDomain>(&domain);
      if (on->cells == nullptr)
        return 0;
      double area = 0;
      for (const double one : on->cells->area)
        area += one;
      return std::sqrt(area / static_cast<double>(on->cells->size()));
    }

    void require(bool is_right, const std::string &message)
    {
      if (!is_right)
        throw InputError(message);
    }

    void check_domain(const Problem<2> &problem)
    {
      constexpr double rounding = 1e-9;
      require(problem.lattice() != nullptr || (problem.mesh() && problem.cells()),
              "domain: it has no mesh or no cells of nodes; make it by mesh_domain or body_domain");
      require(problem.h > 0 && std::isfinite(problem.h),
              "h = " + base::to_text(problem.h, 4) +
                  " is not the size of cells; give a positive length");
      const MeshDomain *mesh = problem.on_mesh();
      require(mesh == nullptr || problem.body() != nullptr ||
                  mesh->reach >= problem.reach() * (1 - rounding),
              "domain: the interaction domain is known to be " +
                  base::to_text(mesh != nullptr ? mesh->reach : 0, 4) + " wide, but " +
                  (problem.dilatation ? "bonds and dilatations" : "bonds") + " reach " +
                  base::to_text(problem.reach(), 4) +
                  "; give mesh_domain that reach, or choose a smaller horizon");
    }

    void check_material(const Problem<2> &problem)
    {
      require(!problem.coefficient || problem.mesh(),
              "coefficient: it varies in space, which the equal cells of a lattice do not allow; "
              "take a mesh domain, or leave it out");
      if (problem.dilatation)
      {
        require(
            problem.kernel.structure() == physics::Structure::tensor,
            "dilatation: it needs displacements, but the kernel is scalar; take a tensor kernel "
            "(physics::deviatoric_kernel)");
        const double horizon = problem.dilatation->influence.horizon();
        require(horizon == problem.horizon(),
                "dilatation: its influence function has the horizon " + base::to_text(horizon, 4) +
                    ", but the kernel " + base::to_text(problem.horizon(), 4) + "; give both one");
      }
      require(problem.body() == nullptr || problem.lame != nullptr,
              "lame: a body with a free boundary needs the constants of its solid; give them as a "
              "function of the place");
    }

    /// Points of the interaction domain, as far as bonds reach: nodes there, or points around Ω.
    std::vector<Point<2>> constrained_samples(const Problem<2> &problem, const Extent &omega)
    {
      constexpr std::size_t n_samples = 80;
      std::vector<Point<2>> samples;
      if (const auto &cells = problem.cells())
      {
        const std::size_t step =
            std::max<std::size_t>(1, (cells->size() - cells->n_free) / n_samples);
        for (std::size_t i = cells->n_free; i < cells->size(); i += step)
          samples.push_back(cells->nodes[i]);
        return samples;
      }
      const geometry::Lattice &lattice = *problem.lattice();
      const auto is_inside = [&](const Point<2> &x)
      {
        const auto cell = (x - lattice.origin()) / lattice.h();
        return lattice.is_inside(static_cast<int>(std::floor(cell[0])),
                                 static_cast<int>(std::floor(cell[1])));
      };
      for (const Point<2> &x : problem.is_periodic() ? std::vector<Point<2>>() : omega.samples)
        for (unsigned int axis = 0; axis < problem.dimension(); ++axis)
          for (const double reach : {-problem.reach(), problem.reach()})
          {
            Point<2> y = x;
            y[axis] += reach;
            if (!is_inside(y))
              samples.push_back(y);
          }
      return samples;
    }

    void check_finite(const std::string &name, const Function &value, unsigned int n_components,
                      const std::vector<Point<2>> &points, const std::string &where)
    {
      for (const Point<2> &x : points)
        for (unsigned int c = 0; c < n_components; ++c)
          if (const double found = value(x, c); !std::isfinite(found))
          {
            std::ostringstream message;
            message << name << " = " << found << " at (" << x << "), component " << c
                    << "; it must be a finite number everywhere in " << where
                    << ": give a function that is, or leave that place out of the domain";
            throw InputError(message.str());
          }
    }

    /// On the bounding box of Ω where it is smooth. What is made of pieces is taken as it is: no
    /// number of points shows where they end.
    void find_series(Field<2> &field, unsigned int n_components, const Extent &omega)
    {
      if (field.is_piecewise || field.series)
        return;
      try
      {
        field.series = series_of(field.value, n_components, omega.box, omega, 0);
      }
      catch (const std::runtime_error &) // in a hole of the domain the field may have no value
      {
        if (omega.is_rectangle)
          throw;
      }
    }

    Field<2> zero(unsigned int n_components, const geometry::Box &box)
    {
      const auto value = [](const Point<2> &, unsigned int) { return 0.; };
      return {value, physics::ChebyshevField::resolve(value, n_components, box.lower, box.upper)};
    }
  } // namespace

  ProblemBuilder::ProblemBuilder(Domain domain, physics::Kernel<2> kernel, double h)
      : Problem<2>{std::move(domain), h, std::move(kernel)}
  {
    if (h == 0)
      this->h = size_of_cells(this->domain);
    n_components = this->kernel.n_components();
  }

  Problem<2> ProblemBuilder::build() const
  {
    Problem<2> problem = *this;
    check_domain(problem);
    check_material(problem);
    if ((problem.coefficient && !problem.body()) ||
        (problem.dilatation && !problem.dilatation->is_homogeneous))
      problem.is_homogeneous = false;
    if (problem.coefficient && !problem.is_homogeneous && problem.spatial_values.empty())
      problem.spatial_values = {
          {"coefficient", [a = *problem.coefficient](const Point<2> &x) { return a.at(x); }}};

    const Extent omega = extent(problem);
    const unsigned int n = problem.n_components;
    const auto complete = [&](const std::string &name, Field<2> &field)
    {
      check_finite(name, field.value, n, omega.samples, "the domain");
      find_series(field, n, omega);
    };
    if (problem.solution)
      complete("solution", *problem.solution);
    if (problem.local_solution)
      complete("local solution", *problem.local_solution);
    if (!problem.constraint.value)
      problem.constraint = problem.solution ? *problem.solution : zero(n, omega.box);
    check_finite("constraint", problem.constraint.value, n, constrained_samples(problem, omega),
                 "the interaction domain");
    if (problem.load.value && problem.is_load_given)
      complete("load", problem.load);
    if (problem.load.value)
      return problem;
    problem.is_load_given = false;
    problem.load = problem.solution ? manufactured_load(problem, omega) : zero(n, omega.box);
    return problem;
  }
} // namespace plumbline::problem
