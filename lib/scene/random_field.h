#pragma once

#include "geometry/lattice.h"
#include "random/ellipses.h"
#include "random/expansion.h"

#include <functional>
#include <memory>
#include <optional>

namespace plumbline::scene
{
  struct RandomSection;

  /// The random field R of a scene over the bounding box of its domain; beyond it R is what it is
  /// at the nearest point. What all realisations share is made when it is first needed, once for
  /// all copies of the scene.
  class RandomField
  {
  public:
    using Place = std::function<double(const dealii::Point<2> &)>;

    /// @throws InputError  numbers that make no field
    RandomField(const RandomSection &section, const geometry::Box &box);

    /// R for standard normal variables, one for each mode, or of the realisation of this number
    /// where it is drawn whole. Made when it is first evaluated; threads may share it.
    Place at(const std::vector<double> &modes, unsigned int realisation) const;

    /// Its modes; nothing where it is drawn whole.
    /// @throws InputError, NumericalError  they cannot be found
    const random::Expansion *expansion() const;

  private:
    struct Shared;
    std::shared_ptr<Shared> shared_;
  };
} // namespace plumbline::scene
