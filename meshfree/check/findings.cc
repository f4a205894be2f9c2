#include "meshfree/check/findings.h"

#include "base/error.h"
#include "meshfree/check/bond_ramp.h"
#include "meshfree/check/images.h"
#include "meshfree/check/sizes.h"
#include "meshfree/discretisations.h"

#include <algorithm>
#include <optional>

namespace plumbline::meshfree
{
  namespace
  {
    /// The families with the volumes of their neighbours.
    template <int dim>
    std::vector<Family<dim>> with_volumes(std::vector<Family<dim>> families,
                                          const std::vector<double> &volumes)
    {
      for (Family<dim> &family : families)
        for (std::size_t k = 0; k < family.bonds.size(); ++k)
          family.bonds[k].area = volumes[family.neighbours[k]];
      return families;
    }

    /// Volumes and weights that belong together, and the rule of ours that the weights are.
    template <int dim>
    struct Recognition
    {
      std::vector<double> volumes;       ///< that the weights were made with, as far as it is known
      std::vector<Family<dim>> families; ///< with those; empty: as found, of mended volumes
      std::optional<Recognised<dim>> rule;
    };

    /// Volumes that are wrong are mended first: were they left as they are, the weights to those
    /// nodes would seem wrong as well, though they may be right. If no rule of ours is recognised
    /// then, the weights may be made with the wrong volumes.
    template <int dim>
    Recognition<dim> recognise_weights(const Findings<dim> &found, const Kernel<dim> &kernel)
    {
      Recognition<dim> result;
      std::vector<double> as_given = found.volumes;
      for (double &volume : as_given)
        volume /= found.volume_factor;
      using Volumes = const std::vector<double> *;
      for (const Volumes volumes : {&found.mended_volumes, static_cast<Volumes>(&as_given)})
      {
        std::vector<Family<dim>> families; // a copy of all only where it is another
        if (volumes == &as_given)
          families = with_volumes(found.given.families, *volumes);
        auto rule =
            recognise(GivenBonds<dim>{volumes == &as_given ? families : found.given.families,
                                      kernel,
                                      *found.cells,
                                      *volumes,
                                      found.precision,
                                      {},
                                      found.lattice});
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
    template <int dim>
    void add_outliers(Findings<dim> &found, const std::vector<Outlier<dim>> &outliers)
    {
      const std::vector<Outlier<dim>> volumes = found.outliers;
      for (const Outlier<dim> &one : outliers)
        if (std::none_of(volumes.begin(), volumes.end(),
                         [&](const Outlier<dim> &volume)
                         {
                           return (one.defect == Defect::neighbour && one.node == volume.node) ||
                                  (one.defect == Defect::weight && one.neighbour == volume.node);
                         }))
          found.outliers.push_back(one);
    }

    /// Weights as they stand, for what names their defects.
    template <int dim>
    void find_causes(Findings<dim> &found, const Kernel<dim> &kernel,
                     const std::vector<std::string> &meant)
    {
      const Recognition<dim> recognition = recognise_weights(found, kernel);
      const GivenBonds<dim> given{recognition.families.empty() ? found.given.families
                                                               : recognition.families,
                                  kernel,
                                  *found.cells,
                                  recognition.volumes,
                                  found.precision,
                                  found.nodes.origin,
                                  found.lattice};
      const Explanation<dim> explanation =
          explain(given, recognition.rule,
                  Circumstances<dim>{meant, found.volume_factor, found.given.of_collar});
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
          found.rule_remark = ramp_text(ramp_effects(given, given.families), measure<dim>());
      }
      if (found.is_mended)
        return; // single bonds cannot be judged yet
      double point_scale = 1;
      for (const Cause &cause : found.causes)
        point_scale *= cause.point_scale;
      add_outliers(found, find_outliers(given, recognition.rule, point_scale));
    }

    /// Volumes against the areas of cells, which come before all that is relative to volumes.
    template <int dim>
    void find_volumes(Findings<dim> &found, const Kernel<dim> &kernel,
                      const std::vector<double> &uncut_areas, double spacing)
    {
      found.precision = Precision::of_files(found.nodes.rounding, found.given.weight_rounding,
                                            found.nodes.volume_rounding, spacing, kernel.horizon());
      const VolumeCheck<dim> volumes =
          check_volumes(GivenBonds<dim>{found.given.families, kernel, *found.cells, found.volumes,
                                        found.precision},
                        uncut_areas);
      found.volume_factor = volumes.factor;
      found.outliers = volumes.outliers;
      found.mended_volumes = volumes.mended;
      found.given.families = with_volumes(std::move(found.given.families), found.mended_volumes);
      for (CollarBond<dim> &one : found.given.of_collar)
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

  template <int dim>
  Findings<dim> find_defects(GivenWeights<dim> given, const Kernel<dim> &kernel,
                             const std::vector<double> &uncut_areas, double spacing,
                             const std::vector<std::string> &meant)
  {
    Findings<dim> found;
    static_cast<GivenWeights<dim> &>(found) = std::move(given);
    find_volumes(found, kernel, uncut_areas, spacing);
    const std::vector<Family<dim>> &families = found.given.families;
    found.moments = check_moments(families, kernel);
    found.elastic = elastic_ranges(families, kernel);
    found.weights = check_weights(families, kernel, found.mended_volumes);
    found.symmetry = found.nodes.box
                         ? check_symmetry(without_images(families, found.nodes, *found.cells),
                                          kernel, found.mended_volumes)
                         : check_symmetry(families, kernel, found.mended_volumes);
    find_causes(found, kernel, meant);
    return found;
  }

  void check_matrix(const problem::Problem<2> &problem, Findings<2> &found)
  {
    try
    {
      const FamilySource<2> source = [&](std::size_t i, Family<2> &family)
      { family = found.given.families[i]; };
      found.matrix = algebra::check_matrix(
          scattered_operator(source, problem, {0, found.cells->n_free}).rows.free);
    }
    catch (const NumericalError &error)
    {
      found.matrix_failure = error.what(); // weights may be wrong enough for rows to be empty
    }
  }

  template Findings<2> find_defects(GivenWeights<2>, const Kernel<2> &, const std::vector<double> &,
                                    double, const std::vector<std::string> &);
  template Findings<3> find_defects(GivenWeights<3>, const Kernel<3> &, const std::vector<double> &,
                                    double, const std::vector<std::string> &);
} // namespace plumbline::meshfree
