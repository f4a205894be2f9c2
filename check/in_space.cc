#include "check/in_space.h"

#include "base/error.h"
#include "check/body.h"
#include "meshfree/check/images.h"
#include "meshfree/check/nodes_in_space.h"

namespace plumbline::check
{
  study::Record record_of(const Findings<3> &found)
  {
    study::Record record;
    record.key.analysis = "check";
    record.key.method = "given weights"; // whatever rule gives them: that of the loop over levels
    record.key.h = found.level.level.h;
    record.key.horizon = found.level.level.horizon;
    record.set("nodes", static_cast<double>(found.cells->n_free));
    record.set("bonds", static_cast<double>(found.weights.n_bonds));
    record.set("negative weights", static_cast<double>(found.weights.n_negative));
    record.set("bonds without partner", static_cast<double>(found.symmetry.n_unpaired));
    record.set("first moment defect", found.moments.defects[0].worst.value);
    record.set("second moment defect", found.moments.second.value);
    record.set("median moment defect", found.moments.typical());
    record.set("imbalance of pairs", found.symmetry.imbalance);
    if (!found.rule.empty())
    {
      record.notes.push_back("the weights are those of " + found.rule);
      record.set("factor of the rule", found.rule_factor);
    }
    for (const meshfree::ElasticRange &one : found.elastic)
    {
      record.set("least " + one.name, one.least);
      record.set("median " + one.name, one.median);
      record.set("largest " + one.name, one.largest);
    }
    return record;
  }

  meshfree::GivenWeights<3> with_cells(meshfree::GivenNodes<3> nodes, const geometry::Cuboid &omega,
                                       bool is_periodic, const problem::Level &level)
  {
    meshfree::GivenWeights<3> weights;
    weights.nodes = std::move(nodes);
    if (is_periodic)
    {
      weights.nodes.box = {omega.lower, omega.upper};
      weights.nodes.box->take_in(weights.nodes.places, [&](std::size_t node)
                                 { return "node " + std::to_string(weights.nodes.id[node]); });
      weights.nodes.box->check_sides(level.horizon, level.h);
      meshfree::add_images(level.horizon + level.h, weights.nodes);
    }
    meshfree::CellsInSpace cells = meshfree::given_cells(weights.nodes, omega, level.horizon);
    weights.lattice = cells.lattice;
    weights.cells = std::make_shared<const geometry::NodeCells<3>>(std::move(cells.cells));
    return weights;
  }

  void find_defects(meshfree::BondValues values, meshfree::GivenWeights<3> weights,
                    const physics::Kernel<3> &kernel, const std::vector<std::string> &meant,
                    Findings<3> &found)
  {
    for (const std::size_t k : weights.cells->source)
    {
      weights.volumes.push_back(weights.nodes.volume[k]);
      found.ids.push_back(weights.nodes.id[k]);
    }
    to_weights(values, kernel, weights);
    if (weights.nodes.box)
      found.n_crossing =
          meshfree::crossing_bonds(weights.given.families, weights.nodes, *weights.cells);
    const std::vector<double> volumes = weights.cells->area;
    static_cast<meshfree::Findings<3> &>(found) =
        meshfree::find_defects(std::move(weights), kernel, volumes, found.level.node_size, meant);
  }

  Findings<3> find_in_space(const scene::Scene &scene, const Input &input)
  {
    if (!scene.domain.mesh.is_lattice())
      throw InputError("Domain/mesh = " + scene.domain.mesh.name +
                       ": in three dimensions weights are checked on one box; write lattice, and "
                       "give Domain/boxes");
    const geometry::Solid &solid = scene.domain.solid;
    if (solid.include.size() != 1 || !solid.exclude.empty())
      throw InputError("in three dimensions weights are checked on one box; give Domain/boxes with "
                       "one, and clear Domain/holes");
    const geometry::Cuboid &omega = solid.include.front();
    const bool is_periodic = to_boundary(input.boundary, "--boundary") == scene::Boundary::periodic;
    Findings<3> found;
    found.scene_name = scene.name;
    found.purpose = scene.purpose;
    meshfree::GivenNodes<3> nodes = meshfree::read_given_nodes<3>(input.nodes_file);
    if (is_periodic)
      nodes.box = {omega.lower, omega.upper};
    found.level = choose_level(scene, meshfree::node_spacing(nodes, omega));
    meshfree::GivenWeights<3> weights =
        with_cells(std::move(nodes), omega, is_periodic, found.level.level);
    weights.given =
        meshfree::read_given_families<3>(input.bonds_file, weights.nodes, *weights.cells);
    find_defects(meshfree::to_bond_values(input.bonds_are, "--bonds-are"), std::move(weights),
                 make_kernel_in_space(scene, found.level.level.horizon), scene.methods.names,
                 found);
    found.notes = notes_of(found, assumptions(scene, input, found.level.level), input);
    return found;
  }
} // namespace plumbline::check
