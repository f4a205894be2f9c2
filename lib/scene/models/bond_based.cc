#include "base/number_text.h"
#include "scene/models/model.h"
#include "scene/on_line.h"
#include "scene/values.h"

#include <cmath>

namespace plumbline::scene
{
  namespace
  {
    template <int dim>
    physics::Kernel<dim> kernel_of(const Scene &scene, double horizon)
    {
      const KernelSection &kernel = scene.kernel;
      if (kernel.limit == Limit::navier)
      {
        const auto modulus = scene.material.modulus_of_bonds(scene.domain.dimension);
        return physics::Kernel<dim>::with_bulk_modulus(
            kernel.profile, horizon, modulus ? 5. / 3 * *modulus : kernel.bulk_modulus);
      }
      if (kernel.limit == Limit::none)
        return {kernel.structure, kernel.profile, horizon, kernel.constant};
      return physics::Kernel<dim>::with_diffusion(kernel.profile, horizon,
                                                  kernel.limit == Limit::laplace ? 1 : .5);
    }

    class BondBased : public Model
    {
    public:
      std::string name() const override { return "bond-based"; }
      std::string help() const override
      {
        return "scalar kernels and bond tensors, defined by section Kernel alone";
      }

      Capabilities can() const override
      {
        using C = Capability;
        return of_meshes() | Capabilities{C::lattice, C::heterogeneous, C::nonlocal, C::dynamic,
                                          C::cracks,  C::line,          C::space};
      }
      Capabilities can_in_space() const override
      {
        return can() | Capabilities{Capability::free_boundary};
      }

      std::map<std::string, Settings> templates() const override
      {
        return {{"scalar", {{"Problem/solution", "x^3 + 2*y^2"}}},
                {"tensor",
                 {{"Kernel/type", "bond-tensor"},
                  {"Kernel/limit", "Navier"},
                  {"Problem/solution", "x*(1-x)/2 + y*(1-y)/2, x*(1-x)/2 + y*(1-y)/2"}}}};
      }

      bool takes_influence() const override { return false; }

      std::string constants() const override
      {
        return ": the constants of bonds are Kernel/bulk modulus or Material/E; clear this key, or "
               "choose LPS or variational";
      }

      void check_constants(const Scene &scene) const override
      {
        if (!scene.material.modulus_of_bonds(scene.domain.dimension))
          return;
        require(scene.kernel.limit == Limit::navier,
                "Material/E = " + scene.material.given[0][0] +
                    " is for bond tensors; write Kernel/type = bond-tensor and Kernel/limit = "
                    "Navier, or clear Material/E");
        require(scene.kernel.bulk_modulus == 1,
                "Material/E and Kernel/bulk modulus set the same constant; clear one of them");
      }

      physics::Kernel<2> kernel(const Scene &scene, double horizon) const override
      {
        return kernel_of<2>(scene, horizon);
      }
      physics::Kernel<3> kernel_in_space(const Scene &scene, double horizon) const override
      {
        return kernel_of<3>(scene, horizon);
      }

      std::vector<std::pair<std::string, std::string>>
      derived_constants(const Scene &scene, double horizon) const override
      {
        const unsigned int dimension = scene.domain.dimension;
        if (dimension == 1 || !scene.material.modulus_of_bonds(dimension))
          return {};
        const double c = scene.domain.is_in_space() ? kernel_in_space(scene, horizon).constant()
                                                    : kernel(scene, horizon).constant();
        return {{"micromodulus c, C = c ρ(|ξ|/δ) ξ⊗ξ/|ξ|²",
                 base::to_text(c, 6) + " [force/length^" + std::to_string(dimension + 4) +
                     "] at δ = " + base::to_text(horizon, 6) + ", proportional to δ^-" +
                     std::to_string(dimension + 2)}};
      }

      std::vector<std::pair<std::string, std::string>> facts(const Scene &scene,
                                                             double horizon) const override
      {
        const physics::LocalLimit limit =
            is_on_intervals(scene)       ? make_kernel_on_line(scene, horizon).limit()
            : scene.domain.is_in_space() ? kernel_in_space(scene, horizon).limit()
                                         : kernel(scene, horizon).limit();
        const auto speed = [&](double modulus)
        { return base::to_text(std::sqrt(modulus / scene.time.density), 6); };
        auto facts = derived_constants(scene, horizon);
        if (scene.is_vector())
          facts.emplace_back("speeds of long waves c_L, c_T",
                             speed(3 * limit.mu) + ", " + speed(limit.mu));
        else
          facts.emplace_back("speed of long waves", speed(limit.diffusion));
        return facts;
      }
    };
  } // namespace

  const Model &bond_based()
  {
    static const BondBased model;
    return model;
  }
} // namespace plumbline::scene
