#include "analysis/statics.h"

#include "base/error.h"
#include "base/memory.h"
#include "geometry/node_planes.h"
#include "method/discretisation.h"

#include <algorithm>
#include <new>
#include <sstream>
#include <utility>

namespace plumbline::analysis
{
  using method::Discretisation;
  using method::Vector;

  namespace
  {
    [[noreturn]] void refuse_unsettled(double tolerance, unsigned int refinement, double change)
    {
      std::ostringstream message;
      if (refinement == 0)
        message << "outer quadrature is not refined, so it is not known whether the solution "
                   "changes by";
      else
        message << "outer quadrature, refinement " << refinement
                << ", still changes the solution by " << change << " relative to it,";
      message << " more than Quadrature/tolerance = " << tolerance
              << "; raise Quadrature/max refinements or the tolerance, or refine the mesh";
      throw NumericalError(message.str());
    }

    /// One case on its way through the refinements.
    struct Case
    {
      const problem::Problem<2> *problem = nullptr;
      Outcome outcome = {};
      Vector u = {};
      base::Cost cost = {};
      method::Diagnostics solver = {}; ///< what the last solve says
      bool is_done = false;
    };

    /// Solves all cases of one level.
    class Statics
    {
    public:
      Statics(const method::Method &method, const std::vector<const problem::Problem<2> *> &cases,
              const base::Communicator &communicator)
          : method_(method), communicator_(communicator)
      {
        for (const problem::Problem<2> *problem : cases)
          cases_.push_back({problem});
      }

      std::vector<Outcome> run()
      {
        const auto is_done = [](const Case &one) { return one.is_done; };
        for (; !std::all_of(cases_.begin(), cases_.end(), is_done); ++refinement_)
        {
          const auto unprepared = failure_of([&] { prepare(); });
          for (Case &one : cases_)
            if (!one.is_done)
            {
              one.outcome.failure = unprepared ? unprepared : failure_of([&] { solve(one); });
              one.is_done = one.is_done || one.outcome.failure;
            }
        }
        std::vector<Outcome> outcomes;
        for (Case &one : cases_)
          outcomes.push_back(std::move(one.outcome));
        return outcomes;
      }

    private:
      const problem::MethodSettings &settings() const { return cases_.front().problem->settings; }

      /// What fails for one case, others may still do.
      static std::exception_ptr failure_of(const std::function<void()> &action)
      {
        try
        {
          action();
          return nullptr;
        }
        catch (const NumericalError &)
        {
          return std::current_exception();
        }
        catch (const std::bad_alloc &)
        {
          return std::make_exception_ptr(MemoryError(base::out_of_memory()));
        }
      }

      /// The discretisation at this refinement; its cost is every case's.
      void prepare()
      {
        const base::CpuTimer timer;
        system_.reset();
        if (refinement_ == 0)
          discretisation_ = method_.discretise(*cases_.front().problem, communicator_);
        else
          discretisation_->refine_quadrature();
        system_ = discretisation_->tangent();
        const double seconds = discretisation_->communicator().sum(timer.seconds());
        for (Case &one : cases_)
          if (!one.is_done)
            one.cost.setup_seconds += seconds;
      }

      void solve(Case &one)
      {
        const base::CpuTimer timer;
        const method::CaseData data = discretisation_->data(*one.problem);
        Vector u(data.load.size());
        const algebra::LinearSolve solved = system_->solve(
            u, data.load, {settings().solver.tolerance, settings().solver.max_iterations});
        const base::Communicator communicator = discretisation_->communicator();
        one.cost.solve_seconds += communicator.sum(timer.seconds());
        one.cost.n_unknowns = discretisation_->n_unknowns();
        one.cost.n_bonds = solved.n_bonds;
        one.cost.n_iterations = solved.n_iterations;
        one.solver.relative_residual = solved.relative_residual;
        one.solver.operator_backend = solved.backend;
        const bool is_first = refinement_ == 0;
        if (!is_first)
          one.solver.outer_change = data.relative_change(one.u, u);
        std::swap(one.u, u);
        const bool is_settled =
            !discretisation_->has_quadrature_error() || settings().quadrature.tolerance == 0 ||
            (!is_first && one.solver.outer_change <= settings().quadrature.tolerance);
        if (is_settled)
          finish(one, data);
        else if (refinement_ == settings().quadrature.max_refinements)
          refuse_unsettled(settings().quadrature.tolerance, refinement_, one.solver.outer_change);
      }

      void finish(Case &one, const method::CaseData &data)
      {
        const base::Communicator communicator = discretisation_->communicator();
        one.cost.peak_bytes = static_cast<std::size_t>(
            communicator.largest(static_cast<double>(memory_.peak_bytes())));
        Solution solution{data.field(one.u), one.cost, discretisation_->diagnostics()};
        method::Diagnostics &said = solution.diagnostics;
        if (data.tip_forces)
          said.tip_forces = data.tip_forces(one.u);
        said.relative_residual = one.solver.relative_residual;
        said.operator_backend = one.solver.operator_backend;
        if (refinement_ > 0)
          said.outer_change = one.solver.outer_change;
        said.n_refinements = refinement_;
        if (said.n_neighbours == 0)
          said.n_neighbours = static_cast<unsigned int>(
              one.cost.n_bonds / std::max<std::size_t>(1, one.cost.n_unknowns));
        one.outcome.solution = std::move(solution);
        one.is_done = true;
      }

