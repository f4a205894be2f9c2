#pragma once

#include "reference/tetrahedra/face_pairs.h"

#include <array>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace plumbline::reference
{
  /// Places on a lattice of the vertices of two faces, x, y and z of each face's three vertices,
  /// relative to the first vertex: pairs with the same places are translations of each other.
  using FacePlaces = std::array<long, 18>;

  /// Empty: some vertex is not on the lattice.
  /// @param spacing  [horizons]
  std::optional<FacePlaces> places_on_lattice(const PairFace &f, const PairFace &g, double spacing);

  /// Faces at these places, determined by them alone; shared vertices have the same name.
  std::array<PairFace, 2> faces_at(const FacePlaces &places, double spacing);

  /// Values of pairs of faces of a lattice, made once for pairs that are translations of each
  /// other. Thread safe.
  template <class Value>
  class TranslatedPairs
  {
  public:
    /// @param spacing  [horizons]
    explicit TranslatedPairs(double spacing) : spacing_(spacing) {}

    /// The value, and whether it is new.
    /// @param make  takes two faces: by the places alone, so that all threads have the same
    template <class Make>
    std::pair<Value, bool> find(const FacePlaces &places, const Make &make) const
    {
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (const auto found = known_.find(places); found != known_.end())
          return {found->second, false};
      }
      const auto [f, g] = faces_at(places, spacing_);
      const Value made = make(f, g);
      const std::lock_guard<std::mutex> lock(mutex_);
      return {made, known_.try_emplace(places, made).second};
    }

  private:
    double spacing_;
    mutable std::map<FacePlaces, Value> known_;
    mutable std::mutex mutex_;
  };
} // namespace plumbline::reference
