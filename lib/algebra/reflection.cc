#include "algebra/rectangle_solver.h"

#include "algebra/sine_row.h"
#include "base/error.h"
#include "base/fftw.h"

#include <deal.II/lac/vector.h>

#include <Eigen/Dense>

#include <cmath>
#include <complex>
#include <sstream>

namespace plumbline::algebra
{
  using base::AlignedArray;
  using base::Plan;
  using base::set_plan_threads;

  namespace
  {
    using Complex = std::complex<double>;
    using Block = Eigen::MatrixXcd;

    /// One place of the doubled period that a degree of freedom is reflected to.
    struct Image
    {
      int index;           ///< in [0, 2 width)
      unsigned int family; ///< along the axis
      double sign;
    };

    class ReflectionSolver : public RectangleSolver
    {
    public:
      ReflectionSolver(const Stencil &stencil, const geometry::NodeSet &nodes,
                       const geometry::CellRange &cells);
      void add_inverse(Vector &result, const Vector &input) const override;

    private:
      std::array<Image, 2> images(unsigned int axis, unsigned int family, int i) const;
      void invert_symbol(const Stencil &stencil, unsigned int component);

      geometry::NodeSet nodes_;
      std::array<int, 2> lower_, n_;          ///< first cell and number of cells
      std::array<int, 2> before_{}, width_{}; ///< cells before those, and with them and those after
      std::size_t n_real_ = 0, n_modes_ = 0;
      std::vector<Complex> inverse_; ///< shape (n_components, n_modes, n_families, n_families)
      AlignedArray<double> field_;   ///< shape (n_families, 2 width[1], 2 width[0])
      AlignedArray<Complex> modes_;  ///< shape (n_families, n_modes)
      Plan forward_, backward_;
    };

    ReflectionSolver::ReflectionSolver(const Stencil &stencil, const geometry::NodeSet &nodes,
                                       const geometry::CellRange &cells)
        : nodes_(nodes),
          lower_(cells.lower), n_{cells.upper[0] - cells.lower[0], cells.upper[1] - cells.lower[1]}
    {
      for (unsigned int d = 0; d < 2; ++d)
      {
        const SineRow row = fast_sine_row(n_[d], stencil.reach(), 0);
        before_[d] = row.n_before;
        width_[d] = row.n;
      }
      n_real_ = 4 * static_cast<std::size_t>(width_[0]) * width_[1];
      n_modes_ = 2 * static_cast<std::size_t>(width_[1]) * (width_[0] + 1);
      const unsigned int n_families = nodes.n_families();
      field_ = AlignedArray<double>(n_families * n_real_);
      modes_ = AlignedArray<Complex>(n_families * n_modes_);
      const int dims[2] = {2 * width_[1], 2 * width_[0]};
      auto *const modes = reinterpret_cast<fftw_complex *>(modes_.data());
      const int many = static_cast<int>(n_families), n_real = static_cast<int>(n_real_),
                n_modes = static_cast<int>(n_modes_);
      set_plan_threads(n_real_);
      forward_ = Plan(fftw_plan_many_dft_r2c(2, dims, many, field_.data(), nullptr, 1, n_real,
                                             modes, nullptr, 1, n_modes, FFTW_ESTIMATE));
      backward_ = Plan(fftw_plan_many_dft_c2r(2, dims, many, modes, nullptr, 1, n_modes,
                                              field_.data(), nullptr, 1, n_real, FFTW_ESTIMATE));
      inverse_.reserve(nodes.n_components * n_modes_ * n_families * n_families);
      for (unsigned int c = 0; c < nodes.n_components; ++c)
        invert_symbol(stencil, c);
    }

