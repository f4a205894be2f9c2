#include "meshfree/lattice/double_well_motion.h"

#include "meshfree/lattice/double_well_force.h"
#include "method/method.h"
#include "method/nodal_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    using State = method::EquationOfMotion::State;

    /// The nodes that forces are summed over: those of the torus, or the bounding box of the free
    /// ones and a margin as wide as bonds reach.
    struct Box
    {
      std::array<int, 2> n{};
      std::vector<dealii::Point<2>> places; ///< shape (n[1], n[0])
      std::vector<char> is_free;
    };

    Box torus(const problem::Problem<2> &problem)
    {
      const double offset = problem.settings.nodes_are_vertices ? 0 : .5;
      const geometry::Lattice &lattice = *problem.lattice();
      Box box{lattice.n_cells(), {}, {}};
      for (int j = 0; j < box.n[1]; ++j)
        for (int i = 0; i < box.n[0]; ++i)
          box.places.push_back(lattice.point(i + offset, j + offset));
      box.is_free.assign(box.places.size(), 1);
      return box;
    }

    Box with_margin(const geometry::NodeSet &nodes, const geometry::Lattice &lattice, int margin)
    {
      Box box{{nodes.n[0] + 2 * margin, nodes.n[1] + 2 * margin}, {}, {}};
      for (int j = -margin; j < nodes.n[1] + margin; ++j)
        for (int i = -margin; i < nodes.n[0] + margin; ++i)
        {
          const auto place = nodes.place(0, i, j);
          box.places.push_back(lattice.point(place[0], place[1]));
          box.is_free.push_back(nodes.free(0, i, j) ? 1 : 0);
        }
      return box;
    }

    /// ω at the nodes of a box; empty: 1.
    std::vector<double> boundary_function(const problem::Problem<2> &problem, const Box &box)
    {
      std::vector<double> omega;
      if (!problem.boundary_function)
        return omega;
      for (const auto &x : box.places)
        omega.push_back(problem.boundary_function(x));
      return omega;
    }

    int reach(const std::vector<WellBond> &bonds)
    {
      int reach = 0;
      for (const WellBond &bond : bonds)
        reach = std::max({reach, std::abs(bond.k[0]), std::abs(bond.k[1])});
      return reach;
    }

    /// What drives states is b at the free nodes and behind it u at the constrained ones, of the
    /// same shape.
    template <int dim>
    class DoubleWellMotion : public method::NodalMotion<method::EquationOfMotion, dim>
    {
      using Nodal = method::NodalMotion<method::EquationOfMotion, dim>;
      using Nodal::nodes_;

    public:
      using Nodal::size;
      using Nodal::state;

      DoubleWellMotion(const problem::Problem<2> &problem, const Box &box,
                       const std::vector<WellBond> &bonds, std::optional<double> largest_eigenvalue,
                       const typename DoubleWellForce<dim>::Gradient &gradient)
          : cell_(std::pow(problem.h, dim)), largest_(largest_eigenvalue),
            toughness_(lattice_toughness(bonds, dim, problem.h)), n_all_(box.places.size()),
            force_(bonds, problem.h, box.n,
                   problem.is_periodic() ? Exterior::periodic : Exterior::empty,
                   boundary_function(problem, box), gradient, problem.double_well->shape()),
            all_(dim * n_all_), other_(dim * n_all_)
      {
        for (std::size_t k = 0; k < n_all_; ++k)
          (box.is_free[k] != 0 ? free_ : constrained_).push_back(k);
        for (const std::size_t k : free_)
          nodes_.push_back(box.places[k]);
        for (const std::size_t k : constrained_)
          constrained_nodes_.push_back(box.places[k]);
      }

      std::vector<double> drive(const problem::Problem<2> &instant) const override
      {
        std::vector<double> g = state(instant.load);
        for (unsigned int c = 0; c < dim; ++c)
          for (const auto &node : constrained_nodes_)
            g.push_back(instant.constraint.value(node, c));
        return g;
      }

      std::vector<double> inertia(const problem::Problem<2> &instant) const override
      {
        std::vector<double> g = state(*instant.solution);
        g.resize(size() + dim * constrained_.size());
        return g;
      }

      void acceleration(const State &u, const std::vector<double> &g, State &a) const override
      {
        spread(u, g.data() + size(), all_);
        force_.force(all_, other_);
        gather(other_, a);
        for (std::size_t i = 0; i < a.size(); ++i)
          a[i] += g[i];
      }

      void tangent(const State &u, const std::vector<double> &g, const State &v,
                   State &out) const override
      {
        State direction(dim * n_all_);
        spread(u, g.data() + size(), all_);
        spread(v, nullptr, direction);
        force_.tangent(all_, direction, other_);
        gather(other_, out);
      }

      double product(const State &u, const State &v) const override
      {
        double sum = 0;
        for (std::size_t i = 0; i < u.size(); ++i)
          sum += u[i] * v[i];
        return cell_ * sum;
      }

      double energy(const State &u, const std::vector<double> &g) const override
      {
        spread(u, g.data() + size(), all_);
        return force_.energy(all_);
      }

      double power(const State &u, const State &v, const std::vector<double> &g,
                   const std::vector<double> &rate) const override
      {
        double sum = product({g.begin(), g.begin() + static_cast<std::ptrdiff_t>(size())}, v);
        if (constrained_.empty())
          return sum;
        spread(u, g.data() + size(), all_);
        force_.force(all_, other_);
        for (unsigned int c = 0; c < dim; ++c)
          for (std::size_t k = 0; k < constrained_.size(); ++k)
            sum -= cell_ * other_[c * n_all_ + constrained_[k]] *
                   rate[size() + c * constrained_.size() + k];
        return sum;
      }

      std::optional<double> largest_eigenvalue() const override { return largest_; }

      std::map<std::string, double> facts() const override
      {
        return {{"toughness of the lattice", toughness_},
                {"bonds of one evaluation", static_cast<double>(force_.n_bonds())}};
      }

    private:
      /// @param constrained  at the constrained nodes, shape (2, n_constrained); null: 0
      void spread(const State &u, const double *constrained, State &all) const
      {
        for (unsigned int c = 0; c < dim; ++c)
        {
          for (std::size_t k = 0; k < free_.size(); ++k)
            all[c * n_all_ + free_[k]] = u[c * free_.size() + k];
          for (std::size_t k = 0; k < constrained_.size(); ++k)
            all[c * n_all_ + constrained_[k]] =
                constrained == nullptr ? 0 : constrained[c * constrained_.size() + k];
        }
      }

      void gather(const State &all, State &u) const
      {
        u.resize(size());
        for (unsigned int c = 0; c < dim; ++c)
          for (std::size_t k = 0; k < free_.size(); ++k)
            u[c * free_.size() + k] = all[c * n_all_ + free_[k]];
      }

      double cell_;
      std::optional<double> largest_;
      double toughness_;
      std::size_t n_all_;
      DoubleWellForce<dim> force_;
      std::vector<std::size_t> free_, constrained_; ///< of the box
      std::vector<dealii::Point<2>> constrained_nodes_;
      mutable State all_, other_; ///< over the box, shape (dim, n[1], n[0])
    };
  } // namespace

  std::unique_ptr<method::EquationOfMotion> move_double_well(const problem::Problem<2> &problem,
                                                             const Bonds<2> &bonds,
                                                             double largest_eigenvalue,
                                                             const dealii::Tensor<2, 2> &gradient)
  {
    const auto wells = well_bonds(*problem.double_well, bonds);
    const Box box = problem.is_periodic() ? torus(problem)
                                          : with_margin(method::comparison_nodes(problem, 1),
                                                        *problem.lattice(), reach(wells));
    const DoubleWellForce<2>::Gradient of_torus{
        {{gradient[0][0], gradient[0][1]}, {gradient[1][0], gradient[1][1]}}};
    return std::make_unique<DoubleWellMotion<2>>(problem, box, wells, largest_eigenvalue, of_torus);
  }

  std::unique_ptr<method::EquationOfMotion>
  move_double_well_on_line(const problem::Problem<2> &problem, const std::string &rule)
  {
    return std::make_unique<DoubleWellMotion<1>>(problem, torus(problem),
                                                 axis_bonds(*problem.double_well, problem.h, rule),
                                                 std::nullopt, DoubleWellForce<1>::Gradient{});
  }
} // namespace plumbline::meshfree
