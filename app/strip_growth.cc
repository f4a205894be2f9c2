#include "strip_growth.h"

#include "meshfree/fracture/strip.h"

namespace plumbline::app
{
  study::GrowthModel growth_model(meshfree::BreakingNetwork &body,
                                  const dealii::Point<2> &notch_tip)
  {
    study::GrowthModel model;
    const meshfree::BondNetwork &network = body.network();
    model.body = &body;
    model.h = network.h;
    model.nodes = network.nodes;
    for (const meshfree::BondNetwork::Bond &bond : network.bonds)
      model.bonds.push_back({bond.from, bond.to});
    model.toughness_of_bonds = network.toughness;
    model.cut = network.cut;
    model.notch_tip = notch_tip;
    model.damage = [&network](const std::vector<std::size_t> &broken)
    { return network.damage(broken); };
    return model;
  }

  study::StripGrowth grow_through_strip(const GrowingStrip &strip)
  {
    const double h = strip.strip.h;
    const auto make = [&](int n_crack, problem::SurfaceTerms surface_terms)
    {
      method::RiceStrip shape = strip.strip;
      shape.n_crack = n_crack;
      auto solid = meshfree::make_strip(shape, strip.lame, strip.influence.horizon());
      solid.surface_terms = surface_terms;
      return meshfree::BreakingNetwork(
          make_bond_network(solid, strip.rule, strip.influence, h, strip.backend),
          problem::Stretch::linear);
    };
    const int n_crack = strip.strip.n_crack;
    const auto energy = [&](int n)
    { return make(n, problem::SurfaceTerms::uncorrected).response().energy; };
    const double W1 = (energy(n_crack) - energy(n_crack + 1)) / h;
    meshfree::BreakingNetwork body = make(n_crack, strip.surface_terms);
    const double tip = n_crack * h;
    return measure_strip(growth_model(body, {tip, 0}), W1, tip + 2 * h,
                         tip + (2 + strip.n_columns) * h);
  }
} // namespace plumbline::app
