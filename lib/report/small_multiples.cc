#include "report/small_multiples.h"

#include "base/number_text.h"
#include "report/formats.h"
#include "report/plot.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace plumbline::report
{
  namespace
  {
    constexpr double width = 820, right = 136, top = 52, bottom = 86;
    constexpr double column_gap = 24, row_gap = 34, tallest = 380, head = 18;

    /// 1, 2 or 5 times a power of ten: two or three steps in the interval.
    double tick_step(double low, double high)
    {
      const double least = (high - low) / 3;
      const double power = std::pow(10., std::floor(std::log10(least)));
      for (const double factor : {1., 2., 5.})
        if (factor * power >= least)
          return factor * power;
      return 10 * power;
    }

    /// For the widest figure of the y axis, at its steps, and the label beside it.
    double left_margin(double low, double high)
    {
      constexpr double usual = 74, of_label = 46, character = 8;
      const double step = tick_step(low, high);
      std::size_t longest = 0;
      for (double tick = std::ceil(low / step); tick * step <= high; ++tick)
        longest = std::max(longest, base::to_text(tick * step, 6).size());
      return std::max(usual, of_label + character * static_cast<double>(longest));
    }
  } // namespace

  const char *const viridis = "0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', "
                              "5 '#28ae80', 6 '#5ec962', 7 '#addc30', 8 '#fde725'";

  SmallMultiples::SmallMultiples(std::size_t n, std::size_t n_columns,
                                 const std::array<double, 2> &lower,
                                 const std::array<double, 2> &upper, std::string axes)
      : n_(n), n_columns_(n_columns), lower_(lower), upper_(upper), axes_(std::move(axes)),
        left_(left_margin(lower[1], upper[1]))
  {
    const double aspect = (upper[1] - lower[1]) / (upper[0] - lower[0]);
    const auto columns = static_cast<double>(n_columns);
    panel_width_ = (width - left_ - right - (columns - 1) * column_gap) / columns;
    panel_height_ = aspect * panel_width_;
    if (panel_height_ > tallest)
    {
      panel_height_ = tallest;
      panel_width_ = tallest / aspect;
    }
    // The colour bar and its label need some height.
    height_ = std::max(360., y(n - 1) + panel_height_ + bottom);
  }

  double SmallMultiples::x(std::size_t i) const
  {
    return left_ + static_cast<double>(i % n_columns_) * (panel_width_ + column_gap);
  }

  double SmallMultiples::y(std::size_t i) const
  {
    return top + head + static_cast<double>(i / n_columns_) * (panel_height_ + row_gap);
  }

  double SmallMultiples::across(double pixels) const
  {
    return pixels / width;
  }

  double SmallMultiples::up(double pixels) const
  {
    return 1 - pixels / height_;
  }

  std::string SmallMultiples::begin(const std::string &file, const std::string &title,
                                    const std::string &colour_label) const
  {
    const double bar_height = std::min(320., height_ - top - head - bottom); // from the first panel
    std::ostringstream out;
    out << "set terminal svg size " << width << "," << height_
        << " dynamic enhanced font 'sans-serif,14' background '#ffffff'\nset output "
        << quote_gnuplot(file) << "\nset multiplot\n"
        << "set border lc rgb '#888888'\nset tics out scale .5 font ',11' textcolor rgb '#222222'\n"
        << "set cblabel " << quote_gnuplot(colour_label)
        << " noenhanced offset -.4,0 font ',12'\nset colorbox user origin screen "
        << across(x(n_columns_ - 1) + panel_width_ + 22) << ", screen "
        << up(top + head + bar_height) << " size screen " << across(14) << ", screen "
        << bar_height / height_ << " noborder\nset label 1 " << quote_gnuplot(title)
        << " at screen " << across(left_) << ", screen " << up(22)
        << " left noenhanced font ',15'\n";
    return out.str();
  }

  std::string SmallMultiples::axis(char name, unsigned int d, bool has_figures) const
  {
    std::ostringstream out;
    out << "set " << name << "range [" << exact(lower_[d]) << ":" << exact(upper_[d]) << "]\nset "
        << name << "tics nomirror " << exact(tick_step(lower_[d], upper_[d])) << "\nset format "
        << name << " '" << (has_figures ? "%g" : "") << "'\nset " << name << "label '"
        << (has_figures ? std::string(1, axes_[d]) + " [length]" : "") << "'"
        << (name == 'y' ? " offset 1.5,0" : "") << "\n"; // off the picture's edge
    return out.str();
  }

  std::string SmallMultiples::panel(std::size_t i, const std::string &title) const
  {
    std::ostringstream out;
    out << "set lmargin at screen " << across(x(i)) << "\nset rmargin at screen "
        << across(x(i) + panel_width_) << "\nset tmargin at screen " << up(y(i))
        << "\nset bmargin at screen " << up(y(i) + panel_height_) << "\nset title "
        << quote_gnuplot(title) << " noenhanced font ',12' offset 0,-.7\n"
        << axis('x', 0, i + n_columns_ >= n_) << axis('y', 1, i % n_columns_ == 0);
    return out.str();
  }

  std::string SmallMultiples::next()
  {
    return "unset label\nunset colorbox\n";
  }

  std::string SmallMultiples::end()
  {
    return "unset multiplot\nunset output\n";
  }
} // namespace plumbline::report
