#include "meshfree/check/findings.h"

#include "base/error.h"
#include "meshfree/check/bond_ramp.h"
#include "meshfree/check/images.h"
#include "meshfree/discretisations.h"

#include <algorithm>
#include <optional>

namespace plumbline::meshfree
{
  namespace
  {
    /// The families with the volumes of their neighbours.
    std::vector<Family<2>> with_volumes(std::vector<Family<2>> families,
                                        const std::vector<double> &volumes)
    {
      for (Family<2> &family : families)
        for (std::size_t k = 0; k < family.bonds.size(); ++k)
          family.bonds[k].area = volumes[family.neighbours[k]];
      return families;
    }

    /// Volumes and weights that belong together, and the rule of ours that the weights are.
    struct Recognition
    {
      std::vector<double> volumes; ///< that the weights were made with, as far as it is known
      std::vector<Family<2>> families;
      std::optional<Recognised> rule;
    };

    /// Volumes that are wrong are mended first: were they left as they are, the weights to those
    /// nodes would seem wrong as well, though they may be right. If no rule of ours is recognised
    /// then, the weights may be made with the wrong volumes.
    Recognition recognise_weights(const Findings &found, const problem::Problem<2> &problem)
    {
      Recognition result;
      std::vector<double> as_given = found.volumes;
      for (double &volume : as_given)
        volume /= found.volume_factor;
      using Volumes = const std::vector<double> *;
      for (const Volumes volumes : {&found.mended_volumes, static_cast<Volumes>(&as_given)})
      {
        std::vector<Family<2>> families = with_volumes(found.given.families, *volumes);
        auto rule =
            recognise({families, problem.kernel, *problem.cells(), *volumes, found.precision});
        if (!rule && !result.volumes.empty())
          break;
        result = {*volumes, std::move(families), std::move(rule)};
        if (result.rule || found.outliers.empty())
          break;
      }
      return result;
    }

    /// Adds outliers among bonds and nodes, except those that volumes explain: weights
    /// that were made with a volume that is wrong are all off by its factor.
    void add_outliers(Findings &found, const std::vector<Outlier> &outliers)
    {
      const std::vector<Outlier> volumes = found.outliers;
      for (const Outlier &one : outliers)
        if (std::none_of(volumes.begin(), volumes.end(),
                         [&](const Outlier &volume)
                         {
                           return (one.defect == Defect::neighbour && one.node == volume.node) ||
                                  (one.defect == Defect::weight && one.neighbour == volume.node);
                         }))
          found.outliers.push_back(one);
    }

    /// Weights as they stand, for what names their defects.
    void find_causes(Findings &found, const problem::Problem<2> &problem,
                     const std::vector<std::string> &meant)
    {
      const Recognition recognition = recognise_weights(found, problem);
      const GivenBonds given{recognition.families, problem.kernel,  *problem.cells(),
                             recognition.volumes,  found.precision, found.nodes.origin};
      const Explanation explanation =
          explain(given, recognition.rule, {meant, found.volume_factor, found.given.of_collar});
      found.causes = explanation.causes;
      found.is_mended = std::any_of(found.causes.begin(), found.causes.end(),
                                    [](const Cause &cause) { return cause.is_structural; });
      if (const auto &rule = found.is_mended ? explanation.rule : recognition.rule)
      {
        found.rule = rule->rule;
        found.rule_factor = rule->factor;
        const bool is_meant = std::find(meant.begin(), meant.end(), "FA") != meant.end();
        if (rule->is_full_area() && !is_meant && found.causes.empty() &&
            found.moments.typical() > found.precision.moments)
          found.rule_remark = ramp_text(ramp_effects(given, given.families));
      }
      if (found.is_mended)
        return; // single bonds cannot be judged yet
      double point_scale = 1;
      for (const Cause &cause : found.causes)
        point_scale *= cause.point_scale;
      add_outliers(found, find_outliers(given, recognition.rule, point_scale));
    }

    /// Volumes against the areas of cells, which come before all that is relative to volumes.
    void find_volumes(Findings &found, const problem::Problem<2> &problem,
                      const std::vector<double> &uncut_areas, double spacing)
    {
      found.precision =
          Precision::of_files(found.nodes.rounding, found.given.weight_rounding,
                              found.nodes.volume_rounding, spacing, problem.horizon());
      const VolumeCheck volumes = check_volumes(
          {found.given.families, problem.kernel, *problem.cells(), found.volumes, found.precision},
          uncut_areas);
      found.volume_factor = volumes.factor;
      found.outliers = volumes.outliers;
      found.mended_volumes = volumes.mended;
      found.given.families = with_volumes(std::move(found.given.families), found.mended_volumes);
      for (CollarBond &one : found.given.of_collar)
        one.bond.area = found.mended_volumes[one.neighbour];
      double volume = 0, area = 0;
      for (std::size_t i = 0; i < found.cells->n_free; ++i)
      {
        volume += found.volumes[i];
        area += found.cells->area[i];
      }
      found.volume_defect = volume / area - 1;
    }
  } // namespace

  Findings find_defects(GivenWeights given, const problem::Problem<2> &problem,
                        const std::vector<double> &uncut_areas, double spacing,
                        const std::vector<std::string> &meant)
  {
    Findings found;
    static_cast<GivenWeights &>(found) = std::move(given);
    find_volumes(found, problem, uncut_areas, spacing);
    const std::vector<Family<2>> &families = found.given.families;
    found.moments = check_moments(families, problem.kernel);
    found.elastic = elastic_ranges(families, problem.kernel);
    found.weights = check_weights(families, problem.kernel, found.mended_volumes);
    found.symmetry = check_symmetry(
        found.nodes.box ? without_images(families, found.nodes, *found.cells) : families,
        problem.kernel, found.mended_volumes);
    find_causes(found, problem, meant);
    try
    {
      const FamilySource<2> source = [&](std::size_t i, Family<2> &family)
      { family = families[i]; };
      found.matrix = algebra::check_matrix(
          scattered_operator(source, problem, {0, found.cells->n_free}).rows.free);
    }
    catch (const NumericalError &error)
    {
      found.matrix_failure = error.what(); // weights may be wrong enough for rows to be empty
    }
    return found;
  }
} // namespace plumbline::meshfree
