#pragma once

#include "algebra/spectrum.h"
#include "meshfree/check/bond_check.h"
#include "meshfree/check/bond_file.h"
#include "meshfree/check/bond_hypotheses.h"
#include "meshfree/check/bond_outliers.h"
#include "meshfree/check/elastic_check.h"
#include "meshfree/check/volume_check.h"
#include "problem/problem.h"

#include <memory>

namespace plumbline::meshfree
{
  /// Weights of another code, in arrays: what find_defects takes.
  template <int dim>
  struct GivenWeights
  {
    GivenNodes<dim> nodes;
    std::shared_ptr<const geometry::NodeCells<dim>> cells; ///< of the nodes, by their places
    GivenFamilies<dim> given;
    std::vector<double> volumes; ///< of the nodes as given, numbered as the cells
    double lattice = 0;          ///< spacing, see GivenBonds
  };

  /// All that is found of the weights of another code, whatever is solved with them.
  template <int dim>
  struct Findings : GivenWeights<dim>
  {
    std::vector<double> mended_volumes; ///< as the cells' areas tell, numbered as the cells
    double volume_factor = 1;           ///< of the volumes, see VolumeCheck
    double volume_defect = 0; ///< of the free nodes' volumes against their cells' area, relative
    Precision precision;      ///< of the data
    MomentCheck moments;
    std::vector<ElasticRange> elastic; ///< empty for scalar kernels
    WeightCheck weights;
    SymmetryCheck symmetry;
    static constexpr bool has_matrix = dim == 2; ///< in space its factorisation would be too large
    algebra::MatrixCheck matrix;
    std::string matrix_failure; ///< empty: there is a matrix that can be factorised
    std::string rule; ///< of ours that the weights are, once their list is mended; empty: none
    bool is_mended = false; ///< the rule is that of the weights with structural causes undone
    double rule_factor = 1;
    std::string rule_remark; ///< what else there is to say of the rule
    std::vector<Cause> causes;
    std::vector<Outlier<dim>> outliers; ///< volumes first
  };

  /// All but the matrix.
  /// @param uncut_areas  of the nodes' cells before they are clipped to Ω [length^dim]
  /// @param spacing      of the nodes [length]
  /// @param meant        names of the rules that the weights are meant to be; empty: not known
  template <int dim>
  Findings<dim> find_defects(GivenWeights<dim> given, const Kernel<dim> &kernel,
                             const std::vector<double> &uncut_areas, double spacing,
                             const std::vector<std::string> &meant);

  /// Adds what the matrix of these weights tells.
  /// @param problem  on the cells of the nodes
  void check_matrix(const problem::Problem<2> &problem, Findings<2> &found);
} // namespace plumbline::meshfree
