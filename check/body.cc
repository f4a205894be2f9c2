#include "check/body.h"

#include "base/error.h"
#include "base/number_text.h"
#include "geometry/cracks.h"
#include "geometry/search.h"
#include "meshfree/check/images.h"
#include "problem/builder.h"
#include "report/text_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace plumbline::check
{
  using geometry::FamilyCut;
  using meshfree::BodyCheck;
  using meshfree::Correction;
  using meshfree::CutFamilies;
  using meshfree::NodePair;
  using Json = nlohmann::ordered_json;

  namespace
  {
    constexpr std::size_t most_named = 5;

    std::string name(FamilyCut cut)
    {
      switch (cut)
      {
      case FamilyCut::none:
        return "interior";
      case FamilyCut::surface:
        return "near surfaces";
      default:
        return "near cracks";
      }
    }

    std::string word(FamilyCut cut)
    {
      return cut == FamilyCut::none ? "none" : cut == FamilyCut::surface ? "surface" : "crack";
    }

    std::string word(Correction correction)
    {
      switch (correction)
      {
      case Correction::none:
        return "none";
      case Correction::volume:
        return "volume";
      case Correction::whole_ball:
        return "whole ball";
      case Correction::force_density:
        return "force density";
      default:
        return "energy";
      }
    }

    /// Of a node numbered as in its file.
    std::string id(const Findings<2> &found, std::size_t node)
    {
      return std::to_string(found.nodes.id[node]);
    }

    std::string number(double value)
    {
      constexpr int digits = 4;
      return base::to_text(value, digits);
    }

    /// "12 and 13, 12 and 14 ..."
    std::string list(const Findings<2> &found, const std::vector<NodePair> &pairs)
    {
      std::string text;
      for (std::size_t k = 0; k < std::min(most_named, pairs.size()); ++k)
        text += (k == 0 ? "" : ", ") + id(found, pairs[k].node) + " and " +
                id(found, pairs[k].neighbour);
      return text + (pairs.size() > most_named ? " ..." : "");
    }

    std::string pairs_have(std::size_t n)
    {
      return std::to_string(n) + (n == 1 ? " pair of nodes has " : " pairs of nodes have ");
    }

    const CutFamilies *families(const BodyCheck &body, FamilyCut cut)
    {
      for (const CutFamilies &one : body.families)
        if (one.cut == cut)
          return &one;
      return nullptr;
    }

    /// Young's modulus and Poisson's ratio beside those of the interior; empty for scalar kernels.
    std::string elastic_text(const CutFamilies &cut, const CutFamilies &interior)
    {
      std::string text;
      for (std::size_t k = 0; k < cut.elastic.size(); ++k)
        if (const std::string &of = cut.elastic[k].name;
            of.find("plane stress") != std::string::npos)
          text += "; " + of + ": " + number(cut.elastic[k].median) + ", in the interior " +
                  number(interior.elastic[k].median);
      return text;
    }

    std::string effect_text(const CutFamilies &cut, const BodyCheck &body)
    {
      const std::string what =
          cut.cut == FamilyCut::surface ? "surface effect (" : "effect of cracks (";
      return what + std::to_string(cut.n) + " families " + name(cut.cut) +
             "; relative to the bulk, median and minimum): second moments of the visible part " +
             base::to_percent(cut.exact) + ", " + base::to_percent(cut.least_exact) +
             "; of the weights " + base::to_percent(cut.given) + ", " +
             base::to_percent(cut.least_given) +
             elastic_text(cut, *families(body, FamilyCut::none));
    }

    std::string weights_text(const BodyCheck &body)
    {
      if (body.correction.correction == Correction::volume)
        return "weights are multiplied by 2V0/(Vi+Vj): volume correction (Le & Bobaru 2018), where "
               "V is " +
               body.correction.size.name + "; moments are compared without it";
      if (body.correction.correction == Correction::force_density ||
          body.correction.correction == Correction::energy)
        return "weights have the surface correction by the " + word(body.correction.correction) +
               " method (Le & Bobaru 2018); moments are compared without it";
      if (body.correction.correction == Correction::whole_ball || body.n_compared == 0)
        return "";
      if (!body.is_different())
        return "no surface correction: bonds near free surfaces and cracks have the weights of the "
               "interior";
      std::vector<double> factors;
      for (const NodePair &one : body.different)
        factors.push_back(one.factor);
      std::sort(factors.begin(), factors.end());
      return std::to_string(factors.size()) + " of " + std::to_string(body.n_compared) +
             " bonds near free surfaces and cracks have " + number(factors.front()) + " to " +
             number(factors.back()) + " times (median " + number(factors[factors.size() / 2]) +
             ") the weights of like bonds in the interior: not a known surface correction";
    }

    /// Moments near free surfaces or cracks that are farther off than is allowed. Of half lists all
    /// are, by one cause.
    std::vector<std::string> moment_complaints(const Findings<2> &found,
                                               const Requirements &required)
    {
      std::vector<std::string> result;
      if (found.given.is_half_list)
        return result;
      const BodyCheck &body = *found.body;
      const double ratio = body.spacing / found.level.level.horizon;
      for (const CutFamilies &cut : body.families)
        for (const bool is_second : {true, false})
        {
          const meshfree::Worst &worst = is_second ? cut.second : cut.first;
          const double median = is_second ? cut.median_second : cut.median_first;
          const std::string what = name(cut.cut) + (is_second ? " second" : " first") +
                                   " moments are off those of the visible part by ";
          const auto at_worst = [&](const std::string &limit)
          {
            return what + base::to_percent(worst.value) + " at node " + id(found, worst.node) +
                   ", more than " + limit;
          };
          if (cut.cut == FamilyCut::none)
            continue; // judged as on any domain
          if (required.ac && worst.value > ratio)
            result.push_back("required ac: " + at_worst("h/horizon = " + base::to_percent(ratio)));
          if (required.consistent && median > ratio)
            result.push_back("required consistent: " + what + base::to_percent(median) +
                             " in the median, more than h/horizon = " + base::to_percent(ratio));
          if (required.moments && worst.value > *required.moments)
            result.push_back("required moments=" + base::to_text(*required.moments, 5) + ": " +
                             at_worst("that"));
        }
      return result;
    }

    void add_different(const Findings<2> &found, std::vector<std::string> &complaints)
    {
      const std::vector<NodePair> &all = found.body->different;
      if (found.body->is_different())
        return;
      for (std::size_t k = 0; k < std::min(most_named, all.size()); ++k)
        complaints.push_back("outlier: the bond from node " + id(found, all[k].node) + " to node " +
                             id(found, all[k].neighbour) + " has " + number(all[k].factor) +
                             " times the weight of like bonds in the interior");
      if (all.size() > most_named)
        complaints.push_back("outliers: " + std::to_string(all.size() - most_named) +
                             " more bonds near free surfaces and cracks (check.json)");
    }
  } // namespace

  scene::Boundary to_boundary(const std::string &word, const std::string &key)
  {
    const auto boundary = base::from_word<scene::Boundary>(word);
    if (!boundary)
      throw InputError(key + " = '" + word +
                       "' is not known; choose one of 'constrained' (u is prescribed around the "
                       "domain), 'free' (the boundary of the domain is a free surface) and "
                       "'periodic' (opposite sides of the domain, a box, are joined)");
    return *boundary;
  }

  void take_into_box(const GivenBody &body, const geometry::Domain &omega,
                     meshfree::GivenNodes<2> &nodes)
  {
    if (!body.is_periodic())
      return;
    if (!body.cracks.empty())
      throw InputError("cracks in a periodic box are not supported; leave them out, or check the "
                       "body with a constrained or free boundary");
    if (omega.include.size() != 1 || !omega.exclude.empty())
      throw InputError("a periodic domain is one box without holes; give one");
    nodes.box = {omega.include[0].lower, omega.include[0].upper};
    nodes.box->take_in(
        nodes.places, [&](std::size_t k) { return "node " + std::to_string(nodes.id[k]); },
        nodes.origin);
  }

  void add_images(const geometry::Mesh &mesh, const problem::Level &level,
                  meshfree::GivenNodes<2> &nodes)
  {
    if (!nodes.box)
      return;
    nodes.box->check_sides(level.horizon, level.h);
    meshfree::add_images(mesh, nodes);
  }

  namespace
  {
    /// Beyond the reach of all nodes it is a mistake in the unit or the origin.
    void refuse_far_cracks(const std::vector<geometry::Polyline> &cracks,
                           const std::vector<dealii::Point<2>> &nodes, double horizon)
    {
      std::vector<geometry::Box> boxes;
      for (const dealii::Point<2> &x : nodes)
        boxes.push_back({x, x});
      const geometry::BoxSearch<2> search(boxes);
      std::vector<unsigned int> near;
      for (std::size_t c = 0; c < cracks.size(); ++c)
      {
        bool is_near = false;
        for (std::size_t k = 1; k < cracks[c].size() && !is_near; ++k)
        {
          geometry::Box around = geometry::bounding_box({&cracks[c][k - 1], 2});
          for (unsigned int d = 0; d < 2; ++d)
          {
            around.lower[d] -= horizon;
            around.upper[d] += horizon;
          }
          search.find(around, near);
          is_near = !near.empty();
        }
        if (!is_near)
          throw InputError("crack " + std::to_string(c) +
                           " is farther than the horizon from all nodes, so that no bond can cross "
                           "it; give its points in the coordinates of the nodes, or leave it out");
      }
    }
  } // namespace

  namespace
  {
    /// Checks what lies near free surfaces and cracks, and leaves the families of whole balls.
    BodyCheck check_body(const GivenBody &body, const std::string &key,
                         const physics::Kernel<2> &kernel, double spacing,
                         meshfree::GivenWeights<2> &weights, std::vector<double> &uncut_areas)
    {
      geometry::NodeCells<2> named; // places and ids are all that messages need
      named.nodes = weights.cells->nodes;
      named.n_free = weights.cells->n_free;
      for (const std::size_t k : weights.cells->source)
        named.source.push_back(static_cast<std::size_t>(weights.nodes.id[k]));
      try
      {
        refuse_far_cracks(body.cracks, named.nodes, kernel.horizon());
        geometry::check_cracks(body.cracks, named, {}, kernel.horizon());
      }
      catch (const InputError &error)
      {
        throw InputError(key + ": " + error.what());
      }
      const double tolerance =
          std::max(geometry::on_crack * kernel.horizon(), 2 * weights.nodes.rounding);
      const geometry::VisibleBody visible(body.parts, body.cracks, tolerance);
      return meshfree::check_body(weights, uncut_areas, visible, kernel, spacing);
    }
  } // namespace

  problem::Problem<2> problem_on(const geometry::Mesh &mesh,
                                 const std::shared_ptr<const geometry::NodeCells<2>> &cells,
                                 const physics::Kernel<2> &kernel, double h)
  {
    problem::MeshDomain on;
    on.mesh = std::make_shared<const geometry::Mesh>(mesh);
    on.cells = cells;
    on.reach = kernel.horizon();
    return problem::ProblemBuilder(std::move(on), kernel, h).build();
  }

  void find_defects(const GivenBody &body, const std::string &key, meshfree::BondValues values,
                    meshfree::GivenWeights<2> weights, std::vector<double> uncut_areas,
                    problem::Problem<2> problem, const std::vector<std::string> &meant,
                    Findings<2> &found)
  {
    for (const std::size_t k : weights.cells->source)
      weights.volumes.push_back(weights.nodes.volume[k]);
    to_weights(values, problem.kernel, weights);
    if (body.is_cut())
      found.body =
          check_body(body, key, problem.kernel, found.level.node_size, weights, uncut_areas);
    for (const std::size_t k : weights.cells->source)
      found.ids.push_back(weights.nodes.id[k]);
    if (weights.nodes.box)
      found.n_crossing =
          meshfree::crossing_bonds(weights.given.families, weights.nodes, *weights.cells);
    problem.on_mesh()->cells = weights.cells; // of whole balls
    static_cast<meshfree::Findings<2> &>(found) = meshfree::find_defects(
        std::move(weights), problem.kernel, uncut_areas, found.level.node_size, meant);
    meshfree::check_matrix(problem, found);
  }

  std::vector<std::string> body_complaints(const Findings<2> &found, const Requirements &required)
  {
    const BodyCheck &body = *found.body;
    std::vector<std::string> result;
    if (!body.crossing.empty())
      result.push_back(pairs_have(body.crossing.size()) +
                       "bonds across a crack, which must be absent: " + list(found, body.crossing));
    if (!body.missing.empty())
      result.push_back(pairs_have(body.missing.size()) +
                       "no bond, though no crack is between them and like pairs in the interior "
                       "have one: " +
                       list(found, body.missing));
    if (body.correction.correction == Correction::whole_ball)
      result.push_back("cause: weights are multiplied by V0/Vi, where V is " +
                       body.correction.size.name +
                       ": families near free surfaces and cracks are normalised to the full ball, "
                       "and the forces of a pair do not balance; leave the factor out, or take the "
                       "volume correction 2V0/(Vi+Vj)");
    add_different(found, result);
    for (const std::string &one : moment_complaints(found, required))
      result.push_back(one);
    const meshfree::SymmetryCheck &symmetry = body.symmetry;
    if (required.symmetric &&
        (symmetry.asymmetry > found.precision.moments || symmetry.n_unpaired > 0))
      result.push_back("required symmetric: w C of a pair differs from end to end by up to " +
                       base::to_percent(symmetry.asymmetry) + " of the largest, between nodes " +
                       id(found, symmetry.nodes[0]) + " and " + id(found, symmetry.nodes[1]) +
                       "; " + std::to_string(symmetry.n_unpaired) + " bonds without a partner");
    return result;
  }

  std::vector<std::string> body_verdicts(const Findings<2> &found)
  {
    const BodyCheck &body = *found.body;
    std::vector<std::string> result;
    if (const std::string text = weights_text(body); !text.empty())
      result.push_back(text);
    for (const CutFamilies &cut : body.families)
      if (cut.cut != FamilyCut::none)
        result.push_back(effect_text(cut, body));
    if (body.n_at_ends > 0)
      result.push_back(std::to_string(body.n_at_ends) +
                       (body.n_at_ends == 1 ? " pair of nodes touches" : " pairs of nodes touch") +
                       " the end of a crack and may have a bond or not");
    return result;
  }

  report::Table body_table(const Findings<2> &found)
  {
    report::Table table;
    table.columns = {"families",      "number",  "first: median", "first: worst", "second: median",
                     "second: worst", "at node", "visible/bulk",  "weights/bulk"};
    for (const CutFamilies &cut : found.body->families)
      table.rows.push_back(
          {report::text_cell(name(cut.cut)), report::count_cell(cut.n),
           report::error_cell(cut.median_first), report::error_cell(cut.first.value),
           report::error_cell(cut.median_second), report::error_cell(cut.second.value),
           report::text_cell(id(found, cut.second.node)), report::number_cell(cut.exact),
           report::number_cell(cut.given)});
    return table;
  }

  namespace
  {
    Json pairs_json(const Findings<2> &found, const std::vector<NodePair> &pairs)
    {
      Json all = Json::array();
      for (const NodePair &one : pairs)
        all.push_back({found.nodes.id[one.node], found.nodes.id[one.neighbour]});
      return all;
    }

    Json families_json(const Findings<2> &found, const CutFamilies &cut)
    {
      const auto moments = [&](double median, const meshfree::Worst &worst)
      {
        return Json{{"median", median},
                    {"worst", {{"value", worst.value}, {"node", found.nodes.id[worst.node]}}}};
      };
      Json json = {{"cut", word(cut.cut)},
                   {"n", cut.n},
                   {"first_moments", moments(cut.median_first, cut.first)},
                   {"second_moments", moments(cut.median_second, cut.second)},
                   {"visible_over_bulk", {{"median", cut.exact}, {"least", cut.least_exact}}},
                   {"weights_over_bulk", {{"median", cut.given}, {"least", cut.least_given}}}};
      for (const meshfree::ElasticRange &one : cut.elastic)
        json["elastic"][one.name] = {
            {"least", one.least}, {"median", one.median}, {"largest", one.largest}};
      return json;
    }
  } // namespace

  std::string body_json(const Findings<2> &found)
  {
    const BodyCheck &body = *found.body;
    const meshfree::FoundCorrection &correction = body.correction;
    Json json = {{"n_families", body.n_families}, {"n_bonds", body.n_bonds}};
    json["families"] = Json::array();
    for (const CutFamilies &cut : body.families)
      json["families"].push_back(families_json(found, cut));
    json["correction"] = {
        {"name", word(correction.correction)},
        {"volume", correction.size.name.empty() ? Json() : Json(correction.size.name)},
        {"difference_before", correction.before},
        {"difference_after", correction.after}};
    json["crossing"] = pairs_json(found, body.crossing);
    json["missing"] = pairs_json(found, body.missing);
    json["different"] = Json::array();
    for (const NodePair &one : body.different)
      json["different"].push_back({{"node", found.nodes.id[one.node]},
                                   {"neighbour", found.nodes.id[one.neighbour]},
                                   {"factor", one.factor}});
    json["n_compared"] = body.n_compared;
    json["n_at_ends"] = body.n_at_ends;
    return json.dump();
  }
} // namespace plumbline::check
