#include "algebra/rectangle_solver.h"

#include "algebra/constrained_nodes.h"
#include "algebra/simd.h"
#include "base/error.h"
#include "base/fftw.h"

#include <deal.II/lac/vector.h>

#include <Eigen/Core>

#include <cmath>
#include <sstream>

namespace plumbline::algebra
{
  using base::AlignedArray;
  using base::Plan;
  using base::set_plan_threads;

  namespace
  {
    /// The transform along one axis: its modes have the frequencies 2π (p + offset) / length.
    struct Axis
    {
      fftw_r2r_kind forward, backward;
      double offset;
      int length; ///< forward and backward together multiply by it
    };

    /// @param row  the same where both sides are zeros
    Axis axis_between(const std::array<Side, 2> &sides, const SineRow &row)
    {
      if (sides[0] == Side::zero && sides[1] == Side::zero)
        return row.is_longer() ? Axis{FFTW_RODFT10, FFTW_RODFT01, 1, row.period()}
                               : Axis{FFTW_RODFT00, FFTW_RODFT00, 1, row.period()};
      if (sides[0] == Side::zero)
        return {FFTW_RODFT01, FFTW_RODFT10, .5, 2 * row.n};
      return sides[1] == Side::zero ? Axis{FFTW_REDFT01, FFTW_REDFT10, .5, 2 * row.n}
                                    : Axis{FFTW_REDFT00, FFTW_REDFT00, 0, 2 * (row.n - 1)};
    }

    /// Nodes of one axis as they are transformed. The 5-point and 9-point stencils of reach 1 are
    /// inverted exactly as they stand.
    SineRow transformed_row(const std::array<Side, 2> &sides, int n, const Stencil &stencil,
                            unsigned int n_components, Zeros zeros)
    {
      const bool is_between_zeros = sides[0] == Side::zero && sides[1] == Side::zero;
      const int reach = stencil.reach();
      if (zeros == Zeros::next || !is_between_zeros || reach <= 1)
        return {n};
      return fast_sine_row(n, reach, nodes_to_hold(reach, n_components));
    }

    /// Whole vectors. CsrMatrix of a power of two doubles would meet in one part of the cache,
    /// column by column: a transform of 1024 x 1024 takes twice as long then.
    int row_stride(int width)
    {
      constexpr int crowded = 64;
      const int stride = (width + wide - 1) / wide * wide;
      return stride % crowded == 0 ? stride + wide : stride;
    }

    /// cos(k t_p), t_p the n frequencies, times 2 for k > 0 (both signs of k).
    Eigen::MatrixXd cosines(const Axis &axis, int n, int reach)
    {
      Eigen::MatrixXd result(n, reach + 1);
      for (int p = 0; p < n; ++p)
        for (int k = 0; k <= reach; ++k)
          result(p, k) =
              (k == 0 ? 1 : 2) * std::cos(2 * M_PI * k * (p + axis.offset) / axis.length);
      return result;
    }

    class SineSolver : public RectangleSolver
    {
    public:
      SineSolver(const Stencil &stencil, const geometry::NodeSet &nodes,
                 const geometry::CellRange &cells, const Sides &sides, Zeros zeros);
      void add_inverse(Vector &result, const Vector &input) const override;

    private:
      void double_mirrored() const;
      double *row(int j) const
      {
        return field_.data() + static_cast<std::size_t>(before_[1] + j) * stride_ + before_[0];
      }
      std::size_t position(unsigned int component, int j) const
      {
        return component * stride_component_ +
               static_cast<std::size_t>(from_[1] + j) * stride_row_ + from_[0];
      }

      Sides sides_;
      unsigned int n_components_;
      std::size_t stride_row_, stride_component_;
      std::array<int, 2> from_, n_;
      std::array<int, 2> width_{}, before_{};     ///< of the transform, and zeros before the nodes
      int stride_ = 0;                            ///< between rows of field_
      std::vector<double> inverse_eigenvalues_;   ///< shape (n_components, width[1], stride)
      std::vector<ConstrainedNodes> constrained_; ///< of each component
      AlignedArray<double> field_;                ///< shape (width[1], stride)
      Plan forward_, backward_;
    };

