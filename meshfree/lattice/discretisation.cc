#include "meshfree/discretisations.h"
#include "meshfree/lattice/double_well_motion.h"
#include "meshfree/lattice/nodal_field.h"
#include "meshfree/lattice/stencil.h"
#include "method/lattice_discretisation.h"
#include "method/line_discretisation.h"

#include <deal.II/lac/vector.h>

#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    using algebra::Vector;
    using geometry::NodeSet;

    /// b at the nodes.
    Vector nodal_load(const problem::Problem<2> &problem, const NodeSet &nodes)
    {
      Vector load(nodes.size());
      const geometry::Lattice &lattice = *problem.lattice();
      std::size_t block = 0;
      for (unsigned int c = 0; c < nodes.n_components; ++c, block += nodes.n_positions())
      {
        std::vector<double> smooth;
        if (problem.load.fast && problem.load.series)
        {
          const auto at_nodes = [&](unsigned int axis)
          {
            std::vector<double> rows;
            for (int i = 0; i < nodes.n[axis]; ++i)
            {
              const auto basis = problem.load.series->basis(
                  axis, lattice.origin()[axis] + lattice.h() * (i + nodes.axis[0].offset));
              rows.insert(rows.end(), basis.begin(), basis.end());
            }
            return rows;
          };
          smooth = problem.load.series->contract(c, at_nodes(0), at_nodes(1));
        }
        std::size_t position = 0;
        for (int j = 0; j < nodes.n[1]; ++j)
          for (int i = 0; i < nodes.n[0]; ++i, ++position)
            if (nodes.is_free[position] != 0)
            {
              const auto place = nodes.place(0, i, j);
              load[block + position] = smooth.empty()
                                           ? problem.load(lattice.point(place[0], place[1]), c)
                                           : smooth[position];
            }
      }
      return load;
    }

    algebra::Stencil make_stencil(const problem::Problem<2> &problem, const Bonds<2> &bonds)
    {
      return problem.dilatation ? state_based_stencil(*problem.dilatation, bonds)
                                : lattice_operator(problem.kernel, bonds);
    }
    class RuleOnLattice : public method::LatticeDiscretisation
    {
    public:
      RuleOnLattice(const problem::Problem<2> &problem, const Bonds<2> &bonds)
          : LatticeDiscretisation(problem, method::comparison_nodes(problem, problem.n_components),
                                  make_stencil(problem, bonds), {1}),
            move_well_(
                problem.double_well
                    ? MoveWell(
                          [&problem, bonds](double largest, const dealii::Tensor<2, 2> &gradient)
                          { return move_double_well(problem, bonds, largest, gradient); })
                    : MoveWell()),
            is_torus_(problem.is_periodic()), diagnostics_(describe(problem, bonds, stencil()))
      {
      }

      method::Diagnostics diagnostics() const override { return diagnostics_; }

      std::unique_ptr<method::EquationOfMotion> motion(bool is_lumped) const override
      {
        return move_well_ ? move_well_(algebra::Symbol(*waves()).range().largest, {})
                          : LatticeDiscretisation::motion(is_lumped);
      }

      std::unique_ptr<method::EquationOfMotion>
      motion_about(const dealii::Tensor<2, 2> &gradient) const override
      {
        return move_well_ && is_torus_
                   ? move_well_(algebra::Symbol(*waves()).range().largest, gradient)
                   : nullptr;
      }

    private:
      Vector load(const problem::Problem<2> &problem) const override
      {
        return nodal_load(problem, nodes());
      }

      method::Field field(std::vector<double> values) const override
      {
        const auto field =
            std::make_shared<const NodalField>(NodalField{lattice(), nodes(), std::move(values)});
        method::Field result;
        result.nodes = method::free_points(lattice(), nodes());
        for (int j = 0; j < nodes().n[1]; ++j)
          for (int i = 0; i < nodes().n[0]; ++i)
            if (nodes().free(0, i, j))
              for (unsigned int c = 0; c < nodes().n_components; ++c)
                result.nodal.push_back(field->at(c, i, j));
        result.averages = result.nodal;
        result.value = [field](const Point<2> &x, unsigned int c) { return field->value(x, c); };
        result.write_vtu = [field](const std::string &file) { field->write_vtu(file); };
        return result;
      }

      using MoveWell = std::function<std::unique_ptr<method::EquationOfMotion>(
          double largest_eigenvalue, const dealii::Tensor<2, 2> &gradient)>;
      MoveWell move_well_; ///< of double wells, whose stencil is that of small strains
      bool is_torus_;
      method::Diagnostics diagnostics_;
    };
  } // namespace

  std::unique_ptr<method::Discretisation> discretise_on_line(const Rule &rule,
                                                             const problem::Problem<2> &problem)
  {
    return std::make_unique<method::LineDiscretisation>(
        problem.lattice()->n_cells()[0], false,
        [&problem, name = rule.name](bool, unsigned int)
        { return move_double_well_on_line(problem, name); });
  }

  std::unique_ptr<method::Discretisation> discretise_on_lattice(const Rule &rule,
                                                                const problem::Problem<2> &problem)
  {
    return std::make_unique<RuleOnLattice>(
        problem, lattice_bonds(rule.in_plane(problem.kernel), problem.kernel,
                               problem.lattice()->h(), problem.settings.geometry.backend));
  }
} // namespace plumbline::meshfree
