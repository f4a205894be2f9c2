#include "base/error.h"
#include "base/number_text.h"
#include "physics/expression.h"
#include "physics/one_step_bound.h"
#include "scene/keys.h"
#include "scene/models/model.h"
#include "scene/values.h"

#include <algorithm>
#include <cmath>

namespace plumbline::scene
{
  namespace
  {
    std::string number(double value)
    {
      return base::to_text(value, 6);
    }

    /// ω, which decreases to 0 at the boundary of a box.
    double smoothstep(const geometry::Box &box, double horizon, const dealii::Point<2> &x)
    {
      double distance = horizon;
      for (unsigned int a = 0; a < 2; ++a)
        distance = std::min({distance, x[a] - box.lower[a], box.upper[a] - x[a]});
      const double t = std::max(0., distance) / horizon;
      return t * t * (3 - 2 * t);
    }

    class DoubleWells : public Model
    {
    public:
      std::string name() const override { return "double well"; }
      std::string help() const override
      {
        return "nonlinear bonds that soften and break (Jha & Lipton 2018), with c, beta and the "
               "boundary function, for transient analyses (Time/final time)";
      }

      Capabilities can() const override
      {
        using C = Capability;
        return of_meshes() | Capabilities{C::double_well, C::double_well_collar,
                                          C::lattice,     C::notch,
                                          C::nonlocal,    C::dynamic,
                                          C::periodic,    C::line};
      }

      Capabilities needs(const Scene &scene) const override
      {
        Capabilities needed = {Capability::double_well};
        if (scene.time.is_dynamic() && !scene.domain.is_periodic)
          needed.insert(Capability::double_well_collar);
        return needed;
      }

      std::map<std::string, Settings> templates() const override
      {
        return {{"double-well",
                 {{"Purpose",
                   "A wave in double-well bonds on a torus: order of convergence of the rules."},
                  {"Domain/boundary", "periodic"},
                  {"Kernel/type", "linear-decay"},
                  {"Kernel/limit", "Navier"},
                  {"Material/model", "double well"},
                  {"Problem/local solution", "none"},
                  {"Time/final time", "0.5"},
                  {"Time/initial displacement", "0.1*sin(2*pi*x), 0"},
                  {"Methods/names", "FA, PA-AC, IPA-AC, IPA-AC-R2"},
                  {"Study/regime", "m"},
                  {"Study/h", "0.1, 0.05, 0.025, 0.0125"},
                  {"Study/horizon", "0.2"},
                  {"Study/norms", "nodal L2"},
                  {"Study/decisive error", "nodal L2 | reference"},
                  {"Reference/method", "torus"}}},
                {"crack",
                 {{"Purpose", "A crack in a notched strip of glass, in SI units."},
                  {"Domain/boxes", "0, -0.005 : 0.03, 0.005"},
                  {"Kernel/type", "constant"},
                  {"Kernel/limit", "Navier"},
                  {"Material/model", "double well"},
                  {"Material/E", "72e9"},
                  {"Material/toughness", "8"},
                  {"Time/density", "2440"},
                  {"Time/final time", "8.3e-6"},
                  {"Crack/notch", "0.01"},
                  {"Crack/load", "2"},
                  {"Methods/names", "FA"},
                  {"Study/m", "4"},
                  {"Study/h", "0.25e-3"}}}};
      }

      void declare(Keys &keys, MaterialSection &material) const override
      {
        keys.add("c", material.c, any_number(),
                 "c > 0 of the double-well potential f(s) = c g(beta s), by default c (1 - "
                 "exp(-beta s)), whose limit is the energy of a broken bond. [force/length]");
        keys.add("beta", material.beta, any_number(),
                 "beta > 0 of the double-well potential. [1/length]");
        constexpr const char *exponential = "exponential";
        keys.add(
            "potential", exponential, any_text(),
            [&material](const std::string &text)
            {
              material.potential = text == exponential ? physics::WellPotential()
                                                       : physics::WellPotential("f", text);
            },
            "g of the double-well potential f(s) = c g(beta s): exponential, 1 - exp(-r); or an "
            "expression in r with +, -, *, /, ^, exp, ln, sqrt, sin, cos, atan, sinh, cosh and "
            "tanh, smooth and concave with g(0) = 0, g'(0) > 0 and a finite limit as r grows, such "
            "as r/(1 + r). With c = beta = 1 it is f itself.");
        keys.add(
            "toughness", "", any_text(),
            [&material](const std::string &text)
            {
              material.toughness.reset();
              if (!text.empty())
                material.toughness = to_number(text);
            },
            "Fracture toughness G_c > 0 of double wells, given with E instead of c and beta "
            "('plumbline grow' has Fracture/toughness). [force/length]");
        keys.add(
            "boundary function", base::word(BoundaryFunction::one), any_text(),
            [&material](const std::string &text)
            {
              material.boundary_function =
                  base::from_word<BoundaryFunction>(text).value_or(BoundaryFunction::expression);
              material.boundary_expression =
                  material.boundary_function == BoundaryFunction::expression ? text : "";
            },
            "omega of double wells, which weakens bonds near the boundary: one; smoothstep, "
            "t^2 (3 - 2t) with t = min(1, distance to the boundary / horizon); or an expression in "
            "x, y and delta (the horizon) with values in [0, 1], in the interaction domain as "
            "well. A bond between x and y has the factor omega(x) omega(y).");
      }

