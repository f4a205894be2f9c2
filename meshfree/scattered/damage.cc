#include "meshfree/scattered/damage.h"

#include "base/error.h"
#include "meshfree/rules/families.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace plumbline::meshfree
{
  namespace
  {
    /// Sine of the angle below which a bond runs along a crack.
    constexpr double parallel = 1e-9;
    /// Bonds lie on a line if the determinant of Σ K w ξ⊗ξ is below this fraction of its square:
    /// within an angle of 1e-5.
    constexpr double collinear = 1e-10;
    /// Fraction of δ³ below which Σ w ξ is round-off.
    constexpr double no_direction = 1e-8;

    double cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    std::vector<geometry::Box> boxes(const std::vector<std::vector<Point<2>>> &cracks)
    {
      std::vector<geometry::Box> result;
      for (const auto &crack : cracks)
        for (std::size_t i = 1; i < crack.size(); ++i)
          result.push_back(geometry::bounding_box({&crack[i - 1], 2}));
      return result;
    }
  } // namespace

  BrokenBonds::BrokenBonds(const Damage &damage, const geometry::NodeCells<2> &cells,
                           double horizon)
      : cells_(&cells), is_ghost_(damage.is_ghost), tolerance_(geometry::on_crack * horizon),
        search_(boxes(damage.cracks))
  {
    geometry::check_ghosts(is_ghost_, cells);
    geometry::check_cracks(damage.cracks, cells, is_ghost_, horizon);
    for (const geometry::Polyline &crack : damage.cracks)
    {
      const bool is_open = crack.front().distance(crack.back()) > tolerance_;
      for (std::size_t i = 1; i < crack.size(); ++i)
        segments_.push_back(
            {crack[i - 1], crack[i], is_open && i == 1, is_open && i + 1 == crack.size()});
    }
  }

  bool BrokenBonds::crosses(const Segment &segment, const Point<2> &p, const Point<2> &q) const
  {
    const Tensor<1, 2> d = segment.last - segment.first, r = q - p, from = p - segment.first;
    const double area = cross(d, r), length = d.norm();
    if (std::abs(area) <= parallel * length * r.norm())
      return false;
    const double on_bond = cross(from, d) / area, on_segment = cross(from, r) / area * length;
    return on_bond > 0 && on_bond < 1 && on_segment > (segment.begins ? tolerance_ : -tolerance_) &&
           on_segment < length + (segment.ends ? -tolerance_ : tolerance_);
  }

  bool BrokenBonds::find(std::size_t node, const Family<2> &family,
                         std::vector<char> &is_intact) const
  {
    is_intact.assign(family.bonds.size(), 1);
    if (segments_.empty() && is_ghost_.empty())
      return true;
    const Point<2> &x = cells_->nodes[node];
    double reach = 0;
    for (const Bond<2> &bond : family.bonds)
      reach = std::max(reach, bond.xi.norm());
    std::vector<unsigned int> near;
    search_.find(box_around(x, reach), near);
    bool all = true;
    for (std::size_t k = 0; k < family.bonds.size(); ++k)
    {
      const unsigned int j = family.neighbours[k];
      const Point<2> &y = cells_->nodes[j]; // the same answer from both ends
      const Point<2> &p = node < j ? x : y, &q = node < j ? y : x;
      if (is_ghost(j) || std::any_of(near.begin(), near.end(),
                                     [&](unsigned int s) { return crosses(segments_[s], p, q); }))
        is_intact[k] = all = false;
    }
    return all;
  }

  Faces find_faces(const Damage &damage, const geometry::NodeCells<2> &cells, double horizon)
  {
    std::vector<Face> faces = faces_of(damage.cracks);
    const auto is_in_body = [&](const Point<2> &x)
    { return !damage.outside || damage.outside(x) <= 0; };
    std::vector<Point<2>> tips = tips_of(damage.cracks, faces, horizon, 0, is_in_body);
    if (damage.outside && damage.surface_terms == problem::SurfaceTerms::consistent)
    {
      const auto where_it_is = [&](const Point<2> &x) // it need not be defined beyond all nodes
      {
        try
        {
          return damage.outside(x);
        }
        catch (const InputError &)
        {
          return std::numeric_limits<double>::quiet_NaN();
        }
      };
      const geometry::Box all = geometry::bounding_box({cells.nodes.data(), cells.nodes.size()});
      for (const Face &face : zero_line(where_it_is, all, .5 * horizon))
        faces.push_back(face);
    }
    return {std::move(faces), std::move(tips), horizon};
  }

  void check_constrained(const std::vector<char> &is_intact, const geometry::NodeCells<2> &cells,
                         std::size_t node)
  {
    if (std::find(is_intact.begin(), is_intact.end(), 1) != is_intact.end())
      return;
    std::ostringstream message;
    message << "all bonds of node " << cells.source[node] << " at (" << cells.nodes[node]
            << ") are broken, so that nothing holds it; move the crack, or take the node out";
    throw InputError(message.str());
  }

  Remainder remainder(const Kernel<2> &influence, const Family<2> &family,
                      const std::vector<char> &is_intact)
  {
    Tensor<2, 2> shape;
    Tensor<1, 2> inward;
    for (std::size_t k = 0; k < family.bonds.size(); ++k)
      if (is_intact[k] != 0)
      {
        const Bond<2> &bond = family.bonds[k];
        shape += bond.weight * radial_value(influence, bond) * outer_product(bond.xi, bond.xi);
        inward += bond.weight * bond.xi;
      }
    const double square = shape.norm_square(), length = inward.norm();
    Remainder result;
    if (std::abs(determinant(shape)) > collinear * square)
      result.correction = invert(shape);
    else if (square > 0)
      result.correction = shape / square;
    if (length > no_direction * std::pow(influence.horizon(), 3))
      result.normal = -inward / length;
    return result;
  }
} // namespace plumbline::meshfree
