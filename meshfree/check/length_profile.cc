#include "meshfree/check/length_profile.h"

#include "meshfree/check/bond_pairs.h"
#include "meshfree/check/bond_profile.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    struct Sample
    {
      double length, ratio;
    };

    LengthProfile::Bin bin_of(std::vector<Sample>::const_iterator first,
                              std::vector<Sample>::const_iterator last)
    {
      std::vector<double> lengths, ratios;
      for (auto sample = first; sample != last; ++sample)
      {
        lengths.push_back(sample->length);
        ratios.push_back(sample->ratio);
      }
      const double middle = spread_of(ratios).median;
      double deviation = 0;
      for (const double ratio : ratios)
        deviation += std::abs(ratio - middle);
      return {spread_of(lengths).median, middle, deviation / static_cast<double>(ratios.size())};
    }
  } // namespace

  double LengthProfile::largest() const
  {
    double result = 0;
    for (const Bin &bin : bins)
      result = std::max(result, std::abs(bin.ratio));
    return result;
  }

  double LengthProfile::variation() const
  {
    if (!(largest() > 0))
      return 0;
    const auto [low, high] = std::minmax_element(
        bins.begin(), bins.end(), [](const Bin &a, const Bin &b) { return a.ratio < b.ratio; });
    return (high->ratio - low->ratio) / largest();
  }

  double LengthProfile::scatter() const
  {
    if (!(largest() > 0))
      return 0;
    std::vector<double> deviations;
    for (const Bin &bin : bins)
      deviations.push_back(bin.deviation);
    return spread_of(deviations).median / largest();
  }

  bool LengthProfile::falls() const
  {
    constexpr double slack = .02; // of the largest: scatter within the bins
    for (std::size_t b = 0; b + 1 < bins.size(); ++b)
      if (bins[b].ratio * bins[b + 1].ratio < 0 ||
          std::abs(bins[b + 1].ratio) > std::abs(bins[b].ratio) + slack * largest())
        return false;
    return true;
  }

  template <int dim>
  LengthProfile length_profile(const GivenBonds<dim> &given, VolumeOf volume)
  {
    constexpr std::size_t fewest = 30; // bonds of a bin
    constexpr double width = .1;       // in sizes
    const double size = node_size(given), longest = given.kernel.horizon() - .5 * size;
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < given.families.size(); ++i)
      for (std::size_t k = 0; k < given.families[i].bonds.size(); ++k)
      {
        const Bond<dim> &bond = given.families[i].bonds[k];
        const double length = bond.xi.norm();
        const std::size_t node = volume == VolumeOf::node ? i : given.families[i].neighbours[k];
        if (length <= longest)
          samples.push_back({length, bond.weight / given.volumes[node]});
      }
    std::sort(samples.begin(), samples.end(),
              [](const Sample &a, const Sample &b) { return a.length < b.length; });
    LengthProfile profile;
    auto first = samples.begin();
    for (auto sample = samples.begin(); sample != samples.end(); ++sample)
      if (static_cast<std::size_t>(sample - first) >= fewest &&
          static_cast<std::size_t>(samples.end() - sample) >= fewest &&
          sample->length - first->length > width * size)
      {
        profile.bins.push_back(bin_of(first, sample));
        first = sample;
      }
    if (samples.end() - first >= static_cast<std::ptrdiff_t>(fewest))
      profile.bins.push_back(bin_of(first, samples.end()));
    return profile;
  }

  template LengthProfile length_profile(const GivenBonds<2> &, VolumeOf);
  template LengthProfile length_profile(const GivenBonds<3> &, VolumeOf);
} // namespace plumbline::meshfree
