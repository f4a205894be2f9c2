#pragma once

#include "scene/scene.h"
#include "study/sampling.h"

namespace plumbline::study
{
  /// Mean and deviation of the field that a scene's decisive error is held against, shape
  /// (n_places, n_components), and their own L2 uncertainty.
  struct ExactStatistics
  {
    std::vector<double> mean, deviation; ///< this is empty where it is not known
    double mean_uncertainty = 0, deviation_uncertainty = 0;
  };

  /// By many Gauss points in each variable, without any solve: Problem/solution or Problem/local
  /// solution at every one of them. The uncertainty is the change from three quarters as many, at
  /// some of the places.
  /// @param one  of a sample, whose places are taken; its level says where averages are
  /// @throws InputError  the target is not finite at such a point, which may be far out
  /// @return nothing where the target is no expression, or there are more than three variables, or
  /// a field that is drawn whole
  std::optional<ExactStatistics> exact_statistics(const scene::Scene &scene, const Record &one);

  /// The same at other places: averages over squares, each about its place, from others', by the
  /// areas that they share.
  /// @throws InputError  places that stand for areas of several sizes
  ExactStatistics at_places(const ExactStatistics &statistics, const analysis::PointField &from,
                            const analysis::PointField &to);
} // namespace plumbline::study
