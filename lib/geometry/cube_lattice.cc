#include "geometry/cube_lattice.h"

#include "base/error.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace plumbline::geometry
{
  CubeLattice::CubeLattice(const Cuboid &cuboid, double h) : h_(h), origin_(cuboid.lower), n_{}
  {
    constexpr double whole = 1e-6; // of a cell
    constexpr double most_cells = 1e9;
    constexpr int n_digits = 10;
    if (!(h > 0) || !std::isfinite(h))
      throw InputError("mesh size h = " + std::to_string(h) + " must be a positive length");
    double n_all = 1;
    for (unsigned int d = 0; d < 3; ++d)
    {
      const double cells = (cuboid.upper[d] - cuboid.lower[d]) / h;
      std::ostringstream message;
      message << std::setprecision(n_digits) << "mesh size h = " << h;
      if (!(cells > .5) || std::abs(cells - std::round(cells)) > whole)
      {
        message << " does not divide the box [" << cuboid.lower << "; " << cuboid.upper
                << "] of Domain into whole cells (" << cells << " along "
                << "xyz"[d]
                << "); choose h so that every side is a multiple of it, as a fraction such as 1/12 "
                   "if it has no short decimal";
        throw InputError(message.str());
      }
      n_all *= std::round(cells);
      if (n_all > most_cells)
      {
        message << " makes more than " << most_cells << " cells; choose a larger h (Study/h)";
        throw InputError(message.str());
      }
      n_[d] = static_cast<int>(std::round(cells));
    }
  }
} // namespace plumbline::geometry
