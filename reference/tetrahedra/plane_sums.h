#pragma once

#include "reference/tetrahedra/pair_lanes.h"
#include "reference/tetrahedra/plane_integrals.h"

#include <array>
#include <vector>

namespace plumbline::reference
{
  /// A Sum that pairs of faces share.
  struct SharedSum
  {
    double value = 0;
    float size = 0;
    bool is_known = false;
  };

  /// Many PlaneIntegrals in double, several at a time. Sums are complete after finish().
  class PlaneSums
  {
  public:
    using Point = Vector<double>;

    explicit PlaneSums(const std::vector<PotentialPart<double>> &parts);

    /// to += ∫∫ g(|w + t b - s a|) ds dt, s and t in [0, 1]; functions are compact or regular.
    void add_parallelogram(const Point &w, const Point &a, const Point &b, bool is_compact,
                           SharedSum &to);
    /// to += ∫ g over a triangle, corners counter-clockwise about the normal.
    void add_triangle(const std::array<Point, 3> &corners, const Point &normal, bool is_compact,
                      SharedSum &to);
    void finish();

  private:
    /// Planes that wait for others of their kind.
    struct Waiting
    {
      unsigned int n_sides = 0;
      bool is_compact = false;
      unsigned int n = 0;
      PlaneLanes planes{};
      std::array<SharedSum *, n_lanes> to{};
    };
    struct Piece
    {
      double square = 0, height = 0, centre = 0, half = 0, foot = 0, factor = 0;
      SharedSum *to = nullptr;
    };
    /// Pieces of one form and one Gauss rule.
    struct Pieces
    {
      static constexpr unsigned int most = 64;
      unsigned int n = 0;
      std::array<Piece, most> pieces;
    };
    /// A side, or a piece of it.
    struct Range
    {
      double kappa = 0, height = 0, from = 0, to = 0;
    };

    Waiting &waiting(bool is_parallelogram, bool is_compact);
    void add(Waiting &waiting, const std::array<Point, 3> &x, const Point &normal, SharedSum &to);
    void measure(Waiting &waiting);
    void add_compact(const Waiting &waiting, std::size_t part);
    void add_regular(const Waiting &waiting);
    void add_slowly(const Waiting &waiting, unsigned int lane, std::size_t part);
    void add_regular_side(const Range &side, double foot, double factor, SharedSum &to);
    void add_piece(std::size_t form, const Range &piece, double axis, unsigned int extra,
                   double foot, double factor, SharedSum &to);
    void sum(std::size_t form, std::size_t rule);
    /// to += term, with the round-off of values of regular functions, or of compact ones.
    void add_to(SharedSum &to, double term, bool is_regular, double of_series = 0) const;

    const std::vector<PotentialPart<double>> &parts_;
    const GaussRules<double> &rules_ = GaussRules<double>::get();
    std::vector<PieceForm> forms_; ///< compact ones, by parts; inside and outside of a single part
    std::vector<Pieces> pieces_;   ///< by forms and rules
    std::array<Waiting, 4> waiting_;
  };
} // namespace plumbline::reference
