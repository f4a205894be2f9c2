#include "reference/strip/strip_space.h"

#include <map>
#include <tuple>

namespace plumbline::reference
{
  StripSpace::StripSpace(const method::RiceStrip &strip, int reach, const AxisShapes &shapes)
      : strip_(strip), reach_(reach), n_(shapes.n_local() * shapes.n_local())
  {
    const unsigned int n_axis = shapes.n_local();
    const bool is_continuous = shapes.is_continuous();
    const int per_cell = static_cast<int>(is_continuous ? shapes.degree() : n_axis),
              middle = strip.n_height / 2;
    std::map<std::tuple<int, int, bool>, unsigned int> known; // by place, and side of the crack
    visit_all(
        [&](const Place &cell)
        {
          for (unsigned int k = 0; k < n_; ++k)
          {
            const int a = static_cast<int>(k % n_axis), b = static_cast<int>(k / n_axis);
            const int x = cell.column * per_cell + a, y = cell.row * per_cell + b;
            const bool is_upper = cell.row >= middle;
            const bool is_split =
                is_continuous && y == middle * per_cell && x < strip.n_crack * per_cell;
            const auto [at, is_new] = known.try_emplace({x, y, is_split && is_upper},
                                                        static_cast<unsigned int>(known.size()));
            functions_.push_back(at->second);
            if (!is_new)
              continue;
            support_.emplace_back(cell.column + shapes.support_point(a),
                                  cell.row + shapes.support_point(b));
            is_upper_.push_back(is_upper);
            is_free_.push_back(is_continuous ? x > 0 && x < strip.n_length * per_cell && y > 0 &&
                                                   y < strip.n_height * per_cell
                                             : is_inside(cell));
          }
        });
  }
} // namespace plumbline::reference
