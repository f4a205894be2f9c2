#pragma once

#include "reference/mesh/cell_shapes.h"
#include "reference/mesh/segment.h"

namespace plumbline::reference
{
  /// A polynomial p of a cell, of degree 4 in all at most, on one of its sides, as powers of a
  /// parameter along it: Δ^m p, and the derivative of Δ^m p along the outer normal times the side's
  /// length.
  struct SideTrace
  {
    unsigned int degree = 0;                       ///< of p
    std::array<std::array<double, 5>, 3> value{};  ///< of m, degree - 2 m + 1 coefficients
    std::array<std::array<double, 4>, 2> normal{}; ///< of m, degree - 2 m coefficients
  };

  /// The shape functions of triangles, degree 2 at most, or of parallelograms, degree 1 at most,
  /// and their products on the sides.
  class SideTraces
  {
  public:
    explicit SideTraces(const CellShapes &shapes);

    /// Of a shape function in all of its variables: that of s t on squares is 2.
    static unsigned int total_degree(const CellShapes &shapes)
    {
      return shapes.n_vertices() == 3 ? shapes.degree() : 2 * shapes.degree();
    }

    unsigned int n_functions() const { return static_cast<unsigned int>(functions_.size()); }

    /// The shape functions first, then the products of two, a <= b, by rows.
    /// @param side        runs from vertex `side` to the next one
    /// @param is_forward  so does the parameter, else back
    /// @param normal      outer, as long as the side
    /// @param traces      overwritten, shape (n_functions())
    void find(const CellMap &map, unsigned int side, bool is_forward,
              const dealii::Tensor<1, 2> &normal, std::vector<SideTrace> &traces) const;

    /// The same on a segment anywhere: the polynomials beyond their cell, too. Costs .3 ms.
    /// @param normal  outer, as long as the segment
    void find(const CellMap &map, const Segment &segment, const dealii::Tensor<1, 2> &normal,
              std::vector<SideTrace> &traces) const;

  private:
    static constexpr unsigned int highest = 4;
    /// Coefficients of s^i.
    using Series = std::array<double, highest + 1>;

    struct Function
    {
      unsigned int degree = 0;
      /// On a side, forward and back: of ∂^(a+b)/∂ξ^a ∂η^b in unit coordinates.
      std::vector<std::array<std::array<std::array<Series, highest + 1>, highest + 1>, 2>> sides;
    };
    /// Of ξ^a η^b.
    using Coefficients = std::array<Series, highest + 1>;

    std::vector<Function> functions_;
    std::vector<Coefficients> coefficients_; ///< of the same functions
  };
} // namespace plumbline::reference
