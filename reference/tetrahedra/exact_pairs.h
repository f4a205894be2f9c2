#pragma once

#include "reference/tetrahedra/face_pairs.h"

#include <memory>

namespace plumbline::reference
{
  /// A triangle among many, with the numbers by which shared values are found.
  struct NumberedFace
  {
    const PairFace *face = nullptr;
    std::array<unsigned int, 3> edges{}; ///< from vertex k to vertex k + 1
    unsigned int number = 0;
  };

  /// ∬_{F×G} f(|x - y|) of a FacePotential f in closed form except for integrals along lines,
  /// which Gauss rules give to round-off: see PairForm. Each sum carries a bound of its round-off.
  /// Where that exceeds a tolerance, since edges are nearly parallel to the other plane, the same
  /// is done in long double, and then with 124 and 237 bits. Exactly parallel edges and planes have
  /// a form of their own.
  class ExactPairs
  {
  public:
    /// @param tolerance  of one integral's round-off [1]
    ExactPairs(const PotentialKernel &kernel, FacePotential::Kind kind, double tolerance);
    ~ExactPairs();

    struct Integral
    {
      double value = 0;
      double error = 0;       ///< a bound in practice of its round-off
      unsigned int level = 0; ///< 0: double, 1: long double, 2: 124 bits, 3: 237
    };

    /// Values that pairs share for the same two edges, or a vertex and a face. Not thread safe.
    class Shared
    {
    public:
      Shared();
      ~Shared();
      Shared(Shared &&) noexcept;

      /// For pairs of some faces, the first of each pair, with others.
      void start(const std::vector<const NumberedFace *> &first,
                 const std::vector<const NumberedFace *> &second);

    private:
      friend class ExactPairs;
      struct Tables;
      std::unique_ptr<Tables> tables_;
    };

    /// @param f, g  of those that `shared` was started with; it forgets some values as f changes
    Integral operator()(const NumberedFace &f, const NumberedFace &g, Shared &shared) const;

    /// result[k] is that of f and others[k]: faster, since many are integrated at a time.
    void operator()(const NumberedFace &f, const std::vector<const NumberedFace *> &others,
                    Shared &shared, std::vector<Integral> &result) const;

    /// Without shared values.
    Integral operator()(const PairFace &f, const PairFace &g) const;

    /// With 237 bits, in general position, too.
    double precise(const PairFace &f, const PairFace &g) const;

  private:
    class Batch;

    /// With more digits than double has.
    template <class Real>
    class Mixed;

    Integral refined(const NumberedFace &f, const NumberedFace &g, bool is_compact,
                     Shared &shared) const;
    /// With more digits than long double has.
    template <class Face, class Values>
    Integral precise_enough(const Face &f, const Face &g, bool is_compact, Values &values) const;

    struct Parts;
    std::unique_ptr<const Parts> parts_;
    double tolerance_;
  };
} // namespace plumbline::reference
