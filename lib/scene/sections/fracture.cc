#include "base/error.h"
#include "scene/fracture_section.h"
#include "scene/keys.h"
#include "scene/values.h"

#include <cmath>
#include <map>

namespace plumbline::scene
{
  namespace
  {
    const std::map<std::string, SurfaceTerms> surface_aliases = {{"yes", SurfaceTerms::published},
                                                                 {"no", SurfaceTerms::uncorrected}};
  }

  void FractureSection::declare(Keys &keys)
  {
    keys.add(
        "toughness", toughness,
        "Fracture toughness G > 0 (energy per unit area of crack), an expression in x and y. Each "
        "bond has the mean of G at its two ends (Fracture/toughness of bonds) and breaks at the "
        "critical stretch s0, s0^2 = pi G / (3 delta (lambda + mu)) for the influence function "
        "1/r. 'plumbline grow' runs the scene. Empty: nothing breaks. [force/length]");
    keys.add(
        "toughness of bonds", of_bonds,
        "mean: the mean of G at the two ends of a bond; features between nodes are not resolved. "
        "minimum: the smallest G at sample points along the bond, eight per mesh size; weak "
        "lines and layers then weaken all bonds that cross them.");
    keys.add(
        "interfaces", "", scene::lines(),
        [this](const std::string &text) { interfaces = to_lines(text, scene::lines()); },
        "Lines with a strength of their own, written like Domain/cracks: bonds across them have "
        "the G of Fracture/interface toughness, whatever it is on both sides; across several, the "
        "smallest. [length]");
    keys.add("interface toughness", interface_toughness, positive_numbers(),
             "G of each of Fracture/interfaces, separated by ',', or one for all. [force/length]");
    keys.add("criterion", criterion,
             "toughness: the stretch s0 of G in the continuum. On a lattice a crack is trapped "
             "between rows, and needs more (1.32 G for OPT and m = 3). calibrated: s0 over the "
             "square root of that, found by one growth in a strip of eight horizons with the same "
             "rule and m, so that a crack goes on at G.");
    keys.add("breaking", breaking,
             "events: the bond that is next and its ties, at its exact load; there is no load "
             "step. batches: all that are over-stretched at the load of an event. steps: the same "
             "at multiples of Fracture/load step.");
    keys.add("stretch", stretch, "linear: xi.du/|xi|^2. finite: |xi + du|/|xi| - 1.");
    keys.add(
        "surface terms", base::word(surface_terms),
        one_of({"automatic", "published", "none", "consistent", "uncorrected", "yes", "no"}),
        [this](const std::string &text)
        {
          const auto alias = surface_aliases.find(text);
          surface_terms =
              alias == surface_aliases.end() ? *base::from_word<SurfaceTerms>(text) : alias->second;
        },
        "Forces at free surfaces and crack faces. uncorrected (or no): none, dilatations of "
        "incomplete families as they are, and the forces have an energy. none, published (or yes), "
        "consistent: as Material/surface terms. A crack goes on at a smaller load with the pair "
        "terms. No energy has these forces, so that there is no energy balance, and an event takes "
        "some GMRES iterations. automatic: Material/surface terms, or uncorrected where that is "
        "automatic too.");
    keys.add("solver", solver,
             "factor: a Cholesky factor, and Woodbury's formula for bonds that broke since. "
             "multigrid: conjugate gradients with ML's smoothed aggregation, which takes less "
             "memory and more time; for linear stretches without surface terms. automatic: factor "
             "where it fits.");
    keys.add("load step", load_step, any_number(),
             "Of breaking = steps: by how much the load grows. The load is the factor of "
             "Problem/constraint, which says what the grips do at 1.");
    keys.add(
        "largest load", none, any_text(),
        [this](const std::string &text) {
          largest_load = text == none ? std::numeric_limits<double>::infinity() : to_number(text);
        },
        "Where growth ends, or none: it goes on.");
    keys.add("least reaction", least_reaction, between(0, 1),
             "Growth ends where the grips' reaction falls below so much of the largest so far.");
    keys.add("ties", tie_tolerance, between(0, .1),
             "Bonds whose loads differ by so little, relatively, break together: mirror images "
             "do, whatever rounding says of them.");
    keys.add(
        "unbreaking", "", scene::boxes(),
        [this](const std::string &text) { unbreaking = to_boxes(text); },
        "Boxes, written like Domain/boxes: bonds with an end in them do not break. Near grips "
        "stresses are high, and bonds would break there first. [length]");
    keys.add("checkpoint interval", interval, count(1, 100000),
             "Events between checkpoints; a run that was killed goes on from the last one.");
  }

  void FractureSection::complete(SurfaceTerms of_material)
  {
    if (surface_terms == SurfaceTerms::automatic)
      surface_terms =
          of_material == SurfaceTerms::automatic ? SurfaceTerms::uncorrected : of_material;
    else if (is_there() && of_material != SurfaceTerms::automatic && of_material != surface_terms)
      throw InputError("Fracture/surface terms = " + base::word(surface_terms) +
                       " contradicts Material/surface terms = " + base::word(of_material) +
                       "; give one of the two keys, or the same value to both");
    const auto require =
        [](bool is_good, const std::string &key, double value, const std::string &otherwise)
    {
      if (!is_good)
        throw InputError("Fracture/" + key + " = " + short_number(value) + " " + otherwise);
    };
    require(breaking != BreakMode::steps || (load_step > 0 && std::isfinite(load_step)),
            "load step", load_step,
            "must be positive where Fracture/breaking = steps; give the growth of the load, or "
            "write events, which need none");
    if (solver == GrowthSolver::multigrid && !can_iterate())
      throw InputError("Fracture/solver = multigrid does not find pieces that turn about a node, "
                       "where finite stretches and surface terms mean nothing; write "
                       "Fracture/solver = factor, or stretch = linear and surface terms = "
                       "uncorrected");
    if (interface_toughness.size() != interfaces.size() &&
        (interfaces.empty() || interface_toughness.size() != 1))
      throw InputError("Fracture/interface toughness has " +
                       std::to_string(interface_toughness.size()) +
                       " values and Fracture/interfaces has " + std::to_string(interfaces.size()) +
                       " lines; give one value for each line, or one for all");
    require(largest_load > 0, "largest load", largest_load,
            "must be positive; none: growth goes on");
  }
} // namespace plumbline::scene
