#include "uq/largest_modes.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/symmetric_eigen.h"
#include "uq/generator.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <string>

namespace plumbline::uq
{
  namespace
  {
    using base::SymmetricEigen;
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /// An orthonormal basis that grows by blocks, and the matrix seen in it.
    class Basis
    {
    public:
      Basis(Index size, Index room, Index block)
          : vectors_(size, room), seen_(MatrixXd::Zero(room, room)), next_(size, block),
            coupling_(MatrixXd::Zero(block, block))
      {
        for (double &entry : next_.reshaped())
          entry = numbers_.normal();
        orthonormalise_next();
      }

      Index n() const { return n_; }
      Index block() const { return next_.cols(); }

      /// Take the next block in, and make one more of its product.
      void grow(const BlockProduct &product)
      {
        const Index b = block(), old = n_;
        vectors_.middleCols(old, b) = next_;
        n_ += b;
        product(vectors_.col(old).data(), next_.data(), static_cast<unsigned int>(b));
        if (!next_.allFinite())
          throw NumericalError("the modes of a random field: a covariance is not a finite number");
        seen_.block(0, old, n_, b) = orthonormalise_next();
        seen_.block(old, 0, b, n_) = seen_.block(0, old, n_, b).transpose().eval();
      }

      /// Of what is seen.
      SymmetricEigen decompose() const
      {
        return base::symmetric_eigen(seen_.topLeftCorner(n_, n_));
      }

      /// ‖A v - λ v‖ of the eigenvector in column k.
      double residual(const SymmetricEigen &eigen, Index k) const
      {
        return (coupling_ * eigen.vectors.col(k).tail(block())).norm();
      }

      /// Keep the best eigenvectors alone, the largest first.
      void restart(const SymmetricEigen &eigen, Index n_kept)
      {
        constexpr Index strip = 1024; // rows at a time, to spare memory
        const MatrixXd best = eigen.vectors.rightCols(n_kept).rowwise().reverse();
        for (Index row = 0; row < vectors_.rows(); row += strip)
        {
          auto rows = vectors_.middleRows(row, std::min(strip, vectors_.rows() - row));
          rows.leftCols(n_kept) = (rows.leftCols(n_) * best).eval();
        }
        seen_.setZero();
        seen_.diagonal().head(n_kept) = eigen.values.tail(n_kept).reverse();
        n_ = n_kept;
      }

      double entry(Index row, Index k) const { return vectors_(row, k); }

    private:
      /// Make next_ the basis' share, which is returned, plus Q · coupling_, and Q of it. Twice is
      /// enough: the second time takes off what rounding left, or the share of columns of chance.
      MatrixXd orthonormalise_next()
      {
        const auto basis = vectors_.leftCols(n_);
        coupling_.setIdentity();
        MatrixXd share = MatrixXd::Zero(n_, block());
        double size = next_.colwise().norm().maxCoeff();
        for (int round = 0; round < 2; ++round)
        {
          const MatrixXd part = basis.transpose() * next_;
          next_.noalias() -= basis * part;
          share += part * coupling_;
          split_next(size);
          size = 1;
        }
        return share;
      }

      /// next_ = Q R by Gram & Schmidt, each column twice; leaves Q and multiplies coupling_ by R.
      /// Where a column lies in the span of those before or of the basis, Q has one of chance.
      /// @param size  of the columns before the basis' share was taken off
      void split_next(double size)
      {
        constexpr double nothing = 1e-14; // rounding of a product, relative to it
        MatrixXd triangle = MatrixXd::Zero(block(), block());
        for (Index j = 0; j < block(); ++j)
        {
          triangle.col(j).head(j) = remove_columns_before(j);
          triangle(j, j) = next_.col(j).norm();
          if (triangle(j, j) <= nothing * size)
          {
            triangle(j, j) = 0;
            for (double &entry : next_.col(j))
              entry = numbers_.normal();
            remove_columns_before(j);
          }
          next_.col(j).normalize();
        }
        coupling_ = triangle * coupling_;
      }

      VectorXd remove_columns_before(Index j)
      {
        VectorXd sum = VectorXd::Zero(j);
        for (int round = 0; round < 2; ++round)
        {
          const VectorXd part = next_.leftCols(j).transpose() * next_.col(j);
          next_.col(j).noalias() -= next_.leftCols(j) * part;
          sum += part;
        }
        return sum;
      }

      Generator numbers_{20'221'122}; ///< any seed serves
      MatrixXd vectors_;              ///< its first n_ columns
      MatrixXd seen_;                 ///< vectors_ᵀ A vectors_
      MatrixXd next_;                 ///< the next block
      MatrixXd coupling_; ///< A vectors_ - vectors_ seen_ = next_ coupling_ in its last columns
      Index n_ = 0;
    };

    /// Of the vectors that span an eigenspace, those that do not depend on rounding: all but the
    /// first vanish where they are largest together, all but the second where the rest is, and so
    /// on.
    void fix_basis(std::vector<double> *vectors, Index n_vectors)
    {
      const auto size = static_cast<Index>(vectors->size());
      MatrixXd space(size, n_vectors);
      for (Index k = 0; k < n_vectors; ++k)
        space.col(k) = VectorXd::Map(vectors[k].data(), size);
      for (Index k = 0; k + 1 < n_vectors; ++k)
      {
        auto rest = space.rightCols(n_vectors - k);
        const VectorXd lengths = rest.rowwise().norm();
        const double largest = lengths.maxCoeff();
        Index row = 0; // symmetric places are as large but for rounding
        while (lengths[row] < .75 * largest)
          ++row;
        const VectorXd there = rest.row(row).transpose();
        const Eigen::HouseholderQR<MatrixXd> turn(there);
        rest = (rest * turn.householderQ()).eval();
      }
      for (Index k = 0; k < n_vectors; ++k)
        VectorXd::Map(vectors[k].data(), size) = space.col(k);
    }

