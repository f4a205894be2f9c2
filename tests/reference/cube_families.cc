// Galerkin methods with several families of shape functions in space: their entries against those
// of Q1 and against quadrature over pairs of cells, and the preconditioner.
#include "algebra/block_sine.h"
#include "algebra/family_system.h"
#include "base/error.h"
#include "reference/lattice/mass.h"
#include "reference/lattice/solid_stencil.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/vector.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace plumbline;
using namespace plumbline::reference;
using algebra::Vector;
using geometry::Point;
using physics::Kernel;

namespace
{
  using Index = std::array<int, 3>;

  Kernel<3> scalar_kernel(double delta)
  {
    return Kernel<3>::with_diffusion(physics::kernel_type("linear-decay").profile, delta, .5);
  }
  Kernel<3> tensor_kernel(double delta)
  {
    return Kernel<3>::with_bulk_modulus(physics::kernel_type("bond-tensor").profile, delta, 1);
  }

  double largest_entry(const algebra::Stencil &stencil)
  {
    double largest = 0;
    stencil.for_each_offset([&](int k1, int k2, int k3)
                            { largest = std::max(largest, std::abs(stencil(0, 0, k1, k2, k3))); });
    return largest;
  }

  /// A function along an axis as a sum of others: their families, cells and factors.
  struct Term
  {
    unsigned int family;
    int cell;
    double factor;
  };
  using Sum = std::vector<Term>;

  /// An entry between products of sums, with the second one k cells from the first.
  double entry_of_sums(const algebra::Stencil &stencil, unsigned int n_axis, unsigned int a,
                       unsigned int b, const Sum &sum, const Index &k)
  {
    const auto n = static_cast<int>(sum.size());
    double result = 0;
    geometry::for_each_index({0, 0, 0}, {n, n, n},
                             [&](const Index &i)
                             {
                               geometry::for_each_index(
                                   {0, 0, 0}, {n, n, n},
                                   [&](const Index &j)
                                   {
                                     unsigned int s = a, t = b;
                                     double factor = 1;
                                     Index offset{};
                                     for (unsigned int d = 3; d-- > 0;)
                                     {
                                       const Term &left = sum[i[d]], &right = sum[j[d]];
                                       s = s * n_axis + left.family;
                                       t = t * n_axis + right.family;
                                       factor *= left.factor * right.factor;
                                       offset[d] = k[d] + right.cell - left.cell;
                                       if (std::abs(offset[d]) > stencil.reach())
                                         return; // beyond the horizon
                                     }
                                     result +=
                                         factor * stencil(s, t, offset[0], offset[1], offset[2]);
                                   });
                             });
    return result;
  }

  /// Entries of the hat functions, put together from those of a space that holds them.
  double difference_from_hats(const Kernel<3> &kernel, double h, const AxisShapes &shapes,
                              const Sum &hat)
  {
    const auto hats = galerkin_stencil(kernel, h, AxisShapes(true, 1)),
               stencil = galerkin_stencil(kernel, h, shapes);
    double difference = 0;
    for (unsigned int a = 0; a < kernel.n_components(); ++a)
      for (unsigned int b = 0; b < kernel.n_components(); ++b)
        hats.for_each_offset(
            [&](int k1, int k2, int k3)
            {
              const double entry =
                  entry_of_sums(stencil, static_cast<unsigned int>(shapes.families().size()), a, b,
                                hat, {k1, k2, k3});
              difference = std::max(difference, std::abs(entry - hats(a, b, k1, k2, k3)));
            });
    return difference / largest_entry(hats);
  }
} // namespace

