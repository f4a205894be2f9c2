#include "meshfree/scattered/double_well_motion.h"

#include "meshfree/rules/double_well_bonds.h"
#include "meshfree/rules/well_lanes.h"
#include "method/nodal_motion.h"

#include <deal.II/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    using algebra::Simd;
    using State = method::EquationOfMotion::State;
    using Pair = std::array<double, 2>;

    /// A bond of a free node, its force times the node's cell, ω in it.
    struct CellBond
    {
      unsigned int neighbour;
      Pair way; ///< q = way·(u_j - u_i), see well_unit
      double strength;
    };

    enum class Quantity
    {
      derivative,
      tangent,
      value
    };

    /// φ' of q², φ' + 2q²φ'' or φ.
    /// @param n  values, a multiple of simd_width
    template <Quantity quantity, class Lanes>
    PLUMBLINE_VECTOR_CLONES void shape_of(const Lanes &shape, const double *q, std::size_t n,
                                          double *result)
    {
      for (std::size_t k = 0; k < n; k += algebra::simd_width)
      {
        const Simd value = algebra::load<Simd>(q + k), square = value * value;
        Simd of_square{};
        if constexpr (quantity == Quantity::derivative)
          of_square = shape.derivative(square);
        else if constexpr (quantity == Quantity::tangent)
          of_square = shape.tangent(square);
        else
          of_square = shape.value(square);
        std::memcpy(result + k, &of_square, sizeof(of_square));
      }
    }

    /// What the bonds of one node see of a state: q, and a quantity of q².
    struct Row
    {
      std::vector<double> q, shape;
    };

    /// What drives states is √V b at the free nodes and behind it u at the constrained ones, shape
    /// (2, n_constrained).
    class ScatteredWells : public method::NodalMotion<>
    {
    public:
      ScatteredWells(const problem::Problem<2> &problem, const Families<2> &families)
          : cells_(problem.cells()), shape_(problem.double_well->shape()), start_{0}
      {
        const std::size_t n_free = cells_->n_free;
        nodes_.assign(cells_->nodes.begin(),
                      cells_->nodes.begin() + static_cast<std::ptrdiff_t>(n_free));
        Family<2> family;
        for (std::size_t i = 0; i < n_free; ++i)
        {
          roots_.push_back(std::sqrt(cells_->area[i]));
          families.make(i, family);
          for (std::size_t k = 0; k < family.bonds.size(); ++k)
            add_bond(problem, i, family.neighbours[k], family.bonds[k]);
          start_.push_back(bonds_.size());
        }
        is_symmetric_ = find_symmetry();
        all_.resize(2 * cells_->size());
      }

      std::vector<double> drive(const problem::Problem<2> &instant) const override
      {
        std::vector<double> g = state(instant.load);
        for (unsigned int c = 0; c < 2; ++c)
          for (std::size_t i = nodes_.size(); i < cells_->size(); ++i)
            g.push_back(instant.constraint.value(cells_->nodes[i], c));
        return g;
      }

      std::vector<double> inertia(const problem::Problem<2> &instant) const override
      {
        std::vector<double> g = state(*instant.solution);
        g.resize(2 * cells_->size());
        return g;
      }

      State state(const problem::Field<2> &field) const override
      {
        State x = NodalMotion::state(field);
        for (std::size_t i = 0; i < x.size(); ++i)
          x[i] *= root(i);
        return x;
      }

      std::vector<double> nodal(const State &x) const override
      {
        State u = x;
        for (std::size_t i = 0; i < u.size(); ++i)
          u[i] /= root(i);
        return NodalMotion::nodal(u);
      }

      void acceleration(const State &x, const std::vector<double> &g, State &a) const override
      {
        spread(x, g);
        a.assign(g.begin(), g.begin() + static_cast<std::ptrdiff_t>(size()));
        over_rows<Quantity::derivative>(
            [&](std::size_t i, const Row &row)
            {
              Pair sum{};
              for (std::size_t k = start_[i]; k < start_[i + 1]; ++k)
                add(sum, bonds_[k], pull(row, k - start_[i], bonds_[k]));
              for (unsigned int c = 0; c < 2; ++c)
                a[c * nodes_.size() + i] += sum[c] / roots_[i];
            });
      }

      /// With B_ij = ∂(cell times force)/∂u_j the symmetric part of u -> Σ_j B_ij (u_j - u_i).
      void tangent(const State &x, const std::vector<double> &g, const State &y,
                   State &out) const override
      {
        spread(x, g);
        const std::size_t n = nodes_.size();
        out.assign(size(), 0.);
        Row row;
        for (std::size_t i = 0; i < n; ++i)
        {
          see<Quantity::tangent>(i, row);
          for (std::size_t k = start_[i]; k < start_[i + 1]; ++k)
          {
            const CellBond &bond = bonds_[k];
            const double stiffness = bond.strength * row.shape[k - start_[i]];
            const std::size_t j = bond.neighbour;
            const double here = stretch(bond, y, i) / roots_[i],
                         there = j < n ? stretch(bond, y, j) / roots_[j] : 0;
            for (unsigned int c = 0; c < 2; ++c)
            {
              out[c * n + i] += stiffness * bond.way[c] * (.5 * there - here) / roots_[i];
              if (j < n)
                out[c * n + j] += .5 * stiffness * bond.way[c] * here / roots_[j];
            }
          }
        }
      }
      bool is_symmetric() const override { return is_symmetric_; }

      double product(const State &x, const State &y) const override
      {
        return std::inner_product(x.begin(), x.end(), y.begin(), 0.);
      }

      double energy(const State &x, const std::vector<double> &g) const override
      {
        spread(x, g);
        std::vector<double> of_node(nodes_.size());
        over_rows<Quantity::value>(
            [&](std::size_t i, const Row &row)
            {
              for (std::size_t k = start_[i]; k < start_[i + 1]; ++k)
              {
                // a bond between free nodes comes from both ends, one to a constrained node once
                const double ends = bonds_[k].neighbour < nodes_.size() ? 1 : 2;
                of_node[i] +=
                    ends * bonds_[k].strength / (4 * well_unit(shape_)) * row.shape[k - start_[i]];
              }
            });
        return std::accumulate(of_node.begin(), of_node.end(), 0.);
      }

      double power(const State &x, const State &v, const std::vector<double> &g,
                   const std::vector<double> &rate) const override
      {
        const std::size_t n = nodes_.size(), n_constrained = cells_->size() - n;
        double sum = std::inner_product(v.begin(), v.end(), g.begin(), 0.);
        spread(x, g);
        Row row;
        for (std::size_t i = 0; n_constrained > 0 && i < n; ++i)
        {
          see<Quantity::derivative>(i, row);
          for (std::size_t k = start_[i]; k < start_[i + 1]; ++k)
            if (bonds_[k].neighbour >= n)
            {
              const std::size_t constrained = size() + bonds_[k].neighbour - n;
              sum += pull(row, k - start_[i], bonds_[k]) *
                     (bonds_[k].way[0] * rate[constrained] +
                      bonds_[k].way[1] * rate[constrained + n_constrained]);
            }
        }
        return sum;
      }

      std::map<std::string, double> facts() const override
      {
        return {{"bonds of one evaluation", static_cast<double>(bonds_.size())}};
      }

    private:
      double root(std::size_t i) const { return roots_[i % roots_.size()]; }

      void add_bond(const problem::Problem<2> &problem, std::size_t i, unsigned int j,
                    const Bond<2> &bond)
      {
        const WellBond well = well_bond(*problem.double_well, bond.weight, bond.kernel_point);
        const double unit = well_unit(shape_), root = std::sqrt(unit);
        double strength = unit * cells_->area[i] * well.strength;
        if (problem.boundary_function)
          strength *= problem.boundary_function(cells_->nodes[i]) *
                      problem.boundary_function(cells_->nodes[j]);
        if (strength != 0)
          bonds_.push_back({j, {well.way[0] / root, well.way[1] / root}, strength});
      }

      /// Whether bonds between free nodes are the same from both ends, to rounding.
      bool find_symmetry() const
      {
        constexpr double rounding = 1e-12; // of the strongest bond
        const double strongest =
            std::accumulate(bonds_.begin(), bonds_.end(), 0.,
                            [](double largest, const CellBond &bond)
                            { return std::max(largest, std::abs(bond.strength)); });
        for (std::size_t i = 0; i < nodes_.size(); ++i)
          for (std::size_t k = start_[i]; k < start_[i + 1]; ++k)
          {
            const CellBond &bond = bonds_[k];
            if (bond.neighbour >= nodes_.size())
              continue;
            const auto end =
                bonds_.begin() + static_cast<std::ptrdiff_t>(start_[bond.neighbour + 1]);
            const auto back =
                std::find_if(bonds_.begin() + static_cast<std::ptrdiff_t>(start_[bond.neighbour]),
                             end, [i](const CellBond &other) { return other.neighbour == i; });
            if (back == end || std::abs(back->strength - bond.strength) > rounding * strongest ||
                std::hypot(back->way[0] + bond.way[0], back->way[1] + bond.way[1]) >
                    rounding * std::hypot(bond.way[0], bond.way[1]))
              return false;
          }
        return true;
      }

      /// u at all nodes, node by node.
      void spread(const State &x, const std::vector<double> &g) const
      {
        const std::size_t n = nodes_.size(), n_constrained = cells_->size() - n;
        for (unsigned int c = 0; c < 2; ++c)
        {
          for (std::size_t i = 0; i < n; ++i)
            all_[2 * i + c] = x[c * n + i] / roots_[i];
          for (std::size_t i = 0; i < n_constrained; ++i)
            all_[2 * (n + i) + c] = g[2 * n + c * n_constrained + i];
        }
      }

      template <Quantity quantity>
      void see(std::size_t i, Row &row) const
      {
        const std::size_t n = start_[i + 1] - start_[i], padded = (n + algebra::simd_width - 1) /
                                                                  algebra::simd_width *
                                                                  algebra::simd_width;
        row.q.assign(padded, 0.);
        row.shape.resize(padded);
        for (std::size_t k = 0; k < n; ++k)
        {
          const CellBond &bond = bonds_[start_[i] + k];
          const double *const there = &all_[2 * static_cast<std::size_t>(bond.neighbour)];
          row.q[k] =
              bond.way[0] * (there[0] - all_[2 * i]) + bond.way[1] * (there[1] - all_[2 * i + 1]);
        }
        const auto with = [&](const auto &shape)
        { shape_of<quantity>(shape, row.q.data(), padded, row.shape.data()); };
        if (shape_.is_exponential())
          with(ExponentialLanes(shape_));
        else
          with(TabulatedLanes(shape_));
      }

      /// @param visit  (node, row), of several nodes at a time
      template <Quantity quantity, typename Visit>
      void over_rows(const Visit &visit) const
      {
        constexpr unsigned int grain = 256; // nodes, worth a thread's while
        dealii::parallel::apply_to_subranges(
            static_cast<std::size_t>(0), nodes_.size(),
            [&](std::size_t from, std::size_t to)
            {
              Row row;
              for (std::size_t i = from; i < to; ++i)
              {
                see<quantity>(i, row);
                visit(i, row);
              }
            },
            grain);
      }

      /// The force along a bond's way, row.shape being the derivative.
      static double pull(const Row &row, std::size_t k, const CellBond &bond)
      {
        return bond.strength * row.q[k] * row.shape[k];
      }

      static void add(Pair &sum, const CellBond &bond, double pull)
      {
        for (unsigned int c = 0; c < 2; ++c)
          sum[c] += pull * bond.way[c];
      }

      double stretch(const CellBond &bond, const State &y, std::size_t i) const
      {
        return bond.way[0] * y[i] + bond.way[1] * y[nodes_.size() + i];
      }

      std::shared_ptr<const geometry::NodeCells<2>> cells_;
      physics::WellPotential shape_;
      std::vector<double> roots_;      ///< of the free nodes' cells
      std::vector<std::size_t> start_; ///< of each free node's bonds
      std::vector<CellBond> bonds_;
      bool is_symmetric_ = false;
      mutable std::vector<double> all_; ///< u, shape (n_nodes, 2)
    };
  } // namespace

  std::unique_ptr<method::EquationOfMotion> move_double_well(const problem::Problem<2> &problem,
                                                             const Families<2> &families)
  {
    return std::make_unique<ScatteredWells>(problem, families);
  }
} // namespace plumbline::meshfree
