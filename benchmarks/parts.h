#pragma once

namespace plumbline::benchmarks
{
  void register_operators(); ///< applications, by every road
  void register_families();  ///< ball ∩ cell, rules on lattices and on scattered nodes
  void register_assembly();  ///< Galerkin entries: lattices, pairs of cells, whole meshes
} // namespace plumbline::benchmarks
