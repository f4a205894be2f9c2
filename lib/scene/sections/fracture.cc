#include "base/error.h"
#include "scene/fracture_section.h"
#include "scene/keys.h"
#include "scene/values.h"

#include <cmath>

namespace plumbline::scene
{
  void FractureSection::declare(Keys &keys)
  {
    keys.add(
        "toughness", toughness,
        "Fracture toughness G > 0 (energy per unit area of crack), an expression in x and y (and z "
        "in three dimensions). Each "
        "bond has the mean of G at its two ends (Fracture/bond toughness) and breaks at the "
        "critical stretch s0 that the kernel gives: s0^2 = G / (4 beta (lambda + mu)) with beta "
        "the "
        "integral of K r^4 over r from 0 to delta, K the influence function with the integral of K "
        "|xi|^2 = 2; pi G / (3 delta (lambda + mu)) for 1/r, in three dimensions 5 G / (9 k delta) "
        "with the bulk modulus k. 'plumbline grow' runs the scene, with Time/final time as dynamic "
        "fracture. Empty: no bonds break. [force/length]");
    keys.add(
        "bond toughness", of_bonds,
        "mean: the mean of G at the two ends of a bond; features between nodes are not resolved. "
        "minimum: the smallest G at sample points along the bond, eight per mesh size; weak lines "
        "and layers weaken all bonds across them.");
    keys.add(
        "interfaces", "", scene::lines(),
        [this](const std::string &text) { interfaces = to_lines(text, scene::lines()); },
        "Interfaces with their own toughness, written like Domain/cracks: bonds across them have "
        "the G of Fracture/interface toughness, independent of G on either side; bonds across "
        "several have the smallest. [length]");
    keys.add("interface toughness", interface_toughness, positive_numbers(),
             "G of each line of Fracture/interfaces, separated by ',', or one value for all. "
             "[force/length]");
    keys.add(
        "criterion", criterion,
        "toughness: the critical stretch s0 of the continuum formula. On a lattice a crack is "
        "trapped between rows of nodes and needs more energy (1.32 G for OPT and m = 3). "
        "calibrated: s0 divided by the square root of this factor, which one simulation in a strip "
        "of eight horizons with the same rule and m determines, so that a crack propagates at G "
        "(two dimensions).");
    keys.add("breaking", breaking,
             "events: the next critical bond and its ties, at the exact critical load; no load "
             "step is needed. batches: all over-stretched bonds at the load of an event. steps: "
             "all over-stretched bonds at multiples of Fracture/load step.");
    keys.add("stretch", stretch, "linear: xi.du/|xi|^2. finite: |xi + du|/|xi| - 1.");
    keys.add("surface terms", surface_terms,
             "Forces at free surfaces and crack faces. uncorrected: no surface terms and "
             "uncorrected dilatations of incomplete families; the forces derive from an energy. "
             "none, published, consistent: as Material/surface terms. With the pair terms a crack "
             "propagates at a smaller load. These forces do not derive from an energy: there is no "
             "energy balance, and each event takes some GMRES iterations. automatic: "
             "Material/surface terms, or uncorrected if that is automatic too.");
    keys.add("solver", solver,
             "factor: a Cholesky factorisation with Woodbury updates for broken bonds. multigrid: "
             "conjugate gradients with ML's smoothed aggregation, which takes less memory and more "
             "time; for linear stretches without surface terms. automatic: factor if it fits into "
             "memory.");
    keys.add("load step", load_step, any_number(),
             "Load increment for Fracture/breaking = steps. The load is the factor of "
             "Problem/constraint, which gives the displacement of the grips at load 1.");
    keys.add(
        "max load", none, any_text(),
        [this](const std::string &text) {
          largest_load = text == none ? std::numeric_limits<double>::infinity() : to_number(text);
        },
        "The simulation ends at this load. none: no limit.");
    keys.add("min reaction", least_reaction, between(0, 1),
             "The simulation ends when the reaction force at the grips falls below this fraction "
             "of its maximum so far.");
    keys.add("ties", tie_tolerance, between(0, .1),
             "Bonds whose critical loads differ by less than this relative tolerance break "
             "together, so that symmetric bonds break together in spite of rounding.");
    keys.add(
        "no-fail zones", "", scene::boxes(),
        [this](const std::string &text) { unbreaking = to_boxes(text); },
        "Boxes 'x0, y0 : x1, y1', separated by ';', in three dimensions through the whole "
        "thickness: bonds with an end in them do not break. Stresses near "
        "grips are high, and bonds would break there first. [length]");
    keys.add("checkpoint interval", interval, count(1, 100000),
             "Number of events between checkpoints; an interrupted run resumes from the last one.");
  }

  void FractureSection::complete(SurfaceTerms of_material)
  {
    if (is_there() && of_material == SurfaceTerms::energy)
      throw InputError("Material/surface terms = energy is not implemented for fracture (section "
                       "Fracture); clear it, or write uncorrected as Fracture/surface terms, whose "
                       "forces derive from an energy, too");
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
            "must be positive if Fracture/breaking = steps; give the load increment, or write "
            "events, which need none");
    if (solver == GrowthSolver::multigrid && !can_iterate())
      throw InputError(
          "Fracture/solver = multigrid does not detect fragments that can rotate about a node, for "
          "which finite stretches and surface terms are undefined; write Fracture/solver = factor, "
          "or stretch = linear and surface terms = uncorrected");
    if (interface_toughness.size() != interfaces.size() &&
        (interfaces.empty() || interface_toughness.size() != 1))
      throw InputError("Fracture/interface toughness has " +
                       std::to_string(interface_toughness.size()) +
                       " values and Fracture/interfaces has " + std::to_string(interfaces.size()) +
                       " lines; give one value for each line, or one for all");
    require(largest_load > 0, "max load", largest_load, "must be positive; none: no limit");
  }
} // namespace plumbline::scene
