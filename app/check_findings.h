#pragma once

#include "algebra/spectrum.h"
#include "check.h"
#include "meshfree/check/bond_check.h"
#include "meshfree/check/bond_file.h"
#include "meshfree/check/bond_hypotheses.h"
#include "meshfree/check/bond_outliers.h"
#include "meshfree/check/volume_check.h"
#include "scene/scene.h"

#include <map>
#include <memory>

namespace plumbline::app
{
  /// A level of a scene, and what led to it.
  struct ChosenLevel
  {
    problem::Level level;
    std::string series;
    double node_size; ///< spacing of the nodes in Ω: √ of the mean area of their cells [length]

    std::string text() const;
  };

  /// What one case of the scene shows.
  struct CaseCheck
  {
    std::string name, reference;
    std::string failure;                  ///< empty: there is a solution
    std::map<std::string, double> errors; ///< by "norm | target"
    std::map<std::string, double> reference_errors;
  };

  /// All that is found of the weights of another code.
  struct Findings
  {
    std::string scene_name, purpose;
    meshfree::GivenNodes nodes;
    std::shared_ptr<const geometry::NodeCells> cells;
    meshfree::GivenFamilies given;
    std::vector<std::int64_t> ids;      ///< of the nodes, numbered as the cells
    std::vector<double> volumes;        ///< of the nodes as given, numbered as the cells
    std::vector<double> mended_volumes; ///< as the cells' areas tell, numbered as the cells
    double volume_factor = 1;           ///< of the volumes, see meshfree::VolumeCheck
    meshfree::Precision precision;      ///< of the files
    std::vector<std::string> notes;     ///< how files were read that are not plain CSV
    std::size_t n_on_boundary;          ///< free nodes on the boundary of Ω
    ChosenLevel level;
    double volume_defect; ///< of the free nodes' volumes against their cells' area, relative
    meshfree::MomentCheck moments;
    meshfree::WeightCheck weights;
    meshfree::SymmetryCheck symmetry;
    algebra::MatrixCheck matrix;
    std::string matrix_failure; ///< empty: there is a matrix that can be factorised
    std::string rule; ///< of ours that the weights are, once their list is mended; empty: none
    bool is_mended = false; ///< the rule is that of the weights with structural causes undone
    double rule_factor = 1;
    std::string rule_remark; ///< what else there is to say of the rule
    std::vector<meshfree::Cause> causes;
    std::vector<meshfree::Outlier> outliers; ///< volumes first
    std::vector<CaseCheck> cases;

    std::string id(std::size_t node) const { return std::to_string(ids[node]); }
  };

  /// @note Collective: the solutions are shared among the ranks.
  Findings find(scene::Scene scene, const CheckOptions &options);
} // namespace plumbline::app