      bool is_linear() const override { return false; }

      std::string constants() const override
      {
        return ": its constants are E and toughness, or c and beta; clear this key";
      }

      void check_constants(const Scene &scene) const override
      {
        const MaterialSection &material = scene.material;
        const bool has_modulus = material.modulus_of_bonds(scene.domain.dimension).has_value();
        require(has_modulus == material.toughness.has_value(),
                std::string("Material/") + (has_modulus ? "E" : "toughness") + " needs Material/" +
                    (has_modulus ? "toughness" : "E") +
                    " with Material/model = double well; give both, or c and beta");
        require(!has_modulus || (material.c == 1 && material.beta == 1),
                "Material/E and toughness replace Material/c and beta; clear one of these pairs");
        require(!material.toughness ||
                    (*material.toughness > 0 && std::isfinite(*material.toughness)),
                "Material/toughness = " + short_number(material.toughness.value_or(0)) +
                    " must be positive and finite; give the energy per unit area of a crack");
      }

      void check_motion(const Scene &scene) const override
      {
        const MaterialSection &material = scene.material;
        const auto positive = [](const std::string &key, double value, const std::string &remedy)
        {
          require(value > 0 && std::isfinite(value), "Material/" + key + " = " +
                                                         short_number(value) +
                                                         " must be positive and finite; " + remedy);
        };
        positive("c", material.c, "it is the energy of a broken bond; use for example 1");
        positive("beta", material.beta,
                 "bonds soften at strains 1/sqrt(2 beta r); use for example 1");
        (void)make_double_well(scene, 1);
        if (material.boundary_function == BoundaryFunction::one)
          return;
        require(scene.problem.solutions.empty() || !scene.problem.loads.empty(),
                "Problem/load = manufactured: manufactured loads are those of Material/boundary "
                "function = one; write that, or give Problem/load as expressions");
        if (material.boundary_function == BoundaryFunction::expression)
          return check_boundary_expression(scene);
        require(scene.domain.mesh.is_of_boxes() && scene.domain.mesh.map.empty(),
                "Material/boundary function = smoothstep falls to 0 at the sides of Domain/boxes, "
                "which Domain/mesh = " +
                    scene.domain.mesh.name +
                    " need not have; write Material/boundary function = one, or Domain/mesh = "
                    "lattice, squares or triangles");
      }

      /// @throws InputError  it is not in [0, 1]
      static double boundary_value(const physics::Expression &omega, const std::string &text,
                                   const dealii::Point<2> &x)
      {
        const double value = omega(x);
        require(value >= 0 && value <= 1,
                "Material/boundary function = '" + text + "' is " + short_number(value) +
                    " at x = " + short_number(x[0]) + ", y = " + short_number(x[1]) +
                    "; omega must be in [0, 1], for example min(1, max(0, (" + text + ")))");
        return value;
      }

      /// Checks its values at some points of the boxes; all others are checked when evaluated.
      static void check_boundary_expression(const Scene &scene)
      {
        constexpr unsigned int n_points = 23;
        const std::string &text = scene.material.boundary_expression;
        const physics::Expression omega("Material/boundary function", text, scene.names(1));
        require(omega.n_components() == 1, "Material/boundary function = '" + text + "' has " +
                                               std::to_string(omega.n_components()) +
                                               " components; give one, in x, y and delta");
        for (const geometry::Box &box : scene.domain.boxes.include)
          for (unsigned int i = 0; i < n_points * n_points; ++i)
          {
            dealii::Point<2> x = box.lower;
            x[0] += (box.upper[0] - box.lower[0]) * (i % n_points + .5) / n_points;
            x[1] += (box.upper[1] - box.lower[1]) * (i / n_points + .5) / n_points;
            (void)boundary_value(omega, text, x);
          }
      }

      physics::Kernel<2> kernel(const Scene &scene, double horizon) const override
      {
        return make_double_well(scene, horizon).linear_kernel();
      }

