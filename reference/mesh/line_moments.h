#pragma once

#include "physics/potential_jet.h"
#include "reference/mesh/edge_pairs.h"

namespace plumbline::reference
{
  /// The integrals of EdgeMoments over f alone, x being fixed on e; z = y - x.
  /// @tparam n  entries, see EdgePairs
  template <unsigned int degree, unsigned int n>
  class LineMoments
  {
  public:
    LineMoments(const Segment &e, const Segment &f, const Vector2 &z_at_start)
        : normal_e_(Point<2>(e.along[1], -e.along[0])),
          normal_f_(Point<2>(f.along[1], -f.along[0])), along_(f.along), z_(z_at_start),
          product_(normal_e_ * normal_f_)
    {
    }

    template <class Jets>
    void add(const Jets &jets, double t, double weight)
    {
      add_at(jets, z_ + t * along_, t, weight);
    }

    template <class Jets>
    void add_at(const Jets &jets, const Vector2 &z, double t, double weight)
    {
      const auto jet = jets.template at<degree + 1>(z.norm_square());
      const double along_e = normal_e_ * z, along_f = normal_f_ * z, twice = 2 * weight;
      const double across = 2 * along_e * along_f;
#pragma GCC unroll 3
      for (unsigned int k = 0; k <= degree; ++k)
        add_order(k, 0, t, -twice * (jet.first[k] * product_ + jet.second[k] * across),
                  -twice * jet.first[k] * along_e, twice * jet.first[k] * along_f);
      add_value(0, t, weight * jet.value);
      if constexpr (n == 3)
        add_rest(jet, z, along_e, along_f, t, weight);
    }

    /// @param sum  shape (n)
    void add_to(EdgeMoments *sum, double s, double weight) const
    {
      for (unsigned int i = 0; i <= highest; ++i, weight *= s)
        for (unsigned int entry = 0; entry < n; ++entry)
        {
          EdgeMoments &own = sum[entry];
          for (unsigned int k = 0; 2 * k + i <= highest; ++k)
            for (unsigned int j = 0; i + j + 2 * k <= highest; ++j)
              own.both[k][i][j] += weight * both_[entry][k][j];
          for (unsigned int k = 0; 2 * k + i + 1 <= highest; ++k)
            for (unsigned int j = 0; i + j + 2 * k + 1 <= highest; ++j)
            {
              own.of_x[k][i][j] += weight * of_x_[entry][k][j];
              own.of_y[k][i][j] += weight * of_y_[entry][k][j];
            }
          for (unsigned int j = 0; i + j + 2 <= highest; ++j)
            own.value[i][j] += weight * value_[entry][j];
        }
    }

  private:
    static constexpr unsigned int highest = 2 * degree;

    /// Of Ψ_2+k.
    void add_order(unsigned int k, unsigned int entry, double t, double both, double of_x,
                   double of_y)
    {
#pragma GCC unroll 5
      for (unsigned int j = 0; j <= highest - 2 * k; ++j, both *= t)
        both_[entry][k][j] += both;
#pragma GCC unroll 5
      for (unsigned int j = 0; j + 1 <= highest - 2 * k; ++j, of_x *= t, of_y *= t)
      {
        of_x_[entry][k][j] += of_x;
        of_y_[entry][k][j] += of_y;
      }
    }

    void add_value(unsigned int entry, double t, double value)
    {
#pragma GCC unroll 5
      for (unsigned int j = 0; j + 2 <= highest; ++j, value *= t)
        value_[entry][j] += value;
    }

    /// H v: with z = x + i y as a complex number, H_xx + i H_xy = ½ z², its derivative along a
    /// normal m is z m, the second one the product of both normals.
    void add_rest(const physics::TensorJet &jet, const Vector2 &z, double along_e, double along_f,
                  double t, double weight)
    {
      const auto times = [](const Vector2 &a, const Vector2 &b)
      { return Point<2>(a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]); };
      const Vector2 square = times(z, z), turned_e = times(z, normal_e_),
                    turned_f = times(z, normal_f_), normals = times(normal_e_, normal_f_);
      const Vector2 mixed = 2 * (along_f * turned_e + along_e * turned_f) + product_ * square;
      const double across = 2 * along_e * along_f;
#pragma GCC unroll 2
      for (unsigned int i = 0; i < 2; ++i)
      {
#pragma GCC unroll 3
        for (unsigned int k = 0; k <= degree; ++k)
          add_order(k, 1 + i, t,
                    -weight * (normals[i] * jet.v[k] + mixed[i] * jet.v_first[k] +
                               across * square[i] * jet.v_second[k]),
                    -weight * (turned_e[i] * jet.v[k] + square[i] * along_e * jet.v_first[k]),
                    weight * (turned_f[i] * jet.v[k] + square[i] * along_f * jet.v_first[k]));
        add_value(1 + i, t, .5 * weight * square[i] * jet.v[0]);
      }
    }

    Vector2 normal_e_, normal_f_, along_, z_;
    double product_;
    double both_[n][degree + 1][highest + 1] = {}, of_x_[n][degree + 1][highest + 1] = {},
                                          of_y_[n][degree + 1][highest + 1] = {},
                                          value_[n][highest + 1] = {};
  };
} // namespace plumbline::reference
