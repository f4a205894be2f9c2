#pragma once

#include "io/record_keys.h"
#include "io/study_keys.h"
#include "study/results.h"

// The keys of results.json. Each stands here once; the same list writes and reads.
namespace plumbline::method
{
  template <typename Archive>
  void visit(Archive &a, TipForce &force)
  {
    a("tip", force.tip);
    a("force", force.force);
    a("sum_of_norms", force.sum_of_norms);
    a("norm", force.norm);
    a("over_root_horizon", force.over_root);
  }

  template <typename Archive>
  void visit(Archive &a, Diagnostics &diagnostics)
  {
    a("n_neighbours", diagnostics.n_neighbours);
    a("smallest_weight_ratio", diagnostics.smallest_weight_ratio);
    a("n_negative_weights", diagnostics.n_negative_weights);
    a("n_conditions", diagnostics.n_conditions);
    a("rank", diagnostics.rank);
    a("smallest_singular_value", diagnostics.smallest_singular_value);
    a("relative_residual", diagnostics.relative_residual);
    a("operator_backend", diagnostics.operator_backend);
    a("n_geometry_checks", diagnostics.n_geometry_checks);
    a("geometry_difference", diagnostics.geometry_difference);
    a("outer_change", diagnostics.outer_change);
    a("is_outer_error_known", diagnostics.is_outer_error_known);
    a("n_refinements", diagnostics.n_refinements);
    a("limit", diagnostics.limit);
    a("tip_forces", diagnostics.tip_forces);
    a("notes", diagnostics.notes);
  }
} // namespace plumbline::method

namespace plumbline::study
{
  template <typename Archive>
  void visit(Archive &a, Run &run)
  {
    a("method", run.method);
    a("family", run.family);
    a("problem", run.problem);
    a("series", run.series);
    a("level", run.level);
    a("h", run.h);
    a("horizon", run.horizon);
    a("value", run.value);
    a("cost", run.cost);
    a("geometry_seconds", run.geometry_seconds);
    a("diagnostics", run.diagnostics);
    a("size", run.size);
    a("round_off", run.round_off);
    a("area", run.area);
    a("errors", run.errors);
    a("failure", run.failure);
  }

  template <typename Archive>
  void visit(Archive &a, ErrorEstimate &estimate)
  {
    a("problem", estimate.problem);
    a("series", estimate.series);
    a("method", estimate.method);
    a("level", estimate.level);
    a("h", estimate.h);
    a("horizon", estimate.horizon);
    a("h_change", estimate.h_change);
    a("p_change", estimate.p_change);
    a("outer_change", estimate.outer_change);
    a("estimate", estimate.estimate);
    a("certified_digits", estimate.certified_digits);
    a("n_geometry_checks", estimate.n_geometry_checks);
    a("geometry_difference", estimate.geometry_difference);
    a("coarse_change", estimate.coarse_change);
    a("rate", estimate.rate);
    a("field_h_change", estimate.field_h_change);
    a("field_coarse_change", estimate.field_coarse_change);
    a("field_p_change", estimate.field_p_change);
    a("field_rate", estimate.field_rate);
    a("field_estimate", estimate.field_estimate);
    a("is_of_polygon", estimate.is_of_polygon);
  }

  template <typename Archive>
  void visit(Archive &a, Omission &omission)
  {
    a("what", omission.what);
    a("why", omission.why);
    a("saving", omission.saving);
  }

  template <typename Archive>
  void visit(Archive &a, Saving &saving)
  {
    a("method", saving.method);
    a("h", saving.h);
    a("horizon", saving.horizon);
    a("smallest", saving.smallest);
    a("full", saving.full);
    a("difference", saving.difference);
  }

  template <typename Archive>
  void visit(Archive &a, Choice &choice)
  {
    a("target", choice.target);
    a("method", choice.method);
    a("h", choice.h);
    a("error", choice.error);
    a("seconds", choice.seconds);
    a("tied", choice.tied);
  }

  template <typename Archive>
  void visit(Archive &a, Advice &advice)
  {
    a("problem", advice.problem);
    a("series", advice.series);
    a("choices", advice.choices);
    a("stalling", advice.stalling);
    a("field_only", advice.field_only);
  }

  template <typename Archive>
  void visit(Archive &a, ErrorMap &map)
  {
    a("method", map.method);
    a("problem", map.problem);
    a("series", map.series);
    a("quantity", map.quantity);
    a("h", map.h);
    a("horizon", map.horizon);
    a("lower", map.lower);
    a("upper", map.upper);
    a("n_x", map.n_x);
    a("n_y", map.n_y);
    a("size", map.size);
    a("values", map.values);
  }

  template <typename Archive>
  void visit(Archive &a, Results &results)
  {
    a("scene_name", results.scene_name);
    a("purpose", results.purpose);
    a("regime", results.regime);
    a("variable", results.variable);
    a("decisive_error", results.decisive_error);
    a("is_complete", results.is_complete);
    a("provenance", results.provenance);
    a("trends", results.trends);
    a("advice", results.advice);
    a("references", results.references);
    a("estimates", results.estimates);
    a("expectations", results.expectations);
    a("omissions", results.omissions);
    a("maps", results.maps);
    a("runs", results.runs);
    a("savings", results.savings);
    a("left_out", results.left_out);
    a("warnings", results.warnings);
    a("scene_text", results.scene_text);
  }
} // namespace plumbline::study
