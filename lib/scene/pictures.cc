#include "scene/pictures.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/memory.h"
#include "scene/values.h"

#include <algorithm>
#include <array>
#include <filesystem>

namespace plumbline::scene
{
  using uq::GridField;

  namespace
  {
    std::string size_of(const std::array<int, 2> &n)
    {
      return std::to_string(n[0]) + " x " + std::to_string(n[1]);
    }

    /// From the row along the upper side first to that along the lower side first, as grids have
    /// them.
    std::vector<double> from_below(const base::NumberGrid &grid)
    {
      const auto width = static_cast<std::size_t>(grid.n[0]);
      std::vector<double> values(grid.values.size());
      for (std::size_t from = 0; from < values.size(); from += width)
        std::copy_n(grid.values.begin() + static_cast<std::ptrdiff_t>(from), width,
                    values.end() - static_cast<std::ptrdiff_t>(from + width));
      return values;
    }
  } // namespace

  std::vector<GridField> read_pictures(const std::vector<std::string> &files,
                                       const std::string &folder, const geometry::Box &box)
  {
    std::vector<GridField> pictures;
    for (const std::string &name : files)
    {
      const std::string file = (std::filesystem::path(folder) / name).string();
      const base::NumberGrid grid = base::read_number_grid(file);
      if (pictures.empty())
        base::require_memory(
            8. * static_cast<double>(files.size()) * static_cast<double>(grid.values.size()),
            std::to_string(files.size()) + " files of " + size_of(grid.n) + " numbers",
            "give fewer or smaller ones");
      else
        require(grid.n == pictures.front().grid().n,
                "'" + file + "' has " + size_of(grid.n) + " numbers along x and y, and '" +
                    files.front() + "' has " + size_of(pictures.front().grid().n) +
                    "; all must have one size, mend or take out one of them");
      pictures.emplace_back(uq::Grid{box, grid.n}, from_below(grid), uq::Interpolation::constant);
    }
    return pictures;
  }
} // namespace plumbline::scene