      void complete(const Scene &scene, const Level &level, Problem &problem) const override
      {
        problem.double_well = make_double_well(scene, level.horizon);
        if (scene.material.boundary_function == BoundaryFunction::smoothstep)
          problem.boundary_function = [box = scene.domain.boxes.include.front(),
                                       horizon = level.horizon](const dealii::Point<2> &x)
          { return smoothstep(box, horizon, x); };
        if (scene.material.boundary_function == BoundaryFunction::expression)
        {
          const std::string &text = scene.material.boundary_expression;
          problem.boundary_function =
              [text, omega = physics::Expression("Material/boundary function", text,
                                                 scene.names(level.horizon))](
                  const dealii::Point<2> &x) { return boundary_value(omega, text, x); };
        }
      }

      std::vector<std::pair<std::string, std::string>> facts(const Scene &scene,
                                                             double horizon) const override
      {
        const physics::DoubleWell law = make_double_well(scene, horizon);
        const auto speeds = law.wave_speeds(scene.time.density);
        const double final_time = scene.time.final_time,
                     lipschitz = 6 * law.c_bar() / (horizon * horizon);
        std::vector<std::pair<std::string, std::string>> facts = {
            law.shape().is_exponential()
                ? std::pair<std::string, std::string>("f(s) = c (1 - exp(-β s)), stiffness p = cβ",
                                                      "c = " + number(law.c()) +
                                                          ", β = " + number(law.beta()) +
                                                          ", p = " + number(law.stiffness()))
                : std::pair<std::string, std::string>(
                      "f(∞), stiffness p = f'(0), r̄² = β s where bonds soften, β = p/f(∞)",
                      number(law.c()) + ", " + number(law.stiffness()) + ", " +
                          number(law.shape().softening())),
            {"moments M_1, M_2 of J", number(law.moment(1)) + ", " + number(law.moment(2))}};
        if (law.dim() == 1)
        {
          facts.emplace_back("modulus of the elastic limit", number(law.modulus()));
          facts.emplace_back("long-wave speed", number(speeds.longitudinal));
        }
        else
        {
          facts.emplace_back("λ = μ of the elastic limit", number(law.modulus()));
          facts.emplace_back("long-wave speeds c_L, c_T",
                             number(speeds.longitudinal) + ", " + number(speeds.transverse));
        }
        facts.emplace_back("toughness G_c", number(law.toughness()));
        facts.emplace_back("C₁, C₂, C₃ = max |F₁'|, |F₁''|, |F₁'''|",
                           number(law.c1()) + ", " + number(law.c2()) + ", " + number(law.c3()));
        facts.emplace_back("C̄; Lipschitz bound 6 C̄/ε² of F in L²",
                           number(law.c_bar()) + "; " + number(lipschitz));
        facts.emplace_back(
            "proven order of convergence (Jha & Lipton 2018, doi:10.1137/17M1112236, Theorem 3)",
            "h^γ/ε² for data in C^(0,γ), γ <= 1, and Δt; smooth data converge faster");
        facts.emplace_back("factor of that bound, T exp(T (1 + 6 C̄/ε²)), eq. (17) there; too large "
                           "to bound the actual error usefully",
                           number(physics::growth_factor(lipschitz, final_time)));
        facts.emplace_back(
            "C₁, C₂ of section 6 of that paper, C₂ with √3 as printed for three dimensions",
            number(physics::growth_factor(lipschitz, final_time)) + ", " +
                number(physics::section_six_factor(law.c_bar(), horizon, final_time)));
        facts.emplace_back("step limits of θ schemes for the bound (52): (53), ε²/C̄, as printed; "
                           "with the factor 6 of (41), at θ = ½ and 1",
                           number(physics::printed_step_limit(law)) + "; " +
                               number(physics::step_limit(law, .5)) + ", " +
                               number(physics::step_limit(law, 1)));
        facts.emplace_back("softening strain of a bond as long as the horizon",
                           number(law.softening_strain(horizon)));
        return facts;
      }
    };
  } // namespace

  physics::DoubleWell make_double_well(const Scene &scene, double horizon)
  {
    const MaterialSection &material = scene.material;
    const auto with = [&](double c, double beta)
    {
      return physics::DoubleWell(static_cast<int>(scene.domain.dimension), scene.kernel.profile, c,
                                 beta, horizon, material.potential);
    };
    const auto modulus = material.modulus_of_bonds(scene.domain.dimension);
    if (!modulus)
    {
      const double limit = material.potential.limit();
      return with(material.c * limit, material.beta * material.potential.slope() / limit);
    }
    // the toughness is proportional to c, the modulus to c β
    const physics::DoubleWell unit = with(1, 1);
    const double c = material.toughness.value() / unit.toughness();
    return with(c, *modulus / (c * unit.modulus()));
  }

  const Model &double_well()
  {
    static const DoubleWells model;
    return model;
  }
} // namespace plumbline::scene
