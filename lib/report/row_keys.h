#pragma once

#include "report/json_keys.h"
#include "study/standing_crack.h"

// The keys of rows that journals keep, see row_journal.h.
namespace plumbline::method
{
  template <typename Archive>
  void visit(Archive &a, RiceStrip &strip)
  {
    a("n_height", strip.n_height);
    a("n_length", strip.n_length);
    a("n_crack", strip.n_crack);
    a("h", strip.h);
    a("K_tip", strip.K_tip);
  }

  template <typename Archive>
  void visit(Archive &a, StripState &state)
  {
    a("energy", state.energy);
    a("intact", state.intact);
    a("at_end", state.at_end);
    a("opening", state.opening);
    a("n_unknowns", state.n_unknowns);
  }
} // namespace plumbline::method

namespace plumbline::study
{
  /// Which one it is.
  template <typename Archive, typename Row>
  void visit_place(Archive &a, Row &row)
  {
    a("method", row.method);
    a("side", row.family);
    a("series", row.series);
    a("h", row.h);
    a("horizon", row.horizon);
  }

  template <typename Archive>
  void visit(Archive &a, StripGrowth &growth)
  {
    a("peak", growth.peak);
    a("mean", growth.mean);
    a("released", growth.released);
    a("bonds", growth.bonds);
  }

  template <typename Archive>
  void visit(Archive &a, StripRow &row)
  {
    visit_place(a, row);
    a("strip", row.strip);
    a("state", row.state);
    a("release", row.release);
    a("growth", row.growth);
    a("seconds", row.seconds);
    a("failure", row.failure);
  }
} // namespace plumbline::study
