#include "base/error.h"
#include "physics/expression.h"
#include "scene/keys.h"
#include "scene/problem_sections.h"

#include <sstream>

namespace plumbline::base
{
  template <>
  inline constexpr auto words<physics::PlaneState> = std::array{"strain", "stress"};
} // namespace plumbline::base

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
      if (material.model == Model::lps && !material.is_homogeneous && !(lame.lambda > 0))
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
          message << "; give constants that are right at every point, for each phase its own";
        throw InputError(message.str());
      }
    };
    if (is_homogeneous)
      return [lame = at({})](const Point<2> &) { return lame; };
    return at;
  }

  void MaterialSection::declare(Keys &by_name)
  {
    by_name.add(
        "model", model,
        "bond-based: the kernel is all. LPS: the linear peridynamic solid, with harmonic means of "
        "lambda and of mu at both ends of a bond. variational: constants at one point. double "
        "well: "
        "bonds that soften and break (Jha & Lipton 2018), of c, beta and the boundary function, "
        "for motions (Time/final time). All three take Kernel/type as their influence function, "
        "with Kernel/limit = Navier.");
    by_name.add("plane", plane, "Plane strain or plane stress, for E and nu.");
    by_name.add("E", given[0][0],
                "Young's modulus > 0, an expression in x and y. [force/length^2]");
    by_name.add("nu", given[0][1], "Poisson's ratio, -1 < nu < 1/2, given with E.");
    by_name.add("lambda", given[1][0],
                "Lame's first constant in the plane, instead of E and nu. [force/length^2]");
    by_name.add("mu", given[1][1],
                "The shear modulus > 0, given with lambda, which is > -mu. [force/length^2]");
    by_name.add("collar dilatation", has_collar_dilatation, "zero", "from data",
                "theta in the collar, of state-based solids on scattered nodes: from data, or "
                "zero, which is wrong and there to show by how much.");
    by_name.add("c", c, any_number(),
                "Of double wells f(s) = c (1 - exp(-beta s)): the energy of a broken bond, > 0. "
                "[force/length]");
    by_name.add("beta", beta, any_number(), "Of double wells, > 0. [1/length]");
    by_name.add("boundary function", boundary_function,
                "omega of double wells: one, or smoothstep, t^2 (3 - 2t) with t = min(1, distance "
                "to the boundary / horizon), which lets bonds fade out there.");
    by_name.add("k", given[2][0],
                "lambda + mu > 0 of the variational model, instead. [force/length^2]");
    by_name.add("l", given[2][1], "8 mu > 0, given with k. [force/length^2]");
  }

  void MaterialSection::complete()
  {
    unsigned int n_pairs = 0;
    for (unsigned int i = 0; i < pairs.size(); ++i)
    {
      const bool is_first_empty = given[i][0].empty();
      if (is_first_empty != given[i][1].empty())
        throw InputError("Material/" + pairs[i][is_first_empty ? 1 : 0] + " needs Material/" +
                         pairs[i][is_first_empty ? 0 : 1] + ", which is empty");
      if (is_first_empty)
        continue;
      ++n_pairs;
      keys = pairs[i];
      expressions = given[i];
    }
    if (n_pairs != (is_state_based() ? 1 : 0))
      throw InputError("Material/model = " + base::word(model) +
                       (is_state_based()
                            ? " needs its constants once: E and nu, lambda and mu, or k and l"
                        : is_double_well()
                            ? " has the constants c and beta; clear Material/E, nu, lambda, mu, k "
                              "and l"
                            : " takes its constants from the kernel; clear Material/E, nu, lambda, "
                              "mu, k and l, or choose LPS or variational"));
    if (!is_state_based())
      return;
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
