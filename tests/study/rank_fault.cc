// Ends as it should if no rank hangs: the last one fails while the others wait for it elsewhere.
#include "base/team.h"

#include <deal.II/base/mpi.h>

#include <new>

int main(int argc, char **argv)
{
  using plumbline::base::Team;
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const plumbline::base::SeparateTeam ranks(Team::all());
  constexpr double patience = .5;
  ranks.team().together(
      []
      {
        if (Team::all().rank() == 1)
          throw std::bad_alloc();
        Team::all().wait();
      },
      patience);
}
