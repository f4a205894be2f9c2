#include "problem/manufactured_load.h"

#include "physics/double_well_load.h"
#include "physics/load.h"
#include "physics/panels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

namespace plumbline::problem
{
  namespace
  {
    using dealii::Point;
    using physics::ChebyshevField;
    using physics::FewestRadii;
    using physics::Panels;
    using Function = ChebyshevField::Function;

    constexpr unsigned int radii_of_rough_fields = 48; // where nothing is known of u or a

    void find_samples(const geometry::Lattice &lattice, std::vector<Point<2>> &samples)
    {
      constexpr int n_samples = 8;
      const auto &n = lattice.n_cells();
      for (int j = 0; j <= n_samples; ++j)
        for (int i = 0; i <= n_samples; ++i)
        {
          const int k = i * (n[0] - 1) / n_samples, l = j * (n[1] - 1) / n_samples;
          if (lattice.is_inside(k, l))
            samples.push_back(lattice.point(k + .5, l + .5));
        }
    }

    void find_samples(const geometry::Mesh &mesh, std::vector<Point<2>> &samples)
    {
      constexpr std::size_t n_samples = 80;
      const std::size_t step = std::max<std::size_t>(1, mesh.cells.size() / n_samples);
      for (std::size_t i = 0; i < mesh.cells.size(); i += step)
        if (mesh.cells[i].is_inside)
          samples.push_back(geometry::centroid(geometry::view(mesh.polygon(i))));
    }

    geometry::Box enlarged(const Point<2> &lower, const Point<2> &upper, double reach)
    {
      const Point<2> margin(reach, reach);
      return {Point<2>(lower - margin), upper + margin};
    }

    /// The largest value of a field over the samples: for noise levels.
    double magnitude(const Field<2> &field, unsigned int n_components, const Extent &extent)
    {
      double largest = 0;
      for (const Point<2> &x : extent.samples)
        for (unsigned int c = 0; c < n_components; ++c)
          largest = std::max(largest, std::abs(field.value(x, c)));
      return largest;
    }

    /// Round-off of an operator of this kernel on a field.
    double noise_of(const physics::Kernel<2> &kernel, double magnitude)
    {
      return 2 * std::numeric_limits<double>::epsilon() * physics::operator_scale(kernel) *
             magnitude;
    }

    /// What a load is made of, u and what the material does to bonds.
    struct Ingredients
    {
      Function u;
      unsigned int n_components;
      Function material; ///< empty: it is the same everywhere
      unsigned int n_constants = 1;
      const Extent &extent;

      /// Terms along an axis of their product on a box, to 14 digits; 0: more than so many.
      unsigned int terms(const geometry::Box &box, unsigned int most) const
      {
        const unsigned int of_u = terms(u, n_components, box, most);
        const unsigned int of_material =
            material && of_u > 0 ? terms(material, n_constants, box, most) : 1;
        const unsigned int all = of_u + of_material - 1;
        return of_u > 0 && of_material > 0 && all <= most ? all : 0;
      }

    private:
      unsigned int terms(const Function &f, unsigned int n, const geometry::Box &box,
                         unsigned int most) const
      {
        constexpr double digits = 1e-14;
        double size = 0;
        try
        {
          for (const double s : {.1, .4, .8})
            for (unsigned int c = 0; c < n; ++c)
              size = std::max(size, std::abs(f(box.lower + s * (box.upper - box.lower), c)));
        }
        catch (const std::runtime_error &)
        {
          return 0;
        }
        const auto series = series_of(f, n, box, extent, digits * size, most);
        return series ? series->n_terms() : 0;
      }
    };

    /// Panels of a box on each of which, and so far around it, the ingredients are smooth.
    std::shared_ptr<const Panels> panels_of(const Ingredients &of, const geometry::Box &box,
                                            double reach)
    {
      return std::make_shared<const Panels>(
          box.lower, box.upper,
          [&](const Point<2> &lower, const Point<2> &upper, unsigned int most)
          { return of.terms(enlarged(lower, upper, reach), most); });
    }

