#pragma once

#include "geometry/polygon.h"

#include <functional>

namespace plumbline::geometry
{
  /// Quadrature, on convex cells, of fields that jump or have kinks: `polygon_rule` on a cell, or
  /// on its quarters and quarters of these wherever the integral or the first moments of the parts
  /// are not those of the whole. Cells that a line of jumps
  /// crosses end as parts of 2^-depth of their size, with an error of some 2^-depth/10 of the jump
  /// times the cell's area; a sliver along the side of a cell or part may be missed, 1/80 of the
  /// cell. A feature that is narrower than the distance of points in a quarter, some 1/7 of a cell,
  /// may be missed whole.
  class RoughRule
  {
  public:
    using Value = std::function<double(const Point<2> &x)>;

    /// A rule with values of the field at its points.
    struct Sampled
    {
      CutRule rule;
      std::vector<double> values;
    };

    /// polygon_rule itself, for fields that are smooth in cells.
    explicit RoughRule(unsigned int degree) : degree_(degree) {}

    /// As deep as some 1e6 points in all cells allow, 8 at the most; how many of the cells are
    /// rough, and how fast their parts become more, is seen from a few hundred of them. Jumps of
    /// less than 1e-10 of the largest mean of |f| are not looked for.
    /// @param degree  of polygon_rule on each part
    RoughRule(unsigned int degree, std::size_t n_cells,
              const std::function<Polygon(std::size_t cell)> &cell, const Value &f);

    unsigned int depth() const { return depth_; }

    /// Thread safe for an f of the thread's own. @param result  overwritten
    void sample(const Polygon &cell, const Value &f, Sampled &result) const;

    /// ∫ f over a cell.
    double integral(const Polygon &cell, const Value &f) const;

  private:
    struct Part;
    Part part(Polygon polygon, const Value &f) const;
    /// @param tolerance  of integrals, found at depth 0
    void refine(const Part &whole, const Value &f, double tolerance, unsigned int depth,
                Sampled &result) const;

    unsigned int degree_, depth_ = 0;
    double negligible_ = 0; ///< a mean difference, beside the field's largest values
  };
} // namespace plumbline::geometry
