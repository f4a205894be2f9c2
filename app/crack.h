#pragma once

#include "measures.h"
#include "scene/scene.h"
#include "study/crack.h"

namespace plumbline::app
{
  struct CrackOptions : MeasureOptions
  {
    bool check = false; ///< Expected/crack
  };

  /// Memory for the crack of a scene with a notched strip, and disk for its files.
  /// @param n_jobs  processes that each take the memory side by side (--jobs)
  /// @throws InputError  they are not there
  void check_crack_size(const scene::Scene &scene, unsigned int n_levels,
                        const std::filesystem::path &folder, unsigned int n_jobs = 1);

  /// The thresholds of all levels, and the crack's motion at the last one of the first series.
  /// @param folder  of its checkpoint, and of frames/ if there are some
  /// @param before_it_moves  called once nothing is refused any more
  study::CrackResults move_crack(const scene::Scene &scene, unsigned int n_levels,
                                 const std::filesystem::path &folder,
                                 const std::function<void()> &before_it_moves = {});

  /// Find the threshold of every level of a scene with a notched strip (section Crack), and let the
  /// crack move at the last one of the first series; print tables, write crack.html, .md and .json,
  /// crack/ with pictures, frames/ with states as VTU, and while it moves checkpoint.h5, from which
  /// the same command goes on after it was killed.
  /// @return  1 if check is set and the crack does not do what is expected, else 0
  /// @throws InputError  a scene that cannot be used, no room for its frames, a folder that cannot
  /// be written
  /// @throws NumericalError  the motion fails; pictures cannot be drawn, all else is written then
  int crack(const CrackOptions &options);
} // namespace plumbline::app