    /// Of polynomials in balls, from those on the panels around: near the ends of an interval
    /// Chebyshev polynomials vary as fast as those of a part by the root of its share.
    unsigned int degree_in_ball(const Panels::Panel &panel, double reach, double radius)
    {
      const double side =
          2 * reach + std::min(panel.upper[0] - panel.lower[0], panel.upper[1] - panel.lower[1]);
      return static_cast<unsigned int>(
          std::ceil(panel.n_terms * std::sqrt(std::min(1., 2 * radius / side))));
    }

    FewestRadii radii(const std::shared_ptr<const Panels> &panels, double reach, double radius)
    {
      return [=](const Point<2> &x)
      {
        const Panels::Panel &panel = panels->at(x);
        return panel.n_terms == 0 ? radii_of_rough_fields
                                  : (degree_in_ball(panel, reach, radius) + 1) / 2;
      };
    }

    /// Values by the series of panels, elsewhere their own.
    Function by_panels(const Function &f, unsigned int n_components,
                       const std::shared_ptr<const Panels> &panels, double noise)
    {
      const auto fast = std::make_shared<const physics::PanelField>(f, n_components, panels, noise);
      return [f, fast](const Point<2> &x, unsigned int c)
      {
        const auto &series = fast->series(x);
        return series ? (*series)(x, c) : f(x, c);
      };
    }

    /// -F(u) of double wells. All components come at once: they are kept for who asks for the
    /// others at the same points.
    template <int dim>
    struct WellLoad
    {
      physics::WellForce<dim> force;
      Function u;
      mutable std::map<std::pair<double, double>, dealii::Tensor<1, dim>> known;

      double operator()(const Point<2> &x, unsigned int component) const
      {
        const auto [entry, is_new] = known.try_emplace({x[0], x[1]});
        if (is_new)
        {
          Point<dim> at;
          for (unsigned int axis = 0; axis < dim; ++axis)
            at[axis] = x[axis];
          entry->second = -force(
              [&](const Point<dim> &y)
              {
                const Point<2> place(y[0], dim == 1 ? x[1] : y[dim - 1]);
                dealii::Tensor<1, dim> value;
                for (unsigned int c = 0; c < dim; ++c)
                  value[c] = u(place, c);
                return value;
              },
              at);
        }
        return entry->second[component];
      }
    };

    /// By enough points for a field that is a polynomial of this degree in a ball: the 12 radii and
    /// 32 angles of WellForce are for 12.
    Function well_load(const Problem<2> &problem, const Function &u, unsigned int degree)
    {
      const unsigned int n_radii = std::max(12u, degree), n_angles = std::max(32u, 3 * degree);
      if (problem.dimension() == 1)
        return WellLoad<1>{physics::WellForce<1>(*problem.double_well, n_radii, n_angles), u, {}};
      return WellLoad<2>{physics::WellForce<2>(*problem.double_well, n_radii, n_angles), u, {}};
    }

    /// What varies in the material of a problem, of so many components.
    std::pair<Function, unsigned int> material_of(const Problem<2> &problem)
    {
      if (problem.dilatation && !problem.dilatation->is_homogeneous)
        return {[material = problem.dilatation->material](const Point<2> &x, unsigned int c)
                {
                  const physics::Lame lame = material(x);
                  return c == 0 ? lame.lambda : lame.mu;
                },
                2};
      if (problem.coefficient)
        return {[a = *problem.coefficient](const Point<2> &x, unsigned int) { return a.at(x); }, 1};
      return {{}, 1};
    }

    /// θ of a field, as a series where it is smooth: a load asks for it all over the ball.
    std::function<double(const Point<2> &)> dilatation_of(const Function &u,
                                                          const physics::Dilatation<2> &dilatation,
                                                          const Ingredients &of, double noise)
    {
      const double horizon = dilatation.influence.horizon();
      const geometry::Box box = enlarged(of.extent.box.lower, of.extent.box.upper, horizon);
      const auto panels = panels_of(of, box, horizon);
      const physics::FieldDilatation theta(dilatation.influence, u,
                                           radii(panels, horizon, horizon));
      const auto value = by_panels([theta](const Point<2> &x, unsigned int) { return theta(x); }, 1,
                                   panels, noise);
      return [value](const Point<2> &x) { return value(x, 0); };
    }

