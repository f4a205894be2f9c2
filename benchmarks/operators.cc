// Operator applications per bond.

#include "algebra/operator.h"
#include "meshfree/lattice/stencil.h"
#include "meshfree/rules/rules.h"
#include "parts.h"
#include "summary.h"

#include <deal.II/lac/vector.h>

#include <cmath>

namespace plumbline::benchmarks
{
  namespace
  {
    using algebra::OperatorBackend;

    physics::Kernel<2> make_kernel(bool is_tensor, double horizon)
    {
      const auto profile = physics::kernel_type(is_tensor ? "bond-tensor" : "linear-decay").profile;
      return is_tensor ? physics::Kernel<2>::with_bulk_modulus(profile, horizon, 1)
                       : physics::Kernel<2>::with_diffusion(profile, horizon, .5);
    }

    /// The least that a backend has to do, c components on n unknowns of each.
    /// direct: opposite bonds share their weight w (u(+) + u(-)): 3 operations for two bonds, 10 of
    /// a tensor, and a neighbour loaded for each bond; u and the result are moved, and a padded
    /// copy of u lies beside them.
    /// sparse: 2 operations, 12 bytes (value and column) and a neighbour an entry; u and the
    /// result.
    /// fft: 5/2 N log2 N operations of a real transform there and one back, N points with at
    /// least the reach of padding; a real factor for each of N/2 modes, of a tensor three; moved
    /// are u, the result and the factors, touched the field and its modes as well.
    Work work(OperatorBackend backend, double bonds, double n, double c, double n_padded)
    {
      const double vectors = 2 * 8 * c * n, entries = c * c * bonds;
      if (backend == OperatorBackend::direct)
        return {(c == 1 ? 1.5 : 5) * bonds, 8 * c * bonds, vectors, 1.5 * vectors};
      if (backend == OperatorBackend::sparse)
        return {2 * entries, 20 * entries, 12 * entries + vectors, 12 * entries + vectors};
      const double factors = 8 * n_padded / 2 * c * (c + 1) / 2;
      return {c * 5 * n_padded * std::log2(n_padded) + (c == 1 ? 1 : 6) * n_padded, 0,
              vectors + factors, vectors + factors + 2 * 8 * c * n_padded};
    }

    /// y = L_h x for IPA-AC on n × n nodes; arguments: m, n.
    void apply(benchmark::State &state, bool is_tensor, OperatorBackend backend)
    {
      const auto m = static_cast<double>(state.range(0));
      const auto n = static_cast<double>(state.range(1));
      const auto kernel = make_kernel(is_tensor, m / n);
      const auto stencil = meshfree::lattice_operator(
          kernel, meshfree::lattice_bonds(meshfree::improved_partial_area(kernel), kernel, 1 / n,
                                          geometry::Backend::fast));
      const geometry::Lattice lattice({{{{0, 0}, {1, 1}}}, {}}, 1 / n);
      const auto nodes = free_nodes(lattice, {{.5, false, 0}}, kernel.n_components());
      const auto matrix = make_operator(stencil, nodes, backend);
      algebra::Vector x(nodes.size()), y(nodes.size());
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = std::sin(static_cast<double>(i));
      for (auto _ : state)
      {
        matrix->vmult(y, x);
        benchmark::DoNotOptimize(y[0]);
      }
      // a bond is a pair of nodes, whatever the number of components
      const double c = kernel.n_components();
      const double bonds = static_cast<double>(matrix->n_bonds()) / (c * c);
      const double length = n + stencil.reach();
      count(state, "bonds", bonds, work(backend, bonds, n * n, c, length * length));
    }
    /// The same directly on n × n × n nodes in space.
    void apply_in_space(benchmark::State &state, bool is_tensor)
    {
      const auto m = static_cast<double>(state.range(0));
      const int n = static_cast<int>(state.range(1));
      const auto profile = physics::kernel_type(is_tensor ? "bond-tensor" : "linear-decay").profile;
      const auto kernel = is_tensor ? physics::Kernel<3>::with_bulk_modulus(profile, m / n, 1)
                                    : physics::Kernel<3>::with_diffusion(profile, m / n, .5);
      const auto stencil = meshfree::lattice_operator(
          kernel, meshfree::lattice_bonds(meshfree::improved_partial_area(kernel), kernel, 1. / n,
                                          geometry::Backend::fast));
      const auto matrix =
          make_operator(stencil, geometry::BoxNodes{{n, n, n}}, OperatorBackend::direct);
      const double c = kernel.n_components(), n_nodes = std::pow(n, 3);
      algebra::Vector x(static_cast<unsigned int>(c * n_nodes)), y(x.size());
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = std::sin(static_cast<double>(i));
      for (auto _ : state)
      {
        matrix->vmult(y, x);
        benchmark::DoNotOptimize(y[0]);
      }
      // for two opposite bonds, 9 multiplications and additions of a tensor and 3 sums
      const double bonds = static_cast<double>(matrix->n_bonds()) / (c * c);
      const double vectors = 2 * 8 * c * n_nodes;
      count(state, "bonds", bonds,
            {(c == 1 ? 1.5 : 10.5) * bonds, 8 * c * bonds, vectors, 1.5 * vectors});
    }
  } // namespace

  void register_operators()
  {
    const std::vector<std::pair<std::string, OperatorBackend>> backends = {
        {"direct", OperatorBackend::direct},
        {"fft", OperatorBackend::fft},
        {"sparse", OperatorBackend::sparse}};
    for (const bool is_tensor : {false, true})
      for (const auto &[name, backend] : backends)
      {
        const std::string title =
            std::string("apply/") + (is_tensor ? "tensor/" : "scalar/") + name;
        auto *bench =
            benchmark::RegisterBenchmark(title.c_str(), [=, backend = backend](benchmark::State &s)
                                         { apply(s, is_tensor, backend); });
        bench->ArgNames({"m", "n"})->Unit(benchmark::kMillisecond);
        // sizes where the sparse matrix still fits
        for (const auto &[m, n] : {std::pair<int, int>{3, 256}, {8, 256}, {16, 256}, {32, 128}})
          if (!is_tensor || m <= 16)
            bench->Args({m, is_tensor && m == 16 ? 128 : n});
      }
    for (const bool is_tensor : {false, true})
      benchmark::RegisterBenchmark(is_tensor ? "apply/space/tensor/direct"
                                             : "apply/space/scalar/direct",
                                   [=](benchmark::State &s) { apply_in_space(s, is_tensor); })
          ->ArgNames({"m", "n"})
          ->Args({3, 96})
          ->Args({5, 96})
          ->Unit(benchmark::kMillisecond);
    // vectors too large for any cache
    benchmark::RegisterBenchmark("apply/scalar/direct", apply, false, OperatorBackend::direct)
        ->ArgNames({"m", "n"})
        ->Args({3, 2048})
        ->Unit(benchmark::kMillisecond);
  }
} // namespace plumbline::benchmarks
