#include "algebra/rectangle_solver.h"

#include "algebra/fftw.h"
#include "base/error.h"

#include <Eigen/Core>

#include <cmath>
#include <sstream>

namespace plumbline::algebra
{
  namespace
  {
    /// The transform along one axis: its modes have the frequencies 2π (p + offset) / length.
    struct Axis
    {
      fftw_r2r_kind forward, backward;
      double offset;
      int length; ///< forward and backward together multiply by it
    };

    Axis axis_between(const std::array<Side, 2> &sides, int n)
    {
      if (sides[0] == Side::zero)
        return sides[1] == Side::zero ? Axis{FFTW_RODFT00, FFTW_RODFT00, 1, 2 * (n + 1)}
                                      : Axis{FFTW_RODFT01, FFTW_RODFT10, .5, 2 * n};
      return sides[1] == Side::zero ? Axis{FFTW_REDFT01, FFTW_REDFT10, .5, 2 * n}
                                    : Axis{FFTW_REDFT00, FFTW_REDFT00, 0, 2 * (n - 1)};
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
                 const geometry::CellRange &cells, const Sides &sides);
      void add_inverse(Vector &result, const Vector &input) const override;

    private:
      void double_mirrored() const;
      std::size_t position(unsigned int component, int j) const
      {
        return component * stride_component_ +
               static_cast<std::size_t>(from_[1] + j) * stride_row_ + from_[0];
      }

      Sides sides_;
      unsigned int n_components_;
      std::size_t stride_row_, stride_component_;
      std::array<int, 2> from_, n_;
      std::vector<double> inverse_eigenvalues_; ///< shape (n_components, n[1], n[0])
      AlignedArray<double> field_;              ///< shape (n[1], n[0])
      Plan forward_, backward_;
    };

    SineSolver::SineSolver(const Stencil &stencil, const geometry::NodeSet &nodes,
                           const geometry::CellRange &cells, const Sides &sides)
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

      const std::size_t n = static_cast<std::size_t>(n_[0]) * n_[1];
      field_ = AlignedArray<double>(n);
      set_plan_threads(n);
      const Axis axis0 = axis_between(sides[0], n_[0]), axis1 = axis_between(sides[1], n_[1]);
      const auto plan = [&](fftw_r2r_kind kind1, fftw_r2r_kind kind0)
      {
        return Plan(fftw_plan_r2r_2d(n_[1], n_[0], field_.data(), field_.data(), kind1, kind0,
                                     FFTW_ESTIMATE));
      };
      forward_ = plan(axis1.forward, axis0.forward);
      backward_ = plan(axis1.backward, axis0.backward);

      const double scale = 1. / (static_cast<double>(axis0.length) * axis1.length);
      const int reach = stencil.reach();
      const Eigen::MatrixXd cos0 = cosines(axis0, n_[0], reach),
                            cos1 = cosines(axis1, n_[1], reach);
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
        for (Eigen::Index i = 0; i < eigenvalues.size(); ++i)
          inverse_eigenvalues_.push_back(scale / eigenvalues.data()[i]);
      }
    }

    /// Rows of half cells become those of the mirrored operator.
    void SineSolver::double_mirrored() const
    {
      for (unsigned int upper = 0; upper < 2; ++upper)
      {
        if (sides_[0][upper] == Side::mirrored)
          for (int j = 0; j < n_[1]; ++j)
            field_[static_cast<std::size_t>(j) * n_[0] + upper * (n_[0] - 1)] *= 2;
        if (sides_[1][upper] == Side::mirrored)
          for (int i = 0; i < n_[0]; ++i)
            field_[static_cast<std::size_t>(upper) * (n_[1] - 1) * n_[0] + i] *= 2;
      }
    }

    void SineSolver::add_inverse(Vector &result, const Vector &input) const
    {
      const double *inverse = inverse_eigenvalues_.data();
      for (unsigned int c = 0; c < n_components_ && field_.size() > 0; ++c)
      {
        for (int j = 0; j < n_[1]; ++j)
          std::copy_n(input.begin() + position(c, j), n_[0],
                      field_.data() + static_cast<std::size_t>(j) * n_[0]);
        double_mirrored();
        fftw_execute(forward_.get());
        for (std::size_t i = 0; i < field_.size(); ++i)
          field_[i] *= *inverse++;
        fftw_execute(backward_.get());
        for (int j = 0; j < n_[1]; ++j)
        {
          double *const to = result.begin() + position(c, j);
          for (int i = 0; i < n_[0]; ++i)
            to[i] += field_[static_cast<std::size_t>(j) * n_[0] + i];
        }
      }
    }
  } // namespace

  std::unique_ptr<RectangleSolver> make_sine_solver(const Stencil &stencil,
                                                    const geometry::NodeSet &nodes,
                                                    const geometry::CellRange &cells,
                                                    const Sides &sides)
  {
    return std::make_unique<SineSolver>(stencil, nodes, cells, sides);
  }
} // namespace plumbline::algebra
