#pragma once

#include "report/json_keys.h"
#include "study/dispersion.h"
#include "study/stability.h"
#include "study/standing_crack.h"

// The keys of rows that journals keep, see row_journal.h.
namespace plumbline::report
{
  /// Which one it is.
  template <typename Archive, typename Row>
  void visit_place(Archive &a, Row &row)
  {
    a("method", row.method);
    a("side", row.side);
    a("series", row.series);
    a("h", row.h);
    a("horizon", row.horizon);
  }

  template <typename Archive>
  void visit(Archive &a, analysis::Modes &modes)
  {
    std::vector<double> places; // shape (n_nodes, 2)
    for (const dealii::Point<2> &node : modes.nodes)
      places.insert(places.end(), {node[0], node[1]});
    a("components", modes.n_components);
    a("places", places);
    a("values", modes.values);
    modes.nodes.resize(places.size() / 2);
    for (std::size_t i = 0; i < modes.nodes.size(); ++i)
      modes.nodes[i] = {places[2 * i], places[2 * i + 1]};
  }

  template <typename Archive>
  void visit(Archive &a, algebra::Eigenvalues &eigenvalues)
  {
    a("smallest_real", eigenvalues.smallest_real);
    a("smallest_modulus", eigenvalues.smallest_modulus);
    a("largest_modulus", eigenvalues.largest_modulus);
    a("largest_imaginary", eigenvalues.largest_imaginary);
    a("n_computed", eigenvalues.n_computed);
  }

  template <typename Archive>
  void visit(Archive &a, algebra::SignCheck &signs)
  {
    a("n_positive", signs.n_positive);
    a("n_weak", signs.n_weak);
    a("n_loose", signs.n_loose);
    a("n_parts", signs.n_parts);
    a("asymmetry", signs.asymmetry);
  }

  template <typename Archive>
  void visit(Archive &a, analysis::Stability &stability)
  {
    a("n_unknowns", stability.n_unknowns);
    a("smallest", stability.smallest);
    a("largest", stability.largest);
    a("n_zero", stability.n_zero);
    a("modes", stability.modes);
    a("eigenvalues", stability.eigenvalues);
    a("has_signs", stability.has_signs);
    a("signs", stability.signs);
    a("inverse_norm", stability.inverse_norm);
    a("is_norm_exact", stability.is_norm_exact);
    a("diagnostics", stability.diagnostics);
  }

  template <typename Archive>
  void visit(Archive &a, analysis::Consistency &consistency)
  {
    a("n_inner", consistency.n_inner);
    a("degree", consistency.degree);
    a("barrier", consistency.barrier);
  }

  template <typename Archive>
  void visit(Archive &a, study::CriticalSteps &steps)
  {
    a("density", steps.density);
    a("largest", steps.largest);
    a("largest_lumped", steps.largest_lumped);
    a("is_oscillating", steps.is_oscillating);
  }

  template <typename Archive>
  void visit(Archive &a, study::StabilityRow &row)
  {
    visit_place(a, row);
    a("value", row.value);
    a("stability", row.stability);
    a("consistency", row.consistency);
    a("steps", row.steps);
    a("seconds", row.seconds);
    a("failure", row.failure);
  }

  template <typename Archive>
  void visit(Archive &a, study::WaveSample &sample)
  {
    a("k", sample.k);
    a("phase", sample.phase);
    a("group", sample.group);
    a("exact_phase", sample.exact_phase);
    a("exact_group", sample.exact_group);
  }

  template <typename Archive>
  void visit(Archive &a, study::WaveCurve &curve)
  {
    a("polarisation", curve.polarisation);
    a("angle", curve.angle);
    a("local_speed", curve.local_speed);
    a("long_wave_error", curve.long_wave_error);
    a("longest", curve.longest);
    a("samples", curve.samples);
  }

  template <typename Archive>
  void visit(Archive &a, algebra::SymbolRange &range)
  {
    a("least", range.least);
    a("largest", range.largest);
  }

  template <typename Archive>
  void visit(Archive &a, study::DispersionRow &row)
  {
    visit_place(a, row);
    a("value", row.value);
    a("curves", row.curves);
    a("anisotropy", row.anisotropy);
    a("range", row.range);
    a("round_off", row.round_off);
    a("limit", row.limit);
    a("seconds", row.seconds);
    a("failure", row.failure);
  }

  template <typename Archive>
  void visit(Archive &a, method::RiceStrip &strip)
  {
    a("n_height", strip.n_height);
    a("n_length", strip.n_length);
    a("n_crack", strip.n_crack);
    a("h", strip.h);
    a("K_tip", strip.K_tip);
  }

  template <typename Archive>
  void visit(Archive &a, method::StripState &state)
  {
    a("energy", state.energy);
    a("intact", state.intact);
    a("at_end", state.at_end);
    a("opening", state.opening);
    a("n_unknowns", state.n_unknowns);
  }

  template <typename Archive>
  void visit(Archive &a, study::StripGrowth &growth)
  {
    a("peak", growth.peak);
    a("mean", growth.mean);
    a("released", growth.released);
    a("bonds", growth.bonds);
  }

  template <typename Archive>
  void visit(Archive &a, study::StripRow &row)
  {
    visit_place(a, row);
    a("strip", row.strip);
    a("state", row.state);
    a("release", row.release);
    a("growth", row.growth);
    a("seconds", row.seconds);
    a("failure", row.failure);
  }
} // namespace plumbline::report
