#include "reference/strip/bond_pairs.h"

#include "base/error.h"
#include "physics/gauss.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    using Corner = std::array<double, 2>;

    /// The part of a polygon where a value that is linear in it is negative.
    template <class Value>
    std::vector<Corner> cut(const std::vector<Corner> &polygon, const Value &value)
    {
      std::vector<Corner> part;
      for (std::size_t k = 0; k < polygon.size(); ++k)
      {
        const Corner &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const double at_a = value(a), at_b = value(b);
        if (at_a < 0)
          part.push_back(a);
        if ((at_a < 0) != (at_b < 0))
        {
          const double t = at_a / (at_a - at_b);
          part.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
        }
      }
      return part;
    }

    /// Calls visit(x, weight) for the points of a rule that is exact for polynomials of degree 2 (n
    /// - 1) on a polygon: triangles from its first corner, each as a square with one side of length
    /// 0.
    template <class Visit>
    void visit_points(const std::vector<Corner> &polygon, unsigned int n, const Visit &visit)
    {
      const dealii::Quadrature<1> &rule = physics::gauss(n);
      for (std::size_t k = 2; k < polygon.size(); ++k)
      {
        const Corner &o = polygon[0], &a = polygon[k - 1], &b = polygon[k];
        const double twice_area = (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
        for (unsigned int p = 0; p < n; ++p)
          for (unsigned int q = 0; q < n; ++q)
          {
            const double s = rule.point(p)[0], t = rule.point(q)[0] * s, r = s - t;
            visit(Corner{o[0] + r * (a[0] - o[0]) + t * (b[0] - o[0]),
                         o[1] + r * (a[1] - o[1]) + t * (b[1] - o[1])},
                  rule.weight(p) * rule.weight(q) * s * twice_area);
          }
      }
    }

    /// Angles in (0, π) where p sin - q cos = m sin cos, but for two that are all but one.
    void add_roots(double p, double q, double m, std::vector<double> &roots)
    {
      constexpr int n = 32;
      const auto f = [&](double angle)
      {
        const double cosine = std::cos(angle), sine = std::sin(angle);
        return p * sine - q * cosine - m * sine * cosine;
      };
      for (int k = 0; k < n; ++k)
      {
        double below = M_PI * k / n, above = M_PI * (k + 1) / n;
        const bool is_up = f(above) > 0;
        if ((f(below) > 0) == is_up)
          continue;
        for (int step = 0; step < 52; ++step)
        {
          const double middle = .5 * (below + above);
          ((f(middle) > 0) == is_up ? above : below) = middle;
        }
        roots.push_back(below);
      }
    }

    /// Sorted values in [from, to], with both, without those that are next to others.
    std::vector<double> pieces(std::vector<double> cuts, double from, double to)
    {
      constexpr double rounding = 1e-13;
      cuts.push_back(from);
      cuts.push_back(to);
      std::sort(cuts.begin(), cuts.end());
      std::vector<double> result;
      for (const double cut : cuts)
        if (cut >= from && cut <= to && (result.empty() || cut > result.back() + rounding))
          result.push_back(cut);
      return result;
    }
  } // namespace

  BondPairs::BondPairs(const physics::Kernel<2> &kernel, double h, const AxisShapes &shapes)
      : kernel_(kernel), h_(h), m_(kernel.horizon() / h), shapes_(shapes),
        n_axis_(shapes.n_local()), n_(n_axis_ * n_axis_)
  {
    if (kernel.structure() != physics::Structure::tensor || !kernel.breaks().empty())
      throw NumericalError("bonds between cells are those of a bond tensor without breaks");
  }

  int BondPairs::reach() const
  {
    return static_cast<int>(std::ceil(m_ * (1 - 1e-14)));
  }

  BondPairs::Form BondPairs::whole(int i, int j) const
  {
    return integrate(i, j, nullptr);
  }

  BondPairs::Form BondPairs::broken(int i, int j, int depth, double tip) const
  {
    const Crack crack{static_cast<double>(depth), tip};
    return integrate(i, j, &crack);
  }

  /// Angles in ascending order, of one half plane: bonds are counted once.
  std::vector<double> BondPairs::directions(int i, int j, const Crack *crack) const
  {
    const bool is_beside = j == 0 && i > 0; // bonds to the right, else upwards
    const double from = is_beside ? -M_PI / 2 : 0, to = is_beside ? M_PI / 2 : M_PI;
    std::vector<double> cuts;
    const auto add_direction = [&](double x, double y)
    {
      if (x != 0 || y != 0)
        cuts.push_back(std::atan2(y, x));
    };
    for (const int a : {i - 1, i, i + 1})
      for (const int b : {j - 1, j, j + 1})
        add_direction(a, b);
    for (const int a : {i - 1, i, i + 1})
      if (std::abs(a) < m_)
        for (const double sign : {-1, 1})
          add_direction(a, sign * std::sqrt(m_ * m_ - a * a));
    for (const int b : {j - 1, j, j + 1})
      if (std::abs(b) < m_)
        for (const double sign : {-1, 1})
          add_direction(sign * std::sqrt(m_ * m_ - b * b), b);
    if (crack != nullptr)
      for (const int a : {0, 1})
        for (const int b : {0, 1})
        {
          add_direction(i + a - crack->tip, j + b - crack->y);
          add_direction(crack->tip - a, crack->y - b);
          // where lengths are cut at the horizon, see `lengths`
          add_roots(crack->tip - a, crack->y - j - b, m_, cuts);
          add_roots(i + a - crack->tip, b - crack->y, m_, cuts);
        }
    return pieces(cuts, from, to);
  }

  /// Between which z = r (cosine, sine) gives polynomials of r; empty: no bond is like that.
  std::vector<double> BondPairs::lengths(int i, int j, double cosine, double sine,
                                         const Crack *crack) const
  {
    double from = 0, to = m_;
    std::vector<double> cuts;
    const auto cross = [&](int middle, double along)
    {
      if (along == 0)
      {
        if (middle != 0)
          to = 0;
        return;
      }
      const double first = (middle - 1) / along, last = (middle + 1) / along;
      from = std::max(from, std::min(first, last));
      to = std::min(to, std::max(first, last));
      cuts.push_back(middle / along);
    };
    cross(i, cosine);
    cross(j, sine);
    if (!(to > from))
      return {};
    if (crack != nullptr)
    {
      // bonds cross the crack's line at x + (its height over x) slope, which is the tip where x is
      // the corner (a, b - r sine) or (a - r cosine, b) of the rectangle
      const double slope = cosine / sine;
      for (const double a : {0, 1})
        for (const double b : {0, 1})
        {
          cuts.push_back((crack->tip - a - (crack->y - j - b) * slope) / cosine);
          cuts.push_back((i + a + (crack->y - b) * slope - crack->tip) / cosine);
        }
    }
    return pieces(cuts, from, to);
  }

  /// Of jumps φ(x + z) - φ(x) of all functions, over the points x of bonds z, shape (2 n, 2 n).
  BondPairs::Form BondPairs::products(int i, int j, double z1, double z2, const Crack *crack) const
  {
    const double left = std::max(0., i - z1), right = std::min(1., i + 1 - z1);
    const double lower = std::max(0., j - z2), upper = std::min(1., j + 1 - z2);
    std::vector<Corner> points = {{left, lower}, {right, lower}, {right, upper}, {left, upper}};
    if (crack != nullptr)
      points = cut(points, [&](const Corner &x)
                   { return x[0] + (crack->y - x[1]) * (z1 / z2) - crack->tip; });
    Eigen::VectorXd jump(2 * n_);
    Form sum = Form::Zero(2 * n_, 2 * n_);
    visit_points(points, 2 * shapes_.degree() + 1,
                 [&](const Corner &x, double weight)
                 {
                   for (unsigned int k = 0; k < n_; ++k)
                   {
                     const unsigned int a = k % n_axis_, b = k / n_axis_;
                     jump[k] = -shapes_.value(a, x[0]) * shapes_.value(b, x[1]);
                     jump[n_ + k] =
                         shapes_.value(a, x[0] + z1 - i) * shapes_.value(b, x[1] + z2 - j);
                   }
                   sum.noalias() += weight * jump * jump.transpose();
                 });
    return sum;
  }

  BondPairs::Form BondPairs::integrate(int i, int j, const Crack *crack) const
  {
    constexpr unsigned int n_angles = 12;
    const dealii::Quadrature<1> &of_angle = physics::gauss(n_angles),
                                &of_length = physics::gauss(2 * shapes_.degree() + 4);
    Form form = Form::Zero(4 * n_, 4 * n_);
    const std::vector<double> angles = directions(i, j, crack);
    for (std::size_t p = 0; p + 1 < angles.size(); ++p)
      for (unsigned int a = 0; a < of_angle.size(); ++a)
      {
        const double width = angles[p + 1] - angles[p],
                     angle = angles[p] + width * of_angle.point(a)[0];
        const Eigen::Vector2d way(std::cos(angle), std::sin(angle));
        const std::vector<double> cuts = lengths(i, j, way[0], way[1], crack);
        Form sum = Form::Zero(2 * n_, 2 * n_);
        for (std::size_t q = 0; q + 1 < cuts.size(); ++q)
          for (unsigned int b = 0; b < of_length.size(); ++b)
          {
            const double length = cuts[q + 1] - cuts[q],
                         r = cuts[q] + length * of_length.point(b)[0];
            sum += of_length.weight(b) * length * r * kernel_.radial(r * h_) *
                   products(i, j, r * way[0], r * way[1], crack);
          }
        const Eigen::Matrix2d tensor =
            of_angle.weight(a) * width * std::pow(h_, 4) * way * way.transpose();
        for (unsigned int k = 0; k < 2 * n_; ++k)
          for (unsigned int l = 0; l < 2 * n_; ++l)
            form.block<2, 2>(2 * k, 2 * l) += sum(k, l) * tensor;
      }
    return form;
  }
} // namespace plumbline::reference
