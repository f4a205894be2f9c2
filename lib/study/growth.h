#pragma once

#include "analysis/fracture.h"
#include "method/breakable_body.h"
#include "scene/scene.h"
#include "study/analysis.h"

#include <array>
#include <optional>
#include <string>

// How a crack grows in equilibrium: run, found out and held against what is expected.
namespace plumbline::study
{
  using GrowthModel = method::BreakableBody<2>;

  struct GrowthPlan
  {
    problem::FractureSettings rules;
    std::string subject; ///< of checkpoints: what grows
    Checkpoints checkpoints;
  };

  /// Let it grow, from the plan's checkpoint if there is one of the same subject, and write
  /// checkpoints on the way: the result has the same bits wherever it was stopped.
  /// @throws InputError  a checkpoint that cannot be read or written
  /// @throws NumericalError  as analysis::grow; Interrupted
  analysis::Growth run_growth(method::QuasistaticFractureModel &body, const GrowthPlan &plan);

  /// A side between the cells of two next neighbours whose bond broke.
  struct CrackSide
  {
    std::array<dealii::Point<2>, 2> ends;
    std::size_t event = 0;
    bool is_joined = false; ///< to the notch, by others in the end
    std::size_t joined = 0; ///< the event after which it is joined, if it is
  };

  /// Where a crack begins in a body without a notch: the middle of the first side whose next
  /// neighbours part; nothing where none do.
  std::optional<dealii::Point<2>> find_nucleus(const GrowthModel &model,
                                               const std::vector<analysis::Event> &events);

  /// Where a crack went. It is where next neighbours have parted, on scattered nodes those whose
  /// Voronoi cells share a side: sides of cells that hang together with the notch, at their ends or
  /// from one row to the next; without a notch, with the first side.
  struct CrackPath
  {
    std::vector<std::array<dealii::Point<2>, 2>> notch; ///< sides that it cuts
    std::vector<CrackSide> sides;                       ///< as they broke
    std::vector<dealii::Point<2>> tips; ///< after each event: the end that is farthest from the
                                        ///< notch's tip, or that tip
    std::size_t n_elsewhere = 0;        ///< sides apart from the crack
    double width = 0; ///< of all sides, joined or not, projected onto the x-axis, once each
  };
  CrackPath find_path(const GrowthModel &model, const std::vector<analysis::Event> &events);

  // Instantiated for dim = 2 and 3.

  /// A place on a body's lattice, in half mesh sizes from its first node.
  template <int dim>
  using LatticePlace = std::array<long, dim>;
  template <int dim>
  LatticePlace<dim> lattice_place(const method::BreakableBody<dim> &model,
                                  const dealii::Point<dim> &x);

  /// Broken bonds whose mirror image about the plane axis = middle is intact or does not exist.
  template <int dim>
  std::size_t n_unpaired(const method::BreakableBody<dim> &model,
                         const std::vector<std::size_t> &broken, unsigned int axis, double middle);

  /// What a crack has broken of a material, a phase or an interface of one toughness.
  struct BrokenPart
  {
    double toughness = 0; ///< G [force/length]
    std::size_t n_bonds = 0;
    double length = 0; ///< of a straight crack that breaks as many bonds; in space its area
  };

  // Instantiated for dim = 2 and 3.

  /// By toughness, the weakest first.
  template <int dim>
  std::vector<BrokenPart> broken_parts(const method::BreakableBody<dim> &model,
                                       const std::vector<std::size_t> &broken);

  /// Number of bonds that a crack normal to y breaks per column of nodes: 18 at m = 3 with full
  /// areas; on scattered nodes per h of its length; in space per node of the crack plane, averaged
  /// over the thickness.
  template <int dim>
  double bonds_across(const method::BreakableBody<dim> &model);

  /// A picture of the body, after so many events.
  struct GrowthMoment
  {
    std::size_t n_events = 0;
    double load = 0;
    std::vector<double> damage;
  };

  constexpr std::size_t n_growth_moments = 6;

  /// After even parts of all broken bonds, from none to all. Instantiated for dim = 2 and 3.
  template <int dim>
  std::vector<GrowthMoment> growth_moments(const method::BreakableBody<dim> &model,
                                           const std::vector<analysis::Event> &events);

  /// A growth, and the results that the plane and space have in common.
  template <int dim>
  struct CommonFindings
  {
    analysis::Growth growth;
    std::vector<GrowthMoment> moments;
    std::vector<BrokenPart> parts;
    std::vector<dealii::Point<dim>> nodes;
    dealii::Point<2> notch_tip;
  };

