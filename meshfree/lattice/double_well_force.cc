#include "meshfree/lattice/double_well_force.h"

#include "base/error.h"
#include "meshfree/rules/well_lanes.h"

#include <deal.II/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace plumbline::meshfree
{
  namespace
  {
    using algebra::Simd;
    using algebra::Wide;
    using algebra::width_of;

    constexpr int n_registers = 2, tile = algebra::wide * n_registers; // nodes of a row at a time
    constexpr int n_images = 4;

    /// Where a tile's values stand, fields `block` behind each other.
    struct Place
    {
      const double *u, *v;
      const double *omega; ///< null: 1
      std::size_t block;
    };

    /// Mirror images are numbered (+,+), (+,-), (-,+), (-,-) where they are oblique, and (+,0),
    /// (-,0), (0,+), (0,-) where they are axial; in 1D there are two.
    template <int dim, bool is_axial, class Vector>
    struct Images
    {
      static constexpr int n = dim == 1 ? 2 : n_images, width = width_of<Vector>;
      Vector value[n][n_registers];

      /// way·(u_j - u_i) of all images.
      template <class Group>
      [[gnu::always_inline]] void stretch(const Group &group, const double *u, std::size_t block)
      {
        for (int i = 0; i < n; ++i)
          for (int l = 0; l < n_registers; ++l)
          {
            const double *const from = u + l * width, *const to = from + group.shift[i];
            if constexpr (is_axial)
            {
              const std::size_t axis = i / 2;
              const double way = i % 2 == 0 ? group.way[0] : -group.way[0];
              value[i][l] = way * (algebra::load<Vector>(to + axis * block) -
                                   algebra::load<Vector>(from + axis * block));
            }
            else
            {
              const double way0 = i < 2 ? group.way[0] : -group.way[0];
              const double way1 = i % 2 == 0 ? group.way[1] : -group.way[1];
              value[i][l] =
                  way0 * (algebra::load<Vector>(to) - algebra::load<Vector>(from)) +
                  way1 * (algebra::load<Vector>(to + block) - algebra::load<Vector>(from + block));
            }
          }
      }

      /// Multiply by what the neighbours have.
      template <class Group>
      [[gnu::always_inline]] void weigh(const Group &group, const double *omega)
      {
        for (int i = 0; i < n; ++i)
          for (int l = 0; l < n_registers; ++l)
            value[i][l] *= algebra::load<Vector>(omega + group.shift[i] + l * width);
      }

      /// Add Σ value way. Images in a mirror are added before others, so that a mirror swaps
      /// summands.
      template <class Group>
      [[gnu::always_inline]] void add_vector(const Group &group, Vector (&sum)[dim][n_registers])
      {
        for (int l = 0; l < n_registers; ++l)
          if constexpr (is_axial)
            for (int axis = 0; axis < dim; ++axis)
              sum[axis][l] +=
                  group.strength * group.way[0] * (value[2 * axis][l] - value[2 * axis + 1][l]);
          else
          {
            sum[0][l] += group.strength * group.way[0] *
                         ((value[0][l] + value[1][l]) - (value[2][l] + value[3][l]));
            sum[1][l] += group.strength * group.way[1] *
                         ((value[0][l] + value[2][l]) - (value[1][l] + value[3][l]));
          }
      }

      template <class Group>
      [[gnu::always_inline]] void add_scalar(const Group &group, Vector (&sum)[dim][n_registers])
      {
        for (int i = 0; i < n; ++i)
          for (int l = 0; l < n_registers; ++l)
            sum[0][l] += group.strength * value[i][l];
      }
    };

    /// One tile of F (derivative 0), F' v (1) or the energy's density (-1).
    template <int dim, bool is_axial, int derivative, class Lanes, class Group, class Vector>
    [[gnu::always_inline]] inline void add_groups(const Place &at, const Lanes &shape,
                                                  const Group *group, const Group *end,
                                                  Vector (&sum)[dim][n_registers])
    {
      for (; group != end; ++group)
      {
        Images<dim, is_axial, Vector> q, change;
        q.stretch(*group, at.u, at.block);
        if constexpr (derivative == 1)
          change.stretch(*group, at.v, at.block);
        for (int i = 0; i < q.n; ++i)
          for (int l = 0; l < n_registers; ++l)
          {
            Vector &value = q.value[i][l];
            const Vector square = value * value;
            if constexpr (derivative == -1)
              value = shape.value(square);
            else if constexpr (derivative == 0)
              value *= shape.derivative(square);
            else
              value = change.value[i][l] * shape.tangent(square);
          }
        if (at.omega != nullptr)
          q.weigh(*group, at.omega);
        if constexpr (derivative == -1)
          q.add_scalar(*group, sum);
        else
          q.add_vector(*group, sum);
      }
    }

    /// The groups of bonds of every node.
    template <class Group>
    struct Groups
    {
      const Group *oblique, *oblique_end, *axial, *axial_end;
    };

    /// @param result  shape (dim, tile)
    template <int dim, int derivative, class Vector, class Lanes, class Group>
    [[gnu::always_inline]] inline void sum_tile(Place at, const Lanes &shape,
                                                const Groups<Group> &groups, double *result)
    {
      constexpr int part = n_registers * width_of<Vector>;
      for (int first = 0; first < tile; first += part)
      {
        Vector sum[dim][n_registers] = {};
        if constexpr (dim == 2)
          add_groups<dim, false, derivative>(at, shape, groups.oblique, groups.oblique_end, sum);
        add_groups<dim, true, derivative>(at, shape, groups.axial, groups.axial_end, sum);
        for (int a = 0; a < dim; ++a)
          std::memcpy(result + a * tile + first, sum[a], sizeof(sum[a]));
        at.u += part;
        at.v += part;
        if (at.omega != nullptr)
          at.omega += part;
      }
    }

    template <int dim, int derivative, class Lanes, class Group>
    PLUMBLINE_VECTOR_CLONES void sum_by_lanes(const Place &at, const Lanes &shape,
                                              const Groups<Group> &groups, double *result)
    {
      sum_tile<dim, derivative, Simd>(at, shape, groups, result);
    }

    template <int dim, int derivative, class Lanes, class Group>
    PLUMBLINE_WIDE_TARGET void sum_by_wide(const Place &at, const Lanes &shape,
                                           const Groups<Group> &groups, double *result)
    {
      sum_tile<dim, derivative, Wide>(at, shape, groups, result);
    }

    void check_omega(const std::vector<double> &omega, std::size_t n_nodes)
    {
      if (omega.empty())
        return;
      std::ostringstream message;
      message << "boundary function: ";
      if (omega.size() != n_nodes)
        message << omega.size() << " values for " << n_nodes << " nodes; give one a node";
      else if (const auto bad = std::find_if(omega.begin(), omega.end(),
                                             [](double value)
                                             { return !(value >= 0) || !std::isfinite(value); });
               bad != omega.end())
        message << *bad << " at node " << bad - omega.begin() << " is not in [0, infinity)";
      else if (*std::max_element(omega.begin(), omega.end()) == 0)
        message << "0 at all nodes, so there are no forces; it must be positive inside";
      else
        return;
      throw InputError(message.str());
    }

    /// The bond's strength; that of mirror images must be the same up to this.
    constexpr double mirror_tolerance = 1e-10;

    using Strengths = std::map<std::array<int, 2>, WellBond>;

    /// The means of four images, to which rounding gave different digits.
    WellBond mean(const Strengths &bonds, const std::vector<std::array<int, 2>> &images)
    {
      WellBond result;
      const WellBond &first = bonds.at(images[0]);
      for (const auto &k : images)
      {
        const auto found = bonds.find(k);
        const double strength = found == bonds.end() ? 0 : found->second.strength;
        if (!(std::abs(strength - first.strength) <= mirror_tolerance * std::abs(first.strength)))
          throw NumericalError("bonds to (" + std::to_string(images[0][0]) + ", " +
                               std::to_string(images[0][1]) +
                               ") and its mirror images differ; forces of two wells on lattices "
                               "need weights with the symmetry of the lattice");
        result.strength += strength / static_cast<double>(images.size());
        // the larger steps first: images across the diagonal exchange the axes
        const bool is_turned = std::abs(k[0]) < std::abs(k[1]) && images[0][1] == 0;
        for (unsigned int a = 0; a < 2; ++a)
          result.way[a] += std::abs(found->second.way[is_turned ? 1 - a : a]) /
                           static_cast<double>(images.size());
      }
      return result;
    }
  } // namespace

  template <int dim>
  DoubleWellForce<dim>::DoubleWellForce(const std::vector<WellBond> &bonds, double h,
                                        std::array<int, 2> n, Exterior exterior,
                                        std::vector<double> omega, Gradient mean_gradient,
                                        physics::WellPotential shape)
      : h_(h), n_(n), exterior_(exterior), jump_(mean_gradient), shape_(std::move(shape)), reach_(0)
  {
    if (!(h > 0) || !std::isfinite(h) || n[0] < 1 || n[1] < 1 || (dim == 1 && n[1] != 1))
      throw InputError("lattice: " + std::to_string(n[0]) + " x " + std::to_string(n[1]) +
                       " nodes of size h = " + std::to_string(h) +
                       "; give positive numbers, and one row in 1D");
    check_omega(omega, n_nodes());
    for (auto &row : jump_)
      for (unsigned int b = 0; b < dim; ++b)
        row[b] *= n[b] * h;
    Strengths known;
    for (const WellBond &bond : bonds)
    {
      if (bond.strength == 0)
        continue;
      known[bond.k] = bond;
      reach_ = std::max({reach_, std::abs(bond.k[0]), std::abs(bond.k[1])});
    }
    width_ = (n[0] + tile - 1) / tile * tile + 2 * reach_;
    block_size_ = width_ * (dim == 1 ? 1 : n[1] + 2 * reach_);
    padded_.resize(2 * dim * block_size_);
    const double unit = well_unit(shape_), root = std::sqrt(unit);
    for (const auto &entry : known)
    {
      const auto &[k1, k2] = entry.first;
      const bool is_axial = k2 == 0;
      if (k1 <= 0 || k2 < 0)
        continue;
      std::vector<std::array<int, 2>> images = {{k1, k2}, {k1, -k2}, {-k1, k2}, {-k1, -k2}};
      if (is_axial)
        images = dim == 1 ? std::vector<std::array<int, 2>>{{k1, 0}, {-k1, 0}}
                          : std::vector<std::array<int, 2>>{{k1, 0}, {-k1, 0}, {0, k1}, {0, -k1}};
      const WellBond one = mean(known, images);
      Group group{{}, {one.way[0] / root, one.way[1] / root}, unit * one.strength};
      for (std::size_t i = 0; i < images.size(); ++i)
        group.shift[i] = images[i][1] * static_cast<std::ptrdiff_t>(width_) + images[i][0];
      (is_axial ? axial_ : oblique_).push_back(group);
    }
    if (n_images * oblique_.size() + (dim == 1 ? 2 : 4) * axial_.size() != known.size())
      throw NumericalError("some bonds lack their mirror images; forces of two wells on lattices "
                           "need weights with the symmetry of the lattice");
    if (!omega.empty())
    {
      omega_.resize(block_size_);
      pad(omega.data(), {}, omega_.data());
    }
    else if (exterior == Exterior::empty)
    {
      omega_.resize(block_size_);
      pad(std::vector<double>(n_nodes(), 1.).data(), {}, omega_.data());
    }
  }

  template <int dim>
  std::uint64_t DoubleWellForce<dim>::n_bonds() const
  {
    return n_nodes() * (n_images * oblique_.size() + (dim == 1 ? 2 : 4) * axial_.size());
  }

  template <int dim>
  void DoubleWellForce<dim>::pad(const double *field, const std::array<double, dim> &jump,
                                 double *padded) const
  {
    const int margin = dim == 1 ? 0 : reach_;
    const auto periods = [](int i, int n) { return (i >= 0 ? i : i - n + 1) / n; };
    for (int j = -margin; j < n_[1] + margin; ++j)
    {
      double *const row = padded + (j + margin) * width_ + reach_;
      const int turns = periods(j, n_[1]);
      if (turns != 0 && exterior_ == Exterior::empty)
        continue;
      const double *const from = field + static_cast<std::size_t>(j - turns * n_[1]) * n_[0];
      const double lift = jump[dim - 1] * turns;
      std::copy_n(from, n_[0], row);
      if (lift != 0)
        std::for_each(row, row + n_[0], [&](double &value) { value += lift; });
      if (exterior_ == Exterior::periodic)
        for (int i = 0; i < reach_; ++i)
          for (const int k : {-1 - i, n_[0] + i})
          {
            const int around = periods(k, n_[0]);
            row[k] = from[k - around * n_[0]] + (lift + jump[0] * around);
          }
    }
  }

  template <int dim>
  template <typename DoubleWellForce<dim>::Quantity quantity, class Lanes>
  void DoubleWellForce<dim>::evaluate_rows(const Lanes &shape, int from, int to,
                                           double *result) const
  {
    constexpr int derivative = quantity == Quantity::force     ? 0
                               : quantity == Quantity::tangent ? 1
                                                               : -1;
    constexpr int n_results = quantity == Quantity::energy ? 1 : dim;
    const auto sum = algebra::has_wide_registers() ? sum_by_wide<dim, derivative, Lanes, Group>
                                                   : sum_by_lanes<dim, derivative, Lanes, Group>;
    const Groups<Group> groups{oblique_.data(), oblique_.data() + oblique_.size(), axial_.data(),
                               axial_.data() + axial_.size()};
    double sums[dim * tile];
    for (int j = from; j < to; ++j)
      for (int i = 0; i < n_[0]; i += tile)
      {
        const std::size_t node = (j + (dim == 1 ? 0 : reach_)) * width_ + reach_ + i;
        const double *const u = padded_.data() + node, *const omega = omega_.empty()
                                                                          ? nullptr
                                                                          : omega_.data() + node;
        sum({u, u + dim * block_size_, omega, block_size_}, shape, groups, sums);
        for (int a = 0; a < n_results; ++a)
          for (int l = 0; l < std::min(tile, n_[0] - i); ++l)
            result[(static_cast<std::size_t>(a) * n_[1] + j) * n_[0] + i + l] =
                sums[a * tile + l] * (omega == nullptr ? 1 : omega[l]);
      }
  }

  template <int dim>
  template <typename DoubleWellForce<dim>::Quantity quantity>
  void DoubleWellForce<dim>::evaluate(const std::vector<double> &u, const std::vector<double> *v,
                                      double *result) const
  {
    for (unsigned int a = 0; a < dim; ++a)
    {
      pad(u.data() + a * n_nodes(), jump_[a], padded_.data() + a * block_size_);
      if (v != nullptr)
        pad(v->data() + a * n_nodes(), {}, padded_.data() + (dim + a) * block_size_);
    }
    const auto with = [&](const auto &shape)
    {
      dealii::parallel::apply_to_subranges(
          0, n_[1], [&](int from, int to) { evaluate_rows<quantity>(shape, from, to, result); },
          16);
    };
    if (shape_.is_exponential())
      with(ExponentialLanes(shape_));
    else
      with(TabulatedLanes(shape_));
  }

  template <int dim>
  void DoubleWellForce<dim>::force(const std::vector<double> &u, std::vector<double> &f) const
  {
    f.resize(size());
    evaluate<Quantity::force>(u, nullptr, f.data());
  }

  template <int dim>
  void DoubleWellForce<dim>::tangent(const std::vector<double> &u, const std::vector<double> &v,
                                     std::vector<double> &f) const
  {
    f.resize(size());
    evaluate<Quantity::tangent>(u, &v, f.data());
  }

  template <int dim>
  double DoubleWellForce<dim>::energy(const std::vector<double> &u) const
  {
    std::vector<double> density(n_nodes());
    evaluate<Quantity::energy>(u, nullptr, density.data());
    double sum = 0;
    for (const double value : density)
      sum += value;
    return .25 / well_unit(shape_) * sum * (dim == 1 ? h_ : h_ * h_);
  }

  template class DoubleWellForce<1>;
  template class DoubleWellForce<2>;
} // namespace plumbline::meshfree
