#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

/// What stands in gmsh's .msh files.
namespace plumbline::geometry::msh
{
  // types of elements

  inline constexpr long triangle = 2, quadrilateral = 3, tetrahedron = 4, hexahedron = 5;
  /// Of second, third and fourth order: corners, then points on the sides, then inner ones.
  struct HighTriangle
  {
    long type = 0;
    unsigned int n_on_side = 0, n_inside = 0;
  };
  inline constexpr std::array high_triangles = {HighTriangle{9, 1, 0}, HighTriangle{21, 2, 1},
                                                HighTriangle{23, 3, 3}};
  inline constexpr std::array points_and_lines = {1L,  8L,  15L, 26L, 27L, 28L,
                                                  62L, 63L, 64L, 65L, 66L};
  inline constexpr std::array other_surfaces = {9L,  10L, 16L, 20L, 21L, 22L, 23L, 24L, 25L,
                                                36L, 37L, 38L, 39L, 40L, 41L, 42L, 43L, 44L,
                                                45L, 46L, 47L, 48L, 49L, 50L, 51L};

  // of first order, then of second order with all points, and without inner ones
  inline constexpr std::array prisms = {6L, 13L, 18L}, pyramids = {7L, 14L, 19L};
  inline constexpr std::array other_hexahedra = {12L, 17L};
  inline constexpr std::array other_tetrahedra = {11L, 29L, 30L, 31L, 32L, 33L, 71L, 72L,
                                                  73L, 74L, 75L, 79L, 80L, 81L, 82L, 83L};
  template <std::size_t n>
  bool is_one_of(const std::array<long, n> &types, long type)
  {
    return std::find(types.begin(), types.end(), type) != types.end();
  }

  /// Null: it is no triangle of higher order.
  inline const HighTriangle *find_high(long type)
  {
    const auto found = std::find_if(high_triangles.begin(), high_triangles.end(),
                                    [type](const HighTriangle &t) { return t.type == type; });
    return found == high_triangles.end() ? nullptr : &*found;
  }

  inline bool is_surface(long type)
  {
    return type == triangle || type == quadrilateral || is_one_of(other_surfaces, type);
  }

  /// Of a volume, and no tetrahedron or hexahedron of first order.
  inline bool is_other_volume(long type)
  {
    constexpr long first_high = 90, last_high = 125; // prisms, hexahedra and pyramids
    return is_one_of(other_hexahedra, type) || is_one_of(prisms, type) ||
           is_one_of(pyramids, type) || is_one_of(other_tetrahedra, type) ||
           (type >= first_high && type <= last_high);
  }

  /// " (prisms)"; of other cells than those of low order empty.
  inline std::string volume_name(long type)
  {
    return is_one_of(other_hexahedra, type)    ? " (hexahedra of higher order)"
           : is_one_of(prisms, type)           ? " (prisms)"
           : is_one_of(pyramids, type)         ? " (pyramids)"
           : is_one_of(other_tetrahedra, type) ? " (tetrahedra of higher order)"
                                               : "";
  }

  struct Cell
  {
    long group = 0, entity = 0, type = 0;
    std::array<unsigned int, 8> vertex{}; ///< as many as its type has
  };
} // namespace plumbline::geometry::msh
