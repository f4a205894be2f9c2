#include "problem/in_space.h"

#include "base/control_points.h"
#include "base/error.h"
#include "geometry/tetrahedral_domain.h"
#include "physics/load_in_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace plumbline::problem
{
  namespace
  {
    using Point = dealii::Point<3>;

    using geometry::Cuboid;

    /// Ω and a margin on all sides.
    Cuboid with_margin(Cuboid box, double margin)
    {
      for (unsigned int d = 0; d < 3; ++d)
      {
        box.lower[d] -= margin;
        box.upper[d] += margin;
      }
      return box;
    }

    /// n points along each axis of each box.
    std::vector<Point> samples(const std::vector<Cuboid> &boxes, unsigned int n)
    {
      const auto along = base::control_points(n);
      std::vector<Point> points;
      for (const Cuboid &box : boxes)
        for (const double r : along)
          for (const double t : along)
            for (const double s : along)
            {
              Point x;
              for (unsigned int d = 0; d < 3; ++d)
                x[d] = box.lower[d] +
                       std::array<double, 3>{s, t, r}[d] * (box.upper[d] - box.lower[d]);
              points.push_back(x);
            }
      return points;
    }

    /// Of about n cells in Ω, or around it: their centroids and corners.
    std::vector<Point> samples(const geometry::TetrahedralMesh &mesh, bool of_omega, std::size_t n)
    {
      const std::size_t step = std::max<std::size_t>(1, mesh.cells.size() / n);
      std::vector<Point> points;
      std::size_t count = 0;
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      {
        if ((mesh.is_inside[cell] != 0) != of_omega || count++ % step != 0)
          continue;
        dealii::Tensor<1, 3> sum;
        for (const unsigned int vertex : mesh.cells[cell])
          sum += mesh.vertices[vertex];
        points.emplace_back(sum / 4);
        points.push_back(mesh.vertices[mesh.cells[cell].front()]);
      }
      return points;
    }

    bool is_inside(const Cuboid &box, const Point &x)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (!(x[d] >= box.lower[d] && x[d] <= box.upper[d]))
          return false;
      return true;
    }

    bool is_inside(const std::vector<Cuboid> &boxes, const Point &x)
    {
      return std::any_of(boxes.begin(), boxes.end(),
                         [&](const Cuboid &box) { return is_inside(box, x); });
    }

    /// In Ω: points in its boxes, or the centroids of some cells of a mesh, and their corners.
    /// @param n  along each axis of a box; of a mesh n³ cells
    std::vector<Point> samples(const Problem<3> &problem, unsigned int n)
    {
      if (!problem.mesh)
        return samples(problem.lattice.boxes(), n);
      return samples(*problem.mesh, true, static_cast<std::size_t>(n) * n * n);
    }

    /// Around Ω.
    std::vector<Point> samples_around(const Problem<3> &problem)
    {
      constexpr unsigned int n_samples = 16;
      if (problem.mesh)
        return samples(*problem.mesh, false, static_cast<std::size_t>(n_samples) * n_samples);
      const std::vector<Cuboid> omega = problem.lattice.boxes();
      std::vector<Cuboid> around;
      for (const Cuboid &box : omega)
        around.push_back(with_margin(box, problem.reach()));
      std::vector<Point> points;
      for (const Point &x : samples(around, n_samples))
        if (!is_inside(omega, x))
          points.push_back(x);
      return points;
    }

    using Series = std::optional<physics::ChebyshevInSpace>;

    bool is_box(const Problem<3> &problem)
    {
      return !problem.mesh && problem.lattice.is_box();
    }

    /// On the bounding box of Ω; none where the field has no values in a part outside of Ω.
    Series series_of(const physics::ChebyshevInSpace::Function &value, const Problem<3> &problem,
                     double noise = 0)
    {
      const Cuboid box = bounding_box(problem);
      try
      {
        return physics::ChebyshevInSpace::resolve(value, problem.n_components, box.lower, box.upper,
                                                  noise);
      }
      catch (const std::runtime_error &)
      {
        if (is_box(problem))
          throw;
        return {};
      }
    }

    void check_finite(const std::string &name, const Field<3> &field, unsigned int n_components,
                      const Point &x)
    {
      for (unsigned int c = 0; c < n_components; ++c)
        if (const double value = field.value(x, c); !std::isfinite(value))
        {
          std::ostringstream message;
          message << name << " = " << value << " at (" << x << "), component " << c
                  << "; it must be a finite number in the domain and within the horizon around it";
          throw InputError(message.str());
        }
    }

    void complete_field(const std::string &name, Field<3> &field, const Problem<3> &problem)
    {
      constexpr unsigned int n_samples = 8;
      for (const Point &x : samples(problem, n_samples))
        check_finite(name, field, problem.n_components, x);
      if (!field.is_piecewise && !field.series)
        field.series = series_of(field.value, problem);
    }

    void check_constraint(const Problem<3> &problem)
    {
      for (const Point &x : samples_around(problem))
        check_finite("constraint", problem.constraint, problem.n_components, x);
    }

    Field<3> manufactured_load(const Problem<3> &problem)
    {
      constexpr unsigned int n_samples = 3;
      const physics::LoadInSpace load(problem.kernel, problem.dilatation, problem.solution->value,
                                      samples(problem, n_samples));
      Field<3> field{load};
      if (is_box(problem) || problem.solution->series) // else the load has none either
        field.series = series_of(load, problem, load.noise());
      return field;
    }
  } // namespace

  double Field<3>::operator()(const dealii::Point<3> &x, unsigned int component) const
  {
    if (!series)
      return value(x, component);
    physics::AxisFunctionals at;
    for (unsigned int d = 0; d < 3; ++d)
      at[d] = {{{x[d], 1}}};
    return series->apply(component, at).front();
  }

  std::vector<double> Field<3>::apply(unsigned int component,
                                      const physics::AxisFunctionals &functionals,
                                      const std::vector<char> &is_wanted) const
  {
    std::vector<double> result;
    if (series)
    {
      result = series->apply(component, functionals);
      for (std::size_t i = 0; i < is_wanted.size(); ++i)
        if (is_wanted[i] == 0)
          result[i] = 0;
      return result;
    }
    for (const auto &along_z : functionals[2])
      for (const auto &along_y : functionals[1])
        for (const auto &along_x : functionals[0])
        {
          if (!is_wanted.empty() && is_wanted[result.size()] == 0)
          {
            result.push_back(0);
            continue;
          }
          double sum = 0;
          for (const auto &[z, of_z] : along_z)
            for (const auto &[y, of_y] : along_y)
              for (const auto &[x, of_x] : along_x)
                sum += of_x * of_y * of_z * value(Point(x, y, z), component);
          result.push_back(sum);
        }
    return result;
  }

  Problem<3> complete(Problem<3> problem)
  {
    if (!problem.load.value && !problem.solution)
      throw InputError("load: there is neither a load nor a solution to manufacture it from; give "
                       "one of them");
    if (!problem.load.value && (problem.factors || problem.is_free))
      throw InputError(
          "load: it can be manufactured only for homogeneous materials and u prescribed "
          "all around the domain; give a load");
    if (!problem.constraint.value && !problem.solution)
      throw InputError("constraint: u is not known around the domain; give the constraint or the "
                       "solution");
    if (problem.solution)
      complete_field("solution", *problem.solution, problem);
    if (problem.local_solution)
      complete_field("local solution", *problem.local_solution, problem);
    if (!problem.constraint.value)
      problem.constraint = *problem.solution;
    check_constraint(problem);
    problem.is_load_given = static_cast<bool>(problem.load.value);
    if (problem.is_load_given)
      complete_field("load", problem.load, problem);
    else
      problem.load = manufactured_load(problem);
    return problem;
  }

  Problem<3> at_spacing(Problem<3> problem, double h)
  {
    if (problem.mesh)
    {
      constexpr double rounding = 1e-9;
      double size = problem.h();
      for (; size > h * (1 + rounding); size /= 2)
        problem.mesh =
            std::make_shared<const geometry::TetrahedralMesh>(geometry::refine(*problem.mesh));
      if (size < h * (1 - rounding))
        throw InputError("h = " + std::to_string(h) +
                         " is not the mesh size of the problem's mesh divided by a power of 2; "
                         "give such a size");
    }
    problem.lattice = problem.lattice.at_spacing(h);
    problem.make_tetrahedra = {};
    return problem;
  }

  Cuboid bounding_box(const Problem<3> &problem)
  {
    return problem.mesh ? geometry::bounding_box(*problem.mesh) : problem.lattice.cuboid();
  }

  bool has_doubled(const Problem<3> &problem)
  {
    return !problem.mesh && problem.lattice.fits(2) && problem.horizon() >= 2 * problem.h() &&
           inner_vertices(problem.lattice.at_spacing(2 * problem.h())).n_free() > 0;
  }
} // namespace plumbline::problem
