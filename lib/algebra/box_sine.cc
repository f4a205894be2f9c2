#include "algebra/rectangle_solver.h"
#include "algebra/sine_symbol.h"

#include "base/fftw.h"

#include <deal.II/lac/vector.h>

#include <algorithm>

namespace plumbline::algebra
{
  using base::AlignedArray;
  using base::Plan;
  using base::set_plan_threads;

  namespace
  {
    class BoxSineSolver : public RectangleSolver
    {
    public:
      BoxSineSolver(const Stencil &stencil, const std::array<int, 3> &all,
                    const geometry::CubeRange &box);
      void add_inverse(Vector &result, const Vector &input) const override;

    private:
      /// visit(its place in a component of the vectors, its place in the field) of each row.
      template <class Visit>
      void for_each_row(const Visit &visit) const
      {
        for (int k = 0; k < n_[2]; ++k)
          for (int j = 0; j < n_[1]; ++j)
            visit(from_[0] + all_[0] * (from_[1] + j + all_[1] * (from_[2] + k)),
                  n_[0] * (j + static_cast<std::size_t>(n_[1]) * k));
      }

      std::array<std::size_t, 3> all_, from_; ///< extents of vectors, and where the box begins
      std::array<int, 3> n_;                  ///< extents of the box
      std::vector<std::vector<double>> inverse_eigenvalues_; ///< of each component
      AlignedArray<double> field_;                           ///< shape (n[2], n[1], n[0])
      Plan transform_;                                       ///< its own inverse, but for a factor
    };

    BoxSineSolver::BoxSineSolver(const Stencil &stencil, const std::array<int, 3> &all,
                                 const geometry::CubeRange &box)
    {
      for (unsigned int d = 0; d < 3; ++d)
      {
        all_[d] = all[d];
        from_[d] = box.lower[d];
        n_[d] = box.upper[d] - box.lower[d];
      }
      field_ = AlignedArray<double>(static_cast<std::size_t>(n_[0]) * n_[1] * n_[2]);
      set_plan_threads(0); // see Convolution
      const std::array<int, 3> extents = {n_[2], n_[1], n_[0]};
      const std::array<fftw_r2r_kind, 3> kinds = {FFTW_RODFT00, FFTW_RODFT00, FFTW_RODFT00};
      transform_ = Plan(fftw_plan_r2r(3, extents.data(), field_.data(), field_.data(), kinds.data(),
                                      FFTW_ESTIMATE));
      double scale = 1;
      for (const int length : n_)
        scale /= 2. * (length + 1);
      for (unsigned int c = 0; c < stencil.n_blocks(); ++c)
      {
        std::vector<double> values = sine_symbol(stencil, c, n_, {0, n_[1]});
        const auto [least, largest] = std::minmax_element(values.begin(), values.end());
        check_positive(*least, *largest);
        for (double &value : values)
          value = scale / value;
        inverse_eigenvalues_.push_back(std::move(values));
      }
    }

    void BoxSineSolver::add_inverse(Vector &result, const Vector &input) const
    {
      const std::size_t n_all = all_[0] * all_[1] * all_[2];
      for (std::size_t c = 0; c < inverse_eigenvalues_.size(); ++c)
      {
        for_each_row(
            [&](std::size_t place, std::size_t row)
            { std::copy_n(input.begin() + c * n_all + place, n_[0], field_.data() + row); });
        fftw_execute(transform_.get());
        const double *const inverse = inverse_eigenvalues_[c].data();
        for (std::size_t p = 0; p < field_.size(); ++p)
          field_[p] *= inverse[p];
        fftw_execute(transform_.get());
        for_each_row(
            [&](std::size_t place, std::size_t row)
            {
              double *const to = result.begin() + c * n_all + place;
              for (int i = 0; i < n_[0]; ++i)
                to[i] += field_[row + i];
            });
      }
    }
  } // namespace

  std::unique_ptr<RectangleSolver> make_box_sine_solver(const Stencil &stencil,
                                                        const std::array<int, 3> &n,
                                                        const geometry::CubeRange &box)
  {
    return std::make_unique<BoxSineSolver>(stencil, n, box);
  }
} // namespace plumbline::algebra
