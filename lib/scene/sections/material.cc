#include "base/error.h"
#include "physics/elastic_constants.h"
#include "physics/expression.h"
#include "scene/keys.h"
#include "scene/models/model.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::scene
{
  namespace
  {
    using dealii::Point;
    using physics::Expression;
    using physics::Lame;

    using Pair = std::array<std::string, 2>;
    const Pair young = {"E", "nu"}, lame_constants = {"lambda", "mu"}, bulk = {"k", "l"};
    const std::array<Pair, 3> pairs = {young, lame_constants, bulk};

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
      if (material.keys == young)
        lame = physics::lame_from_young(first, second, material.plane);
      else if (material.keys == bulk)
        lame = physics::lame_from_bulk(first, second);
      else
        lame = lame_from_lame(first, second);
      material.model->check(lame, material.is_homogeneous);
      return lame;
    }
  } // namespace

  std::function<Lame(const Point<2> &)> MaterialSection::lame() const
  {
    const Expression first("Material/" + keys[0], expressions[0], names),
        second("Material/" + keys[1], expressions[1], names);
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
        if (!material.is_homogeneous)
          message << "; give constants that are admissible at every point, different ones for each "
                     "phase";
        throw InputError(message.str());
      }
    };
    if (is_homogeneous)
      return [lame = at({})](const Point<2> &) { return lame; };
    return at;
  }

  std::optional<double> MaterialSection::modulus_of_bonds(unsigned int dimension) const
  {
    constexpr double tolerance = 1e-3; // .333 is 1/3
    const auto &[E, nu] = given[0];
    if (E.empty())
      return {};
    const auto value_of = [this](const std::string &key, const std::string &text)
    {
      const Expression expression(key, text, names);
      if (expression.n_components() != 1 || !expression.is_constant())
        throw InputError(key + " = '" + text +
                         "' must be one number for Material/model = " + model->name());
      return expression(dealii::Point<2>());
    };
    const double modulus = value_of("Material/E", E);
    if (!(modulus > 0) || !std::isfinite(modulus))
      throw InputError("Material/E = " + E +
                       " must be positive and finite; give Young's modulus > 0");
    const bool is_stress = dimension == 2 && plane == physics::PlaneState::stress;
    const double nu_of_bonds = is_stress ? 1. / 3 : 1. / 4;
    if (!nu.empty() && !(std::abs(value_of("Material/nu", nu) - nu_of_bonds) <= tolerance))
      throw InputError(
          "Material/nu = " + nu + ": pairwise forces along bonds imply nu = " +
          (is_stress        ? "1/3 in plane stress; write Material/nu = 0.3333"
           : dimension == 2 ? "1/4 in plane strain (1/3 in plane stress); write Material/nu = 0.25"
                            : "1/4; write Material/nu = 0.25") +
          " or leave it empty. Another nu needs Material/model = LPS, which 'plumbline "
          "run' and, for quasi-static fracture, 'plumbline grow' support, and "
          "'plumbline crack' does not");
    if (dimension == 1)
      return modulus;
    return 3. / 5 *
           physics::bulk_modulus_of_bonds(modulus, is_stress ? physics::ElasticState::plane_stress
                                                             : physics::ElasticState::solid);
  }

  void MaterialSection::declare(Keys &by_name)
  {
    std::vector<std::string> names_of_models;
    std::string help;
    for (const Model *const one : models())
    {
      names_of_models.push_back(one->name());
      help += one->name() + ": " + one->help() + ". ";
    }
    by_name.add(
        "model", bond_based().name(), one_of(names_of_models),
        [this](const std::string &text)
        {
          model = *std::find_if(models().begin(), models().end(),
                                [&](const Model *one) { return one->name() == text; });
        },
        help + "All but the first use Kernel/type as the influence function, with Kernel/limit = "
               "Navier.");
    for (const Model *const one : models())
      one->declare(by_name, *this);
  }

  void MaterialSection::complete()
  {
    if (!model->is_state_based())
    {
      for (unsigned int i = 0; i < pairs.size(); ++i)
        for (unsigned int j = 0; j < 2; ++j)
          if (!given[i][j].empty() && (i > 0 || (j > 0 && given[i][0].empty())))
            throw InputError("Material/" + pairs[i][j] + " with Material/model = " + model->name() +
                             model->constants());
      return;
    }
    unsigned int n_pairs = 0;
    for (unsigned int i = 0; i < pairs.size(); ++i)
    {
      const bool is_first_empty = given[i][0].empty();
      if (is_first_empty != given[i][1].empty())
        throw InputError("Material/" + pairs[i][is_first_empty ? 1 : 0] + " needs Material/" +
                         pairs[i][is_first_empty ? 0 : 1] +
                         ", which is empty; give both, or neither");
      if (is_first_empty)
        continue;
      ++n_pairs;
      keys = pairs[i];
      expressions = given[i];
    }
    if (n_pairs != 1)
      throw InputError("Material/model = " + model->name() + model->constants());
    for (unsigned int i = 0; i < 2; ++i)
    {
      const Expression expression("Material/" + keys[i], expressions[i], names);
      if (expression.n_components() != 1)
        throw InputError("Material/" + keys[i] + " = '" + expressions[i] +
                         "' must be one expression");
      is_homogeneous = is_homogeneous && expression.is_constant();
    }
    if (is_homogeneous)
      (void)lame();
  }
} // namespace plumbline::scene
