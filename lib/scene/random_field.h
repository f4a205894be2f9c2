#pragma once

#include "geometry/lattice.h"
#include "uq/ellipses.h"
#include "uq/expansion.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::scene
{
  struct RandomSection;

  /// The random field R of a scene over the bounding box of its domain; beyond it R is what it is
  /// at the nearest point. Files are read at once; what else all realisations share is made when
  /// it is first needed, once for all copies of the scene.
  class RandomField
  {
  public:
    using Place = std::function<double(const dealii::Point<2> &)>;

    /// @param box     that it fills [length]
    /// @param folder  that names of files begin in
    /// @throws InputError  numbers or files that make no field
    RandomField(const RandomSection &section, const geometry::Box &box, const std::string &folder);

    /// R for standard normal variables, one for each mode, or of the realisation of this number
    /// where it is drawn whole: of n files, realisations 1, 2, ..., n, and 1 again after n. Made
    /// when it is first evaluated; threads may share it.
    Place at(const std::vector<double> &modes, unsigned int realisation) const;

    /// Its modes; nothing where it is drawn whole.
    /// @throws InputError, NumericalError  they cannot be found
    const uq::Expansion *expansion() const;

  private:
    struct Shared;
    std::shared_ptr<Shared> shared_;
  };
} // namespace plumbline::scene
