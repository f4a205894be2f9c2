#include "method/mass_root.h"

#include "base/error.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::method
{
  namespace
  {
    using State = MassRoot::State;

    State values(const Eigen::MatrixXd &x)
    {
      return {x.data(), x.data() + x.size()};
    }

    Eigen::SparseMatrix<double> to_matrix(const algebra::CsrMatrix &rows)
    {
      const auto n = static_cast<Eigen::Index>(rows.n_rows());
      std::vector<Eigen::Triplet<double>> entries;
      for (std::size_t i = 0; i < rows.n_rows(); ++i)
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          entries.emplace_back(static_cast<int>(i), static_cast<int>(rows.column[k]),
                               rows.value[k]);
      Eigen::SparseMatrix<double> matrix(n, n);
      matrix.setFromTriplets(entries.begin(), entries.end());
      return matrix;
    }
  } // namespace

  struct MassRoot::Factor
  {
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> permuted;
    unsigned int n_blocks;

    const Eigen::SparseMatrix<double> &lower() const
    {
      return permuted.matrixL().nestedExpression();
    }

    /// Shape (n, n_blocks).
    Eigen::Map<const Eigen::MatrixXd> view(const State &x) const
    {
      return {x.data(), permuted.rows(), static_cast<Eigen::Index>(n_blocks)};
    }
  };

  /// S = √factor L⊗L⊗L, T = L Lᵀ with L bidiagonal.
  struct MassRoot::Product
  {
    /// Of one axis: L_ii and L_(i+1)i.
    struct Axis
    {
      std::size_t n, stride;
      std::vector<double> diagonal, below;
    };

    explicit Product(const ProductMass &mass) : root(std::sqrt(mass.factor))
    {
      std::size_t stride = 1;
      for (const int n : mass.n)
      {
        Axis axis{static_cast<std::size_t>(n), stride, {}, {}};
        double before = 0;
        for (int i = 0; i < n; ++i)
        {
          axis.diagonal.push_back(std::sqrt(1 - before * before));
          before = mass.off / axis.diagonal.back();
          axis.below.push_back(before);
        }
        axes.push_back(std::move(axis));
        stride *= n;
      }
    }

    /// line(axis, x) along all lines of all axes.
    template <class Line>
    State along_lines(State x, const Line &line) const
    {
      for (const Axis &axis : axes)
        for (std::size_t outer = 0; outer < x.size(); outer += axis.stride * axis.n)
          for (std::size_t inner = 0; inner < axis.stride; ++inner)
            line(axis, x.data() + outer + inner);
      return x;
    }

    State scaled(State x, double factor) const
    {
      for (double &value : x)
        value *= factor;
      return x;
    }

    double root;
    std::vector<Axis> axes;
  };

  MassRoot::MassRoot(const ProductMass &mass) : product_(std::make_unique<Product>(mass)) {}

  MassRoot::MassRoot(std::vector<double> masses) : roots_(std::move(masses))
  {
    for (double &root : roots_)
      root = std::sqrt(root);
    is_one_ = std::all_of(roots_.begin(), roots_.end(), [](double root) { return root == 1; });
  }

  MassRoot::MassRoot(const algebra::CsrMatrix &block, unsigned int n_blocks)
      : factor_(std::make_unique<Factor>())
  {
    factor_->n_blocks = n_blocks;
    factor_->permuted.compute(to_matrix(block));
    if (factor_->permuted.info() != Eigen::Success)
      throw NumericalError("the mass matrix is not positive definite");
  }

  MassRoot::MassRoot(MassRoot &&) noexcept = default;
  MassRoot::~MassRoot() = default;

  State MassRoot::to_state(const State &u) const
  {
    if (factor_)
      return values(factor_->lower().transpose() *
                    (factor_->permuted.permutationP() * factor_->view(u)));
    if (product_)
      return product_->scaled(
          product_->along_lines(u,
                                [](const Product::Axis &axis, double *x)
                                {
                                  for (std::size_t i = 0; i < axis.n; ++i, x += axis.stride)
                                    *x = axis.diagonal[i] * *x +
                                         (i + 1 < axis.n ? axis.below[i] * x[axis.stride] : 0);
                                }),
          product_->root);
    State x = u;
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] *= roots_[i];
    return x;
  }

  State MassRoot::to_unknowns(const State &x) const
  {
    if (factor_)
      return values(
          factor_->permuted.permutationPinv() *
          factor_->lower().transpose().triangularView<Eigen::Upper>().solve(factor_->view(x)));
    if (product_)
      return product_->scaled(product_->along_lines(x,
                                                    [](const Product::Axis &axis, double *x)
                                                    {
                                                      double after = 0;
                                                      for (std::size_t i = axis.n; i-- > 0;)
                                                      {
                                                        double &value = x[i * axis.stride];
                                                        value = (value - axis.below[i] * after) /
                                                                axis.diagonal[i];
                                                        after = value;
                                                      }
                                                    }),
                              1 / product_->root);
    return of_force(x);
  }

  State MassRoot::of_force(const State &f) const
  {
    if (factor_)
      return values(factor_->lower().triangularView<Eigen::Lower>().solve(
          factor_->permuted.permutationP() * factor_->view(f)));
    if (product_)
      return product_->scaled(product_->along_lines(f,
                                                    [](const Product::Axis &axis, double *x)
                                                    {
                                                      double before = 0;
                                                      for (std::size_t i = 0; i < axis.n;
                                                           ++i, x += axis.stride)
                                                      {
                                                        *x = (*x - before) / axis.diagonal[i];
                                                        before = axis.below[i] * *x;
                                                      }
                                                    }),
                              1 / product_->root);
    State x = f;
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] /= roots_[i];
    return x;
  }
} // namespace plumbline::method
