#include "reference/lattice/stencil.h"

#include "geometry/polygon.h"

#include <algorithm>
#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    using geometry::ArrayView;
    using geometry::Point;

    /// ∫ over cell ∩ ball of C_ab(z) P_p(x) P_q(y) dz, x and y the cell's own coordinates in [-1,
    /// 1], for (a,b) = (0,0), (0,1), (1,1): index (ab n_modes + p) n_modes + q.
    using CellMoments = std::vector<double>;

    class MomentTable
    {
    public:
      MomentTable(const physics::Kernel<2> &kernel, double h, unsigned int n_modes,
                  geometry::Backend backend, ArrayView<const Point<2>> polygon);

      int n_cells() const { return n_; }

      /// The moment of the cell [i, i+1] × [j, j+1] h, -n <= i, j < n, by reflection and exchange
      /// from the octant 0 <= j <= i.
      double operator()(int i, int j, unsigned int a, unsigned int b, unsigned int p,
                        unsigned int q) const;
      bool is_empty(int i, int j) const { return octant_[slot(i, j)].empty(); }

    private:
      static int fold(int i) { return i < 0 ? -i - 1 : i; }
      std::size_t slot(int i, int j) const
      {
        const int big = std::max(fold(i), fold(j)), small = std::min(fold(i), fold(j));
        return static_cast<std::size_t>(big) * (big + 1) / 2 + small;
      }
      void integrate(const physics::Kernel<2> &kernel, double h, int i, int j,
                     geometry::Backend backend, ArrayView<const Point<2>> polygon,
                     CellMoments &moments) const;

      int n_;
      unsigned int n_modes_, n_pairs_;
      std::vector<CellMoments> octant_;
    };

    MomentTable::MomentTable(const physics::Kernel<2> &kernel, double h, unsigned int n_modes,
                             geometry::Backend backend, ArrayView<const Point<2>> polygon)
        : n_(static_cast<int>(std::ceil(kernel.horizon() / h * (1 - 1e-14)))), n_modes_(n_modes),
          n_pairs_(kernel.n_components() == 1 ? 1 : 3)
    {
      const std::vector<physics::Kernel<2>> parts = kernel.parts();
      for (int i = 0; i < n_; ++i)
        for (int j = 0; j <= i; ++j)
        {
          CellMoments moments;
          for (const physics::Kernel<2> &part : parts)
            integrate(part, h, i, j, backend, polygon, moments);
          octant_.push_back(std::move(moments));
        }
    }

    void MomentTable::integrate(const physics::Kernel<2> &kernel, double h, int i, int j,
                                geometry::Backend backend, ArrayView<const Point<2>> polygon,
                                CellMoments &moments) const
    {
      if (h * std::hypot(i, j) >= kernel.horizon())
        return;
      const auto cell = geometry::square(Point<2>(i * h, j * h), h);
      geometry::Polygon cut(cell.begin(), cell.end());
      if (polygon.size() > 0)
        cut = geometry::overlap(geometry::view(cell), polygon);
      if (cut.empty())
        return;
      const geometry::CutRule rule = kernel_rule(kernel, geometry::view(cut),
                                                 h * M_SQRT2 / kernel.horizon(), n_modes_, backend);

      moments.resize(n_pairs_ * n_modes_ * n_modes_);
      std::vector<double> x(n_modes_), y(n_modes_);
      for (std::size_t q = 0; q < rule.points.size(); ++q)
      {
        const Point<2> &z = rule.points[q];
        legendre(2 * (z[0] / h - i) - 1, n_modes_, x.data());
        legendre(2 * (z[1] / h - j) - 1, n_modes_, y.data());
        const double value = rule.weights[q] * kernel.radial(z.norm());
        double *moment = moments.data();
        for (unsigned int pair = 0; pair < n_pairs_; ++pair)
        {
          const double factor = value * kernel.direction_factor(pair / 2, (pair + 1) / 2, z);
          for (unsigned int m = 0; m < n_modes_; ++m)
          {
            const double row = factor * x[m];
            for (unsigned int n = 0; n < n_modes_; ++n)
              *moment++ += row * y[n];
          }
        }
      }
    }

    double MomentTable::operator()(int i, int j, unsigned int a, unsigned int b, unsigned int p,
                                   unsigned int q) const
    {
      const CellMoments &moments = octant_[slot(i, j)];
      double sign = 1;
      const bool is_mixed = a != b;
      if (i < 0 && (p % 2 == 1) != is_mixed)
        sign = -sign;
      if (j < 0 && (q % 2 == 1) != is_mixed)
        sign = -sign;
      unsigned int pair = n_pairs_ == 1 ? 0 : a + b;
      if (fold(i) < fold(j))
      {
        std::swap(p, q);
        pair = n_pairs_ == 1 ? 0 : 2 - pair;
      }
      return sign * moments[(pair * n_modes_ + p) * n_modes_ + q];
    }

    /// What one cell of the ball adds to the stencil of one pair of components.
    void subtract_cell(algebra::Stencil &stencil, const Correlations &r, unsigned int n_axis, int i,
                       int j, unsigned int a, unsigned int b, const std::vector<double> &moments)
    {
      const unsigned int n_families = n_axis * n_axis, n_modes = r.n_modes();
      std::vector<double> along_y(n_modes);
      for (unsigned int s1 = 0; s1 < n_axis; ++s1)
        for (unsigned int t1 = 0; t1 < n_axis; ++t1)
          for (int d1 = Correlations::first_interval; d1 < -Correlations::first_interval; ++d1)
          {
            const double *const rx = r.coefficients(s1, t1, d1);
            if (rx == nullptr)
              continue;
            std::fill(along_y.begin(), along_y.end(), 0.);
            for (unsigned int p = 0; p < n_modes; ++p)
              for (unsigned int q = 0; q < n_modes; ++q)
                along_y[q] += rx[p] * moments[p * n_modes + q];
            for (unsigned int s2 = 0; s2 < n_axis; ++s2)
              for (unsigned int t2 = 0; t2 < n_axis; ++t2)
                for (int d2 = Correlations::first_interval; d2 < -Correlations::first_interval;
                     ++d2)
                {
                  const double *const ry = r.coefficients(s2, t2, d2);
                  if (ry == nullptr)
                    continue;
                  double sum = 0;
                  for (unsigned int q = 0; q < n_modes; ++q)
                    sum += ry[q] * along_y[q];
                  stencil(a * n_families + s1 + s2 * n_axis, b * n_families + t1 + t2 * n_axis,
                          i - d1, j - d2) -= sum;
                }
          }
    }
  } // namespace

  geometry::CutRule kernel_rule(const physics::Kernel<2> &kernel, ArrayView<const Point<2>> polygon,
                                double length, unsigned int n_modes, geometry::Backend backend)
  {
    const physics::RadialProfile &profile = kernel.profile();
    const unsigned int degree = profile.degree(std::min(1., length));
    const int exponent = std::max(0, profile.lowest_exponent() + static_cast<int>(degree));
    const unsigned int n_angles = 16 + (profile.is_function() ? degree / 2 : 0),
                       n_radii = std::max(
                           10u, (static_cast<unsigned int>(exponent) + 2 * n_modes) / 2 + 1);
    return geometry::polar_rule({Point<2>(), kernel.horizon()}, polygon, n_angles, n_radii,
                                backend);
  }

  algebra::Stencil galerkin_stencil(const physics::Kernel<2> &kernel, double h,
                                    const AxisShapes &shapes, geometry::Backend backend,
                                    ArrayView<const Point<2>> polygon)
  {
    const Correlations r(shapes);
    const unsigned int n_modes = r.n_modes();
    const auto n_axis = static_cast<unsigned int>(shapes.families().size());
    const unsigned int n_families = n_axis * n_axis, n_components = kernel.n_components();
    const MomentTable table(kernel, h, n_modes, backend, polygon);
    const int n = table.n_cells();

    algebra::Stencil stencil(n_components * n_families, n + 1);
    std::vector<double> moments(n_modes * n_modes);
    for (unsigned int a = 0; a < n_components; ++a)
      for (unsigned int b = 0; b < n_components; ++b)
      {
        double mass = 0; // ∫ C_ab as the sum of the cells, so that constants give zero
        for (int j = -n; j < n; ++j)
          for (int i = -n; i < n; ++i)
            if (!table.is_empty(i, j))
            {
              for (unsigned int p = 0; p < n_modes; ++p)
                for (unsigned int q = 0; q < n_modes; ++q)
                  moments[p * n_modes + q] = h * h * table(i, j, a, b, p, q);
              mass += moments[0];
              subtract_cell(stencil, r, n_axis, i, j, a, b, moments);
            }
        for (unsigned int s = 0; s < n_families; ++s)
          for (unsigned int t = 0; t < n_families; ++t)
            for (int k2 = -1; k2 <= 1; ++k2)
              for (int k1 = -1; k1 <= 1; ++k1)
                stencil(a * n_families + s, b * n_families + t, k1, k2) +=
                    mass * r(s % n_axis, t % n_axis, -k1) * r(s / n_axis, t / n_axis, -k2);
      }
    return stencil;
  }
} // namespace plumbline::reference
