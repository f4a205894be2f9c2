#include "meshfree/method.h"

#include "meshfree/solutions.h"

#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    class RuleMethod : public study::Method
    {
    public:
      explicit RuleMethod(Rule rule, bool is_trap = false)
          : rule_(std::move(rule)), is_trap_(is_trap)
      {
      }
      std::string name() const override { return rule_.name; }
      std::string family() const override { return "meshfree"; }
      std::string help() const override { return rule_.help; }
      bool is_in_all() const override { return !is_trap_; }
      std::string why_not(const scene::Scene &scene, const scene::Problem &problem) const override
      {
        if (scene.iteration != "cg" || problem.lattice || problem.body)
          return {};
        std::string why = "on scattered nodes a bond has two weights, one for each end";
        if (problem.dilatation && !problem.dilatation->is_symmetric())
          why = "harmonic means of constants that vary in space (LPS) make none";
        else if (scene.is_damaged())
          why = "what cracks and free surfaces add to rows makes none";
        return "Solver/iteration = cg needs a symmetric operator, but " + why +
               "; write automatic, gmres or bicgstab";
      }

      study::Solution solve(const scene::Scene &scene, const scene::Problem &problem) const override
      {
        if (problem.body)
          return body_solution(rule_, scene, problem);
        return problem.lattice ? lattice_solution(rule_, scene, problem)
                               : scattered_solution(rule_, scene, problem);
      }

      double expected_bytes(const scene::Scene &scene,
                            const study::ProblemSize &size) const override
      {
        return meshfree::expected_bytes(scene, size);
      }

      std::optional<study::DiscreteOperator>
      discrete_operator(const scene::Scene &scene, const scene::Problem &problem) const override
      {
        if (problem.body)
          return body_discrete(rule_, scene, problem);
        return problem.lattice ? lattice_discrete(rule_, scene, problem)
                               : scattered_discrete(rule_, scene, problem);
      }

      std::optional<study::SymbolData> symbol(const scene::Scene &scene,
                                              const scene::Problem &problem) const override
      {
        return lattice_symbol(rule_, scene, problem);
      }

    private:
      Rule rule_;
      bool is_trap_;
    };
  } // namespace

  study::Methods methods()
  {
    study::Methods methods;
    for (const Rule &rule : rules())
      methods.push_back(std::make_shared<RuleMethod>(rule));
    for (const Rule &rule : traps())
      methods.push_back(std::make_shared<RuleMethod>(rule, true));
    return methods;
  }
} // namespace plumbline::meshfree
