#include "method/lattice_motion.h"

#include "algebra/sparse.h"
#include "algebra/spectrum.h"
#include "base/error.h"
#include "method/lattice_discretisation.h"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <utility>

namespace plumbline::method
{
  namespace
  {
    using State = EquationOfMotion::State;
    using Map = Eigen::Map<const Eigen::VectorXd>;

    Map view(const State &x)
    {
      return {x.data(), static_cast<Eigen::Index>(x.size())};
    }

    State values(const Eigen::VectorXd &x)
    {
      return {x.data(), x.data() + x.size()};
    }

    Eigen::SparseMatrix<double> to_matrix(const algebra::Rows &rows)
    {
      const auto n = static_cast<Eigen::Index>(rows.n_rows());
      std::vector<Eigen::Triplet<double>> entries;
      for (std::size_t i = 0; i < rows.n_rows(); ++i)
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          entries.emplace_back(static_cast<int>(i), static_cast<int>(rows.column[k]),
                               rows.value[k]);
      Eigen::SparseMatrix<double> matrix(n, n);
      matrix.setFromTriplets(entries.begin(), entries.end());
      return matrix;
    }

    bool is_diagonal(const algebra::Stencil &stencil)
    {
      return stencil.n_entries() == stencil.n_blocks();
    }

    /// M = S Sᵀ, applied in parts: x = Sᵀ u, u = S⁻ᵀ x.
    class MassRoot
    {
    public:
      MassRoot(const algebra::Stencil &mass, const geometry::NodeSet &nodes)
      {
        if (is_diagonal(mass))
        {
          for (const std::size_t position : algebra::free_positions(nodes))
          {
            const auto s = static_cast<unsigned int>(position / nodes.n_positions());
            roots_.push_back(std::sqrt(mass(s, s, 0, 0)));
          }
          return;
        }
        factor_.compute(to_matrix(algebra::assemble(mass, nodes)));
        if (factor_.info() != Eigen::Success)
          throw NumericalError("the mass matrix is not positive definite");
        lower_ = factor_.matrixL();
      }

      State to_state(const State &u) const
      {
        if (roots_.empty())
          return values(lower_.transpose() * (factor_.permutationP() * view(u)));
        State x = u;
        for (std::size_t i = 0; i < x.size(); ++i)
          x[i] *= roots_[i];
        return x;
      }

      State to_unknowns(const State &x) const ///< S⁻ᵀ
      {
        if (roots_.empty())
          return values(factor_.permutationPinv() *
                        lower_.transpose().triangularView<Eigen::Upper>().solve(view(x)));
        return divided(x);
      }

      State of_force(const State &f) const ///< S⁻¹
      {
        if (roots_.empty())
          return values(
              lower_.triangularView<Eigen::Lower>().solve(factor_.permutationP() * view(f)));
        return divided(f);
      }

    private:
      State divided(State x) const
      {
        for (std::size_t i = 0; i < x.size(); ++i)
          x[i] /= roots_[i];
        return x;
      }

      State roots_; ///< of a diagonal matrix
      Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
      Eigen::SparseMatrix<double> lower_;
    };

    double dot(const State &x, const State &y)
    {
      return view(x).dot(view(y));
    }

    class LatticeMotion : public EquationOfMotion
    {
    public:
      explicit LatticeMotion(LatticeParts parts)
          : parts_(std::move(parts)), positions_(algebra::free_positions(parts_.nodes)),
            nodes_(free_points(parts_.lattice, parts_.nodes)), root_(parts_.mass, parts_.nodes),
            action_(algebra::restrict(
                algebra::make_operator(parts_.stiffness, parts_.nodes, parts_.backend),
                parts_.nodes.size(), positions_))
      {
      }

      std::size_t size() const override { return positions_.size(); }

      std::vector<double> drive(const scene::Problem &instant) const override
      {
        algebra::Vector load = parts_.load(instant);
        load -= around(parts_.stiffness, instant);
        return root_.of_force(unknowns(load));
      }

      std::vector<double> inertia(const scene::Problem &instant) const override
      {
        scene::Problem of_solution = instant;
        of_solution.load = *instant.solution;
        algebra::Vector load = parts_.load(of_solution);
        load -= around(parts_.mass, instant);
        return root_.of_force(unknowns(load));
      }

      State state(const scene::Field &field) const override
      {
        State u;
        for (const auto &node : nodes_)
          for (unsigned int c = 0; c < n_components(); ++c)
            u.push_back(field.value(node, c));
        return root_.to_state(u);
      }

      void acceleration(const State &u, const std::vector<double> &g, State &a) const override
      {
        stiffness(u, a);
        for (std::size_t i = 0; i < a.size(); ++i)
          a[i] = g[i] - a[i];
      }

      void tangent(const State &, const std::vector<double> &, const State &v,
                   State &out) const override
      {
        stiffness(v, out);
        for (double &value : out)
          value = -value;
      }

      double product(const State &u, const State &v) const override
      {
        return parts_.cell * dot(u, v);
      }

      double energy(const State &u, const std::vector<double> &) const override
      {
        State force(u.size());
        stiffness(u, force);
        return .5 * product(u, force);
      }

      double power(const State &, const State &v, const std::vector<double> &g,
                   const std::vector<double> &) const override
      {
        return product(g, v);
      }

      unsigned int n_components() const override { return parts_.nodes.n_components; }
      const std::vector<dealii::Point<2>> &nodes() const override { return nodes_; }
      std::vector<double> nodal(const State &u) const override { return root_.to_unknowns(u); }

    private:
      /// S⁻¹ A S⁻ᵀ x
      void stiffness(const State &x, State &out) const
      {
        State force(x.size());
        action_(root_.to_unknowns(x), force);
        out = root_.of_force(force);
      }

      algebra::Vector around(const algebra::Stencil &stencil, const scene::Problem &instant) const
      {
        return collar_action(stencil, parts_.nodes,
                             collar_values(instant, parts_.nodes, stencil.reach()));
      }

      State unknowns(const algebra::Vector &over_nodes) const
      {
        State u;
        u.reserve(positions_.size());
        for (const std::size_t position : positions_)
          u.push_back(over_nodes[position]);
        return u;
      }

      LatticeParts parts_;
      std::vector<std::size_t> positions_;
      std::vector<dealii::Point<2>> nodes_;
      MassRoot root_;
      algebra::Action action_;
    };
  } // namespace

  std::unique_ptr<EquationOfMotion> move_on_lattice(LatticeParts parts)
  {
    return std::make_unique<LatticeMotion>(std::move(parts));
  }

  std::vector<double> collar_values(const scene::Problem &problem, const geometry::NodeSet &nodes,
                                    int margin, std::vector<std::size_t> *held)
  {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(nodes.n_blocks()) * (nodes.n[0] + 2 * margin) *
                   (nodes.n[1] + 2 * margin));
    for (unsigned int c = 0; c < nodes.n_components; ++c)
      for (unsigned int s = 0; s < nodes.n_families(); ++s)
        for (int j = -margin; j < nodes.n[1] + margin; ++j)
          for (int i = -margin; i < nodes.n[0] + margin; ++i)
          {
            double value = 0;
            if (!nodes.free(s, i, j))
            {
              const auto place = nodes.place(s, i, j);
              value = problem.constraint.value(problem.lattice->point(place[0], place[1]), c);
              if (held != nullptr)
                held->push_back(values.size());
            }
            values.push_back(value);
          }
    return values;
  }
} // namespace plumbline::method
