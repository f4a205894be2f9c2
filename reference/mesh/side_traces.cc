#include "reference/mesh/side_traces.h"

#include <algorithm>

namespace plumbline::reference
{
  namespace
  {
    constexpr unsigned int highest = 4;

    /// Σ c_ab ξ^a η^b, degree 4 at most.
    struct Polynomial
    {
      std::array<std::array<double, highest + 1>, highest + 1> c{};

      Polynomial derivative(unsigned int axis) const
      {
        Polynomial result;
        for (unsigned int a = 0; a <= highest; ++a)
          for (unsigned int b = 0; a + b <= highest; ++b)
            if (axis == 0 && a > 0)
              result.c[a - 1][b] = a * c[a][b];
            else if (axis == 1 && b > 0)
              result.c[a][b - 1] = b * c[a][b];
        return result;
      }

      Polynomial operator*(const Polynomial &other) const
      {
        Polynomial result;
        for (unsigned int a = 0; a <= highest; ++a)
          for (unsigned int b = 0; a + b <= highest; ++b)
            for (unsigned int i = 0; i + a + b <= highest; ++i)
              for (unsigned int j = 0; i + j + a + b <= highest; ++j)
                result.c[a + i][b + j] += c[a][b] * other.c[i][j];
        return result;
      }

      /// At start + s along.
      std::array<double, highest + 1> on_line(const Point<2> &start,
                                              const dealii::Tensor<1, 2> &along) const
      {
        Polynomial xi, eta, sum, power_of_xi; // polynomials in s alone: c[i][0]
        xi.c[0][0] = start[0];
        xi.c[1][0] = along[0];
        eta.c[0][0] = start[1];
        eta.c[1][0] = along[1];
        power_of_xi.c[0][0] = 1;
        for (unsigned int a = 0; a <= highest; ++a, power_of_xi = power_of_xi * xi)
        {
          Polynomial power = power_of_xi;
          for (unsigned int b = 0; a + b <= highest; ++b, power = power * eta)
            for (unsigned int i = 0; i <= highest; ++i)
              sum.c[i][0] += c[a][b] * power.c[i][0];
        }
        std::array<double, highest + 1> series{};
        for (unsigned int i = 0; i <= highest; ++i)
          series[i] = sum.c[i][0];
        return series;
      }
    };

    Polynomial linear(double constant, double xi, double eta)
    {
      Polynomial result;
      result.c[0][0] = constant;
      result.c[1][0] = xi;
      result.c[0][1] = eta;
      return result;
    }

    /// Lagrange's, in the order of CellShapes: vertices, then middles of sides.
    std::vector<Polynomial> shape_functions(unsigned int n_vertices, unsigned int degree)
    {
      if (degree == 0)
        return {linear(1, 0, 0)};
      const Polynomial xi = linear(0, 1, 0), eta = linear(0, 0, 1), left = linear(1, -1, 0),
                       below = linear(1, 0, -1);
      if (n_vertices == 4)
        return {left * below, xi * below, xi * eta, left * eta};
      const std::vector<Polynomial> corner = {linear(1, -1, -1), linear(0, 1, 0), linear(0, 0, 1)};
      if (degree == 1)
        return corner;
      std::vector<Polynomial> result;
      for (const Polynomial &l : corner)
      {
        Polynomial factor = l; // 2 l - 1
        for (auto &row : factor.c)
          for (double &value : row)
            value *= 2;
        factor.c[0][0] -= 1;
        result.push_back(l * factor);
      }
      for (unsigned int k = 0; k < 3; ++k)
        result.push_back(corner[k] * corner[(k + 1) % 3] * linear(4, 0, 0));
      return result;
    }
  } // namespace

  SideTraces::SideTraces(const CellShapes &shapes)
  {
    const unsigned int degree = total_degree(shapes);
    const auto basis = shape_functions(shapes.n_vertices(), shapes.degree());
    std::vector<std::pair<Polynomial, unsigned int>> functions;
    for (const Polynomial &phi : basis)
      functions.emplace_back(phi, degree);
    for (std::size_t a = 0; a < basis.size(); ++a)
      for (std::size_t b = a; b < basis.size(); ++b)
        functions.emplace_back(basis[a] * basis[b], 2 * degree);
    const std::vector<Point<2>> vertex = CellShapes(shapes.n_vertices(), 1).support();
    const std::size_t n_sides = vertex.size();
    for (const auto &[polynomial, of_polynomial] : functions)
    {
      Function function{of_polynomial, {}};
      function.sides.resize(n_sides);
      Polynomial by_xi = polynomial;
      for (unsigned int a = 0; a <= highest; ++a, by_xi = by_xi.derivative(0))
      {
        Polynomial derivative = by_xi;
        for (unsigned int b = 0; a + b <= highest; ++b, derivative = derivative.derivative(1))
          for (std::size_t side = 0; side < n_sides; ++side)
            for (const unsigned int back : {0u, 1u})
            {
              const Point<2> &from = vertex[(side + back) % n_sides],
                             &to = vertex[(side + 1 - back) % n_sides];
              function.sides[side][back][a][b] = derivative.on_line(from, to - from);
            }
      }
      functions_.push_back(function);
      coefficients_.push_back(polynomial.c);
    }
  }

