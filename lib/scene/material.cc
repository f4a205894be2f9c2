#include "scene/material.h"

#include "base/error.h"
#include "physics/expression.h"

#include <sstream>

namespace plumbline::scene
{
  namespace
  {
    using dealii::Point;
    using physics::Expression;
    using physics::Lame;

    const std::array<std::array<std::string, 2>, 3> pairs = {
        {{"E", "nu"}, {"lambda", "mu"}, {"k", "l"}}};

    Lame lame_from_lame(double lambda, double mu)
    {
      std::ostringstream message;
      if (!(mu > 0))
        message << "the shear modulus mu = " << mu << ", but it must be positive";
      else if (!(lambda + mu > 0))
        message << "lambda = " << lambda << ", but it must be larger than -mu = " << -mu;
      else
        return {lambda, mu};
      throw InputError(message.str());
    }

    Lame convert(const MaterialSection &material, double first, double second)
    {
      Lame lame{};
      if (material.keys[0] == "E")
        lame = physics::lame_from_young(first, second, material.plane);
      else if (material.keys[0] == "k")
        lame = physics::lame_from_bulk(first, second);
      else
        lame = lame_from_lame(first, second);
      if (material.model == "LPS" && !material.is_homogeneous && !(lame.lambda > 0))
      {
        std::ostringstream message;
        message << "lambda = " << lame.lambda
                << ", but harmonic means need it positive; choose constants with lambda > 0 (nu > "
                   "0), or Material/model = variational";
        throw InputError(message.str());
      }
      return lame;
    }
  } // namespace

  std::function<Lame(const Point<2> &)> MaterialSection::lame() const
  {
    const Expression first("Material/" + keys[0], expressions[0]),
        second("Material/" + keys[1], expressions[1]);
    const auto at = [material = *this, first, second](const Point<2> &x)
    {
      try
      {
        return convert(material, first(x), second(x));
      }
      catch (const InputError &error)
      {
        std::ostringstream message;
        message << "Material/" << material.keys[0] << " and " << material.keys[1];
        if (!material.is_homogeneous)
          message << " at (" << x << ")";
        message << ": " << error.what();
        throw InputError(message.str());
      }
    };
    if (is_homogeneous)
      return [lame = at({})](const Point<2> &) { return lame; };
    return at;
  }

  MaterialSection make_material(const std::function<std::string(const std::string &key)> &value)
  {
    MaterialSection material;
    material.model = value("Material/model");
    material.has_collar_dilatation = value("Material/collar dilatation") == "from data";
    material.plane = value("Material/plane") == "stress" ? physics::PlaneState::stress
                                                         : physics::PlaneState::strain;
    unsigned int n_pairs = 0;
    for (const auto &keys : pairs)
    {
      const std::array<std::string, 2> expressions = {value("Material/" + keys[0]),
                                                      value("Material/" + keys[1])};
      if (expressions[0].empty() != expressions[1].empty())
        throw InputError("Material/" + keys[expressions[0].empty() ? 1 : 0] + " needs Material/" +
                         keys[expressions[0].empty() ? 0 : 1] + ", which is empty");
      if (expressions[0].empty())
        continue;
      ++n_pairs;
      material.keys = keys;
      material.expressions = expressions;
    }
    if (n_pairs != (material.is_state_based() ? 1 : 0))
      throw InputError("Material/model = " + material.model +
                       (material.is_state_based()
                            ? " needs its constants once: E and nu, lambda and mu, or k and l"
                            : " takes its constants from the kernel; clear Material/E, nu, lambda, "
                              "mu, k and l, or choose LPS or variational"));
    if (!material.is_state_based())
      return material;
    for (unsigned int i = 0; i < 2; ++i)
    {
      const Expression expression("Material/" + material.keys[i], material.expressions[i]);
      if (expression.n_components() != 1)
        throw InputError("Material/" + material.keys[i] + " = '" + material.expressions[i] +
                         "' must be one expression");
      material.is_homogeneous = material.is_homogeneous && expression.is_constant();
    }
    if (material.is_homogeneous)
      (void)material.lame();
    return material;
  }

  std::optional<physics::Dilatation> make_dilatation(const Scene &scene, double horizon)
  {
    if (!scene.has_dilatation())
      return {};
    return physics::Dilatation{physics::influence_function(scene.kernel.profile, horizon),
                               scene.material.lame(), scene.material.model == "LPS",
                               scene.material.is_homogeneous};
  }
} // namespace plumbline::scene
