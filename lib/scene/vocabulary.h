#pragma once

#include "problem/capabilities.h"
#include "problem/fracture.h"
#include "problem/level.h"
#include "problem/surface_terms.h"

// Words of problems that scene text uses.
namespace plumbline::scene
{
  using problem::all_but;
  using problem::all_capabilities;
  using problem::BondToughness;
  using problem::BreakMode;
  using problem::Capabilities;
  using problem::Capability;
  using problem::Capable;
  using problem::Criterion;
  using problem::GrowthEnd;
  using problem::GrowthSolver;
  using problem::Level;
  using problem::of_damage;
  using problem::of_meshes;
  using problem::Series;
  using problem::Stretch;
  using problem::SurfaceTerms;
} // namespace plumbline::scene
