#include "reference/lattice/polygonal_ball.h"

#include "base/number_text.h"
#include "method/another_operator.h"
#include "method/lattice_discretisation.h"
#include "reference/lattice/discretisation.h"
#include "reference/lattice/stencil.h"

#include <array>
#include <cmath>
#include <limits>

namespace plumbline::reference
{
  namespace
  {
    using geometry::Point;

    class PolygonalBall : public method::Method, public method::AnotherOperator
    {
    public:
      PolygonalBall(unsigned int degree, unsigned int n_sides)
          : shapes_(true, degree), n_sides_(n_sides)
      {
      }
      std::string name() const override
      {
        return without_polygon() + "+polygon" + std::to_string(n_sides_);
      }
      method::MethodFamily family() const override { return method::MethodFamily::reference; }
      std::string help() const override
      {
        return without_polygon() + " on lattices, the ball replaced by the " +
               "inscribed regular polygon of " + std::to_string(n_sides_) +
               " sides (not asymptotically compatible)";
      }
      bool is_in_all() const override { return false; }
      std::string what_it_does() const override
      {
        return "replaces the ball by a polygon of " + std::to_string(n_sides_) +
               " sides, so that its solutions tend to those of a different operator";
      }

      method::Capabilities can() const override
      {
        using method::Capability;
        return {Capability::lattice, Capability::nonlocal, Capability::dynamic};
      }
      std::unique_ptr<method::Discretisation>
      discretise(const problem::Problem<2> &problem,
                 const base::Communicator & /*communicator*/) const override
      {
        return discretise_on_lattice(problem, shapes_, n_sides_);
      }

      unsigned int order() const override { return shapes_.degree() + 1; }
      double expected_bytes(const method::ProblemSize &size) const override
      {
        return method::expected_lattice_bytes(size, shapes_.degree() * shapes_.degree(),
                                              size.n_components, size.reach() / size.level.h + 1);
      }

    private:
      std::string without_polygon() const { return "Q" + std::to_string(shapes_.degree()); }

      AxisShapes shapes_;
      unsigned int n_sides_;
    };
  } // namespace

  geometry::Polygon inscribed_polygon(double horizon, unsigned int n_sides)
  {
    geometry::Polygon polygon;
    for (unsigned int k = 0; k < n_sides; ++k)
    {
      const double angle = 2 * M_PI * k / n_sides;
      polygon.emplace_back(horizon * std::cos(angle), horizon * std::sin(angle));
    }
    return polygon;
  }

  double second_moment_ratio(const physics::Kernel<2> &kernel, unsigned int n_sides)
  {
    // the traces ∫ C_aa r², in the polygon as n times that of the sector of a side
    const geometry::Polygon polygon = inscribed_polygon(kernel.horizon(), n_sides);
    const std::array<Point<2>, 3> sector = {Point<2>(), polygon[0], polygon[1]};
    constexpr double round_off = 1e-13;
    double sum = 0, size = 0;
    for (const physics::Kernel<2> &part : kernel.parts())
    {
      const geometry::CutRule rule =
          kernel_rule(part, {sector.data(), sector.size()}, 1, 2, geometry::Backend::fast);
      for (std::size_t q = 0; q < rule.points.size(); ++q)
        sum += rule.weights[q] * part.radial(rule.points[q].norm()) * rule.points[q].norm_square();
    }
    const auto trace = [](const physics::Kernel<2> &one)
    {
      double result = 0;
      for (unsigned int a = 0; a < one.n_components(); ++a)
        result += one.moment({2, 0}, a, a) + one.moment({0, 2}, a, a);
      return result;
    };
    for (const physics::Kernel<2> &part : kernel.parts())
      size += std::abs(trace(part));
    const double whole = trace(kernel);
    return std::abs(whole) > round_off * size ? n_sides * sum / whole
                                              : std::numeric_limits<double>::quiet_NaN();
  }

  method::LimitProof limit_of_polygon(const problem::Problem<2> &problem, unsigned int n_sides)
  {
    method::LimitProof proof;
    if (!problem.settings.tends_to_local_limit && problem.settings.ball_order == 0)
      return proof;
    proof.defect = std::abs(second_moment_ratio(problem.kernel, n_sides) - 1);
    if (!std::isfinite(proof.defect)) // the second moments vanish, and with them the local limit
      return {};
    proof.answer = method::LimitProof::Answer::incompatible;
    proof.reason = "a polygon of " + std::to_string(n_sides) +
                   " sides replaces the ball: second moments are off by " +
                   base::to_text(100 * proof.defect, 3) + " %";
    return proof;
  }

  method::Methods polygonal_balls()
  {
    method::Methods methods;
    for (const unsigned int n_sides : {8u, 16u, 32u})
      methods.push_back(std::make_shared<PolygonalBall>(1, n_sides));
    return methods;
  }
} // namespace plumbline::reference
