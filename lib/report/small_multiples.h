#pragma once

#include <array>
#include <string>

namespace plumbline::report
{
  /// Viridis at equal steps (Smith and van der Walt 2015) as a palette of gnuplot: lightness grows
  /// evenly, so that grey print and colour-blind readers keep the order.
  extern const char *const viridis;

  /// A picture of maps side by side with one colour bar, as commands of gnuplot; lengths are in
  /// pixels from the upper left corner.
  class SmallMultiples
  {
  public:
    /// @param lower, upper  corners of what each panel shows
    /// @param axes          names of the horizontal and the vertical coordinate
    SmallMultiples(std::size_t n, std::size_t n_columns, const std::array<double, 2> &lower,
                   const std::array<double, 2> &upper, std::string axes = "xy");

    double panel_width() const { return panel_width_; }

    /// Terminal, title and colour bar; palette and range are to be set behind it.
    std::string begin(const std::string &file, const std::string &title,
                      const std::string &colour_label) const;

    /// Where panel i is drawn, its title and axes; to be followed by a plot and next().
    std::string panel(std::size_t i, const std::string &title) const;
    static std::string next();

    static std::string end();

  private:
    double x(std::size_t i) const;
    double y(std::size_t i) const;
    double across(double pixels) const;
    double up(double pixels) const;
    std::string axis(char name, unsigned int d, bool has_figures) const;

    std::size_t n_, n_columns_;
    std::array<double, 2> lower_, upper_;
    std::string axes_;
    double left_; ///< margin for the figures of the y axis and its label [pixel]
    double panel_width_, panel_height_, height_;
  };
} // namespace plumbline::report
