#include "reference/strip/cracked_strip.h"

#include "base/error.h"
#include "physics/crack_field.h"
#include "reference/strip/bond_pairs.h"
#include "reference/strip/strip_space.h"

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/vector.h>

#include <Eigen/Cholesky>

#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    using method::RiceStrip;
    using Form = BondPairs::Form;
    using Place = StripSpace::Place;
    using Eigen::VectorXd;
    using Values = dealii::Vector<double>;
    using dealii::Tensor;

    VectorXd join(const VectorXd &a, const VectorXd &b)
    {
      VectorXd both(a.size() + b.size());
      both << a, b;
      return both;
    }

    /// Bonds of a lattice without a crack: of pairs of cells, each pair once.
    struct PairForm
    {
      Place way; ///< from the first cell to the second
      Form form;
    };

    std::vector<PairForm> whole_pairs(const BondPairs &pairs)
    {
      std::vector<PairForm> all;
      const int reach = pairs.reach();
      for (int j = 0; j <= reach; ++j)
        for (int i = j > 0 ? -reach : 0; i <= reach; ++i)
          all.push_back({{i, j}, pairs.whole(i, j)});
      return all;
    }

    /// Those that a crack cuts, or a part of theirs.
    struct CutPair
    {
      Place first, second;
      Form form;
    };

    std::vector<CutPair> cut_pairs(const RiceStrip &strip, const BondPairs &pairs,
                                   const std::vector<PairForm> &whole)
    {
      std::vector<CutPair> cut;
      const int middle = strip.n_height / 2, reach = pairs.reach();
      for (const PairForm &pair : whole)
        for (int depth = 1; depth <= pair.way.row; ++depth) // rows of the first below the crack
          for (int column = -reach; column < strip.n_crack + reach; ++column)
          {
            const Place first{column, middle - depth},
                second{column + pair.way.column, middle - depth + pair.way.row};
            const int left = std::min(first.column, second.column),
                      right = std::max(first.column, second.column) + 1;
            if (left < -reach || left >= strip.n_crack)
              continue;
            cut.push_back({first, second,
                           right <= strip.n_crack ? pair.form
                                                  : pairs.broken(pair.way.column, pair.way.row,
                                                                 depth, strip.n_crack - column)});
          }
      return cut;
    }

    /// The intact strip, where nothing changes along x and only u_y is not zero.
    struct IntactStrip
    {
      std::vector<double> u; ///< of functions along y, from -reach rows on
      double energy = 0;     ///< of a column
      double at_end = 0;     ///< half of its bonds that cross a line
    };

    IntactStrip solve_intact(const RiceStrip &strip, const std::vector<PairForm> &whole, int reach,
                             const AxisShapes &shapes)
    {
      const auto n_axis = static_cast<int>(shapes.n_local());
      const int per_cell = shapes.is_continuous() ? n_axis - 1 : n_axis;
      const int n_rows = strip.n_height + 2 * reach,
                n = n_rows * per_cell + (shapes.is_continuous() ? 1 : 0);
      Form all = Form::Zero(n, n), across = all; // each bond as often as columns begin in it
      for (const PairForm &pair : whole)
      {
        Form part = Form::Zero(2 * n_axis, 2 * n_axis);
        const auto of = [&](Eigen::Index k) // a function's along y, of the first cell or the second
        { return k / 2 / (n_axis * n_axis) * n_axis + k / 2 % (n_axis * n_axis) / n_axis; };
        for (Eigen::Index k = 1; k < pair.form.rows(); k += 2)
          for (Eigen::Index l = 1; l < pair.form.rows(); l += 2)
            part(of(k), of(l)) += pair.form(k, l);
        for (int row = 0; row + pair.way.row < n_rows; ++row)
        {
          const int other = row + pair.way.row;
          if ((row < reach || row >= reach + strip.n_height) &&
              (other < reach || other >= reach + strip.n_height))
            continue; // of the grips alone
          const auto place = [&](int k)
          { return (k < n_axis ? row : other) * per_cell + k % n_axis; };
          for (int k = 0; k < 2 * n_axis; ++k)
            for (int l = 0; l < 2 * n_axis; ++l)
            {
              all(place(k), place(l)) += part(k, l);
              across(place(k), place(l)) += std::abs(pair.way.column) * part(k, l);
            }
        }
      }
      const int n_constrained = reach * per_cell + (shapes.is_continuous() ? 1 : 0),
                n_free = n - 2 * n_constrained;
      VectorXd u(n);
      u.head(n_constrained).setConstant(-1);
      u.tail(n_constrained).setConstant(1);
      u.segment(n_constrained, n_free).setZero();
      const VectorXd force = -(all * u).segment(n_constrained, n_free);
      u.segment(n_constrained, n_free) =
          all.block(n_constrained, n_constrained, n_free, n_free).ldlt().solve(force);
      return {{u.data(), u.data() + n}, .5 * u.dot(all * u), .25 * u.dot(across * u)};
    }

    /// Forces of bonds on free functions, as deal.II's solvers take an operator.
    class StripOperator
    {
    public:
      StripOperator(const StripSpace &space, const std::vector<PairForm> &whole,
                    const std::vector<CutPair> &cut)
          : space_(space), cut_(cut)
      {
        const Eigen::Index n = whole.front().form.rows() / 2;
        Form own = Form::Zero(n, n);
        for (const PairForm &pair : whole)
        {
          own += pair.form.topLeftCorner(n, n) + pair.form.bottomRightCorner(n, n);
          const Form across = pair.form.topRightCorner(n, n);
          if (pair.way.row == 0 && pair.way.column == 0)
            own += across + across.transpose();
          else
          {
            blocks_.push_back({pair.way, across});
            blocks_.push_back({{-pair.way.column, -pair.way.row}, across.transpose()});
          }
        }
        blocks_.push_back({{0, 0}, own});
      }

      /// Of all functions.
      void forces(Values &sum, const Values &u) const
      {
        sum.reinit(u.size());
        space_.visit_all(
            [&](const Place &cell)
            {
              if (!space_.is_inside(cell))
                return;
              VectorXd force = VectorXd::Zero(blocks_.back().form.rows());
              for (const PairForm &block : blocks_)
                force.noalias() += block.form * space_.gather(u, {cell.column + block.way.column,
                                                                  cell.row + block.way.row});
              space_.scatter(force, cell, sum);
            });
        for (const CutPair &pair : cut_)
          if (space_.is_inside(pair.first) || space_.is_inside(pair.second))
          {
            const VectorXd force =
                pair.form * join(space_.gather(u, pair.first), space_.gather(u, pair.second));
            space_.scatter(-force.head(force.size() / 2), pair.first, sum);
            space_.scatter(-force.tail(force.size() / 2), pair.second, sum);
          }
        for (unsigned int k = 0; k < space_.n_functions(); ++k)
          if (!space_.is_free(k))
            sum[2 * k] = sum[2 * k + 1] = 0;
      }

      /// @param u  zero where functions are constrained
      void vmult(Values &sum, const Values &u) const { forces(sum, u); }

      Values diagonal() const
      {
        Values sum(2 * space_.n_functions());
        space_.visit_all(
            [&](const Place &cell)
            {
              if (space_.is_inside(cell))
                space_.scatter(blocks_.back().form.diagonal(), cell, sum);
            });
        return sum;
      }

    private:
      const StripSpace &space_;
      const std::vector<CutPair> &cut_;
      std::vector<PairForm> blocks_; ///< what a cell gets from another; last, from itself
    };

    struct Jacobi
    {
      Values diagonal;

      void vmult(Values &x, const Values &b) const
      {
        for (unsigned int k = 0; k < x.size(); ++k)
          x[k] = diagonal[k] != 0 ? b[k] / diagonal[k] : 0;
      }
    };

    double energy(const StripSpace &space, const Values &u, const Place &first, const Place &second,
                  const Form &form)
    {
      const VectorXd both = join(space.gather(u, first), space.gather(u, second));
      return .5 * both.dot(form * both);
    }

    /// What is constrained: the grips and what is behind with them, what is ahead as the intact
    /// strip, which is a first guess between them.
    Values begin(const RiceStrip &strip, const StripSpace &space, const IntactStrip &intact,
                 const AxisShapes &shapes)
    {
      Values u(2 * space.n_functions());
      const unsigned int n_axis = shapes.n_local(),
                         per_cell = shapes.is_continuous() ? n_axis - 1 : n_axis;
      space.visit_all(
          [&](const Place &cell)
          {
            for (unsigned int k = 0; k < n_axis * n_axis; ++k)
            {
              const unsigned int function = space.functions(cell)[k];
              const bool is_behind =
                  cell.column < 0 || (space.support(function)[0] <= 0 && !space.is_free(function));
              u[2 * function + 1] =
                  is_behind && cell.row >= 0 && cell.row < strip.n_height
                      ? (space.is_upper(function) ? 1 : -1)
                      : intact.u[(cell.row + space.reach()) * per_cell + k / n_axis];
            }
          });
      return u;
    }

    /// The field of K, all around and for a first guess.
    Values begin_with_field(const RiceStrip &strip, const StripSpace &space)
    {
      Values u(2 * space.n_functions());
      for (unsigned int function = 0; function < space.n_functions(); ++function)
      {
        const geometry::Point<2> &at = space.support(function);
        const double y = std::copysign(at[1] - .5 * strip.n_height, // on the crack too
                                       space.is_upper(function) ? 1 : -1);
        const Tensor<1, 2> value =
            physics::crack_field(strip.h * geometry::Point<2>(at[0] - *strip.K_tip, y), {1, 1});
        for (unsigned int d = 0; d < 2; ++d)
          u[2 * function + d] = value[d];
      }
      return u;
    }

    void solve(const StripOperator &A, Values &u)
    {
      constexpr unsigned int most_steps = 5000;
      Values force, change(u.size());
      A.forces(force, u);
      force *= -1;
      dealii::SolverControl control(most_steps, 1e-13 * force.l2_norm());
      try
      {
        dealii::SolverCG<Values>(control).solve(A, change, force, Jacobi{A.diagonal()});
      }
      catch (const dealii::SolverControl::NoConvergence &error)
      {
        throw NumericalError("a strip with a crack is not solved in " + std::to_string(most_steps) +
                             " steps");
      }
      u += change;
    }

    /// u_y above less that below at the right side of a column.
    double opening(const StripSpace &space, const Values &u, int column, int middle,
                   const AxisShapes &shapes)
    {
      const unsigned int n_axis = shapes.n_local();
      const VectorXd above = space.gather(u, {column, middle}),
                     below = space.gather(u, {column, middle - 1});
      double jump = 0;
      for (unsigned int k = 0; k < n_axis * n_axis; ++k)
        jump += shapes.value(k % n_axis, 1) * (shapes.value(k / n_axis, 0) * above[2 * k + 1] -
                                               shapes.value(k / n_axis, 1) * below[2 * k + 1]);
      return jump;
    }
  } // namespace

  method::StripState solve_strip(const RiceStrip &strip, const physics::Kernel<2> &kernel,
                                 const AxisShapes &shapes)
  {
    const BondPairs pairs(kernel, strip.h, shapes);
    const std::vector<PairForm> whole = whole_pairs(pairs);
    const std::vector<CutPair> cut = cut_pairs(strip, pairs, whole);
    const StripSpace space(strip, pairs.reach(), shapes);
    method::StripState state;
    Values u;
    if (strip.K_tip)
    {
      state.intact = physics::crack_release({1, 1});
      u = begin_with_field(strip, space);
    }
    else
    {
      const IntactStrip intact = solve_intact(strip, whole, pairs.reach(), shapes);
      state.intact = intact.energy / strip.h;
      state.at_end = intact.at_end;
      u = begin(strip, space, intact, shapes);
    }
    solve(StripOperator(space, whole, cut), u);

    for (const PairForm &pair : whole)
      space.visit_all(
          [&](const Place &first)
          {
            const Place second{first.column + pair.way.column, first.row + pair.way.row};
            if (space.has(second) && (space.is_inside(first) || space.is_inside(second)))
              state.energy += energy(space, u, first, second, pair.form);
          });
    for (const CutPair &pair : cut)
      if (space.is_inside(pair.first) || space.is_inside(pair.second))
        state.energy -= energy(space, u, pair.first, pair.second, pair.form);
    for (int column = 0; column < strip.n_crack; ++column)
      state.opening.push_back(opening(space, u, column, strip.n_height / 2, shapes));
    for (unsigned int function = 0; function < space.n_functions(); ++function)
      state.n_unknowns += space.is_free(function) ? 2 : 0;
    return state;
  }
} // namespace plumbline::reference
