#pragma once

#include "scene/scene.h"

#include <array>
#include <functional>
#include <vector>

namespace plumbline::study
{
  /// The local limit of double wells on a torus without a load: waves of the Navier equation with
  /// λ = μ, u_tt = μ/ρ (Δu + 2 ∇ div u), in one dimension u_tt = (modulus/ρ) u_xx. Each Fourier
  /// mode of the initial data evolves by itself, its part along k at speed c_L, across k at c_T.
  /// Jha & Lipton 2018, doi:10.1137/17M1112236, section 5, with the constants of
  /// physics::DoubleWell.
  class LocalWaves
  {
  public:
    /// A component of a field.
    using Field = std::function<double(const dealii::Point<2> &, unsigned int component)>;

    /// @param displacement, velocity  at t = 0; empty: 0
    /// @throws InputError  data that 40 periods per side (10 in two dimensions) do not resolve to
    /// 1e-9
    LocalWaves(const scene::Scene &scene, const Field &displacement, const Field &velocity);

    /// At a time, values of shape (n_nodes, n_components).
    struct State
    {
      std::vector<double> u, v;
    };
    State at(double t, const std::vector<dealii::Point<2>> &nodes) const;

  private:
    struct Mode
    {
      std::array<double, 2> k{};
      /// Amplitudes of cos k·x and sin k·x of u and v, by component.
      std::array<std::array<double, 2>, 2> u{}, v{};
    };
    Mode moved(const Mode &mode, double t) const;
    /// The modes of both fields, but for those below rounding.
    void transform(const std::array<const Field *, 2> &fields, const dealii::Tensor<1, 2> &side);
    /// At points between those of the transform.
    void check(const std::array<const Field *, 2> &fields, const dealii::Tensor<1, 2> &side) const;
    bool is_line() const { return n_components_ == 1; }
    long most() const { return is_line() ? 40 : 10; } ///< periods per side

    unsigned int n_components_;
    double longitudinal_, transverse_;
    dealii::Point<2> lower_;
    std::vector<Mode> modes_;
  };
} // namespace plumbline::study
