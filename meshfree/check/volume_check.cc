#include "meshfree/check/volume_check.h"

#include "base/number_text.h"
#include "meshfree/check/bond_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace plumbline::meshfree
{
  namespace
  {
    using Values = std::vector<double>;

    constexpr double half = .5;

    /// Nodes that agree, so that the others are in bands: cells that are no Voronoi cells, as those
    /// of graded lattices, leave half of the nodes alike at most.
    constexpr double majority = .6;

    /// What most of some positive numbers are; of two that are as common the one nearer to 1.
    struct Shared
    {
      double value = 0;
      double share = 0; ///< of the numbers, that are this to the tolerance
    };

    /// @param tolerance  relative
    Shared most_common(Values values, double tolerance)
    {
      std::sort(values.begin(), values.end());
      std::size_t best = 0;
      double value = 1;
      for (std::size_t from = 0, to = 0; to < values.size(); ++to)
      {
        while (values[to] > values[from] * (1 + 2 * tolerance))
          ++from;
        const double middle = values[(from + to) / 2];
        const std::size_t n = to - from + 1;
        if (n > best || (n == best && std::abs(std::log(middle)) < std::abs(std::log(value))))
        {
          best = n;
          value = middle;
        }
      }
      return {value, static_cast<double>(best) / static_cast<double>(values.size())};
    }

    /// Volumes over what they may be, of nodes [first, last).
    struct VolumeFit
    {
      Values areas;       ///< what the volumes are held against
      Values ratios;      ///< volumes over areas, over the middle
      double middle = 1;  ///< factor of most
      double share = 0;   ///< of nodes that have it to rounding
      Spread spread = {}; ///< of the ratios
    };

    template <int dim>
    VolumeFit fit(const GivenBonds<dim> &given, const Values &areas, std::size_t first,
                  std::size_t last)
    {
      constexpr double enough = 1. / 3;
      VolumeFit result{areas, {}};
      for (std::size_t i = first; i < last; ++i)
        result.ratios.push_back(given.volumes[i] / areas[i]);
      const Shared shared = most_common(result.ratios, given.precision.volume);
      result.share = shared.share;
      result.middle = shared.share >= enough ? shared.value : spread_of(result.ratios).median;
      for (double &ratio : result.ratios)
        ratio /= result.middle;
      result.spread = spread_of(result.ratios);
      return result;
    }

    bool is_better(const VolumeFit &one, const VolumeFit &other, double floor)
    {
      constexpr double clearly = .1; // more nodes
      if (std::abs(one.share - other.share) > clearly)
        return one.share > other.share;
      return one.spread.allowed(floor) < other.spread.allowed(floor);
    }

    /// Adds nodes [first, last) whose volume is an outlier.
    /// @param band_fits  a node that fits one of them is in no band; empty: there are none
    template <int dim>
    void add_outliers(const GivenBonds<dim> &given, const VolumeFit &best,
                      const std::vector<VolumeFit> &band_fits, std::size_t first, std::size_t last,
                      std::vector<Outlier<dim>> &outliers)
    {
      constexpr double band = .01; // what other ways to cut cells at a boundary hardly make
      const double floor = given.precision.volume, allowed = best.spread.allowed(floor);
      for (std::size_t i = first; i < last; ++i)
      {
        const double off = std::abs(best.ratios[i - first] - 1);
        const bool is_in_band =
            !band_fits.empty() &&
            std::all_of(band_fits.begin(), band_fits.end(),
                        [&](const VolumeFit &one)
                        {
                          const double middle = one.share >= majority ? one.middle : best.middle,
                                       ratio = given.volumes[i] / (middle * one.areas[i]);
                          return std::abs(ratio - 1) > std::max(band, 5 * floor);
                        });
        if (!(off > allowed || is_in_band))
          continue;
        Outlier<dim> one{Defect::volume, i};
        one.found = given.volumes[i];
        one.expected = best.middle * best.areas[i];
        one.distance = off > allowed ? off / allowed : off / band;
        outliers.push_back(one);
      }
    }

    /// The factor of all volumes of Ω; 1 where they are the areas, as far as their spread tells.
    double common_factor(const VolumeFit &fit, double floor)
    {
      constexpr double nearly_all = .9, small = .4; // of log(factor): cells that are cut otherwise
      const double off = std::abs(std::log(fit.middle)),
                   allowed = fit.share >= nearly_all
                                 ? 5 * floor
                                 : std::max(small, fit.spread.allowed(10 * floor));
      return off > allowed ? fit.middle : 1;
    }
  } // namespace

  template <int dim>
  VolumeCheck<dim> check_volumes(const GivenBonds<dim> &given, const Values &uncut_areas)
  {
    const geometry::NodeCells<dim> &cells = given.cells;
    const std::size_t n_free = given.families.size(), n = cells.size();
    const double floor = given.precision.volume;
    VolumeCheck<dim> check;
    check.mended = given.volumes;
    for (const auto &[first, last] : {std::pair{std::size_t{0}, n_free}, std::pair{n_free, n}})
    {
      if (first == last)
        continue;
      const bool is_free = first == 0;
      const double mean =
          std::accumulate(cells.area.begin() + static_cast<std::ptrdiff_t>(first),
                          cells.area.begin() + static_cast<std::ptrdiff_t>(last), 0.) /
          static_cast<double>(last - first);
      std::vector<VolumeFit> fits;
      for (const Values &areas : {cells.area, uncut_areas, Values(n, mean)})
        fits.push_back(fit(given, areas, first, last));
      const VolumeFit *best = &fits[0];
      for (const VolumeFit &one : fits)
        best = is_better(one, *best, floor) ? &one : best;
      if (is_free)
        check.factor = common_factor(*best, floor);
      const bool is_equal = fits[2].share >= majority;
      std::vector<VolumeFit> band_fits;
      if (is_free && best->share >= majority)
        band_fits = {fits[0], fits[1]};
      if (is_equal)
        band_fits = is_free ? fits : std::vector<VolumeFit>{fits[2]};
      if (is_equal && !is_free)
        best = &fits[2];
      const std::size_t n_before = check.outliers.size();
      add_outliers(given, *best, band_fits, first, last, check.outliers);
      for (std::size_t k = n_before; k < check.outliers.size(); ++k)
        check.mended[check.outliers[k].node] = check.outliers[k].expected;
      const double off = best->middle / check.factor;
      if (is_free || (off > half && off < 1 / half)) // else the collar's are without it
        for (std::size_t i = first; i < last; ++i)
          check.mended[i] /= check.factor;
    }
    std::stable_sort(check.outliers.begin(), check.outliers.end(),
                     [](const Outlier<dim> &a, const Outlier<dim> &b)
                     { return a.distance > b.distance; });
    return check;
  }

  std::string unit_text(double factor, int dim, double size)
  {
    struct Unit
    {
      double ratio; ///< how many of it make one of the other
      const char *text;
    };
    constexpr double same = 1e-4;
    constexpr std::array<Unit, 9> units = {{{1e3, "mm for m"},
                                            {1e2, "cm for m"},
                                            {1e1, "mm for cm"},
                                            {1e6, "um for m, or mm for km"},
                                            {1e9, "nm for m"},
                                            {25.4, "mm for inches"},
                                            {1 / .0254, "inches for m"},
                                            {1 / .3048, "feet for m"},
                                            {12, "inches for feet"}}};
    const double ratio = dim == 2 ? std::sqrt(factor) : std::cbrt(factor);
    const std::string plate = "for a plate of thickness " + base::to_text(factor, 4);
    if (dim == 3 && std::abs(factor * size - 1) < same)
      return "as areas h^2 in place of volumes h^3, h = " + base::to_text(size, 6);
    std::string text = dim == 2 ? "as " + plate : "as if in other units of length";
    for (const Unit &unit : units)
    {
      if (std::abs(ratio / unit.ratio - 1) < same)
        text = "as in units of length 1/" + base::to_text(unit.ratio, 6) + " of the scene's, " +
               unit.text;
      if (std::abs(ratio * unit.ratio - 1) < same)
        text = "as in units of length " + base::to_text(unit.ratio, 6) +
               " times the scene's, not " + unit.text + (dim == 2 ? ", or " + plate : "");
    }
    return text;
  }

  template VolumeCheck<2> check_volumes(const GivenBonds<2> &, const std::vector<double> &);
  template VolumeCheck<3> check_volumes(const GivenBonds<3> &, const std::vector<double> &);
} // namespace plumbline::meshfree
