#include "check/moduli.h"

#include "base/choice.h"
#include "base/error.h"
#include "base/number_list.h"
#include "base/number_text.h"
#include "base/similar_words.h"
#include "meshfree/rules/stiffness.h"
#include "scene/values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace plumbline::base
{
  template <>
  inline constexpr auto words<physics::ElasticState> =
      std::array{"plane stress", "plane strain", "3D"};
} // namespace plumbline::base

namespace plumbline::check
{
  namespace
  {
    using meshfree::Rule;
    using physics::ElasticState;

    std::vector<Rule> chosen_rules(const std::string &names, const std::vector<Rule> &own)
    {
      if (names == scene::all)
        return meshfree::rules();
      std::vector<Rule> available = meshfree::rules();
      for (const std::vector<Rule> *table : {&meshfree::rules_on_request(), &own})
        available.insert(available.end(), table->begin(), table->end());
      std::vector<Rule> chosen;
      std::string known;
      for (const Rule &rule : available)
        known += (known.empty() ? "" : ", ") + rule.name;
      std::istringstream list(names);
      for (std::string name; std::getline(list, name, ',');)
      {
        auto found = std::find_if(available.begin(), available.end(),
                                  [&](const Rule &rule) { return rule.name == name; });
        if (found == available.end()) // no rule of the caller's own: other names of ours
          found = std::find_if(available.begin(), available.end(),
                               [ours = base::to_lower(scene::method_name(name))](const Rule &rule)
                               { return base::to_lower(rule.name) == ours; });
        if (found == available.end())
          throw InputError("--rules: '" + name + "' is not known; choose all or some of " + known);
        if (found->is_scalar)
          throw InputError("--rules: '" + found->name +
                           "' supports scalar kernels only, which have no elastic "
                           "constants; take GFD or IPA-AC-R2");
        chosen.push_back(*found);
      }
      return chosen;
    }

    std::vector<double> ratios_of(const std::vector<std::string> &given)
    {
      std::vector<double> ratios =
          given.empty() ? std::vector<double>{2, 3, 4, 5} : base::to_numbers(ratios_option, given);
      for (const double m : ratios)
        if (!(m >= 1) || m > 50)
          throw InputError(std::string(ratios_option) + ": horizon / h = " + base::to_text(m, 6) +
                           " must be between 1 (below that a node has no neighbours) and 50");
      return ratios;
    }

    const physics::RadialProfile &profile_of(const std::string &name)
    {
      const physics::KernelType &type = physics::kernel_type(name);
      if (type.structure != physics::Structure::tensor || type.make != nullptr)
        throw InputError("--kernel: '" + name +
                         "' has no elastic constants of its own; choose bond-tensor, 'bond-tensor "
                         "constant' or 'bond-tensor conical'");
      return type.profile;
    }

    template <int dim>
    meshfree::NeighbourhoodQuadrature<dim> quadrature(const Rule &rule,
                                                      const physics::Kernel<dim> &kernel)
    {
      if constexpr (dim == 2)
        return rule.in_plane(kernel);
      else
      {
        if (!rule.in_space)
          throw InputError("--state: rule '" + rule.name +
                           "' is made for the plane; choose 'plane stress' or 'plane strain'");
        return rule.in_space(kernel);
      }
    }

    /// On a lattice of mesh size 1.
    template <int dim>
    analysis::Record measure(const Rule &rule, const ModuliOptions &options, ElasticState state,
                             double m)
    {
      const auto kernel = physics::Kernel<dim>::with_bulk_modulus(
          profile_of(options.kernel), m, physics::bulk_modulus_of_bonds(options.E, state));
      analysis::Record record;
      record.key.analysis = "moduli";
      record.key.method = rule.name;
      record.key.h = 1;
      record.key.horizon = m;
      try
      {
        const auto bonds =
            lattice_bonds(quadrature(rule, kernel), kernel, 1., geometry::Backend::fast);
        const physics::CubicStiffness stiffness = meshfree::stiffness(kernel, bonds.family);
        const auto constants = physics::engineering_constants(stiffness, state);
        record.set("C1111", stiffness.C1111);
        record.set("C1122", stiffness.C1122);
        record.set("C1212", stiffness.C1212);
        record.set("E", constants.E);
        record.set("nu", constants.nu);
        record.set("shear along axes", constants.shear_along);
        record.set("shear across axes", constants.shear_across);
        record.set("anisotropy", constants.anisotropy);
        record.set("error of E", constants.E / options.E - 1);
        record.set("neighbours", static_cast<double>(bonds.family.size()));
      }
      catch (const NumericalError &error)
      {
        record.failure = error.what();
      }
      return record;
    }
  } // namespace

  ElasticState elastic_state(const std::string &word)
  {
    auto state = base::from_word<ElasticState>(word);
    if (!state)
      state = base::from_word<ElasticState>("plane " + word); // as in Material/plane
    if (!state)
      throw InputError("--state: '" + word +
                       "' is not known; choose 'plane stress', 'plane strain' or 3D");
    return *state;
  }

  study::StudyResults moduli_of_rules(const ModuliOptions &options)
  {
    if (!(options.E > 0) || !std::isfinite(options.E))
      throw InputError("--E: Young's modulus is " + base::to_text(options.E, 6) +
                       "; give a number above 0");
    const ElasticState state = elastic_state(options.state);
    study::StudyResults results;
    results.analysis = "moduli";
    results.scene_name = "moduli of " + options.kernel + ", " + base::word(state);
    results.purpose = "Elastic constants of meshfree rules on lattices";
    for (const Rule &rule : chosen_rules(options.rules, options.own_rules))
      for (const double m : ratios_of(options.ratios))
        results.records.push_back(state == ElasticState::solid
                                      ? measure<3>(rule, options, state, m)
                                      : measure<2>(rule, options, state, m));
    return results;
  }

  report::View moduli_view(const study::StudyResults &results)
  {
    report::View view = report::default_view(results);
    std::vector<report::RecordColumn> columns = {
        {"rule",
         [](const analysis::Record &record) { return report::text_cell(record.key.method); }},
        {"m",
         [](const analysis::Record &record) { return report::number_cell(record.key.horizon); }},
        report::count_column("neighbours", "neighbours")};
    for (const auto name : {"E", "nu", "shear along axes", "shear across axes", "anisotropy",
                            "C1111", "C1122", "C1212", "error of E"})
      columns.push_back(report::number_column(name, name));
    view.parts = {
        {"moduli", view.title, "",
         report::table_of(results, columns,
                          [](const analysis::Record &record) { return record.failure.empty(); })},
        report::failures(results, "Without weights", "reason")};
    return view;
  }
} // namespace plumbline::check