TEST(CubeFamilies, have_the_entries_of_the_hat_functions_in_them)
{
  const AxisShapes quadratic(true, 2), discontinuous(false, 1);
  const Sum as_quadratics = {{0, 0, 1}, {1, -1, .5}, {1, 0, .5}},
            as_discontinuous = {{1, -1, 1}, {0, 0, 1}};
  for (const double delta : {.1, .25})
  {
    EXPECT_LT(difference_from_hats(scalar_kernel(delta), .1, quadratic, as_quadratics), 1e-13);
    EXPECT_LT(difference_from_hats(scalar_kernel(delta), .1, discontinuous, as_discontinuous),
              1e-13);
  }
  EXPECT_LT(difference_from_hats(tensor_kernel(.15), .1, quadratic, as_quadratics), 1e-13);
  EXPECT_LT(difference_from_hats(tensor_kernel(.15), .1, discontinuous, as_discontinuous), 1e-13);
}

namespace
{
  /// -∫∫ C_ab(y - x) φ_s(x) φ_t(y) of two cells apart from each other and inside the horizon, by
  /// products of Gauss's rule; y in the cell k cells from that of x.
  double pair_of_cells(const Kernel<3> &kernel, unsigned int a, unsigned int b,
                       const AxisShapes &shapes, const std::array<unsigned int, 3> &s,
                       const std::array<unsigned int, 3> &t, const Index &k)
  {
    const dealii::QGauss<3> gauss(6);
    double sum = 0;
    for (unsigned int p = 0; p < gauss.size(); ++p)
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const Point<3> x = gauss.point(p), y = gauss.point(q);
        double value = gauss.weight(p) * gauss.weight(q);
        Point<3> z;
        for (unsigned int d = 0; d < 3; ++d)
        {
          z[d] = k[d] + y[d] - x[d];
          value *= shapes.value(s[d], x[d]) * shapes.value(t[d], y[d]);
        }
        sum -= value * kernel.radial(z.norm()) * kernel.direction_factor(a, b, z);
      }
    return sum;
  }
} // namespace

TEST(CubeFamilies, have_the_entries_of_a_quadrature_over_pairs_of_cells)
{
  const AxisShapes discontinuous(false, 1), quadratic(true, 2);
  const double delta = 6; // all of cells apart from each other
  const Index k = {3, -2, 2};
  const Kernel<3> scalar = scalar_kernel(delta), tensor = tensor_kernel(delta);
  const auto of_scalar = galerkin_stencil(scalar, 1, discontinuous);
  for (const auto &[s, t] : {std::pair{1u, 6u}, {0u, 5u}})
    EXPECT_NEAR(of_scalar(s, t, k[0], k[1], k[2]) / pair_of_cells(scalar, 0, 0, discontinuous,
                                                                  {s % 2, s / 2 % 2, s / 4},
                                                                  {t % 2, t / 2 % 2, t / 4}, k),
                1, 1e-9);
  // the function of degree 2 in the middle of the cell, which is that of one cell alone
  const auto of_tensor = galerkin_stencil(tensor, 1, quadratic);
  EXPECT_NEAR(of_tensor(0 * 8 + 7, 2 * 8 + 7, k[0], k[1], k[2]) /
                  pair_of_cells(tensor, 0, 2, quadratic, {1, 1, 1}, {1, 1, 1}, k),
              1, 1e-9);
}

namespace
{
  /// (A u)(family, position) / ∫ φ of a field given by its values at the nodes.
  template <typename Field>
  std::vector<double> applied(const algebra::Stencil &stencil, const AxisShapes &shapes, double h,
                              unsigned int n_components, const Field &field)
  {
    const auto n_axis = static_cast<unsigned int>(shapes.families().size());
    const unsigned int n_families = n_axis * n_axis * n_axis;
    const algebra::Stencil mass = mass_stencil<3>(shapes, 1, h);
    std::vector<double> result;
    for (unsigned int a = 0; a < n_components; ++a)
      for (unsigned int s = 0; s < n_families; ++s)
      {
        double sum = 0, tested = 0;
        for (unsigned int t = 0; t < n_families; ++t)
        {
          stencil.for_each_offset(
              [&](int k1, int k2, int k3)
              {
                Point<3> x(k1, k2, k3);
                unsigned int family = t;
                for (unsigned int d = 0; d < 3; ++d, family /= n_axis)
                  x[d] = h * (x[d] + shapes.families()[family % n_axis].offset);
                for (unsigned int b = 0; b < n_components; ++b)
                  sum += stencil(a * n_families + s, b * n_families + t, k1, k2, k3) * field(x, b);
              });
          mass.for_each_offset([&](int k1, int k2, int k3) { tested += mass(s, t, k1, k2, k3); });
        }
        result.push_back(sum / tested);
      }
    return result;
  }
} // namespace

