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

  bool is_any_distributed(const scene::Scene &scene, const method::Methods &methods)
  {
    const scene::DomainSection &domain = scene.domain;
    if (domain.is_in_space())
      return study::repeated_by_ranks(scene, methods).size() < methods.size();
    return domain.is_free_body || !domain.mesh.is_lattice();
  }

  std::string work_of_ranks(const scene::Scene &scene, const method::Methods &methods)
  {
    if (!scene.domain.is_in_space())
      return repeats_work(scene, methods) ? "repeated by each" : "";
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
                      "the domain is " +
                      (scene.time.is_dynamic()
                           ? "one box and no error is estimated (Reference/estimate)"
                           : "one box or several (Domain/boxes) and Study/norms is without energy")
            : scene.domain.is_free_body
                ? ", because methods on bodies with a free boundary are not all distributed; use "
                  "one "
                  "rank"
                : ", because each method is compared with its own finest level (Study/decisive "
                  "error), for which one process keeps all solutions; use one rank, or choose "
                  "another error");
  }
} // namespace plumbline::study
