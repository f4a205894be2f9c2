#include "uq/ellipses.h"

#include "base/error.h"
#include "base/number_text.h"
#include "uq/generator.h"
#include "uq/torus_packing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::uq
{
  namespace
  {
    using Ellipse = Ellipses::Ellipse;

    Ellipse draw_ellipse(const Box &window, Generator &numbers)
    {
      Ellipse ellipse;
      for (unsigned int d = 0; d < 2; ++d) // in this order, on every machine
        ellipse.centre[d] =
            window.lower[d] + numbers.uniform() * (window.upper[d] - window.lower[d]);
      const double angle = 2 * M_PI * numbers.uniform();
      ellipse.cosine = std::cos(angle);
      ellipse.sine = std::sin(angle);
      return ellipse;
    }

    Box enlarged(const Box &box, double by)
    {
      return {{box.lower[0] - by, box.lower[1] - by}, {box.upper[0] + by, box.upper[1] + by}};
    }

    double area(const Box &box)
    {
      return (box.upper[0] - box.lower[0]) * (box.upper[1] - box.lower[1]);
    }

    double area(const std::array<double, 2> &semi_axes)
    {
      return M_PI * semi_axes[0] * semi_axes[1];
    }

    bool contains(const Box &box, const Point<2> &x)
    {
      return x[0] >= box.lower[0] && x[0] <= box.upper[0] && x[1] >= box.lower[1] &&
             x[1] <= box.upper[1];
    }

    /// Before anything is drawn: too many would take all memory, or for ever.
    void require_number(double expected, const EllipseModel &model)
    {
      constexpr double most = 1e7;
      if (!(expected <= most))
        throw InputError("ellipses of semi-axes " + base::to_text(model.semi_axes[0], 4) + " and " +
                         base::to_text(model.semi_axes[1], 4) + " would be " +
                         base::to_text(expected, 3) + " in number to cover the area fraction of " +
                         base::to_text(model.fraction, 4) +
                         "; choose larger ones, 1e7 are the most");
    }

    std::vector<Ellipse> draw_boolean(const EllipseModel &model, const Box &box, Generator &numbers)
    {
      const Box window = enlarged(box, std::max(model.semi_axes[0], model.semi_axes[1]));
      const double expected = -std::log1p(-model.fraction) * area(window) / area(model.semi_axes);
      require_number(expected, model);
      std::vector<Ellipse> ellipses(numbers.poisson(expected));
      for (Ellipse &ellipse : ellipses)
        ellipse = draw_ellipse(window, numbers);
      return ellipses;
    }

    std::vector<Ellipse> draw_separate(const EllipseModel &model, const Box &box,
                                       Generator &numbers)
    {
      constexpr unsigned int most_failures = 100'000; // in a row
      const double reach = std::max(model.semi_axes[0], model.semi_axes[1]);
      const Box torus = enlarged(box, 2 * reach);
      const double each = area(model.semi_axes) / area(torus);
      const double n_wanted = std::floor(model.fraction / each + numbers.uniform());
      require_number(n_wanted, model);
      TorusPacking packing(model.semi_axes, torus);
      std::vector<Ellipse> near_box;
      for (double n = 0; n < n_wanted; ++n)
      {
        Ellipse ellipse = draw_ellipse(torus, numbers);
        for (unsigned int failures = 1; !packing.add(ellipse); ++failures)
        {
          if (failures == most_failures)
            throw InputError(
                "area fraction = " + base::to_text(model.fraction, 4) +
                " of ellipses that do not overlap is not reached by adding them one by one: at " +
                base::to_text(n * each, 3) + " no place was free any more, at " +
                std::to_string(most_failures) +
                " places tried; choose a fraction below that, or let them overlap");
          ellipse = draw_ellipse(torus, numbers);
        }
        if (contains(enlarged(box, reach), ellipse.centre))
          near_box.push_back(ellipse);
      }
      return near_box;
    }

    void check_semi_axes(const std::array<double, 2> &semi_axes)
    {
      for (const double semi_axis : semi_axes)
        if (!(semi_axis > 0) || !std::isfinite(semi_axis))
          throw InputError("ellipses: semi-axis = " + base::to_text(semi_axis, 6) +
                           " cannot be used; give lengths > 0, in the unit of the domain");
    }
  } // namespace

  void check(const EllipseModel &model)
  {
    check_semi_axes(model.semi_axes);
    if (!(model.fraction >= 0 && model.fraction < 1))
      throw InputError("ellipses: area fraction = " + base::to_text(model.fraction, 6) +
                       " cannot be used; give one in [0, 1)");
  }

  Ellipses Ellipses::draw(const EllipseModel &model, const Box &box, std::uint64_t seed,
                          std::uint64_t stream)
  {
    check(model);
    check(Grid{box, {1, 1}});
    Generator numbers(seed, stream);
    return Ellipses(model.semi_axes, box,
                    model.overlap ? draw_boolean(model, box, numbers)
                                  : draw_separate(model, box, numbers));
  }

  Ellipses::Ellipses(std::array<double, 2> semi_axes, const Box &box, std::vector<Ellipse> ellipses)
      : semi_axes_(semi_axes), box_(box), ellipses_(std::move(ellipses))
  {
    check_semi_axes(semi_axes_);
    check(Grid{box, {1, 1}});
    sort_into_bins();
  }

  void Ellipses::sort_into_bins()
  {
    constexpr double most_bins = 2000; // along x and y
    const double reach = std::max(semi_axes_[0], semi_axes_[1]);
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double side = box_.upper[d] - box_.lower[d];
      n_bins_[d] = static_cast<int>(std::clamp(std::floor(side / reach), 1., most_bins));
      bins_per_length_[d] = n_bins_[d] / side;
    }
    // first how many grains each bin has, then their places one after the other
    std::vector<std::size_t> bins, owner;
    for (std::size_t k = 0; k < ellipses_.size(); ++k)
    {
      add_bins_of(ellipses_[k], bins);
      owner.resize(bins.size(), k);
    }
    first_.assign(static_cast<std::size_t>(n_bins_[0]) * n_bins_[1] + 1, 0);
    for (const std::size_t bin : bins)
      ++first_[bin + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    members_.resize(bins.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < bins.size(); ++i)
    {
      const Ellipse &e = ellipses_[owner[i]];
      members_[next[bins[i]]++] = {e.centre[0],
                                   e.centre[1],
                                   e.cosine / semi_axes_[0],
                                   e.sine / semi_axes_[0],
                                   -e.sine / semi_axes_[1],
                                   e.cosine / semi_axes_[1]};
    }
  }

  void Ellipses::add_bins_of(const Ellipse &ellipse, std::vector<std::size_t> &bins) const
  {
    // of the ellipse along each axis; more by rounding's share, so that no point on an edge is lost
    constexpr double rounding = 1e-9;
    const std::array<double, 2> half_width{
        std::hypot(semi_axes_[0] * ellipse.cosine, semi_axes_[1] * ellipse.sine),
        std::hypot(semi_axes_[0] * ellipse.sine, semi_axes_[1] * ellipse.cosine)};
    std::array<int, 2> low{}, high{};
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double middle = (ellipse.centre[d] - box_.lower[d]) * bins_per_length_[d];
      const double half = half_width[d] * bins_per_length_[d] + rounding, n = n_bins_[d];
      low[d] = static_cast<int>(std::clamp(std::floor(middle - half), 0., n));
      high[d] = static_cast<int>(std::clamp(std::floor(middle + half), -1., n - 1));
    }
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i)
        bins.push_back(static_cast<std::size_t>(j) * n_bins_[0] + i);
  }

  bool Ellipses::covers(const Point<2> &x) const
  {
    std::array<int, 2> at{};
    for (unsigned int d = 0; d < 2; ++d)
      at[d] = static_cast<int>(
          std::clamp((x[d] - box_.lower[d]) * bins_per_length_[d], 0., n_bins_[d] - 1.));
    const std::size_t bin = static_cast<std::size_t>(at[1]) * n_bins_[0] + at[0];
    for (std::size_t k = first_[bin]; k < first_[bin + 1]; ++k)
    {
      const Member &m = members_[k];
      const double dx = x[0] - m.x, dy = x[1] - m.y;
      const double s = m.along_x * dx + m.along_y * dy, t = m.across_x * dx + m.across_y * dy;
      if (s * s + t * t <= 1)
        return true;
    }
    return false;
  }

  std::vector<double> Ellipses::at_nodes(const Grid &grid) const
  {
    std::vector<double> values;
    values.reserve(grid.size());
    for (int j = 0; j < grid.n[1]; ++j)
      for (int i = 0; i < grid.n[0]; ++i)
        values.push_back(covers(grid.node(i, j)) ? 1 : 0);
    return values;
  }

  double Ellipses::fraction_covered(const Grid &grid) const
  {
    const std::vector<double> values = at_nodes(grid);
    return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(grid.size());
  }
} // namespace plumbline::uq