  /// The results in the plane.
  struct GrowthFindings : CommonFindings<2>
  {
    CrackPath path;
    std::vector<double> toughness;         ///< see GrowthModel
    dealii::Point<2> origin;               ///< that places count from, see scene::DomainSection
    double plane_modulus = 0;              ///< mean of E/(1 - nu²) over the nodes [force/length²]
    std::optional<std::size_t> n_unpaired; ///< on a lattice
  };

  /// The same as a record.
  ///
  /// Scalars: scene::growth_quantities, as far as they are known. By G of bonds and lengths L by
  /// counts of bonds, "G by bonds" is (G_1 L_1 + G_2 L_2 + G_i L_i) / W with W the path's width:
  /// Fan et al. 2022, doi:10.1016/j.cma.2022.115340, eq. (5.2) [force/length]; "G by energy" is
  /// what bonds held and what was released, over W: above the material's where growth is unstable,
  /// for then more is released than bonds take. K = √(G E/(1 - nu²)), the modulus' mean (ibid.,
  /// (5.3)). "L1", "L2" and "Li" are lengths of the crack within phase 1, the weaker one, within
  /// phase 2 and of bonds between the two (ibid., (5.2)) [length]: of one phase L1 is all; where G
  /// has more than two values there are no phases. "first break" and
  /// "first advance" are loads of the first broken bond, in event 0, and of the first event after
  /// which the tip is not the notch's, the "first advance event". "width", "apart", "reaction
  /// left", under dead loads "load left", and others. Without a notch "nucleus x" and "nucleus y"
  /// are where the crack begins, see find_nucleus. Texts: "end" and "connected". Curves: "events",
  /// "broken" (their bonds), "sides" and "notch", "moments" of the components of the field
  /// "damage", "parts" and "phases". Field "G" where it varies.
  Record growth_record(Record record, const GrowthFindings &found);

  /// Where a crack begins in space without a notch: as in the plane, in the first layer z = const
  /// of nodes, from below, in which next neighbours part. What parts across z alone is not seen.
  std::optional<dealii::Point<3>> find_nucleus(const method::BreakableBody<3> &model,
                                               const std::vector<analysis::Event> &events);

  /// Where a crack went in space. In each layer z = const of nodes it is the path of those bonds
  /// that lie in it, see CrackPath; the front is the line through the tips of all layers.
  struct CrackFront
  {
    std::vector<double> z;                ///< of the layers, ascending [length]
    std::vector<CrackPath> layers;        ///< of each
    std::vector<std::vector<double>> way; ///< of the tips from the notch's, after each event, shape
                                          ///< (n_events, n_layers) [length]
    double area = 0; ///< of all separated sides, projected onto the x-z plane [length^2]
    std::size_t n_elsewhere = 0; ///< sides apart from the crack
  };
  CrackFront find_front(const method::BreakableBody<3> &model,
                        const std::vector<analysis::Event> &events);

  /// The results in space.
  struct FrontFindings : CommonFindings<3>
  {
    CrackFront front;
    std::optional<dealii::Point<3>> nucleus; ///< without a notch
    double h = 0;
    std::size_t n_unpaired_in_y = 0, n_unpaired_in_z = 0;
  };

  /// The same as a record: as growth_record, without what exists in the plane only (K, phases).
  ///
  /// Scalars: "advance", "advance min" and "advance max" are the mean, minimum and maximum
  /// advance over the front's layers, from the notch tip [length]; "area" in place of the width
  /// [length^2]; "unpaired" about the middle of y and "unpaired in z" about the middle of the
  /// thickness; without a notch "nucleus x", "nucleus y" and "nucleus z". Curves: "events" with
  /// "way", "way min" and "way max" of the front; "front" with the advance of each layer at the
  /// moments; "sides" with z. Field "damage" is that of the layer in the middle of the thickness,
  /// the lower one of two.
  Record growth_record(Record record, const FrontFindings &found);

  /// The forces of a record's body have no energy: its text "surface terms" says so.
  bool is_corrected(const Record &record);

  /// Expected/growth and growth ends; and what is never right, where forces have an energy: work
  /// that differs from stored + in bonds + released by more than 1e-10 of it.
  std::vector<Expectation> check_crack_growth(const Record &record,
                                              const scene::ExpectedSection &expected);

  /// What is not in the model of a record, for reports.
  std::vector<std::string> left_out_of_growth(const Record &record);

  /// A record is of a body in space.
  bool is_in_space(const Record &record);

  constexpr auto scattered_nodes = "scattered"; ///< text "nodes" of a record
  bool is_scattered(const Record &record);
} // namespace plumbline::study
