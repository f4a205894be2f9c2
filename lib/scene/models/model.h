#pragma once

#include "scene/capabilities.h"
#include "scene/problem.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace plumbline::scene
{
  class Keys;

  /// Keys with their values.
  using Settings = std::vector<std::pair<std::string, std::string>>;

  /// What a body is made of, a value of Material/model: one file of this folder and a row of
  /// models().
  class Model
  {
  public:
    virtual ~Model() = default;
    virtual std::string name() const = 0;
    virtual std::string help() const = 0; ///< what it is, behind its name
    virtual Capabilities can() const = 0;

    /// What a scene needs since it is of this model.
    virtual Capabilities needs(const Scene &) const { return {}; }

    /// What scenes of it begin with, by the name of their template.
    virtual std::map<std::string, Settings> templates() const = 0;

    /// Keys of section Material that no model before it in models() has.
    virtual void declare(Keys &, MaterialSection &) const {}

    /// Kernel/type is its influence function and u has a component for each axis; else the kernel
    /// is all of it.
    virtual bool takes_influence() const { return true; }

    /// It has λ and μ, given by one pair of keys.
    virtual bool is_state_based() const { return false; }

    /// Dilatations count in a scene of it, so that data reach twice as far.
    virtual bool has_dilatation(const Scene &) const { return false; }

    virtual bool is_linear() const { return true; } ///< its force, in u

    /// What follows "Material/model = NAME" where λ and μ are given or missing against
    /// is_state_based().
    virtual std::string constants() const = 0;

    /// Of λ and μ at both ends of a bond.
    virtual physics::Mean mean() const { return physics::Mean::arithmetic; }

    /// @throws InputError  constants that it cannot have, though solids can
    virtual void check(const physics::Lame &, bool /*is_homogeneous*/) const {}

    /// @throws InputError  what does not fit together where it moves
    virtual void check_motion(const Scene &) const {}

    /// Of its bonds, of small strains where it is not linear.
    virtual physics::Kernel<2> kernel(const Scene &scene, double horizon) const = 0;

    /// What a problem has of it besides.
    virtual void complete(const Scene &, const Level &, Problem &) const {}

    /// Its constants, what they are and their values, for reports of motions.
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
  std::vector<Capable> capable_models();
} // namespace plumbline::scene
