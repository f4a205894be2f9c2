#include "meshfree/fracture/network_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace plumbline::meshfree
{
  namespace
  {
    using NetworkBond = BondNetwork<2>::Bond;

    /// Sides of cells, joined to straight runs.
    class CellSides
    {
    public:
      explicit CellSides(const BondNetwork<2> &network)
          : h_(network.h), origin_(network.nodes.front())
      {
      }

      /// The side that a bond of length h crosses; longer ones are left out.
      void add(const Point<2> &from, const Tensor<1, 2> &xi)
      {
        constexpr double rounding = 1e-6;
        if (xi.norm() > (1 + rounding) * h_)
          return;
        const unsigned int across = std::abs(xi[0]) > std::abs(xi[1]) ? 0 : 1;
        const Tensor<1, 2> middle = (from + .5 * xi - origin_) / h_;
        places_[{across, std::lround(2 * middle[across])}].insert(std::lround(middle[1 - across]));
      }

      std::vector<geometry::Polyline> runs() const
      {
        std::vector<geometry::Polyline> result;
        for (const auto &[line, places] : places_)
          for (auto first = places.begin(); first != places.end();)
          {
            auto last = first, next = std::next(first);
            while (next != places.end() && *next == *last + 1)
              last = next++;
            const auto point = [&, across = line.first, at = line.second](double along)
            {
              Point<2> x = origin_;
              x[across] += .5 * h_ * static_cast<double>(at);
              x[1 - across] += h_ * along;
              return x;
            };
            result.push_back(
                {point(static_cast<double>(*first) - .5), point(static_cast<double>(*last) + .5)});
            first = next;
          }
        return result;
      }

    private:
      double h_;
      Point<2> origin_;
      /// By the axis across them and the line [h/2] that they lie on: along it [h].
      std::map<std::pair<unsigned int, long>, std::set<long>> places_;
    };
  } // namespace

  Faces find_faces(const BondNetwork<2> &network, const Connections<2> &connections)
  {
    /// A notch ends within a cell of where the sides of cells begin that go on with it.
    const double gap = .75 * network.h;
    CellSides sides(network), grown(network);
    for (const NetworkBond &bond : network.surfaces->gaps)
      if (bond.from == bond.to) // to where no node is
        sides.add(network.nodes[bond.from], bond.xi);
    for (std::size_t b = 0; b < network.bonds.size(); ++b)
      if (!connections.is_whole(b))
        grown.add(network.nodes[network.bonds[b].from], network.bonds[b].xi);
    const std::vector<geometry::Polyline> &notch = network.surfaces->notch, runs = grown.runs();
    std::vector<Face> faces = faces_of(notch);
    for (const auto &lines : {sides.runs(), runs})
      for (const Face &face : faces_of(lines))
        faces.push_back(face);
    const auto is_in_a_cell = [&](const Point<2> &x)
    {
      return std::any_of(network.nodes.begin(), network.nodes.end(),
                         [&](const Point<2> &node)
                         {
                           return std::max(std::abs(x[0] - node[0]), std::abs(x[1] - node[1])) <
                                  .5 * (1 + geometry::on_crack) * network.h;
                         });
    };
    std::vector<Point<2>> tips = tips_of(notch, faces, network.horizon, gap, is_in_a_cell);
    for (const Point<2> &tip :
         tips_of(runs, faces, network.horizon, gap, [](const Point<2> &) { return true; }))
      tips.push_back(tip);
    return {std::move(faces), std::move(tips), network.horizon};
  }
} // namespace plumbline::meshfree