TEST(CubeFamilies, take_fields_of_the_space_to_the_exact_force)
{
  const double h = .1;
  const auto linear = [](const Point<3> &x, unsigned int c)
  { return 3 * x[0] - 2 * x[1] + x[2] * (1. + c); };
  const auto quadratic = [](const Point<3> &x, unsigned int c)
  {
    return c == 0   ? x[0] * x[0] + 2 * x[1] * x[1] + x[0] * x[2]
           : c == 1 ? 3 * x[2] * x[2] - x[0] * x[1]
                    : x[1] * x[1] + x[0];
  };
  for (const AxisShapes &shapes : {AxisShapes(true, 2), AxisShapes(false, 1), AxisShapes(false, 2)})
    for (const bool is_scalar : {true, false})
    {
      const Kernel<3> kernel = is_scalar ? scalar_kernel(.25) : tensor_kernel(.15);
      const unsigned int n_components = kernel.n_components();
      if (!is_scalar && shapes.families().size() > 2)
        continue; // it takes long
      const auto stencil = galerkin_stencil(kernel, h, shapes);
      const double rounding = 1e-12 * largest_entry(stencil) / (h * h * h);
      for (const double force : applied(stencil, shapes, h, n_components, linear))
        EXPECT_NEAR(force, 0, rounding);
      if (shapes.degree() < 2)
        continue;
      // μ = λ: -½ Σ ∫ C_ab ξ_c ξ_d ∂_cd u_b = -(μ Δu + 2 μ ∇ div u)
      const double mu = is_scalar ? .5 : kernel.moment({0, 2, 0}, 0, 0) / 2;
      const std::array<double, 3> laplacian = {6, 6, 2}, grad_div = {2 - 1, 0, 1};
      const auto forces = applied(stencil, shapes, h, n_components, quadratic);
      for (std::size_t i = 0; i < forces.size(); ++i)
      {
        const std::size_t a = i / (forces.size() / n_components);
        EXPECT_NEAR(forces[i], -mu * (laplacian[a] + (is_scalar ? 0 : 2 * grad_div[a])),
                    10 * rounding);
      }
    }
}

namespace
{
  /// A field on a box of cells, odd about its sides: its value at any position.
  class OddField
  {
  public:
    OddField(const geometry::CubeFamilies &nodes, const Vector &values)
        : nodes_(nodes), values_(values)
    {
    }
    double operator()(unsigned int component, unsigned int family, Index at) const
    {
      auto along = nodes_.along(family);
      double sign = 1;
      for (unsigned int d = 0; d < 3; ++d)
      {
        const int n = nodes_.n[d];
        at[d] = ((at[d] % (2 * n)) + 2 * n) % (2 * n);
        const geometry::AxisSpecies &species = nodes_.axis[along[d]];
        if (species.at_vertex && at[d] % n == 0)
          return 0;
        if (at[d] >= n)
        {
          at[d] = species.at_vertex ? 2 * n - at[d] : 2 * n - 1 - at[d];
          along[d] = species.mirror;
          sign = -sign;
        }
      }
      const auto n_axis = static_cast<unsigned int>(nodes_.axis.size());
      const std::size_t block =
          component * nodes_.n_families() + along[0] + n_axis * (along[1] + n_axis * along[2]);
      return sign * values_[block * nodes_.n_positions() + geometry::number_within(at, nodes_.n)];
    }

  private:
    const geometry::CubeFamilies &nodes_;
    const Vector &values_;
  };

