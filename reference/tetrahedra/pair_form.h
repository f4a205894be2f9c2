#pragma once

#include "reference/tetrahedra/plane_integrals.h"

namespace plumbline::reference
{
  /// A triangle of a pair, as its partner's plane sees it.
  template <class Real>
  struct FormFace
  {
    std::array<Vector<Real>, 3> x;
    std::array<unsigned int, 3> names{}; ///< of vertices
    std::array<unsigned int, 3> edges{}; ///< numbers, k -> k + 1
    unsigned int number = 0;
    Vector<Real> normal; ///< of length 1, edges k -> k + 1 counter-clockwise about it
    std::array<Real, 3> length{}, height{},
        along{}; ///< of edges; of vertices: over the other plane, along the axis
    std::array<Real, 3> rise{},
        beta{}; ///< of edges: of the heights; where they meet the other plane
    std::array<bool, 3> is_parallel{}; ///< the edge to the other plane

    static unsigned int next(unsigned int k) { return (k + 1) % 3; }
    Vector<Real> edge(unsigned int k) const { return x[next(k)] - x[k]; }

    /// The distance of the edge's line from a point of the plane, > 0 on its inner side.
    Real distance(unsigned int k, const Vector<Real> &from) const
    {
      return edge(k).cross(normal).dot(x[k] - from) / length[k];
    }

    void measure()
    {
      const Vector<Real> area = edge(0).cross(edge(1));
      normal = area * (1 / area.norm());
      for (unsigned int k = 0; k < 3; ++k)
        length[k] = edge(k).norm();
    }

    /// The point of the plane nearest to another.
    Vector<Real> project(const Vector<Real> &p) const { return p - normal * normal.dot(p - x[0]); }

    void look_at(const FormFace &other, const Vector<Real> &axis, const Vector<Real> &middle,
                 double rounding)
    {
      using std::abs;
      // heights over a vertex that both have, if there is one
      unsigned int base = 0;
      for (unsigned int k = 0; k < 3; ++k)
        if (shares(other.names[k]))
          base = k;
      for (unsigned int k = 0; k < 3; ++k)
      {
        height[k] = other.shares(names[k]) ? Real(0) : other.normal.dot(x[k] - other.x[base]);
        along[k] = axis.dot(x[k] - middle);
      }
      for (unsigned int k = 0; k < 3; ++k)
      {
        rise[k] = height[next(k)] - height[k];
        is_parallel[k] = abs(rise[k]) <= rounding;
        beta[k] = is_parallel[k]
                      ? Real(0)
                      : Real(along[k] - height[k] * ((along[next(k)] - along[k]) / rise[k]));
      }
    }

    bool shares(unsigned int name) const
    {
      return names[0] == name || names[1] == name || names[2] == name;
    }
    bool is_shared_edge(unsigned int k, const FormFace &other) const
    {
      return other.shares(names[k]) && other.shares(names[next(k)]);
    }
    /// Of edges that are not parallel to the other plane.
    Real least_rise() const
    {
      using std::abs;
      Real least = 1;
      for (unsigned int k = 0; k < 3; ++k)
        if (!is_parallel[k])
          least = std::min(least, Real(abs(rise[k])));
      return least;
    }
    bool is_all_parallel() const { return is_parallel[0] && is_parallel[1] && is_parallel[2]; }
  };

  /// Makes edges that are parallel in double precision parallel to all digits, by moving a
  /// vertex of g by a rounding of its coordinates. Faces that are not parallel have at most
  /// one such pair.
  /// @return  whether there is one
  template <class Real>
  bool align(const FormFace<Real> &f, FormFace<Real> &g)
  {
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
      {
        const Vector<Real> a = f.edge(i), b = g.edge(j);
        constexpr double alike = 1e-15;
        if (g.is_shared_edge(j, f) || a.cross(b).norm() > alike * (a.norm() + b.norm()))
          continue;
        const Vector<Real> along = a * (a.dot(b) / a.dot(a));
        const unsigned int end = FormFace<Real>::next(j);
        if (f.shares(g.names[end]))
          g.x[j] = g.x[end] - along;
        else
          g.x[end] = g.x[j] + along;
        return true;
      }
    return false;
  }