    /// Of bonds, and of dilatations, whose forces reach two horizons.
    Function linear_load(const Problem<2> &problem, const Function &u, const Ingredients &of,
                         const FewestRadii &fewest, double magnitude)
    {
      const physics::ManufacturedLoad bonds(problem.kernel, u, problem.coefficient, fewest);
      if (!problem.dilatation)
        return bonds;
      const physics::Kernel<2> &influence = problem.dilatation->influence;
      const double noise = influence.horizon() * noise_of(influence, magnitude);
      return
          [bonds, force = physics::DilatationForce(*problem.dilatation,
                                                   dilatation_of(u, *problem.dilatation, of, noise),
                                                   fewest)](const Point<2> &x, unsigned int c)
      { return bonds(x, c) + force(x, c); };
    }
  } // namespace

  Extent extent(const Problem<2> &problem)
  {
    Extent result;
    result.h = problem.h;
    if (const geometry::Lattice *lattice = problem.lattice())
    {
      const auto &n = lattice->n_cells();
      result.box = {lattice->origin(), lattice->point(n[0], n[1])};
      result.is_rectangle = lattice->is_rectangle();
      find_samples(*lattice, result.samples);
    }
    else
    {
      result.box = geometry::bounding_box(*problem.mesh());
      find_samples(*problem.mesh(), result.samples);
    }
    return result;
  }

  std::optional<ChebyshevField> series_of(const Function &value, unsigned int n_components,
                                          const geometry::Box &box, const Extent &extent,
                                          double noise, unsigned int most)
  {
    constexpr double fewest_controls = 100, most_controls = 2000;
    ChebyshevField::Search search;
    search.most = most;
    for (unsigned int axis = 0; axis < 2; ++axis)
    {
      const double side = box.upper[axis] - box.lower[axis],
                   share = side / (extent.box.upper[axis] - extent.box.lower[axis]);
      // a part of Ω is looked at as closely as all of it
      search.n_control[axis] = static_cast<unsigned int>(std::ceil(std::clamp(
          side / extent.h, share * fewest_controls, std::max(share, 1.) * most_controls)));
    }
    return ChebyshevField::resolve(value, n_components, box.lower, box.upper, noise, search);
  }

  Function plain_load(const Problem<2> &problem)
  {
    const Function &u = problem.solution->value;
    constexpr unsigned int n_radii = 24;
    if (problem.double_well)
      return well_load(problem, u, n_radii);
    const Extent omega = extent(problem);
    const Ingredients of{u, problem.n_components, {}, 1, omega};
    return linear_load(
        problem, u, of, [](const Point<2> &) { return n_radii; },
        magnitude(*problem.solution, problem.n_components, omega));
  }

  Field<2> manufactured_load(const Problem<2> &problem, const Extent &extent)
  {
    const Function &u = problem.solution->value;
    const unsigned int n_components = problem.n_components;
    const double size = magnitude(*problem.solution, n_components, extent),
                 noise = noise_of(problem.kernel, size), horizon = problem.horizon(),
                 reach = problem.reach();
    const auto [material, n_constants] = material_of(problem);
    const Ingredients of{u, n_components, material, n_constants, extent};
    const auto panels = panels_of(of, extent.box, reach);
    Field<2> load;
    // an operator smooths, and looking closer would take a ball at each of many points
    load.is_smooth_in_cells = true;
    if (problem.double_well)
    {
      unsigned int degree = 0;
      for (const Panels::Panel &panel : panels->all())
        degree = std::max(degree, panel.n_terms == 0 ? radii_of_rough_fields
                                                     : degree_in_ball(panel, reach, horizon));
      load.value = well_load(problem, u, degree);
    }
    else
      load.value = linear_load(problem, u, of, radii(panels, reach, horizon), size);
    if (panels->is_one())
    {
      load.series = physics::series_on_one(load.value, n_components, *panels, noise);
      if (load.series)
        load.fast = [series = *load.series](const Point<2> &x, unsigned int c)
        { return series(x, c); };
      return load;
    }
    load.fast = by_panels(load.value, n_components, panels, noise);
    return load;
  }
} // namespace plumbline::problem
