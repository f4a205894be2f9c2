#include "reference/tetrahedra/plane_sums.h"

#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    constexpr std::size_t n_rules = GaussRules<double>::n_rules;
  } // namespace

  PlaneSums::PlaneSums(const std::vector<PotentialPart<double>> &parts) : parts_(parts)
  {
    for (const PotentialPart<double> &part : parts)
      forms_.push_back(part.compact_form());
    if (parts.size() == 1)
    {
      forms_.push_back(parts.front().regular_form(true));
      forms_.push_back(parts.front().regular_form(false));
    }
    pieces_.resize(forms_.size() * n_rules);
    for (unsigned int k = 0; k < waiting_.size(); ++k)
    {
      waiting_[k].n_sides = k < 2 ? 3 : 4;
      waiting_[k].is_compact = k % 2 == 1;
    }
  }

  PlaneSums::Waiting &PlaneSums::waiting(bool is_parallelogram, bool is_compact)
  {
    return waiting_[(is_parallelogram ? 2 : 0) + (is_compact ? 1 : 0)];
  }

  void PlaneSums::add_parallelogram(const Point &w, const Point &a, const Point &b, bool is_compact,
                                    SharedSum &to)
  {
    add(waiting(true, is_compact), {w, a, b}, {}, to);
  }

  void PlaneSums::add_triangle(const std::array<Point, 3> &corners, const Point &normal,
                               bool is_compact, SharedSum &to)
  {
    add(waiting(false, is_compact), corners, normal, to);
  }

  void PlaneSums::add(Waiting &waiting, const std::array<Point, 3> &x, const Point &normal,
                      SharedSum &to)
  {
    const unsigned int lane = waiting.n++;
    PlaneLanes &planes = waiting.planes;
    for (unsigned int k = 0; k < 3; ++k)
    {
      planes.x[k][0][lane] = x[k].x;
      planes.x[k][1][lane] = x[k].y;
      planes.x[k][2][lane] = x[k].z;
    }
    planes.normal[0][lane] = normal.x;
    planes.normal[1][lane] = normal.y;
    planes.normal[2][lane] = normal.z;
    planes.area[lane] = 1;
    waiting.to[lane] = &to;
    if (waiting.n == n_lanes)
      measure(waiting);
  }

  void PlaneSums::measure(Waiting &waiting)
  {
    if (waiting.n_sides == 3)
      measure_triangles(waiting.planes);
    else
      measure_parallelograms(waiting.planes);
    if (waiting.is_compact)
      for (std::size_t part = 0; part < parts_.size(); ++part)
      {
        clip(waiting.planes, waiting.n_sides, parts_[part].end());
        add_compact(waiting, part);
      }
    else
      add_regular(waiting);
    waiting.n = 0;
  }

  void PlaneSums::add_compact(const Waiting &waiting, std::size_t part)
  {
    const PlaneLanes &planes = waiting.planes;
    static const double turn = 2 * M_PI;
    for (unsigned int lane = 0; lane < waiting.n; ++lane)
    {
      const double distance = planes.distance[lane], height = distance * distance;
      if (!(distance < parts_[part].end()))
        continue;
      bool is_inside = true, is_slow = false;
      for (unsigned int k = 0; k < waiting.n_sides; ++k)
      {
        const double kappa = planes.kappa[k][lane];
        is_inside = is_inside && kappa >= 0;
        const bool is_empty = !(planes.low[k][lane] < planes.high[k][lane]);
        const double length = planes.high[k][lane] - planes.low[k][lane];
        is_slow =
            is_slow || kappa == 0 ||
            (!is_empty && rules_.must_cut(planes.axis[k][lane], parts_[part].extra_points(length)));
      }
      if (is_slow)
      {
        add_slowly(waiting, lane, part);
        continue;
      }
      const double factor = 1 / planes.area[lane];
      for (unsigned int k = 0; k < waiting.n_sides; ++k)
        if (planes.low[k][lane] < planes.high[k][lane])
        {
          const Range piece = {planes.kappa[k][lane], height, planes.low[k][lane],
                               planes.high[k][lane]};
          add_piece(part, piece, planes.axis[k][lane],
                    parts_[part].extra_points(piece.to - piece.from), 0, factor, *waiting.to[lane]);
          add_to(*waiting.to[lane], 0, false,
                 factor * parts_[part].size_of_piece(piece.kappa, piece.from, piece.to, height));
        }
      if (is_inside)
      {
        double foot = 0;
        parts_[part].add_compact(&height, 0, &foot, distance > 0 ? 1 : 0);
        add_to(*waiting.to[lane], -foot * turn * factor, false,
               factor * turn * parts_[part].size_of_compact(distance));
      }
    }
  }

  void PlaneSums::add_slowly(const Waiting &waiting, unsigned int lane, std::size_t part)
  {
    const PlaneLanes &planes = waiting.planes;
    std::array<PlaneSide<double>, 4> sides;
    for (unsigned int k = 0; k < waiting.n_sides; ++k)
      sides[k] = {planes.kappa[k][lane], planes.from[k][lane], planes.to[k][lane]};
    const PlaneIntegral<double> plane(sides, waiting.n_sides, planes.distance[lane]);
    const Sum<double> sum = waiting.is_compact
                                ? plane.compact(parts_[part])
                                : plane.regular(RadialFunction<double>(parts_, plane.distance()));
    SharedSum &to = *waiting.to[lane];
    to.value += sum.value / planes.area[lane];
    to.size += static_cast<float>(sum.size / planes.area[lane]);
  }

  void PlaneSums::add_regular(const Waiting &waiting)
  {
    const PlaneLanes &planes = waiting.planes;
    for (unsigned int lane = 0; lane < waiting.n; ++lane)
    {
      if (parts_.size() > 1)
      {
        add_slowly(waiting, lane, 0);
        continue;
      }
      const double distance = planes.distance[lane];
      const double foot = RadialFunction<double>(parts_, distance).at_foot();
      for (unsigned int k = 0; k < waiting.n_sides; ++k)
        if (planes.kappa[k][lane] != 0)
          add_regular_side({planes.kappa[k][lane], distance * distance, planes.from[k][lane],
                            planes.to[k][lane]},
                           foot, 1 / planes.area[lane], *waiting.to[lane]);
    }
  }

  void PlaneSums::add_regular_side(const Range &side, double foot, double factor, SharedSum &to)
  {
    const double eta = side.kappa * side.kappa + side.height,
                 square = parts_.front().end() * parts_.front().end() - eta,
                 reach = square > 0 ? std::sqrt(square) : 0;
    constexpr unsigned int most_depth = 60;
    const auto add = [&](double from, double end, unsigned int depth, const auto &again) -> void
    {
      if (!(from < end))
        return;
      const double axis =
          (std::sqrt(from * from + eta) + std::sqrt(end * end + eta)) / (end - from);
      const unsigned int extra = parts_.front().extra_points(end - from);
      if (rules_.must_cut(axis, extra) && depth < most_depth)
      {
        const double cut = from < 0 && end > 0 ? 0 : (from + end) / 2;
        again(from, cut, depth + 1, again);
        again(cut, end, depth + 1, again);
        return;
      }
      const bool is_inside = std::abs(from + end) < 2 * reach;
      add_piece(is_inside ? 1 : 2, {side.kappa, side.height, from, end}, axis, extra, foot, factor,
                to);
    };
    double from = side.from;
    for (const double cut : {-reach, reach})
      if (cut > from && cut < side.to)
      {
        add(from, cut, 0, add);
        from = cut;
      }
    add(from, side.to, 0, add);
  }

  void PlaneSums::add_piece(std::size_t form, const Range &piece, double axis, unsigned int extra,
                            double foot, double factor, SharedSum &to)
  {
    const std::size_t rule = rules_.number_for_ellipse(axis, extra);
    Pieces &pieces = pieces_[form * n_rules + rule];
    const double half = (piece.to - piece.from) / 2;
    pieces.pieces[pieces.n++] = {
        piece.kappa * piece.kappa,   piece.height, (piece.from + piece.to) / 2, half, foot,
        factor * half * piece.kappa, &to};
    if (pieces.n == Pieces::most)
      sum(form, rule);
  }

  void PlaneSums::sum(std::size_t form, std::size_t rule)
  {
    Pieces &pieces = pieces_[form * n_rules + rule];
    const auto &gauss = rules_.rule(rule);
    PieceLanes lanes{};
    for (unsigned int first = 0; first < pieces.n; first += n_lanes)
    {
      const unsigned int n = std::min(n_lanes, pieces.n - first);
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        const Piece &piece = pieces.pieces[first + std::min(lane, n - 1)];
        lanes.square[lane] = piece.square;
        lanes.height[lane] = piece.height;
        lanes.centre[lane] = piece.centre;
        lanes.half[lane] = piece.half;
        lanes.foot[lane] = piece.foot;
      }
      sum_pieces(forms_[form], gauss.points.data(), gauss.weights.data(), gauss.n, lanes);
      for (unsigned int lane = 0; lane < n; ++lane)
      {
        const Piece &piece = pieces.pieces[first + lane];
        add_to(*piece.to, piece.factor * lanes.total[lane], form >= parts_.size());
      }
    }
    pieces.n = 0;
  }

  void PlaneSums::add_to(SharedSum &to, double term, bool is_regular, double of_series) const
  {
    to.value += term;
    to.size +=
        static_cast<float>(std::abs(term) * (is_regular ? parts_.front().growth() : 1) + of_series);
  }

  void PlaneSums::finish()
  {
    for (Waiting &waiting : waiting_)
      if (waiting.n > 0)
        measure(waiting);
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      if (pieces_[k].n > 0)
        sum(k / n_rules, k % n_rules);
  }
} // namespace plumbline::reference
