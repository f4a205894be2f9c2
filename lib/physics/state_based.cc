#include "physics/state_based.h"

#include "base/error.h"

#include <sstream>

namespace plumbline::physics
{
  namespace
  {
    [[noreturn]] void refuse(const std::string &what, double value, const std::string &allowed)
    {
      std::ostringstream message;
      message << what << " = " << value << ", but it must be " << allowed;
      throw InputError(message.str());
    }
  } // namespace

  Lame lame_from_young(double E, double nu, PlaneState state)
  {
    if (!(E > 0))
      refuse("Young's modulus E", E, "positive");
    if (!(nu > -1 && nu < .5))
      refuse("Poisson's ratio nu", nu,
             "larger than -1 and smaller than 1/2; for a nearly incompressible solid take .499");
    const double mu = E / (2 * (1 + nu));
    return {state == PlaneState::strain ? E * nu / ((1 + nu) * (1 - 2 * nu))
                                        : E * nu / (1 - nu * nu),
            mu};
  }

  Lame lame_from_bulk(double k, double l)
  {
    if (!(k > 0))
      refuse("the bulk constant k", k, "positive");
    if (!(l > 0))
      refuse("the shear constant l", l, "positive");
    return {k - l / 8, l / 8};
  }

  template <int dim>
  Kernel<dim> influence_function(RadialProfile profile, double horizon)
  {
    return Kernel<dim>::with_diffusion(std::move(profile), horizon, .5);
  }

  template <int dim>
  Kernel<dim> deviatoric_kernel(const Kernel<dim> &influence, double mu)
  {
    return {Structure::tensor, influence.profile(), influence.horizon(),
            2 * (dim + 2) * mu * influence.constant()};
  }

  template Kernel<2> influence_function(RadialProfile, double);
  template Kernel<3> influence_function(RadialProfile, double);
  template Kernel<2> deviatoric_kernel(const Kernel<2> &, double);
  template Kernel<3> deviatoric_kernel(const Kernel<3> &, double);
} // namespace plumbline::physics