    SineSolver::SineSolver(const Stencil &stencil, const geometry::NodeSet &nodes,
                           const geometry::CellRange &cells, const Sides &sides, Zeros zeros)
        : sides_(sides), n_components_(nodes.n_components), stride_row_(nodes.n[0]),
          stride_component_(nodes.n_positions())
    {
      const int first = nodes.axis[0].at_vertex ? 1 : 0;
      for (unsigned int d = 0; d < 2; ++d)
      {
        from_[d] = cells.lower[d] + first;
        n_[d] = cells.upper[d] - from_[d];
      }
      if (n_[0] <= 0 || n_[1] <= 0)
        return; // a strip one cell wide has no vertex inside
      const SineRow row0 = transformed_row(sides[0], n_[0], stencil, n_components_, zeros),
                    row1 = transformed_row(sides[1], n_[1], stencil, n_components_, zeros);
      width_ = {row0.n, row1.n};
      before_ = {row0.n_before, row1.n_before};
      stride_ = row_stride(width_[0]);

      const std::size_t n = static_cast<std::size_t>(stride_) * width_[1];
      field_ = AlignedArray<double>(n);
      std::fill_n(field_.data(), n, 0.);
      set_plan_threads(n);
      const Axis axis0 = axis_between(sides[0], row0), axis1 = axis_between(sides[1], row1);
      const auto plan = [&](fftw_r2r_kind kind1, fftw_r2r_kind kind0)
      {
        const std::array<int, 2> extents = {width_[1], width_[0]}, embedding = {width_[1], stride_};
        const std::array<fftw_r2r_kind, 2> kinds = {kind1, kind0};
        return Plan(fftw_plan_many_r2r(2, extents.data(), 1, field_.data(), embedding.data(), 1, 0,
                                       field_.data(), embedding.data(), 1, 0, kinds.data(),
                                       FFTW_ESTIMATE));
      };
      forward_ = plan(axis1.forward, axis0.forward);
      backward_ = plan(axis1.backward, axis0.backward);

      const double scale = 1. / (static_cast<double>(axis0.length) * axis1.length);
      const int reach = stencil.reach();
      const Eigen::MatrixXd cos0 = cosines(axis0, width_[0], reach),
                            cos1 = cosines(axis1, width_[1], reach);
      inverse_eigenvalues_.resize(n_components_ * n);
      for (unsigned int c = 0; c < n_components_; ++c)
      {
        Eigen::MatrixXd entries(reach + 1, reach + 1);
        for (int k1 = 0; k1 <= reach; ++k1)
          for (int k2 = 0; k2 <= reach; ++k2)
            entries(k1, k2) = stencil(c, c, k1, k2);
        const Eigen::MatrixXd eigenvalues = cos0 * entries * cos1.transpose();
        if (!(eigenvalues.minCoeff() > 0))
        {
          std::ostringstream message;
          message << "the operator is not positive definite: its symbol reaches "
                  << eigenvalues.minCoeff() << " (largest " << eigenvalues.maxCoeff()
                  << "); the rule is unstable here, change the rule or the ratio horizon / h";
          throw NumericalError(message.str());
        }
        double *const inverse = inverse_eigenvalues_.data() + c * n;
        for (int j = 0; j < width_[1]; ++j)
          for (int i = 0; i < width_[0]; ++i)
            inverse[static_cast<std::size_t>(j) * stride_ + i] = scale / eigenvalues(i, j);
        constrained_.emplace_back(std::array<SineRow, 2>{row0, row1}, stride_, inverse);
      }
    }

    /// Rows of half cells become those of the mirrored operator.
    void SineSolver::double_mirrored() const
    {
      for (unsigned int upper = 0; upper < 2; ++upper)
      {
        if (sides_[0][upper] == Side::mirrored)
          for (int j = 0; j < n_[1]; ++j)
            row(j)[upper * (n_[0] - 1)] *= 2;
        if (sides_[1][upper] == Side::mirrored)
          for (int i = 0; i < n_[0]; ++i)
            row(static_cast<int>(upper) * (n_[1] - 1))[i] *= 2;
      }
    }

    void SineSolver::add_inverse(Vector &result, const Vector &input) const
    {
      for (unsigned int c = 0; c < n_components_ && field_.size() > 0; ++c)
      {
        if (width_ != n_)
          std::fill_n(field_.data(), field_.size(), 0.);
        for (int j = 0; j < n_[1]; ++j)
          std::copy_n(input.begin() + position(c, j), n_[0], row(j));
        double_mirrored();
        fftw_execute(forward_.get());
        constrained_[c].apply(field_.data(), inverse_eigenvalues_.data() + c * field_.size());
        fftw_execute(backward_.get());
        for (int j = 0; j < n_[1]; ++j)
        {
          double *const to = result.begin() + position(c, j);
          for (int i = 0; i < n_[0]; ++i)
            to[i] += row(j)[i];
        }
      }
    }
  } // namespace

  std::unique_ptr<RectangleSolver> make_sine_solver(const Stencil &stencil,
                                                    const geometry::NodeSet &nodes,
                                                    const geometry::CellRange &cells,
                                                    const Sides &sides, Zeros zeros)
  {
    return std::make_unique<SineSolver>(stencil, nodes, cells, sides, zeros);
  }
} // namespace plumbline::algebra
