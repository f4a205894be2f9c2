#include "algebra/multigrid.h"
#include "meshfree/fracture/equilibrium.h"
#include "meshfree/fracture/network_terms.h"

namespace plumbline::meshfree
{
  namespace
  {
    using Vector = algebra::Multigrid::Vector;

    template <int dim>
    class MultigridEquations : public NetworkEquations<dim>
    {
    public:
      using Solution = typename NetworkEquations<dim>::Solution;

      MultigridEquations(const BondNetwork<dim> &network, const Connections<dim> &connections)
          : network_(&network), connections_(&connections), terms_(network),
            ranges_(terms_.n_unknowns(), dim, base::Communicator::alone())
      {
        const typename NetworkTerms<dim>::Terms all = terms_.all(connections);
        const algebra::CsrMatrix matrix =
            algebra::normal_matrix(all.rows, all.factors, terms_.n_unknowns());
        n_entries_ = matrix.value.size();
        cycle_.emplace(matrix, ranges_, dim, terms_.free_nodes());
      }

      void take_out(const std::vector<std::size_t> &bonds,
                    const Connections<dim> & /*the same*/) override
      {
        n_taken_ += bonds.size();
      }

      std::optional<Solution> solve(const NodeField<dim> &start) const override
      {
        Solution solution{start, 0};
        const auto n = equilibrate<dim>(
            [this](const NodeField<dim> &u) {
              return forces(*network_, *connections_, u, dilatations(*network_, *connections_, u));
            },
            Iteration::conjugate_gradients, *network_, *this, solution.u);
        if (!n)
          return {};
        solution.n_iterations = *n;
        return solution;
      }

      std::optional<NodeField<dim>> displacements(const NodeField<dim> &forces) const override
      {
        const std::vector<double> given = terms_.free(forces);
        Vector b(ranges_.own(), MPI_COMM_SELF), x(b);
        std::copy(given.begin(), given.end(), b.begin());
        cycle_->vmult(x, b);
        return terms_.expand({x.begin(), x.end()});
      }

      void add_holds(const NodeField<dim> &u, NodeField<dim> &forces) const override
      {
        for (const typename Connections<dim>::Hold &hold : connections_->holds())
          terms_.add_hold(hold, u, forces);
      }

      std::size_t rank() const override { return n_taken_; }
      std::size_t n_unknowns() const override { return terms_.n_unknowns(); }

      double making_seconds() const override
      {
        constexpr double seconds_per_entry = 340e-9;
        return seconds_per_entry * static_cast<double>(n_entries_);
      }

      double update_seconds(std::size_t /*n_bonds*/, unsigned int n_iterations) const override
      {
        constexpr double seconds_per_entry = 6.6e-9; // of an iteration
        return seconds_per_entry * static_cast<double>(n_entries_) * n_iterations;
      }

    private:
      const BondNetwork<dim> *network_;
      const Connections<dim> *connections_;
      NetworkTerms<dim> terms_;
      algebra::OwnedRanges ranges_;
      std::optional<algebra::Multigrid> cycle_;
      std::size_t n_entries_ = 0, n_taken_ = 0;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<NetworkEquations<dim>> multigrid_equations(const BondNetwork<dim> &network,
                                                             const Connections<dim> &connections)
  {
    return std::make_unique<MultigridEquations<dim>>(network, connections);
  }

  template std::unique_ptr<NetworkEquations<2>> multigrid_equations(const BondNetwork<2> &,
                                                                    const Connections<2> &);
  template std::unique_ptr<NetworkEquations<3>> multigrid_equations(const BondNetwork<3> &,
                                                                    const Connections<3> &);
} // namespace plumbline::meshfree
