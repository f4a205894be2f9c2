#include "method/mass_root.h"

#include "base/error.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
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

  namespace
  {
    /// The factor T = L Lᵀ along an axis: L_ii and L_(i+1)i.
    struct Factors
    {
      std::vector<double> diagonal, below;
    };

    Factors factors(int n, double off)
    {
      Factors of;
      double before = 0;
      for (int i = 0; i < n; ++i)
      {
        of.diagonal.push_back(std::sqrt(1 - before * before));
        before = off / of.diagonal.back();
        of.below.push_back(before);
      }
      return of;
    }

    /// What L and Lᵀ do to a line, a value each `stride`: entries [first, first + n) of theirs, the
    /// others being 0.
    struct Line
    {
      const Factors &of;
      std::size_t first, n, stride;

      /// Lᵀ x. @param next  the value after the line
      void multiply(double *x, double next) const
      {
        for (std::size_t i = 0; i < n; ++i, x += stride)
          *x = of.diagonal[first + i] * *x + of.below[first + i] * (i + 1 < n ? x[stride] : next);
      }

      /// L⁻¹ x
      void solve_lower(double *x) const
      {
        double before = 0;
        for (std::size_t i = 0; i < n; ++i, x += stride)
        {
          *x = (*x - before) / of.diagonal[first + i];
          before = of.below[first + i] * *x;
        }
      }

      /// Lᵀ⁻¹ x
      void solve_upper(double *x) const
      {
        double after = 0;
        for (std::size_t i = n; i-- > 0;)
        {
          double &value = x[i * stride];
          value = (value - of.below[first + i] * after) / of.diagonal[first + i];
          after = value;
        }
      }
    };

    /// L⁻¹ and Lᵀ⁻¹ along lines through the slabs of all ranks. A slab is linear in the plane
    /// beside it: it is the result with 0 there, plus a factor of each plane times that plane. So
    /// each rank needs the ends of slabs before it, as far as products of factors are not lost in
    /// rounding.
    class Passing
    {
    public:
      /// @param is_lower  L⁻¹, in the order of planes, else against it
      Passing(const base::Slabs &slabs, const Factors &factors, bool is_lower)
          : slabs_(slabs), ends_(slabs.ranks(), static_cast<int>(slabs.ranks().n_ranks())),
            own_(static_cast<int>(slabs.ranks().rank())), is_lower_(is_lower)
      {
        for (int i = 0; i < slabs.n_planes(); ++i)
        {
          const int before = is_lower ? i - 1 : i;
          of_plane_.push_back(before < 0 ? 0 : -factors.below[before] / factors.diagonal[i]);
        }
        for (unsigned int rank = 0; rank < slabs.ranks().n_ranks(); ++rank)
        {
          const auto [first, second] = slabs.owned(rank);
          of_rank_.push_back(std::accumulate(of_plane_.begin() + first, of_plane_.begin() + second,
                                             1., std::multiplies<>()));
        }
      }

      /// @param x    the result with 0 beside the slab, shape (n_components, n_owned, plane_size)
      /// @param end  its plane that others are beside, shape (n_components, plane_size)
      void complete(State &x, const std::vector<double> &end, std::size_t plane_size) const
      {
        const std::vector<double> beside = plane_beside(end);
        const int n = slabs_.n_owned();
        const auto of_component = static_cast<std::size_t>(n) * plane_size;
        double factor = 1;
        for (int i = 0; i < n && std::abs(factor) > rounding; ++i)
        {
          const int plane = is_lower_ ? i : n - 1 - i;
          factor *= of_plane_[slabs_.owned().first + plane];
          for (std::size_t c = 0; c * of_component < x.size(); ++c)
            for (std::size_t k = 0; k < plane_size; ++k)
              x[c * of_component + plane * plane_size + k] += factor * beside[c * plane_size + k];
        }
      }

    private:
      static constexpr double rounding = 1e-20; ///< of a value, and less

      /// The plane of the result beside this rank's slab.
      std::vector<double> plane_beside(const std::vector<double> &end) const
      {
        const std::vector<double> ends =
            ends_.fetch(end, end.size(),
                        [this](unsigned int rank) -> base::Slabs::Range
                        {
                          const int to = static_cast<int>(rank), n = n_needed(to);
                          return is_lower_ ? base::Slabs::Range{to - n, to}
                                           : base::Slabs::Range{to + 1, to + 1 + n};
                        });
        std::vector<double> plane(end.size());
        const int n = n_needed(own_);
        for (int k = n; k >= 1; --k) // from the farthest
        {
          const double factor = of_rank_[is_lower_ ? own_ - k : own_ + k];
          const double *const there = ends.data() + (is_lower_ ? n - k : k - 1) * end.size();
          for (std::size_t i = 0; i < plane.size(); ++i)
            plane[i] = there[i] + factor * plane[i];
        }
        return plane;
      }

      /// Slabs before a rank's whose ends count.
      int n_needed(int rank) const
      {
        const int n_ranks = ends_.n_planes(), step = is_lower_ ? -1 : 1;
        double factor = 1;
        int n = 0;
        for (int other = rank + step; other >= 0 && other < n_ranks && std::abs(factor) > rounding;
             other += step, ++n)
          factor *= of_rank_[other];
        return n;
      }

      base::Slabs slabs_, ends_; ///< an end of each rank
      int own_;                  ///< rank
      bool is_lower_;
      std::vector<double> of_plane_, of_rank_; ///< by how much the plane before counts
    };
  } // namespace

  /// S = √factor L⊗L⊗L, T = L Lᵀ with L bidiagonal.
  struct MassRoot::Product
  {
    Product(const ProductMass &mass, const base::Slabs &slabs_of_planes)
        : root(std::sqrt(mass.factor)), n(mass.n), n_components(mass.n_components),
          slabs(slabs_of_planes)
    {
      for (unsigned int d = 0; d < 3; ++d)
        axes[d] = factors(n[d], mass.off);
      n[2] = slabs.n_owned();
      if (is_shared())
        for (const bool is_lower : {false, true})
          passing.emplace_back(slabs, axes[2], is_lower);
    }

    bool is_shared() const { return slabs.ranks().n_ranks() > 1; }
    std::size_t plane_size() const { return static_cast<std::size_t>(n[0]) * n[1]; }

    /// visit(line, x along it, number of the line) for all lines along an axis.
    template <class Visit>
    void along(unsigned int d, State &x, const Visit &visit) const
    {
      const std::size_t stride = d == 0 ? 1 : d == 1 ? n[0] : plane_size(), length = n[d];
      const Line line{axes[d], d == 2 ? static_cast<std::size_t>(slabs.owned().first) : 0, length,
                      stride};
      for (std::size_t outer = 0; outer < x.size(); outer += stride * length)
        for (std::size_t inner = 0; inner < stride; ++inner)
          visit(line, x.data() + outer + inner, outer / length + inner);
    }

    /// The first or last plane of this rank; 0 where it has none.
    std::vector<double> end(const State &x, bool is_last) const
    {
      const std::size_t size = plane_size(), of_component = size * n[2];
      std::vector<double> planes(n_components * size);
      for (unsigned int c = 0; c < n_components && n[2] > 0; ++c)
        std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(c * of_component +
                                                            (is_last ? of_component - size : 0)),
                    size, planes.begin() + static_cast<std::ptrdiff_t>(c * size));
      return planes;
    }

    /// Sᵀ x
    State to_state(State x) const
    {
      for (const unsigned int d : {0u, 1u})
        along(d, x, [](const Line &line, double *value, std::size_t) { line.multiply(value, 0); });
      std::vector<double> next; // plane
      if (is_shared())
        next = base::Slabs(slabs.ranks(), static_cast<int>(slabs.ranks().n_ranks()))
                   .fetch(end(x, false), n_components * plane_size(),
                          [](unsigned int rank) -> base::Slabs::Range {
                            return {static_cast<int>(rank) + 1, static_cast<int>(rank) + 2};
                          });
      along(2, x,
            [&](const Line &line, double *value, std::size_t i)
            { line.multiply(value, next.empty() ? 0 : next[i]); });
      return scaled(std::move(x), root);
    }

    /// S⁻¹ x, or S⁻ᵀ x
    State solve(State x, bool is_lower) const
    {
      for (const unsigned int d : {0u, 1u, 2u})
        along(d, x,
              [&](const Line &line, double *value, std::size_t)
              { is_lower ? line.solve_lower(value) : line.solve_upper(value); });
      if (is_shared())
        passing[is_lower ? 1 : 0].complete(x, end(x, is_lower), plane_size());
      return scaled(std::move(x), 1 / root);
    }

    static State scaled(State x, double factor)
    {
      for (double &value : x)
        value *= factor;
      return x;
    }

    double root;
    std::array<int, 3> n; ///< nodes of this rank
    unsigned int n_components;
    std::array<Factors, 3> axes;
    base::Slabs slabs;
    std::vector<Passing> passing; ///< of Lᵀ⁻¹ and L⁻¹, where slabs are shared
  };

  MassRoot::MassRoot(const ProductMass &mass, const std::optional<base::Slabs> &slabs)
      : product_(std::make_unique<Product>(
            mass, slabs ? *slabs : base::Slabs(base::Communicator::alone(), mass.n[2])))
  {
  }

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
      return product_->to_state(u);
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
      return product_->solve(x, false);
    return of_force(x);
  }

  State MassRoot::of_force(const State &f) const
  {
    if (factor_)
      return values(factor_->lower().triangularView<Eigen::Lower>().solve(
          factor_->permuted.permutationP() * factor_->view(f)));
    if (product_)
      return product_->solve(f, true);
    State x = f;
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] /= roots_[i];
    return x;
  }
} // namespace plumbline::method
