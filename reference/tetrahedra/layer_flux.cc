#include "reference/tetrahedra/layer_flux.h"

namespace plumbline::reference
{
  namespace
  {
    using dealii::Tensor;

    /// Λ at n radii.
    void evaluate(const PotentialPart<double> &part, const double *r, double *values,
                  unsigned int n)
    {
      constexpr unsigned int at_once = RadialPolynomial<double>::most_radii;
      for (unsigned int first = 0; first < n; first += at_once)
        part.potential().evaluate(r + first, values + first, std::min(at_once, n - first));
      for (unsigned int q = 0; q < n; ++q)
        values[q] /= r[q];
    }
  } // namespace

  LayerFlux::LayerFlux(const PotentialKernel &kernel)
  {
    for (const PotentialTerms &terms : kernel.terms)
      parts_.emplace_back(terms, 1);
  }

  Tensor<1, 3> LayerFlux::operator()(const dealii::Point<3> &x, const FaceSides &face) const
  {
    constexpr double flat = 1e-13; // a distance that is none
    const double height = face.normal * (face.x[0] - x), distance = std::abs(height);
    Tensor<1, 3> flux;
    for (const PotentialPart<double> &part : parts_)
    {
      if (distance >= part.end())
        continue;
      const double nearest = std::max(distance, flat);
      double foot = 0, whole = 0; // Λ(d), ∫ Λ'/r
      evaluate(part, &nearest, &foot, 1);
      for (unsigned int k = 0; k < 3; ++k)
      {
        const Tensor<1, 3> start = face.x[k] - x;
        const double kappa = face.outward[k] * start, of_kappa = kappa * kappa,
                     first = face.along[k] * start, last = first + face.length[k],
                     square = of_kappa + distance * distance,
                     reach = std::sqrt(std::max(0., part.end() * part.end() - square)),
                     from = std::max(first, -reach), to = std::min(last, reach);
        const auto angle = [&](double begin, double end)
        { return std::atan2(kappa * (end - begin), of_kappa + begin * end); };
        if (from < to)
        {
          const LinePoints points(from, to, square, part.extra_points(to - from));
          std::array<double, LinePoints::most> values; // filled up to n
          evaluate(part, points.r.data(), values.data(), points.n);
          double of_side = 0, moment = 0;
          for (unsigned int q = 0; q < points.n; ++q)
          {
            moment += points.weight[q] * values[q];
            of_side +=
                points.weight[q] / (of_kappa + points.tau[q] * points.tau[q]) * (values[q] - foot);
          }
          flux += moment * face.outward[k];
          if (kappa != 0)
            whole += kappa * of_side;
        }
        if (kappa != 0 && (from > first || to < last)) // beyond the reach, where Λ = 0
          whole -= foot * (angle(first, last) - (from < to ? angle(from, to) : 0));
      }
      flux += height * whole * face.normal;
    }
    return flux;
  }
} // namespace plumbline::reference
