#include "reference/mesh/inclusion_check.h"

#include "reference/mesh/edge_form.h"
#include "reference/mesh/edge_pairs.h"

#include <map>
#include <optional>
#include <random>

namespace plumbline::reference
{
  namespace
  {
    using geometry::PairPosition;
    using geometry::Polygon;
    using geometry::Verdict;

    const Segment &segment(const Segment &side)
    {
      return side;
    }
    const Segment &segment(const Edge &side)
    {
      return side.segment;
    }

    Polygon polygon(const MeshCells &cells, std::size_t cell)
    {
      Polygon result;
      for (const unsigned int vertex : cells.outline(cell))
        result.push_back(cells.vertex(vertex));
      return result;
    }

    /// As PolygonPairs has them.
    std::vector<Segment> sides(const MeshCells &cells, std::size_t cell)
    {
      const std::vector<unsigned int> &outline = cells.outline(cell);
      std::vector<Segment> result;
      for (std::size_t k = 0; k < outline.size(); ++k)
      {
        const auto [first, second] = std::minmax(outline[k], outline[(k + 1) % outline.size()]);
        result.emplace_back(cells.vertex(first), cells.vertex(second));
      }
      return result;
    }

    /// Decisions of assemble_by_edges.
    class EdgeDecisions
    {
    public:
      EdgeDecisions(const MeshSpace &space, const physics::Kernel<2> &kernel)
          : space_(space), form_(space)
      {
        for (const physics::Kernel<2> &part : kernel.parts())
          ways_.emplace_back(space, form_, part);
        for (const Edge &edge : form_.edges)
          index_[std::minmax(edge.node[0], edge.node[1])] = &edge;
      }

      /// What pairs of nodes take a pair of triangles for: both, if they contradict each other.
      std::vector<PairPosition> positions(std::size_t a, std::size_t b, std::size_t part) const
      {
        bool is_inside = false, is_apart = false;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
          {
            const PairPosition position =
                ways_[part].position(space_.dofs(a)[i], space_.dofs(b)[j]);
            is_inside = is_inside || position == PairPosition::inside;
            is_apart = is_apart || position == PairPosition::apart;
          }
        std::vector<PairPosition> taken;
        if (is_inside)
          taken.push_back(PairPosition::inside);
        if (is_apart)
          taken.push_back(PairPosition::apart);
        if (taken.empty())
          taken.push_back(PairPosition::cut);
        return taken;
      }

      std::vector<Edge> sides(std::size_t cell) const
      {
        std::vector<Edge> result;
        const unsigned int *const dof = space_.dofs(cell);
        for (unsigned int k = 0; k < 3; ++k)
          result.push_back(*index_.at(std::minmax(dof[k], dof[(k + 1) % 3])));
        return result;
      }

    private:
      const MeshSpace &space_;
      EdgeForm form_;
      std::vector<PairWays> ways_; ///< of each part of the kernel
      std::map<std::pair<unsigned int, unsigned int>, const Edge *> index_;
    };

    void add(Verdict verdict, InclusionCheck &check)
    {
      ++check.n_decisions;
      check.n_open += verdict == Verdict::open;
      check.n_ties += verdict == Verdict::tie;
      check.n_wrong += verdict == Verdict::wrong;
    }

    Polygon ends(const Segment &e)
    {
      return {e.start, e.end};
    }

    /// Parts of f in circles about the ends of e, and about a point of it.
    void check_parts(const Segment &e, const Segment &f, double horizon, double s,
                     InclusionCheck &check)
    {
      for (const Point<2> &x : {e.start, e.end, e.start + s * e.along})
        add(geometry::judge_part(
                SquaredDistance(f.start - x, f.along).below(horizon * horizon, 0, 1), x, horizon,
                f.start, f.end),
            check);
    }

    template <class Side>
    void check_sides(const std::vector<Side> &of_a, const std::vector<Side> &of_b, double horizon,
                     bool is_cut, std::mt19937 &random, InclusionCheck &check)
    {
      for (const Side &e : of_a)
        for (const Side &f : of_b)
        {
          const Polygon ends_e = ends(segment(e)), ends_f = ends(segment(f));
          add(judge(position(e, f, horizon), geometry::view(ends_e), geometry::view(ends_f),
                    horizon),
              check);
          if (is_cut)
            check_parts(segment(e), segment(f), horizon,
                        static_cast<double>(random()) / std::mt19937::max(), check);
        }
    }
  } // namespace

  InclusionCheck check_inclusions(const MeshSpace &space, const MeshCells &cells,
                                  const physics::Kernel<2> &kernel, Decider decider,
                                  unsigned int n_pairs, unsigned int seed)
  {
    InclusionCheck check;
    const auto parts = kernel.parts();
    std::optional<EdgeDecisions> by_edges;
    if (decider == Decider::edges)
      by_edges.emplace(space, kernel);
    std::mt19937 random(seed);
    std::vector<unsigned int> near;
    for (unsigned int pair = 0; pair < n_pairs; ++pair)
    {
      const std::size_t part = pair % parts.size(), a = random() % cells.size();
      const double horizon = parts[part].horizon();
      cells.find_near(a, horizon + 4 * cells.radius(a), near);
      const std::size_t b = near[random() % near.size()];
      const Polygon of_a = polygon(cells, a), of_b = polygon(cells, b);
      const auto view_a = geometry::view(of_a), view_b = geometry::view(of_b);
      const PairPosition exact = geometry::exact_position(view_a, view_b, horizon);
      ++(exact == PairPosition::inside  ? check.n_inside
         : exact == PairPosition::apart ? check.n_apart
                                        : check.n_cut);
      const bool is_cut = exact == PairPosition::cut;
      if (by_edges)
      {
        for (const PairPosition taken : by_edges->positions(a, b, part))
          add(judge(taken, view_a, view_b, horizon), check);
        check_sides(by_edges->sides(a), by_edges->sides(b), horizon, is_cut, random, check);
        continue;
      }
      add(judge(cells.position(a, b, horizon), view_a, view_b, horizon), check);
      if (!cells.is_rectangle(a) || !cells.is_rectangle(b)) // those by their correlation
        check_sides(sides(cells, a), sides(cells, b), horizon, is_cut, random, check);
    }
    return check;
  }

  std::string InclusionCheck::text() const
  {
    // no counts that differ from level to level: one note for all
    std::string text = std::to_string(n_pairs()) +
                       " pairs of cells, their sides, and parts of sides in circles: inside the "
                       "horizon, cut by it or apart ";
    if (n_wrong > 0)
      return text + "NOT as CGAL's exact predicates say in " + std::to_string(n_wrong) + " of " +
             std::to_string(n_decisions) + " decisions";
    text += "as CGAL's exact predicates say in all of them";
    return n_ties == 0 ? text : text + ", but for ties within 1e-13 of the horizon";
  }
} // namespace plumbline::reference
