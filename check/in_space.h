#pragma once

#include "check/requirements.h"
#include "meshfree/check/weights_in_space.h"

namespace plumbline::check
{
  /// What is found of weights in space: moments, elastic constants, pairs, and on lattices whose
  /// rule they are.
  struct InSpace : meshfree::FindingsInSpace
  {
    meshfree::WeightsInSpace given;
    problem::Level level;                ///< of the scene
    std::vector<std::string> complaints; ///< what makes the exit code 1
    std::string assumed;                 ///< see assumptions()
  };

  /// @pre     scene.domain.is_in_space()
  /// @throws InputError  files that cannot be used; nodes whose spacing no level of the scene has
  InSpace find_in_space(const scene::Scene &scene, const Input &input,
                        const Requirements &required);

  /// The findings as a record, for other programs.
  study::Record record_of(const InSpace &found);

  /// For people; the answer last.
  std::string text(const InSpace &found);

  extern const char *const not_checked_in_space; ///< a sentence for the end of texts

  /// For programs, as lib/io/results.schema.json describes it.
  std::string to_json(const InSpace &found, const scene::Scene &scene);
} // namespace plumbline::check