  /// ∬_{F×G} f(|x - y|) for a radial potential f = Σ parts, exact. Three times the field of rays
  /// from a point makes an integral one over the boundary: with z = y - x and
  ///   4 g₁ + r g₁' = f,  3 g + r g' = g₁,
  /// f is the divergence of ((x - O) g₁, (y - O) g₁) in F×G, O being any point of the line in which
  /// the two planes meet, so that
  ///   ∬_{F×G} f = Σ_e d(O, e) ∬_{e×G} g₁ + Σ_e' d(O, e') ∬_{F×e'} g₁,
  /// where d is the distance of an edge's line, > 0 from within. In the same way, with the point X
  /// where the line of e meets the plane of G, and l the distance along e,
  ///   ∬_{e×G} g₁ = Σ_e' d(X, e') ∬_{e×e'} g + Σ_{v of e} ± l(X, v) ∫_{v×G} g,
  /// and what is left are integrals over parallelograms and triangles: PlaneIntegral. With
  /// normals n, n', s = |n×n'|, the axis u = n×n'/s, heights h over the other plane, A and β the
  /// rise of h along an edge and where it meets the axis, this is
  ///   s⁻² Σ A A' (β - β')² ∬_{e×e'} g - s⁻¹ Σ h (β_in - β_out) ∫_{v×G} g + s⁻¹ Σ h' (...) ∫_{F×v'}
  ///   g,
  /// sides by their parameters in [0, 1]. An edge parallel to the other plane has no X; there the
  /// field of rays is that of the projection to the plane, and functions of ρ in place of r:
  /// ParallelFunction; the same for parallel planes. No term is singular then. Edges that are
  /// nearly parallel make terms that are large like 1/A and cancel; sizes say how far.
  template <class Real, class Cache>
  class PairForm
  {
  public:
    using Parts = std::vector<PotentialPart<Real>>;
    using Point = Vector<Real>;
    using Face = FormFace<Real>;

    PairForm(const Parts &parts, bool is_compact, Cache &cache)
        : parts_(parts), is_compact_(is_compact), cache_(cache)
    {
    }

    /// @param f  whose vertices have the shared values K(v, G), the other's K(v', F)
    /// @param rounding  of heights
    /// The size is that of terms, as their factors are known, whose heights are rounded themselves.
    Sum<Real> operator()(Face f, Face g, double rounding)
    {
      sum_ = {};
      f.measure();
      g.measure();
      const Point product = f.normal.cross(g.normal);
      const Real sine = product.norm();
      const Point axis = sine > 0 ? product * (1 / sine) : product;
      const Point middle = (f.x[0] + f.x[1] + f.x[2] + g.x[0] + g.x[1] + g.x[2]) * (Real(1) / 6);
      f.look_at(g, axis, middle, rounding);
      g.look_at(f, axis, middle, rounding);
      if (f.is_all_parallel() || g.is_all_parallel())
      {
        add_parallel_planes(f, g);
        return sum_;
      }
      // rises are differences of heights, which have the round-off of the distance; measured
      constexpr double share = 1e-3;
      const Real distance = (f.x[0] - g.x[0]).norm();
      growth_ = 1 + share * distance / std::min(f.least_rise(), g.least_rise());
      const bool has_parallel = has_parallel_edge(f, g) || has_parallel_edge(g, f);
      is_compact_ = is_compact_ && !has_parallel;
      add_edge_pairs(f, g, sine);
      add_vertices(f, g, Real(-1 / sine), false);
      add_vertices(g, f, Real(1 / sine), true);
      if (has_parallel)
      {
        add_parallel_edges(f, g, axis, Real(1 / sine), false);
        add_parallel_edges(g, f, axis, Real(-1 / sine), true);
      }
      sum_.size *= growth_;
      constexpr double least_sine = 1e-3, no_bound = 1e30, certain = 1e-30;
      if (has_parallel && sine < least_sine && rounding > certain)
        sum_.size *= no_bound; // what is taken for parallel ought to be so to more digits
      return sum_;
    }

  private:
    static bool has_parallel_edge(const Face &f, const Face &g)
    {
      for (unsigned int k = 0; k < 3; ++k)
        if (f.is_parallel[k] && !f.is_shared_edge(k, g))
          return true;
      return false;
    }

    Sum<Real> integrate(const PlaneIntegral<Real> &plane) const
    {
      return is_compact_ ? plane.compact(parts_)
                         : plane.regular(RadialFunction<Real>(parts_, plane.distance()));
    }

    /// y - x over two edges.
    struct Parallelogram
    {
      Parallelogram(const Face &f, unsigned int i, const Face &g, unsigned int j)
      {
        const Point a = f.edge(i), b = g.edge(j), w = g.x[j] - f.x[i];
        corners = {w, w + b, w + b - a, w - a};
        normal = a.cross(b);
        area = normal.norm();
        normal = normal * (1 / area);
      }
      std::array<Point, 4> corners;
      Point normal;
      Real area = 0;
    };

