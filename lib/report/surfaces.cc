#include "report/surfaces.h"

#include "report/plot.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace plumbline::report
{
  namespace
  {
    using study::SolutionGrid;

    /// Parts of the range, with viridis at the same parts.
    constexpr std::array<std::pair<double, const char *>, 3> levels = {
        {{.25, "#3b528b"}, {.5, "#21918c"}, {.75, "#5ec962"}}};

    std::string symbol(const SolutionGrid &grid)
    {
      return grid.n_components == 1 ? "u" : "|u|";
    }

    std::string place(const SolutionGrid &grid)
    {
      return grid.problem + (grid.series.empty() ? "" : ", " + grid.series) +
             ", h = " + rounded(grid.h);
    }

    /// f(number, centre) for the cells inside the domain, in the order of `values`.
    template <class F>
    void for_each_cell(const SolutionGrid &grid, const F &f)
    {
      std::size_t i = 0;
      for (unsigned int z = 0; z < grid.n[2]; ++z)
        for (unsigned int y = 0; y < grid.n[1]; ++y)
          for (unsigned int x = 0; x < grid.n[0]; ++x, ++i)
            if (std::isfinite(grid.values[i]))
              f(i,
                dealii::Point<3>(grid.first[0] + x * grid.spacing, grid.first[1] + y * grid.spacing,
                                 grid.first[2] + z * grid.spacing));
    }

    /// Values at the centres of cells, and a mesh of the cubes between eight of them.
    class Interpolant
    {
    public:
      explicit Interpolant(const SolutionGrid &grid) : element_(1)
      {
        constexpr auto outside = std::numeric_limits<unsigned int>::max();
        std::vector<unsigned int> vertex(grid.values.size(), outside);
        std::vector<dealii::Point<3>> centres;
        std::vector<double> values;
        for_each_cell(grid,
                      [&](std::size_t i, const dealii::Point<3> &centre)
                      {
                        vertex[i] = centres.size();
                        centres.push_back(centre);
                        values.push_back(grid.values[i]);
                      });
        std::vector<dealii::CellData<3>> cubes;
        const auto &n = grid.n;
        for (unsigned int z = 0; z + 1 < n[2]; ++z)
          for (unsigned int y = 0; y + 1 < n[1]; ++y)
            for (unsigned int x = 0; x + 1 < n[0]; ++x)
            {
              dealii::CellData<3> cube(8);
              for (unsigned int v = 0; v < 8; ++v)
                cube.vertices[v] = vertex[x + (v & 1) + std::size_t{n[0]} * (y + (v >> 1 & 1)) +
                                          std::size_t{n[0]} * n[1] * (z + (v >> 2))];
              if (std::find(cube.vertices.begin(), cube.vertices.end(), outside) ==
                  cube.vertices.end())
                cubes.push_back(std::move(cube));
            }
        if (cubes.empty())
          return;
        mesh_.create_triangulation(centres, cubes, dealii::SubCellData());
        dofs_.reinit(mesh_);
        dofs_.distribute_dofs(element_);
        nodal_.reinit(dofs_.n_dofs());
        low_ = std::numeric_limits<double>::infinity();
        high_ = -low_;
        for (const auto &cell : dofs_.active_cell_iterators())
          for (const unsigned int v : cell->vertex_indices())
          {
            const double value = values[cell->vertex_index(v)];
            nodal_[cell->vertex_dof_index(v, 0)] = value;
            low_ = std::min(low_, value);
            high_ = std::max(high_, value);
          }
      }

      bool has_surfaces() const
      {
        return high_ - low_ > round_off * std::max(std::abs(low_), std::abs(high_));
      }

      /// The value at this part of the range.
      double level(double part) const { return low_ + part * (high_ - low_); }

      /// Triangles of the surface, each a closed line of gnuplot.
      std::string surface(double value) const
      {
        const dealii::MappingQ1<3> mapping;
        const dealii::GridTools::MarchingCubeAlgorithm<3, dealii::Vector<double>> cubes(mapping,
                                                                                        element_);
        std::vector<dealii::Point<3>> vertices;
        std::vector<dealii::CellData<2>> triangles;
        cubes.process(dofs_, nodal_, value, vertices, triangles);
        std::string text;
        const auto add = [&](unsigned int v)
        {
          for (unsigned int d = 0; d < 3; ++d)
            text += rounded(vertices[v][d]) + (d < 2 ? " " : "\n");
        };
        for (const auto &triangle : triangles)
        {
          for (const unsigned int v : triangle.vertices)
            add(v);
          add(triangle.vertices.front());
          text += "\n\n";
        }
        return text;
      }

    private:
      dealii::Triangulation<3> mesh_;
      dealii::FE_Q<3> element_;
      dealii::DoFHandler<3> dofs_;
      dealii::Vector<double> nodal_;
      double low_ = 0, high_ = 0;
    };
  } // namespace

  std::string surfaces_title(const SolutionGrid &grid)
  {
    return place(grid) + ": isosurfaces of " + symbol(grid) + " computed with " + grid.method;
  }

  std::string surfaces_script(const SolutionGrid &grid, const std::string &file)
  {
    const Interpolant interpolant(grid);
    if (!interpolant.has_surfaces())
      return "";
    std::ostringstream data, plots;
    std::size_t n = 0;
    for (const auto &[part, colour] : levels)
      if (const std::string surface = interpolant.surface(interpolant.level(part));
          !surface.empty())
      {
        data << "$s" << n << " << EOD\n" << surface << "EOD\n";
        plots << (n > 0 ? ", " : "splot ") << "$s" << n << " with polygons fc rgb '" << colour
              << "' notitle, keyentry with lines lw 8 lc rgb '" << colour << "' title "
              << quote_gnuplot(symbol(grid) + " = " + rounded(interpolant.level(part)));
        ++n;
      }
    std::ostringstream out;
    out << "\nreset\n"
        << data.str()
        << "set terminal svg size 820,560 dynamic enhanced font 'sans-serif,14' background "
           "'#ffffff'\nset output "
        << quote_gnuplot(file) << "\nset title " << quote_gnuplot(surfaces_title(grid))
        << " noenhanced font ',15'\nset border 4095 lc rgb '#888888'\n"
           "set tics font ',11' textcolor rgb '#222222'\nset view 62,32,1.25\nset view equal xyz\n"
           "set xyplane at "
        << exact(grid.lower[2]) << "\nset key noenhanced textcolor rgb '#222222'\n"
        << "set pm3d depthorder noborder\nset pm3d lighting primary .35 specular .1\n"
           "set style fill transparent solid .5\n";
    for (unsigned int d = 0; d < 3; ++d)
      out << "set "
          << "xyz"[d] << "range [" << exact(grid.lower[d]) << ":" << exact(grid.upper[d])
          << "]\nset "
          << "xyz"[d] << "label '"
          << "xyz"[d] << " [length]' font ',12'\n";
    out << plots.str() << "\nunset output\n";
    return out.str();
  }

  Table grid_table(const SolutionGrid &grid)
  {
    Table table;
    table.columns = {"method",     "problem",    "series",     "h [length]",
                     "x [length]", "y [length]", "z [length]", symbol(grid)};
    for_each_cell(grid,
                  [&](std::size_t i, const dealii::Point<3> &centre)
                  {
                    table.rows.push_back({text_cell(grid.method), text_cell(grid.problem),
                                          text_cell(grid.series), number_cell(grid.h),
                                          number_cell(centre[0]), number_cell(centre[1]),
                                          number_cell(centre[2]), number_cell(grid.values[i])});
                  });
    return table;
  }
} // namespace plumbline::report
