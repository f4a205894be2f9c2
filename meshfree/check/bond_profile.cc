#include "meshfree/check/bond_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace plumbline::meshfree
{
  namespace
  {
    /// Bonds of a bin: enough to tell a few from the others.
    constexpr std::size_t fewest = 30;

    /// Bonds repeat where there are so many of a class on average.
    constexpr std::size_t repeated = 6;

    double nth(std::vector<double> &values, std::size_t n)
    {
      const auto at = values.begin() + static_cast<std::ptrdiff_t>(n);
      std::nth_element(values.begin(), at, values.end());
      return *at;
    }
  } // namespace

  double Spread::allowed(double floor) const
  {
    constexpr double in_deviations = 10, in_tails = 6;
    return std::max({floor, in_deviations * deviation, in_tails * tail});
  }

  Spread spread_of(const std::vector<double> &values)
  {
    constexpr double normal = 1.4826;
    constexpr std::size_t one_in = 13;
    if (values.empty())
      return {};
    std::vector<double> copy = values;
    Spread result;
    result.median = nth(copy, copy.size() / 2);
    for (double &value : copy)
      value = std::abs(value - result.median);
    result.deviation = normal * nth(copy, copy.size() / 2);
    const std::size_t n_beyond = std::max<std::size_t>(1, copy.size() / one_in);
    if (copy.size() > n_beyond)
      result.tail = nth(copy, copy.size() - 1 - n_beyond);
    return result;
  }

  template <int dim>
  std::vector<BondProfile::Shape> BondProfile::shapes(const std::vector<Point<dim>> &xi)
  {
    constexpr double irrational = 1.618033988749895; // no two pairs of whole numbers are alike
    std::vector<Shape> result;
    for (const Point<dim> &one : xi)
    {
      std::array<double, dim> sides{};
      for (unsigned int d = 0; d < dim; ++d)
        sides[d] = std::abs(one[d]);
      std::sort(sides.begin(), sides.end());
      result.push_back({one.norm(), sides[0] + (dim == 3 ? irrational * sides[1] : 0)});
    }
    return result;
  }

  template std::vector<BondProfile::Shape> BondProfile::shapes(const std::vector<Point<2>> &);
  template std::vector<BondProfile::Shape> BondProfile::shapes(const std::vector<Point<3>> &);

  BondProfile::BondProfile(const std::vector<Shape> &bonds, double size, double rounding)
      : order_(bonds.size())
  {
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(),
              [&](std::size_t a, std::size_t b) { return bonds[a].length < bonds[b].length; });
    constexpr double far_below = 1e-8; // what moves nodes, in sizes
    find_classes(bonds, std::max(far_below * size, 6 * rounding));
    if (!is_lattice_)
      find_bins(bonds, size);
  }

  void BondProfile::find_classes(const std::vector<Shape> &bonds, double same)
  {
    const auto side = [&](std::size_t k) { return bonds[k].side; };
    std::vector<std::size_t> classes = order_, start;
    for (std::size_t from = 0, to = 0; from < classes.size(); from = to)
    {
      while (to < classes.size() &&
             (to == from || bonds[classes[to]].length - bonds[classes[to - 1]].length <= same))
        ++to;
      std::sort(classes.begin() + static_cast<std::ptrdiff_t>(from),
                classes.begin() + static_cast<std::ptrdiff_t>(to),
                [&](std::size_t a, std::size_t b) { return side(a) < side(b); });
      for (std::size_t k = from; k < to; ++k)
        if (k == from || side(classes[k]) - side(classes[k - 1]) > same)
          start.push_back(k);
    }
    is_lattice_ = start.size() * repeated <= bonds.size();
    if (!is_lattice_)
      return;
    for (std::size_t c = 0; c < start.size(); ++c)
      like_.emplace_back(c, c + 1);
    start.push_back(classes.size());
    order_ = std::move(classes);
    start_ = std::move(start);
  }

  void BondProfile::find_bins(const std::vector<Shape> &bonds, double size)
  {
    constexpr double width = .1, reach = .5; // in sizes
    const auto length = [&](std::size_t k) { return bonds[order_[k]].length; };
    start_ = {0};
    for (std::size_t k = 0; k < order_.size(); ++k)
      if (k - start_.back() >= fewest && length(k) - length(start_.back()) > width * size &&
          order_.size() - k >= fewest)
        start_.push_back(k);
    start_.push_back(order_.size());
    const std::size_t n = start_.size() - 1;
    for (std::size_t bin = 0; bin < n; ++bin)
    {
      std::size_t first = bin, last = bin + 1;
      while (first > 0 && length(start_[bin]) - length(start_[first] - 1) < reach * size)
        --first;
      while (last < n && length(start_[last]) - length(start_[bin + 1] - 1) < reach * size)
        ++last;
      like_.emplace_back(first, last);
    }
  }

  std::vector<BondProfile::Usual> BondProfile::usual(const std::vector<double> &values,
                                                     double floor) const
  {
    std::vector<Spread> spreads;
    for (std::size_t bin = 0; bin < like_.size(); ++bin)
    {
      std::vector<double> own;
      for (std::size_t k = start_[bin]; k < start_[bin + 1]; ++k)
        own.push_back(values[order_[k]]);
      spreads.push_back(spread_of(own));
    }
    std::vector<Usual> result(values.size());
    for (std::size_t bin = 0; bin < like_.size(); ++bin)
    {
      Usual usual{spreads[bin].median, spreads[bin].median, floor};
      for (std::size_t other = like_[bin].first; other < like_[bin].second; ++other)
      {
        usual.low = std::min(usual.low, spreads[other].median);
        usual.high = std::max(usual.high, spreads[other].median);
        usual.allowed = std::max(usual.allowed, spreads[other].allowed(floor));
      }
      for (std::size_t k = start_[bin]; k < start_[bin + 1]; ++k)
        result[order_[k]] = usual;
    }
    return result;
  }
} // namespace plumbline::meshfree
