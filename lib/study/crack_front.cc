#include "study/growth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace plumbline::study
{
  using analysis::Event;
  using dealii::Point;

  namespace
  {
    using SpaceModel = method::BreakableBody<3>;
    using LatticePlace = std::array<long, 3>; ///< in half mesh sizes from the first node

    LatticePlace place_of(const SpaceModel &model, const Point<3> &x)
    {
      LatticePlace place{};
      for (unsigned int d = 0; d < 3; ++d)
        place[d] = std::lround(2 * (x[d] - model.nodes.front()[d]) / model.h);
      return place;
    }

    /// The nodes of one z and the bonds between them as a body in the plane.
    struct Layer
    {
      double z = 0;
      GrowthModel model;
      std::map<std::size_t, std::size_t> bond_of; ///< of the body's bonds that lie in it
    };

    std::vector<Layer> layers_of(const SpaceModel &model)
    {
      std::map<long, Layer> layers;
      std::vector<long> layer_of;
      std::vector<unsigned int> number;
      for (const Point<3> &x : model.nodes)
      {
        layer_of.push_back(place_of(model, x)[2]);
        Layer &layer = layers[layer_of.back()];
        layer.z = x[2];
        number.push_back(static_cast<unsigned int>(layer.model.nodes.size()));
        layer.model.nodes.emplace_back(x[0], x[1]);
      }
      for (std::size_t b = 0; b < model.bonds.size(); ++b)
        if (const auto &[from, to] = model.bonds[b]; layer_of[from] == layer_of[to])
        {
          Layer &layer = layers[layer_of[from]];
          layer.bond_of[b] = layer.model.bonds.size();
          layer.model.bonds.push_back({number[from], number[to]});
        }
      for (const auto &[from, to] : model.cut)
        if (layer_of[from] == layer_of[to])
          layers[layer_of[from]].model.cut.push_back({number[from], number[to]});
      std::vector<Layer> result;
      for (auto &[place, layer] : layers)
      {
        layer.model.h = model.h;
        layer.model.notch_tip = model.notch_tip;
        result.push_back(std::move(layer));
      }
      return result;
    }

    /// With those of the bonds that lie in a layer.
    std::vector<Event> in_layer(const Layer &layer, const std::vector<Event> &events)
    {
      std::vector<Event> result(events.size());
      for (std::size_t i = 0; i < events.size(); ++i)
        for (const std::size_t b : events[i].bonds)
          if (const auto bond = layer.bond_of.find(b); bond != layer.bond_of.end())
            result[i].bonds.push_back(bond->second);
      return result;
    }
  } // namespace

  CrackFront find_front(const SpaceModel &model, const std::vector<Event> &events)
  {
    CrackFront front;
    front.way.resize(events.size());
    for (const Layer &layer : layers_of(model))
    {
      front.z.push_back(layer.z);
      front.layers.push_back(find_path(layer.model, in_layer(layer, events)));
      const CrackPath &path = front.layers.back();
      for (std::size_t i = 0; i < events.size(); ++i)
        front.way[i].push_back(path.tips[i].distance(model.notch_tip));
      front.area += path.width * model.h;
      front.n_elsewhere += path.n_elsewhere;
    }
    return front;
  }

  std::size_t n_unpaired(const SpaceModel &model, const std::vector<std::size_t> &broken,
                         unsigned int axis, double middle)
  {
    using BondEnds = std::array<LatticePlace, 2>;
    const auto key = [&](std::size_t bond, bool is_mirrored)
    {
      BondEnds ends{};
      for (unsigned int i = 0; i < 2; ++i)
      {
        Point<3> x = model.nodes[model.bonds[bond][i]];
        if (is_mirrored)
          x[axis] = 2 * middle - x[axis];
        ends[i] = place_of(model, x);
      }
      std::sort(ends.begin(), ends.end());
      return ends;
    };
    std::set<BondEnds> all;
    for (const std::size_t bond : broken)
      all.insert(key(bond, false));
    return static_cast<std::size_t>(std::count_if(broken.begin(), broken.end(),
                                                  [&](std::size_t bond)
                                                  { return all.count(key(bond, true)) == 0; }));
  }
} // namespace plumbline::study
