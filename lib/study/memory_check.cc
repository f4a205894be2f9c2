#include "algebra/multiplier_system.h"
#include "base/error.h"
#include "base/memory.h"
#include "geometry/polygon.h"
#include "scene/mesh.h"
#include "scene/mesh_in_space.h"
#include "scene/on_line.h"
#include "study/energy.h"
#include "study/memory_estimate.h"
#include "study/motion_estimate.h"
#include "study/preflight.h"
#include "study/reference_estimate.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::study
{
  namespace
  {
    /// What does not depend on cells.
    method::ProblemSize size_of(const scene::Scene &scene, const problem::Level &level)
    {
      method::ProblemSize size;
      size.level = level;
      size.n_components = scene.n_components();
      size.is_body = scene.domain.is_free_body;
      size.has_factors = !scene.kernel.materials.empty();
      size.has_dilatation = scene.has_dilatation();
      return size;
    }

    method::ProblemSize lattice_size(const scene::Scene &scene, const problem::Level &level)
    {
      method::ProblemSize size = size_of(scene, level);
      if (scene.domain.is_in_space())
      {
        const geometry::CubeLattice lattice = scene.domain.cubes(level.h);
        const auto &n = lattice.n_cells();
        size.extents = {static_cast<double>(n[0]), static_cast<double>(n[1])};
        size.depth = n[2];
        size.is_box = lattice.is_box();
        size.is_scattered = !scene.methods.nodes.are_lattice_centres();
        return size;
      }
      const auto n = scene.domain.lattice(level.h).n_cells();
      size.extents = {static_cast<double>(n[0]), is_on_intervals(scene) ? 0 : double(n[1])};
      return size;
    }

    bool is_on_line(const method::ProblemSize &size)
    {
      return size.is_lattice() && size.extents[1] == 0;
    }

    /// A banded factor, and vectors, of at most so many unknowns a cell as the method's order.
    double bytes_on_line(const Method &method, const method::ProblemSize &size)
    {
      constexpr double n_vectors = 40;
      const double of_cell =
                       method.family() == method::MethodFamily::reference ? method.order() : 1,
                   band = (size.reach() / size.level.h + 2) * of_cell;
      return sizeof(double) * size.extents[0] * of_cell * (band + n_vectors);
    }

    method::ProblemSize mesh_size(const scene::Scene &scene, const geometry::Mesh &mesh,
                                  const problem::Level &level)
    {
      if (!mesh.wholes.empty())
        return mesh_size(scene, geometry::straightened(mesh), level);
      method::ProblemSize size = size_of(scene, level);
      size.n_cells = static_cast<double>(mesh.cells.size());
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      {
        size.n_free += mesh.cells[cell].is_inside ? 1 : 0;
        size.cell_area += geometry::area(geometry::view(mesh.polygon(cell)));
      }
      size.cell_area /= std::max(1., size.n_cells);
      return size;
    }

    /// Of tetrahedra, as six of each cube of the same volume, or of hexahedra.
    method::ProblemSize mesh_size_in_space(const scene::Scene &scene, const problem::Level &level)
    {
      const auto mesh = make_mesh_in_space(scene, level);
      const double n_tetrahedra = mesh->hexahedra.empty() ? 1 : geometry::n_in_hexahedron, // a cell
          n_in_cube = geometry::n_in_hexahedron / n_tetrahedra;
      method::ProblemSize size = size_of(scene, level);
      double volume = 0;
      for (std::size_t cell = 0; cell < mesh->cells.size(); ++cell)
        volume += geometry::determinant(*mesh, cell) / 6;
      size.n_cells = static_cast<double>(mesh->cells.size()) / n_tetrahedra;
      for (const char is_inside : mesh->is_inside)
        size.n_free += is_inside != 0 ? 1 / n_tetrahedra : 0;
      size.level.h = std::cbrt(n_in_cube * volume / size.n_cells);
      size.depth = std::cbrt(size.n_free / n_in_cube);
      size.extents = {size.depth, size.depth};
      size.is_scattered = true;
      return size;
    }

    /// The same of nodes at the centroids of the cells.
    method::ProblemSize of_centroids(method::ProblemSize size)
    {
      const double finer = std::cbrt(size.n_free) / size.depth;
      size.level.h /= finer;
      size.depth *= finer;
      size.extents = {size.depth, size.depth};
      return size;
    }

    /// The same body in cells of another size.
    method::ProblemSize at_level(method::ProblemSize size, const problem::Level &level)
    {
      const double finer = std::pow(size.level.h / level.h, 2);
      const double of_cells = size.depth > 0 ? std::pow(finer, 1.5) : finer;
      size.level = level;
      for (double &extent : size.extents)
        extent *= std::sqrt(finer);
      size.depth *= std::sqrt(finer);
      size.n_cells *= of_cells;
      size.n_free *= of_cells;
      size.cell_area /= finer;
      return size;
    }

    /// Processes that run a scene at once.
    struct Processes
    {
      unsigned int n_jobs;  ///< that do the same, see base::require_memory
      unsigned int n_ranks; ///< that share what is distributed
    };

    bool is_on_mesh(const method::ProblemSize &size)
    {
      return !size.is_lattice() && size.depth == 0 && size.n_cells > 0;
    }

    /// Whether ranks share the rows of a mesh: all but those of local methods, and by rules those
    /// of free bodies and of dilatations that are unknowns.
    bool is_shared_on_mesh(const scene::Scene &scene, const Method &method,
                           const method::ProblemSize &size)
    {
      if (!is_on_mesh(size))
        return false;
      if (method.family() == method::MethodFamily::meshfree)
        return !size.is_body && !scene.solver.is_mixed;
      return method.family() == method::MethodFamily::reference;
    }

    /// What one of several ranks has of rows: its share, and while a Galerkin matrix is assembled
    /// half the rows within reach of its share, a square. Cells stay whole.
    method::ProblemSize of_rank_on_mesh(method::ProblemSize size, const Method &method,
                                        unsigned int n_ranks)
    {
      const double share = size.n_free / n_ranks;
      const double halo = method.family() == method::MethodFamily::reference
                              ? 2 * size.reach() * std::sqrt(share / size.cell_area)
                              : 0;
      size.n_free = std::min(size.n_free, share + halo);
      return size;
    }

    /// @param is_shared  by ranks
    /// @param more       bytes, besides those of a static solution
    MemoryEstimate estimate(const Method &method, const method::ProblemSize &size,
                            const std::string &what, unsigned int n_ranks, bool is_shared,
                            double more)
    {
      method::ProblemSize of_rank = size;
      if (is_shared && is_on_mesh(size))
      {
        constexpr double of_node = 1000; // of its cell, also where expected_bytes() has it by rows
        of_rank = of_rank_on_mesh(size, method, n_ranks);
        if (method.family() == method::MethodFamily::meshfree)
          more += of_node * (size.n_free - of_rank.n_free);
      }
      else if (is_shared)
      {
        constexpr double of_masks = 4; // which cells are in Ω, and which nodes are free
        if (!size.is_box)
          more += of_masks * size.extents[0] * size.extents[1] * size.depth;
        of_rank.depth = std::ceil(size.depth / n_ranks);
      }
      std::ostringstream text;
      text << what << method.name() << " at h = " << size.level.h
           << ", horizon = " << size.level.horizon << " (";
      if (is_on_line(size))
        text << size.extents[0] << " cells)";
      else if (size.is_lattice() && size.n_cells == 0)
        text << size.extents[0] << " x " << size.extents[1]
             << (size.depth > 0 ? " x " + std::to_string(std::lround(size.depth)) : "")
             << " cells)";
      else
        text << "some " << std::round(size.n_cells) << " cells)";
      if (is_shared)
        text << " on each of " << n_ranks << " ranks";
      if (is_on_line(size))
        return {text.str(), bytes_on_line(method, size) + more};
      const bool is_of_centroids =
          size.depth > 0 && size.n_cells > 0 && method.family() == method::MethodFamily::meshfree;
      return {text.str(),
              method.expected_bytes(is_of_centroids ? of_centroids(of_rank) : of_rank) + more};
    }

    /// Of the solver for nearly incompressible solids, see algebra::make_box_system. It is chosen
    /// by the coupling of the stencil, which differs by up to 15 % from that of the constants at m
    /// = 3.
    double multiplier_bytes(const scene::Scene &scene, const Method &method,
                            const method::ProblemSize &size)
    {
      constexpr double margin = .8, rounding = 1e-9;
      if (!size.is_box || !size.has_dilatation || !scene.material.is_homogeneous ||
          !method.is_distributed_in_space(size))
        return 0;
      const physics::Lame lame = scene.material.lame()({});
      if (lame.lambda + 2 * lame.mu < margin * algebra::strong_coupling * lame.mu)
        return 0;
      const auto cells = [](double extent) { return static_cast<int>(std::lround(extent)); };
      // dilatations reach two horizons, shape functions a cell more
      const double m = size.level.horizon / size.level.h;
      const int more = method.family() == method::MethodFamily::reference ? 1 : 0,
                least = 2 * static_cast<int>(std::floor(m + rounding)) + more,
                most = 2 * static_cast<int>(std::ceil(m - rounding)) + more;
      return algebra::expected_multiplier_bytes(
          size.n_components, {cells(size.extents[0]), cells(size.extents[1]), cells(size.depth)},
          least, most);
    }

    /// In slabs.
    bool is_shared(const scene::Scene &scene, const Method &method, const method::ProblemSize &size)
    {
      return method.is_distributed_in_space(size) &&
             (scene.time.is_dynamic() ? is_motion_shared(scene, method)
                                      : !has_energy(scene.study.norms));
    }

    MemoryEstimate estimate_solution(const scene::Scene &scene, const Method &method,
                                     const method::ProblemSize &size, const std::string &what,
                                     unsigned int n_ranks)
    {
      const bool is_of_all =
          n_ranks > 1 && (is_shared(scene, method, size) || is_shared_on_mesh(scene, method, size));
      return estimate(method, size, what, n_ranks, is_of_all,
                      is_of_all ? 0 : multiplier_bytes(scene, method, size));
    }

    void require(const MemoryEstimate &estimate, unsigned int n_jobs)
    {
      base::require_memory(estimate.bytes, estimate.what,
                           "choose a larger h or a smaller horizon (Study/h, Study/m, "
                           "Study/horizon), run the first levels only (--levels), or leave this "
                           "method out (--methods)",
                           n_jobs);
    }

    /// Of a solution, and of what an estimate of its error solves besides.
    std::vector<MemoryEstimate> estimate_all(const scene::Scene &scene, const Method &method,
                                             const method::ProblemSize &size, unsigned int n_ranks)
    {
      std::vector<MemoryEstimate> found = {estimate_solution(scene, method, size, "", n_ranks)};
      if (!is_estimated(scene, method) && (method.name() != scene.reference.method ||
                                           scene.reference.estimate == scene::Estimate::none))
        return found;
      const std::string what = "the estimate of the error of ";
      if (size.is_lattice() || method.name() == scene.reference.method)
        found.push_back(estimate_solution(
            scene, method, at_level(size, {size.level.h / 2, size.level.horizon}), what, n_ranks));
      if (const auto higher = method.higher_degree();
          higher && size.is_lattice() && !scene.domain.is_in_space())
        found.push_back(estimate_solution(scene, *higher, size, what, n_ranks));
      return found;
    }

    /// Of a level, measured: the coarsest one, from which that of finer ones
    /// follows.
    method::ProblemSize measured_size(const scene::Scene &scene, const problem::Level &level)
    {
      if (scene.domain.is_in_space() && scene.domain.mesh.is_file())
        return mesh_size_in_space(scene, level);
      if (scene.domain.is_free_body)
        return mesh_size(scene, *scene::make_body(scene, level).mesh, level);
      return scene.domain.mesh.is_lattice()
                 ? lattice_size(scene, level)
                 : mesh_size(scene, scene::make_mesh(scene, level), level);
    }

    /// Whether the cells of a mesh are fewer where h is larger.
    bool follows_h(const scene::Scene &scene, const method::ProblemSize &coarse)
    {
      if (!scene.domain.mesh.is_file())
        return true;
      if (scene.domain.mesh.is_msh())
        return false;
      return measured_size(scene, {coarse.level.h / 2, coarse.level.horizon}).n_cells >
             1.5 * coarse.n_cells;
    }

    method::ProblemSize of_same_cells(method::ProblemSize size, const problem::Level &level)
    {
      size.level = level;
      return size;
    }

    /// The first error of a method that does not fit.
    void require_all(const scene::Scene &scene, const Methods &methods,
                     const method::ProblemSize &size, const Processes &processes)
    {
      for (const auto &method : methods)
        for (const MemoryEstimate &one : estimate_all(scene, *method, size, processes.n_ranks))
          require(one, processes.n_jobs);
    }

    MemoryEstimate estimate_motion(const scene::Scene &scene, const Method &method,
                                   const problem::Level &level, unsigned int n_ranks)
    {
      // states, energies and nodes; load, constraint and solution at Chebyshev's
      // points in time
      constexpr double n_states = 15, n_points = 33;
      const double n_vectors = n_states + (scene.is_steady() ? 3 : 3 * n_points);
      const method::ProblemSize size = scene.domain.is_in_space() && scene.domain.mesh.is_file()
                                           ? mesh_size_in_space(scene, level)
                                           : lattice_size(scene, level);
      const bool is_of_all = n_ranks > 1 && is_shared(scene, method, size);
      const double n_unknowns = size.n_components * size.extents[0] * size.extents[1] *
                                std::ceil(size.depth / (is_of_all ? n_ranks : 1));
      return estimate(method, size, "transient analysis by ", n_ranks, is_of_all,
                      sizeof(double) * n_vectors * n_unknowns);
    }

    std::size_t n_run(const problem::Series &series, unsigned int n_levels)
    {
      return n_levels == 0 ? series.levels.size()
                           : std::min<std::size_t>(n_levels, series.levels.size());
    }
  } // namespace

  void check_memory(const scene::Scene &scene, const Methods &methods, const Methods &available,
                    unsigned int n_levels, unsigned int n_jobs, unsigned int n_ranks)
  {
    Methods all = methods;
    const method::ProblemSize coarse =
        measured_size(scene, scene.study.series.front().levels.front());
    if (scene.reference.method)
    {
      const auto reference = find_method(available, *scene.reference.method, "Reference/method");
      if (scene.reference.h == 0)
        all.push_back(reference);
      else
        for (const auto &series : scene.study.series)
          require_all(scene, {reference},
                      at_level(coarse, {scene.reference.h, series.levels.front().horizon}),
                      {n_jobs, n_ranks});
    }
    for (const auto &series : scene.study.series)
      for (std::size_t i = 0; i < n_run(series, n_levels); ++i)
        try
        {
          require_all(scene, all, at_level(coarse, series.levels[i]), {n_jobs, n_ranks});
        }
        catch (const InputError &)
        {
          if (follows_h(scene, coarse))
            throw;
          require_all(scene, all, of_same_cells(coarse, series.levels[i]), {n_jobs, n_ranks});
        }
  }

  Methods repeated_by_ranks(const scene::Scene &scene, const Methods &methods)
  {
    if (!scene.domain.mesh.is_lattice())
      return methods;
    const method::ProblemSize size = lattice_size(scene, scene.study.series.front().levels.front());
    Methods repeated;
    std::copy_if(methods.begin(), methods.end(), std::back_inserter(repeated),
                 [&](const auto &method) { return !is_shared(scene, *method, size); });
    return repeated;
  }

  void check_memory_of_motion(const scene::Scene &scene, const Methods &methods,
                              unsigned int n_levels, unsigned int n_jobs, unsigned int n_ranks)
  {
    for (const auto &series : scene.study.series)
      for (std::size_t i = 0; i < n_run(series, n_levels); ++i)
        for (const auto &method : methods)
          require(estimate_motion(scene, *method, series.levels[i], n_ranks), n_jobs);
  }

  namespace
  {
    /// The largest one of a level.
    MemoryEstimate estimate_level(const scene::Scene &scene, const Method &method,
                                  const method::ProblemSize &coarse, bool has_same_cells,
                                  const problem::Level &level, unsigned int n_ranks)
    {
      if (scene.time.is_dynamic() && scene.domain.is_in_space())
        return estimate_motion(scene, method, level, n_ranks);
      const auto all = estimate_all(
          scene, method, has_same_cells ? of_same_cells(coarse, level) : at_level(coarse, level),
          n_ranks);
      return *std::max_element(all.begin(), all.end(),
                               [](const MemoryEstimate &a, const MemoryEstimate &b)
                               { return a.bytes < b.bytes; });
    }
  } // namespace

  std::vector<MemoryOfLevel> estimate_memory(const scene::Scene &scene, const Methods &methods,
                                             unsigned int n_levels, unsigned int n_ranks)
  {
    const method::ProblemSize coarse =
        measured_size(scene, scene.study.series.front().levels.front());
    const bool has_same_cells = scene.domain.mesh.is_file() && !follows_h(scene, coarse);
    std::vector<MemoryOfLevel> found;
    for (const auto &method : methods)
      for (const auto &series : scene.study.series)
        for (std::size_t i = 0; i < n_run(series, n_levels); ++i)
          found.push_back(
              {method->name(), series.name, series.levels[i],
               estimate_level(scene, *method, coarse, has_same_cells, series.levels[i], n_ranks)});
    return found;
  }
} // namespace plumbline::study
