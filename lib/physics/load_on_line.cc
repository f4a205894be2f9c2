#include "physics/load_on_line.h"

#include "base/error.h"
#include "physics/gauss.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

namespace plumbline::physics
{
  namespace
  {
    constexpr double tolerance = 1e-13; // of the terms that cancel
    constexpr unsigned int n_points = 14;

    struct Sum
    {
      double value = 0, mass = 0; ///< mass: ∫ |C|
      double largest = 0;         ///< |u|
    };

    struct Piece
    {
      double from = 0, to = 0;
      Sum sum;
      int depth = 0;
    };

    class Force
    {
    public:
      Force(const Kernel<1> &kernel, const FieldOnLine &u, double x)
          : kernel_(kernel), u_(u), x_(x), middle_(u(Point<1>(x), 0))
      {
      }

      double value() const
      {
        constexpr int most_depth = 40;
        constexpr unsigned int most_pieces = 4000;
        std::vector<Piece> open;
        double from = 0, mass = 0, largest = 0;
        const auto add = [&](double end)
        {
          open.push_back({from, end, sum(from, end), 0});
          mass += open.back().sum.mass;
          largest = std::max(largest, open.back().sum.largest);
          from = end;
        };
        for (const double end : kernel_.breaks())
          add(end);
        add(kernel_.horizon());
        double result = 0;
        unsigned int n_pieces = 0;
        while (!open.empty())
        {
          const Piece whole = open.back();
          open.pop_back();
          const double middle = whole.from + (whole.to - whole.from) / 2;
          const Piece lower{whole.from, middle, sum(whole.from, middle), whole.depth + 1},
              upper{middle, whole.to, sum(middle, whole.to), whole.depth + 1};
          const double halves = lower.sum.value + upper.sum.value;
          largest = std::max({largest, lower.sum.largest, upper.sum.largest});
          if (std::abs(halves - whole.sum.value) <= tolerance * 4 * mass * largest)
            result += halves;
          else if (whole.depth >= most_depth || ++n_pieces > most_pieces)
            refuse();
          else
          {
            open.push_back(lower);
            open.push_back(upper);
          }
        }
        return result;
      }

    private:
      Sum sum(double from, double to) const
      {
        Sum result;
        for (unsigned int q = 0; q < n_points; ++q)
        {
          const double r = from + (to - from) * gauss_.point(q)[0],
                       weight = (to - from) * gauss_.weight(q) * kernel_.radial(r),
                       right = u_(Point<1>(x_ + r), 0), left = u_(Point<1>(x_ - r), 0);
          result.value += weight * ((middle_ - right) + (middle_ - left));
          result.mass += std::abs(weight);
          result.largest =
              std::max({result.largest, std::abs(middle_), std::abs(right), std::abs(left)});
        }
        return result;
      }

      [[noreturn]] void refuse() const
      {
        std::ostringstream message;
        message << "the load that belongs to the solution (Problem/load = manufactured) cannot be "
                   "integrated at x = "
                << x_ << ": give a piecewise smooth solution, or the load itself";
        throw NumericalError(message.str());
      }

      const Kernel<1> &kernel_;
      const FieldOnLine &u_;
      double x_, middle_;
      const dealii::Quadrature<1> &gauss_ = gauss(n_points);
    };
  } // namespace

  FieldOnLine load_on_line(const Kernel<1> &kernel, FieldOnLine u)
  {
    return [kernel, u = std::move(u)](const Point<1> &x, unsigned int)
    { return Force(kernel, u, x[0]).value(); };
  }
} // namespace plumbline::physics