    /// Symbol of one component's diagonal block at every mode of the doubled period, inverted.
    void ReflectionSolver::invert_symbol(const Stencil &stencil, unsigned int component)
    {
      const unsigned int n_families = nodes_.n_families();
      const int reach = stencil.reach(), period[2] = {2 * width_[0], 2 * width_[1]};
      const double scale = 1. / static_cast<double>(n_real_);
      const auto wrap = [](int k, int p) { return ((k % p) + p) % p; };
      std::vector<Complex> symbol(n_families * n_families * n_modes_);
      for (unsigned int s = 0; s < n_families; ++s)
      {
        std::fill_n(field_.data(), field_.size(), 0.);
        for (unsigned int t = 0; t < n_families; ++t)
          for (int k2 = -reach; k2 <= reach; ++k2)
            for (int k1 = -reach; k1 <= reach; ++k1)
              field_[t * n_real_ + static_cast<std::size_t>(wrap(-k2, period[1])) * period[0] +
                     wrap(-k1, period[0])] +=
                  stencil(component * n_families + s, component * n_families + t, k1, k2);
        fftw_execute(forward_.get());
        std::copy_n(modes_.data(), modes_.size(), symbol.begin() + s * modes_.size());
      }

      for (std::size_t q = 0; q < n_modes_; ++q)
      {
        Block block(n_families, n_families);
        for (unsigned int s = 0; s < n_families; ++s)
          for (unsigned int t = 0; t < n_families; ++t)
            block(s, t) = symbol[(s * n_families + t) * n_modes_ + q];
        // odd fields have no constant part: lift the kernel of the zero mode out of the way
        if (q == 0)
          block.array() += block.diagonal().real().mean();
        const Eigen::LDLT<Block> factors(block);
        if (factors.info() != Eigen::Success || !(factors.vectorD().real().minCoeff() > 0))
        {
          std::ostringstream message;
          message << "the operator is not positive definite: a block of its symbol has the pivot "
                  << factors.vectorD().real().minCoeff()
                  << "; the discretisation is unstable here, change the ratio horizon / h";
          throw NumericalError(message.str());
        }
        const Block inverse = scale * factors.solve(Block::Identity(n_families, n_families));
        for (unsigned int s = 0; s < n_families; ++s)
          for (unsigned int t = 0; t < n_families; ++t)
            inverse_.push_back(inverse(s, t));
      }
    }

    /// A value and its odd mirror image about the rectangle's lower side along one axis.
    std::array<Image, 2> ReflectionSolver::images(unsigned int axis, unsigned int family,
                                                  int i) const
    {
      const geometry::AxisSpecies &species = nodes_.axis[family];
      const int period = 2 * width_[axis];
      i += before_[axis];
      const int mirrored = species.at_vertex ? (period - i) % period : period - 1 - i;
      return {Image{i, family, 1}, Image{mirrored, species.mirror, -1}};
    }

    void ReflectionSolver::add_inverse(Vector &result, const Vector &input) const
    {
      const auto n_axis = static_cast<unsigned int>(nodes_.axis.size());
      const unsigned int n_families = nodes_.n_families();
      const auto visit = [&](const auto &action)
      {
        for (unsigned int s = 0; s < n_families; ++s)
        {
          const unsigned int s1 = s % n_axis, s2 = s / n_axis;
          for (int j = nodes_.axis[s2].at_vertex ? 1 : 0; j < n_[1]; ++j)
            for (int i = nodes_.axis[s1].at_vertex ? 1 : 0; i < n_[0]; ++i)
              action(s, s1, s2, i, j,
                     (static_cast<std::size_t>(s) * nodes_.n[1] + lower_[1] + j) * nodes_.n[0] +
                         lower_[0] + i);
        }
      };
      const std::size_t width = 2 * static_cast<std::size_t>(width_[0]);

      for (unsigned int c = 0; c < nodes_.n_components; ++c)
      {
        const std::size_t start = c * n_families * nodes_.n_positions();
        std::fill_n(field_.data(), field_.size(), 0.);
        visit(
            [&](unsigned int, unsigned int s1, unsigned int s2, int i, int j, std::size_t at)
            {
              for (const Image &x : images(0, s1, i))
                for (const Image &y : images(1, s2, j))
                  field_[(x.family + y.family * n_axis) * n_real_ + y.index * width + x.index] =
                      x.sign * y.sign * input[start + at];
            });
        fftw_execute(forward_.get());
        Eigen::VectorXcd in(n_families);
        for (std::size_t q = 0; q < n_modes_; ++q)
        {
          for (unsigned int s = 0; s < n_families; ++s)
            in[s] = modes_[s * n_modes_ + q];
          const Complex *row = inverse_.data() + (c * n_modes_ + q) * n_families * n_families;
          for (unsigned int s = 0; s < n_families; ++s, row += n_families)
          {
            Complex sum = 0;
            for (unsigned int t = 0; t < n_families; ++t)
              sum += row[t] * in[t];
            modes_[s * n_modes_ + q] = sum;
          }
        }
        fftw_execute(backward_.get());
        visit(
            [&](unsigned int s, unsigned int, unsigned int, int i, int j, std::size_t at) {
              result[start + at] += field_[s * n_real_ + (before_[1] + j) * width + before_[0] + i];
            });
      }
    }
  } // namespace

  std::unique_ptr<RectangleSolver> make_reflection_solver(const Stencil &stencil,
                                                          const geometry::NodeSet &nodes,
                                                          const geometry::CellRange &cells)
  {
    return std::make_unique<ReflectionSolver>(stencil, nodes, cells);
  }
} // namespace plumbline::algebra
