#include "study/growth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace plumbline::study
{
  using analysis::Event;
  using dealii::Point;

  namespace
  {
    using SpaceModel = method::BreakableBody<3>;

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
        layer_of.push_back(lattice_place(model, x)[2]);
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

    /// The events, each reduced to its bonds that lie in the layer.
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

  std::optional<Point<3>> find_nucleus(const SpaceModel &model, const std::vector<Event> &events)
  {
    const std::vector<Layer> layers = layers_of(model);
    for (const Event &event : events)
      for (const Layer &layer : layers)
        if (const auto found = find_nucleus(layer.model, in_layer(layer, {event})))
          return Point<3>((*found)[0], (*found)[1], layer.z);
    return {};
  }

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
} // namespace plumbline::study
