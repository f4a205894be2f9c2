#pragma once

#include "meshfree/check/bond_outliers.h"

namespace plumbline::meshfree
{
  /// What is wrong with the volumes of nodes: a factor that all carry, and outliers.
  template <int dim>
  struct VolumeCheck
  {
    /// The volumes are the cells' areas times this: 1, or what a third of the free nodes share, to
    /// rounding, or the median where it is far outside of their spread.
    double factor = 1;
    std::vector<Outlier<dim>> outliers; ///< Defect::volume, the largest distance first
    std::vector<double> mended;         ///< from the cells' areas, shape (n_nodes) [length^dim]
  };

  /// Holds volumes against the areas of Voronoi cells, cut at the boundary of Ω or not, or against
  /// one volume for all, whichever fits most nodes. Nodes of Ω whose volume is neither are named,
  /// each alone, or many where three of five nodes agree with their cells to rounding: bands of
  /// nodes with another volume, more than 1 % off. In the collar, whose outermost cells have no
  /// area of their own, the latter only where three of five volumes are one number.
  /// @param given        the volumes are those of the file
  /// @param uncut_areas  of the Voronoi cells that the boundary of Ω does not cut
  template <int dim>
  VolumeCheck<dim> check_volumes(const GivenBonds<dim> &given,
                                 const std::vector<double> &uncut_areas);

  /// Interprets a factor of volumes: "as ...", the thickness of a plate or other units of length.
  /// @param size  of a cell in space, whose area may have been given as its volume [length]
  std::string unit_text(double factor, int dim = 2, double size = 0);
} // namespace plumbline::meshfree
