#include "algebra/slab_sine.h"

#include "algebra/sine_symbol.h"
#include "base/error.h"

#include <fftw3-mpi.h>

#include <algorithm>
#include <limits>

namespace plumbline::algebra
{
  using base::AlignedArray;
  using base::Plan;

  namespace
  {
    /// Once in a program, after its threads.
    void init_distributed_transforms()
    {
      base::set_plan_threads(0);
      static const bool ready = (fftw_mpi_init(), true);
      (void)ready;
    }

    /// Modes are moved to slabs of the second axis. A box of one row there is turned about the
    /// third axis, which leaves the order of its nodes.
    std::array<int, 3> turned(const std::array<int, 3> &n)
    {
      return n[1] > 1 ? n : std::array<int, 3>{n[1], n[0], n[2]};
    }

    /// Of modes of a box turned so, shape (n[2], n_rows, n[0]).
    std::vector<double> symbol_of_turned(const Stencil &stencil, unsigned int component,
                                         const std::array<int, 3> &n, const base::Slabs &rows)
    {
      if (n[1] > 1)
        return sine_symbol(stencil, component, n, rows.owned());
      const std::vector<double> all = sine_symbol(stencil, component, n, {0, 1});
      std::vector<double> values;
      for (auto row = all.begin(); row != all.end(); row += n[0])
        values.insert(values.end(), row + rows.owned().first, row + rows.owned().second);
      return values;
    }
  } // namespace

  SlabSine::SlabSine(const Stencil &stencil, const std::array<int, 3> &box,
                     const base::Slabs &slabs)
      : n_own_(static_cast<std::size_t>(box[0]) * box[1] * slabs.n_owned())
  {
    const std::array<int, 3> n = turned(box);
    init_distributed_transforms();
    const MPI_Comm mpi = slabs.ranks().mpi;
    const std::array<std::ptrdiff_t, 3> extents = {n[2], n[1], n[0]};
    const base::Slabs rows(slabs.ranks(), n[1]);
    std::ptrdiff_t n_planes = 0, first_plane = 0, n_rows = 0, first_row = 0;
    const std::ptrdiff_t n_local =
        fftw_mpi_local_size_many_transposed(3, extents.data(), 1, slabs.block(), rows.block(), mpi,
                                            &n_planes, &first_plane, &n_rows, &first_row);
    if (n_planes != slabs.n_owned() || n_rows != rows.n_owned())
      throw NumericalError("FFTW distributes planes differently from the slabs requested");
    field_ = AlignedArray<double>(std::max<std::size_t>(n_local, 1));
    const std::array<fftw_r2r_kind, 3> kinds = {FFTW_RODFT00, FFTW_RODFT00, FFTW_RODFT00};
    const auto plan = [&](unsigned int flag, int block_in, int block_out)
    {
      return Plan(fftw_mpi_plan_many_r2r(3, extents.data(), 1, block_in, block_out, field_.data(),
                                         field_.data(), mpi, kinds.data(), FFTW_ESTIMATE | flag));
    };
    forward_ = plan(FFTW_MPI_TRANSPOSED_OUT, slabs.block(), rows.block());
    backward_ = plan(FFTW_MPI_TRANSPOSED_IN, rows.block(), slabs.block());
    double scale = 1;
    for (const int length : n)
      scale /= 2. * (length + 1);
    modes_ = {n[0], rows.n_owned(), n[2]};
    n_modes_ = static_cast<std::size_t>(modes_[0]) * modes_[1] * modes_[2];
    for (unsigned int c = 0; c < stencil.n_blocks(); ++c)
    {
      std::vector<double> values = symbol_of_turned(stencil, c, box, rows);
      double least = std::numeric_limits<double>::infinity(), largest = -least;
      for (const double value : values)
      {
        least =
            std::min(least, std::isnan(value) ? -std::numeric_limits<double>::infinity() : value);
        largest = std::max(largest, value);
      }
      check_positive(-slabs.ranks().largest(-least), slabs.ranks().largest(largest));
      for (double &value : values)
        value = scale / value;
      inverse_eigenvalues_.push_back(std::move(values));
    }
  }

  void SlabSine::apply(const double *input, double *output) const
  {
    for (const std::vector<double> &inverse : inverse_eigenvalues_)
    {
      std::copy_n(input, n_own_, field_.data());
      fftw_execute(forward_.get());
      const double *value =
          inverse.data(); // shape (n[2], rows, n[0]); the modes: (rows, n[2], n[0])
      for (int k = 0; k < modes_[2]; ++k)
        for (int j = 0; j < modes_[1]; ++j)
        {
          double *const row =
              field_.data() + (static_cast<std::size_t>(j) * modes_[2] + k) * modes_[0];
          for (int i = 0; i < modes_[0]; ++i)
            row[i] *= *value++;
        }
      fftw_execute(backward_.get());
      std::copy_n(field_.data(), n_own_, output);
      input += n_own_;
      output += n_own_;
    }
  }
} // namespace plumbline::algebra
