#include "algebra/block_sine.h"

#include "base/error.h"
#include "base/fftw.h"

#include <deal.II/lac/vector.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::algebra
{
  using base::AlignedArray;
  using base::Plan;
  using base::set_plan_threads;

  namespace
  {
    using Index = std::array<int, 3>;

    /// The waves of one family along an axis of n cells, θ_p = π p / n.
    struct Waves
    {
      bool is_odd = false;    ///< about the middle of the cell: cosines
      bool at_vertex = false; ///< sin(θ i), i = 1 ... n - 1; else at i + ½, i = 0 ... n - 1
      unsigned int partner = 0;

      int first_mode() const { return is_odd ? 0 : 1; }
      int first_position() const { return at_vertex ? 1 : 0; }
      int n_along(int n) const { return at_vertex ? n - 1 : n; }
      double place() const { return at_vertex ? 0 : .5; }
      fftw_r2r_kind forward() const
      {
        return at_vertex ? FFTW_RODFT00 : is_odd ? FFTW_REDFT10 : FFTW_RODFT10;
      }
      fftw_r2r_kind backward() const
      {
        return at_vertex ? FFTW_RODFT00 : is_odd ? FFTW_REDFT01 : FFTW_RODFT01;
      }
    };

    /// Of two families that mirror each other the first is that of their sum, the second that of
    /// their difference.
    std::vector<Waves> waves_of(const std::vector<geometry::AxisSpecies> &axis)
    {
      std::vector<Waves> waves;
      for (unsigned int s = 0; s < axis.size(); ++s)
        waves.push_back({axis[s].mirror < s, axis[s].at_vertex, axis[s].mirror});
      return waves;
    }

    /// The part of a family's sum or difference that a family is.
    double rotation(const std::vector<Waves> &waves, unsigned int wave, unsigned int family)
    {
      const unsigned int partner = waves[wave].partner;
      if (partner == wave)
        return wave == family ? 1 : 0;
      if (family != wave && family != partner)
        return 0;
      return waves[wave].is_odd && family == wave ? -M_SQRT1_2 : M_SQRT1_2;
    }

    /// Factors of entries along an axis of n cells: from families s, t and offset k to waves S, T
    /// and mode p, shape (n_axis² (n + 1), n_axis² (2 reach + 1)). With f_S(i) = Im c_S e^{iθ(i +
    /// x_S)}, c_S = 1 for sines and i for cosines, A_ST(k) acts on f_T as Re (c_T / c_S) e^{iθ(k +
    /// x_T - x_S)}.
    Eigen::MatrixXd factors(const std::vector<Waves> &waves, int n, int reach)
    {
      const auto n_axis = static_cast<unsigned int>(waves.size());
      const int width = 2 * reach + 1;
      Eigen::MatrixXd result(n_axis * n_axis * (n + 1), n_axis * n_axis * width);
      for (unsigned int s = 0; s < n_axis; ++s)
        for (unsigned int t = 0; t < n_axis; ++t)
          for (int p = 0; p <= n; ++p)
            for (unsigned int from_s = 0; from_s < n_axis; ++from_s)
              for (unsigned int from_t = 0; from_t < n_axis; ++from_t)
                for (int k = -reach; k <= reach; ++k)
                {
                  const double phase = M_PI * p / n * (k + waves[t].place() - waves[s].place());
                  const double wave = waves[s].is_odd == waves[t].is_odd ? std::cos(phase)
                                      : waves[s].is_odd                  ? std::sin(phase)
                                                                         : -std::sin(phase);
                  result((s * n_axis + t) * (n + 1) + p,
                         (from_s * n_axis + from_t) * width + k + reach) =
                      rotation(waves, s, from_s) * rotation(waves, t, from_t) * wave;
                }
      return result;
    }

    class BlockSineSolver : public RectangleSolver
    {
    public:
      BlockSineSolver(const Stencil &stencil, const geometry::CubeFamilies &nodes,
                      const geometry::CubeRange &box);
      void add_inverse(Vector &result, const Vector &input) const override;

    private:
      /// A family's part of the field, shape (n[2], n[1], n[0]).
      struct Part
      {
        std::array<unsigned int, 3> along{};
        Index n{}, first_mode{}, first_position{};
        std::size_t start = 0;
        Plan forward, backward;

        std::size_t size() const { return static_cast<std::size_t>(n[0]) * n[1] * n[2]; }

        /// Of a mode; -1: the family has none.
        std::ptrdiff_t place(const Index &p) const
        {
          std::ptrdiff_t result = 0;
          for (unsigned int d = 3; d-- > 0;)
          {
            const int i = p[d] - first_mode[d];
            if (i < 0 || i >= n[d])
              return -1;
            result = result * n[d] + i;
          }
          return static_cast<std::ptrdiff_t>(start) + result;
        }
      };

      void make_parts();
      void invert_symbol(const Stencil &stencil, unsigned int component);
      void add_inverse_of(Eigen::MatrixXd &block, const Index &mode);
      void multiply(const double *inverse) const;
      void rotate() const;

      /// visit(its place in a component of the vectors, its place in the field) of each row.
      template <class Visit>
      void for_each_row(unsigned int family, const Visit &visit) const
      {
        const Part &part = parts_[family];
        for (int k = 0; k < part.n[2]; ++k)
          for (int j = 0; j < part.n[1]; ++j)
            visit(family * n_positions_ +
                      geometry::number_within({box_.lower[0] + part.first_position[0],
                                               box_.lower[1] + part.first_position[1] + j,
                                               box_.lower[2] + part.first_position[2] + k},
                                              all_),
                  part.start + part.n[0] * (j + static_cast<std::size_t>(part.n[1]) * k));
      }

      Index all_; ///< extents of vectors
      std::size_t n_positions_;
      geometry::CubeRange box_;
      Index n_{};
      std::vector<Waves> waves_;
      std::vector<Part> parts_;
      /// Lower triangles, shape (n_components, n[2] + 1, n[1] + 1, n[0] + 1, n_families (n_families
      /// + 1) / 2)
      std::vector<std::vector<double>> inverse_;
      AlignedArray<double> field_;
    };

    BlockSineSolver::BlockSineSolver(const Stencil &stencil, const geometry::CubeFamilies &nodes,
                                     const geometry::CubeRange &box)
        : all_(nodes.n), n_positions_(nodes.n_positions()), box_(box), waves_(waves_of(nodes.axis))
    {
      for (unsigned int d = 0; d < 3; ++d)
        n_[d] = box.upper[d] - box.lower[d];
      std::size_t size = 0;
      for (unsigned int family = 0; family < nodes.n_families(); ++family)
      {
        Part part;
        part.along = nodes.along(family);
        for (unsigned int d = 0; d < 3; ++d)
        {
          const Waves &waves = waves_[part.along[d]];
          part.n[d] = waves.n_along(n_[d]);
          part.first_mode[d] = waves.first_mode();
          part.first_position[d] = waves.first_position();
        }
        part.start = size;
        size += part.size();
        parts_.push_back(std::move(part));
      }
      field_ = AlignedArray<double>(size);
      make_parts();
      for (unsigned int c = 0; c < nodes.n_components; ++c)
        invert_symbol(stencil, c);
    }

    void BlockSineSolver::make_parts()
    {
      set_plan_threads(0); // see Convolution
      for (Part &part : parts_)
      {
        if (part.size() == 0)
          continue; // a box one cell thick has no vertex inside
        double *const values = field_.data() + part.start;
        const Index extents = {part.n[2], part.n[1], part.n[0]};
        std::array<fftw_r2r_kind, 3> forward{}, backward{};
        for (unsigned int d = 0; d < 3; ++d)
        {
          forward[2 - d] = waves_[part.along[d]].forward();
          backward[2 - d] = waves_[part.along[d]].backward();
        }
        // parts begin anywhere in the field
        const unsigned int flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
        part.forward =
            Plan(fftw_plan_r2r(3, extents.data(), values, values, forward.data(), flags));
        part.backward =
            Plan(fftw_plan_r2r(3, extents.data(), values, values, backward.data(), flags));
      }
    }

    /// @param block  of the families that have the mode; unused rows are zero
    void BlockSineSolver::add_inverse_of(Eigen::MatrixXd &block, const Index &mode)
    {
      const double scale = 1. / (8. * n_[0] * n_[1] * n_[2]);
      const auto n_families = static_cast<unsigned int>(parts_.size());
      std::vector<double> &inverse = inverse_.back();
      for (unsigned int s = 0; s < n_families; ++s)
        if (parts_[s].place(mode) < 0)
        {
          block.row(s).setZero();
          block.col(s).setZero();
          block(s, s) = 1;
        }
      const Eigen::LLT<Eigen::MatrixXd> cholesky(block);
      if (cholesky.info() != Eigen::Success)
      {
        std::ostringstream message;
        message << "the operator is not positive definite: a block of its symbol has the "
                   "eigenvalue "
                << Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(block, Eigen::EigenvaluesOnly)
                       .eigenvalues()
                       .minCoeff()
                << "; the discretisation is unstable here, change the ratio horizon / h";
        throw NumericalError(message.str());
      }
      block = cholesky.solve(Eigen::MatrixXd::Identity(n_families, n_families));
      for (unsigned int s = 0; s < n_families; ++s)
        for (unsigned int t = 0; t <= s; ++t)
          inverse.push_back(scale * block(s, t));
    }

    /// The symbol of one component at all modes, axis by axis and layer by layer, inverted.
    void BlockSineSolver::invert_symbol(const Stencil &stencil, unsigned int component)
    {
      const auto n_axis = static_cast<unsigned int>(waves_.size());
      const unsigned int n_pairs = n_axis * n_axis, n_families = n_pairs * n_axis;
      const auto &reach = stencil.reaches();
      std::array<Eigen::MatrixXd, 3> along;
      for (unsigned int d = 0; d < 3; ++d)
        along[d] = factors(waves_, n_[d], reach[d]);
      const auto column = [&](unsigned int s, unsigned int t, int k, unsigned int d)
      { return (s * n_axis + t) * (2 * reach[d] + 1) + k + reach[d]; };
      // rows: of the third axis as in its factors; columns: modes of the first, then the second
      Eigen::MatrixXd planes(along[2].cols(), along[0].rows() * along[1].rows());
      for (unsigned int s3 = 0; s3 < n_axis; ++s3)
        for (unsigned int t3 = 0; t3 < n_axis; ++t3)
          for (int k3 = -reach[2]; k3 <= reach[2]; ++k3)
          {
            Eigen::MatrixXd entries(along[0].cols(), along[1].cols());
            for (unsigned int s = 0; s < n_pairs; ++s)
              for (unsigned int t = 0; t < n_pairs; ++t)
                for (int k2 = -reach[1]; k2 <= reach[1]; ++k2)
                  for (int k1 = -reach[0]; k1 <= reach[0]; ++k1)
                    entries(column(s % n_axis, t % n_axis, k1, 0),
                            column(s / n_axis, t / n_axis, k2, 1)) =
                        stencil(component * n_families + s + n_pairs * s3,
                                component * n_families + t + n_pairs * t3, k1, k2, k3);
            const Eigen::MatrixXd plane = along[0] * entries * along[1].transpose();
            planes.row(column(s3, t3, k3, 2)) =
                Eigen::Map<const Eigen::RowVectorXd>(plane.data(), plane.size());
          }

      std::vector<double> inverse;
      inverse.reserve((n_[0] + 1.) * (n_[1] + 1.) * (n_[2] + 1.) * n_families * (n_families + 1) /
                      2);
      inverse_.push_back(std::move(inverse));
      Eigen::MatrixXd block(n_families, n_families);
      for (int p3 = 0; p3 <= n_[2]; ++p3)
      {
        Eigen::MatrixXd of_layer(n_pairs, along[2].cols());
        for (unsigned int pair = 0; pair < n_pairs; ++pair)
          of_layer.row(pair) = along[2].row(pair * (n_[2] + 1) + p3);
        const Eigen::MatrixXd layer = of_layer * planes;
        for (int p2 = 0; p2 <= n_[1]; ++p2)
          for (int p1 = 0; p1 <= n_[0]; ++p1)
          {
            for (unsigned int s = 0; s < n_families; ++s)
              for (unsigned int t = 0; t < n_families; ++t)
              {
                const auto &S = parts_[s].along, &T = parts_[t].along;
                block(s, t) = layer(S[2] * n_axis + T[2],
                                    ((S[1] * n_axis + T[1]) * (n_[1] + 1) + p2) * along[0].rows() +
                                        (S[0] * n_axis + T[0]) * (n_[0] + 1) + p1);
              }
            add_inverse_of(block, {p1, p2, p3});
          }
      }
    }

    /// Families that mirror each other into their sum and difference, and back.
    void BlockSineSolver::rotate() const
    {
      unsigned int step = 1;
      for (unsigned int d = 0; d < 3; ++d, step *= static_cast<unsigned int>(waves_.size()))
        for (const Part &part : parts_)
        {
          const unsigned int s = part.along[d], partner = waves_[s].partner;
          if (partner <= s)
            continue;
          double *const sum = field_.data() + part.start,
                        *const difference =
                            field_.data() + parts_[static_cast<std::size_t>(&part - parts_.data()) +
                                                   (partner - s) * step]
                                                .start;
          for (std::size_t i = 0; i < part.size(); ++i)
          {
            const double a = sum[i], b = difference[i];
            sum[i] = M_SQRT1_2 * (a + b);
            difference[i] = M_SQRT1_2 * (a - b);
          }
        }
    }

    /// Modes by the inverse of their blocks.
    void BlockSineSolver::multiply(const double *inverse) const
    {
      const auto n_families = static_cast<unsigned int>(parts_.size());
      std::vector<std::ptrdiff_t> places(n_families);
      std::vector<double> in(n_families), out(n_families);
      geometry::for_each_index({0, 0, 0}, {n_[0] + 1, n_[1] + 1, n_[2] + 1},
                               [&](const Index &mode)
                               {
                                 for (unsigned int s = 0; s < n_families; ++s)
                                 {
                                   places[s] = parts_[s].place(mode);
                                   in[s] = places[s] < 0 ? 0 : field_[places[s]];
                                   out[s] = 0;
                                 }
                                 for (unsigned int s = 0; s < n_families; ++s)
                                 {
                                   for (unsigned int t = 0; t < s; ++t, ++inverse)
                                   {
                                     out[s] += *inverse * in[t];
                                     out[t] += *inverse * in[s];
                                   }
                                   out[s] += *inverse++ * in[s];
                                 }
                                 for (unsigned int s = 0; s < n_families; ++s)
                                   if (places[s] >= 0)
                                     field_[places[s]] = out[s];
                               });
    }

    void BlockSineSolver::add_inverse(Vector &result, const Vector &input) const
    {
      const auto n_families = static_cast<unsigned int>(parts_.size());
      const std::size_t n_of_component = n_families * n_positions_;
      for (std::size_t c = 0; c < inverse_.size(); ++c)
      {
        for (unsigned int s = 0; s < n_families; ++s)
          for_each_row(s,
                       [&](std::size_t place, std::size_t row) {
                         std::copy_n(input.begin() + c * n_of_component + place, parts_[s].n[0],
                                     field_.data() + row);
                       });
        rotate();
        for (const Part &part : parts_)
          if (part.size() > 0)
            fftw_execute(part.forward.get());
        multiply(inverse_[c].data());
        for (const Part &part : parts_)
          if (part.size() > 0)
            fftw_execute(part.backward.get());
        rotate();
        for (unsigned int s = 0; s < n_families; ++s)
          for_each_row(s,
                       [&](std::size_t place, std::size_t row)
                       {
                         double *const to = result.begin() + c * n_of_component + place;
                         for (int i = 0; i < parts_[s].n[0]; ++i)
                           to[i] += field_[row + i];
                       });
      }
    }
  } // namespace

  std::unique_ptr<RectangleSolver> make_block_sine_solver(const Stencil &stencil,
                                                          const geometry::CubeFamilies &nodes,
                                                          const geometry::CubeRange &box)
  {
    return std::make_unique<BlockSineSolver>(stencil, nodes, box);
  }
} // namespace plumbline::algebra
