#include "meshfree/method.h"

#include "base/error.h"
#include "meshfree/body/corrected_rule.h"
#include "meshfree/discretisations.h"
#include "meshfree/fracture/breaking_network.h"
#include "meshfree/fracture/network_motion.h"
#include "meshfree/fracture/standing_crack.h"
#include "meshfree/fracture/strip.h"
#include "meshfree/lattice/crack_strip.h"
#include "meshfree/rules/double_well_bonds.h"

#include <array>
#include <limits>
#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    class RuleMethod : public method::Method,
                       public method::StripSolver,
                       public method::FractureSolver,
                       public method::DynamicFractureSolver,
                       public method::MethodOnIntervals
    {
    public:
      explicit RuleMethod(Rule rule, bool is_in_all = true)
          : rule_(std::move(rule)), is_in_all_(is_in_all)
      {
      }
      std::string name() const override { return rule_.name; }
      method::MethodFamily family() const override { return method::MethodFamily::meshfree; }
      std::string help() const override { return rule_.help; }
      bool is_in_all() const override { return is_in_all_; }
      std::string why_not(const problem::Problem<2> &problem) const override
      {
        if (rule_.is_scalar && problem.n_components > 1)
          return no_tensors();
        if (problem.settings.solver.iteration != base::Iteration::cg || problem.lattice() ||
            problem.body())
          return {};
        std::string why = "on scattered nodes a bond has two weights, one for each end";
        if (problem.dilatation && !problem.dilatation->is_symmetric())
          why = "harmonic means of constants that vary in space (LPS) make none";
        else if (problem.damage.is_there())
          why = "what cracks and free surfaces add to rows makes none";
        return "Solver/iteration = cg needs a symmetric operator, but " + why +
               "; write automatic, gmres or bicgstab";
      }

      std::string why_not_in_space(const Kernel<3> &kernel, bool, bool) const override
      {
        return rule_.is_scalar && kernel.n_components() > 1 ? no_tensors() : "";
      }

      std::string why_not_on_intervals(const Kernel<1> &) const override
      {
        if (rule_.on_line)
          return {};
        return rule_.not_on_line.empty() ? "not implemented in one dimension" : rule_.not_on_line;
      }

      std::unique_ptr<method::IntervalDiscretisation>
      discretise_on_intervals(const problem::Problem<1> &problem) const override
      {
        return meshfree::discretise_on_intervals(rule_, problem);
      }

      method::Capabilities can() const override
      {
        method::Capabilities can =
            problem::all_but({method::Capability::line, method::Capability::space});
        if (rule_.is_scalar)
          for (const auto capability : of_solids)
            can.erase(capability);
        if (is_axis_rule(rule_.name))
          can.insert(method::Capability::line);
        if (rule_.in_space)
          can.insert(method::Capability::space);
        return can;
      }

      /// Rules that adjust weights ask truncated families for the moments of whole balls.
      method::Capabilities can_in_space() const override
      {
        method::Capabilities can = this->can();
        constexpr double any = 1;
        const auto kernel = Kernel<3>::with_diffusion(physics::RadialProfile({{any, 0}}), any, any);
        if (rule_.in_space && rule_.in_space(kernel).adjust)
          can.erase(method::Capability::free_boundary);
        return can;
      }

      std::unique_ptr<method::Discretisation>
      discretise(const problem::Problem<2> &problem,
                 const base::Communicator &communicator) const override
      {
        if (problem.dimension() == 1)
          return discretise_on_line(rule_, problem);
        if (problem.body())
          return discretise_on_body(rule_, problem);
        return problem.lattice() ? discretise_on_lattice(rule_, problem)
                                 : discretise_on_scattered_nodes(rule_, problem, communicator);
      }

      std::unique_ptr<method::DiscretisationInSpace>
      discretise_in_space(const problem::Problem<3> &problem) const override
      {
        return problem.cells ? discretise_on_nodes(rule_, problem)
                             : discretise_on_box(rule_, problem);
      }

      const method::DynamicFractureSolver *dynamic_fracture_solver() const override { return this; }
      method::StripThreshold strip_threshold(const physics::DoubleWell &law, double h, int n_rows,
                                             geometry::Backend backend) const override
      {
        const CrackColumn column(bonds_of(law, h, backend), h, n_rows, law.shape());
        method::StripThreshold found{
            column.toughness(), std::numeric_limits<double>::quiet_NaN(), {}};
        try
        {
          found.energy = column.threshold();
        }
        catch (const NumericalError &error)
        {
          found.failure = error.what();
        }
        return found;
      }
      std::unique_ptr<method::NotchedStrip> notched_strip(const physics::DoubleWell &law,
                                                          const method::NotchedStripShape &shape,
                                                          geometry::Backend backend) const override
      {
        return std::make_unique<CrackStrip>(bonds_of(law, shape.h, backend), shape, law.shape());
      }

      const method::FractureSolver *fracture_solver() const override { return this; }
      method::BreakableBody<2> breakable_body(const method::BreakingSolid<2> &solid,
                                              const Kernel<2> &influence, double h,
                                              geometry::Backend backend, problem::Stretch stretch,
                                              problem::GrowthSolver solver) const override
      {
        return make_body(solid, rule_.in_plane, influence, h, backend, stretch, solver);
      }
      method::BreakableBody<3> breakable_body(const method::BreakingSolid<3> &solid,
                                              const Kernel<3> &influence, double h,
                                              geometry::Backend backend, problem::Stretch stretch,
                                              problem::GrowthSolver solver) const override
      {
        return make_body(solid, in_space(), influence, h, backend, stretch, solver);
      }
      method::MovingBody moving_body(const method::BreakingSolid<2> &solid,
                                     const Kernel<2> &influence, double h,
                                     geometry::Backend backend) const override
      {
        return meshfree::moving_body(
            make_bond_network(solid, rule_.in_plane(physics::deviatoric_kernel(influence, 1)),
                              influence, h, backend),
            notch_tip(solid));
      }
      double lattice_toughness(const Kernel<2> &influence, double h,
                               geometry::Backend backend) const override
      {
        return meshfree::lattice_toughness(rule_.in_plane(physics::deviatoric_kernel(influence, 1)),
                                           influence, h, backend);
      }
      double lattice_toughness(const Kernel<3> &influence, double h,
                               geometry::Backend backend) const override
      {
        return meshfree::lattice_toughness(in_space()(physics::deviatoric_kernel(influence, 1)),
                                           influence, h, backend);
      }

      const method::StripSolver *strip_solver() const override { return this; }
      method::StripState solve_strip(const method::RiceStrip &strip,
                                     const Kernel<2> &influence) const override
      {
        return meshfree::solve_strip(
            strip, rule_.in_plane(physics::deviatoric_kernel(influence, 1)), influence);
      }

      std::optional<method::BreakableBody<2>>
      breakable_strip(const method::RiceStrip &strip, const physics::Lame &lame,
                      problem::SurfaceTerms terms, const Kernel<2> &influence,
                      geometry::Backend backend) const override
      {
        BreakingSolid<2> solid = make_strip(strip, lame, influence.horizon());
        solid.surface_terms = terms;
        return make_body(solid, rule_.in_plane, influence, strip.h, backend,
                         problem::Stretch::linear, problem::GrowthSolver::factor);
      }

      double expected_bytes(const method::ProblemSize &size) const override
      {
        return meshfree::expected_bytes(size);
      }
      bool is_distributed_in_space(const method::ProblemSize &size) const override
      {
        return size.depth > 0 && !size.is_scattered;
      }

    private:
      static constexpr std::array of_solids = {
          method::Capability::damaged_dilatation, method::Capability::notch,
          method::Capability::dilatation,         method::Capability::zero_dilatation,
          method::Capability::mixed_dilatation,   method::Capability::double_well,
          method::Capability::double_well_collar};

      static std::string no_tensors()
      {
        return "it has weights for scalar kernels only: fitted derivatives of a vector field do "
               "not give "
               "forces along the bonds; use GFD or IPA-AC-R2";
      }

      template <int dim>
      using MakeQuadrature = std::function<NeighbourhoodQuadrature<dim>(const Kernel<dim> &)>;

      /// @throws InputError  the rule has no weights in space
      const MakeQuadrature<3> &in_space() const
      {
        if (!rule_.in_space)
          throw InputError("Methods/names = " + rule_.name +
                           " has no weights in three dimensions; write FA or OPT");
        return rule_.in_space;
      }

      template <int dim>
      static method::BreakableBody<dim>
      make_body(const method::BreakingSolid<dim> &solid, const MakeQuadrature<dim> &quadrature,
                const Kernel<dim> &influence, double h, geometry::Backend backend,
                problem::Stretch stretch, problem::GrowthSolver solver)
      {
        return meshfree::breakable_body(
            std::make_shared<BreakingNetwork<dim>>(
                make_bond_network(solid, quadrature(physics::deviatoric_kernel(influence, 1)),
                                  influence, h, backend),
                stretch, solver),
            notch_tip(solid));
      }

      template <int dim>
      static dealii::Point<2> notch_tip(const method::BreakingSolid<dim> &solid)
      {
        return solid.notch.empty() ? dealii::Point<2>() : solid.notch.front().back();
      }

      std::vector<WellBond> bonds_of(const physics::DoubleWell &law, double h,
                                     geometry::Backend backend) const
      {
        const auto kernel = law.linear_kernel();
        return well_bonds(law, lattice_bonds(rule_.in_plane(kernel), kernel, h, backend));
      }

      Rule rule_;
      bool is_in_all_;
    };
  } // namespace

  std::shared_ptr<const method::Method> make_method(const Rule &rule)
  {
    return std::make_shared<RuleMethod>(rule);
  }

  method::Methods methods()
  {
    method::Methods methods;
    for (const Rule &rule : rules())
      methods.push_back(make_method(rule));
    for (const Rule &rule : rules_on_request())
      methods.push_back(std::make_shared<RuleMethod>(rule, false));
    const method::Methods corrected = corrected_rules();
    methods.insert(methods.end(), corrected.begin(), corrected.end());
    return methods;
  }
} // namespace plumbline::meshfree
