#include "study/work_of_ranks.h"

#include "study/preflight.h"

#include <algorithm>

namespace plumbline::study
{
  namespace
  {
    /// Whether ranks do the same side by side: on lattices and in space, and rules on free bodies.
    bool repeats_work(const scene::Scene &scene, const method::Methods &methods)
    {
      if (!scene.domain.is_free_body)
        return scene.domain.mesh.is_lattice() || scene.domain.is_in_space();
      return std::any_of(methods.begin(), methods.end(),
                         [](const auto &method)
                         { return method->family() == method::MethodFamily::meshfree; });
    }

    std::string names_of(const method::Methods &methods)
    {
      std::string names;
      for (const auto &method : methods)
        names += (names.empty() ? "" : ", ") + method->name();
      return names;
    }
  } // namespace

  std::string work_of_ranks(const scene::Scene &scene, const method::Methods &methods)
  {
    if (!scene.domain.is_in_space())
      return repeats_work(scene, methods) ? "repeated by each: lattices are not shared among ranks"
                                          : "";
    const method::Methods repeated = study::repeated_by_ranks(scene, methods);
    if (repeated.empty())
      return "distributed in slabs of cells along z";
    return "repeated by each: " + names_of(repeated) +
           (repeated.size() < methods.size() ? "; others distributed in slabs of cells along z"
                                             : "");
  }

  std::string repetition(const scene::Scene &scene, const method::Methods &methods,
                         unsigned int n_ranks)
  {
    return "each of the " + std::to_string(n_ranks) + " ranks repeats all of the work" +
           (scene.domain.is_in_space()
                ? " of " + names_of(study::repeated_by_ranks(scene, methods)) +
                      "; Q1, DGQ0 and rules on the nodes of the lattice are distributed where "
                      "the domain is one box" +
                      (scene.time.is_dynamic() ? " and no error is estimated (Reference/estimate)"
                                               : "")
            : scene.domain.dimension == 1
                ? ", because one-dimensional problems are not distributed; use one rank"
                : ", because problems on lattices in the plane are not distributed; use one rank, "
                  "or write Domain/mesh = squares, which is distributed");
  }
} // namespace plumbline::study
