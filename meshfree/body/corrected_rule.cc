#include "meshfree/body/corrected_rule.h"

#include "meshfree/discretisations.h"

#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    class CorrectedRule : public method::Method
    {
    public:
      CorrectedRule(Rule rule, SurfaceCorrection correction)
          : rule_(std::move(rule)), correction_(std::move(correction))
      {
      }
      std::string name() const override { return rule_.name + "+" + correction_.name; }
      method::MethodFamily family() const override { return method::MethodFamily::meshfree; }
      std::string help() const override
      {
        return rule_.name + " on free bond-based bodies (l = 4k): " + correction_.help;
      }
      bool is_in_all() const override { return false; }

      method::Capabilities can() const override
      {
        using method::Capability;
        return problem::of_meshes() |
               method::Capabilities{Capability::free_boundary, Capability::nonlocal,
                                    Capability::dynamic};
      }
      std::string why_not(const problem::Problem<2> &problem) const override
      {
        if (!problem.body())
          return "it corrects bonds near the free surfaces of bodies; write Domain/boundary = free "
                 "with Material/model = variational, or take " +
                 rule_.name;
        return "";
      }

      std::unique_ptr<method::Discretisation>
      discretise(const problem::Problem<2> &problem,
                 const base::Communicator & /*communicator*/) const override
      {
        return discretise_by_bonds(rule_, correction_, problem);
      }

      /// Bonds, and the factor by nested dissection, as expected of growing cracks.
      double expected_bytes(const method::ProblemSize &size) const override
      {
        const double m = size.level.horizon / size.level.h, n = size.n_free;
        return 250 * M_PI * m * m * n + 100 * m * m * n * std::log2(std::max(2., n));
      }

    private:
      Rule rule_;
      SurfaceCorrection correction_;
    };
  } // namespace

  method::Methods corrected_rules()
  {
    method::Methods methods;
    for (const std::string rule : {"FA", "IPA-AC-R2"})
      for (const SurfaceCorrection &correction : surface_corrections())
        methods.push_back(
            std::make_shared<CorrectedRule>(find_rule(rule, "surface correction of"), correction));
    return methods;
  }
} // namespace plumbline::meshfree
