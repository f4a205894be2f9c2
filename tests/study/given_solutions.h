#pragma once

#include "method/discretisation.h"
#include "study/statics.h"

/// Methods that solve nothing, for what is done with solutions.
namespace plumbline::study
{
  /// Yields the fields it is told, in a discretisation of one unknown.
  class GivenSolutions : public Method
  {
  public:
    explicit GivenSolutions(std::string name, MethodFamily family = MethodFamily::meshfree)
        : name_(std::move(name)), family_(family)
    {
    }
    std::string name() const override { return name_; }
    MethodFamily family() const override { return family_; }
    std::string help() const override { return ""; }
    std::unique_ptr<method::Discretisation> discretise(const problem::Problem<2> &,
                                                       const base::Communicator &) const override
    {
      return std::make_unique<Given>(*this);
    }

    mutable unsigned int n_solves = 0;

  private:
    virtual method::Field field(const problem::Problem<2> &) const = 0;
    virtual double outer_change() const { return 0; }

    class Given : public method::Discretisation
    {
    public:
      explicit Given(const GivenSolutions &method) : method_(method) {}
      std::size_t n_unknowns() const override { return 1; }
      method::CaseData data(const problem::Problem<2> &problem) const override
      {
        ++method_.n_solves;
        return {method::Vector(1),
                [this, &problem](const method::Vector &) { return method_.field(problem); },
                {}};
      }
      std::unique_ptr<algebra::LinearSystem> tangent() const override
      {
        return std::make_unique<Identity>();
      }
      method::DiscreteOperator matrix() const override { return {}; }
      method::Diagnostics diagnostics() const override
      {
        method::Diagnostics result;
        result.outer_change = method_.outer_change();
        return result;
      }

    private:
      const GivenSolutions &method_;
    };

    class Identity : public algebra::LinearSystem
    {
    public:
      void vmult(method::Vector &y, const method::Vector &x) const override { y = x; }
      algebra::LinearSolve solve(method::Vector &x, const method::Vector &b,
                                 const algebra::Stopping &) const override
      {
        x = b;
        return {};
      }
    };

    std::string name_;
    MethodFamily family_;
  };

  struct SweepControl : RunControl, StaticsOptions
  {
  };

  /// Static solutions of a scene, by all ranks together.
  inline StudyResults run_sweep(const scene::Scene &scene, const Methods &methods,
                                const Methods &available, const SweepControl &options = {},
                                const StudyResults &earlier = {})
  {
    RunControl control = options;
    control.earlier = earlier;
    control.ranks = base::Communicator::all();
    return run_study(statics_analysis(available, options), scene, methods, control);
  }

  /// Solutions as if each had cost so many CPU seconds; 1 is enough not to be repeated for its
  /// time.
  inline SweepControl at_cost(const std::function<double(const problem::Problem<2> &)> &seconds =
                                  [](const problem::Problem<2> &) { return 1; })
  {
    SweepControl control;
    control.solve =
        [seconds](const Method &method, const std::vector<const problem::Problem<2> *> &cases)
    {
      auto outcomes = analysis::solve(method, cases);
      for (std::size_t i = 0; i < cases.size(); ++i)
        if (outcomes[i].solution)
        {
          outcomes[i].solution->cost.setup_seconds = 0;
          outcomes[i].solution->cost.solve_seconds = seconds(*cases[i]);
        }
      return outcomes;
    };
    return control;
  }
} // namespace plumbline::study
