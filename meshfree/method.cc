#include "meshfree/method.h"

#include "meshfree/discretisations.h"
#include "meshfree/fracture/standing_crack.h"
#include "meshfree/rules/double_well_bonds.h"

#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    class RuleMethod : public method::Method
    {
    public:
      explicit RuleMethod(Rule rule, bool is_counterexample = false)
          : rule_(std::move(rule)), is_counterexample_(is_counterexample)
      {
      }
      std::string name() const override { return rule_.name; }
      method::MethodFamily family() const override { return method::MethodFamily::meshfree; }
      std::string help() const override { return rule_.help; }
      bool is_in_all() const override { return !is_counterexample_; }
      std::string why_not(const problem::Problem<2> &problem) const override
      {
        if (problem.settings.solver.iteration != base::Iteration::cg || problem.lattice ||
            problem.body)
          return {};
        std::string why = "on scattered nodes a bond has two weights, one for each end";
        if (problem.dilatation && !problem.dilatation->is_symmetric())
          why = "harmonic means of constants that vary in space (LPS) make none";
        else if (problem.damage.is_there())
          why = "what cracks and free surfaces add to rows makes none";
        return "Solver/iteration = cg needs a symmetric operator, but " + why +
               "; write automatic, gmres or bicgstab";
      }

      method::Capabilities can() const override
      {
        return is_axis_rule(rule_.name) ? problem::all_capabilities()
                                        : problem::all_but({method::Capability::line});
      }

      std::unique_ptr<method::Discretisation>
      discretise(const problem::Problem<2> &problem,
                 const base::Communicator &communicator) const override
      {
        if (problem.dimension == 1)
          return discretise_on_line(rule_, problem);
        if (problem.body)
          return discretise_on_body(rule_, problem);
        return problem.lattice ? discretise_on_lattice(rule_, problem)
                               : discretise_on_scattered_nodes(rule_, problem, communicator);
      }

      method::StripState solve_strip(const method::RiceStrip &strip,
                                     const Kernel<2> &influence) const override
      {
        return meshfree::solve_strip(strip, rule_.of(physics::deviatoric_kernel(influence, 1)),
                                     influence);
      }

      double expected_bytes(const method::ProblemSize &size) const override
      {
        return meshfree::expected_bytes(size);
      }

    private:
      Rule rule_;
      bool is_counterexample_;
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
    for (const Rule &rule : counterexamples())
      methods.push_back(std::make_shared<RuleMethod>(rule, true));
    return methods;
  }
} // namespace plumbline::meshfree
