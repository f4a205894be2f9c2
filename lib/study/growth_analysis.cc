#include "study/growth_analysis.h"

#include "base/cost.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "geometry/crack_tips.h"
#include "method/fracture_solver.h"
#include "physics/crossing_energy.h"
#include "physics/expression.h"
#include "scene/checks.h"
#include "scene/mesh.h"
#include "scene/models/model.h"
#include "scene/origin.h"
#include "scene/problem.h"
#include "study/breaking_analysis.h"
#include "study/sampling.h"
#include "study/seeds.h"
#include "study/strip_growth.h"
#include "study/unseen_features.h"

#include <algorithm>
#include <cmath>

namespace plumbline::study
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    double value_at(const physics::Expression &expression, const Point<2> &x,
                    unsigned int component)
    {
      return expression(x, component);
    }
    double value_at(const physics::Expression &expression, const Point<3> &x,
                    unsigned int component)
    {
      return expression.at(x, component);
    }

    /// What boxes of x and y are in space: through the whole thickness.
    std::vector<geometry::Cuboid> through_thickness(const std::vector<geometry::Box> &boxes,
                                                    const geometry::Solid &solid)
    {
      double lower = solid.include.front().lower[2], upper = solid.include.front().upper[2];
      for (const geometry::Cuboid &one : solid.include)
      {
        lower = std::min(lower, one.lower[2]);
        upper = std::max(upper, one.upper[2]);
      }
      std::vector<geometry::Cuboid> result;
      for (const geometry::Box &box : boxes)
        result.push_back(
            {{box.lower[0], box.lower[1], lower}, {box.upper[0], box.upper[1], upper}});
      return result;
    }

    /// The constants of the solid; of bond tensors those of their local limit.
    std::function<physics::Lame(const Point<2> &)> constants(const scene::Scene &scene)
    {
      if (scene.material.model->is_state_based())
        return scene.material.lame();
      constexpr double any = 1; // horizon: the limit does not depend on it
      const physics::LocalLimit limit =
          scene.domain.is_in_space() ? scene.material.model->kernel_in_space(scene, any).limit()
                                     : scene.material.model->kernel(scene, any).limit();
      return [lame = physics::Lame{limit.mu, limit.mu}](const Point<2> &) { return lame; };
    }

    void set_boxes(const scene::Scene &scene, method::BreakingSolid<2> &solid)
    {
      solid.domain = scene.domain.boxes;
      solid.grips = scene.domain.fixed;
      solid.unbreaking = scene.fracture.unbreaking;
      solid.material = constants(scene);
    }
    void set_boxes(const scene::Scene &scene, method::BreakingSolid<3> &solid)
    {
      solid.domain = scene.domain.solid;
      solid.grips = through_thickness(scene.domain.fixed, solid.domain);
      solid.unbreaking = through_thickness(scene.fracture.unbreaking, solid.domain);
      solid.material = [lame = constants(scene)({})](const Point<3> &) { return lame; };
    }

    /// @param trapping  G is divided by it
    template <int dim>
    method::BreakingSolid<dim> make_solid(const scene::Scene &scene, double horizon,
                                          double trapping)
    {
      method::BreakingSolid<dim> solid;
      set_boxes(scene, solid);
      if constexpr (dim == 2)
        if (!scene.domain.mesh.is_lattice())
        {
          const problem::Level &level = scene.study.series.front().levels.front();
          solid.cells = std::make_shared<const geometry::NodeCells<2>>(
              scene::make_node_cells(scene, level, scene::make_mesh(scene, level)));
        }
      solid.notch = scene.domain.cracks;
      const physics::Expression toughness("Fracture/toughness", scene.fracture.toughness,
                                          scene.names(horizon));
      solid.constrained = [](const Point<dim> &) { return Tensor<1, dim>(); };
      if (!scene.time.is_dynamic())
        solid.constrained =
            [constrained = physics::Expression("Problem/constraint", *scene.problem.constraint,
                                               scene.names(horizon))](const Point<dim> &x)
        {
          Tensor<1, dim> u;
          for (unsigned int d = 0; d < dim; ++d)
            u[d] = value_at(constrained, x, d);
          return u;
        };
      if (!scene.time.is_dynamic() && !scene.problem.loads.empty())
        solid.load =
            [load = physics::Expression("Problem/load", scene.problem.loads.front().expression,
                                        scene.names(horizon))](const Point<dim> &x)
        {
          Tensor<1, dim> b;
          for (unsigned int d = 0; d < dim; ++d)
            b[d] = value_at(load, x, d);
          return b;
        };
      solid.surface_terms = scene.fracture.surface_terms;
      solid.toughness = [toughness](const Point<dim> &x) { return value_at(toughness, x, 0); };
      solid.takes_least_toughness = scene.fracture.of_bonds == problem::BondToughness::minimum;
      for (std::size_t k = 0; k < scene.fracture.interfaces.size(); ++k)
        solid.interfaces.push_back(
            {scene.fracture.interfaces[k], scene.fracture.toughness_of_interface(k)});
      solid.trapping = trapping;
      return solid;
    }

    std::string surface_words(problem::SurfaceTerms terms)
    {
      switch (terms)
      {
      case problem::SurfaceTerms::published:
        return "with surface terms (Fan et al. 2022, eq. (3.19))";
      case problem::SurfaceTerms::consistent:
        return "with consistent surface terms";
      case problem::SurfaceTerms::none:
        return "with corrected dilatations, without surface terms";
      default:
        return "without surface terms";
      }
    }

    /// @param is_bonds  no node has a dilatation
    std::string model_words(const scene::Scene &scene, bool is_bonds)
    {
      if (!scene.material.model->is_state_based())
        return "bond-based: bond tensors";
      if (is_bonds && !scene.fracture.is_corrected())
        return "bond-based: for lambda = mu the dilatation term vanishes";
      return std::string(is_bonds ? "bonds (lambda = mu) " : "LPS ") +
             surface_words(scene.fracture.surface_terms) +
             (scene.material.is_homogeneous ? ""
                                            : ", each node's dilatation with its own constants");
    }

    /// The middle of the body along an axis.
    template <class Box>
    double middle(const std::vector<Box> &boxes, unsigned int axis)
    {
      double lower = boxes.front().lower[axis], upper = lower;
      for (const Box &box : boxes)
      {
        lower = std::min(lower, box.lower[axis]);
        upper = std::max(upper, box.upper[axis]);
      }
      return .5 * (lower + upper);
    }

    /// By what G is to be divided for a crack to go on at G in this lattice: the largest energy,
    /// over G, that one needs in a strip whose height is eight horizons.
    double find_trapping(const scene::Scene &scene, const Method &method,
                         const physics::Kernel<2> &influence, double h)
    {
      const int m = static_cast<int>(std::ceil(influence.horizon() / h - 1e-9)), height = 8 * m;
      const physics::Lame lame = constants(scene)(
          scene.domain.cracks.empty() ? Point<2>(middle(scene.domain.boxes.include, 0),
                                                 middle(scene.domain.boxes.include, 1))
                                      : scene.domain.cracks.front().back());
      // as far from the left end as the crack is long, farther from the right one
      return grow_through_strip(*method.strip_solver(),
                                {{height, 5 * height, 2 * height, h, {}},
                                 4,
                                 lame,
                                 scene.fracture.surface_terms,
                                 scene.geometry.backend},
                                influence)
          ->peak;
    }

    /// The mean of E/(1 - nu²) in plane strain over nodes.
    double mean_plane_modulus(const scene::Scene &scene, const std::vector<Point<2>> &nodes)
    {
      const auto lame = constants(scene);
      double sum = 0;
      for (const Point<2> &node : nodes)
      {
        const physics::Lame at = lame(node);
        sum += 4 * at.mu * (at.lambda + at.mu) / (at.lambda + 2 * at.mu);
      }
      return sum / static_cast<double>(nodes.size());
    }

    template <int dim>
    std::vector<double> toughness_of_nodes(const scene::Scene &scene,
                                           const std::vector<Point<dim>> &nodes, double horizon)
    {
      const physics::Expression toughness("Fracture/toughness", scene.fracture.toughness,
                                          scene.names(horizon));
      std::vector<double> at_nodes;
      for (const Point<dim> &node : nodes)
        at_nodes.push_back(value_at(toughness, node, 0));
      return at_nodes;
    }

    /// What of G and of the material lies between nodes, where bonds do not know of it.
    std::vector<std::string> find_unseen(const scene::Scene &scene, const GrowthModel &model,
                                         double horizon)
    {
      std::vector<SpatialValue> values = scene::material_values(scene);
      const physics::Expression toughness("Fracture/toughness", scene.fracture.toughness,
                                          scene.names(horizon));
      if (!toughness.is_constant() && scene.fracture.of_bonds == problem::BondToughness::mean)
        values.push_back(
            {"Fracture/toughness", [toughness](const Point<2> &x) { return toughness(x); }});
      if (values.empty())
        return {};
      PlacesBetweenNodes places{model.nodes, {}, {}};
      const double half = .5 * model.h;
      if (model.cells)
        places.cells = model.cells->pieces;
      else
        for (const Point<2> &x : model.nodes)
          places.cells.push_back({x + Point<2>(-half, -half), x + Point<2>(half, -half),
                                  x + Point<2>(half, half), x + Point<2>(-half, half)});
      for (const auto &bond : model.bonds)
        places.middles_of_bonds.push_back(model.nodes[bond[0]] +
                                          .5 * (model.nodes[bond[1]] - model.nodes[bond[0]]));
      std::vector<std::string> warnings = unseen_features(values, places, model.h);
      for (std::string &one : warnings)
        one += "; refine Study/h, or make the features wider than h" +
               std::string(one.find("Fracture/") == 0
                               ? ", or write Fracture/bond toughness = minimum, or give a weak "
                                 "line as Fracture/interfaces"
                               : "");
      return warnings;
    }

    /// λ = μ at every one of some points.
    bool is_of_bonds(const scene::Scene &scene)
    {
      constexpr int n = 16; // along each side
      const auto material = constants(scene);
      if (scene.domain.is_in_space()) // where it is homogeneous
      {
        const physics::Lame lame = material({});
        return std::abs(lame.lambda - lame.mu) <= 1e-12 * lame.mu;
      }
      for (const geometry::Box &box : scene.domain.boxes.include)
        for (int k = 0; k < n * n; ++k)
        {
          const Tensor<1, 2> side = box.upper - box.lower;
          const physics::Lame lame = material(
              box.lower + Tensor<1, 2>({(k % n + .5) / n * side[0], (k / n + .5) / n * side[1]}));
          if (std::abs(lame.lambda - lame.mu) > 1e-12 * lame.mu)
            return false;
        }
      return true;
    }
  } // namespace

  namespace
  {
    /// The scene's body at its level.
    template <int dim>
    method::BreakableBody<dim> make_body(const scene::Scene &scene, const Method &method,
                                         const physics::Kernel<dim> &influence, double trapping,
                                         problem::GrowthSolver solver)
    {
      try
      {
        return method.fracture_solver()->breakable_body(
            make_solid<dim>(scene, influence.horizon(), trapping), influence,
            scene.study.series.front().levels.front().h, scene.geometry.backend,
            scene.fracture.stretch, solver);
      }
      catch (const InputError &error)
      {
        throw InputError(scene::with_origin(error.what(), scene.domain.origin));
      }
    }

    method::MovingBody make_moving_body(const scene::Scene &scene, const Method &method,
                                        const physics::Kernel<2> &influence, double trapping)
    {
      try
      {
        return method.fracture_solver()->moving_body(
            make_solid<2>(scene, influence.horizon(), trapping), influence,
            scene.study.series.front().levels.front().h, scene.geometry.backend);
      }
      catch (const InputError &error)
      {
        throw InputError(scene::with_origin(error.what(), scene.domain.origin));
      }
    }
  } // namespace

  std::shared_ptr<const Method> fracture_method(const std::string &name, const Methods &available)
  {
    std::string known, corrected;
    for (const auto &method : available)
      if (method->fracture_solver() != nullptr)
      {
        if (method->name() == name)
          return method;
        if (method->is_in_all())
          known += (known.empty() ? "" : ", ") + method->name();
      }
      else if (method->name() == name && method->family() == method::MethodFamily::meshfree)
        corrected = "' does not support bonds that break; take one of ";
    throw InputError("Methods/names = '" + name +
                     (!corrected.empty() ? corrected
                                         : "' is not a meshfree rule; only these support cracks "
                                           "(Galerkin spaces would need jumps); take one of ") +
                     known);
  }

  GrowthSize expected_size(const scene::Scene &scene, unsigned int n_jobs)
  {
    const problem::Level &level = scene.study.series.front().levels.front();
    double m = level.horizon / level.h;
    const auto &cracks = scene.domain.cracks;
    const bool is_in_space = scene.domain.is_in_space(), has_notch = !cracks.empty();
    const Point<2> tip = has_notch ? cracks.front().back() : Point<2>(),
                   mouth = has_notch ? cracks.front()[0] : Point<2>();
    GrowthSize size;
    double way = 0,
           layers = 1; // along x from the notch's tip, if any, to the far side; of nodes in z
    const auto add_box = [&](const auto &box)
    {
      size.n_nodes +=
          (box.upper[0] - box.lower[0]) * (box.upper[1] - box.lower[1]) / (level.h * level.h);
      way = std::max(way, !has_notch           ? box.upper[0] - box.lower[0]
                          : tip[0] >= mouth[0] ? box.upper[0] - tip[0]
                                               : tip[0] - box.lower[0]);
    };
    if (scene.domain.mesh.is_lattice() && !is_in_space)
      for (const geometry::Box &box : scene.domain.boxes.include)
        add_box(box);
    if (!scene.domain.mesh.is_lattice())
    {
      const geometry::Mesh mesh = scene::make_mesh(scene, level);
      add_box(geometry::bounding_box(mesh));
      if (scene.methods.nodes.kind() == scene::NodeKind::mesh)
      {
        m *= std::sqrt(static_cast<double>(mesh.n_wholes()) / size.n_nodes);
        size.n_nodes = static_cast<double>(mesh.n_wholes());
      }
    }
    for (const geometry::Cuboid &box : scene.domain.solid.include)
    {
      const double n = size.n_nodes;
      add_box(box);
      const double of_box = (box.upper[2] - box.lower[2]) / level.h;
      layers = std::max(layers, of_box);
      size.n_nodes = n + of_box * (size.n_nodes - n);
    }
    // half the ball's area or volume, in nodes
    size.n_bonds = (is_in_space ? 2. / 3 * M_PI * m : .5 * M_PI) * m * m * size.n_nodes;
    const bool is_bonds = is_of_bonds(scene);
    // with dilatations the reach is twice as far; nested dissection: entries of the factor grow
    // with the logarithm of n a node, in space with its cube root
    const double n_entries = (is_in_space ? 18 * (is_bonds ? 1 : 8) : 8 * (is_bonds ? 1 : 4)) *
                             size.n_bonds,
                 n_factor = is_in_space
                                ? (is_bonds ? 22 : 88) * m * m * std::pow(size.n_nodes, 4. / 3)
                                : (is_bonds ? 6 : 18) * m * m * size.n_nodes *
                                      std::log2(std::max(2., size.n_nodes));
    // bonds with their books; the factor with entries of the matrix while it is made, and room for
    // some 400 solutions of Woodbury's formula; or the matrix, multigrid's copy and coarser levels
    size.factor_bytes = 400 * size.n_bonds + 16 * n_factor + 6400 * size.n_nodes;
    size.multigrid_bytes = 400 * size.n_bonds + 44 * n_entries;
    size.solver = scene.fracture.solver;
    if (size.solver == problem::GrowthSolver::automatic)
      size.solver = scene.fracture.can_iterate() && scene.problem.loads.empty() &&
                            n_jobs * size.factor_bytes > base::available_memory()
                        ? problem::GrowthSolver::multigrid
                        : problem::GrowthSolver::factor;
    // 18 a column of nodes at m = 3 in the plane
    size.n_breaks = (is_in_space ? .25 * M_PI * m * layers : 2. / 3) * m * m * m * way / level.h;
    // a solution for each bond, 2 ns an entry of the factor, and half of that for updates and new
    // factors; or iterations of 6.6 ns an entry of the matrix, and a fourth of that for set-ups
    const double n_iterations = 1.5 * std::pow(2 * size.n_nodes, .25);
    size.seconds = size.n_breaks * (size.solver == problem::GrowthSolver::factor
                                        ? 1.5 * 2e-9 * n_factor
                                        : 1.25 * 6.6e-9 * n_entries * n_iterations);
    return size;
  }

  namespace
  {
    /// Memory for the growth of a scene: nothing is made before it is there.
    void check_growth_size(const scene::Scene &scene, unsigned int n_jobs)
    {
      const GrowthSize size = expected_size(scene, n_jobs);
      // bonds, of the network and as they are summed, with their ends; nodes, and what drives them
      // at up to 65 times: as it is given, and in analysis::Transient with its rate
      const double node_bytes = scene.is_steady() ? 2000 : 2000 + 4000;
      if (scene.time.is_dynamic())
        return base::require_memory(300 * size.n_bonds + node_bytes * size.n_nodes,
                                    "a body of " + base::to_text(size.n_nodes, 3) + " nodes",
                                    "choose a larger h (Study/h)", n_jobs);
      const bool is_factor = size.solver == problem::GrowthSolver::factor;
      const bool may_iterate =
          is_factor && scene.fracture.can_iterate() && scene.problem.loads.empty();
      base::require_memory(
          is_factor ? size.factor_bytes : size.multigrid_bytes,
          "Study/h = " + base::to_text(scene.study.series.front().levels.front().h, 4) +
              " gives a body of " + base::to_text(size.n_nodes, 3) + " nodes",
          may_iterate ? "choose a larger h, or Fracture/solver = multigrid, which takes " +
                            base::bytes_to_text(size.multigrid_bytes)
                      : "choose a larger h",
          n_jobs);
    }

    /// The solid, as it was solved and why.
    template <int dim>
    void describe(const scene::Scene &scene, const method::BreakableBody<dim> &model,
                  problem::GrowthSolver solver, Record &record)
    {
      const problem::FractureSettings &rules = scene.fracture;
      record.key.problem = base::word(rules.breaking);
      record.texts["model"] = model_words(scene, !model.has_dilatation);
      record.texts["breaking"] = base::word(rules.breaking);
      record.texts["stretch"] = base::word(rules.stretch);
      record.texts["criterion"] = base::word(rules.criterion);
      record.texts["surface terms"] = base::word(rules.surface_terms);
      record.texts["toughness of bonds"] = base::word(rules.of_bonds);
      record.texts["solver"] = base::word(solver);
      if (model.cells)
        record.texts["nodes"] = scattered_nodes;
      record.set("min reaction", rules.least_reaction);
      record.set("max load", rules.largest_load);
      record.set("interfaces", static_cast<double>(rules.interfaces.size()));
      record.cost.n_unknowns = model.body->n_unknowns();
      record.cost.n_bonds = model.body->n_bonds();
      record.set("unknowns", static_cast<double>(model.body->n_unknowns()));
      record.set("bonds", static_cast<double>(model.body->n_bonds()));
    }

    /// The formula of the critical stretch, with its source.
    std::string stretch_words(const scene::Scene &scene)
    {
      const bool is_in_space = scene.domain.is_in_space();
      if (scene::is_inverse_distance(scene.kernel))
        return is_in_space ? "s0² = 5G/(9kδ) with the bulk modulus k (Silling & Askari 2005)"
                           : "s0² = πG/(3δ(λ + μ)) (Fan et al. 2022, eq. (2.25))";
      return std::string(is_in_space ? "s0² = G/(πβ(3λ + 2μ)) with β = ∫K r⁵ dr"
                                     : "s0² = G/(4β(λ + μ)) with β = ∫K r⁴ dr") +
             " of the influence function K (Kernel/type = " + scene.kernel.type + ")";
    }

    /// At which a bond breaks whose ends are both like one node, the smallest of all nodes.
    template <int dim>
    double critical_stretch(const scene::Scene &scene, const method::BreakableBody<dim> &model,
                            const physics::Kernel<dim> &influence, double trapping)
    {
      const auto lame = constants(scene);
      double smallest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < model.nodes.size(); ++i)
      {
        const Point<2> here(model.nodes[i][0], model.nodes[i][1]); // in space constants are alike
        smallest =
            std::min(smallest, model.toughness[i] /
                                   (trapping * physics::crossing_energy(influence, lame(here))));
      }
      return std::sqrt(smallest);
    }

    void describe_field(const scene::RandomSection &random, Record &record)
    {
      record.texts["seeds"] = seed_words(random);
      if (random.field != scene::FieldKind::none)
        record.set("field seed", static_cast<double>(random.seed));
      if (random.is_drawn_whole())
        record.set("field realisation", random.realisation);
      if (const auto spectrum = field_spectrum(random))
      {
        record.set("variance kept", spectrum->variance_kept());
        record.texts["field"] = words_of(*spectrum);
        analysis::Curve &curve = record.curves["spectrum"] = curve_of({"mode", "share", "kept"});
        for (std::size_t k = 0; k < spectrum->share.size(); ++k)
          add_row(curve, {static_cast<double>(k + 1), spectrum->share[k], spectrum->kept[k]});
      }
    }

    void set_work(const method::QuasistaticFractureModel::Work &work, Record &record)
    {
      record.cost.n_iterations = work.n_iterations;
      record.set("factorisations", static_cast<double>(work.n_factorisations));
      record.set("factor seconds", work.factor_seconds, "time");
      record.set("updates", static_cast<double>(work.n_updates));
      record.set("update seconds", work.update_seconds, "time");
      record.set("largest rank", static_cast<double>(work.largest_rank));
      if (work.n_iterations == 0)
        return;
      record.set("iterations", static_cast<double>(work.n_iterations));
      record.set("most iterations", static_cast<double>(work.most_iterations));
    }

    std::vector<std::size_t> all_broken(const analysis::Growth &growth)
    {
      std::vector<std::size_t> broken;
      for (const analysis::Event &event : growth.events)
        broken.insert(broken.end(), event.bonds.begin(), event.bonds.end());
      return broken;
    }

    template <int dim>
    CommonFindings<dim> common_findings(const method::BreakableBody<dim> &model,
                                        analysis::Growth growth,
                                        const std::vector<std::size_t> &broken)
    {
      auto moments = growth_moments(model, growth.events);
      return {std::move(growth), std::move(moments), broken_parts(model, broken), model.nodes,
              model.notch_tip};
    }

    FrontFindings find_out(const scene::Scene &scene, const method::BreakableBody<3> &model,
                           analysis::Growth growth)
    {
      const std::vector<std::size_t> broken = all_broken(growth);
      const std::vector<geometry::Cuboid> &boxes = scene.domain.solid.include;
      FrontFindings found;
      static_cast<CommonFindings<3> &>(found) = common_findings(model, std::move(growth), broken);
      found.front = find_front(model, found.growth.events);
      found.h = model.h;
      found.n_unpaired_in_y = n_unpaired(model, broken, 1, middle(boxes, 1));
      found.n_unpaired_in_z = n_unpaired(model, broken, 2, middle(boxes, 2));
      return found;
    }

    GrowthFindings find_out(const scene::Scene &scene, const GrowthModel &model,
                            analysis::Growth growth)
    {
      const std::vector<std::size_t> broken = all_broken(growth);
      GrowthFindings found;
      static_cast<CommonFindings<2> &>(found) = common_findings(model, std::move(growth), broken);
      found.path = find_path(model, found.growth.events);
      found.toughness = model.toughness;
      found.origin = scene.domain.origin;
      found.plane_modulus = mean_plane_modulus(scene, model.nodes);
      if (!model.cells)
        found.n_unpaired = n_unpaired(model, broken, 1, middle(scene.domain.boxes.include, 1));
      return found;
    }

    /// Notes on features that the nodes do not resolve, and on crack tips that lie on bonds.
    std::vector<std::string> find_notes(const scene::Scene &scene, const GrowthModel &model,
                                        double horizon)
    {
      std::vector<std::string> notes = find_unseen(scene, model, horizon);
      for (const geometry::TipOnBonds &tip :
           geometry::tips_on_bonds(scene.domain.cracks, model.nodes, horizon))
        notes.push_back(tip.text(scene.domain.origin));
      return notes;
    }
    /// The notch extends along z: what meets it in one layer of nodes meets it in all.
    std::vector<std::string> find_notes(const scene::Scene &scene,
                                        const method::BreakableBody<3> &model, double horizon)
    {
      std::vector<Point<2>> layer;
      for (const Point<3> &x : model.nodes)
        if (std::abs(x[2] - model.nodes.front()[2]) < .5 * model.h)
          layer.emplace_back(x[0], x[1]);
      std::vector<std::string> notes;
      for (const geometry::TipOnBonds &tip :
           geometry::tips_on_bonds(scene.domain.cracks, layer, horizon))
        notes.push_back(tip.text({}));
      return notes;
    }

    void write_moments(const GrowthFindings & /*found*/, const WriteDamage & /*write*/) {}
    void write_moments(const FrontFindings &found, const WriteDamage &write)
    {
      std::vector<double> loads;
      for (const GrowthMoment &moment : found.moments)
      {
        loads.push_back(moment.load);
        if (write)
          write(loads, found.nodes, moment.damage);
      }
    }

    template <int dim>
    Record analyse_in(const Place &place, const Method &method, const Checkpoints &checkpoints,
                      const WriteDamage &write)
    {
      const scene::Scene &scene = place.scene();
      const problem::Level &level = place.level();
      const problem::GrowthSolver solver = expected_size(scene).solver;
      const auto influence = physics::influence_function<dim>(scene.kernel.profile, level.horizon);
      Record record = place.record("grow", method);
      record.texts["critical stretch"] = stretch_words(scene);
      double trapping = 1;
      if constexpr (dim == 2)
        if (scene.fracture.criterion == problem::Criterion::calibrated)
        {
          trapping = find_trapping(scene, method, influence, level.h);
          record.set("G_peak / G", trapping);
        }
      method::BreakableBody<dim> model = make_body(scene, method, influence, trapping, solver);
      model.toughness = toughness_of_nodes(scene, model.nodes, level.horizon);
      describe(scene, model, solver, record);
      record.set("s0", critical_stretch(scene, model, influence, trapping));
      describe_field(scene.random, record);
      record.set("G_h / G", model.cells ? model.cut_energy
                                        : method.fracture_solver()->lattice_toughness(
                                              influence, level.h, scene.geometry.backend));
      record.notes = find_notes(scene, model, level.horizon);
      const base::CpuTimer timer;
      analysis::Growth growth =
          run_growth(*model.body, {scene.fracture, "plumbline grow\n" + scene.text, checkpoints});
      record.cost.solve_seconds = timer.seconds();
      record.texts["pulled by"] = scene.problem.loads.empty() ? "grips" : "dead loads";
      set_work(model.body->work(), record);
      std::optional<Point<dim>> nucleus;
      if (scene.domain.cracks.empty())
        nucleus = find_nucleus(model, growth.events);
      if (nucleus)
        model.notch_tip = Point<2>((*nucleus)[0], (*nucleus)[1]);
      auto found = find_out(scene, model, std::move(growth));
      if constexpr (dim == 3)
        found.nucleus = nucleus;
      write_moments(found, write);
      return growth_record(std::move(record), found);
    }

    /// The scene's body in motion.
    Record analyse_motion(const Place &place, const Method &method, const Checkpoints &checkpoints,
                          const WriteStrip &write)
    {
      const scene::Scene &scene = place.scene();
      const problem::Level &level = place.level();
      const auto influence = physics::influence_function<2>(scene.kernel.profile, level.horizon);
      Record record = place.record("grow", method);
      record.texts["critical stretch"] = stretch_words(scene);
      double trapping = 1;
      if (scene.fracture.criterion == problem::Criterion::calibrated)
      {
        trapping = find_trapping(scene, method, influence, level.h);
        record.set("G_peak / G", trapping);
      }
      method::MovingBody body = make_moving_body(scene, method, influence, trapping);
      body.parts.toughness = toughness_of_nodes(scene, body.parts.nodes, level.horizon);
      record.texts["model"] = model_words(scene, !body.parts.has_dilatation);
      record.texts["criterion"] = base::word(scene.fracture.criterion);
      record.set("s0", critical_stretch(scene, body.parts, influence, trapping));
      describe_field(scene.random, record);
      record.set("G_h / G", method.fracture_solver()->lattice_toughness(influence, level.h,
                                                                        scene.geometry.backend));
      record.notes = find_notes(scene, body.parts, level.horizon);
      return breaking_record(place, std::move(body), checkpoints, write, std::move(record));
    }

    void conclude(const scene::Scene &scene, StudyResults &results)
    {
      for (const Record &record : results.records)
      {
        results.warnings.insert(results.warnings.end(), record.notes.begin(), record.notes.end());
        for (Expectation &one : scene.time.is_dynamic()
                                    ? check_breaking(record, scene.expected)
                                    : check_crack_growth(record, scene.expected))
          results.expectations.push_back(std::move(one));
      }
    }
  } // namespace

  Analysis growth_analysis(const Checkpoints &checkpoints, const WriteDamage &write,
                           const WriteStrip &write_motion)
  {
    Analysis analysis{"grow", "Fracture bond by bond"};
    analysis.choose_methods = [](const scene::Scene &scene, const Methods &available, unsigned int,
                                 unsigned int n_jobs) -> Methods
    {
      if (!scene.fracture.is_there())
        throw InputError("scene '" + scene.name +
                         "': Fracture/toughness is empty, so that nothing breaks; give it, or use "
                         "'plumbline run' ('plumbline crack' where Crack/notch is given)");
      check_growth_size(scene, n_jobs);
      return {fracture_method(scene.methods.names.front(), available)};
    };
    analysis.analyse = [=](const Place &place, const Method &method) -> Records
    {
      if (place.scene().time.is_dynamic())
        return {analyse_motion(place, method, checkpoints, write_motion)};
      return {place.scene().domain.is_in_space()
                  ? analyse_in<3>(place, method, checkpoints, write)
                  : analyse_in<2>(place, method, checkpoints, write)};
    };
    analysis.conclude = conclude;
    analysis.sampled.assign(scene::growth_quantities.begin(), scene::growth_quantities.end());
    analysis.sampled_field = "damage";
    analysis.are_failures_findings = false;
    return analysis;
  }
} // namespace plumbline::study
