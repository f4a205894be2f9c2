#pragma once

#include "analysis/fracture.h"
#include "method/breakable_body.h"
#include "scene/scene.h"
#include "uq/spectrum.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>

// How a crack grows in equilibrium: run, found out and held against what is expected.
namespace plumbline::study
{
  using GrowthModel = method::BreakableBody;

  struct GrowthPlan
  {
    problem::FractureSettings rules;
    std::string subject;              ///< of checkpoints: what grows
    std::filesystem::path checkpoint; ///< its file
  };

  /// Let it grow, from the plan's checkpoint if there is one of the same subject, and write
  /// checkpoints on the way: the result has the same bits wherever it was stopped.
  /// @throws InputError  a checkpoint that cannot be read or written
  /// @throws NumericalError  as analysis::grow
  analysis::Growth run_growth(const GrowthModel &model, const GrowthPlan &plan);

  /// A side between the cells of two next neighbours whose bond broke.
  struct CrackSide
  {
    std::array<dealii::Point<2>, 2> ends;
    std::size_t event = 0;
    bool is_joined = false; ///< to the notch, by others in the end
  };

  /// Where a crack went. It is where next neighbours have parted: sides of cells that hang together
  /// with the notch, at their ends or from one row to the next.
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

  /// Bonds that broke whose mirror images about y = `middle` did not, or are none.
  std::size_t n_unpaired(const GrowthModel &model, const std::vector<std::size_t> &broken,
                         double middle);

  /// What a crack has broken of a material, a phase or an interface of one toughness.
  struct BrokenPart
  {
    double toughness = 0; ///< G [force/length]
    std::size_t n_bonds = 0;
    double length = 0; ///< of a straight crack that breaks as many bonds
  };

  /// By toughness, the weakest first.
  std::vector<BrokenPart> broken_parts(const GrowthModel &model,
                                       const std::vector<std::size_t> &broken);

  /// Bonds that a straight crack along a row of nodes breaks for each column of them: 18 at m = 3.
  double bonds_across(const GrowthModel &model);

  /// A picture of the body, after so many events.
  struct GrowthMoment
  {
    std::size_t n_events = 0;
    double load = 0;
    std::vector<double> damage;
  };

  constexpr std::size_t n_growth_moments = 6;

  /// After even parts of all broken bonds, from none to all.
  std::vector<GrowthMoment> growth_moments(const GrowthModel &model,
                                           const std::vector<analysis::Event> &events);

  struct GrowthResults
  {
    std::string scene_name, purpose, method, model; ///< model: bond-based, or LPS
    std::string scene_text;                         ///< the scene as read, all keys
    scene::RandomSection random;                    ///< with its seed, realisation and values
    problem::FractureSettings rules;
    double h = 0, horizon = 0;
    double lattice_toughness = 0; ///< energy of all bonds across a straight line, over G
    double trapping = 1;          ///< G was divided by this, see problem::Criterion
    double plane_modulus = 0;     ///< mean of E/(1 - nu²) over the nodes [force/length²]
    std::vector<BrokenPart> parts;
    std::vector<dealii::Point<2>> nodes;
    std::vector<double> toughness;        ///< see GrowthModel
    std::optional<uq::Spectrum> spectrum; ///< of a random field of modes
    dealii::Point<2> notch_tip;
    dealii::Point<2> origin; ///< that places count from, see scene::DomainSection
    std::size_t n_bonds = 0, n_unknowns = 0;
    analysis::Growth growth;
    method::QuasistaticFractureModel::Work work;
    double seconds = 0; ///< CPU time since it was taken up
    CrackPath path;
    std::vector<GrowthMoment> moments;
    std::size_t n_unpaired = 0;
    std::vector<std::string> warnings; ///< e.g. of what the nodes do not see

    std::size_t n_broken() const;
    double advance() const; ///< of the tip, from the notch's
    /// The event with the largest reaction before it; 0 where there is none.
    std::size_t peak() const;
    double largest_imbalance() const, largest_residual() const;
    /// Of broken bonds, and of all that was released, per length of the path.
    /// (G_1 L_1 + G_2 L_2 + G_i L_i) / W, lengths by counts of bonds and W the path's width: Fan et
    /// al. 2022, doi:10.1016/j.cma.2022.115340, eq. (5.2) [force/length]. NaN without a path.
    double toughness_by_bonds() const;
    /// What bonds held and what was released, over W: above the material's where growth is
    /// unstable, for then more is released than bonds take. NaN without a path.
    double toughness_by_energy() const;
    /// G of the body's phases, the weaker one first: two, or one where G is the same everywhere;
    /// none where it has more values than that [force/length].
    std::vector<double> phases() const;
    /// One of scene::growth_quantities; K = √(G E/(1 - nu²)), the modulus' mean (ibid., (5.3)).
    /// L1, L2 and Li are lengths of the crack within phase 1, within phase 2 and of bonds between
    /// the two, by counts of bonds (ibid., (5.2)) [length]: of one phase L1 is all, and NaN without
    /// phases.
    double quantity(const std::string &name) const;

  private:
    /// Of broken bonds of this toughness, as a straight crack has them [length].
    double length(double of_toughness) const;
  };

  /// What does not hold of a scene's expectations, and of the audit: work = stored + in bonds +
  /// released to 1e-10, where forces have an energy. One sentence each.
  std::vector<std::string> growth_faults(const GrowthResults &results,
                                         const scene::ExpectedSection &expected);

  /// What is not in the model, for reports.
  std::vector<std::string> left_out_of_growth(const problem::FractureSettings &rules);
} // namespace plumbline::study