    /// @param factor  what it is multiplied by, which tells a cache how exact it has to be
    Sum<Real> edge_pair(const Face &f, unsigned int i, const Face &g, unsigned int j,
                        const Real &factor) const
    {
      const auto make = [&]
      {
        const Parallelogram p(f, i, g, j);
        Sum<Real> result;
        result.add(1 / p.area, integrate({p.corners.data(), 4, p.normal}));
        return result;
      };
      return cache_.edges(f.edges[i], g.edges[j], is_compact_, factor * growth_, make);
    }

    static PlaneIntegral<Real> plane_from(const Point &v, const Face &g)
    {
      const std::array<Point, 3> corners = {g.x[0] - v, g.x[1] - v, g.x[2] - v};
      return {corners.data(), 3, g.normal};
    }

    Sum<Real> vertex_and_face(const Face &f, unsigned int k, const Face &g, bool is_second,
                              const Real &factor) const
    {
      const auto make = [&] { return integrate(plane_from(f.x[k], g)); };
      return is_second
                 ? cache_.second_vertex(f.names[k], is_compact_, factor * growth_, make)
                 : cache_.first_vertex(f.names[k], g.number, is_compact_, factor * growth_, make);
    }

    void add_edge_pairs(const Face &f, const Face &g, const Real &sine)
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
        {
          if (f.is_parallel[i] || g.is_parallel[j])
            continue;
          const Real gap = (f.beta[i] - g.beta[j]) / sine;
          const Real factor = f.rise[i] * g.rise[j] * gap * gap;
          sum_.add(factor, edge_pair(f, i, g, j, factor));
        }
    }

    void add_vertices(const Face &f, const Face &g, const Real &factor, bool is_second)
    {
      for (unsigned int k = 0; k < 3; ++k)
      {
        const unsigned int in = (k + 2) % 3;     // edge k starts at vertex k
        const Real gap = f.beta[in] - f.beta[k]; // β of parallel edges is 0
        if (f.height[k] == 0 || gap == 0)
          continue;
        const Real whole = factor * f.height[k] * gap;
        sum_.add(whole, vertex_and_face(f, k, g, is_second, whole));
      }
    }

    /// All terms of the parallel edges e of f: of ∬_{e×G} g₁, and of ∬_{F×e'} g₁ with edges e' that
    /// are not parallel.
    /// @param factor  d(O, e) = ± factor × height, + if e runs along the axis
    void add_parallel_edges(const Face &f, const Face &g, const Point &axis, const Real &factor,
                            bool is_second)
    {
      for (unsigned int i = 0; i < 3; ++i)
      {
        if (!f.is_parallel[i] || f.is_shared_edge(i, g))
          continue;
        using std::abs;
        const Real height = (f.height[i] + f.height[Face::next(i)]) / 2;
        const Real distance = (f.edge(i).dot(axis) > 0 ? height : Real(-height)) * factor;
        if (abs(height) < flat)
          continue;
        const auto make = [&]
        { return edge_and_face(f, i, g, ParallelFunction<Real>(parts_, abs(height), false)); };
        sum_.add(distance * f.length[i], cache_.parallel(f.edges[i], g.number, make));
        for (unsigned int j = 0; j < 3; ++j)
        {
          if (g.is_parallel[j])
            continue;
          // d(O, e') |e'| is ± β' A'/s, and d(X', e) is d(O, e)
          const Real other = factor * g.beta[j] * g.rise[j];
          const Real whole = other * distance * f.length[i];
          sum_.add(whole, is_second ? edge_pair(g, j, f, i, whole) : edge_pair(f, i, g, j, whole));
        }
      }
    }

    /// 1/|e| × ∬_{e×G} g₁ by rays from the projection of the start of an edge e = i.
    template <class Function>
    Sum<Real> edge_and_face(const Face &f, unsigned int i, const Face &g,
                            const Function &function) const
    {
      const unsigned int end = Face::next(i);
      Sum<Real> sum = plane_from(f.x[end], g).regular(function);
      const Point from = g.project(f.x[i]);
      for (unsigned int j = 0; j < 3; ++j)
      {
        const Real distance = g.distance(j, from);
        if (distance != 0)
          sum.add(distance * g.length[j], edges_by(f, i, g, j, function));
      }
      return sum;
    }

    /// ∬_{e×e'} of a function's g, parameters in [0, 1].
    template <class Function>
    Sum<Real> edges_by(const Face &f, unsigned int i, const Face &g, unsigned int j,
                       const Function &function) const
    {
      constexpr double least_sine = 1e-12;
      const Point a = f.edge(i), b = g.edge(j);
      Sum<Real> result;
      if (a.cross(b).norm() > least_sine * (f.length[i] * g.length[j]))
      {
        const Parallelogram p(f, i, g, j);
        result.add(1 / p.area,
                   PlaneIntegral<Real>(p.corners.data(), 4, p.normal).regular(function));
      }
      else
        add_along(f, i, g, j, function, result);
      return result;
    }

