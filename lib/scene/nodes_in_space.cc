#include "scene/nodes_in_space.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "scene/values.h"

#include <filesystem>

namespace plumbline::scene
{
  namespace
  {
    void check_memory(double n_nodes, const Level &level)
    {
      constexpr double of_node = 8000; // with its cell and what methods find of it [bytes]
      base::require_memory(n_nodes * of_node,
                           "scattered nodes at h = " + base::to_text(level.h, 4) + " (about " +
                               base::to_text(n_nodes, 2) + " nodes)",
                           "choose a larger h (Study/h)");
    }
  } // namespace

  std::vector<dealii::Point<3>> read_nodes_in_space(const std::string &file)
  {
    base::Csv csv(file, {"x", "y", "z"});
    std::vector<dealii::Point<3>> nodes;
    while (csv.next())
      nodes.emplace_back(csv.number("x"), csv.number("y"), csv.number("z"));
    return nodes;
  }

  geometry::NodeCells<3> make_cells_in_space(const Scene &scene, const Level &level,
                                             const geometry::CubeLattice &lattice)
  {
    const NodeSource &source = scene.methods.nodes;
    const bool is_file = source.kind() == NodeKind::file;
    const std::string file = source.file_at(level.h);
    const double reach = scene.reach(level.horizon);
    try
    {
      if (is_file)
      {
        const auto nodes =
            read_nodes_in_space((std::filesystem::path(scene.folder) / file).string());
        check_memory(static_cast<double>(nodes.size()), level);
        return voronoi_cells(nodes, lattice, reach);
      }
      const int n_layers = geometry::layers_for(reach, level.h);
      double n = 1;
      for (const int along : lattice.n_cells())
        n *= along + 2. * n_layers;
      check_memory(n, level);
      return voronoi_cells(
          lattice_nodes(lattice, n_layers, source.perturbation, scene.geometry.seed), lattice,
          reach);
    }
    catch (const InputError &error)
    {
      throw InputError("Methods/nodes = " + (is_file ? file : source.name) +
                       ", h = " + base::to_text(level.h, 4) + ": " + error.what() +
                       (is_file ? " (nodes are counted from 0)" : ""));
    }
  }
} // namespace plumbline::scene
