// Ends as it should if no rank hangs: the last one fails while the others wait for it elsewhere.
#include "base/communicator.h"

#include <deal.II/base/mpi.h>

#include <new>

int main(int argc, char **argv)
{
  using plumbline::base::Communicator;
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const plumbline::base::SeparateCommunicator ranks(Communicator::all());
  constexpr double patience = .5;
  ranks.communicator().together(
      []
      {
        if (Communicator::all().rank() == 1)
          throw std::bad_alloc();
        Communicator::all().wait();
      },
      patience);
}
