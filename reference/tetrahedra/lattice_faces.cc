#include "reference/tetrahedra/lattice_faces.h"

#include <cmath>

namespace plumbline::reference
{
  using dealii::Point;

  std::optional<FacePlaces> places_on_lattice(const PairFace &f, const PairFace &g, double spacing)
  {
    const auto &x = f.vertices(), &y = g.vertices();
    constexpr double off = 1e-12; // rounding of coordinates
    bool is_of_lattice = true;
    FacePlaces places{};
    for (unsigned int d = 0; d < 3; ++d)
    {
      const auto place = [&](const Point<3> &vertex)
      {
        const double steps = (vertex[d] - x[0][d]) / spacing;
        const long nearest = std::lround(steps);
        is_of_lattice = is_of_lattice && std::abs(steps - static_cast<double>(nearest)) < off;
        return nearest;
      };
      for (unsigned int k = 0; k < 3; ++k)
      {
        places[3 * d + k] = place(x[k]);
        places[9 + 3 * d + k] = place(y[k]);
      }
      if (!is_of_lattice)
        return {};
    }
    return places;
  }

  std::array<PairFace, 2> faces_at(const FacePlaces &places, double spacing)
  {
    std::array<PairFace::Vertices, 2> x;
    std::array<std::array<unsigned int, 3>, 2> names{};
    for (unsigned int face = 0; face < 2; ++face)
      for (unsigned int k = 0; k < 3; ++k)
      {
        names[face][k] = 3 * face + k;
        for (unsigned int d = 0; d < 3; ++d)
          x[face][k][d] = spacing * static_cast<double>(places[9 * face + 3 * d + k]);
        for (unsigned int other = 0; other < 3 * face; ++other)
          if (x[face][k] == x[0][other])
            names[face][k] = other; // they share it
      }
    return {PairFace(x[0], names[0]), PairFace(x[1], names[1])};
  }
} // namespace plumbline::reference