  Vector random_field(const geometry::CubeFamilies &nodes, unsigned int seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Vector u(nodes.size());
    for (const std::size_t place : nodes.free_places())
      u[place] = uniform(random);
    return u;
  }
} // namespace

TEST(BlockSine, inverts_the_stencil_on_odd_fields)
{
  const geometry::CubeLattice lattice({{{{0, 0, 0}, {4, 3, 5}}}, {}}, 1);
  for (const AxisShapes &shapes : {AxisShapes(true, 2), AxisShapes(false, 1), AxisShapes(false, 2)})
  {
    const auto nodes = geometry::free_families(lattice, shapes.families(), 1);
    const auto stencil = galerkin_stencil(scalar_kernel(1.5), 1, shapes);
    const Vector u = random_field(nodes, 5);
    const OddField odd(nodes, u);
    Vector force(nodes.size()), found(nodes.size());
    for (const std::size_t place : nodes.free_places())
    {
      const auto family = static_cast<unsigned int>(place / nodes.n_positions());
      const auto i = static_cast<int>(place % nodes.n_positions());
      const Index at = {i % 4, i / 4 % 3, i / 12};
      for (unsigned int t = 0; t < nodes.n_families(); ++t)
        stencil.for_each_offset(
            [&](int k1, int k2, int k3)
            {
              force[place] +=
                  stencil(family, t, k1, k2, k3) * odd(0, t, {at[0] + k1, at[1] + k2, at[2] + k3});
            });
    }
    algebra::make_block_sine_solver(stencil, nodes, {{0, 0, 0}, lattice.n_cells()})
        ->add_inverse(found, force);
    found -= u;
    EXPECT_LT(found.linfty_norm(), 1e-12);
  }
}

TEST(BlockSine, is_symmetric_on_parts_of_a_domain_and_zero_elsewhere)
{
  const geometry::CubeLattice lattice({{{{0, 0, 0}, {4, 2, 3}}, {{0, 0, 0}, {1, 4, 3}}}, {}}, 1);
  for (const AxisShapes &shapes : {AxisShapes(true, 2), AxisShapes(false, 1)})
  {
    const auto nodes = geometry::free_families(lattice, shapes.families(), 3);
    const auto stencil = galerkin_stencil(tensor_kernel(1.2), 1, shapes);
    const auto solver = algebra::make_block_sine_solver(stencil, nodes, {{0, 0, 0}, {1, 4, 3}});
    const Vector u = random_field(nodes, 5), v = random_field(nodes, 6);
    Vector of_u(nodes.size()), of_v(nodes.size());
    solver->add_inverse(of_u, u);
    solver->add_inverse(of_v, v);
    EXPECT_NEAR(of_u * v, of_v * u, 1e-12 * std::abs(of_u * u));
    EXPECT_GT(of_u * u, 0);
    for (unsigned int block = 0; block < nodes.n_blocks(); ++block)
      geometry::for_each_index(
          {0, 0, 0}, nodes.n,
          [&](const Index &at)
          {
            if (!nodes.free(block % nodes.n_families(), at) || at[0] > 0)
            {
              EXPECT_EQ(of_u[block * nodes.n_positions() + geometry::number_within(at, nodes.n)],
                        0);
            }
          });
  }
}

TEST(BlockSine, refuses_an_operator_that_is_not_positive_definite)
{
  const AxisShapes shapes(false, 1);
  const geometry::CubeLattice lattice({{{{0, 0, 0}, {3, 3, 3}}}, {}}, 1);
  const auto nodes = geometry::free_families(lattice, shapes.families(), 1);
  auto stencil = galerkin_stencil(scalar_kernel(1.5), 1, shapes);
  for (unsigned int s = 0; s < 8; ++s)
    stencil(s, s, 0, 0, 0) *= .5;
  EXPECT_THROW(algebra::make_block_sine_solver(stencil, nodes, {{0, 0, 0}, lattice.n_cells()}),
               NumericalError);
  EXPECT_THROW(algebra::make_operator(stencil, nodes, algebra::OperatorBackend::direct),
               InputError);
}