      const method::Method &method_;
      base::Communicator communicator_;
      const base::MemoryGauge memory_;
      std::vector<Case> cases_;
      std::unique_ptr<Discretisation> discretisation_;
      std::unique_ptr<algebra::LinearSystem> system_;
      unsigned int refinement_ = 0;
    };
  } // namespace

  std::vector<Outcome> solve(const method::Method &method,
                             const std::vector<const problem::Problem<2> *> &cases,
                             const base::Communicator &communicator)
  {
    return Statics(method, cases, communicator).run();
  }

  void settle_quadrature(Discretisation &discretisation, const problem::Problem<2> &problem)
  {
    if (!discretisation.has_quadrature_error() || problem.settings.quadrature.tolerance == 0)
      return;
    Vector before;
    for (unsigned int refinement = 0;; ++refinement)
    {
      const method::CaseData data = discretisation.data(problem);
      Vector u(data.load.size());
      discretisation.tangent()->solve(
          u, data.load,
          {problem.settings.solver.tolerance, problem.settings.solver.max_iterations});
      const double change = refinement == 0 ? 0 : data.relative_change(before, u);
      if (refinement > 0 && change <= problem.settings.quadrature.tolerance)
        return;
      if (refinement == problem.settings.quadrature.max_refinements)
        refuse_unsettled(problem.settings.quadrature.tolerance, refinement, change);
      before = u;
      discretisation.refine_quadrature();
    }
  }

  Solution solve(const method::Method &method, const problem::Problem<2> &problem,
                 const base::Communicator &communicator)
  {
    std::vector<Outcome> outcomes = solve(method, {&problem}, communicator);
    if (!outcomes.front().solution)
      std::rethrow_exception(outcomes.front().failure);
    return std::move(*outcomes.front().solution);
  }

  namespace
  {
    /// Of something that each rank has all of, one rank's part [first, second) of items of n
    /// values.
    void keep(std::vector<double> &values, const std::pair<std::size_t, std::size_t> &part,
              std::size_t n)
    {
      values = {values.begin() + part.first * n, values.begin() + part.second * n};
    }

    /// Leave to this rank its share of a solution that it has all of.
    void keep_share(SolutionInSpace &solution, const problem::Problem<3> &problem,
                    const base::Communicator &ranks)
    {
      const std::size_t n_components = problem.n_components;
      const auto cells = geometry::cell_centres(problem.lattice);
      const auto n_below = [&cells](int plane) {
        return geometry::planes_of(cells, {0, plane}).n_free();
      };
      const auto [first, second] = method::slabs_of_cells(problem.lattice, ranks).owned();
      keep(solution.averages, {n_below(first), n_below(second)}, n_components);
      const auto nodes = ranks.owned_range(solution.nodes.size());
      solution.nodes = {solution.nodes.begin() + nodes.first,
                        solution.nodes.begin() + nodes.second};
      keep(solution.nodal, nodes, n_components);
      if (!solution.volumes.empty())
        keep(solution.volumes, nodes, 1);
    }
  } // namespace

  SolutionInSpace solve(const method::Method &method, const problem::Problem<3> &problem,
                        const base::Communicator &ranks)
  {
    const base::MemoryGauge memory;
    base::CpuTimer timer;
    const auto discretisation = method.discretise_in_space(problem);
    const bool is_distributed = ranks.n_ranks() > 1 && discretisation->distribute(ranks);
    const auto of_all = [&](double seconds)
    { return is_distributed ? ranks.sum(seconds) : seconds; };
    const auto system = discretisation->tangent();
    SolutionInSpace solution;
    solution.cost.setup_seconds = of_all(timer.seconds());
    timer.restart();
    const auto data = discretisation->data(problem);
    Vector u(data.load.size());
    const auto &settings = problem.settings.solver;
    const algebra::LinearSolve solved =
        system->solve(u, data.load, {settings.tolerance, settings.max_iterations});
    solution.cost.solve_seconds = of_all(timer.seconds());
    solution.cost.n_unknowns = discretisation->n_unknowns();
    solution.cost.n_bonds = solved.n_bonds;
    solution.cost.n_iterations = solved.n_iterations;
    solution.cost.peak_bytes =
        static_cast<std::size_t>(ranks.largest(static_cast<double>(memory.peak_bytes())));
    static_cast<method::FieldInSpace &>(solution) = data.field(u);
    if (ranks.n_ranks() > 1 && !is_distributed)
      keep_share(solution, problem, ranks);
    solution.diagnostics = discretisation->diagnostics();
    solution.diagnostics.relative_residual = solved.relative_residual;
    solution.diagnostics.operator_backend = solved.backend;
    return solution;
  }
} // namespace plumbline::analysis
