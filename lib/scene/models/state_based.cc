#include "base/error.h"
#include "scene/keys.h"
#include "scene/models/model.h"

#include <cmath>
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
    /// Solids of λ and μ: bonds of the influence function, and a dilatation.
    class StateBased : public Model
    {
    public:
      Capabilities can() const override
      {
        using C = Capability;
        return of_meshes() | Capabilities{C::lattice,          C::heterogeneous, C::nonlocal,
                                          C::dynamic,          C::dilatation,    C::zero_dilatation,
                                          C::mixed_dilatation, C::space};
      }

      Capabilities needs(const Scene &scene) const override
      {
        Capabilities needed;
        if (scene.has_dilatation())
          needed.insert(Capability::dilatation);
        if (scene.has_dilatation() && scene.domain.is_damaged())
          needed.insert(Capability::damaged_dilatation);
        return needed;
      }

      bool is_state_based() const override { return true; }

      /// For λ = μ there are bond forces only.
      bool has_dilatation(const Scene &scene) const override
      {
        const MaterialSection &material = scene.material;
        if (scene.solver.is_full_model || scene.domain.is_damaged() || !material.is_homogeneous)
          return true;
        const physics::Lame lame = material.lame()({});
        return std::abs(lame.lambda - lame.mu) > 1e-14 * lame.mu;
      }

      std::string constants() const override
      {
        return " needs one pair of constants: E and nu, lambda and mu, or k and l";
      }

      physics::Kernel<2> kernel(const Scene &scene, double horizon) const override
      {
        // bodies with a free boundary have their own constants at each node
        const bool is_one = scene.material.is_homogeneous && !scene.domain.is_free_body;
        return physics::deviatoric_kernel(
            physics::influence_function<2>(scene.kernel.profile, horizon),
            is_one ? scene.material.lame()({}).mu : 1);
      }

      physics::Kernel<3> kernel_in_space(const Scene &scene, double horizon) const override
      {
        return physics::deviatoric_kernel(
            physics::influence_function<3>(scene.kernel.profile, horizon),
            scene.material.lame()({}).mu);
      }

      std::optional<physics::Dilatation<3>> dilatation_in_space(const Scene &scene,
                                                                double horizon) const override
      {
        if (!scene.has_dilatation())
          return {};
        const physics::Lame lame = scene.material.lame()({});
        return physics::Dilatation<3>{physics::influence_function<3>(scene.kernel.profile, horizon),
                                      [lame](const dealii::Point<3> &) { return lame; }, false,
                                      true};
      }

      void complete(const Scene &scene, const Level &level, Problem &problem) const override
      {
        if (scene.domain.is_free_body)
          problem.lame = scene.material.lame();
        if (scene.has_dilatation())
          problem.dilatation = {physics::influence_function<2>(scene.kernel.profile, level.horizon),
                                scene.material.lame(), mean() == physics::Mean::harmonic,
                                scene.material.is_homogeneous};
      }
    };

    class Lps : public StateBased
    {
    public:
      std::string name() const override { return "LPS"; }
      std::string help() const override
      {
        return "the linear peridynamic solid, with harmonic means of lambda and of mu at the two "
               "ends of a bond";
      }

      Capabilities can() const override { return StateBased::can() | of_damage(); }

      std::map<std::string, Settings> templates() const override
      {
        return {{"LPS",
                 {{"Kernel/type", "1/r"},
                  {"Kernel/limit", "Navier"},
                  {"Problem/solution", "x*(1-x)/2 + y*(1-y)/2, x*(1-x)/2 + y*(1-y)/2"},
                  {"Material/model", "LPS"},
                  {"Material/E", "1"},
                  {"Material/nu", "0.3"}}}};
      }

      void declare(Keys &keys, MaterialSection &material) const override
      {
        auto &given = material.given;
        keys.add("plane", material.plane, "Plane strain or plane stress, for E and nu.");
        keys.add(
            "E", given[0][0],
            "Young's modulus > 0, an expression in x and y; a number for bond tensors and double "
            "wells. [force/length^2]");
        keys.add("nu", given[0][1],
                 "Poisson's ratio, -1 < nu < 1/2, given with E. Bond tensors and double wells have "
                 "1/4, and 1/3 in plane stress.");
        keys.add("lambda", given[1][0],
                 "Lame's first constant (in plane stress that of the plane), instead of E and nu. "
                 "[force/length^2]");
        keys.add(
            "mu", given[1][1],
            "The shear modulus > 0, given with lambda > -mu (> -2 mu / 3 in three dimensions). "
            "[force/length^2]");
        keys.add(
            "surface terms", base::word(material.surface_terms),
            one_of({"automatic", "published", "none", "consistent", "energy"}),
            [&material](const std::string &text)
            { material.surface_terms = *base::from_word<SurfaceTerms>(text); },
            "Forces that replace those of missing bonds at crack faces and free surfaces "
            "(Domain/cracks, Domain/outside). The dilatation is corrected in all cases. published: "
            "Fan et al. 2022, "
            "eqs. (3.19)-(3.22); they exert a net force of order sqrt(delta) at crack tips, so "
            "that the observed order tends to 1/2, and are inexact across interfaces and on "
            "oblique faces. none: no pair terms; first order at cracks, but not exact in uniaxial "
            "stress along a face. consistent: exact in uniaxial stress along straight faces, also "
            "oblique ones "
            "and on interfaces, and without a net force at tips of cracks along rows of nodes. "
            "energy: as none, and the forces derive from the energy of the bonds and the corrected "
            "dilatations, so that they also balance in moment. Galerkin methods support energy and "
            "none. "
            "automatic: published; in 'plumbline grow' Fracture/surface terms decides.");
        keys.add("dilatation in interaction domain", material.has_collar_dilatation, "zero",
                 "from data",
                 "theta in the interaction domain, for state-based solids on scattered nodes: from "
                 "data, or zero, which is wrong and demonstrates the size of this error.");
      }

      physics::Mean mean() const override { return physics::Mean::harmonic; }

      void check(const physics::Lame &lame, bool is_homogeneous) const override
      {
        if (is_homogeneous || lame.lambda > 0)
          return;
        std::ostringstream message;
        message << "lambda = " << lame.lambda
                << ", but harmonic means need it positive; choose constants with lambda > 0 (nu > "
                   "0), or Material/model = variational";
        throw InputError(message.str());
      }
    };

    class Variational : public StateBased
    {
    public:
      std::string name() const override { return "variational"; }
      std::string help() const override
      {
        return "the variational model, with constants at one point";
      }

      Capabilities can() const override
      {
        return StateBased::can() | Capabilities{Capability::free_boundary, Capability::floating};
      }
      Capabilities can_in_space() const override { return StateBased::can(); }

      std::map<std::string, Settings> templates() const override
      {
        return {{"variational",
                 {{"Purpose", "A bar constrained on the left and pulled on the right."},
                  {"Domain/boxes", "0, 0 : 2, 1"},
                  {"Domain/boundary", "free"},
                  {"Domain/fixed", "0, 0 : 0.1, 1"},
                  {"Kernel/type", "1/r"},
                  {"Kernel/limit", "Navier"},
                  {"Material/model", "variational"},
                  {"Material/k", "100"},
                  {"Material/l", "800"},
                  {"Problem/load", "100*(x > 1.9 - 1e-9), 0"},
                  {"Problem/constraint", "0, 0"},
                  {"Problem/local solution", "none"},
                  {"Methods/names", "FA, PA-AC, IPA-AC"},
                  {"Methods/nodes", "vertices"},
                  {"Study/regime", "m"},
                  {"Study/h", "1/10, 1/20, 1/40, 1/80, 1/160"},
                  {"Study/horizon", "0.2"},
                  {"Study/norms", "averages L2"},
                  {"Study/decisive error", "averages L2 | own finest level"}}}};
      }

      void declare(Keys &keys, MaterialSection &material) const override
      {
        keys.add("k", material.given[2][0],
                 "lambda + mu > 0 of the variational model, instead of E and nu. [force/length^2]");
        keys.add("l", material.given[2][1],
                 "8 mu > 0 of the variational model, given with k. [force/length^2]");
      }
    };
  } // namespace

  const Model &lps()
  {
    static const Lps model;
    return model;
  }

  const Model &variational()
  {
    static const Variational model;
    return model;
  }
} // namespace plumbline::scene
