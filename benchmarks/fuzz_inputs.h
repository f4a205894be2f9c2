#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace plumbline::benchmarks
{
  /// What an input is given to.
  enum class Reader
  {
    scene,      ///< .prm, with all checks of a scene
    json_scene, ///< the same in JSON
    mesh,       ///< .msh
    nodes,      ///< CSV of Methods/nodes, and of `plumbline check`
    bonds,      ///< CSV of `plumbline check`
    pictures,   ///< CSV of Random/files
    results,    ///< results.json
    script,     ///< .geo: what may be in it
    meshed,     ///< .geo: meshed by gmsh
    tetrahedra  ///< .msh in three dimensions
  };
  constexpr unsigned int n_readers = 10;

  /// The ending of its files, and how many of 1000 inputs it gets: processes are dear.
  struct Share
  {
    const char *name, *ending;
    unsigned int per_mille;
  };
  constexpr Share shares[n_readers] = {{"scene", ".prm", 300},   {"json scene", ".json", 100},
                                       {"mesh", ".msh", 200},    {"nodes", ".csv", 80},
                                       {"bonds", ".csv", 80},    {"pictures", ".csv", 40},
                                       {"results", ".json", 59}, {"script", ".geo", 100},
                                       {"meshed", ".geo", 1},    {"tetrahedra", ".msh", 40}};

  /// Sound inputs of each reader.
  using Corpus = std::vector<std::vector<std::string>>;

  /// From the shipped scenes, a mesh of each version, and results of two runs.
  /// @throws std::runtime_error  scenes not there
  Corpus make_corpus(const std::string &scenes);

  struct Input
  {
    Reader reader;
    std::string text;
  };

  /// The same for the same seed and corpus: a sound text, changed up to six times: numbers into
  /// strange ones, words into other words, lines moved, doubled, deleted or taken from another
  /// text, characters repeated to depth, bytes changed.
  Input make_input(const Corpus &corpus, std::uint64_t seed);
} // namespace plumbline::benchmarks
