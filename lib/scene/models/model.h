#pragma once

#include "scene/capabilities.h"
#include "scene/problem.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plumbline::scene
{
  class Keys;

  /// Keys with their values.
  using Settings = std::vector<std::pair<std::string, std::string>>;

  /// A constitutive model, a value of Material/model: one file of this folder and a row of
  /// models().
  class Model
  {
  public:
    virtual ~Model() = default;
    virtual std::string name() const = 0;
    virtual std::string help() const = 0; ///< description that follows its name
    virtual Capabilities can() const = 0;
    virtual Capabilities can_in_space() const { return can(); } ///< with Domain/dimension = 3

    /// Capabilities that scenes of this model need.
    virtual Capabilities needs(const Scene &) const { return {}; }

    /// Settings of its scene templates, by the template's name.
    virtual std::map<std::string, Settings> templates() const = 0;

    /// Declares the keys of section Material that no earlier model of models() has.
    virtual void declare(Keys &, MaterialSection &) const {}

    /// Kernel/type is its influence function and u is a vector; else the kernel defines the model.
    virtual bool takes_influence() const { return true; }

    /// Its constants are λ and μ, given by one pair of keys.
    virtual bool is_state_based() const { return false; }

    /// Its forces depend on the dilatation, so that data are needed within twice the horizon.
    virtual bool has_dilatation(const Scene &) const { return false; }

    virtual bool is_linear() const { return true; } ///< its force depends linearly on u

    /// Ends the message "Material/model = NAME..." where constants are missing, or given that it
    /// does not take.
    virtual std::string constants() const = 0;

    /// Mean of λ and μ at the two ends of a bond.
    virtual physics::Mean mean() const { return physics::Mean::arithmetic; }

    /// @throws InputError  constants that this model does not admit
    virtual void check(const physics::Lame &, bool /*is_homogeneous*/) const {}

    /// @throws InputError  constants of section Material that do not fit the others of the scene
    virtual void check_constants(const Scene &) const {}

    /// @throws InputError  keys that are inconsistent in a transient analysis
    virtual void check_motion(const Scene &) const {}

    /// Kernel of its bonds; of a nonlinear model, linearised at zero strain.
    virtual physics::Kernel<2> kernel(const Scene &scene, double horizon) const = 0;

    /// The same in space.
    /// @throws InputError  the model is of the plane
    virtual physics::Kernel<3> kernel_in_space(const Scene &scene, double horizon) const;

    /// What its dilatation adds in space; empty: bonds only.
    virtual std::optional<physics::Dilatation<3>> dilatation_in_space(const Scene &,
                                                                      double /*horizon*/) const
    {
      return {};
    }

    /// Adds the model's other data to a problem.
    virtual void complete(const Scene &, const Level &, Problem &) const {}

    /// The constants of its bonds that follow from Material/E, with units, as pairs of description
    /// and value.
    virtual std::vector<std::pair<std::string, std::string>>
    derived_constants(const Scene &, double /*horizon*/) const
    {
      return {};
    }

    /// Its constants as pairs of description and value, for transient reports.
    virtual std::vector<std::pair<std::string, std::string>> facts(const Scene &,
                                                                   double /*horizon*/) const
    {
      return {};
    }
  };

  const Model &bond_based();
  const Model &lps();
  const Model &variational();
  const Model &double_well();

  /// All of them; a new one is one file and one row here.
  const std::vector<const Model *> &models();

  /// For capability_table.
  std::vector<Capable> capable_models(bool is_in_space = false);
} // namespace plumbline::scene
