#pragma once

#include "reference/tetrahedra/face_pairs.h"

#include <array>
#include <optional>

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
} // namespace plumbline::reference
