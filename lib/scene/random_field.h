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

  /// The random field R of a scene over the bounding box of its domain; outside the box it has the
  /// value at the nearest point. Files are read by the constructor; other data that all
  /// realisations share are computed when first needed, once for all copies of the scene.
  class RandomField
  {
  public:
    using Place = std::function<double(const dealii::Point<2> &)>;

    /// @param box     domain of the field [length]
    /// @param folder  to which file names are relative
    /// @throws InputError  parameters or files that do not define a field
    RandomField(const RandomSection &section, const geometry::Box &box, const std::string &folder);

    /// R for standard normal variables, one for each mode, or, without modes, the realisation of
    /// this number: with n files, realisations 1, 2, ..., n, and 1 again after n. Computed when
    /// first evaluated; thread-safe.
    Place at(const std::vector<double> &modes, unsigned int realisation) const;

    /// Its modes; null without modes.
    /// @throws InputError, NumericalError  they cannot be computed
    const uq::Expansion *expansion() const;

  private:
    struct Shared;
    std::shared_ptr<Shared> shared_;
  };
} // namespace plumbline::scene
