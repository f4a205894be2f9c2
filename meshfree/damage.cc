#include "meshfree/damage.h"

#include "base/error.h"
#include "meshfree/families.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::meshfree
{
  namespace
  {
    /// A bond or a node is at a crack's end, or on it, up to this fraction of the horizon.
    constexpr double touch = 1e-9;
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

    double distance(const Point<2> &x, const Point<2> &first, const Point<2> &last)
    {
      const Tensor<1, 2> d = last - first;
      return x.distance(first + std::clamp((x - first) * d / d.norm_square(), 0., 1.) * d);
    }

    std::vector<geometry::Box> boxes(const std::vector<std::vector<Point<2>>> &cracks)
    {
      std::vector<geometry::Box> result;
      for (const auto &crack : cracks)
        for (std::size_t i = 1; i < crack.size(); ++i)
          result.push_back(geometry::bounding_box({&crack[i - 1], 2}));
      return result;
    }

    [[noreturn]] void refuse(std::size_t crack, const std::string &why)
    {
      throw InputError("crack " + std::to_string(crack) + ' ' + why);
    }
  } // namespace

  BrokenBonds::BrokenBonds(const Damage &damage, const geometry::NodeCells &cells, double horizon)
      : cells_(&cells), is_ghost_(damage.is_ghost), tolerance_(touch * horizon),
        search_(boxes(damage.cracks))
  {
    std::vector<std::size_t> crack_of;
    for (std::size_t c = 0; c < damage.cracks.size(); ++c)
    {
      const auto &crack = damage.cracks[c];
      if (crack.size() < 2)
        refuse(c, "has fewer than two points; give a polyline");
      const bool is_open = crack.front().distance(crack.back()) > tolerance_;
      for (std::size_t i = 1; i < crack.size(); ++i)
      {
        if (!(crack[i - 1].distance(crack[i]) > tolerance_))
          refuse(c, "has its points " + std::to_string(i - 1) + " and " + std::to_string(i) +
                        " in one place; take one of them out");
        segments_.push_back(
            {crack[i - 1], crack[i], is_open && i == 1, is_open && i + 1 == crack.size()});
        crack_of.push_back(c);
      }
    }
    std::vector<unsigned int> near;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      const Point<2> &x = cells.nodes[i];
      std::ostringstream node;
      if (is_ghost(i))
      {
        if (i < cells.n_free)
        {
          node << "node " << cells.source[i] << " at (" << x << ") lies in the domain and is a "
               << "ghost; ghosts belong to the collar";
          throw InputError(node.str());
        }
        continue;
      }
      search_.find(box_around(x, tolerance_), near);
      for (const unsigned int s : near)
        if (distance(x, segments_[s].first, segments_[s].last) <= tolerance_)
        {
          node << "goes through node " << cells.source[i] << " at (" << x << "), so that it is not "
               << "known on which side that is; move the crack by a part of the cell, or the node";
          refuse(crack_of[s], node.str());
        }
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

  bool BrokenBonds::find(std::size_t node, const Family &family, std::vector<char> &is_intact) const
  {
    is_intact.assign(family.bonds.size(), 1);
    if (segments_.empty() && is_ghost_.empty())
      return true;
    const Point<2> &x = cells_->nodes[node];
    double reach = 0;
    for (const Bond &bond : family.bonds)
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

  Remainder remainder(const Kernel<2> &influence, const Family &family,
                      const std::vector<char> &is_intact)
  {
    Tensor<2, 2> shape;
    Tensor<1, 2> inward;
    for (std::size_t k = 0; k < family.bonds.size(); ++k)
      if (is_intact[k] != 0)
      {
        const Bond &bond = family.bonds[k];
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
