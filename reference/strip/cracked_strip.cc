#include "reference/strip/cracked_strip.h"

#include "base/error.h"
#include "reference/strip/bond_pairs.h"

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/vector.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <map>
#include <tuple>

namespace plumbline::reference
{
  namespace
  {
    using geometry::Point;
    using method::RiceStrip;
    using Form = BondPairs::Form;
    using Eigen::VectorXd;
    using Values = dealii::Vector<double>;

    /// A cell, from the strip's lower left one; or how far another one is from it.
    struct Place
    {
      int column = 0, row = 0;
    };

    /// The cells of the strip and of what is held around it, and the functions on them: of two
    /// components each, continuous ones shared.
    class StripSpace
    {
    public:
      StripSpace(const RiceStrip &strip, int reach, const AxisShapes &shapes);

      int reach() const { return reach_; }
      bool is_inside(const Place &cell) const
      {
        return cell.column >= 0 && cell.column < strip_.n_length && cell.row >= 0 &&
               cell.row < strip_.n_height;
      }
      const unsigned int *functions(const Place &cell) const
      {
        return &functions_[index(cell) * n_];
      }
      std::size_t n_functions() const { return support_.size(); }
      const Point<2> &support(unsigned int function) const { return support_[function]; } // in h
      bool is_upper(unsigned int function) const { return is_upper_[function] != 0; }
      bool is_free(unsigned int function) const { return is_free_[function] != 0; }

      /// Calls visit(cell) for all, or for those of the strip.
      template <class Visit>
      void visit_all(const Visit &visit) const
      {
        for (int row = -reach_; row < strip_.n_height + reach_; ++row)
          for (int column = -reach_; column < strip_.n_length + reach_; ++column)
            visit(Place{column, row});
      }
      bool has(const Place &cell) const
      {
        return cell.column >= -reach_ && cell.column < strip_.n_length + reach_ &&
               cell.row >= -reach_ && cell.row < strip_.n_height + reach_;
      }

      VectorXd gather(const Values &u, const Place &cell) const
      {
        VectorXd values(2 * n_);
        const unsigned int *const function = functions(cell);
        for (unsigned int k = 0; k < n_; ++k)
          for (unsigned int d = 0; d < 2; ++d)
            values[2 * k + d] = u[2 * function[k] + d];
        return values;
      }
      void scatter(const VectorXd &values, const Place &cell, Values &sum) const
      {
        const unsigned int *const function = functions(cell);
        for (unsigned int k = 0; k < n_; ++k)
          for (unsigned int d = 0; d < 2; ++d)
            sum[2 * function[k] + d] += values[2 * k + d];
      }

    private:
      std::size_t index(const Place &cell) const
      {
        return static_cast<std::size_t>(cell.row + reach_) * (strip_.n_length + 2 * reach_) +
               cell.column + reach_;
      }

      RiceStrip strip_;
      int reach_;
      unsigned int n_; ///< functions of a cell
      std::vector<unsigned int> functions_;
      std::vector<Point<2>> support_;
      std::vector<char> is_upper_, is_free_;
    };

    StripSpace::StripSpace(const RiceStrip &strip, int reach, const AxisShapes &shapes)
        : strip_(strip), reach_(reach), n_(shapes.n_local() * shapes.n_local())
    {
      const unsigned int n_axis = shapes.n_local();
      const bool is_continuous = shapes.is_continuous();
      const int per_cell = static_cast<int>(is_continuous ? shapes.degree() : n_axis),
                middle = strip.n_height / 2;
      std::map<std::tuple<int, int, bool>, unsigned int> known; // by place, and side of the crack
      visit_all(
          [&](const Place &cell)
          {
            for (unsigned int k = 0; k < n_; ++k)
            {
              const int a = static_cast<int>(k % n_axis), b = static_cast<int>(k / n_axis);
              const int x = cell.column * per_cell + a, y = cell.row * per_cell + b;
              const bool is_upper = cell.row >= middle;
              const bool is_split =
                  is_continuous && y == middle * per_cell && x < strip.n_crack * per_cell;
              const auto [at, is_new] = known.try_emplace({x, y, is_split && is_upper},
                                                          static_cast<unsigned int>(known.size()));
              functions_.push_back(at->second);
              if (!is_new)
                continue;
              support_.emplace_back(cell.column + shapes.support_point(a),
                                    cell.row + shapes.support_point(b));
              is_upper_.push_back(is_upper);
              is_free_.push_back(is_continuous ? x > 0 && x < strip.n_length * per_cell && y > 0 &&
                                                     y < strip.n_height * per_cell
                                               : is_inside(cell));
            }
          });
    }

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
      const int n_held = reach * per_cell + (shapes.is_continuous() ? 1 : 0),
                n_free = n - 2 * n_held;
      VectorXd u(n);
      u.head(n_held).setConstant(-1);
      u.tail(n_held).setConstant(1);
      u.segment(n_held, n_free).setZero();
      const VectorXd force = -(all * u).segment(n_held, n_free);
      u.segment(n_held, n_free) = all.block(n_held, n_held, n_free, n_free).ldlt().solve(force);
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

      /// @param u  zero where functions are held
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

    /// What is held: the grips and what is behind with them, what is ahead as the intact strip,
    /// which is a first guess between them.
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
    const IntactStrip intact = solve_intact(strip, whole, pairs.reach(), shapes);
    Values u = begin(strip, space, intact, shapes);
    solve(StripOperator(space, whole, cut), u);

    method::StripState state;
    state.intact = intact.energy / strip.h;
    state.at_end = intact.at_end;
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