    /// The same of parallel edges: the density of differences is a trapezium.
    template <class Function>
    void add_along(const Face &f, unsigned int i, const Face &g, unsigned int j,
                   const Function &function, Sum<Real> &result) const
    {
      const Point along = f.edge(i) * (1 / f.length[i]), w = g.x[j] - f.x[i];
      const Real start = along.dot(w), step = along.dot(g.edge(j)), &length = f.length[i];
      std::array<Real, 4> knots = {start, start + step, start - length, start + step - length};
      std::sort(knots.begin(), knots.end());
      const Point across = w - along * start;
      // the square of the distance in the plane
      const Real square =
          std::max(Real(0), Real(across.dot(across) - function.distance() * function.distance()));
      const Real top = std::min(length, g.length[j]) / (length * g.length[j]);
      const std::array<Real, 4> heights = {0, top, top, 0};
      for (unsigned int k = 0; k < 3; ++k)
        if (knots[k] < knots[k + 1])
          add_along_piece({knots[k], knots[k + 1]}, {heights[k], heights[k + 1]}, square, function,
                          0, result);
    }

    template <class Function>
    void add_along_piece(const std::array<Real, 2> &at, const std::array<Real, 2> &weights,
                         const Real &square, const Function &function, unsigned int depth,
                         Sum<Real> &result) const
    {
      using std::sqrt;
      constexpr unsigned int most_depth = 60;
      const Real size = at[1] - at[0];
      const Real eta = square + function.distance() * function.distance();
      const Real axis = (sqrt(at[0] * at[0] + eta) + sqrt(at[1] * at[1] + eta)) / size;
      Real cut = at[0] < 0 && at[1] > 0 ? Real(0) : Real((at[0] + at[1]) / 2);
      const unsigned int extra = extra_points(parts_, size);
      bool is_cut = GaussRules<Real>::get().must_cut(static_cast<double>(axis), extra);
      for (const PotentialPart<Real> &part : parts_)
        if (const Real end = part.end() * part.end() - eta; end > 0)
          for (const Real &root : {Real(sqrt(end)), Real(-sqrt(end))})
            if (root > at[0] + size / 100000 && root < at[1] - size / 100000)
            {
              cut = root;
              is_cut = true;
            }
      if (is_cut && depth < most_depth)
      {
        const Real middle = (weights[0] * (at[1] - cut) + weights[1] * (cut - at[0])) / size;
        add_along_piece({at[0], cut}, {weights[0], middle}, square, function, depth + 1, result);
        add_along_piece({cut, at[1]}, {middle, weights[1]}, square, function, depth + 1, result);
        return;
      }
      const auto &rule = GaussRules<Real>::get().for_ellipse(axis, extra);
      for (unsigned int q = 0; q < rule.n; ++q)
      {
        const Real t = (1 + rule.points[q]) / 2, tau = at[0] + size * t;
        result.add(rule.weights[q] / 2 * size * (weights[0] + (weights[1] - weights[0]) * t) *
                   function.density(square + tau * tau));
      }
    }

    void add_parallel_planes(const Face &f, const Face &g)
    {
      using std::abs;
      Real height = 0;
      bool is_same = false;
      for (unsigned int k = 0; k < 3; ++k)
      {
        height += f.height[k] / 3;
        is_same = is_same || g.shares(f.names[k]);
      }
      if (is_same || abs(height) < flat)
        add_planes(f, g, RadialFunction<Real>(parts_, Real(0)));
      else
        add_planes(f, g, ParallelFunction<Real>(parts_, abs(height), true));
    }

    template <class Function>
    void add_planes(const Face &f, const Face &g, const Function &function)
    {
      const Point centre = (f.x[0] + f.x[1] + f.x[2]) * (Real(1) / 3), foot = g.project(centre);
      const bool is_same_face = f.names == g.names;
      for (unsigned int i = 0; i < 3; ++i)
      {
        sum_.add(f.distance(i, centre) * f.length[i] * (is_same_face ? 2 : 1),
                 edge_and_face(f, i, g, function));
        if (is_same_face)
          continue;
        sum_.add(g.distance(i, foot) * g.length[i], edge_and_face(g, i, f, function));
      }
    }

    static constexpr double flat = 1e-13; ///< a height that is none

    const Parts &parts_;
    bool is_compact_;
    Cache &cache_;
    Sum<Real> sum_;
    Real growth_ = 1; ///< of its size
  };
} // namespace plumbline::reference