  namespace
  {
    /// Derivatives in space by those in unit coordinates.
    struct Operators
    {
      Operators(const CellMap &map, const dealii::Tensor<1, 2> &normal)
      {
        // ∂/∂x = j0 ∂/∂ξ + j2 ∂/∂η, ∂/∂y = j1 ∂/∂ξ + j3 ∂/∂η
        const auto &j = map.inverse();
        n[0] = normal[0] * j[0] + normal[1] * j[1];
        n[1] = normal[0] * j[2] + normal[1] * j[3];
        const double laplace[3] = {j[0] * j[0] + j[1] * j[1], 2 * (j[0] * j[2] + j[1] * j[3]),
                                   j[2] * j[2] + j[3] * j[3]};
        for (unsigned int m = 0; m < 2; ++m)
          for (unsigned int k = 0; k <= 2 * m; ++k)
            for (unsigned int i = 0; i < 3; ++i)
              of_power[m + 1][k + i] += of_power[m][k] * laplace[i];
      }

      double n[2] = {}; ///< of ∂/∂ξ and ∂/∂η in the normal derivative
      double of_power[3][highest + 1] = {{1}}; ///< Δ^m = Σ_k of_power[m][k] ∂^2m/∂ξ^(2m-k) ∂η^k
    };

    Polynomial sum(double a, const Polynomial &p, double b, const Polynomial &q)
    {
      Polynomial result;
      for (unsigned int i = 0; i <= highest; ++i)
        for (unsigned int j = 0; i + j <= highest; ++j)
          result.c[i][j] = a * p.c[i][j] + b * q.c[i][j];
      return result;
    }
  } // namespace

  void SideTraces::find(const CellMap &map, const Segment &segment,
                        const dealii::Tensor<1, 2> &normal, std::vector<SideTrace> &traces) const
  {
    const Operators by(map, normal);
    const Point<2> start = map.unit(segment.start);
    const dealii::Tensor<1, 2> along = map.unit(segment.end) - start;
    traces.assign(functions_.size(), {});
    for (std::size_t f = 0; f < functions_.size(); ++f)
    {
      SideTrace &trace = traces[f];
      trace.degree = functions_[f].degree;
      Polynomial power{coefficients_[f]}; // Δ^m
      for (unsigned int m = 0; 2 * m <= trace.degree; ++m)
      {
        trace.value[m] = power.on_line(start, along);
        const Polynomial by_xi = power.derivative(0), by_eta = power.derivative(1);
        if (2 * m >= trace.degree)
          break;
        const auto slope = sum(by.n[0], by_xi, by.n[1], by_eta).on_line(start, along);
        std::copy_n(slope.begin(), trace.normal[m].size(), trace.normal[m].begin());
        power = sum(
            1, sum(by.of_power[1][0], by_xi.derivative(0), by.of_power[1][1], by_xi.derivative(1)),
            by.of_power[1][2], by_eta.derivative(1));
      }
    }
  }

  void SideTraces::find(const CellMap &map, unsigned int side, bool is_forward,
                        const dealii::Tensor<1, 2> &normal, std::vector<SideTrace> &traces) const
  {
    const Operators by(map, normal);
    traces.assign(functions_.size(), {});
    for (std::size_t f = 0; f < functions_.size(); ++f)
    {
      const auto &derivatives = functions_[f].sides[side][is_forward ? 0 : 1];
      SideTrace &trace = traces[f];
      trace.degree = functions_[f].degree;
      for (unsigned int m = 0; 2 * m <= trace.degree; ++m)
        for (unsigned int k = 0; k <= 2 * m; ++k)
          for (unsigned int i = 0; i + 2 * m <= trace.degree; ++i)
          {
            trace.value[m][i] += by.of_power[m][k] * derivatives[2 * m - k][k][i];
            if (i + 2 * m < trace.degree)
              trace.normal[m][i] +=
                  by.of_power[m][k] * (by.n[0] * derivatives[2 * m - k + 1][k][i] +
                                       by.n[1] * derivatives[2 * m - k][k + 1][i]);
          }
    }
  }
} // namespace plumbline::reference
