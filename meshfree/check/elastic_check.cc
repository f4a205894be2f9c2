#include "meshfree/check/elastic_check.h"

#include "meshfree/rules/stiffness.h"

#include <algorithm>
#include <array>
#include <functional>

namespace plumbline::meshfree
{
  template <int dim>
  std::vector<ElasticRange> elastic_ranges(const std::vector<Family<dim>> &families,
                                           const Kernel<dim> &kernel)
  {
    using physics::CubicStiffness;
    using physics::ElasticState;
    if (kernel.n_components() == 1 || families.empty())
      return {};
    std::vector<CubicStiffness> all;
    for (const Family<dim> &family : families)
      all.push_back(stiffness(kernel, family.bonds));
    std::array<int, dim> along{};
    along[0] = 2;
    const double C1111 = kernel.moment(along) / 2;
    const CubicStiffness material{C1111, C1111 / 3, C1111 / 3}; // of bonds alone: λ = μ
    std::vector<ElasticRange> ranges;
    const auto add =
        [&](const std::string &name, const std::function<double(const CubicStiffness &)> &constant)
    {
      std::vector<double> values;
      for (const CubicStiffness &one : all)
        values.push_back(constant(one));
      std::sort(values.begin(), values.end());
      ranges.push_back(
          {name, values.front(), values[values.size() / 2], values.back(), constant(material)});
    };
    add("C1111", [](const CubicStiffness &one) { return one.C1111; });
    add("C1122", [](const CubicStiffness &one) { return one.C1122; });
    add("C1212", [](const CubicStiffness &one) { return one.C1212; });
    add("(C1111-C1122)/2", [](const CubicStiffness &one) { return (one.C1111 - one.C1122) / 2; });
    const std::vector<std::pair<ElasticState, std::string>> states =
        dim == 2 ? std::vector<std::pair<ElasticState, std::string>>{{ElasticState::plane_stress,
                                                                      ", plane stress"},
                                                                     {ElasticState::plane_strain,
                                                                      ", plane strain"}}
                 : std::vector<std::pair<ElasticState, std::string>>{{ElasticState::solid, ""}};
    for (const auto &[state, name] : states)
    {
      const ElasticState of = state;
      add("E" + name, [of](const CubicStiffness &one) { return engineering_constants(one, of).E; });
      add("nu" + name,
          [of](const CubicStiffness &one) { return engineering_constants(one, of).nu; });
    }
    add("anisotropy", [](const CubicStiffness &one)
        { return engineering_constants(one, ElasticState::solid).anisotropy; });
    return ranges;
  }

  template std::vector<ElasticRange> elastic_ranges(const std::vector<Family<2>> &,
                                                    const Kernel<2> &);
  template std::vector<ElasticRange> elastic_ranges(const std::vector<Family<3>> &,
                                                    const Kernel<3> &);
} // namespace plumbline::meshfree