    void fix_bases(LargestModes &modes)
    {
      const std::size_t n = modes.eigenvalue.size();
      for (std::size_t first = 0, end = 0; first < n; first = end)
      {
        // as alike as they are known, but no noise
        const double alike = std::min(1e-12 * modes.eigenvalue[0], 1e-6 * modes.eigenvalue[first]);
        double residual = 0;
        for (;
             end == first || (end < n && modes.eigenvalue[first] - modes.eigenvalue[end] <= alike);
             ++end)
          residual = std::hypot(residual, modes.residual[end]);
        if (end - first > 1)
          fix_basis(&modes.vector[first], static_cast<Index>(end - first));
        for (std::size_t k = first; k < end; ++k)
          modes.residual[k] = residual;
      }
    }

    void fix_sign(std::vector<double> &vector)
    {
      double largest = 0;
      for (const double entry : vector)
        largest = std::max(largest, std::abs(entry));
      // half: modes that are odd have their largest modulus twice, with either sign
      const auto first =
          std::find_if(vector.begin(), vector.end(),
                       [largest](double entry) { return std::abs(entry) >= largest / 2; });
      if (*first < 0)
        for (double &entry : vector)
          entry = -entry;
    }

    LargestModes dense_modes(Index size, const BlockProduct &product, Index n_modes)
    {
      const MatrixXd identity = MatrixXd::Identity(size, size);
      MatrixXd matrix(size, size);
      product(identity.data(), matrix.data(), static_cast<unsigned int>(size));
      if (!matrix.allFinite())
        throw NumericalError("the modes of a random field: a covariance is not a finite number");
      const SymmetricEigen eigen = base::symmetric_eigen((matrix + matrix.transpose()) / 2);
      LargestModes modes;
      for (Index k = 0; k < n_modes; ++k)
      {
        const VectorXd vector = eigen.vectors.col(size - 1 - k);
        modes.eigenvalue.push_back(eigen.values[size - 1 - k]);
        modes.vector.emplace_back(vector.begin(), vector.end());
        modes.residual.push_back((matrix * vector - modes.eigenvalue.back() * vector).norm());
      }
      modes.n_products = 1;
      modes.sum_so_far.push_back(eigen.values.tail(n_modes).sum());
      modes.is_settled = true;
      return modes;
    }

    LargestModes lanczos_modes(Index size, Index room, const BlockProduct &product,
                               const ModeSearch &search)
    {
      const Index n_modes = search.n_modes;
      Basis basis(size, room, search.block);
      LargestModes modes;
      for (;;)
      {
        basis.grow(product);
        ++modes.n_products;
        if (basis.n() < n_modes)
          continue;
        const SymmetricEigen eigen = basis.decompose();
        const Index last = basis.n() - 1;
        const double most = search.tolerance * eigen.values[last];
        modes.sum_so_far.push_back(eigen.values.tail(n_modes).sum());
        modes.residual.clear();
        for (Index k = 0; k < n_modes; ++k)
          modes.residual.push_back(basis.residual(eigen, last - k));
        modes.is_settled = *std::max_element(modes.residual.begin(), modes.residual.end()) <= most;
        if (modes.is_settled || modes.n_products >= search.most_products)
        {
          basis.restart(eigen, n_modes);
          for (Index k = 0; k < n_modes; ++k)
          {
            modes.eigenvalue.push_back(eigen.values[last - k]);
            auto &vector = modes.vector.emplace_back(static_cast<std::size_t>(size));
            for (Index row = 0; row < size; ++row)
              vector[static_cast<std::size_t>(row)] = basis.entry(row, k);
          }
          return modes;
        }
        if (basis.n() + basis.block() > room)
          basis.restart(eigen, n_modes + basis.block());
      }
    }
  } // namespace

  LargestModes largest_modes(std::size_t size, const BlockProduct &product,
                             const ModeSearch &search)
  {
    Assert(search.n_modes >= 1 && search.n_modes <= size && search.block >= 1,
           dealii::ExcInternalError());
    const std::size_t room = 2 * search.n_modes + 6 * search.block;
    base::require_memory(8. * static_cast<double>(std::min(size, room + search.block)) *
                             static_cast<double>(size),
                         std::to_string(search.n_modes) + " modes of a random field at " +
                             std::to_string(size) + " nodes",
                         "ask for fewer modes, or choose a coarser grid");
    constexpr std::size_t worth_a_basis = 2; // of its size the matrix has rows
    LargestModes modes =
        size <= worth_a_basis * room
            ? dense_modes(static_cast<Index>(size), product, search.n_modes)
            : lanczos_modes(static_cast<Index>(size), static_cast<Index>(room), product, search);
    fix_bases(modes);
    for (std::vector<double> &vector : modes.vector)
      fix_sign(vector);
    return modes;
  }
} // namespace plumbline::uq
